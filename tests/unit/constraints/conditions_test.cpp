#include <gtest/gtest.h>

#include <cmath>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {
namespace {

const double c30 = std::sqrt(0.75);

model::Skew tilted() { return {.id = 1, .axes = {Vec3{c30, 0.5, 0}, Vec3{-0.5, c30, 0}, Vec3{0, 0, 1}}}; }

TEST(Axes, MovingSkewFollowsItsNodesForEveryDirectionFlag) {
  for (int direction = 0; direction < 3; ++direction) {
    auto m = nodes_at({{0, 0, 0}, {2, 0, 0}, {1, 3, 0}});
    m.skews.push_back({.id = 1, .nodes = {0, 1, 2}, .direction = direction});
    state::State s = state_of(m);
    for (auto& x : s.x) x = {-x.y, x.x, x.z};  // a quarter turn about z
    Axes axes(m);
    axes.update(s);
    EXPECT_EQ(axes.axis(0, direction), (Vec3{0, 1, 0}));            // along N1 -> N2
    EXPECT_EQ(axes.axis(0, (direction + 2) % 3), (Vec3{0, 0, 1}));  // normal of the three nodes
    const Frame f = axes.frame(0);
    EXPECT_EQ(cross(f[0], f[1]), f[2]);
  }
}

TEST(Axes, DegenerateMovingSkewKeepsItsAxes) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  m.skews.push_back({.id = 1, .nodes = {0, 1, 2}});
  Axes axes(m);
  axes.update(state_of(m));
  EXPECT_EQ(axes.axis(0, 1), (Vec3{0, 1, 0}));
}

TEST(BoundaryConditions, HoldComponentsInASkewAndTakeTheirEnergy) {
  auto m = nodes_at({{0, 0, 0}});
  m.skews.push_back(tilted());
  m.boundary_conditions.push_back(
      {.id = 1, .translation = {false, true, false}, .rotation = {true, false, false}, .skew = 0, .nodes = {0}});
  m.concentrated_loads.push_back({.id = 1, .direction = 1, .scale_y = 2.0, .nodes = {0}});
  Rig rig(m, 1.0, 0.5);
  rig.s.v[0] = {1, 1, 1};
  rig.s.w[0] = {1, 1, 0};
  rig.start();
  for (int n = 0; n < 50; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(dot(rig.s.v[0], m.skews[0].axes[1]), 0.0, 1e-14);
    ASSERT_NEAR(dot(rig.s.w[0], m.skews[0].axes[0]), 0.0, 1e-14);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-13);
  }
  // Only the component of the force along the free axis accelerates: 2 sin 30 degrees.
  EXPECT_NEAR(dot(rig.s.v[0], m.skews[0].axes[0]), c30 + 0.5 + 1.0 * 0.495, 1e-13);
  EXPECT_NEAR(rig.s.v[0].z, 1.0, 1e-15);
  // The held components lose their kinetic energy at once, (1/2) (c30 - 1/2)^2 + (1/4) (c30 + 1/2)^2; the reaction that follows is
  // normal to the motion and does no work.
  EXPECT_NEAR(rig.work_conditions, -0.5 * (c30 - 0.5) * (c30 - 0.5) - 0.25 * (c30 + 0.5) * (c30 + 0.5), 1e-13);
}

TEST(BoundaryConditions, CardsOfOneNodeAccumulateAcrossFrames) {
  auto m = nodes_at({{0, 0, 0}});
  m.skews.push_back(tilted());
  m.boundary_conditions.push_back({.id = 1, .translation = {true, false, false}, .nodes = {0}});
  m.boundary_conditions.push_back({.id = 2, .translation = {true, false, false}, .skew = 0, .nodes = {0}});
  Rig rig(m);
  rig.s.v[0] = {1, 2, 3};
  rig.start();
  rig.step(0.1);
  EXPECT_NEAR(rig.s.v[0].x, 0.0, 1e-15);
  EXPECT_NEAR(rig.s.v[0].y, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(rig.s.v[0].z, 3.0);
}

TEST(BoundaryConditions, ReleaseActsAtOnceAndCanBeTakenBack) {
  auto m = nodes_at({{0, 0, 0}});
  m.boundary_conditions.push_back({.id = 1, .translation = {true, true, true}, .nodes = {0}});
  m.concentrated_loads.push_back({.id = 1, .direction = 0, .nodes = {0}});
  Rig rig(m);
  rig.start();
  rig.step(0.1);
  EXPECT_EQ(rig.s.v[0].x, 0.0);
  rig.conditions.release(0, 0);
  EXPECT_FALSE(rig.conditions.fixed(0, 0));
  EXPECT_TRUE(rig.conditions.fixed(0, 1));
  rig.step(0.1);
  EXPECT_DOUBLE_EQ(rig.s.v[0].x, 0.1);
  rig.conditions.restore(0, 0);
  EXPECT_TRUE(rig.conditions.fixed(0, 0));
  rig.step(0.1);
  EXPECT_EQ(rig.s.v[0].x, 0.0);
  rig.conditions.release(0, 1);
  rig.conditions.restore_all();
  EXPECT_TRUE(rig.conditions.fixed(0, 1));
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-15);
}

