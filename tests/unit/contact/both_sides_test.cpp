// TYPE7: every node-facet pair within the gap repels on its own, on both sides (numerics.md 7.7).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "contact/enforce/both_sides_pair.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::Host;

const std::vector<Facet> one_triangle{{{0, 1, 2, 2}}};
const std::vector<Facet> one_quad{{{0, 1, 2, 3}}};

void add_triangle(Host& host, double mass = 1.0) {
  host.add({0, 0, 0}, mass);
  host.add({1.1, 0.1, 0}, mass);
  host.add({0.2, 0.9, 0.1}, mass);
}
void add_quad(Host& host, double mass = 1.0) {
  host.add({-1, -1, 0}, mass);
  host.add({1, -1, 0}, mass);
  host.add({1, 1, 0}, mass);
  host.add({-1, 1, 0}, mass);
}

Interface interface_of(Index node, const std::vector<Facet>& facets, const BothSidesOptions& o, double stiffness) {
  Interface i = Interface::both_sides({node}, Surface(facets), o);
  const std::vector<double> k(facets.size(), stiffness);
  i.set_surface(1, {k, {}, {}, {}});
  return i;
}

// The stored energy is a potential of the forces: over faces of triangles and quadrilaterals (flat, warped), beyond an edge, beyond a
// corner, on both sides.
TEST(BothSides, force_is_minus_the_gradient_of_the_stored_energy) {
  BothSidesOptions o;
  o.gap = 0.3;
  o.damping = 0.0;
  double worst = 0.0;
  for (const Vec3 at : {Vec3{0.4, 0.3, 0.15}, Vec3{0.4, 0.3, -0.1}, Vec3{0.5, -0.1, 0.1}, Vec3{-0.1, -0.1, 0.1}, Vec3{0.8, 0.6, -0.05}}) {
    for (const bool quad : {false, true}) {
      Host host;
      add_triangle(host);
      if (quad) host.x[2] = {0.9, 1.0, 0.1}, host.add({-0.1, 0.9, 0.0}, 1.0);
      const std::vector<Facet>& facet = quad ? one_quad : one_triangle;
      const Index n = host.add(at, 1.0);
      const auto energy = [&](const std::vector<Vec3>& x) {
        Host probe = host;
        probe.x = x;
        Interface i = interface_of(n, facet, o, 7.0);
        return probe.contact(i).elastic;
      };
      Interface i = interface_of(n, facet, o, 7.0);
      ASSERT_EQ(host.contact(i).in_contact, 1);
      for (std::size_t c = 0; c < 3 * host.x.size(); ++c) {
        const double d = 1e-6;
        std::vector<Vec3> plus = host.x, minus = host.x;
        plus[c / 3][static_cast<int>(c % 3)] += d;
        minus[c / 3][static_cast<int>(c % 3)] -= d;
        const double slope = (energy(plus) - energy(minus)) / (2 * d);
        worst = std::max(worst, std::abs(slope + host.f[c / 3][static_cast<int>(c % 3)]));
        EXPECT_NEAR(-slope, host.f[c / 3][static_cast<int>(c % 3)], 2e-8) << "node " << c / 3;
      }
    }
  }
  std::printf("  worst difference %.1e\n", worst);
}

TEST(BothSides, both_sides_act_alike) {
  BothSidesOptions o;
  o.gap = 0.2;
  o.friction = 0.3;
  Host up, down;
  add_quad(up);
  add_quad(down);
  const Index n = up.add({0.3, 0.2, 0.1}, 0.5, {1, 2, -3});
  down.add({0.3, 0.2, -0.1}, 0.5, {1, 2, 3});
  Interface a = interface_of(n, one_quad, o, 5.0), b = interface_of(n, one_quad, o, 5.0);
  up.dt = down.dt = 1e-3;
  up.contact(a);
  down.contact(b);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_DOUBLE_EQ(up.f[k].x, down.f[k].x);
    EXPECT_DOUBLE_EQ(up.f[k].y, down.f[k].y);
    EXPECT_DOUBLE_EQ(up.f[k].z, -down.f[k].z);
  }
  EXPECT_GT(up.f[4].z, 0.0);
}

