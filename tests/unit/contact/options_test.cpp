// Options of one-sided interfaces: friction laws and filters, damping, initial penetrations (numerics.md 7.2.5, 7.4.5).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "contact/enforce/coefficient.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

TEST(FrictionLaw, exponential_is_libm_to_rounding) {
  double worst = 0.0;
  for (double x = -60.0; x <= 60.0; x += 0.0137) worst = std::max(worst, std::abs(exponential(x) / std::exp(x) - 1.0));
  EXPECT_LT(worst, 5e-16);
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_GT(exponential(-1e9), 0.0);
  EXPECT_TRUE(std::isfinite(exponential(1e9)));
  std::printf("  worst relative error %.1e\n", worst);
}

// The published forms [Radioss Reference Guide, /INTER/TYPE5, Ifric; TYPE7 for the exponential].
TEST(FrictionLaw, closed_forms) {
  const double f = 0.2, p = 3.0, v = 0.7;
  const std::array<double, 6> c{0.11, -0.3, 0.02, 0.004, 0.05, -0.8};
  using M = FrictionLaw::Model;
  EXPECT_DOUBLE_EQ(friction_coefficient({M::coulomb, c}, f, p, v), 0.2);
  EXPECT_NEAR(friction_coefficient({M::polynomial, c}, f, p, v), f + c[0] * p + c[1] * v + c[2] * p * v + c[3] * p * p + c[4] * v * v,
              1e-15);
  EXPECT_NEAR(friction_coefficient({M::darmstadt, c}, f, p, v),
              f + c[0] * std::exp(c[1] * v) * p * p + c[2] * std::exp(c[3] * v) * p + c[4] * std::exp(c[5] * v), 1e-14);
  EXPECT_NEAR(friction_coefficient({M::exponential, {0.4, 1.3}}, f, p, v), 0.4 + (f - 0.4) * std::exp(-1.3 * v), 1e-15);
  // A coefficient below zero would drive the motion.
  EXPECT_EQ(friction_coefficient({M::polynomial, {0, -10, 0, 0, 0, 0}}, f, p, v), 0.0);
}

// Renard: C1 at rest, C3 at C5, C4 at C6, C2 far away; the first two branches are continuous with their neighbours.
TEST(FrictionLaw, renard_goes_through_its_points) {
  const FrictionLaw law{FrictionLaw::Model::renard, {0.3, 0.25, 0.4, 0.1, 0.5, 2.0}};
  const auto mu = [&](double v) { return friction_coefficient(law, 0.0, 1.0, v); };
  EXPECT_DOUBLE_EQ(mu(0.0), 0.3);
  EXPECT_NEAR(mu(0.5), 0.4, 1e-15);
  EXPECT_NEAR(mu(0.25), 0.3 + 0.1 * 0.75, 1e-15);
  EXPECT_NEAR(mu(2.0), 0.1, 1e-15);
  EXPECT_NEAR(mu(5.0), 0.25 - 1.0 / (1.0 / 0.15 + 9.0), 1e-15);
  EXPECT_NEAR(mu(1e6), 0.25, 1e-9);
  for (const double v : {0.5, 2.0}) EXPECT_NEAR(mu(v - 1e-9), mu(v + 1e-9), 1e-8);
}

struct Slide {
  Host host;
  std::vector<Facet> facets = grid(host, 4, 1, 0, 40, -5, 5, flat);
  Index n = host.add({2, 0, -0.1}, 0.0);
  Interface make(const Options& o, double k = 10.0) {
    Interface i = Interface::nodes_to_surface({n}, {}, Surface(facets), o);
    set_stiffness(i, 1, facets.size(), k);
    return i;
  }
  StepResult slide(Interface& i, double by, double h) {
    std::vector<Vec3> x = host.x;
    x[static_cast<std::size_t>(n)].x += by;
    return host.place(i, x, h);
  }
};

