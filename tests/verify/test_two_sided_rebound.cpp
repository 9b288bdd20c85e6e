// TYPE7 in whole runs: rigid bodies with nothing but the contact to limit the step, touches in the first cycle, light plates that rub
// (docs/theory/contact.md, 7a).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

constexpr double gap = 1e-3;

void add_type7(Scene& s, const std::vector<Index>& nodes, Index surface, double friction = 0.0, double vis_s = 0.05, int inacti = 0) {
  model::Interface i;
  i.id = 1;
  i.stfac = 1.0;
  i.gap = gap;
  i.friction = friction;
  model::InterfaceType7 t;
  t.nodes = nodes;
  std::sort(t.nodes.begin(), t.nodes.end());
  t.surface = surface;
  t.istf = 4;
  t.inacti = inacti;
  t.vis_s = vis_s;
  t.gap_given = true;
  i.type = std::move(t);
  s.model.interfaces.push_back(std::move(i));
}

/// What a run says of its contact, of the largest energy.
struct Found {
  double err = 0.0, cx = 0.0, last_cx = 0.0;
  std::size_t cycles = 0;
  Index touched = 0, touches = 0;  ///< nodes at most, and at the end
};

Found run(const Scene& s, Recorder& r) {
  const auto report = abut::cycle::run(s.model, {}, r);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  Found f;
  f.cycles = r.samples.size();
  for (const auto& sample : r.samples) {
    f.err = std::max(f.err, std::abs(sample.balance.err));
    f.last_cx = std::abs(sample.balance.cx) / sample.balance.largest;
    f.cx = std::max(f.cx, f.last_cx);
    f.touches = sample.interfaces[0].in_contact;
    f.touched = std::max(f.touched, f.touches);
  }
  return f;
}

// A rigid block falls on a rigid plate that is free, too, head on, from the edge of the gap to 2.65 gaps above it. Closed: m1 v1 + m2 v2
// stays, and without dampers the bodies part as fast as they met. Runs of half of these ended with up to 10^11 times their energy.
TEST(TwoSidedRebound, RigidBodiesKeepEnergyAndMomentum) {
  double worst = 0.0;
  std::size_t most = 0;
  for (const double speed : {0.2, 20.0}) {
    for (const double clear : {1.0 + 1e-6, 1.05, 1.3, 1.5, 2.45, 2.6, 2.85, 2.9, 3.65}) {
      Scene s("rigid");
      const Index steel = s.elastic(7800.0, 210e9, 0.3), aluminium = s.elastic(2700.0, 70e9, 0.33);
      const auto lower = s.block(s.part(s.solid_property(), steel), {-0.06, -0.06, -0.03}, {0.12, 0.12, 0.03}, {1, 1, 1});
      const auto upper = s.block(s.part(s.solid_property(), aluminium), {-0.03, -0.03, clear * gap}, {0.06, 0.06, 0.06}, {1, 1, 1});
      add_type7(s, upper.nodes, s.surface(lower, 2, true), 0.0, 0.0);
      const Index below = s.rigid_body(lower.nodes, {0, 0, -0.015}), above = s.rigid_body(upper.nodes, {0, 0, clear * gap + 0.03});
      s.velocity(upper.nodes, {0, 0, -speed});
      s.velocity({above}, {0, 0, -speed});
      s.end(6.0 * gap / speed);
      Recorder r({below, above});
      const Found f = run(s, r);
      ASSERT_EQ(f.touched, 4) << clear << " at " << speed;
      EXPECT_EQ(f.touches, 0);
      const double m1 = 0.12 * 0.12 * 0.03 * 7800.0, m2 = 0.06 * 0.06 * 0.06 * 2700.0;
      const double v1 = r.samples.back().v[0].z, v2 = r.samples.back().v[1].z;
      EXPECT_NEAR(m1 * v1 + m2 * v2, -m2 * speed, 1e-12 * m2 * speed) << clear << " at " << speed;
      EXPECT_GT((v2 - v1) / speed, speed > 1.0 ? 0.95 : 0.995) << clear << " at " << speed;
      EXPECT_LT((v2 - v1) / speed, 1.005) << clear << " at " << speed;
      worst = std::max(worst, f.last_cx);
      most = std::max(most, f.cycles);
    }
  }
  std::printf("[found] rigid blocks: |CX| %.3f %% at the end, %zu cycles at most\n", 100 * worst, most);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(most, 300u);
}

// Plates of 2 mm that touch in the first step of the run, or begin to press in it where their gap begins (Inacti 5).
TEST(TwoSidedRebound, FirstStepMakesNoEnergy) {
  for (const double speed : {3.0, 150.0}) {
    for (const double clear : {0.9, 1.0001, 1.02, 1.05}) {
      Scene s("touch");
      const Index property = s.shell_property(0.002);
      const Index a = s.part(property, s.elastic(7800.0, 210e9, 0.3)), b = s.part(property, s.elastic(2700.0, 70e9, 0.33));
      (void)s.shells(a, 6, 6, [](double u, double v) { return Vec3{0.12 * u - 0.06, 0.12 * v - 0.06, 0.0}; });
      const auto above = s.shells(
          b, 4, 4,
          [clear](double u, double v) {
            return Vec3{0.06 * u - 0.031, 0.06 * v - 0.027, clear * gap};
          },
          true);
      add_type7(s, above, s.shell_surface(a), 0.0, 0.05, clear < 1.0 ? 5 : 0);
      s.velocity(above, {0, 0, -speed});
      s.end(1.5e-4);
      Recorder r;
      const Found f = run(s, r);
      EXPECT_GT(f.touched, 20);
      std::printf("[found] plates at %.4f gaps, %g m/s: ERR %.2f %% at most, CX %.3f %% at most, %.3f %% at the end\n", clear, speed,
                  100 * f.err, 100 * f.cx, 100 * f.last_cx);
      EXPECT_LT(f.err, speed > 100.0 ? 0.02 : 0.01);
      EXPECT_LT(f.last_cx, clear < 1.0 ? 0.02 : 0.005);  // CX holds what the relaxing of the offset makes, too
    }
  }
}

// A light plate slides and falls on a block: its viscous friction (Iform 1) is far stiffer than its normal springs.
TEST(TwoSidedRebound, RubbingMakesNoEnergy) {
  for (const double friction : {0.0, 0.2}) {
    Scene s("rub");
    const auto block =
        s.block(s.part(s.solid_property(), s.elastic(7800.0, 210e9, 0.3)), {-0.06, -0.06, -0.03}, {0.12, 0.12, 0.03}, {6, 6, 3});
    const Index b = s.part(s.shell_property(0.002), s.elastic(2700.0, 70e9, 0.33));
    const auto above = s.shells(
        b, 4, 4,
        [](double u, double v) {
          return Vec3{0.06 * u - 0.031, 0.06 * v - 0.027, 2.3 * gap};
        },
        true);
    add_type7(s, above, s.surface(block, 2, true), friction);
    std::get<model::InterfaceType7>(s.model.interfaces[0].type).istf = 2;
    s.velocity(above, {6, 2, -20});
    s.end(1.5e-4);
    Recorder r;
    const Found f = run(s, r);
    EXPECT_GT(f.touched, 20);
    std::printf("[found] friction %.1f: CX %.3f %% at most, %.3f %% at the end\n", friction, 100 * f.cx, 100 * f.last_cx);
    EXPECT_LT(f.cx, 0.005);
    EXPECT_LT(f.last_cx, 0.002);
  }
}

}  // namespace