// Forces of a pair sum to zero whatever acts: normal, damping, friction, warped facets, corrected weights.
TEST(BothSides, keeps_momentum) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int touched = 0;
  for (int trial = 0; trial < 200; ++trial) {
    for (const auto form : {BothSidesOptions::Friction::viscous, BothSidesOptions::Friction::incremental}) {
      Host host;
      for (const Vec3 corner : {Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, 0}}) {
        host.add(corner + 0.3 * Vec3{u(random), u(random), u(random)}, 1.0, {u(random), u(random), u(random)});
      }
      const Index n = host.add({1.2 * u(random), 1.2 * u(random), 0.3 * u(random)}, 0.7, {u(random), u(random), u(random)});
      BothSidesOptions o;
      o.gap = 0.3;
      o.friction = 0.4;
      o.friction_form = form;
      o.all_pieces = trial % 2 == 0;
      Interface i = interface_of(n, one_quad, o, 3.0);
      host.dt = host.before = 1e-3;
      touched += host.contact(i).in_contact;
      Vec3 sum;
      double size = 0.0;
      for (const Vec3& f : host.f) {
        sum += f;
        size += norm(f);
      }
      EXPECT_LE(norm(sum), 1e-15 * size);
    }
  }
  EXPECT_GT(touched, 100);
}

// f_n = K0 g p/(g - p) and E = K0 g^2 (-p/g - ln(1 - p/g)) up to the pole, K0 half of K.
TEST(BothSides, law_is_the_closed_form) {
  const double k0 = 3.0, g = 0.5;
  for (const double u : {1e-9, 1e-3, 0.1, 0.5, 0.9, 0.99, 1 - 1e-6, 1 - 1e-9}) {
    const BothSidesForce f = both_sides_force(k0, g, u * g, 2.0, -0.4, 0.05);
    EXPECT_NEAR(f.elastic, k0 * u * g / (1 - u), 1e-6 * f.elastic);
    EXPECT_NEAR(f.energy, k0 * g * g * (-u - std::log1p(-u)), 1e-6 * f.energy);
    const double left = g - u * g;
    EXPECT_NEAR(f.critical, std::sqrt(2 * k0 * g / left * 2.0 * g / left), 1e-12 * f.critical);
    EXPECT_NEAR(f.damping, 0.05 * f.critical + 0.32 * 2.0 * 0.4 / left, 1e-12 * f.damping);
  }
}

// A node that bounces from a heavy facet: what damping takes is what kinetic energy has lost.
TEST(BothSides, damping_dissipates) {
  double previous = 1.0;
  for (const double damping : {0.0, 0.05, 0.3}) {
    Host host;
    add_quad(host, 1e9);
    const Index n = host.add({0.0, 0.0, 0.2}, 1.0, {0, 0, -0.3});
    BothSidesOptions o;
    o.gap = 0.15;
    o.damping = damping;
    Interface i = interface_of(n, one_quad, o, 100.0);
    double work = 0.0;
    for (int step = 0; step < 20000; ++step) {
      host.step(i, 1e-4);
      EXPECT_GE(host.last.damping_work, work);
      work = host.last.damping_work;
    }
    const double v = host.v[static_cast<std::size_t>(n)].z;
    const double lost = 0.5 * (0.09 - v * v);
    EXPECT_GT(v, 0.0);
    EXPECT_NEAR(lost, work, 2e-3 * 0.045);
    EXPECT_LT(std::abs(host.last.made), 2e-3 * 0.045);
    if (damping > 0.0) { EXPECT_LT(v / 0.3, previous); }
    std::printf("  damping %.2f: restitution %.4f, CX/KE %.1e\n", damping, v / 0.3, host.last.made / 0.045);
    previous = v / 0.3;
  }
}

