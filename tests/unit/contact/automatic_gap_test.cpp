// Gap from thickness (Options::automatic_gap): where plates come to rest, per segment, and no energy where thickness changes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "unit/contact/energy_scenes.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

Options automatic(Law law = Law::constant, double gap = 0.0) {
  Options o;
  o.automatic_gap = true;
  o.gap = gap;
  o.rules.law = law;
  return o;
}

// Plates of 3 and 2 with 5 x 5 and 3 x 3 facets under a pressure: at rest their mid-surfaces are (3 + 2)/2 apart less P = F/K of the
// pairs, whatever pass holds a node; TYPE3.
TEST(AutomaticGap, plates_rest_at_half_of_both_thicknesses) {
  for (const Law law : {Law::constant, Law::stiffening}) {
    Host host;
    const std::vector<Facet> lower = grid(host, 5, 5, 0, 10, 0, 10, flat);
    const auto first = static_cast<Index>(host.x.size());
    const std::vector<Facet> upper = grid(
        host, 3, 3, 1, 9, 1, 9, [](double, double) { return 2.5; }, false);
    Interface made = Interface::two_surfaces(Surface(lower), Surface(upper), automatic(law));
    const std::vector<double> k1(lower.size(), 1000.0), k2(upper.size(), 1000.0), t1(lower.size(), 3.0), t2(upper.size(), 2.0);
    made.set_surface(0, {k1, t1, {}, {}});
    made.set_surface(1, {k2, t2, {}, {}});
    // A rigid plate: all nodes move by the mean force, with enough damping to come to rest.
    constexpr double pressing = 0.1;
    double speed = 0.0, opening = 2.5;
    const double nodes = static_cast<double>(host.x.size()) - static_cast<double>(first);
    for (int step = 0; step < 4000; ++step) {
      std::vector<Vec3> x = host.x;
      for (auto i = static_cast<std::size_t>(first); i < x.size(); ++i) x[i].z = opening;
      host.place(made, x, 0.01);
      double force = -pressing;
      for (auto i = static_cast<std::size_t>(first); i < x.size(); ++i) force += host.f[i].z;
      speed = 0.9 * speed + 0.01 * force / nodes;
      opening += 0.01 * speed;
    }
    EXPECT_GE(host.last.in_contact, 16);
    EXPECT_NEAR(host.last.normal_force.z, pressing, 1e-3 * pressing);
    EXPECT_NEAR(opening, 2.5 - host.last.largest_penetration, 1e-12);
    EXPECT_LT(host.last.largest_penetration, 1e-3);
  }
}