TEST(ImposedMotion, VelocityMeetsItsCurveAtTheHalfStepForAnySteps) {
  auto m = nodes_at({{0, 0, 0}});
  m.skews.push_back(tilted());
  const Index f = add_function(m, {0, 0.5, 1}, {1, 3, -2});
  m.imposed_motions.push_back({.id = 1, .function = f, .direction = 0, .skew = 0, .scale_x = 2.0, .scale_y = 0.5, .nodes = {0}});
  Rig rig(m, 2.0);
  rig.s.v[0] = {0.1, 0.7, 0.2};
  const double along_y = dot(rig.s.v[0], m.skews[0].axes[1]);
  rig.start();
  for (int n = 0; n < 60; ++n) {
    const double t = rig.s.times.t, h = 0.01 * (1.0 + 0.5 * std::sin(2.3 * n));
    rig.step(h);
    ASSERT_NEAR(dot(rig.s.v[0], m.skews[0].axes[0]), 0.5 * rig.curves.value(f, (t + 0.5 * h) / 2.0), 1e-14);
    ASSERT_NEAR(dot(rig.s.v[0], m.skews[0].axes[1]), along_y, 1e-14);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-13);
  }
}

TEST(ImposedMotion, DisplacementMeetsItsCurveAtEveryStep) {
  auto m = nodes_at({{5, 0, 0}});
  const Index f = add_function(m, {0, 0.1, 0.3}, {0, 0.2, 0.1});
  m.imposed_motions.push_back({.id = 1, .kind = model::ImposedMotion::Kind::displacement, .function = f, .direction = 0, .nodes = {0}});
  Rig rig(m);
  rig.start();
  for (int n = 0; n < 60; ++n) {
    rig.step(0.005 * (1.0 + 0.5 * std::sin(2.3 * n)));
    ASSERT_NEAR(rig.s.u[0].x, rig.curves.value(f, rig.s.times.t), 1e-14);
  }
}

TEST(ImposedMotion, DisplacementStartedByASensorIsRelative) {
  auto m = nodes_at({{0, 0, 0}});
  const Index f = add_function(m, {0, 1}, {0, 2});
  m.sensors.push_back({1, 0.0995, 1e30});
  m.imposed_motions.push_back(
      {.id = 1, .kind = model::ImposedMotion::Kind::displacement, .function = f, .direction = 0, .sensor = 0, .nodes = {0}});
  Rig rig(m);
  rig.s.v[0] = {1, 0, 0};
  rig.start();
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.s.u[0].x, 0.1, 1e-15);  // free flight
  for (int n = 0; n < 20; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.s.u[0].x, 0.1 + 0.4, 1e-14);
}

TEST(ImposedMotion, RotationReachesItsAngle) {
  auto m = nodes_at({{0, 0, 0}});
  const Index f = add_function(m, {0, 1}, {0, 0.5});
  m.imposed_motions.push_back({.id = 1, .kind = model::ImposedMotion::Kind::displacement, .function = f, .direction = 5, .nodes = {0}});
  Rig rig(m, 1.0, 0.3);
  rig.start();
  double angle = 0.0;
  for (int n = 0; n < 100; ++n) {
    const double h = 0.01 * (1.0 + 0.5 * std::sin(2.3 * n));
    rig.step(h);
    angle += h * rig.s.w[0].z;
    ASSERT_NEAR(angle, 0.5 * rig.s.times.t, 1e-14);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-14);
  }
}

TEST(ImposedMotion, AccelerationAndWindow) {
  auto m = nodes_at({{0, 0, 0}});
  m.imposed_motions.push_back({.id = 1,
                               .kind = model::ImposedMotion::Kind::acceleration,
                               .direction = 2,
                               .scale_y = 4.0,
                               .t_start = 0.095,
                               .t_stop = 0.195,
                               .nodes = {0}});
  Rig rig(m);
  rig.start();
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  EXPECT_EQ(rig.s.v[0].z, 0.0);
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.s.v[0].z, 0.4, 1e-14);
  rig.step(0.01);
  EXPECT_NEAR(rig.s.v[0].z, 0.4, 1e-14);
}

// A node is drawn at constant speed against a constant force: work = force times distance, in both bookings.
TEST(ImposedMotion, WorkIsForceTimesDistance) {
  auto m = nodes_at({{0, 0, 0}});
  m.imposed_motions.push_back({.id = 1, .direction = 0, .scale_y = 3.0, .nodes = {0}});
  Rig rig(m, 2.0);
  rig.s.v[0] = {3, 0, 0};
  rig.forces = [](state::State& s) { s.f_contact[0] = {-50, 0, 0}; };
  double way = 0.0;
  rig.output = [&](const state::State& s) { way = s.u[0].x; };
  rig.start();
  for (int n = 0; n < 100; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.motions.reaction(0), 50.0, 1e-9);
  }
  EXPECT_NEAR(rig.external, 50.0 * way, 1e-9);
  EXPECT_NEAR(rig.work_motions, 50.0 * way, 1e-9);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-10);
}

}  // namespace
}  // namespace abut::constraints::test
