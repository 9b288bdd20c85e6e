// Closed forms of longitudinal impact (issue: run a real deck, 6.1), through TYPE3 and the default profile.
//
// One-dimensional theory of a bar (impedance Z = rho c A, length L, T = 2 L/c) that moves with v0 onto a spring k in front
// of a rigid wall (two equal bars with opposite speeds meet at their plane of symmetry: k = 2 K_total of the interface).
// With a = k/Z, force on the spring:
//   0 <= t <= T:   F = Z v0 (1 - exp(-a t))
//   t = T + s:     F = Z v0 [-1 + (2 a s + 2 - exp(-a T)) exp(-a s)]     until F = 0: the bars part.
// k -> infinity: contact lasts T, force Z v0, velocities reversed (Graff 1975, Wave Motion in Elastic Solids, 2.1.4).
// The theory is linear; at v = 0.1 the strain is 10 % and v/c = 0.1 a shock (bulk viscosity takes 2 % of the impulse),
// so the bars are of small strain without viscosity (Ismstr 1, qa = qb = 0) and one element across: with
// nu = 0 the problem is one-dimensional. At v = 0.01 two elements across, large strain and the default viscosity agree as well.
// Several elements across have corner, edge and inner nodes with springs as 0.4 : 0.67 : 1 where the bar's stress asks for
// 0.25 : 0.5 : 1, and only viscosity keeps one-point bricks from following: the faces bulge into each other. At v = 0.1 the nodes
// in the middle are then half a segment deep behind the top of a facing bulge, as near to each of the four facets around it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;

struct Impact {
  double parting = -1.0;  // instant at which the facing nodes are apart again, interpolated; contact begins at 0 where the gap is 0
  double impulse = 0.0, peak = 0.0;
  double worst_error_free = 0.0, worst_error_contact = 0.0;
  double made = 0.0;  // |CX| at the end over the largest term
  Vec3 momentum_first, momentum_last;
  double plateau = 0.0;     // mean normal force over 8 <= t <= 16
  double exit_speed = 0.0;  // mean z velocity of the first block at the end
};

struct BarCase {
  double length = 10.0, side = 1.0, young = 1.0, density = 1.0, v = 0.1;
  int cells = 80, across = 1;
  bool linear = true;  // small strain, no quadratic bulk viscosity
  double s = 0.2, gap = 0.0;
  double end = 40.0;
  double step_scale = 0.9;
};

/// K of both passes together: sum over nodes of s K1 K2/(K1 + K2), K1 facet, K2 node (sum of quarters).
double total_stiffness(const BarCase& b) {
  const double bulk = b.young / 3.0;  // nu = 0
  const double area = b.side * b.side / (b.across * b.across);
  const double facet = bulk * area * area / (area * b.length / b.cells);
  double sum = 0.0;
  for (int i = 0; i <= b.across; ++i) {
    for (int j = 0; j <= b.across; ++j) {
      const double node = facet * 0.25 * ((i == 0 || i == b.across) ? 1 : 2) * ((j == 0 || j == b.across) ? 1 : 2);
      sum += b.s * facet * node / (facet + node);
    }
  }
  return 2.0 * sum;
}

struct SpringTheory {
  double parting = 0.0;  ///< contact time
  double impulse = 0.0;
};

/// One-dimensional theory of two bars with the interface's springs.
SpringTheory theory(const BarCase& b) {
  const double z = std::sqrt(b.young * b.density) * b.side * b.side;
  const double period = 2.0 * b.length / std::sqrt(b.young / b.density);
  const double a = 2.0 * total_stiffness(b) / z;
  double low = 0.0;
  double high = 50.0 / a;
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (low + high);
    ((2.0 * a * mid + 2.0 - std::exp(-a * period)) * std::exp(-a * mid) > 1.0 ? low : high) = mid;
  }
  // Integral of F: Z v0 [T - (1 - exp(-a T))/a + (-u + 4 - (2 u + 4) e^-u - exp(-a T) (1 - e^-u))/a], u = a s.
  const double u = a * low;
  const double q = std::exp(-a * period);
  const double rest = -u + 4.0 - (2.0 * u + 4.0) * std::exp(-u) - q * (1.0 - std::exp(-u));
  return {period + low, z * b.v * (period + (rest - (1.0 - q)) / a)};
}

