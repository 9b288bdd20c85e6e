// A rigid body of six point masses, and what its tests measure.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {

inline const std::vector<Vec3> cloud{{0.2, -0.1, 0.3}, {1, 0, 0}, {-0.8, 0.3, 0.1}, {0.1, 1.2, -0.4}, {0.3, -0.9, 0.5}, {0, 0.2, 0.9}};

inline model::RigidBody card(Id id, Index main, std::vector<Index> nodes, int ispher = 2) {
  model::RigidBody body;
  body.id = id;
  body.main = main;
  body.nodes = std::move(nodes);
  body.ispher = ispher;
  return body;
}

inline model::Model body_of_points(int icog = 1, int ispher = 3) {
  auto m = nodes_at(cloud);
  model::RigidBody body = card(9, 0, {1, 2, 3, 4, 5}, ispher);
  body.icog = icog;
  m.rigid_bodies.push_back(body);
  return m;
}

inline void set_masses(state::State& s) {
  for (std::size_t i = 0; i < s.mass.size(); ++i) s.mass[i] = 0.5 + 0.3 * static_cast<double>(i);
}

/// Factors between 0.5 and 1.5 on a step: no two neighbours alike.
inline double uneven(int n) { return 1.0 + 0.5 * std::sin(2.7 * n); }

inline Vec3 angular_momentum(const Rig& rig) {
  const auto main = static_cast<std::size_t>(rig.model.rigid_bodies[0].main);
  return rig.bodies.times_inertia(0, rig.s.w[main]);
}

/// An impulse on node 4 changes its velocity to `expected`: given at once, or as a contact force in cycle 0.
inline void expect_response(Rig& rig, const RigidBodies::Carrier& carrier, const Vec3& impulse, const Vec3& expected, bool at_once) {
  if (at_once) {
    rig.s.times.h_bar = 0.5;
    rig.s.times.h_plus = 1.0;
    rig.bodies.push(rig.s, carrier, impulse);
    EXPECT_LT(norm(rig.bodies.next_velocity(rig.s, carrier) - expected), 1e-5 * norm(expected));
  } else {
    rig.forces = [impulse](state::State& s) { s.f_contact[4] = 2.0 * impulse; };  // cycle 0 kicks by half a step
    rig.step(1.0);
    EXPECT_LT(norm(rig.s.v[4] - expected), 1e-5 * norm(expected));
  }
}

}  // namespace abut::constraints::test
