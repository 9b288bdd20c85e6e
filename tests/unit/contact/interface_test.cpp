// Forces, friction, energies of one-sided interfaces through the public API.
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

struct OneNode {
  Host host;
  Interface interface;
  Index node;
};

// One node against a 3 x 3 surface of unit facets around the origin, own stiffness as large as one wants.
OneNode one_node(Vec3 at, Options options, double facet_k = 42.0, double node_k = 42.0) {
  Host host;
  auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
  const Index node = host.add(at, 1.0);
  const std::size_t count = facets.size();
  Interface interface = Interface::nodes_to_surface({node}, {node_k}, Surface(std::move(facets)), options);
  set_stiffness(interface, 1, count, facet_k);
  return {std::move(host), std::move(interface), node};
}

Options with(Rules rules, double gap = 0.0, double friction = 0.0, double scale = 0.2) {
  Options o;
  o.rules = rules;
  o.gap = gap;
  o.friction = friction;
  o.stiffness_scale = scale;
  return o;
}

// T13, T14, T16: s K1 K2/(K1 + K2), for equal sides 0.5 s E t.
TEST(PairStiffness, series_of_both_sides) {
  auto b = one_node({0.1, -0.2, -0.01}, with(Rules::standard()));
  b.host.contact(b.interface);
  EXPECT_NEAR(b.host.f[static_cast<std::size_t>(b.node)].z, 0.5 * 0.2 * 42.0 * 0.01, 1e-15);
  auto c = one_node({0.1, -0.2, -0.01}, with(Rules::standard()), 42.0, 10.5);
  c.host.contact(c.interface);
  EXPECT_NEAR(c.host.f[static_cast<std::size_t>(c.node)].z, 0.2 * 42.0 * 10.5 / 52.5 * 0.01, 1e-15);
}

// T15: K1 = K2/10 gives s/11 K2.
TEST(PairStiffness, soft_side_governs) {
  auto b = one_node({0.0, 0.0, -0.01}, with(Rules::standard()), 100.0, 10.0);
  b.host.contact(b.interface);
  EXPECT_NEAR(b.host.f[static_cast<std::size_t>(b.node)].z, 0.2 / 11.0 * 100.0 * 0.01, 1e-15);
}

// numerics.md 7.4.1: TYPE5 of the reference takes half of the facet's stiffness.
TEST(PairStiffness, reference_one_pass_takes_half) {
  auto b = one_node({0.0, 0.0, -0.01}, with(Rules::reference()), 100.0, 10.0);
  b.host.contact(b.interface);
  EXPECT_NEAR(b.host.f[static_cast<std::size_t>(b.node)].z, 0.5 * 0.2 * 100.0 * 0.01, 1e-15);
}

// T26, T27: the gap acts on the side of the normal only. T25: from Gap on.
TEST(Gap, is_one_sided_and_sharp) {
  for (const Rules& rules : {Rules::standard(), Rules::reference()}) {
    auto near = one_node({0.0, 0.0, 0.0499}, with(rules, 0.05));
    near.host.contact(near.interface);
    EXPECT_GT(near.host.f[static_cast<std::size_t>(near.node)].z, 0.0);
    auto far = one_node({0.0, 0.0, 0.0501}, with(rules, 0.05));
    far.host.contact(far.interface);
    EXPECT_EQ(far.host.f[static_cast<std::size_t>(far.node)].z, 0.0);
  }
  // Deep behind: not met by the standard rule, pushed without limit by the reference.
  auto standard = one_node({0.0, 0.0, -0.8}, with(Rules::standard(), 0.05));
  EXPECT_EQ(standard.host.contact(standard.interface).in_contact, 0);
  auto reference = one_node({0.0, 0.0, -0.8}, with(Rules::reference(), 0.05));
  EXPECT_EQ(reference.host.contact(reference.interface).in_contact, 1);
  EXPECT_NEAR(reference.host.f[static_cast<std::size_t>(reference.node)].z, 0.5 * 0.2 * 42.0 * 0.85, 1e-13);
}

// T8: zero gap means zero.
TEST(Gap, zero_is_zero) {
  for (const Rules& rules : {Rules::standard(), Rules::reference()}) {
    auto front = one_node({0.2, 0.1, 1e-12}, with(rules));
    EXPECT_EQ(front.host.contact(front.interface).in_contact, 0);
    auto behind = one_node({0.2, 0.1, -1e-12}, with(rules));
    EXPECT_EQ(behind.host.contact(behind.interface).in_contact, 1);
  }
}