// A node of TYPE5 with a thickness of its own over facets of 1 and 4, and over solids (0): per segment, away from the change. The gap of
// the card is the least.
TEST(AutomaticGap, is_that_of_the_segment) {
  Host host;
  const std::vector<Facet> facets = grid(host, 8, 1, 0, 80, -5, 5, flat);
  const Index n = host.add({5, 0, 10}, 0.0);
  const std::vector<double> t{1, 1, 1, 4, 4, 4, 0, 0}, k(8, 10.0), own{0.6}, share{2.5};
  for (const double card : {0.0, 0.7}) {
    Interface made = Interface::nodes_to_surface({n}, share, Surface(facets), automatic(Law::constant, card));
    made.set_surface(1, {k, t, {}, {}});
    made.set_surface(0, {{}, own, {}, {}});
    const auto penetration = [&](double x, double z) {
      std::vector<Vec3> at = host.x;
      at[static_cast<std::size_t>(n)] = {x, 0, 10};
      host.place(made, at);
      at[static_cast<std::size_t>(n)].z = z;
      return host.place(made, at).largest_penetration;
    };
    for (const auto& [x, thickness] : {std::pair{5.0, 1.0}, {15.0, 1.0}, {45.0, 4.0}, {75.0, 0.0}}) {
      const double gap = std::max(card, 0.5 * (0.6 + thickness));
      EXPECT_NEAR(penetration(x, gap - 0.01), 0.01, 1e-14) << x;
      EXPECT_EQ(penetration(x, gap + 0.01), 0.0) << x;
      std::vector<NodalContact> nodal(host.x.size());
      made.add_nodal_contact(nodal);
      EXPECT_NEAR(nodal[static_cast<std::size_t>(n)].opening, 0.01, 1e-14);
    }
    // Between segments of 1 and 4 it goes from one to the other without a jump. Just before an edge towards which it grows the facet
    // beyond counts with its gap at the edge, less for being further (docs/theory/contact.md, 3).
    for (const double x : {20.001, 30.0, 35.0, 39.0, 39.999}) {
      const double from = x < 30.0 ? 20.0 : 30.0, corner_left = x < 30.0 ? 1.0 : 2.5, corner_right = corner_left + 1.5;
      const auto gap_at = [&](double u) { return std::max(card, 0.5 * (0.6 + corner_left + u * (corner_right - corner_left))); };
      const double gap = gap_at((x - from) / 10.0), distance = gap - 0.01;
      const double less = std::hypot(distance, from + 10.0 - x) - distance, length = 2.5;
      const double beyond = less < length ? gap_at(1.0) - less * length / (length - less) : 0.0;
      EXPECT_NEAR(penetration(x, distance), 0.01 + std::max(0.0, beyond - gap), 1e-12) << x;
    }
  }
}

// The force is the gradient of the stored energy where thickness changes too: both laws, against central differences; and a lap around
// the change gets back the work that it gave.
TEST(AutomaticGap, force_is_the_gradient_where_thickness_changes) {
  for (const Law law : {Law::constant, Law::stiffening}) {
    Host host;
    const std::vector<Facet> facets = grid(host, 6, 3, 0, 60, -15, 15, [](double x, double y) { return 0.002 * x * y; });
    const Index n = host.add({25, 3, 20}, 0.0);
    Interface made = Interface::nodes_to_surface({n}, {3.0}, Surface(facets), automatic(law));
    std::vector<double> t, k(facets.size(), 10.0);
    for (std::size_t f = 0; f < facets.size(); ++f) t.push_back(1.0 + 0.7 * static_cast<double>(f % 6) + 0.4 * static_cast<double>(f / 6));
    const std::vector<double> own{1.0};
    made.set_surface(1, {k, t, {}, {}});
    made.set_surface(0, {{}, own, {}, {}});
    const auto at = [&](const Vec3& x) {
      std::vector<Vec3> all = host.x;
      all[static_cast<std::size_t>(n)] = x;
      return host.place(made, all);
    };
    at({25, 3, 20});
    for (const Vec3& x : {Vec3{25, 3, 1.3}, Vec3{33, -2, 1.9}, Vec3{41, 7, 2.6}}) {
      Vec3 gradient{};
      constexpr double d = 1e-5;
      for (int cycle = 0; cycle < 3; ++cycle) at(x);  // behind the first force: the law's own, its potential
      for (int c = 0; c < 3; ++c) {
        Vec3 step{};
        step[c] = d;
        at(x + step);
        at(x + step);
        const double up = host.last.elastic;
        at(x - step);
        at(x - step);
        gradient[c] = (up - host.last.elastic) / (2.0 * d);
      }
      at(x);
      at(x);
      const Vec3 f = host.f[static_cast<std::size_t>(n)];
      EXPECT_GT(norm(f), 0.01);
      EXPECT_NEAR(norm(f + gradient), 0.0, 1e-5 * norm(f)) << (law == Law::constant) << " at " << x.x;
      EXPECT_GT(std::abs(f.x), 0.01 * norm(f));  // it turns with the outer face
    }
    double work = 0.0, largest = 0.0;
    Vec3 last = host.f[static_cast<std::size_t>(n)];
    constexpr int steps = 4000;
    const auto path = [](int s) {
      const double a = 2.0 * 3.14159265358979323846 * s / steps;
      return Vec3{30 + 14 * std::cos(a), 6 * std::sin(a), 1.4 + 0.3 * std::sin(2 * a)};
    };
    at(path(0));
    at(path(0));
    last = host.f[static_cast<std::size_t>(n)];
    for (int s = 1; s <= steps; ++s) {
      at(path(s));
      const Vec3 f = host.f[static_cast<std::size_t>(n)];
      work += dot(0.5 * (last + f), path(s) - path(s - 1));
      last = f;
      largest = std::max(largest, host.last.elastic);
    }
    EXPECT_LE(std::abs(work), 1e-3 * largest);
    std::printf("  net work of a lap over the largest CE %.1e\n", work / largest);
  }
}

