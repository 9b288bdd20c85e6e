// A rigid body of six point masses, and what its tests measure.
#pragma once

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

}  // namespace abut::constraints::test
