// Free borders, and places where several facets are equally near (docs/theory/contact.md, 1).
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>

#include "contact/enforce/law.hpp"
#include "contact/search/nearest.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

Options still(double gap) {
  Options o;
  o.gap = gap;
  o.stiffness_scale = 1.0;
  o.depth_limit = 0.6;
  o.rules.switch_correction = false;  // imposed motion
  return o;
}

// Forces where the host stands against minus the gradient of what is stored, by central differences: the largest difference over the
// largest force. `make` gives an interface like `walk`. Nodes without a force may be left out.
template <class Make>
double off_the_gradient(const Make& make, const Interface& walk, const Host& host, double d, bool only_loaded) {
  const auto history = walk.history();
  const auto stored = [&](const std::vector<Vec3>& at) {
    Interface probe = make();
    probe.restore(history);
    Host h = host;
    h.x = at;
    h.contact(probe);
    return h;
  };
  const Host here = stored(host.x);
  double scale = 0.0, worst = 0.0;
  for (const Vec3& f : here.f) scale = std::max(scale, norm(f));
  for (std::size_t k = 0; k < host.x.size(); ++k) {
    if (only_loaded && squared_norm(here.f[k]) == 0.0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> plus = host.x, minus = host.x;
      plus[k][axis] += d;
      minus[k][axis] -= d;
      const double slope = (stored(plus).last.elastic - stored(minus).last.elastic) / (2 * d);
      worst = std::max(worst, std::abs(here.f[k][axis] + slope) / scale);
    }
  }
  return worst;
}

// A sheet of 4 x 4 facets, half of them four times as stiff, and a free node; where asked with a thickness for automatic gaps of 0.1 to
// 0.35, thin where it is stiff.
struct UnevenSheet {
  Host host;
  std::vector<Facet> facets;
  std::vector<double> stiffness, thickness;
  std::size_t node = 0;

  explicit UnevenSheet(const std::function<double(double, double)>& height, bool thick = false)
      : facets(grid(host, 4, 4, -1.5, 1.5, -1.5, 1.5, height)) {
    for (std::size_t f = 0; f < facets.size(); ++f) {
      stiffness.push_back(f % 4 < 2 ? 1.0 : 4.0);
      if (thick) thickness.push_back((f % 4 < 2 ? 0.5 : 0.2) * (f / 4 % 2 == 0 ? 1.0 : 1.4));
    }
    node = static_cast<std::size_t>(host.add({}, 1.0));
  }
  [[nodiscard]] Interface make(const Options& o) const {
    Interface i = Interface::nodes_to_surface({static_cast<Index>(node)}, {1.0}, Surface(facets), o);
    i.set_surface(1, {stiffness, thickness, {}});
    return i;
  }
};

// A node that came through the front lies deep behind the widened strip of a border: its force, and those on the facet's corners, are minus
// the gradient of what is stored.
TEST(Border, force_in_a_widened_strip_is_the_gradient) {
  const auto bent = [](double x, double y) { return 0.05 * x * x - 0.04 * x * y; };
  double worst = 0.0;
  int looked = 0;
  for (const Law law : {Law::constant, Law::stiffening}) {
    for (const double depth : {0.05, 0.2, 0.45}) {
      for (const double out : {0.12, 0.16, 0.22, 0.3}) {
        Host host;
        const auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, bent);
        const auto n = static_cast<std::size_t>(host.add({1.2, 0.2, bent(1.2, 0.2) + 0.01}, 1.0));
        Options o = still(0.2);
        o.rules.law = law;
        const auto make = [&] {
          Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
          set_stiffness(i, 1, facets.size(), 2.0);
          return i;
        };
        Interface walk = make();
        host.contact(walk);
        std::vector<Vec3> x = host.x;
        const Vec3 from = x[n];
        const Vec3 to{1.5 + out, 0.2, bent(1.5, 0.2) - depth};
        for (int step = 1; step <= 200; ++step) {
          x[n] = from + (step / 200.0) * (to - from);
          host.place(walk, x);
        }
        if (host.last.in_contact == 0) continue;  // beyond the end of this depth's strip
        worst = std::max(worst, off_the_gradient(make, walk, host, 1e-6, false));
        ++looked;
      }
    }
  }
  std::printf("  %d places, force against the gradient: %.1e of the largest force\n", looked, worst);
  EXPECT_GE(looked, 12);
  EXPECT_LT(worst, 2e-6);
}