// T24: F = K Gap/(Gap - P) P.
TEST(Force, stiffening_law) {
  auto b = one_node({0.0, 0.0, 0.02}, with(Rules::standard(), 0.05));
  b.host.contact(b.interface);
  EXPECT_NEAR(b.host.f[static_cast<std::size_t>(b.node)].z, 4.2 * 0.05 / 0.02 * 0.03, 1e-14);
}

// numerics.md 9.6: edge tolerance of the plain rule.
TEST(PlainRule, edge_tolerance) {
  const auto touches = [](double x, double gap) {
    Host host;
    auto facets = grid(host, 1, 1, -0.5, 0.5, -0.5, 0.5, flat);
    const Index node = host.add({x, 0.0, -0.01}, 1.0);
    Interface i = Interface::nodes_to_surface({node}, {1.0}, Surface(std::move(facets)), with(Rules::reference(), gap));
    set_stiffness(i, 1, 1, 1.0);
    return host.contact(i).in_contact;
  };
  EXPECT_EQ(touches(0.524, 0.0), 1);
  EXPECT_EQ(touches(0.53, 0.0), 0);
  EXPECT_EQ(touches(0.53, 0.05), 1);
  EXPECT_EQ(touches(0.56, 0.05), 0);
}

// numerics.md 9.8: contact time, deepest penetration and impulse of one node on a rigid segment.
TEST(Force, single_node_bounces_in_half_a_period) {
  auto b = one_node({0.0, 0.0, 0.0}, with(Rules::standard()));
  const double k = 4.2;
  const auto n = static_cast<std::size_t>(b.node);
  b.host.v[n] = {0.0, 0.0, -0.01};
  const double h = 0.002;
  double deepest = 0.0, impulse = 0.0, ends = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const StepResult r = b.host.step(b.interface, h);
    deepest = std::max(deepest, r.largest_penetration);
    impulse += r.normal_force.z * h;
    if (r.in_contact > 0) ends = b.host.time;
  }
  EXPECT_NEAR(ends, std::acos(-1.0) * std::sqrt(1.0 / k), 2 * h);
  EXPECT_NEAR(deepest, 0.01 * std::sqrt(1.0 / k), 1e-7);
  EXPECT_NEAR(impulse, -0.02, 1e-6);
}

// T21, T22, numerics.md 9.9: a spring of K/10 up to mu Fn, then slip, and back with an elastic unloading.
TEST(Friction, sticks_slips_and_returns) {
  const double p = 0.01, k = 4.2, mu = 0.3;
  auto b = one_node({0.0, 0.0, -p}, with(Rules::standard(), 0.0, mu));
  const auto n = static_cast<std::size_t>(b.node);
  b.host.contact(b.interface);
  const double slip_at = 10.0 * mu * p;
  std::vector<Vec3> where = b.host.x;
  double largest = 0.0;
  for (int i = 1; i <= 40; ++i) {
    where[n].x = i * 0.002;
    b.host.place(b.interface, where);
    const double expected = std::min(0.1 * k * where[n].x, mu * k * p);
    EXPECT_NEAR(b.host.f[n].x, -expected, 1e-14) << i;
    EXPECT_NEAR(b.host.last.elastic, 0.5 * k * p * p + 0.5 * expected * expected / (0.1 * k), 1e-15);
    largest = std::max(largest, b.host.last.friction_work);
  }
  EXPECT_NEAR(largest, mu * k * p * (0.08 - slip_at), 1e-15);
  for (int i = 39; i >= 20; --i) {
    where[n].x = i * 0.002;
    b.host.place(b.interface, where);
    const double expected = std::max(mu * k * p - 0.1 * k * (0.08 - where[n].x), -mu * k * p);
    EXPECT_NEAR(b.host.f[n].x, -expected, 1e-14) << i;
  }
  EXPECT_NEAR(b.host.last.made, 0.0, 1e-16);
}

