// Rigid bodies whose main node stays beside the centre of gravity: ICoG 3, and switched on by a sensor.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constraints/rigid_bodies.hpp"
#include "unit/constraints/bodies.hpp"

namespace abut::constraints::test {
namespace {

// Linear and angular momentum, about the origin, and energy of point masses with inertia.
struct Invariants {
  Vec3 linear, angular;
  double energy = 0.0;
};
Invariants invariants(const state::State& s, const std::vector<double>& mass, double inertia) {
  Invariants sum;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    sum.linear += mass[i] * s.v[i];
    sum.angular += mass[i] * cross(s.x[i], s.v[i]) + inertia * s.w[i];
    sum.energy += 0.5 * (mass[i] * squared_norm(s.v[i]) + inertia * squared_norm(s.w[i]));
  }
  return sum;
}

// The main node is beside the centre of gravity: it is one more point of a free body, whose nodes keep their linear momentum and whose
// energy and angular momentum about its centre stay, at any sequence of steps.
TEST(RigidBody, FreeBodyBesideItsCentreKeepsMomentumAndEnergy) {
  Rig rig(body_of_points(3), 1.0, 0.02);
  set_masses(rig.s);
  const std::vector<double> mass(rig.s.mass.begin(), rig.s.mass.end());
  rig.s.v[0] = {0.3, -0.2, 0.5};
  rig.s.w[0] = {2.0, -1.0, 3.0};
  rig.start();
  double total = 0.0;
  for (const double m : mass) total += m;
  EXPECT_NEAR(rig.s.mass[0], total, 1e-14);
  EXPECT_EQ(rig.s.x[0], cloud[0]);
  const Invariants first = invariants(rig.s, mass, 0.02);
  const double arm = norm(rig.s.x[3] - rig.s.x[0]);
  const auto energy = [&] {
    const Vec3 centre = rig.s.v[0] - rig.bodies.relative_velocity(0);
    return 0.5 * total * squared_norm(centre) + 0.5 * dot(rig.s.w[0], rig.bodies.times_inertia(0, rig.s.w[0]));
  };
  EXPECT_NEAR(energy(), first.energy, 1e-13 * first.energy);
  const double spin = norm(rig.bodies.times_inertia(0, rig.s.w[0]));
  for (int n = 0; n < 2000; ++n) {
    rig.step(0.01 * uneven(n));
    const Invariants now = invariants(rig.s, mass, 0.02);
    ASSERT_LT(norm(now.linear - first.linear), 1e-12) << n;
    ASSERT_NEAR(energy(), first.energy, 1e-12 * first.energy) << n;
    ASSERT_NEAR(norm(rig.bodies.times_inertia(0, rig.s.w[0])), spin, 1e-12 * spin) << n;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-11) << n;
    ASSERT_NEAR(norm(rig.s.x[3] - rig.s.x[0]), arm, 1e-11) << n;
  }
}

// Gravity acts on the mass: a body that does not turn falls without turning, whichever node is the main one; work m g h.
TEST(RigidBody, BesideItsCentreFallsWithoutTurning) {
  auto m = body_of_points(3);
  m.gravities.push_back({});
  m.gravities[0].direction = 2;
  m.gravities[0].scale_y = -10.0;
  for (Index i = 0; i < 6; ++i) m.gravities[0].nodes.push_back(i);
  Rig rig(m);
  set_masses(rig.s);
  rig.start();
  const double height = rig.s.x[4].z;
  for (int n = 0; n < 100; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-14 * (1.0 + rig.kinetic)) << n;
  }
  EXPECT_LT(norm(rig.s.w[0]), 1e-14);
  EXPECT_NEAR(height - rig.s.x[4].z, 0.5 * 10.0 * 1.0, 1e-12);
  EXPECT_NEAR(rig.work_gravity, rig.kinetic, 1e-11);
}

// Switched on by a sensor beside its centre of gravity: velocity and turn follow from the momentum and the angular momentum of the
// nodes, the energy that is lost is that of the plastic impact, P.P / 2M + L.J^-1 L / 2, and none is made afterwards.
TEST(RigidBody, SensorSwitchesOnBesideTheCentre) {
  auto m = body_of_points();
  m.sensors.push_back({1, 0.095, 1e30});
  m.rigid_bodies[0].sensor = 0;
  Rig rig(m, 1.0, 0.05);
  set_masses(rig.s);
  const std::vector<double> mass(rig.s.mass.begin(), rig.s.mass.end());
  for (std::size_t i = 0; i < 6; ++i) rig.s.v[i] = {std::sin(3.0 * static_cast<double>(i)), 0.4, std::cos(2.0 * static_cast<double>(i))};
  rig.s.w[2] = {0.5, 0, 1};
  rig.start();
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  ASSERT_EQ(rig.bodies.body_of(3), no_index);
  const Invariants before = invariants(rig.s, mass, 0.05);
  const std::vector<Vec3> x(rig.s.x.begin(), rig.s.x.end());
  double total = 0.0;
  Vec3 centre{};
  for (std::size_t i = 0; i < 6; ++i) {
    total += mass[i];
    centre += mass[i] * x[i];
  }
  centre = centre / total;
  rig.output = [&, once = false](const state::State& s) mutable {
    if (once) return;
    once = true;
    const Invariants now = invariants(s, mass, 0.05);
    EXPECT_LT(norm(now.linear - before.linear), 1e-13);
    EXPECT_LT(norm(now.angular - before.angular), 1e-13);
    EXPECT_LT(now.energy, before.energy);
    const Vec3 spin = before.angular - cross(centre, before.linear);
    const double turning = 0.5 * dot(spin, s.w[0]);  // w = J^-1 L
    EXPECT_NEAR(now.energy, 0.5 * squared_norm(before.linear) / total + turning, 1e-12);
    EXPECT_LT(norm(rig.bodies.times_inertia(0, s.w[0]) - spin), 1e-12);
  };
  rig.step(0.01);
  ASSERT_EQ(rig.bodies.body_of(3), 0);
  EXPECT_GT(norm(rig.s.x[0] - centre), 0.1);
  const auto energy = [&] {
    const Vec3 velocity = rig.s.v[0] - rig.bodies.relative_velocity(0);
    return 0.5 * total * squared_norm(velocity) + 0.5 * dot(rig.s.w[0], rig.bodies.times_inertia(0, rig.s.w[0]));
  };
  const double kinetic = energy();
  for (int n = 0; n < 1000; ++n) {
    rig.step(0.01 * uneven(n));
    ASSERT_NEAR(energy(), kinetic, 1e-12 * kinetic) << n;
    ASSERT_LT(norm(invariants(rig.s, mass, 0.05).linear - before.linear), 1e-12) << n;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-11) << n;
  }
}

}  // namespace
}  // namespace abut::constraints::test