// Inward folds of curved surfaces near free borders and over a change of stiffness, and of thickness where the gap is automatic: where a
// facet stores more than the nearest one, the force on the node, and those on the corners of both facets, are minus the gradient of what is
// stored.
TEST(Border, force_of_a_facet_that_stores_more_is_the_gradient) {
  const std::vector<std::function<double(double, double)>> shapes{
      [](double x, double y) { return 0.2 * x * x + 0.15 * y * y; }, [](double x, double y) { return 0.15 * x * x - 0.2 * y * y; },
      [](double x, double y) { return -0.2 * x * x - 0.1 * x * y - 0.2 * y * y; }, [](double x, double) { return 0.4 * std::abs(x); }};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  double worst = 0.0;
  int looked = 0;
  for (const auto& [gap, thick] : {std::pair{0.0, false}, {0.2, false}, {0.1, true}}) {
    for (const Law law : {Law::constant, Law::stiffening}) {
      if (gap == 0.0 && law == Law::stiffening) continue;
      for (const auto& height : shapes) {
        UnevenSheet sheet(height, thick);
        Host& host = sheet.host;
        const std::size_t n = sheet.node;
        Options o = still(gap);
        o.automatic_gap = thick;
        o.rules.law = law;
        const auto make = [&] { return sheet.make(o); };
        Interface walk = make();
        std::vector<Vec3> x = host.x;
        for (int step = 0; step < 3000; ++step) {
          // Near the folds between facets.
          const double along = 1.66 * std::sin(0.021 * step + 0.3), across = 0.75 * (step / 300 % 3 - 1) + 0.03 * u(random);
          const double px = step % 600 < 300 ? across : along, py = step % 600 < 300 ? along : across;
          x[n] = {px, py, height(px, py) + (gap > 0.0 ? 0.1 + 0.08 * u(random) : -0.08 + 0.07 * u(random))};
          host.place(walk, x);
          const auto loaded = std::count_if(host.f.begin(), host.f.end(), [](const Vec3& f) { return squared_norm(f) > 0.0; });
          if (host.last.in_contact == 0 || loaded <= 5) continue;  // only the nearest facet acts
          worst = std::max(worst, off_the_gradient(make, walk, host, 1e-7, true));
          ++looked;
        }
      }
    }
  }
  std::printf("  %d places, force against the gradient: %.1e of the largest force\n", looked, worst);
  EXPECT_GE(looked, 200);
  EXPECT_LT(worst, 1e-5);
}

// The same surfaces: what is stored is, word for word (docs/theory/contact.md, 3), the largest that any facet has for the node, each with
// its own gap.
TEST(Border, stored_energy_is_the_largest_of_any_facet) {
  const std::vector<std::function<double(double, double)>> shapes{[](double x, double y) { return 0.2 * x * x + 0.15 * y * y; },
                                                                  [](double x, double y) { return 0.15 * x * x - 0.2 * y * y; },
                                                                  [](double x, double) { return 0.4 * std::abs(x); }};
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  double worst = 0.0;
  int compared = 0, other = 0, beside = 0;
  for (int sheets = 0; sheets < 6; ++sheets) {
    const bool thick = sheets >= 3;
    const auto& height = shapes[static_cast<std::size_t>(sheets) % 3];
    UnevenSheet sheet(height, thick);
    Host& host = sheet.host;
    const std::size_t n = sheet.node;
    Options o = still(thick ? 0.0 : 0.2);
    o.automatic_gap = thick;
    for (int shot = 0; shot < 6000; ++shot) {
      const double px = shot % 2 == 0 ? 0.75 * (shot % 3 - 1) + 0.02 * u(random) : 1.7 * u(random), py = 1.7 * u(random);
      host.x[n] = {px, py, height(px, py) + (thick ? 0.2 + 0.15 * u(random) : 0.1 + 0.09 * u(random))};
      Interface i = sheet.make(o);
      host.contact(i);
      Side side(Surface(sheet.facets), true);
      side.set({sheet.stiffness, sheet.thickness, {}}, false);
      side.gather(host.x);
      // The nearest point, and of every facet T, K and P*; a free node in front: strips are not widened.
      std::vector<Measure> all;
      const Measure* nearest = nullptr;
      for (Index f = 0; f < side.facet_count(); ++f)
        all.push_back(signed_measure(side, f, closest_point(side.patch(f), host.x[n]), host.x[n]));
      for (const Measure& m : all) {
        if (nearest == nullptr || m.closest.squared_distance < nearest->closest.squared_distance) nearest = &m;
      }
      if (nearest->distance < 0.0) continue;
      double most = 0.0, of_nearest = 0.0;
      for (const Measure& m : all) {
        const double gap = thick ? 0.5 * side.thickness_at(m.facet, m.closest.weight) : 0.2;
        const NormalLaw law{gap};
        const double p = gap - nearest->distance;
        if (p <= 0.0 || m.closest.beyond || m.distance < 0.0 || dot(m.normal, nearest->normal) < -0.5) continue;
        double k1 = 0.0, low = 1e300, high = 0.0;
        for (std::size_t c = 0; c < 4; ++c) {
          const double k = side.corner_stiffness(side.surface().local()[at(m.facet)][c]);
          k1 += m.closest.weight[c] * k;
          low = std::min(low, k);
          high = std::max(high, k);
        }
        k1 = std::clamp(k1, low, high);
        const double kappa = taper(side.patch(m.facet), m.closest.s, m.closest.t).value * k1 / (k1 + 1.0);
        const double less = m.distance - nearest->distance;
        const double psi = kappa * law.potential(p - less * (1.0 + p / (0.25 * std::sqrt(side.facet_area(m.facet)))));
        most = std::max(most, psi);
        if (&m == nearest) of_nearest = psi;
      }
      ++compared;
      other += most > 1.001 * of_nearest ? 1 : 0;
      beside += most > 0.0 && of_nearest == 0.0 ? 1 : 0;
      worst = std::max(worst, std::abs(host.last.elastic - most));
    }
  }
  std::printf("  %d nodes, another facet than the nearest for %d, which has nothing for %d of them; differs by %.1e\n", compared, other,
              beside, worst);
  EXPECT_GT(compared, 10000);
  EXPECT_GT(other, 500);
  EXPECT_GT(beside, 20);
  EXPECT_LT(worst, 1e-14);
}

