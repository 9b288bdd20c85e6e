#include "contact/project/closest_point.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

struct Box {
  double low_s, high_s, low_t, high_t;
};

Box domain(const Patch& patch) {
  const double strip = 2.0 * patch.strip;  // s and t run over two per side
  const auto open = [&patch, strip](int side) { return (patch.borders >> side & 1) != 0 ? strip : 0.0; };
  return {-1.0 - open(3), 1.0 + open(1), -1.0 - open(0), 1.0 + open(2)};
}

// X = c + a s + b t + g s t, seen from `origin`: near the projected point rounding is that of the facet, not of the model's size.
struct Bilinear {
  Vec3 c, a, b, g;
  Bilinear(const Vec3& c0, const Vec3& a0, const Vec3& b0, const Vec3& g0) : c(c0), a(a0), b(b0), g(g0) {}
  explicit Bilinear(const Patch& p, const Vec3& origin = {})
      : c(0.25 * ((p.x[0] - origin) + (p.x[1] - origin) + (p.x[2] - origin) + (p.x[3] - origin))),
        a(0.25 * ((p.x[1] - p.x[0]) + (p.x[2] - p.x[3]))),
        b(0.25 * ((p.x[3] - p.x[0]) + (p.x[2] - p.x[1]))),
        g(0.25 * ((p.x[0] - p.x[1]) + (p.x[2] - p.x[3]))) {}
  [[nodiscard]] Vec3 at(double s, double t) const { return c + s * a + t * b + (s * t) * g; }
};

struct Minimum {
  double s, t, squared_distance;
};

// Projected Newton with active bounds from one start; q is seen from the point that is projected.
Minimum descend(const Bilinear& q, const Box& box, double s, double t) {
  Vec3 r = -q.at(s, t);
  double value = squared_norm(r);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vec3 xs = q.a + t * q.g;
    const Vec3 xt = q.b + s * q.g;
    const double gs = -dot(r, xs);
    const double gt = -dot(r, xt);
    const bool hold_s = (s <= box.low_s && gs > 0.0) || (s >= box.high_s && gs < 0.0);
    const bool hold_t = (t <= box.low_t && gt > 0.0) || (t >= box.high_t && gt < 0.0);
    if (hold_s && hold_t) break;
    const double a11 = squared_norm(xs);
    const double a22 = squared_norm(xt);
    const double metric = dot(xs, xt);
    double ds = 0.0;
    double dt = 0.0;
    if (hold_s) {
      dt = a22 > 0.0 ? -gt / a22 : 0.0;
    } else if (hold_t) {
      ds = a11 > 0.0 ? -gs / a11 : 0.0;
    } else {
      double a12 = metric - dot(r, q.g);
      double det = a11 * a22 - a12 * a12;
      if (det <= 1e-4 * a11 * a22) {
        a12 = metric;
        const double lift = 1e-10 * (a11 + a22);
        det = (a11 + lift) * (a22 + lift) - a12 * a12;
        if (det <= 0.0) break;  // both tangents vanish: a point
        ds = -((a22 + lift) * gs - a12 * gt) / det;
        dt = -((a11 + lift) * gt - a12 * gs) / det;
      } else {
        ds = -(a22 * gs - a12 * gt) / det;
        dt = -(a11 * gt - a12 * gs) / det;
      }
    }
    if (std::abs(ds) < projection_tolerance && std::abs(dt) < projection_tolerance) {
      s = std::clamp(s + ds, box.low_s, box.high_s);
      t = std::clamp(t + dt, box.low_t, box.high_t);
      r = -q.at(s, t);
      value = squared_norm(r);
      break;
    }
    double factor = 1.0;
    bool moved = false;
    for (int halving = 0; halving < 40; ++halving) {
      const double next_s = std::clamp(s + factor * ds, box.low_s, box.high_s);
      const double next_t = std::clamp(t + factor * dt, box.low_t, box.high_t);
      const Vec3 next_r = -q.at(next_s, next_t);
      const double next = squared_norm(next_r);
      // Close to the minimum the distance stands still in rounding while s and t still gain digits.
      const bool settled = std::abs(ds) + std::abs(dt) < 1e-4 && halving == 0;
      if (next < value || settled) {
        moved = next_s != s || next_t != t;
        s = next_s;
        t = next_t;
        r = next_r;
        value = next;
        break;
      }
      factor *= 0.5;
    }
    if (!moved) {
      // A clamped Newton direction need not descend; the gradient of one free variable alone does.
      if (hold_s || hold_t) break;
      const double only_s = std::clamp(s - gs / std::max(a11, 1e-300), box.low_s, box.high_s);
      const double only_t = std::clamp(t - gt / std::max(a22, 1e-300), box.low_t, box.high_t);
      const Vec3 rs = -q.at(only_s, t);
      const Vec3 rt = -q.at(s, only_t);
      if (squared_norm(rs) < value && squared_norm(rs) <= squared_norm(rt)) {
        s = only_s;
        r = rs;
      } else if (squared_norm(rt) < value) {
        t = only_t;
        r = rt;
      } else {
        break;
      }
      value = squared_norm(r);
    }
  }
  return {s, t, value};
}