// Iform 1: min(mu f_N, VIS_F C v) against the motion, no stick.
TEST(BothSides, viscous_friction_is_the_closed_form) {
  for (const double speed : {1e-4, 0.5}) {
    Host host;
    add_quad(host, 0.0);
    const Index n = host.add({0, 0, 0.1}, 2.0, {speed, 0, 0});
    BothSidesOptions o;
    o.gap = 0.2;
    o.friction = 0.3;
    o.friction_viscosity = 0.8;
    Interface i = interface_of(n, one_quad, o, 10.0);
    host.contact(i);
    // Over the centre of a square all four triangles have their closest point there: p = 0.1.
    const double fn = 5.0 * 0.2 / 0.1 * 0.1, c = std::sqrt(2 * 5.0 * 2.0 * 2.0);
    EXPECT_NEAR(host.f[4].z, fn, 1e-14);
    EXPECT_NEAR(host.f[4].x, -std::min(0.3 * fn, 0.8 * c * speed), 1e-14);
  }
}

// Iform 2: F grows by K v h until mu f_N; its elastic part is stored, the rest is friction work; CX stays small.
TEST(BothSides, incremental_friction_sticks_then_slips) {
  Host host;
  add_quad(host, 0.0);
  const Index n = host.add({-0.2, 0, 0.1}, 0.0);
  BothSidesOptions o;
  o.gap = 0.2;
  o.friction = 0.25;
  o.friction_form = BothSidesOptions::Friction::incremental;
  o.friction_viscosity = 0.0;
  o.damping = 0.0;
  Interface i = interface_of(n, {{{0, 1, 2, 3}}}, o, 10.0);
  std::vector<Vec3> x = host.x;
  host.place(i, x, 0.1);
  double slid = 0.0, fw = 0.0;
  for (int step = 1; step <= 100; ++step) {
    x[4].x += 1e-3;
    slid += 1e-3;
    host.place(i, x, 0.1);
    const double limit = 0.25 * host.f[4].z;
    const double size = std::abs(host.last.tangential_force.x);
    if (slid < 0.02) { EXPECT_NEAR(size, 10.0 * slid, 0.02 * 10.0 * slid) << step; }
    if (slid > 0.05) { EXPECT_NEAR(size, limit, 1e-12 * limit) << step; }
    EXPECT_GE(host.last.friction_work, fw);
    fw = host.last.friction_work;
  }
  EXPECT_GT(fw, 0.0);
  EXPECT_NEAR(host.last.made, 0.0, 0.02 * fw);
}

// Ifiltr: F <- a F + (1 - a) F_old: after n cycles of constant sliding 1 - (1 - a)^n of the limit.
TEST(BothSides, filter_is_the_geometric_series) {
  Host host;
  add_quad(host, 0.0);
  host.add({0, 0, 0.1}, 2.0, {1e6, 0, 0});
  BothSidesOptions o;
  o.gap = 0.2;
  o.friction = 0.3;
  o.filter.share = 0.2;
  Interface i = interface_of(4, one_quad, o, 10.0);
  for (int n = 1; n <= 12; ++n) {
    host.contact(i);
    EXPECT_NEAR(-host.f[4].x, 0.3 * 10.0 * 0.1 * (1 - std::pow(0.8, n)), 1e-13);
  }
}