// The force of a node at a tie (above an edge and a corner of several facets, in a groove, behind the top of a pyramid) does not depend on
// how facets and nodes are numbered.
TEST(Border, ties_do_not_depend_on_ids) {
  const auto pyramid = [](double x, double y) { return -0.3 * std::max(std::abs(x), std::abs(y)); };
  const auto pit = [](double x, double y) { return 0.3 * std::max(std::abs(x), std::abs(y)); };
  const auto groove = [](double x, double) { return 0.5 * std::abs(x); };
  struct Place {
    const char* name;
    std::function<double(double, double)> height;
    Vec3 at;
  };
  const std::vector<Place> places{{"above an edge", flat, {0.0, 0.4, 0.05}},
                                  {"above a corner", flat, {0.0, 0.0, 0.05}},
                                  {"behind an edge", flat, {1.0, 0.3, -0.04}},
                                  {"in a groove", groove, {0.0, 0.3, 0.06}},
                                  {"in a pit", pit, {0.0, 0.0, 0.05}},
                                  {"behind a top", pyramid, {0.0, 0.0, -0.06}},
                                  {"above a top", pyramid, {0.0, 0.0, 0.04}},
                                  {"behind a ridge", pyramid, {0.5, 0.5, -0.2}},
                                  {"on the corner of the border", flat, {2, 2, 0.01}}};
  double worst = 0.0;
  for (const Place& place : places) {
    Vec3 first{};
    std::vector<Vec3> reactions;
    for (unsigned seed = 0; seed < 20; ++seed) {
      std::mt19937 random(seed);
      Host sorted;
      const auto facets = grid(sorted, 4, 4, -2, 2, -2, 2, place.height, true, true);
      std::vector<std::size_t> to(sorted.x.size());
      std::iota(to.begin(), to.end(), std::size_t{0});
      std::vector<Facet> listed = facets;
      if (seed > 0) {
        std::shuffle(to.begin(), to.end(), random);
        std::shuffle(listed.begin(), listed.end(), random);
      }
      Host host = sorted;
      for (std::size_t k = 0; k < to.size(); ++k) host.x[to[k]] = sorted.x[k];
      for (Facet& f : listed) {
        for (Index& node : f.node) node = static_cast<Index>(to[static_cast<std::size_t>(node)]);
      }
      const auto n = static_cast<std::size_t>(host.add(place.at, 1.0));
      Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(listed), still(0.1));
      set_stiffness(i, 1, listed.size(), 2.0);
      EXPECT_EQ(host.contact(i).in_contact, 1) << place.name;
      std::vector<Vec3> f(to.size());
      for (std::size_t k = 0; k < to.size(); ++k) f[k] = host.f[to[k]];
      if (seed == 0) {
        first = host.f[n];
        reactions = f;
        continue;
      }
      worst = std::max(worst, norm(host.f[n] - first) / norm(first));
      for (std::size_t k = 0; k < to.size(); ++k) worst = std::max(worst, norm(f[k] - reactions[k]) / norm(first));
    }
  }
  std::printf("  forces differ by %.1e over 20 numberings\n", worst);
  EXPECT_LT(worst, 1e-13);
}