// A sheet of 6 x 6 facets over [-2.5, 2.5]^2, folded along x = 0, thicker on its right half and less so on its far one: over an inward
// fold a node goes from a facet of one gap to one of another at once. Laps low enough to touch both halves, and only the thick one, get
// back the work that they gave: to 1e-3 of the largest CE, with finer steps where what trapezoidal work misses of a force that jumps at
// the fold is more (path.bound).
/// @param heights  over the larger gap
void walk_over_folds(const std::vector<double>& ratios, const std::vector<double>& heights) {
  struct Fold {
    double angle;
    bool convex;  // seen from in front; behind, it is the inward one
  };
  double worst = 0.0;
  int laps = 0, repeated = 0;
  for (const Fold fold : {Fold{10, false}, Fold{45, false}, Fold{90, false}, Fold{45, true}}) {
    for (const double ratio : ratios) {
      for (const Law law : {Law::constant, Law::stiffening}) {
        for (const double height : heights) {
          Host host;
          const auto form = [fold](double x, double) { return test::fold_height(x, fold.angle, fold.convex); };
          const std::vector<Facet> facets = grid(host, 6, 6, -2.5, 2.5, -2.5, 2.5, form);
          std::vector<double> thickness, stiffness;
          for (std::size_t f = 0; f < facets.size(); ++f) {
            thickness.push_back((f % 6 < 3 ? 0.25 : 0.25 * ratio) * (f < 18 ? 1.0 : 1.3));
            stiffness.push_back(law == Law::stiffening && f % 6 < 3 ? 4.0 : 1.0);
          }
          const double above = height * 0.125 * std::max(1.0, ratio);
          const auto where = [&](double u) {
            const double a = 0.4 + 0.75 * std::acos(-1.0) * std::clamp((u - 0.15) / 0.7, 0.0, 1.0);
            const double x = 0.1 + 1.2 * std::cos(a), y = 0.05 + 0.9 * std::sin(a);
            const double lift = u < 0.15 ? 1.0 - u / 0.15 : u > 0.85 ? (u - 0.85) / 0.15 : 0.0;
            return Vec3{x, y, form(x, y) + above + 0.01 * std::sin(5.0 * u) + 2.0 * lift};
          };
          Rules rules = Rules::standard();
          rules.law = law;
          double net = 0.0;
          for (const int steps : {20000, 160000}) {
            const test::Path path = test::lap(rules, 0.0, facets, stiffness, host, where, steps, thickness);
            EXPECT_GT(path.largest, 0.0);
            EXPECT_LE(path.net, path.bound);
            net = path.net / path.largest;
            if (net <= 1e-3) break;
            if (steps == 20000) ++repeated;
          }
          ++laps;
          worst = std::max(worst, net);
          EXPECT_LE(net, 1e-3) << fold.angle << " degrees, ratio " << ratio << ", height " << height << ", stiffening "
                               << (law == Law::stiffening);
        }
      }
    }
  }
  std::printf("  %d laps, %d with finer steps: net work over the largest CE, worst %.1e\n", laps, repeated, worst);
}

TEST(AutomaticGap, laps_over_inward_folds_give_their_work_back) { walk_over_folds({2.0}, {0.25, 0.8}); }

