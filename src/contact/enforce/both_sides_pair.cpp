#include "contact/enforce/both_sides_pair.hpp"

#include <algorithm>
#include <cmath>

#include "contact/enforce/law.hpp"

namespace abut::contact {

namespace {

struct Closest {
  Vec3 point;
  std::array<double, 3> weight{};
};

/// Closest point of the triangle (a, b, c) by regions [Ericson 2005, Real-Time Collision Detection, 5.1.5].
Closest closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, {1.0, 0.0, 0.0}};
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, {0.0, 1.0, 0.0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return {a + v * ab, {1.0 - v, v, 0.0}};
  }
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, {0.0, 0.0, 1.0}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return {a + w * ac, {1.0 - w, 0.0, w}};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {b + w * (c - b), {0.0, 1.0 - w, w}};
  }
  const double sum = va + vb + vc;
  const double v = vb / sum;
  const double w = vc / sum;
  return {a + v * ab + w * ac, {1.0 - v - w, v, w}};
}

}  // namespace

BothSidesContact both_sides_contact(const Vec3& node, const std::array<Vec3, 4>& x, bool triangle, double gap, bool all_pieces) {
  BothSidesContact out;
  const Vec3 c = triangle ? x[2] : 0.25 * (x[0] + x[1] + x[2] + x[3]);
  Vec3 direction, nearest;
  std::array<double, 4> sum{};
  for (std::size_t i = 0; i < (triangle ? 1u : 4u); ++i) {
    const std::size_t j = (i + 1) % 4;
    const Closest at = closest_on_triangle(node, c, x[i], x[j]);
    const Vec3 r = node - at.point;
    const double d = norm(r);
    const double p = gap - d;
    out.distance = std::min(out.distance, d);
    if (p <= 0.0) continue;
    std::array<double, 4> weight{};
    weight[i] += at.weight[1];
    weight[j] += at.weight[2];
    if (triangle) weight[2] += at.weight[0];
    for (std::size_t k = 0; !triangle && k < 4; ++k) weight[k] += 0.25 * at.weight[0];
    if (p > out.penetration) {
      out.penetration = p;
      out.weight = weight;
      nearest = r;
    }
    if (d > 0.0) direction += (p / d) * r;
    for (std::size_t k = 0; k < 4; ++k) sum[k] += p * weight[k];
  }
  if (out.penetration <= 0.0) return out;
  // A node on the facet itself has no direction: the facet's normal decides.
  const Vec3 facet_normal = normalized(triangle ? cross(x[1] - x[0], x[2] - x[0]) : cross(x[2] - x[0], x[3] - x[1]));
  const auto unit = [&facet_normal](const Vec3& v) { return squared_norm(v) > 0.0 ? v / norm(v) : facet_normal; };
  out.away = unit(nearest);
  out.normal = out.away;
  if (!all_pieces || triangle) return out;
  out.normal = unit(direction);
  const double total = sum[0] + sum[1] + sum[2] + sum[3];
  for (std::size_t k = 0; k < 4; ++k) out.weight[k] = sum[k] / total;
  return out;
}

std::array<double, 4> without_hourglass(std::array<double, 4> h) {
  double eta = 0.25 * (h[1] - h[0] + h[3] - h[2]);
  eta = std::max(std::min({eta, h[1], h[3]}), std::max(-h[0], -h[2]));
  return {h[0] + eta, h[1] - eta, h[2] + eta, h[3] - eta};
}

BothSidesForce both_sides_force(double k0, double gap, double p, double mass, double normal_velocity, double vis_s) {
  const double left = gap - p;
  const double ratio = gap / left;
  BothSidesForce f;
  f.elastic = k0 * ratio * p;
  f.energy = k0 * gap * gap * NormalLaw::minus_u_minus_log(p / gap);
  f.tangent = k0 * ratio * ratio;
  const double closing = std::max(0.0, -normal_velocity);
  f.critical = std::sqrt(2.0 * k0 * ratio * mass * (closing > 0.0 ? ratio : 1.0));
  f.damping = vis_s * f.critical + 0.32 * mass * closing / left;
  return f;
}

}  // namespace abut::contact