// A held node that slides over a free border is named in the one step in which it is lost, and no longer pushed.
TEST(Border, lost_node_is_named_once) {
  Host host;
  const auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
  const auto n = static_cast<std::size_t>(host.add({1.0, 0.2, 0.05}, 1.0));
  Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), still(0.1));
  set_stiffness(i, 1, facets.size(), 2.0);
  std::vector<Vec3> x = host.x;
  int times = 0;
  for (int step = 0; step < 200; ++step) {
    x[n].x += 0.01;
    host.place(i, x);
    if (host.last.lost == 0) continue;
    ++times;
    ASSERT_EQ(i.nodes_lost().size(), 1u);
    EXPECT_EQ(i.nodes_lost()[0], static_cast<Index>(n));
    EXPECT_GT(x[n].x, 1.5);
    EXPECT_EQ(norm(host.f[n]), 0.0);
  }
  EXPECT_EQ(times, 1);
  EXPECT_EQ(host.last.in_contact, 0);
}

// A step through the surface near its border: held when the node is still behind the surface or its strip at the end of the step, named as
// lost when it went through and over the border in one step, nobody's business when it passed outside of it.
TEST(Border, steps_through_the_surface_near_its_border) {
  struct Shot {
    double from, to;  ///< x before and after; it passes z = 0 half way
    int crossed, lost;
  };
  for (const Shot& s : {Shot{1.3, 1.4, 1, 0}, Shot{1.4, 1.56, 1, 0}, Shot{1.1, 1.8, 0, 1}, Shot{1.0, 1.9, 0, 1}, Shot{1.2, 2.4, 0, 0},
                        Shot{1.6, 1.9, 0, 0}, Shot{1.9, 1.3, 0, 0}}) {
    Host host;
    const auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
    const auto n = static_cast<std::size_t>(host.add({s.from, 0.2, 0.8}, 1.0));
    Options o = still(0.01);
    o.depth_limit = 0.05;
    Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
    set_stiffness(i, 1, facets.size(), 2.0);
    host.dt = host.before = 1.0;
    host.contact(i);
    std::vector<Vec3> x = host.x;
    x[n] = {s.to, 0.2, -0.8};
    host.place(i, x);
    EXPECT_EQ(host.last.crossed, s.crossed) << s.from << " " << s.to;
    EXPECT_EQ(host.last.lost, s.lost) << s.from << " " << s.to;
    EXPECT_EQ(host.last.in_contact, s.crossed) << s.from << " " << s.to;
  }
}

// Where the sides of a quadrilateral converge beyond a border its bilinear form folds over: strips end before that. Over a plane facet no
// node outside the gap is held, whatever its corners. (With strips of a fifth everywhere a round disc meshed from a square, whose corners
// on the border have up to 174 degrees, held nodes that hovered above it, behind the sheet that had turned over.)
TEST(Border, strips_do_not_fold_over) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int folded = 0, narrow = 0;
  for (int shape = 0; shape < 400; ++shape) {
    // Corner 2 on the way from the diagonal to its place in the square; or the side from 2 to 3 ever shorter.
    const double way = 0.5 * (any(random) + 1.0);
    Host host;
    const Vec3 third = shape % 2 == 0 ? Vec3{way, way, 0.0} : Vec3{1.0, 1.0, 0.0};
    const Vec3 fourth = shape % 2 == 0 ? Vec3{-1.0, 1.0, 0.0} : Vec3{1.0 - 2.0 * way, 1.0, 0.0};
    const std::vector<Facet> facets{{{host.add({-1, -1, 0}), host.add({1, -1, 0}), host.add(third), host.add(fourth)}}};
    Patch patch{{host.x[0], host.x[1], host.x[2], host.x[3]}, false, 15};
    fit_strips(patch);
    if (patch.narrow < 1.0) ++narrow;
    std::vector<Index> nodes;
    for (int k = 0; k < 60; ++k) nodes.push_back(host.add({2.0 * any(random), 2.0 * any(random), 0.11}, 1.0));
    const std::vector<double> stiffness(nodes.size(), 1.0);
    Interface i = Interface::nodes_to_surface(nodes, stiffness, Surface(facets), still(0.1));
    set_stiffness(i, 1, 1, 1.0);
    host.contact(i);
    if (host.last.in_contact > 0) ++folded;
    // The area over the strips does not change its sign.
    for (const double wide : {patch.strip, patch.strip + patch.widens * border_widening}) {
      for (const double s : {-1.0 - 2.0 * wide, 1.0 + 2.0 * wide}) {
        for (const double t : {-1.0 - 2.0 * wide, 1.0 + 2.0 * wide}) {
          const std::array<Vec3, 2> along = tangents(patch, s, t);
          EXPECT_GE(cross(along[0], along[1]).z, 0.0) << shape;
        }
      }
    }
  }
  std::printf("  of 400 quadrilaterals %d have narrow strips, %d hold a node outside the gap\n", narrow, folded);
  EXPECT_EQ(folded, 0);
  EXPECT_GT(narrow, 50);
}

}  // namespace
}  // namespace abut::contact
