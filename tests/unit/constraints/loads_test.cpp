#include "constraints/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {
namespace {

TEST(Curves, ExtendTheFirstAndLastSegment) {
  model::Model m;
  const Index f = add_function(m, {1, 2, 4}, {10, 20, 0});
  const Index constant = add_function(m, {3}, {7});
  const Curves curves(m);
  EXPECT_DOUBLE_EQ(curves.value(f, 1.5), 15.0);
  EXPECT_DOUBLE_EQ(curves.value(f, 2.0), 20.0);
  EXPECT_DOUBLE_EQ(curves.value(f, 3.0), 10.0);
  EXPECT_DOUBLE_EQ(curves.value(f, 0.0), 0.0);    // slope 10 to the left
  EXPECT_DOUBLE_EQ(curves.value(f, 6.0), -20.0);  // slope -10 to the right
  EXPECT_DOUBLE_EQ(curves.value(constant, -99.0), 7.0);
  EXPECT_DOUBLE_EQ(curves.value(no_index, 5.0), 1.0);
}

TEST(Curves, SensorShiftsTimeAndScalesApply) {
  model::Model m;
  const Index f = add_function(m, {0, 1}, {0, 1});
  m.sensors.push_back({1, 2.0, 5.0});
  const Curves curves(m);
  EXPECT_DOUBLE_EQ(curves.scaled(f, 0, 0.5, 3.0, 3.0), 6.0);  // 3 f((3 - 2) / 0.5)
  EXPECT_FALSE(curves.on(0, 1.999));
  EXPECT_TRUE(curves.on(0, 2.0));
  EXPECT_FALSE(curves.on(0, 5.0));
}

// numerics.md 9, item 1: K = m = 1, h = 0.1. Leap-frog's own solution from u = 0, v = 1 is u_n = h sin(n w h) / sin(w h) with
// sin(w h / 2) = h / 2; the energy T + K u^2 / 2 stays within O(h^2).
TEST(LeapFrog, OscillatorHasItsDiscreteFrequencyAndBoundedEnergy) {
  Rig rig(nodes_at({{0, 0, 0}}));
  rig.s.v[0] = {1, 0, 0};
  rig.forces = [](state::State& s) { s.f_contact[0] = -s.u[0]; };
  double worst = 0.0;
  rig.output = [&](const state::State& s) {
    const Vec3 v = s.v[0] + 0.5 * s.times.h_minus * s.a[0];
    worst = std::max(worst, std::fabs(0.5 * squared_norm(v) + 0.5 * squared_norm(s.u[0]) - 0.5));
  };
  rig.start();
  const double h = 0.1, w = 2.0 / h * std::asin(h / 2.0);
  for (int n = 1; n <= 1000; ++n) {
    rig.step(h);
    ASSERT_NEAR(rig.s.u[0].x, h * std::sin(n * w * h) / std::sin(w * h), 1e-11) << n;
  }
  EXPECT_LT(worst, 0.5 * h * h);
  EXPECT_GT(worst, 0.0);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

// numerics.md 9, item 2, and F dx: a constant force F on a mass m. T* + the work of the ledger agree at every cycle.
TEST(Loads, ConstantForceKicksByHalfFirstAndDoesForceTimesDistance) {
  auto m = nodes_at({{0, 0, 0}});
  m.concentrated_loads.push_back({.id = 1, .direction = 1, .scale_y = 6.0, .nodes = {0}});
  Rig rig(m, 2.0);
  double booked_at = 0.0, displacement_at = 0.0;
  rig.output = [&](const state::State& s) { displacement_at = s.u[0].y; };
  rig.start();
  const double h = 0.01, a = 3.0;
  rig.step(h);
  EXPECT_DOUBLE_EQ(rig.s.v[0].y, 0.5 * h * a);
  EXPECT_DOUBLE_EQ(rig.s.u[0].y, 0.5 * h * h * a);
  for (int n = 2; n <= 100; ++n) {
    rig.step(h);
    ASSERT_NEAR(rig.s.u[0].y, 0.5 * a * n * h * n * h, 1e-13);
  }
  booked_at = rig.external;  // last booked with v and h_+ of the last cycle: F u at t^n for a constant step
  EXPECT_NEAR(booked_at, 6.0 * displacement_at, 1e-12);
  EXPECT_NEAR(rig.work_loads, rig.kinetic, 1e-12);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

// The reference's booking: pair of F at t^n and t^n - h_-, v at entry, times h_+ (numerics.md 1.6.4).
TEST(Loads, ReferenceWorkUsesTheFollowingStep) {
  auto m = nodes_at({{0, 0, 0}});
  const Index ramp = add_function(m, {0, 1}, {0, 10});
  m.concentrated_loads.push_back({.id = 1, .function = ramp, .direction = 0, .nodes = {0}});
  Rig rig(m);
  rig.s.v[0] = {3, 0, 0};
  rig.start();
  rig.step(0.1);
  EXPECT_DOUBLE_EQ(rig.external, 0.0);
  const double v = rig.s.v[0].x;
  rig.step(0.05);
  EXPECT_NEAR(rig.external, 0.5 * (0.0 + 1.0) * v * 0.05, 1e-15);
}

TEST(Loads, MomentActsOnRotationInASkew) {
  auto m = nodes_at({{0, 0, 0}});
  m.skews.push_back({.id = 1, .axes = {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}});
  m.concentrated_loads.push_back({.id = 1, .direction = 3, .skew = 0, .scale_y = 4.0, .nodes = {0}});
  Rig rig(m, 1.0, 2.0);
  rig.start();
  for (int n = 0; n < 10; ++n) rig.step(0.1);
  EXPECT_NEAR(rig.s.w[0].y, 2.0 * 0.95, 1e-14);  // (n - 1/2) h M / I
  EXPECT_EQ(rig.s.w[0].x, 0.0);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
}

// Free fall from rest at constant step is exact in leap-frog; the booked work is m g times the way, both bookings.
TEST(Gravity, FreeFall) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}});
  m.gravities.push_back({.id = 1, .direction = 2, .scale_y = -9.81, .nodes = {0, 1}});
  Rig rig(m, 3.0);
  double way = 0.0;
  rig.output = [&](const state::State& s) { way = s.u[0].z; };
  rig.start();
  for (int n = 0; n < 200; ++n) rig.step(0.005);
  EXPECT_NEAR(rig.s.u[0].z, -0.5 * 9.81, 1e-12);
  EXPECT_NEAR(rig.external, 2 * 3.0 * -9.81 * way, 1e-10);
  EXPECT_NEAR(rig.work_gravity, rig.kinetic, 1e-10);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-11);
}

