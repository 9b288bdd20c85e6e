// Finite rotations and 3 x 3 symmetric tensors of rigid bodies; + - * / sqrt only, so that the bits do not depend on libm.
#pragma once

#include <array>

#include "abut/vec3.hpp"

namespace abut::constraints {

/// R r - r for the rotation vector `angle` (radians, right-hand rule): Rodrigues' formula with sin(t)/t and (1 - cos t)/t^2
/// as power series, accurate to 1e-16 relative for |angle| <= 1.
[[nodiscard]] inline Vec3 chord(const Vec3& r, const Vec3& angle) {
  const double t2 = squared_norm(angle);
  double s = 1.0, c = 1.0;
  for (int k = 9; k >= 1; --k) {
    s = 1.0 - s * t2 / ((2.0 * k) * (2.0 * k + 1.0));
    c = 1.0 - c * t2 / ((2.0 * k + 1.0) * (2.0 * k + 2.0));
  }
  c *= 0.5;
  const Vec3 u = cross(angle, r);
  return s * u + c * cross(angle, u);
}

/// r turned by `angle`.
[[nodiscard]] inline Vec3 rotated(const Vec3& r, const Vec3& angle) { return r + chord(r, angle); }

/// Symmetric tensor xx yy zz xy yz zx.
using Symmetric = std::array<double, 6>;

[[nodiscard]] inline Vec3 times(const Symmetric& a, const Vec3& b) {
  return {a[0] * b.x + a[3] * b.y + a[5] * b.z, a[3] * b.x + a[1] * b.y + a[4] * b.z, a[5] * b.x + a[4] * b.y + a[2] * b.z};
}

/// m (|r|^2 1 - r r): inertia of a point mass at r.
inline void add_point_mass(Symmetric& j, double m, const Vec3& r) {
  j[0] += m * (r.y * r.y + r.z * r.z);
  j[1] += m * (r.z * r.z + r.x * r.x);
  j[2] += m * (r.x * r.x + r.y * r.y);
  j[3] -= m * r.x * r.y;
  j[4] -= m * r.y * r.z;
  j[5] -= m * r.z * r.x;
}

/// Principal values and right-handed orthonormal axes of a symmetric tensor (cyclic Jacobi).
void diagonalise(const Symmetric& a, std::array<double, 3>& values, std::array<Vec3, 3>& axes);

}  // namespace abut::constraints
