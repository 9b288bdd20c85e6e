// What a rigid body answers to impulses, springs and added mass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "constraints/body_frequency.hpp"
#include "constraints/rigid_bodies.hpp"
#include "unit/constraints/bodies.hpp"

namespace abut::constraints::test {
namespace {

// An impulse on a node of a body changes that node's velocity by response(), and push() gives the accelerations that do it.
TEST(RigidBody, ResponseIsTheVelocityThatAnImpulseGives) {
  auto m = body_of_points();
  m.boundary_conditions.push_back({.id = 1, .translation = {false, true, false}, .rotation = {true, false, false}, .nodes = {0}});
  for (const bool pushed : {false, true}) {
    Rig rig(m);
    set_masses(rig.s);
    rig.start();
    RigidBodies::Carrier carrier{4, 0, 0, rig.conditions.held(0, false), rig.conditions.held(0, true)};
    const Vec3 impulse{1e-6, 2e-6, -1e-6};
    const Vec3 expected = rig.bodies.response(rig.s, carrier, impulse);
    EXPECT_EQ(carrier.translation.count, 1);
    EXPECT_EQ(carrier.rotation.count, 1);
    expect_response(rig, carrier, impulse, expected, pushed);
  }
}

/// Largest omega^2 of a body with a spring k_i on each node (others held), by power iteration on its six degrees of freedom.
double frequency_squared(const Rig& rig, const std::vector<double>& k) {
  Vec3 v{0.3, -0.8, 0.5}, w{-0.2, 0.6, 0.7};
  double omega2 = 0.0;
  for (int n = 0; n < 20000; ++n) {
    Vec3 force{}, torque{};
    for (std::size_t i = 0; i < k.size(); ++i) {
      const Vec3 r = rig.s.x[i] - rig.s.x[0];
      const Vec3 f = k[i] * (v + cross(w, r));
      force += f;
      torque += cross(r, f);
    }
    const RigidBodies::Carrier centre{0, 0, 0, {}, {}};
    v = rig.bodies.response(rig.s, centre, force);
    const auto& inertia = rig.bodies.inertia(0);
    w = {};
    for (std::size_t a = 0; a < 3; ++a) w += dot(inertia.axes[a], torque) / inertia.principal[a] * inertia.axes[a];
    omega2 = std::sqrt(squared_norm(v) + squared_norm(w));
    v = v / omega2;
    w = w / omega2;
  }
  return omega2;
}

// The stiffnesses that the main node gets bound the body's frequency, which largest_rate() does by at most 12 %: K/M and K r^2/J, each on
// its own, miss that one spring moves and turns the body. They are not less than K r^2/J with the least inertia and r^2 about every axis.
TEST(RigidBody, GatheredStiffnessBoundsTheFrequency) {
  const std::vector<std::vector<double>> springs{{0, 0, 0, 5, 0, 0}, {0, 2, 2, 2, 2, 2}, {7, 0, 0, 0, 0, 1}, {0, 1, 0, 9, 0, 4}};
  for (const std::vector<double>& k : springs) {
    Rig rig(body_of_points());
    set_masses(rig.s);
    rig.start();
    for (std::size_t i = 0; i < k.size(); ++i) rig.s.stiffness[i] = k[i];
    const double exact = frequency_squared(rig, k);
    rig.bodies.gather(rig.s, rig.conditions);
    const double bound = rig.s.stiffness[0] / rig.s.mass[0];
    EXPECT_NEAR(rig.s.rotational_stiffness[0] / rig.s.inertia[0], bound, 1e-12 * bound);
    BodySprings together;
    double about_all_axes = 0.0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      together.add(rig.s.x[i] - rig.s.x[0], k[i], 0.0);
      about_all_axes += k[i] * squared_norm(rig.s.x[i] - rig.s.x[0]);
    }
    const double rate = largest_rate(together, rig.s.mass[0], rig.bodies.inertia(0));
    EXPECT_GE(rate, exact * (1.0 - 1e-12));
    EXPECT_LE(rate, 1.119 * exact);
    EXPECT_NEAR(bound, std::max(rate, about_all_axes / rig.s.inertia[0]), 1e-12 * bound);
  }
}

// Equal springs at equal arms on a sphere: six equal frequencies, the largest distance of the bound.
TEST(RigidBody, BoundOfEqualFrequencies) {
  BodySprings springs;
  for (const Vec3& r : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
    springs.add(r, 2.0, 0.0);
  }
  const RigidBodies::Inertia inertia{3.0, {2.0, 2.0, 2.0}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  EXPECT_NEAR(largest_rate(springs, 3.0, inertia), 4.0 * std::pow(6.0, 1.0 / 16.0), 1e-13);  // 12/3 and 8/2
  springs = {};
  springs.add({0, 2, 0}, 3.0, 0.0);  // 3 (1/3 + 4/2)
  EXPECT_NEAR(largest_rate(springs, 3.0, inertia), 7.0 * std::pow(2.0 + std::pow(1.0 / 7.0, 16), 1.0 / 16.0), 1e-12);
}

// Mass scaling of a spinning body: mass and tensor grow, what follows turns by the inertia that the main node states, and the ledger
// closes with the energy that came.
TEST(RigidBody, AddedMassEntersMassAndTensor) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.s.v[0] = {0.5, -1.0, 0.2};
  rig.s.w[0] = {0.4, 1.0, -0.3};
  rig.start();
  double brought = 0.0;
  rig.scaling = [&](state::State& s) {
    if (s.times.cycle != 3 && s.times.cycle != 7) return;
    brought += rig.bodies.scale_inertia(0, 1.7, s) + 0.5 * 0.9 * squared_norm(s.v[0]);
    s.mass[0] += 0.9;
    rig.bodies.add_mass(0, 0.9);
  };
  const double mass = rig.s.mass[0], inertia = rig.s.inertia[0];
  const Vec3 axis = rig.bodies.inertia(0).axes[1];
  const Vec3 before = rig.bodies.times_inertia(0, axis);
  for (int n = 0; n < 20; ++n) {
    rig.step(0.002 * uneven(n));
    ASSERT_NEAR(rig.ledger() - brought, 0.0, 1e-13) << n;
  }
  EXPECT_NEAR(rig.s.mass[0], mass + 1.8, 1e-14);
  EXPECT_NEAR(rig.bodies.inertia(0).mass, mass + 1.8, 1e-14);
  EXPECT_NEAR(rig.s.inertia[0], 1.7 * 1.7 * inertia, 1e-14);
  EXPECT_NEAR(norm(rig.bodies.times_inertia(0, rig.bodies.inertia(0).axes[1])), 1.7 * 1.7 * norm(before), 1e-13);
  const double h = 1e-5;
  for (int n = 0; n < 2; ++n) rig.step(h);
  const Vec3 velocity = rig.s.v[0], spin = angular_momentum(rig), torque{400.0, 0, -200.0};
  rig.forces = [&](state::State& s) { s.m_internal[0] = -torque; };
  for (int n = 0; n < 20; ++n) rig.step(h);
  EXPECT_EQ(rig.s.v[0], velocity);
  EXPECT_LT(norm(angular_momentum(rig) - spin - 20.0 * h * torque), 2e-3 * norm(20.0 * h * torque));
}

// An impulse on a node of a body changes that node's velocity as the body's answer says, whatever holds the main node.
TEST(RigidBody, AnswerToAnImpulse) {
  using Six = std::array<bool, 3>;
  const std::vector<std::array<Six, 2>> cases{{Six{}, Six{}},
                                              {Six{true, false, false}, Six{}},
                                              {Six{true, true, false}, Six{false, false, true}},
                                              {Six{true, true, true}, Six{true, false, true}},
                                              {Six{true, true, true}, Six{true, true, true}}};
  for (const auto& [translation, rotation] : cases) {
    auto m = body_of_points();
    m.boundary_conditions.push_back({1, translation, rotation, no_index, {m.rigid_bodies[0].main}});
    Rig rig(m);
    set_masses(rig.s);
    rig.start();
    const Index main = m.rigid_bodies[0].main;
    const auto response = rig.bodies.answer(rig.s, 0, rig.conditions.held(main, false), rig.conditions.held(main, true));
    const Vec3 d = normalized(Vec3{1, 2, -1});
    const Vec3 expected = response.velocity(rig.s.x[4], rig.s.x[4], d);
    rig.forces = [&](state::State& s) { s.f_contact[4] = d; };
    rig.step(1e-6);
    EXPECT_LT(norm(rig.s.v[4] / 0.5e-6 - expected), 1e-6 * (norm(expected) + 1e-3));
  }
}

}  // namespace
}  // namespace abut::constraints::test
