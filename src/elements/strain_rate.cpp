#include "elements/strain_rate.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace abut::elements {

namespace {

/// Gradient of a velocity field: column k is dv/dx_k.
using Gradient = std::array<Vec3, 3>;

/// Solves dv/dx from derivatives along three directions: dv_a = sum_k dv/dx_k (dx_a)_k.
bool gradient_of(const std::array<Vec3, 3>& dx, const std::array<Vec3, 3>& dv, Gradient& out) {
  const double det = dot(dx[0], cross(dx[1], dx[2]));
  if (!(std::abs(det) > 0.0)) return false;
  const std::array<Vec3, 3> inverse{cross(dx[1], dx[2]) / det, cross(dx[2], dx[0]) / det, cross(dx[0], dx[1]) / det};
  for (int k = 0; k < 3; ++k) {
    Vec3 sum{};
    for (std::size_t a = 0; a < 3; ++a) sum += inverse[a][k] * dv[a];
    out[static_cast<std::size_t>(k)] = sum;
  }
  return true;
}

double equivalent(const Gradient& g) {
  const double third = (g[0].x + g[1].y + g[2].z) / 3.0;
  const double xx = g[0].x - third, yy = g[1].y - third, zz = g[2].z - third;
  const double xy = 0.5 * (g[1].x + g[0].y), yz = 0.5 * (g[2].y + g[1].z), zx = 0.5 * (g[0].z + g[2].x);
  return std::sqrt(2.0 / 3.0 * (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + zx * zx)));
}

double solid_rate(std::span<const Index> nodes, std::span<const Vec3> x, std::span<const Vec3> v) {
  // Signs of the natural coordinates of the corners (numerics.md 0.5); a tetrahedron's edges from its first node.
  static constexpr int xi[8] = {-1, 1, 1, -1, -1, 1, 1, -1}, eta[8] = {-1, -1, 1, 1, -1, -1, 1, 1}, zeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
  std::array<Vec3, 3> dx{}, dv{};
  const auto at = [&nodes](std::size_t k) { return static_cast<std::size_t>(nodes[k]); };
  if (nodes.size() == 4) {
    for (std::size_t a = 0; a < 3; ++a) {
      dx[a] = x[at(a + 1)] - x[at(0)];
      dv[a] = v[at(a + 1)] - v[at(0)];
    }
  } else {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::array<int, 3> sign{xi[k], eta[k], zeta[k]};
      for (std::size_t a = 0; a < 3; ++a) {
        dx[a] += static_cast<double>(sign[a]) * x[at(k)];
        dv[a] += static_cast<double>(sign[a]) * v[at(k)];
      }
    }
  }
  Gradient g{};
  return gradient_of(dx, dv, g) ? equivalent(g) : 0.0;
}

double shell_rate(std::span<const Index> nodes, double t, std::span<const Vec3> x, std::span<const Vec3> v, std::span<const Vec3> w) {
  const auto at = [&nodes](std::size_t k) { return static_cast<std::size_t>(nodes[k]); };
  // Two directions in the element: diagonals of a quadrilateral, sides of a triangle. Their normal is the frame's.
  const std::size_t a = nodes.size() == 4 ? 2 : 1, b = nodes.size() == 4 ? 3 : 2, from = nodes.size() == 4 ? 1 : 0;
  const Vec3 p = x[at(a)] - x[at(0)], q = x[at(b)] - x[at(from)];
  const Vec3 normal = cross(p, q);
  const double size = norm(normal);
  if (!(size > 0.0)) return 0.0;
  const Vec3 e3 = normal / size, e1 = normalized(p), e2 = cross(e3, e1);
  const auto rates = [&](const Vec3& dp, const Vec3& dq) {  // field derivatives along e1 and e2
    const double px = dot(p, e1), qx = dot(q, e1), qy = dot(q, e2);
    const Vec3 d1 = dp / px;
    return std::array<Vec3, 2>{d1, (dq - qx * d1) / qy};
  };
  const auto square = [](double xx, double yy, double xy) { return xx * xx + yy * yy + xx * yy + 0.25 * xy * xy; };
  const auto dv = rates(v[at(a)] - v[at(0)], v[at(b)] - v[at(from)]);
  const auto dw = rates(w[at(a)] - w[at(0)], w[at(b)] - w[at(from)]);
  const double membrane = square(dot(dv[0], e1), dot(dv[1], e2), dot(dv[0], e2) + dot(dv[1], e1));
  const double bending = square(dot(dw[0], e2), -dot(dw[1], e1), dot(dw[1], e2) - dot(dw[0], e1));
  return std::sqrt(4.0 / 3.0 * membrane + t * t / 9.0 * bending);
}

}  // namespace

double equivalent_strain_rate(const Group& group, Index element, std::span<const Vec3> x, std::span<const Vec3> v,
                              std::span<const Vec3> w) {
  const ElementNodes own = group.nodes(element);
  const std::span<const Index> nodes = own;
  const model::ElementKind kind = group.kind();
  if (kind == model::ElementKind::shell4 || kind == model::ElementKind::shell3) {
    // A quadrilateral with nodes 3 = 4 is a triangle.
    const bool triangle = nodes.size() == 4 && nodes[2] == nodes[3];
    return shell_rate(triangle ? nodes.first(3) : nodes, group.thickness(element), x, v, w);
  }
  return solid_rate(nodes, x, v);
}

}  // namespace abut::elements
