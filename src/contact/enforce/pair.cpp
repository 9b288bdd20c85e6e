#include "contact/enforce/pair.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

// The free directions: two on a face, one along an edge, none at a corner; in (s, t), with dH/dxi and X_a along them.
struct Directions {
  std::size_t count = 0;
  std::array<std::array<double, 2>, 2> d{};
  std::array<std::array<double, 4>, 2> dh{};
  std::array<Vec3, 2> tangent{};
};

Directions free_directions(const Patch& patch, const ClosestPoint& c) {
  Directions free;
  if (c.feature == Feature::corner) return free;
  if (c.feature == Feature::face) {
    free.count = 2;
    free.d = {{{1.0, 0.0}, {0.0, 1.0}}};
  } else {
    constexpr std::array<std::array<double, 2>, 3> of_triangle{{{1.0, 0.0}, {-1.0, 1.0}, {0.0, 1.0}}};
    free.count = 1;
    free.d[0] = patch.triangle ? of_triangle[c.number] : std::array{c.number % 2 == 0 ? 1.0 : 0.0, c.number % 2 == 0 ? 0.0 : 1.0};
  }
  const auto gradient = shape_gradient(patch.triangle, c.s, c.t);
  for (std::size_t a = 0; a < free.count; ++a) {
    for (std::size_t i = 0; i < (patch.triangle ? 3U : 4U); ++i) {
      free.dh[a][i] = free.d[a][0] * gradient[0][i] + free.d[a][1] * gradient[1][i];
      free.tangent[a] += free.dh[a][i] * patch.x[i];
    }
  }
  return free;
}

// How much wider strips are, in lengths of the facet, at x = depth over its length: x, but with a slope that starts and ends without a jump
// (a jump of the slope is one of the normal force).
struct Wider {
  double value = 0.0, slope = 0.0;
};
constexpr double starts = 0.1, ends = 0.4;  // lengths over which the slope rises to 1 and falls to 0
Wider wider_at(double x) {
  constexpr double last = border_widening + 0.5 * (starts + ends);
  if (x <= 0.0) return {};
  if (x < starts) return {0.5 * x * x / starts, x / starts};
  if (x < last - ends) return {x - 0.5 * starts, 1.0};
  if (x < last) return {border_widening - 0.5 * (last - x) * (last - x) / ends, (last - x) / ends};
  return {border_widening, 0.0};
}

/// Distance across the facet from a border that a node is near to the other side; of triangles the least height.
/// @param s, t  the taper changes along the first, the second direction
double across(bool triangle, std::size_t directions, const std::array<Vec3, 2>& tangent, bool s, bool t) {
  const double first = norm(tangent[0]), second = norm(tangent[1]);
  if (directions == 1) return triangle ? first : 2.0 * first;
  const double area = norm(cross(tangent[0], tangent[1]));
  if (triangle) return area / std::max({first, second, norm(tangent[0] - tangent[1])});
  const double along = s == t ? std::max(first, second) : s ? second : first;
  return along > 0.0 ? 2.0 * area / along : 0.0;
}

}  // namespace