// The reference's slip test and first cycle (numerics.md 7.4.3): no friction in the cycle in which contact begins.
TEST(Friction, reference_rule_starts_one_cycle_late) {
  const double mu = 0.3;
  auto b = one_node({0.0, 0.0, 0.01}, with(Rules::reference(), 0.0, mu));
  const auto n = static_cast<std::size_t>(b.node);
  b.host.contact(b.interface);
  std::vector<Vec3> where = b.host.x;
  where[n] = {0.05, 0.0, -0.01};
  b.host.place(b.interface, where);
  EXPECT_EQ(b.host.f[n].x, 0.0);
  where[n] = {0.10, 0.0, -0.01};
  b.host.place(b.interface, where);
  EXPECT_NEAR(b.host.f[n].x, -mu * 4.2 * 0.01, 1e-15);

  auto s = one_node({0.0, 0.0, 0.01}, with(Rules::standard(), 0.0, mu));
  s.host.contact(s.interface);
  where[n] = {0.05, 0.0, -0.01};
  s.host.place(s.interface, where);
  EXPECT_LT(s.host.f[n].x, 0.0);  // ours acts from the first step
}

// numerics.md 7.2.5: nodes that touch at the start rub from the first cycle.
TEST(Friction, reference_rule_anchors_initial_contacts) {
  auto b = one_node({0.0, 0.0, -0.01}, with(Rules::reference(), 0.0, 0.3));
  const auto n = static_cast<std::size_t>(b.node);
  b.host.contact(b.interface);
  std::vector<Vec3> where = b.host.x;
  where[n].x = 0.001;
  b.host.place(b.interface, where);
  EXPECT_NEAR(b.host.f[n].x, -0.1 * 4.2 * 0.001, 1e-15);
}

// Ptlim: the friction stress is capped by shear_limit times the area.
TEST(Friction, shear_limit_caps) {
  Options o = with(Rules::standard(), 0.0, 0.5);
  o.shear_limit = 0.002;
  auto b = one_node({0.0, 0.0, -0.01}, o);
  const auto n = static_cast<std::size_t>(b.node);
  b.host.contact(b.interface);
  std::vector<Vec3> where = b.host.x;
  where[n].x = 0.3;
  b.host.place(b.interface, where);
  EXPECT_NEAR(b.host.f[n].x, -0.002, 1e-15);
}

struct TwoPlates {
  Host host;
  std::vector<Facet> lower, upper;
};

TwoPlates two_plates(double overlap, unsigned seed, bool triangles = false) {
  TwoPlates p;
  const auto noise = [seed](double x, double y) { return 0.01 * std::sin(13.0 * x + 7.0 * y + seed); };
  p.lower = grid(p.host, 7, 6, 0.0, 1.4, 0.0, 1.2, noise, true, false, 1.0);
  p.upper = grid(
      p.host, 5, 5, 0.13, 1.25, 0.07, 1.1, [&](double x, double y) { return noise(y, x) - overlap; }, false, triangles, 1.0);
  for (std::size_t i = 0; i < p.host.x.size(); ++i) {
    p.host.v[i] = {0.3 * std::sin(3.0 * static_cast<double>(i)), 0.2 * std::cos(5.0 * static_cast<double>(i)),
                   0.1 * std::sin(static_cast<double>(i))};
  }
  return p;
}

// T2, T10: swapping the two surfaces gives the same forces bit for bit.
TEST(TwoSurfaces, swapping_changes_no_bit) {
  for (const bool triangles : {false, true}) {
    for (Rules rules : {Rules::standard(), Rules::reference()}) {
      for (const double gap : {0.0, 0.02}) {
        TwoPlates p = two_plates(0.005, 3, triangles);
        Host other = p.host;
        Interface a = Interface::two_surfaces(Surface(p.lower), Surface(p.upper), with(rules, gap, 0.2));
        Interface b = Interface::two_surfaces(Surface(p.upper), Surface(p.lower), with(rules, gap, 0.2));
        set_stiffness(a, 0, p.lower.size(), 10.0);
        set_stiffness(a, 1, p.upper.size(), 25.0);
        set_stiffness(b, 1, p.lower.size(), 10.0);
        set_stiffness(b, 0, p.upper.size(), 25.0);
        for (int i = 0; i < 30; ++i) {
          p.host.step(a, 0.01);
          other.step(b, 0.01);
          ASSERT_GT(p.host.last.in_contact, 0);
          ASSERT_EQ(p.host.last.elastic, other.last.elastic);
          ASSERT_EQ(p.host.last.made, other.last.made);
          ASSERT_EQ(p.host.last.normal_force, -other.last.normal_force);
          for (std::size_t n = 0; n < p.host.x.size(); ++n) {
            ASSERT_EQ(p.host.f[n], other.f[n]);
            ASSERT_EQ(p.host.k[n], other.k[n]);
          }
        }
      }
    }
  }
}