// TYPE5: the limit is mu(P, v) f_n with P the force over the facet's area and v the sliding speed, in both rule sets.
TEST(FrictionLaw, limits_the_force_of_a_pair) {
  for (const bool reference : {false, true}) {
    Slide s;
    Options o;
    o.stiffness_scale = 0.2;
    if (reference) o.rules = Rules::reference();
    o.friction_law = {FrictionLaw::Model::polynomial, {5.0, 0.3, 0, 0, 0, 0}};
    o.friction = 0.1;
    Interface i = s.make(o);
    const double fn = 0.5 * 0.2 * 10.0 * 0.1, area = 100.0;
    for (int step = 0; step < 60; ++step) s.slide(i, 0.1, 0.1);  // v = 1
    const double mu = 0.1 + 5.0 * fn / area + 0.3;
    EXPECT_NEAR(s.host.last.tangential_force.x, mu * fn, 1e-12 * mu * fn) << reference;
    EXPECT_NEAR(s.host.last.normal_force.z, -fn, 1e-14);
  }
}

// Filter of the trial force below the limit. Return mapping: F_n = a (F_(n-1) + k dg) + (1 - a) F_(n-1) = F_(n-1) + a k dg.
TEST(FrictionLaw, filter_of_the_trial_force) {
  Slide s;
  Options o;
  o.friction = 100.0;
  o.filter.share = 0.25;
  Interface i = s.make(o);
  s.slide(i, 0.0, 0.1);
  const double kt = 0.1 * 0.5 * 0.2 * 10.0;
  for (int step = 1; step <= 20; ++step) {
    s.slide(i, 0.01, 0.1);
    EXPECT_NEAR(s.host.last.tangential_force.x, 0.25 * kt * 0.01 * step, 1e-14);
  }
  // What the filter holds back is slip: the balance closes.
  EXPECT_GT(s.host.last.friction_work, 0.0);
  EXPECT_NEAR(s.host.last.made, 0.0, 1e-12 * s.host.last.friction_work);

  // Anchors (reference): F0 + k x is filtered: geometric approach to the spring's force.
  Slide r;
  o.rules = Rules::reference();
  Interface j = r.make(o);
  r.slide(j, 0.0, 0.1);
  double filtered = 0.0;
  for (int step = 1; step <= 20; ++step) {
    r.slide(j, 0.01, 0.1);
    filtered = 0.25 * kt * 0.01 * step + 0.75 * filtered;
    EXPECT_NEAR(r.host.last.tangential_force.x, filtered, 1e-14);
  }
}

// Initial::offset: nothing at the start, the same stiffness from there on, the gap comes back as the node moves out.
TEST(InitialPenetration, offset_starts_the_gap_at_what_is_there) {
  for (const Law law : {Law::constant, Law::stiffening}) {
    for (const Edges edges : {Edges::closest, Edges::plain}) {
      Host host;
      const auto facets = grid(host, 2, 2, -1, 1, -1, 1, flat);
      const Index n = host.add({0.3, 0.4, 0.06}, 1.0);
      Options o;
      o.gap = 0.1;
      o.rules.law = law;
      o.rules.edges = edges;
      o.rules.switch_correction = false;
      o.initial = Initial::offset;
      Interface i = Interface::nodes_to_surface({n}, {10.0}, Surface(facets), o);
      set_stiffness(i, 1, facets.size(), 10.0);
      const double k = 0.2 * 5.0;
      std::vector<Vec3> x = host.x;
      const auto force = [&](double z) {
        x[static_cast<std::size_t>(n)].z = z;
        host.place(i, x);
        return host.f[static_cast<std::size_t>(n)].z;
      };
      const auto expected = [&](double p) { return law == Law::constant ? k * p : k * 0.1 / (0.1 - p) * p; };
      EXPECT_EQ(force(0.06), 0.0);
      EXPECT_NEAR(force(0.05), expected(0.01), 1e-14);
      EXPECT_NEAR(force(0.06), 0.0, 1e-14);
      EXPECT_EQ(force(0.08), 0.0);  // 0.02 of the gap are back
      EXPECT_NEAR(force(0.07), expected(0.01), 1e-14);
      EXPECT_EQ(force(0.2), 0.0);
      EXPECT_NEAR(force(0.07), expected(0.03), 1e-14);
    }
  }
}

