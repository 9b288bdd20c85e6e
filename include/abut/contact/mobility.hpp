// How nodes answer to impulses that do not move as free points: held in some or all directions, or part of a rigid body.
#pragma once

#include <array>
#include <cstddef>

#include "abut/vec3.hpp"

namespace abut::contact {

/// Symmetric 3 by 3 tensor A (xx, yy, zz, xy, yz, zx), 1/mass: an impulse j changes the node's velocity by A j.
/// A node of mass m held in directions e_k (unit, normal to each other): (1 - sum e_k e_k^T)/m. Zero: it cannot move.
/// A node of a rigid body: alone in contact 1/M - [r] J^-1 [r] with [r] the matrix of r x. Springs that act on one body together each
/// move its share of the mass: where the host knows the contact stiffness K_i on the body's nodes, sum K/K_i times as much, the second r
/// taken to the point sum K_i r_i / sum K, with `stiffness` saying K_i.
struct Mobility {
  std::array<double, 6> a{};
  /// Stiffness of all springs on the node that a counts as acting together; 0: of none, one pair alone.
  double stiffness = 0.0;

  [[nodiscard]] Vec3 operator*(const Vec3& b) const {
    return {a[0] * b.x + a[3] * b.y + a[5] * b.z, a[3] * b.x + a[1] * b.y + a[4] * b.z, a[5] * b.x + a[4] * b.y + a[2] * b.z};
  }
  /// Adds s e e^T.
  void add(double s, const Vec3& e) {
    const std::array<double, 6> products{e.x * e.x, e.y * e.y, e.z * e.z, e.x * e.y, e.y * e.z, e.z * e.x};
    for (std::size_t i = 0; i < 6; ++i) a[i] += s * products[i];
  }
  [[nodiscard]] bool immobile() const { return a == std::array<double, 6>{}; }
};

}  // namespace abut::contact