// Standard rules: the order in which facets are listed changes no bit.
TEST(TwoSurfaces, listing_order_changes_no_bit) {
  TwoPlates p = two_plates(0.005, 5);
  Host other = p.host;
  std::vector<Facet> shuffled(p.lower.rbegin(), p.lower.rend());
  Interface a = Interface::two_surfaces(Surface(p.lower), Surface(p.upper), with(Rules::standard(), 0.02, 0.2));
  Interface b = Interface::two_surfaces(Surface(shuffled), Surface(p.upper), with(Rules::standard(), 0.02, 0.2));
  std::vector<double> k(p.lower.size());
  for (std::size_t i = 0; i < k.size(); ++i) k[i] = 5.0 + static_cast<double>(i % 4);
  std::vector<double> reversed(k.rbegin(), k.rend());
  a.set_surface(0, {k, {}, {}});
  b.set_surface(0, {reversed, {}, {}});
  set_stiffness(a, 1, p.upper.size(), 25.0);
  set_stiffness(b, 1, p.upper.size(), 25.0);
  for (int i = 0; i < 30; ++i) {
    p.host.step(a, 0.01);
    other.step(b, 0.01);
    for (std::size_t n = 0; n < p.host.x.size(); ++n) ASSERT_EQ(p.host.f[n], other.f[n]);
  }
}

// Momentum: the forces of an interface sum to zero; without friction their moments do too.
TEST(TwoSurfaces, forces_and_moments_balance) {
  for (const double friction : {0.0, 0.3}) {
    for (Rules rules : {Rules::standard(), Rules::reference()}) {
      TwoPlates p = two_plates(0.005, 11);
      Interface a = Interface::two_surfaces(Surface(p.lower), Surface(p.upper), with(rules, 0.02, friction));
      std::vector<double> k(p.lower.size());
      for (std::size_t i = 0; i < k.size(); ++i) k[i] = 5.0 + 3.0 * static_cast<double>(i % 4);
      a.set_surface(0, {k, {}, {}});
      set_stiffness(a, 1, p.upper.size(), 25.0);
      for (int i = 0; i < 20; ++i) {
        p.host.contact(a);
        Vec3 sum{}, moment{};
        double size = 0.0;
        for (std::size_t n = 0; n < p.host.x.size(); ++n) {
          sum += p.host.f[n];
          moment += cross(p.host.x[n], p.host.f[n]);
          size += norm(p.host.f[n]);
        }
        ASSERT_GT(size, 0.0);
        EXPECT_LT(norm(sum), 1e-13 * size);
        if (friction == 0.0 && rules.edges == Edges::closest) { EXPECT_LT(norm(moment), 1e-13 * size); }
        p.host.step(a, 0.01);
      }
    }
  }
}

// T6: a node on both surfaces is refused, and named.
TEST(TwoSurfaces, shared_nodes_are_refused) {
  Host host;
  auto facets = grid(host, 2, 1, 0.0, 2.0, 0.0, 1.0, flat);
  try {
    (void)Interface::two_surfaces(Surface({facets[0]}), Surface({facets[1]}), {});
    FAIL();
  } catch (const std::invalid_argument& e) { EXPECT_STREQ(e.what(), "contact: 2 nodes lie on both surfaces: 1, 4"); }
}

// A thickness limits the depth at which a node is still held (pass.cpp): one that is no length is refused.
TEST(TwoSurfaces, a_thickness_that_is_no_length_is_refused) {
  Host host;
  const auto low = grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat);
  const auto high = grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat);
  Interface i = Interface::two_surfaces(Surface(low), Surface(high), {});
  for (const double bad : {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const std::vector<double> thickness{bad};
    EXPECT_THROW(i.set_surface(0, {.thickness = thickness}), std::invalid_argument) << bad;
  }
  const std::vector<double> none{0.0};
  EXPECT_NO_THROW(i.set_surface(0, {.thickness = none}));
}