ClosestPoint closest_on_quad(const Patch& patch, const Vec3& x) {
  const Bilinear q(patch, x);
  const Box box = domain(patch);
  Minimum best = descend(q, box, 0.0, 0.0);
  // Not convex when |r.g| reaches the metric's smallest value, or when the facet or its strips fold over: try the corners as well.
  const double metric = std::min(squared_norm(q.a), squared_norm(q.b));
  const double twist = squared_norm(q.g);
  const double reach = std::max(std::max(-box.low_s, box.high_s), std::max(-box.low_t, box.high_t));
  const bool folds = twist * reach * reach > 0.25 * metric;
  if (folds || (twist > 1e-8 * metric && best.squared_distance * twist > 0.04 * metric * metric)) {
    for (const double s : {box.low_s, box.high_s}) {
      for (const double t : {box.low_t, box.high_t}) {
        const Minimum other = descend(q, box, s, t);
        if (other.squared_distance < best.squared_distance) best = other;
      }
    }
  }
  ClosestPoint result;
  result.s = best.s;
  result.t = best.t;
  result.squared_distance = best.squared_distance;
  const bool left = best.s <= box.low_s;
  const bool right = best.s >= box.high_s;
  const bool bottom = best.t <= box.low_t;
  const bool top = best.t >= box.high_t;
  const auto is_border = [&patch](int side) { return (patch.borders >> side & 1) != 0; };
  result.beyond = (left && is_border(3)) || (right && is_border(1)) || (bottom && is_border(0)) || (top && is_border(2));
  if ((left || right) && (bottom || top)) {
    result.feature = Feature::corner;
    result.number = static_cast<std::uint8_t>(bottom ? (left ? 0 : 1) : (right ? 2 : 3));
  } else if (left || right || bottom || top) {
    result.feature = Feature::edge;
    result.number = static_cast<std::uint8_t>(bottom ? 0 : right ? 1 : top ? 2 : 3);
  }
  result.weight = shape(false, best.s, best.t);
  result.point = position(patch, best.s, best.t);
  return result;
}

ClosestPoint closest_on_triangle(const Patch& patch, const Vec3& x) {
  // Bounds lambda_i >= -open_i make a larger triangle; side e lies opposite corner (e + 2) % 3.
  std::array<double, 3> open{};
  for (std::size_t e = 0; e < 3; ++e) open[(e + 2) % 3] = (patch.borders >> e & 1) != 0 ? patch.strip : 0.0;
  std::array<std::array<double, 3>, 3> corner{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) corner[i][j] = -open[j];
    corner[i][i] = 1.0 + open[(i + 1) % 3] + open[(i + 2) % 3];
  }
  const auto blend = [&patch](const std::array<double, 3>& w) { return w[0] * patch.x[0] + w[1] * patch.x[1] + w[2] * patch.x[2]; };
  const Vec3 a = blend(corner[0]);
  const Vec3 b = blend(corner[1]);
  const Vec3 c = blend(corner[2]);

  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = x - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  const Vec3 bp = x - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  const Vec3 cp = x - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;

  ClosestPoint result;
  std::array<double, 3> w{};
  const auto edge = [&result](int number) {
    result.feature = Feature::edge;
    result.number = static_cast<std::uint8_t>(number);
  };
  const auto corner_of = [&result](int number) {
    result.feature = Feature::corner;
    result.number = static_cast<std::uint8_t>(number);
  };
  if (d1 <= 0.0 && d2 <= 0.0) {
    corner_of(0);
    w = {1.0, 0.0, 0.0};
  } else if (d3 >= 0.0 && d4 <= d3) {
    corner_of(1);
    w = {0.0, 1.0, 0.0};
  } else if (d6 >= 0.0 && d5 <= d6) {
    corner_of(2);
    w = {0.0, 0.0, 1.0};
  } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    edge(0);
    const double v = d1 / (d1 - d3);
    w = {1.0 - v, v, 0.0};
  } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    edge(2);
    const double v = d2 / (d2 - d6);
    w = {1.0 - v, 0.0, v};
  } else if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    edge(1);
    const double v = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    w = {0.0, 1.0 - v, v};
  } else {
    const double sum = va + vb + vc;
    w = {va / sum, vb / sum, vc / sum};
  }
  std::array<double, 3> lambda{};
  for (std::size_t j = 0; j < 3; ++j) lambda[j] = w[0] * corner[0][j] + w[1] * corner[1][j] + w[2] * corner[2][j];
  if (result.feature == Feature::edge) {
    result.beyond = (patch.borders >> result.number & 1) != 0;
  } else if (result.feature == Feature::corner) {
    const int previous = (result.number + 2) % 3;
    result.beyond = (patch.borders >> result.number & 1) != 0 || (patch.borders >> previous & 1) != 0;
  }
  result.s = lambda[1];
  result.t = lambda[2];
  result.weight = {1.0 - lambda[1] - lambda[2], lambda[1], lambda[2], 0.0};
  result.point = position(patch, result.s, result.t);
  result.squared_distance = squared_norm(x - result.point);
  return result;
}