// Inacti 5 and 6: no force at the start; p0 <- min(p0, 0.95 p0 + 0.05 p) lets the gap grow back while the node moves out.
TEST(BothSides, initial_offset_relaxes) {
  for (const bool margin : {false, true}) {
    Host host;
    add_quad(host, 0.0);
    host.add({0, 0, 0.12}, 0.0);  // no mass: no damping
    BothSidesOptions o;
    o.gap = 0.2;
    o.switch_correction = false;  // the law's own force in every cycle
    o.initial = margin ? BothSidesOptions::Initial::offset_with_margin : BothSidesOptions::Initial::offset;
    Interface i = interface_of(4, one_quad, o, 10.0);
    std::vector<Vec3> x = host.x;
    host.place(i, x);
    EXPECT_EQ(norm(host.f[4]), 0.0);
    double p0 = 0.08 * (1 + 1e-8) + (margin ? 0.05 * 0.12 : 0.0);
    for (const double z : {0.15, 0.15, 0.15, 0.13, 0.11, 0.11, 0.09}) {
      x[4].z = z;
      host.place(i, x);
      const double p = 0.2 - z;
      p0 = std::min(p0, 0.95 * p0 + 0.05 * (p + (margin ? 0.05 * (0.2 - p) : 0.0)));
      const double left = std::max(0.0, p - p0), g = 0.2 - p0;
      EXPECT_NEAR(host.f[4].z, 5.0 * g / (g - left) * left, 1e-13) << z;
    }
    x[4].z = 0.3;  // left the gap: from now on all of it acts
    host.place(i, x);
    x[4].z = 0.15;
    host.place(i, x);
    EXPECT_NEAR(host.f[4].z, 5.0 * 0.2 / 0.15 * 0.05, 1e-13);
  }
}

// A light node on a stiff spring turns around within a few steps (h^2 K/m = 0.72 in contact, 4.8 before it). T = T0 - DW after the bounce,
// and the interface's own account (CX) says so too; without damping the node leaves as fast as it came.
TEST(BothSides, a_damped_bounce_closes_the_balance) {
  for (const double damping : {0.0, 0.05, 0.3}) {
    double worst = 0.0, plain = 0.0;
    for (const bool corrected : {true, false}) {
      for (int phase = 0; phase < 40; ++phase) {
        Host host;
        add_quad(host, 0.0);
        host.add({0.1, 0.2, 0.21 + 0.0005 * phase}, 1.0, {0, 0, -0.01});
        BothSidesOptions o;
        o.gap = 0.2;
        o.damping = damping;
        o.switch_correction = corrected;
        Interface i = interface_of(4, one_quad, o, 2.0);  // K0 = 1: the free step below would be beyond its limit
        host.dt = host.before = 2.2;
        for (int n = 0; n < 60; ++n) {
          host.contact(i);
          const double h = std::min(2.2, host.k[4] > 0.0 ? 0.6 * std::sqrt(2.0 / host.k[4]) : 2.2);
          host.v[4] += 0.5 * (host.dt + h) * host.f[4];
          host.x[4] += h * host.v[4];
          host.before = host.dt;
          host.dt = h;
        }
        ASSERT_GT(host.v[4].z, 0.0);
        const double t0 = 0.5e-4;
        const double t = 0.5 * squared_norm(host.v[4]);
        const double error = std::abs(t + host.last.damping_work - t0) / t0;
        if (corrected) { EXPECT_NEAR(host.last.made / t0, (t + host.last.damping_work - t0) / t0, 0.05) << phase; }
        (corrected ? worst : plain) = std::max(corrected ? worst : plain, error);
      }
    }
    std::printf("  damping %.2f: worst |T + DW - T0|/T0 %.4f, law's own force in every cycle %.4f\n", damping, worst, plain);
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(plain, 4.0 * worst);
  }
}

