// A three-component vector: the value type of every public interface of abut.
#pragma once

#include <cmath>

namespace abut {

/// Three doubles, tightly packed: an array of Vec3 is an array of #N by 3 doubles, row-major.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  [[nodiscard]] constexpr double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }

  constexpr Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  constexpr Vec3& operator*=(double s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  constexpr bool operator==(const Vec3&) const = default;
};
static_assert(sizeof(Vec3) == 3 * sizeof(double));

[[nodiscard]] constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
[[nodiscard]] constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
[[nodiscard]] constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
[[nodiscard]] constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
[[nodiscard]] constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
[[nodiscard]] constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double squared_norm(const Vec3& a) { return dot(a, a); }
[[nodiscard]] inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// @return a / |a|; the zero vector stays zero.
[[nodiscard]] inline Vec3 normalized(const Vec3& a) {
  const double n = norm(a);
  return n > 0.0 ? a / n : Vec3{};
}

}  // namespace abut