// One strip: (1 - u^2)^2, u the share of its sloping part, and its slope in the overshoot.
struct Fall {
  double value = 1.0, slope = 0.0;
};
Fall strip(double overshoot, double width, double wider) {
  const double flat = border_flat * width + wider;
  if (overshoot <= flat) return {};
  const double fall = (1.0 - border_flat) * width;
  if (fall <= 0.0) return {0.0, 0.0};
  const double u = (overshoot - flat) / fall;
  if (u >= 1.0) return {0.0, 0.0};
  const double rest = 1.0 - u * u;
  return {rest * rest, -4.0 * u * rest / fall};
}

}  // namespace

void fit_strips(Patch& patch) {
  if (patch.borders == 0 || patch.triangle) return;
  constexpr double left = 0.25;
  const Vec3 d13 = patch.x[2] - patch.x[0], d24 = patch.x[3] - patch.x[1];
  const Bilinear q{{}, 0.25 * (d13 - d24), 0.25 * (d13 + d24), 0.25 * ((patch.x[0] - patch.x[1]) + (patch.x[2] - patch.x[3]))};
  const Vec3 normal = cross(q.a, q.b);
  const double area = squared_norm(normal);
  // Most are nearly parallelograms: |a x g| + |b x g| is a small part of |a x b| whatever their directions, and nothing folds.
  constexpr double widest_strip = border_strip + border_widening, part = (1.0 - left) / (2.0 * widest_strip + (1.0 - left));
  if (2.0 * (squared_norm(q.a) + squared_norm(q.b)) * squared_norm(q.g) <= part * part * area) return;
  const double along_s = dot(cross(q.a, q.g), normal), along_t = dot(cross(q.g, q.b), normal);
  double widest = widest_strip;
  for (int corner = 0; corner < 4; ++corner) {
    const double s = corner == 1 || corner == 2 ? 1.0 : -1.0, t = corner >= 2 ? 1.0 : -1.0;
    const bool over_s = (patch.borders >> (s > 0.0 ? 1 : 3) & 1) != 0, over_t = (patch.borders >> (t > 0.0 ? 2 : 0) & 1) != 0;
    const double here = area + s * along_s + t * along_t;
    const double falls = -2.0 * ((over_s ? s * along_s : 0.0) + (over_t ? t * along_t : 0.0));  // per length of strip
    for (const double fall : {falls, over_s ? -2.0 * s * along_s : 0.0, over_t ? -2.0 * t * along_t : 0.0}) {
      if (fall > 0.0) widest = std::min(widest, std::max(0.0, (1.0 - left) * here) / fall);
    }
  }
  patch.narrow = std::min(1.0, widest / border_strip);
  patch.widens = std::clamp((widest - border_strip) / border_widening, 0.0, 1.0);
  patch.strip = patch.narrow * border_strip;
}

MeanPlane mean_plane(const Patch& patch) {
  MeanPlane plane;
  plane.normal = normalized(cross(patch.x[2] - patch.x[0], patch.x[3] - patch.x[1]));
  plane.center = 0.25 * ((patch.x[0] + patch.x[1]) + (patch.x[2] + patch.x[3]));
  plane.top = -1e300;
  for (const Vec3& corner : patch.x) plane.top = std::max(plane.top, dot(plane.normal, corner - plane.center));
  return plane;
}

ClosestPoint closest_point(const Patch& patch, const Vec3& x) {
  return patch.triangle ? closest_on_triangle(patch, x) : closest_on_quad(patch, x);
}