// Inacti 1, 2 and Fpenmax take nodes and facets out; Inacti 5 of an interface that is born later starts from t = 0.
TEST(BothSides, initial_penetrations_can_be_dropped) {
  using Initial = BothSidesOptions::Initial;
  for (const int kind : {1, 2, 3, 4}) {
    Host host;
    add_quad(host, 0.0);
    host.add({0, 0, 0.12}, 1.0);
    BothSidesOptions o;
    o.gap = 0.2;
    if (kind == 1) o.initial = Initial::drop_nodes;
    if (kind == 2) o.initial = Initial::drop_facets;
    if (kind == 3) o.largest_penetration = 0.3;  // 0.4 of the gap is deeper
    if (kind == 4) {
      o.initial = Initial::offset;
      o.birth = 1.5;
    }
    Interface i = interface_of(4, one_quad, o, 10.0);
    std::vector<Vec3> x = host.x;
    for (int step = 0; step < 4; ++step) {
      host.place(i, x);
      EXPECT_EQ(norm(host.f[4]), 0.0) << kind;
    }
    x[4].z = 0.05;
    host.place(i, x);
    EXPECT_EQ(norm(host.f[4]) > 0.0, kind == 4) << kind;
  }
  BothSidesOptions o;
  o.gap = 0.2;
  o.largest_penetration = 0.5;
  Host host;
  add_quad(host, 0.0);
  host.add({0, 0, 0.12}, 1.0);
  Interface i = interface_of(4, one_quad, o, 10.0);
  host.contact(i);
  EXPECT_GT(host.f[4].z, 0.0);
}

// Inacti 3 and 4: moved by p (1 + 1e-8), then nothing penetrates.
TEST(BothSides, projections_take_penetrations_away) {
  for (const bool surface : {false, true}) {
    Host host;
    add_quad(host, 1.0);
    host.add({0.1, 0.2, 0.12}, 1.0);
    BothSidesOptions o;
    o.gap = 0.2;
    Interface i = interface_of(4, one_quad, o, 10.0);
    const auto moves = i.projections(host.x, surface);
    ASSERT_EQ(moves.size(), surface ? 4u : 1u);
    for (const Projection& m : moves) {
      EXPECT_NEAR(norm(m.by), 0.08, 1e-9);
      host.x[static_cast<std::size_t>(m.node)] += m.by;
    }
    EXPECT_EQ(host.contact(i).in_contact, 0);
  }
}

// Istf 2 to 5 and their limits; Igap 1 to 3.
TEST(BothSides, stiffness_and_gap_of_a_pair) {
  using Stiffness = BothSidesOptions::Stiffness;
  const auto force = [](const BothSidesOptions& o, double main, double own, double z) {
    Host host;
    add_quad(host, 0.0);
    host.add({0, 0, z}, 1.0);
    Interface i = Interface::both_sides({4}, Surface(one_quad), o);
    const std::vector<double> k1{main}, k2{own};
    i.set_surface(1, {k1, {}, {}, {}});
    i.set_surface(0, {k2, {}, {}, {}});
    host.contact(i);
    return host.f[4].z;
  };
  BothSidesOptions o;
  o.gap = 0.2;
  const auto expected = [](double k) { return 0.5 * k * 0.2 / 0.15 * 0.05; };
  o.stiffness = Stiffness::facet;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(4), 1e-13);
  o.stiffness = Stiffness::mean;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(8), 1e-13);
  o.stiffness = Stiffness::larger;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(12), 1e-13);
  o.stiffness = Stiffness::smaller;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(4), 1e-13);
  o.stiffness = Stiffness::series;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(3), 1e-13);
  o.stiffness_max = 2;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(2), 1e-13);
  o.stiffness_min = 9, o.stiffness_max = 1e30;
  EXPECT_NEAR(force(o, 4, 12, 0.15), expected(9), 1e-13);

  BothSidesOptions v;
  v.gap = 0.05;
  v.node_gap = {0.12};
  v.facet_gap = {0.08};
  EXPECT_NEAR(force(v, 4, 0, 0.15), expected(4), 1e-13);
  v.gap_max = 0.14;
  EXPECT_EQ(force(v, 4, 0, 0.15), 0.0);
  v.gap_max = 1e30;
  v.node_size = {0.06};
  v.facet_size = {0.06};
  EXPECT_EQ(force(v, 4, 0, 0.15), 0.0);
  EXPECT_NEAR(force(v, 4, 0, 0.10), 2 * 0.12 / 0.10 * 0.02, 1e-13);
  v.gap = 0.2;  // Gapmin is the least
  EXPECT_NEAR(force(v, 4, 0, 0.15), expected(4), 1e-13);
}

