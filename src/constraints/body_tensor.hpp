// Products with the inertia tensor of a rigid body, J = sum_k J_k e_k e_k.
#pragma once

#include <cmath>
#include <cstddef>

#include "constraints/boundary_conditions.hpp"
#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

inline Vec3 times(const RigidBodies::Inertia& inertia, const Vec3& b) {
  Vec3 sum{};
  for (std::size_t k = 0; k < 3; ++k) sum += inertia.principal[k] * dot(inertia.axes[k], b) * inertia.axes[k];
  return sum;
}

/// J^-1 b on the span of the axes with an inertia.
inline Vec3 times_inverse(const RigidBodies::Inertia& inertia, const Vec3& b) {
  Vec3 sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (inertia.principal[k] > 0.0) sum += dot(inertia.axes[k], b) / inertia.principal[k] * inertia.axes[k];
  }
  return sum;
}

/// J alpha = rhs for the components of alpha that are not held.
inline Vec3 solve_free(const RigidBodies::Inertia& inertia, const Vec3& rhs, const BoundaryConditions::Held& held) {
  if (held.count == 0) return times_inverse(inertia, rhs);
  if (held.count == 3) return {};
  if (held.count == 2) {
    const Vec3 e = cross(held.axis[0], held.axis[1]);
    const double j = dot(e, times(inertia, e));
    return j > 0.0 ? dot(e, rhs) / j * e : Vec3{};
  }
  const Vec3 h = held.axis[0];
  const Vec3 e1 = normalized(std::fabs(h.x) < 0.6 ? cross(h, Vec3{1, 0, 0}) : cross(h, Vec3{0, 1, 0}));
  const Vec3 e2 = cross(h, e1);
  const Vec3 j1 = times(inertia, e1), j2 = times(inertia, e2);
  const double j11 = dot(e1, j1), j12 = dot(e1, j2), j22 = dot(e2, j2);
  const double det = j11 * j22 - j12 * j12;
  if (det <= 0.0) return {};
  const double r1 = dot(e1, rhs), r2 = dot(e2, rhs);
  return (j22 * r1 - j12 * r2) / det * e1 + (j11 * r2 - j12 * r1) / det * e2;
}

}  // namespace abut::constraints
