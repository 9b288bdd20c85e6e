// Largest frequency of a rigid body on springs: what its main node tells the time step.
//
// Springs K_I at arms r_I and rotational springs K^r_I act on the motion (v, w) of the body with 1/2 sum K_I |v + w x r_I|^2 +
// 1/2 sum K^r_I |w|^2. In the body's principal axes, divided by M and J_k, this is a symmetric 6 x 6 matrix A >= 0:
//   A_ij = (sum K_I)/M d_ij,  A_i,3+j = e_ijk (sum K_I r_I)_k / sqrt(M J_j),
//   A_3+j,3+k = [sum K_I (|r_I|^2 d_jk - r_j r_k) + sum K^r_I d_jk] / sqrt(J_j J_k).
// The nodal step takes 1/2 h^2 K <= m, with the factor of Gerschgorin in K; the body's turn is 1/2 h^2 lambda_max(A) <= 1.
// K/M and K^r/J each on its own would miss up to a factor of two: a spring beside the centre moves and turns the body.
#pragma once

#include "abut/vec3.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rotation.hpp"

namespace abut::constraints {

struct BodySprings {
  double translation = 0.0;  ///< sum K_I
  Vec3 first;                ///< sum K_I r_I
  Symmetric second{};        ///< sum K_I (|r|^2 1 - r r) + K^r_I 1

  void add(const Vec3& r, double k, double rotational) {
    translation += k;
    first += k * r;
    add_point_mass(second, k, r);
    for (std::size_t d = 0; d < 3; ++d) second[d] += rotational;
  }
};

/// A bound of lambda_max(A) that is at most 12 % above it: (trace A^16)^(1/16), 6^(1/16) = 1.119. Exact where one frequency
/// stands out. Axes without inertia are left out.
[[nodiscard]] double largest_rate(const BodySprings& springs, double mass, const RigidBodies::Inertia& inertia);

}  // namespace abut::constraints