TEST(Pressure, ResultantIsPressureTimesAreaAlongTheNormal) {
  auto m = nodes_at({{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {5, 0, 0}, {7, 0, 0}, {5, 4, 0}});
  m.pressure_loads.push_back({.id = 1, .scale_y = 10.0, .segments = {{0, 1, 2, 3}, {4, 5, 6, 6}}});
  Rig rig(m);
  rig.loads.apply(rig.s);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rig.s.f_external[i], (Vec3{0, 0, 15.0}));
  for (std::size_t i = 4; i < 7; ++i) EXPECT_NEAR(rig.s.f_external[i].z, 40.0 / 3.0, 1e-13);
}

// A closed surface feels no resultant force and no resultant moment; a hexahedron with warped faces.
TEST(Pressure, ClosedSurfaceHasNoResultant) {
  auto m = nodes_at({{0, 0, 0}, {1.1, 0.1, 0}, {1, 1.2, 0.1}, {0, 1, -0.2}, {0, 0.1, 1}, {1, 0, 1.3}, {1.2, 1, 1}, {0.1, 1, 0.9}});
  m.pressure_loads.push_back(
      {.id = 1, .scale_y = 7.0, .segments = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}});
  Rig rig(m);
  rig.loads.apply(rig.s);
  Vec3 force{};
  double size = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    force += rig.s.f_external[i];
    size += norm(rig.s.f_external[i]);
  }
  EXPECT_LT(norm(force), 1e-14 * size);
  EXPECT_GT(size, 1.0);
}

TEST(Pressure, WorkOverAWay) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  m.pressure_loads.push_back({.id = 1, .scale_y = 8.0, .segments = {{0, 1, 2, 3}}});
  Rig rig(m);
  double way = 0.0;
  rig.output = [&](const state::State& s) { way = s.u[0].z; };
  rig.start();
  for (int n = 0; n < 100; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.external, 8.0 * way, 1e-12);  // p A u
  EXPECT_NEAR(rig.work_loads, rig.kinetic, 1e-12);
}

// Steps that change from cycle to cycle: the ledger closes to rounding all the same.
TEST(Ledger, ClosesForAnySequenceOfSteps) {
  auto m = nodes_at({{0, 0, 0}});
  const Index wave = add_function(m, {0, 0.3, 0.7, 1.5}, {0, 4, -3, 9});
  m.concentrated_loads.push_back({.id = 1, .function = wave, .direction = 0, .nodes = {0}});
  m.gravities.push_back({.id = 1, .function = wave, .direction = 1, .nodes = {0}});
  Rig rig(m, 0.7);
  rig.s.v[0] = {0.3, -0.2, 0.9};
  rig.forces = [](state::State& s) { s.f_contact[0] = -30.0 * s.u[0]; };
  rig.start();
  for (int n = 0; n < 300; ++n) {
    rig.step(0.004 * (1.0 + 0.6 * std::sin(1.7 * n)));
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-12) << n;
  }
  EXPECT_GT(std::fabs(rig.work_loads), 0.1);
}

}  // namespace
}  // namespace abut::constraints::test
