#include "contact/project/plain.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

double ratio(double above, double below) { return below != 0.0 ? above / below : 0.0; }

// Unbounded Newton for the orthogonal projection; degenerate (s, t) lines of a triangle's repeated corner are kept away by the
// distance of the start, the residual test ends it.
void newton(const Patch& patch, const Vec3& x, double& s, double& t) {
  const Vec3 g = 0.25 * ((patch.x[0] - patch.x[1]) + (patch.x[2] - patch.x[3]));
  for (int iteration = 0; iteration < 30; ++iteration) {
    const std::array<double, 4> h = shape(false, s, t);
    const Vec3 r = x - (h[0] * patch.x[0] + h[1] * patch.x[1] + h[2] * patch.x[2] + h[3] * patch.x[3]);
    const auto dh = shape_gradient(false, s, t);
    Vec3 xs{}, xt{};
    for (std::size_t i = 0; i < 4; ++i) {
      xs += dh[0][i] * patch.x[i];
      xt += dh[1][i] * patch.x[i];
    }
    const double a11 = squared_norm(xs);
    const double a22 = squared_norm(xt);
    double a12 = dot(xs, xt) - dot(r, g);
    double det = a11 * a22 - a12 * a12;
    if (det <= 1e-4 * a11 * a22) {
      a12 = dot(xs, xt);
      det = a11 * a22 - a12 * a12;
      if (det <= 1e-14 * a11 * a22) return;
    }
    const double gs = dot(r, xs);
    const double gt = dot(r, xt);
    const double ds = (a22 * gs - a12 * gt) / det;
    const double dt = (a11 * gt - a12 * gs) / det;
    s = std::clamp(s + ds, -4.0, 4.0);
    t = std::clamp(t + dt, -4.0, 4.0);
    if (std::abs(ds) + std::abs(dt) < projection_tolerance) return;
  }
}

}  // namespace

double edge_tolerance(double gap, double area) { return area > 0.0 ? std::clamp(2.0 * std::abs(gap) / std::sqrt(area), 0.05, 0.2) : 0.05; }

PlainPoint project_plain(const Patch& patch, const Vec3& x, double gap, bool area_ratios) {
  const std::array<Vec3, 4>& corner = patch.x;
  const Vec3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
  Vec3 doubled{};
  for (std::size_t i = 0; i < 4; ++i) doubled += cross(corner[i] - centre, corner[(i + 1) % 4] - centre);
  PlainPoint result;
  const double length = norm(doubled);
  result.area = 0.5 * length;
  if (length <= 0.0) return result;
  result.normal = doubled / length;
  const auto own = [&](std::size_t i, std::size_t j) { return dot(result.normal, cross(corner[i] - centre, corner[j] - centre)); };
  const auto seen = [&](std::size_t i, std::size_t j) { return dot(result.normal, cross(corner[i] - x, corner[j] - x)); };

  const double a12 = own(0, 1), a23 = own(1, 2), a34 = own(2, 3), a41 = own(3, 0);
  const double b12 = seen(0, 1), b23 = seen(1, 2), b34 = seen(2, 3), b41 = seen(3, 0);
  double s = ratio(a23 * b41 - b23 * a41, a23 * b41 + b23 * a41);
  double t = patch.triangle || a34 == 0.0 ? ratio(b12, a12) - 1.0 : ratio(b12 * a34 - b34 * a12, b12 * a34 + b34 * a12);
  if (!area_ratios && !patch.triangle) newton(patch, x, s, t);

  const double limit = 1.0 + edge_tolerance(gap, result.area);
  result.inside = std::abs(s) <= limit && std::abs(t) <= limit;
  result.raw_s = s;
  result.raw_t = t;
  result.s = std::clamp(s, -1.0, 1.0);
  result.t = std::clamp(t, -1.0, 1.0);
  result.weight = shape(false, result.s, result.t);
  result.point = result.weight[0] * corner[0] + result.weight[1] * corner[1] + result.weight[2] * corner[2] + result.weight[3] * corner[3];
  result.distance = dot(result.normal, x - result.point);
  return result;
}

}  // namespace abut::contact
