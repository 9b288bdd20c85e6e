// Contact patch test (issue: the contact heart, 6): two blocks of 1 x 1 x 0.5, meshes that do not match, uniform pressure on top. The
// exact answer is s_zz = -p everywhere, in both blocks, whatever the meshes (R. L. Taylor and P. Papadopoulos, On a patch test for
// contact problems in two dimensions, in: Nonlinear Computational Mechanics, 1991). Node to segment in one pass is known to fail
// it (M. A. Crisfield, Re-visiting the contact patch test, Int. J. Numer. Meth. Eng. 48, 2000, 435-449); two passes, each
// surface held by the other, spread the load better and still are not exact with penalties: printed and bounded here.
//
// TYPE3 (two passes) and TYPE5 (one: nodes of the upper block on segments of the lower one), both laws (gap 0; gap 0.02 with the
// blocks that far apart), nu 0.3, default property, p = 1e-3 E. Protocol: the pressure grows smoothly over 8 times the round trip
// 4 H/c of a wave and is held for 4 more; nothing is damped, KE / IE < 1 % after the ramp is asserted for two passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "support/csv.hpp"
#include "support/quasi_static.hpp"
#include "support/round.hpp"
#include "support/scene.hpp"

namespace {

using namespace abut;
using scenes::Block;
using scenes::Scene;
using scenes::StaticRecord;

struct Patch {
  int lower = 4, upper = 6;  ///< bricks along each side
  bool two_passes = true;
  bool stiffening = false;
  double s = 1.0;
  double young = 1.0, poisson = 0.3, density = 1.0, pressure = 1e-3;
  double ramp = 8.0, hold = 4.0;
};

struct Answer {
  double worst = 0.0;    ///< largest |s_zz + p| / p of all bricks
  double contact = 0.0;  ///< the same of the rows at the contact
  double rms = 0.0;      ///< root of the mean square of all bricks
  double force = 0.0;    ///< contact force over the load
  double kinetic = 0.0, hourglass = 0.0, drift = 0.0;
  double penetration = 0.0;
};

Answer press(const Patch& c) {
  Scene scene("patch");
  const Index property = scene.solid_property();
  const Index material = scene.elastic(c.density, c.young, c.poisson);
  const double h = 0.5;
  const double gap = c.stiffening ? 0.02 : 0.0;
  const auto rows = [](int n) { return std::max(1, n / 2); };
  const Block lower = scene.block(scene.part(property, material), {0, 0, -h}, {1, 1, h}, {c.lower, c.lower, rows(c.lower)});
  const Block upper = scene.block(scene.part(property, material), {0, 0, gap}, {1, 1, h}, {c.upper, c.upper, rows(c.upper)});
  for (const Block* b : {&lower, &upper}) {
    scene.fix(b->plane(0, false), {true, false, false});
    scene.fix(b->plane(1, false), {false, true, false});
  }
  scene.fix(lower.plane(2, false), {false, false, true});
  const double unit = 4.0 * 2.0 * h / std::sqrt(c.young / c.density);
  scene.traction(upper, 2, true, 2, -c.pressure, scenes::ramp(scene, c.ramp * unit));
  const Index below = scene.surface(lower, 2, true);
  const Index above = scene.surface(upper, 2, false);
  scene.contact(below, above, c.s, 0.0, gap);
  if (!c.two_passes) {
    model::InterfaceType5 one;
    one.nodes = upper.plane(2, false);
    std::sort(one.nodes.begin(), one.nodes.end());
    one.surface = below;
    scene.model.interfaces[0].type = one;
  }
  const StaticRecord r = scenes::solve_static(scene, (c.ramp + c.hold) * unit);
  EXPECT_EQ(r.outcome.kind, cycle::Outcome::Kind::finished) << r.outcome.message;
  Answer a;
  if (r.outcome.kind != cycle::Outcome::Kind::finished) return a;
  const auto deviation = [&](Index e) { return std::abs(r.stress[static_cast<std::size_t>(e)][2] + c.pressure) / c.pressure; };
  double squares = 0.0;
  const Index bricks = scene.model.bricks.size();
  const Index split = c.lower * c.lower * rows(c.lower);
  for (Index e = 0; e < bricks; ++e) {
    const double d = deviation(e);
    squares += d * d;
    a.worst = std::max(a.worst, d);
    const bool touches = (e >= split - c.lower * c.lower && e < split) || (e >= split && e < split + c.upper * c.upper);
    if (touches) a.contact = std::max(a.contact, d);
  }
  a.rms = std::sqrt(squares / bricks);
  const auto& last = r.energies.back();
  a.force = std::abs(last.force.z) / c.pressure;
  a.kinetic = r.kinetic_share(c.ramp * unit);
  a.hourglass = last.he / last.ie;
  a.penetration = last.penetration;
  std::printf(
      "[found] contact patch: %d on %d, %s, %s law, s %.3g: s_zz off by %.2f %% (rows at the contact %.2f, rms %.2f), force / load %.5f, "
      "P %.2e, KE/IE %.1e, HE/IE %.1e, %zu cycles\n",
      c.upper, c.lower, c.two_passes ? "two passes" : "one pass", c.stiffening ? "stiffening" : "constant", c.s, 100.0 * a.worst,
      100.0 * a.contact, 100.0 * a.rms, a.force, a.penetration, a.kinetic, a.hourglass, r.energies.size());
  return a;
}

struct Ratio {
  int lower, upper;
};
struct Passes {
  Answer two, one;
};

/// The same meshes with two passes and with one. The load arrives whole in any case: what goes wrong in one pass is where.
Passes press_both_ways(const Ratio& ratio, bool stiffening, double s) {
  Patch c;
  c.lower = ratio.lower;
  c.upper = ratio.upper;
  c.stiffening = stiffening;
  c.s = s;
  const Answer two = press(c);
  c.two_passes = false;
  const Answer one = press(c);
  EXPECT_LT(two.kinetic, 0.01);
  EXPECT_NEAR(two.force, 1.0, 0.002);
  EXPECT_NEAR(one.force, 1.0, 0.01);
  EXPECT_LT(two.worst, one.worst) << ratio.upper << " on " << ratio.lower;
  return {two, one};
}

constexpr Ratio ratios[] = {{4, 4}, {4, 5}, {4, 6}, {6, 4}, {4, 8}, {8, 4}};

TEST(ContactPatch, TwoPassesCarryThePressureThroughMeshesThatDoNotMatch) {
  scenes::Csv csv("patch", "lower,upper,passes,stiffening,worst");
  for (const bool stiffening : {false, true}) {
    for (const Ratio& ratio : ratios) {
      const auto [two, one] = press_both_ways(ratio, stiffening, 4.0);
      EXPECT_LT(two.worst, 0.05) << ratio.upper << " on " << ratio.lower;
      // In one pass the nodes of a surface that is not a refinement of the other cannot carry an even pressure; twice as coarse
      // (4 on 8) they leave every other node of the finer surface unheld, which swings and drifts (HE 17 times IE).
      if (ratio.lower > ratio.upper || ratio.upper % ratio.lower != 0) {
        EXPECT_GT(one.worst, 0.2) << ratio.upper << " on " << ratio.lower;
      }
      csv.row({1.0 * ratio.lower, 1.0 * ratio.upper, 2.0, stiffening ? 1.0 : 0.0, 100.0 * two.worst});
      csv.row({1.0 * ratio.lower, 1.0 * ratio.upper, 1.0, stiffening ? 1.0 : 0.0, 100.0 * one.worst});
    }
  }
}

// The springs of nodes on edges and corners are stiffer for their area than those inside (K1 K2 / (K1 + K2) with K1 a share of the
// facets around a node): with soft springs even matching meshes carry the pressure unevenly. It fades as s grows.
TEST(ContactPatch, ErrorFallsWithStifferSprings) {
  for (const Ratio& ratio : {ratios[0], ratios[2]}) {
    double before = 1e30;
    for (const double s : {0.2, 1.0, 4.0}) {
      Patch c;
      c.lower = ratio.lower;
      c.upper = ratio.upper;
      c.s = s;
      const Answer a = press(c);
      EXPECT_LT(a.kinetic, 0.01);
      EXPECT_LT(a.worst, before) << s;
      before = a.worst;
    }
  }
}

// The same at the default Stfac, 0.2: the table of docs/verification/contact-forms.md. The pressure is shared by springs that are as soft
// as the bricks, so what the springs of edges and corners have too much the others lack; the load still arrives whole.
TEST(ContactPatchFull, AtTheDefaultStfac) {
  for (const bool stiffening : {false, true}) {
    for (const Ratio& ratio : ratios) {
      const auto [two, one] = press_both_ways(ratio, stiffening, 0.2);
      EXPECT_LT(two.worst, 0.22) << ratio.upper << " on " << ratio.lower;
    }
  }
}

}  // namespace