// 2.5: (g - p)/2 over the closing speed of pairs, 0.9 gap over the largest relative speed near or far, twice the longest step so far; nodes
// below the least step leave.
TEST(BothSides, kinematic_limits) {
  BothSidesOptions o;
  o.gap = 0.2;
  Host host;
  add_quad(host, 1.0);
  const Index n = host.add({0, 0, 0.15}, 1.0, {0, 0, -4.0});
  Interface i = interface_of(n, one_quad, o, 1.0);
  host.dt = 1e-3;
  host.contact(i);
  EXPECT_NEAR(host.last.kinematic_step, 2e-3, 1e-15);
  host.dt = 0.1;
  host.contact(i);
  EXPECT_NEAR(host.last.kinematic_step, 0.5 * 0.15 / 4.0, 1e-15);
  EXPECT_EQ(host.last.kinematic_node, n);
  host.x[4].z = 50.0;
  host.v[4] = {3.0, 0, -4.0};
  host.contact(i);
  EXPECT_NEAR(host.last.kinematic_step, 0.9 * 0.2 / 5.0, 1e-15);
  EXPECT_EQ(host.last.in_contact, 0);

  o.step_minimum = 0.02;
  Interface j = interface_of(n, one_quad, o, 1.0);
  host.x[4].z = 0.15;
  host.contact(j);
  EXPECT_EQ(norm(host.f[4]), 0.0);
  host.v[4] = {};
  host.contact(j);
  EXPECT_EQ(norm(host.f[4]), 0.0);  // gone for good
}

// A node never meets a facet of its own; an inactive node (Idel) is let go; an eroded facet too.
TEST(BothSides, own_facets_and_erosion) {
  BothSidesOptions o;
  o.gap = 0.2;
  Host host;
  add_quad(host, 1.0);
  host.add({0, 0, 0.1}, 1.0);
  Interface self = Interface::both_sides({0, 1, 2, 3, 4}, Surface(one_quad), o);
  const std::vector<double> k{1.0};
  self.set_surface(1, {k, {}, {}, {}});
  EXPECT_EQ(host.contact(self).in_contact, 1);
  const std::vector<std::uint8_t> off{1, 1, 1, 1, 0}, on(5, 1), eroded{0}, whole{1};
  self.set_surface(0, {{}, {}, off, {}});
  EXPECT_EQ(host.contact(self).in_contact, 0);
  self.set_surface(0, {{}, {}, on, {}});
  EXPECT_EQ(host.contact(self).in_contact, 1);
  self.set_surface(1, {{}, {}, eroded, {}});
  EXPECT_EQ(host.contact(self).in_contact, 0);
}

// A checkpoint goes on with the same bits.
TEST(BothSides, history_resumes_bit_for_bit) {
  BothSidesOptions o;
  o.gap = 0.2;
  o.friction = 0.3;
  o.friction_form = BothSidesOptions::Friction::incremental;
  o.initial = BothSidesOptions::Initial::offset;
  Host host;
  add_quad(host, 1.0);
  host.add({0.2, 0.1, 0.15}, 1.0, {0.3, 0.1, -0.4});
  Interface a = interface_of(4, one_quad, o, 10.0);
  for (int s = 0; s < 200; ++s) host.step(a, 1e-3);
  Interface b = interface_of(4, one_quad, o, 10.0);
  b.restore(a.history());
  Host other = host;
  for (int s = 0; s < 200; ++s) {
    host.step(a, 1e-3);
    other.step(b, 1e-3);
  }
  EXPECT_EQ(host.x[4].x, other.x[4].x);
  EXPECT_EQ(host.x[4].z, other.x[4].z);
  EXPECT_EQ(host.last.made, other.last.made);
}

}  // namespace
}  // namespace abut::contact
