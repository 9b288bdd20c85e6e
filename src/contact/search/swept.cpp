#include "contact/search/swept.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

struct MovingTriangle {
  std::array<Vec3, 3> before, after;
  Vec3 x_before, x_after;

  [[nodiscard]] static Vec3 blend(const Vec3& a, const Vec3& b, double u) { return a + u * (b - a); }
  // Six times the volume of node and triangle: > 0 in front.
  [[nodiscard]] double side(double u) const {
    const Vec3 a = blend(before[0], after[0], u);
    return dot(cross(blend(before[1], after[1], u) - a, blend(before[2], after[2], u) - a), blend(x_before, x_after, u) - a);
  }
  [[nodiscard]] bool inside(double u) const {
    const Vec3 a = blend(before[0], after[0], u);
    const Vec3 b = blend(before[1], after[1], u);
    const Vec3 c = blend(before[2], after[2], u);
    const Vec3 x = blend(x_before, x_after, u);
    const Vec3 n = cross(b - a, c - a);
    const double all = squared_norm(n);
    const double tolerance = -1e-9 * all;  // neighbours overlap rather than leave a slit
    return all > 0.0 && dot(cross(b - a, x - a), n) >= tolerance && dot(cross(c - b, x - b), n) >= tolerance &&
           dot(cross(a - c, x - c), n) >= tolerance;
  }
};

// First passage from >= 0 to < 0 of the cubic in [0, 1], inside the triangle.
Crossing first_crossing(const MovingTriangle& m) {
  // Cubic through four values: monotone between 0, the roots of its derivative, and 1.
  const double f0 = m.side(0.0), f1 = m.side(1.0 / 3.0), f2 = m.side(2.0 / 3.0), f3 = m.side(1.0);
  const double c1 = -5.5 * f0 + 9.0 * f1 - 4.5 * f2 + f3;
  const double c2 = 9.0 * f0 - 22.5 * f1 + 18.0 * f2 - 4.5 * f3;
  const double c3 = -4.5 * f0 + 13.5 * f1 - 13.5 * f2 + 4.5 * f3;
  std::array<double, 4> knot{0.0, 1.0, 1.0, 1.0};
  std::size_t knots = 1;
  const double qa = 3.0 * c3, qb = 2.0 * c2, qc = c1;
  const double disc = qb * qb - 4.0 * qa * qc;
  if (disc > 0.0) {
    const double q = -0.5 * (qb + (qb >= 0.0 ? std::sqrt(disc) : -std::sqrt(disc)));
    double r1 = qa != 0.0 ? q / qa : 2.0;
    double r2 = q != 0.0 ? qc / q : 2.0;
    if (r1 > r2) std::swap(r1, r2);
    if (r1 > 0.0 && r1 < 1.0) knot[knots++] = r1;
    if (r2 > 0.0 && r2 < 1.0) knot[knots++] = r2;
  }
  knot[knots] = 1.0;
  for (std::size_t k = 0; k < knots; ++k) {
    double low = knot[k], high = knot[k + 1];
    if (!(m.side(low) >= 0.0 && m.side(high) < 0.0)) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (m.side(middle) >= 0.0 ? low : high) = middle;
    }
    if (m.inside(low) || m.inside(high)) return {true, high};
  }
  return {};
}

}  // namespace

Crossing crosses(const Patch& before, const Vec3& x_before, const Patch& after, const Vec3& x_after) {
  constexpr std::array<std::array<std::size_t, 3>, 4> split{{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
  Crossing first;
  for (std::size_t k = 0; k < (before.triangle ? 1u : 4u); ++k) {
    MovingTriangle m{{}, {}, x_before, x_after};
    for (std::size_t i = 0; i < 3; ++i) {
      m.before[i] = before.x[split[k][i]];
      m.after[i] = after.x[split[k][i]];
    }
    const Crossing one = first_crossing(m);
    if (one.crossed && (!first.crossed || one.fraction < first.fraction)) first = one;
  }
  return first;
}

}  // namespace abut::contact