TEST(InitialPenetration, ignored_until_it_has_been_outside) {
  Host host;
  const auto facets = grid(host, 2, 2, -1, 1, -1, 1, flat);
  const Index n = host.add({0.3, 0.4, 0.06}, 1.0), other = host.add({-0.3, -0.4, 0.2}, 1.0);
  Options o;
  o.gap = 0.1;
  o.initial = Initial::ignore;
  o.rules.switch_correction = false;
  Interface i = Interface::nodes_to_surface({n, other}, {10.0, 10.0}, Surface(facets), o);
  set_stiffness(i, 1, facets.size(), 10.0);
  std::vector<Vec3> x = host.x;
  const auto place = [&](double z, double w) {
    x[static_cast<std::size_t>(n)].z = z;
    x[static_cast<std::size_t>(other)].z = w;
    host.place(i, x);
  };
  place(0.06, 0.2);
  place(0.01, 0.06);
  EXPECT_EQ(host.f[static_cast<std::size_t>(n)].z, 0.0);
  EXPECT_GT(host.f[static_cast<std::size_t>(other)].z, 0.0);  // came from outside: as ever
  place(0.12, 0.2);
  place(0.06, 0.2);
  EXPECT_GT(host.f[static_cast<std::size_t>(n)].z, 0.0);
}

// Inacti 3 and 4 of TYPE5 (7.2.5): onto the gap surface, by (1 + 1e-8) of what is missing, along the facet's normal; in the order of the
// nodes, each on what its predecessors left.
TEST(InitialPenetration, projections_of_nodes_and_of_segments) {
  Host host;
  const auto facets = grid(host, 2, 1, -2, 2, -1, 1, flat);
  const Index a = host.add({-1, 0, -0.03}, 1.0), b = host.add({1, 0, 0.04}, 1.0), c = host.add({1, 0.5, 0.2}, 1.0);
  Options o;
  o.gap = 0.1;
  Interface i = Interface::nodes_to_surface({a, b, c}, {1, 1, 1}, Surface(facets), o);
  set_stiffness(i, 1, facets.size(), 1.0);
  const auto moves = i.projections(host.x, false);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].node, a);
  EXPECT_NEAR(moves[0].by.z, 0.13 * (1 + 1e-8), 1e-15);
  EXPECT_EQ(moves[1].node, b);
  EXPECT_NEAR(moves[1].by.z, 0.06 * (1 + 1e-8), 1e-15);

  const auto back = i.projections(host.x, true);
  std::vector<Vec3> x = host.x;
  for (const Projection& m : back) {
    EXPECT_LT(m.node, a);
    x[static_cast<std::size_t>(m.node)] += m.by;
  }
  host.x = x;
  EXPECT_EQ(host.contact(i).in_contact, 0);
  // Node a comes first: its whole segment goes down by 0.13, the two shared corners too; node b then finds its segment tilted,
  // 0.065 lower under it than at the start: more than the 0.06 it asked for.
  for (const Projection& m : back) EXPECT_NEAR(m.by.z, x[static_cast<std::size_t>(m.node)].x < 0.5 ? -0.13 : 0.0, 2e-8);
}

// Viscosity: a bounce loses what DW says, never pulls, and more damping loses more.
TEST(Damping, takes_what_it_books) {
  double previous = 1.0;
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    for (const double gap : {0.0, 0.05}) {
      Host host;
      const auto facets = grid(host, 2, 2, -1, 1, -1, 1, flat);
      const Index n = host.add({0.3, 0.4, 0.1}, 1.0, {0, 0, -0.2});
      const auto node = static_cast<std::size_t>(n);
      Options o;
      o.gap = gap;
      o.damping = share;
      Interface i = Interface::nodes_to_surface({n}, {2000.0}, Surface(facets), o);
      set_stiffness(i, 1, facets.size(), 2000.0);
      double work = 0.0;
      for (int s = 0; s < 6000; ++s) {
        host.step(i, 2e-4);
        EXPECT_GE(host.f[node].z, 0.0);
        EXPECT_GE(host.last.damping_work, work);
        work = host.last.damping_work;
      }
      const double ke = 0.02, lost = ke - 0.5 * host.v[node].z * host.v[node].z;
      EXPECT_NEAR(lost, work, 2e-3 * ke);
      EXPECT_LT(std::abs(host.last.made), 2e-3 * ke);
      std::printf("  damping %.1f gap %.2f: restitution %.4f, CX/KE %.1e\n", share, gap, host.v[node].z / 0.2, host.last.made / ke);
      if (gap == 0.0 && share > 0.0) { EXPECT_LT(host.v[node].z / 0.2, previous); }
      if (gap == 0.0) previous = host.v[node].z / 0.2;
    }
  }
}