double distance_at_least(const Patch& patch, const Vec3& x) {
  if (patch.triangle) return 0.0;
  const Bilinear q(patch, x);
  const Box box = domain(patch);
  // A point of the facet that is the closest one where sides are parallel; any other gives a bound too.
  const double a11 = squared_norm(q.a), a22 = squared_norm(q.b), a12 = dot(q.a, q.b), gs = dot(q.c, q.a), gt = dot(q.c, q.b);
  const double det = a11 * a22 - a12 * a12;
  if (!(det > 1e-4 * a11 * a22)) return 0.0;
  const double free = std::clamp((a12 * gt - a22 * gs) / det, box.low_s, box.high_s);
  const double t = std::clamp(-(gt + a12 * free) / a22, box.low_t, box.high_t);
  const double s = std::clamp(-(gs + a12 * t) / a11, box.low_s, box.high_s);
  // The facet lies in the hull of its corners (with strips: of theirs), and the hull beyond a plane across the way to that point.
  const Vec3 way = q.at(s, t);
  const double length = norm(way);
  const double c = dot(way, q.c), a = dot(way, q.a), b = dot(way, q.b), g = dot(way, q.g);
  const auto corner = [&](double u, double v) { return c + u * a + v * b + (u * v) * g; };
  const double nearest = std::min(std::min(corner(box.low_s, box.low_t), corner(box.high_s, box.low_t)),
                                  std::min(corner(box.low_s, box.high_t), corner(box.high_s, box.high_t)));
  constexpr double rounding = 1e-14;  // of the lengths that it is made from
  return length > 0.0 ? std::max(0.0, nearest / length - rounding * (std::sqrt(a11 + a22) + length)) : 0.0;
}

std::array<double, 4> shape(bool triangle, double s, double t) {
  if (triangle) return {1.0 - s - t, s, t, 0.0};
  return {0.25 * (1.0 - s) * (1.0 - t), 0.25 * (1.0 + s) * (1.0 - t), 0.25 * (1.0 + s) * (1.0 + t), 0.25 * (1.0 - s) * (1.0 + t)};
}

std::array<std::array<double, 4>, 2> shape_gradient(bool triangle, double s, double t) {
  if (triangle) return {{{-1.0, 1.0, 0.0, 0.0}, {-1.0, 0.0, 1.0, 0.0}}};
  return {{{-0.25 * (1.0 - t), 0.25 * (1.0 - t), 0.25 * (1.0 + t), -0.25 * (1.0 + t)},
           {-0.25 * (1.0 - s), -0.25 * (1.0 + s), 0.25 * (1.0 + s), 0.25 * (1.0 - s)}}};
}

Vec3 position(const Patch& patch, double s, double t) {
  if (patch.triangle) return patch.x[0] + s * (patch.x[1] - patch.x[0]) + t * (patch.x[2] - patch.x[0]);
  return Bilinear(patch).at(s, t);
}

std::array<Vec3, 2> tangents(const Patch& patch, double s, double t) {
  if (patch.triangle) return {patch.x[1] - patch.x[0], patch.x[2] - patch.x[0]};
  const Bilinear q(patch);
  return {q.a + t * q.g, q.b + s * q.g};
}

Vec3 normal_at(const Patch& patch, double s, double t) {
  const std::array<Vec3, 2> tangent = tangents(patch, s, t);
  return normalized(cross(tangent[0], tangent[1]));
}

Taper taper(const Patch& patch, double s, double t, double wider) {
  if (patch.borders == 0) return {};
  Taper result;
  const double width = patch.narrow < Patch::too_narrow ? 0.0 : border_strip * patch.narrow;
  const double unit = patch.triangle ? 1.0 : 2.0;  // s and t run over 1 or 2 per side
  // Product over the sides: over(shoot) grows with ds, dt.
  const auto times = [&](int side, double over, double ds, double dt) {
    if ((patch.borders >> side & 1) == 0) return;
    const Fall one = strip(over, unit * width, width > 0.0 ? unit * wider : 0.0);
    result.ds = result.ds * one.value + result.value * one.slope * ds;
    result.dt = result.dt * one.value + result.value * one.slope * dt;
    result.dw = result.dw * one.value - result.value * one.slope * unit;
    result.value *= one.value;
  };
  if (patch.triangle) {
    times(0, -t, 0.0, -1.0);
    times(1, s + t - 1.0, 1.0, 1.0);
    times(2, -s, -1.0, 0.0);
    return result;
  }
  times(0, -1.0 - t, 0.0, -1.0);
  times(1, s - 1.0, 1.0, 0.0);
  times(2, t - 1.0, 0.0, 1.0);
  times(3, -1.0 - s, -1.0, 0.0);
  return result;
}

}  // namespace abut::contact