PairForce pair_force(const Side& surface, const Measure& m, const Vec3& x, const NormalLaw& law, Depth own, double scale,
                     double node_stiffness, bool half_of_facet, double widening, bool gap_follows) {
  PairForce result;
  const ClosestPoint& c = m.closest;
  const Patch patch = surface.patch(m.facet);
  const std::array<Index, 4>& corner = surface.surface().local()[at(m.facet)];
  const std::size_t corners = patch.triangle ? 3 : 4;
  const double p = own.depth;
  Wider wider = wider_at(-widening * own.distance);
  wider.value *= patch.widens;
  wider.slope *= patch.widens;
  const double widens = wider.slope * widening;  // dw/dP
  const Taper t = taper(patch, c.s, c.t, wider.value);
  if (c.beyond || t.value <= 0.0) return result;

  double k1 = 0.0, thickness = 0.0;
  double smallest = 1e300, largest = 0.0, thinnest = 1e300, thickest = 0.0;
  for (std::size_t i = 0; i < corners; ++i) {
    const double k = surface.corner_stiffness(corner[i]);
    k1 += c.weight[i] * k;
    smallest = std::min(smallest, k);
    largest = std::max(largest, k);
    if (!gap_follows) continue;
    const double t_i = surface.node_thickness(corner[i]);
    thickness += c.weight[i] * t_i;
    thinnest = std::min(thinnest, t_i);
    thickest = std::max(thickest, t_i);
  }
  gap_follows = gap_follows && thinnest <= thickness && thickness <= thickest;  // the same of thickness
  // Strips extrapolate: keep the field within its corners' values there.
  const bool clipped = k1 < smallest || k1 > largest;
  k1 = std::clamp(k1, smallest, largest);
  double pair = 0.0;
  double slope = 0.0;  // dKp/dK1
  if (half_of_facet) {
    pair = 0.5 * scale * k1;
    slope = 0.5 * scale;
  } else if (k1 > 0.0 && node_stiffness > 0.0) {
    const double sum = k1 + node_stiffness;
    pair = scale * k1 * node_stiffness / sum;
    slope = scale * (node_stiffness / sum) * (node_stiffness / sum);
  }
  if (clipped) slope = 0.0;

  const double phi = law.potential(p);
  result.whole = pair;
  result.stiffness = t.value * pair;
  result.of_wider = pair * phi * t.dw * widens;
  result.magnitude = own.slope * (result.stiffness * law.force(p)) + (own.nearest ? result.of_wider : 0.0);
  result.potential = result.stiffness * phi;
  result.on_node = result.magnitude * m.normal;

  const Directions free = free_directions(patch, c);
  const auto& dh = free.dh;
  const auto& tangent = free.tangent;
  std::array<double, 2> push{};  // dPsi/dxi at fixed distance
  for (std::size_t a = 0; a < free.count; ++a) {
    double dk1 = 0.0, dgap = 0.0;
    for (std::size_t i = 0; i < corners; ++i) {
      dk1 += dh[a][i] * surface.corner_stiffness(corner[i]);
      if (gap_follows) dgap += 0.5 * dh[a][i] * surface.node_thickness(corner[i]);
    }
    push[a] = phi * (t.value * slope * dk1 + pair * (free.d[a][0] * t.ds + free.d[a][1] * t.dt));
    if (dgap != 0.0) push[a] += result.stiffness * (own.grows * law.force(p) + law.gap_slope(p)) * dgap;
  }
  std::array<double, 2> shift{};  // c^a
  const Vec3 r = x - c.point;
  if (push[0] != 0.0 || push[1] != 0.0) {
    const double a11 = squared_norm(tangent[0]);
    if (free.count == 1) {
      shift[0] = a11 > 0.0 ? push[0] / a11 : 0.0;
    } else {
      const double a22 = squared_norm(tangent[1]);
      double a12 = dot(tangent[0], tangent[1]);
      if (!patch.triangle) a12 -= 0.25 * dot(r, (patch.x[0] - patch.x[1]) + (patch.x[2] - patch.x[3]));
      const double det = a11 * a22 - a12 * a12;
      if (det > 1e-3 * a11 * a22) { shift = {(a22 * push[0] - a12 * push[1]) / det, (a11 * push[1] - a12 * push[0]) / det}; }
    }
    const Vec3 sideways = shift[0] * tangent[0] + shift[1] * tangent[1];
    result.on_node -= sideways;
    // Cross terms kappa' phi' and, in a strip, T'' phi: |T''| <= 8 and |T'| <= 1.54 in units of the strip.
    if (phi > 0.0) result.extra_tangent = norm(sideways) * law.force(p) / phi;
    if (t.value < 1.0) {
      const double fall = (1.0 - border_flat) * border_strip * patch.narrow;
      const double width = fall * across(patch.triangle, free.count, tangent, t.ds != 0.0, t.dt != 0.0);
      if (width > 0.0) result.extra_tangent += pair * 8.0 * phi / (width * width);
      if (wider.value > 0.0) {
        result.extra_tangent +=
            pair * (2.0 * 1.54 * law.force(p) * widens + 8.0 * phi * widens * widens / fall + 1.54 * phi * widening * widening / starts) /
            fall;
      }
    }
  }
  if (c.feature != Feature::face && m.distance < 0.0) {
    // Behind an inward fold the direction turns with radius |d|.
    result.extra_tangent += std::min(std::abs(result.magnitude) / -m.distance, 10.0 * result.stiffness * law.tangent(p));
  }
  for (std::size_t i = 0; i < corners; ++i) {
    result.on_facet[i] = -c.weight[i] * result.on_node - (shift[0] * dh[0][i] + shift[1] * dh[1][i]) * r;
  }
  return result;
}

FrictionCouple friction_couple(const Patch& patch, const ClosestPoint& c, const Vec3& x, const Vec3& on_surface) {
  FrictionCouple result;
  const Directions free = free_directions(patch, c);
  if (free.count == 0) return result;
  const std::size_t corners = patch.triangle ? 3 : 4;
  const auto& dh = free.dh;
  const auto& tangent = free.tangent;
  // Of one direction: as if the other were a unit vector across.
  const bool two = free.count == 2;
  const double g11 = squared_norm(tangent[0]), g12 = dot(tangent[0], tangent[1]), g22 = two ? squared_norm(tangent[1]) : 1.0;
  const double det = g11 * g22 - g12 * g12;
  if (!(det > 0.0)) return result;
  const double i11 = g22 / det, i12 = -g12 / det, i22 = two ? g11 / det : 0.0;
  const double f1 = dot(on_surface, tangent[0]), f2 = dot(on_surface, tangent[1]);
  const Vec3 r = x - c.point;
  std::array<double, 4> arm{};
  double weights = 1.0, arms = 1.0;
  for (std::size_t i = 0; i < corners; ++i) {
    const double h1 = dh[0][i], h2 = dh[1][i];
    result.on_facet[i] = -((i11 * f1 + i12 * f2) * h1 + (i12 * f1 + i22 * f2) * h2) * r;
    const double square = (i11 * h1 * h1 + 2.0 * i12 * h1 * h2) + i22 * h2 * h2;
    arm[i] = std::sqrt(c.weight[i] * c.weight[i] + squared_norm(r) * std::max(square, 0.0));
    weights += std::abs(c.weight[i]);
    arms += arm[i];
  }
  for (std::size_t i = 0; i < corners; ++i) result.corner_share[i] = 0.5 * (arm[i] * arms - std::abs(c.weight[i]) * weights);
  result.node_share = 0.5 * (arms - weights);
  return result;
}

}  // namespace abut::contact