TEST(AutomaticGapFull, laps_over_inward_folds_give_their_work_back) {
  walk_over_folds({0.3, 0.8, 2.0, 3.0, 6.0}, {-0.15, 0.1, 0.25, 0.45, 0.65, 0.8, 0.9});
}

// Free nodes fly at inward folds of a thin and a thick half and leave with the kinetic energy that they came with, also those that the
// thick half alone holds while the thin one is nearer. What is missed is the force that jumps at the fold: it falls with the step.
double worst_of_shots(double h) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  double worst = 0.0, mean = 0.0;
  int left = 0;
  for (const double angle : {10.0, 45.0, 90.0}) {
    for (const Law law : {Law::constant, Law::stiffening}) {
      Host host;
      const auto form = [angle](double x, double) { return test::fold_height(x, angle, false); };
      const std::vector<Facet> facets = grid(host, 6, 6, -3, 3, -3, 3, form);
      std::vector<double> thickness, stiffness;
      for (std::size_t f = 0; f < facets.size(); ++f) {
        thickness.push_back(f % 6 < 3 ? 0.2 : 0.5);
        stiffness.push_back(f % 6 < 3 ? 0.04 : 0.02);
      }
      const std::size_t first = host.x.size();
      std::vector<Index> nodes;
      std::vector<double> came;
      for (int shot = 0; shot < 100; ++shot) {
        const double speed = 0.1 * std::pow(10.0, u(random) - 1.5);
        const Vec3 direction = normalized({u(random) - 0.5, u(random) - 0.5, -1.0});
        const Vec3 aim{0.8 * u(random) - 0.4, u(random) - 0.5, 0.6};
        nodes.push_back(host.add({aim.x, aim.y, aim.z + form(aim.x, aim.y)}, 1.0, speed * direction));
        came.push_back(squared_norm(host.v.back()));
      }
      Options o = automatic(law);
      o.stiffness_scale = 1.0;
      Interface made = Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 0.04), Surface(facets), o);
      made.set_surface(1, {stiffness, thickness, {}});
      std::vector<char> touched(nodes.size(), 0);
      for (int step = 0; step < 300.0 / h; ++step) {
        host.step(made, h);
        std::vector<char> touches(host.x.size(), 0);
        for (const Index n : made.nodes_in_contact()) touches[static_cast<std::size_t>(n)] = 1;
        for (std::size_t s = 0; s < nodes.size(); ++s) {
          const bool over = std::max(std::abs(host.x[first + s].x), std::abs(host.x[first + s].y)) < 2.9;
          if (touched[s] == 1 && touches[first + s] == 0 && over) {
            const double error = std::abs(squared_norm(host.v[first + s]) / came[s] - 1.0);
            worst = std::max(worst, error);
            mean += error;
            ++left;
          }
          touched[s] = touches[first + s];
        }
      }
    }
  }
  std::printf("  h^2 K/m %.1e: kinetic energy after %d contacts off by %.1e in the mean, %.1e at worst\n", 0.02 * h * h, left, mean / left,
              worst);
  EXPECT_GT(left, 500);
  EXPECT_LE(mean / left, 2e-3);
  return worst;
}

TEST(AutomaticGap, shots_at_inward_folds_keep_their_energy) {
  const double coarse = worst_of_shots(1.0), fine = worst_of_shots(0.125);
  EXPECT_LE(coarse, 0.15);
  EXPECT_LE(fine, 0.02);
}

TEST(AutomaticGap, needs_closest_points) {
  Host host;
  const std::vector<Facet> facets = grid(host, 1, 1, 0, 1, 0, 1, flat);
  Options o = automatic();
  o.rules = Rules::reference();
  EXPECT_THROW(Interface::nodes_to_surface({host.add({0, 0, 1})}, {}, Surface(facets), o), std::invalid_argument);
}

}  // namespace
}  // namespace abut::contact
