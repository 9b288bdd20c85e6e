// What an impulse does to nodes that do not move as free points: nodes held in some or all directions, nodes of rigid bodies.
#pragma once

#include <array>
#include <cstddef>

#include "abut/vec3.hpp"

namespace abut::contact {

/// Symmetric 3 by 3 tensor: xx, yy, zz, xy, yz, zx.
struct SymmetricTensor {
  std::array<double, 6> c{};

  [[nodiscard]] Vec3 operator*(const Vec3& b) const {
    return {c[0] * b.x + c[3] * b.y + c[5] * b.z, c[3] * b.x + c[1] * b.y + c[4] * b.z, c[5] * b.x + c[4] * b.y + c[2] * b.z};
  }
  /// Adds s e e^T.
  void add(double s, const Vec3& e) {
    const std::array<double, 6> products{e.x * e.x, e.y * e.y, e.z * e.z, e.x * e.y, e.y * e.z, e.z * e.x};
    for (std::size_t i = 0; i < 6; ++i) c[i] += s * products[i];
  }
};

/// An impulse j at x changes the velocity there by  T j + (R (r x j)) x r,  r = x - centre.
/// A node of mass m held in directions e_k (unit, normal to each other): T = (1 - sum e_k e_k^T)/m, R = 0. A rigid body: T = 1/M,
/// R = inverse of its inertia tensor about `centre`, both reduced to the directions that are free. Zero: what it stands for cannot move.
struct Mobility {
  SymmetricTensor translation;  ///< T, 1/mass
  SymmetricTensor rotation;     ///< R, 1/(mass length^2)
  Vec3 centre;

  [[nodiscard]] bool immobile() const {
    for (std::size_t i = 0; i < 6; ++i) {
      if (translation.c[i] != 0.0 || rotation.c[i] != 0.0) return false;
    }
    return true;
  }
};

}  // namespace abut::contact