// A linear spring with a damper parts when the force ends: e = exp(-z/sqrt(1 - z^2) (pi - atan(2 z sqrt(1 - z^2)/(2 z^2 - 1))))
// [Schwager, Poeschel 2007, Granular Matter 9, 465], the force being cut at zero.
TEST(Damping, restitution_is_the_closed_form) {
  for (const double z : {0.05, 0.2, 0.4}) {
    Host host;
    const auto facets = grid(host, 2, 2, -1, 1, -1, 1, flat);
    const Index n = host.add({0.3, 0.4, 0.01}, 1.0, {0, 0, -0.2});
    const auto node = static_cast<std::size_t>(n);
    Options o;
    o.damping = z;
    Interface i = Interface::nodes_to_surface({n}, {200.0}, Surface(facets), o);
    set_stiffness(i, 1, facets.size(), 200.0);
    for (int s = 0; s < 20000; ++s) host.step(i, 5e-5);
    const double root = std::sqrt(1 - z * z);
    const double phase = std::atan2(2 * z * root, 1 - 2 * z * z);
    const double e = std::exp(-z / root * (3.14159265358979 - phase));
    EXPECT_NEAR(host.v[node].z / 0.2, e, 2e-3) << z;
  }
}

// The node of an eroded facet: held on by `node_active`, with the stiffness of all its facets (Idel < 0), or let go.
TEST(Erosion, nodes_can_outlive_their_facets) {
  Host host;
  const auto lower = grid(host, 1, 1, -1, 1, -1, 1, flat);
  const auto upper = grid(
      host, 1, 1, -0.5, 0.5, -0.5, 0.5, [](double, double) { return -0.01; }, false);
  const auto make = [&] {
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), {});
    set_stiffness(i, 0, 1, 4.0);
    set_stiffness(i, 1, 1, 4.0);
    return i;
  };
  const std::vector<std::uint8_t> eroded{0}, keep(4, 1), none(4, 0), whole{1};
  Interface a = make(), b = make(), c = make();
  EXPECT_EQ(host.contact(a).in_contact, 4);
  const double force = host.last.normal_force.z;
  a.set_surface(1, {{}, {}, eroded, {}});
  EXPECT_EQ(host.contact(a).in_contact, 0);
  b.set_surface(1, {{}, {}, eroded, keep});
  EXPECT_EQ(host.contact(b).in_contact, 4);
  EXPECT_DOUBLE_EQ(host.last.normal_force.z, force);
  c.set_surface(1, {{}, {}, whole, none});
  EXPECT_EQ(host.contact(c).in_contact, 0);
}

// Friction acts at the node and at the contact point, |d| apart, up to Gap mu |Fn|: its couple at the corners balances that moment.
TEST(FrictionCouple, leaves_a_pair_without_moment) {
  for (const double gap : {0.2, 0.02, 0.002}) {
    Host host;
    const auto facets = grid(
        host, 1, 1, -1, 1, -1, 1, [](double x, double y) { return 0.05 * x * y; }, true, false, 1.0);
    const Index n = host.add({0.3, -0.4, -0.006 + 0.5 * gap}, 1.0, {0.7, 0.2, 0.0});
    Options o;
    o.gap = gap;
    o.friction = 0.4;
    Interface i = Interface::nodes_to_surface({n}, {50.0}, Surface(facets), o);
    set_stiffness(i, 1, facets.size(), 50.0);
    host.dt = host.before = 1e-2;
    for (int step = 0; step < 3; ++step) host.contact(i);
    std::vector<Vec3> normal(5), tangential(5);
    i.add_nodal_forces(normal, tangential);
    Vec3 force{}, moment{}, of_friction{};
    for (std::size_t k = 0; k < 5; ++k) {
      force += normal[k] + tangential[k];
      moment += cross(host.x[k], normal[k] + tangential[k]);
      of_friction += cross(host.x[k], tangential[k]);
    }
    const double fn = norm(normal[4]), ft = norm(tangential[4]);
    ASSERT_GT(ft, 0.0);
    EXPECT_NEAR(norm(of_friction), (gap - host.last.largest_penetration) * ft, 1e-12 * ft);
    EXPECT_LT(norm(force), 1e-15 * fn);
    EXPECT_LT(norm(moment), 2e-15 * fn);
  }
}

}  // namespace
}  // namespace abut::contact