Impact two_bars(const BarCase& b, abut::Profile profile = {}) {
  Scene scene("bars");
  const auto material = scene.elastic(b.density, b.young, 0.0);
  const auto property = b.linear ? scene.linear_solid_property() : scene.solid_property();
  const auto p1 = scene.part(property, material);
  const auto p2 = scene.part(property, material);
  const auto first = scene.block(p1, {0, 0, 0}, {b.side, b.side, b.length}, {b.across, b.across, b.cells});
  const auto second = scene.block(p2, {0, 0, b.length + b.gap}, {b.side, b.side, b.length}, {b.across, b.across, b.cells});
  scene.velocity(first.nodes, {0, 0, b.v});
  scene.velocity(second.nodes, {0, 0, -b.v});
  scene.contact(scene.surface(first, 2, true), scene.surface(second, 2, false), b.s, 0.0, b.gap);
  scene.end(b.end, 0.0, b.step_scale);
  std::vector<abut::Index> facing = first.plane(2, true);
  const std::size_t pairs = facing.size();
  for (const auto n : second.plane(2, false)) facing.push_back(n);
  Recorder recorder(facing);
  abut::cycle::RunOptions options;
  options.profile = profile;
  const auto report = abut::cycle::run(scene.model, options, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;

  Impact out;
  out.momentum_first = recorder.samples.front().balance.momentum;
  out.momentum_last = recorder.samples.back().balance.momentum;
  double plateau = 0.0;
  double plateau_time = 0.0;
  double deep_before = 0.0;
  double time_before = 0.0;
  for (const auto& sample : recorder.samples) {
    const auto& contact = sample.interfaces[0];
    const bool touching = contact.in_contact > 0;
    double deep = -1e30;  // of the deepest pair
    for (std::size_t i = 0; i < pairs; ++i) deep = std::max(deep, sample.u[i].z - sample.u[i + pairs].z - b.gap);
    if (deep_before > 0.0 && deep <= 0.0) out.parting = time_before + (sample.time - time_before) * deep_before / (deep_before - deep);
    deep_before = deep;
    time_before = sample.time;
    if (sample.time >= 8.0 && sample.time <= 16.0) {
      plateau += sample.dt * std::abs(contact.normal_force.z);
      plateau_time += sample.dt;
    }
    out.peak = std::max(out.peak, std::abs(contact.normal_force.z));
    out.impulse = std::abs(contact.normal_impulse.z);
    double& worst = touching ? out.worst_error_contact : out.worst_error_free;
    worst = std::max(worst, std::abs(sample.balance.err));
    out.made = std::abs(sample.balance.cx) / sample.balance.largest;
  }
  out.plateau = plateau / plateau_time;
  double mass = 0.0;
  for (const auto n : first.nodes) {
    const auto i = static_cast<std::size_t>(n);
    out.exit_speed += recorder.last_state.mass[i] * recorder.last_state.v[i].z;
    mass += recorder.last_state.mass[i];
  }
  out.exit_speed /= mass;
  return out;
}

void print(const char* what, const BarCase& b, const Impact& r) {
  std::printf("[found] %s: s %.3g, gap %.3g, %d x %d x %d per bar: contact %.4f (spring theory %.4f), impulse %.5f (%.5f)\n", what, b.s,
              b.gap, b.across, b.across, b.cells, r.parting, theory(b).parting, r.impulse, theory(b).impulse);
}

// T13, T17; 6.1: series stiffness of brick faces decides when penalty-coupled bars part.
TEST(Bars, PartWhenTheSpringTheorySays) {
  const BarCase b;
  const Impact r = two_bars(b);
  print("two bars", b, r);
  EXPECT_NEAR(r.parting, theory(b).parting, 0.01 * theory(b).parting);
  EXPECT_NEAR(r.impulse, theory(b).impulse, 0.01 * theory(b).impulse);
  BarCase solid;
  solid.cells = 40;
  solid.across = 2;
  solid.linear = false;
  solid.v = 0.01;
  const Impact thick = two_bars(solid);
  print("two bars, large strain", solid, thick);
  EXPECT_NEAR(thick.parting, theory(solid).parting, 0.01 * theory(solid).parting);
  EXPECT_NEAR(thick.impulse, theory(solid).impulse, 0.01 * theory(solid).impulse);
}

// 6.1 with two elements across at v = 0.1. The springs' theory takes flat faces; the bulges make the last pair part later:
// 22.95 is the figure of the issue. (A lateral shift of 1e-6 ends it: frictionless bulges slide off each other.)
TEST(Bars, HoldWithTwoElementsAcross) {
  BarCase b;
  b.cells = 40;
  b.across = 2;
  const Impact r = two_bars(b);
  print("two bars, 2 x 2 x 40", b, r);
  EXPECT_NEAR(r.parting, 22.95, 0.01 * 22.95);
  EXPECT_NEAR(r.impulse, theory(b).impulse, 0.01 * theory(b).impulse);
  EXPECT_LT(r.worst_error_contact, 0.01);
  EXPECT_LT(r.made, 0.002);
}

TEST(Bars, ApproachIdealContactAsStiffnessGrows) {
  double previous = 1e30;
  for (const double s : {0.1, 0.2, 0.4, 0.8}) {
    BarCase b;
    b.s = s;
    b.cells = 160;
    const Impact r = two_bars(b);
    print("stiffer", b, r);
    EXPECT_NEAR(r.parting, theory(b).parting, 0.01 * theory(b).parting) << "s = " << s;
    const double off = r.parting - 20.0;
    EXPECT_GT(off, 0.0);
    EXPECT_LT(off, previous);
    previous = off;
  }
}

TEST(Bars, ApproachIdealContactAsTheMeshRefines) {
  double previous = 1e30;
  double previous_impulse = 1e30;
  for (const int cells : {20, 40, 80, 160}) {
    BarCase b;
    b.cells = cells;
    const Impact r = two_bars(b);
    print("finer", b, r);
    EXPECT_NEAR(r.parting, theory(b).parting, 0.01 * theory(b).parting) << cells << " elements";
    EXPECT_NEAR(r.impulse, theory(b).impulse, 0.01 * theory(b).impulse) << cells << " elements";
    const double off = r.parting - 20.0;
    EXPECT_LT(off, previous);
    EXPECT_LT(std::abs(r.impulse - 2.0), previous_impulse);
    previous = off;
    previous_impulse = std::abs(r.impulse - 2.0);
  }
}

// The spring itself kept (s n constant) while the mesh refines: what is left over is the mesh alone.
TEST(Bars, ConvergeToTheSpringTheoryWithTheSpringKept) {
  double previous = 1e30;
  for (const int cells : {20, 40, 80, 160}) {
    BarCase b;
    b.cells = cells;
    b.s = 0.2 * 40 / cells;
    const Impact r = two_bars(b);
    print("spring kept", b, r);
    const double off = std::abs(r.parting - theory(b).parting);
    EXPECT_LT(off, previous) << cells << " elements";
    previous = off;
  }
  EXPECT_LT(previous, 1e-4 * 21.97);
}

// 6.1: ideal bars exchange their velocities; with springs the rest of the energy rings in the bars.
TEST(Bars, ExchangeVelocities) {
  BarCase b;
  b.cells = 160;
  const Impact r = two_bars(b);
  print("exchange", b, r);
  std::printf("[found] exchange: exit speed %.5f (-0.1), force plateau %.5f (0.1)\n", r.exit_speed, r.plateau);
  EXPECT_NEAR(r.exit_speed, -0.1, 0.01 * 0.1);
  EXPECT_NEAR(r.impulse, 2.0 * 10.0 * 0.1, 0.01 * 2.0);
  EXPECT_NEAR(r.plateau, 0.1, 0.01 * 0.1);
}

// 6.5: linear momentum of a free impact.
TEST(Bars, ConserveMomentumToRounding) {
  const Impact r = two_bars({});
  const double scale = 2.0 * 10.0 * 0.1;
  EXPECT_LT(abut::norm(r.momentum_last - r.momentum_first), 1e-12 * scale);
}

TEST(Bars, KeepTheirEnergy) {
  const Impact r = two_bars({});
  EXPECT_LT(r.worst_error_free, 0.01);
  EXPECT_LT(r.worst_error_contact, 0.02);
  EXPECT_LT(r.made, 0.002);
}

}  // namespace