// A history blob taken in the middle of a run continues it bit for bit; damaged ones are refused.
TEST(History, resumes_bit_for_bit) {
  for (Rules rules : {Rules::standard(), Rules::reference()}) {
    TwoPlates p = two_plates(0.005, 7);
    const auto make = [&] {
      Interface a = Interface::two_surfaces(Surface(p.lower), Surface(p.upper), with(rules, 0.02, 0.2));
      set_stiffness(a, 0, p.lower.size(), 10.0);
      set_stiffness(a, 1, p.upper.size(), 25.0);
      return a;
    };
    Interface a = make();
    for (int i = 0; i < 20; ++i) p.host.step(a, 0.01);
    std::vector<std::byte> blob = a.history();
    Host host = p.host;
    Interface b = make();
    b.restore(blob);
    for (int i = 0; i < 20; ++i) {
      p.host.step(a, 0.01);
      host.step(b, 0.01);
      ASSERT_EQ(host.last.made, p.host.last.made);
      for (std::size_t n = 0; n < host.x.size(); ++n) ASSERT_EQ(p.host.f[n], host.f[n]);
    }
    blob[blob.size() / 2] ^= std::byte{1};
    EXPECT_THROW(b.restore(blob), std::invalid_argument);
    EXPECT_THROW(b.restore(std::span(blob).first(10)), std::invalid_argument);
  }
}

// Birth and death; eroded facets do not hold, nodes without live facets are let go.
TEST(Activity, birth_death_and_erosion) {
  Options o = with(Rules::standard());
  o.birth = 1.0;
  o.death = 2.0;
  auto b = one_node({0.0, 0.0, -0.01}, o);
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 0);
  b.host.time = 1.5;
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 1);
  b.host.time = 2.5;
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 0);
  b.host.time = 1.7;
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 1);
  std::vector<std::uint8_t> active(9, 1);
  active[4] = 0;
  b.interface.set_surface(1, {{}, {}, active});
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 0);
  active[4] = 1;
  b.interface.set_surface(1, {{}, {}, active});
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 1);
  const std::vector<std::uint8_t> nobody(1, 0);
  b.interface.set_surface(0, {{}, {}, nobody});
  EXPECT_EQ(b.host.contact(b.interface).in_contact, 0);
}

// Whoever hands out the loops: ranges in any order, empty ones among them, on threads or not, give the bits of one thread.
TEST(Executors, hand_out_ranges_as_they_like) {
  using Body = std::function<void(std::size_t, std::size_t)>;
  const auto backwards = [](std::size_t count, const Body& body) {
    body(0, 0);
    for (std::size_t end = count; end > 0;) {
      const std::size_t begin = end > 2 ? end - 2 : 0;
      body(begin, end);
      body(0, 0);
      end = begin;
    }
  };
  const auto threads = [](std::size_t count, const Body& body) {
    std::vector<std::thread> all;
    for (std::size_t t = 0; t < 3; ++t) all.emplace_back([=, &body] { body(count * t / 3, count * (t + 1) / 3); });
    for (std::thread& one : all) one.join();
  };
  std::vector<std::vector<Vec3>> forces;
  for (const Executor& executor : {Executor{}, Executor{backwards}, Executor{threads}}) {
    Host host;
    const auto wave = [](double x, double y) { return 0.02 * x * x - 0.03 * x * y; };
    auto lower = grid(host, 40, 40, -2, 2, -2, 2, wave);
    auto upper = grid(
        host, 33, 33, -1.6, 1.7, -1.5, 1.8, [&](double x, double y) { return wave(x, y) + 0.09; }, false, false, 1.0);
    const std::size_t counts[] = {lower.size(), upper.size()};
    Interface i = Interface::two_surfaces(Surface(std::move(lower)), Surface(std::move(upper)), with(Rules::standard(), 0.1, 0.2));
    for (const int side : {0, 1}) set_stiffness(i, side, counts[side], 50.0);
    if (executor) i.set_executor(executor);
    for (std::size_t n = 41 * 41; n < host.x.size(); ++n) host.v[n] = {0.5, 0.2, -0.3};
    forces.emplace_back();
    for (int step = 0; step < 40; ++step) {
      host.step(i, 0.01);
      forces.back().insert(forces.back().end(), host.f.begin(), host.f.end());
    }
    EXPECT_GT(host.last.in_contact, 600);
  }
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(forces[0], forces[2]);
}

}  // namespace
}  // namespace abut::contact
