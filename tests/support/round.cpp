#include "support/round.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut::scenes {

namespace {

using Point = std::array<double, 2>;

Point mix(const Point& a, const Point& b, double t) { return {(1.0 - t) * a[0] + t * b[0], (1.0 - t) * a[1] + t * b[1]}; }

/// Side of the core from (core, 0) to its corner on the diagonal. A corner at 1.2 core leaves 110 degrees inside of it and
/// 125 on either side of the diagonal.
Point core_side(double core, double t) {
  const double corner = 1.2 * core * std::numbers::sqrt2 / 2.0;
  return mix({core, 0.0}, {corner, corner}, t);
}

Point mirrored(const Point& p) { return {p[1], p[0]}; }

}  // namespace

std::vector<double> graded(int n, double growth) {
  std::vector<double> x{0.0};
  double step = 1.0;
  for (int i = 0; i < n; ++i) {
    x.push_back(x.back() + step);
    step *= growth;
  }
  for (double& v : x) v /= x.back();
  x.back() = 1.0;
  return x;
}

double growth_from(double first, double length, int n) {
  double low = 0.1, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double q = 0.5 * (low + high);
    double sum = 0.0;
    double step = first;
    for (int k = 0; k < n; ++k, step *= q) sum += step;
    (sum < length ? low : high) = q;
  }
  return 0.5 * (low + high);
}

QuarterDisc QuarterDisc::make(int n, int m, double core, double growth) {
  QuarterDisc d;
  const auto add = [&d](const Point& p) {
    d.points.push_back(p);
    return static_cast<int>(d.points.size()) - 1;
  };
  const auto square = [n](int i, int j) { return static_cast<std::size_t>(i + (n + 1) * j); };
  std::vector<int> inner(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      // Coons patch between the axes and the two sides of the core.
      const double u = static_cast<double>(i) / n;
      const double v = static_cast<double>(j) / n;
      const Point bottom{core * u, 0.0}, left{0.0, core * v};
      const Point right = core_side(core, v);
      const Point top = mirrored(core_side(core, u));
      const Point corner = core_side(core, 1.0);
      Point p{};
      for (std::size_t c = 0; c < 2; ++c) {
        const Point b{core, 0.0}, t{0.0, core};
        p[c] = (1.0 - v) * bottom[c] + v * top[c] + (1.0 - u) * left[c] + u * right[c] -
               (u * (1.0 - v) * b[c] + (1.0 - u) * v * t[c] + u * v * corner[c]);
      }
      if (i == 0) p[0] = 0.0;
      if (j == 0) p[1] = 0.0;
      inner[square(i, j)] = add(p);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      d.quads.push_back({inner[square(i, j)], inner[square(i + 1, j)], inner[square(i + 1, j + 1)], inner[square(i, j + 1)]});
  }
  // Blocks around the core: spoke s = 0..2n from the x axis over the diagonal to the y axis, ring r = 0..m.
  const std::vector<double> radial = graded(m, growth);
  std::vector<std::vector<int>> ring(static_cast<std::size_t>(m) + 1);
  for (int s = 0; s <= 2 * n; ++s) ring[0].push_back(s <= n ? inner[square(n, s)] : inner[square(2 * n - s, n)]);
  for (int r = 1; r <= m; ++r) {
    for (int s = 0; s <= 2 * n; ++s) {
      const double angle = 0.25 * std::numbers::pi * s / n;
      Point p = mix(d.points[static_cast<std::size_t>(ring[0][static_cast<std::size_t>(s)])], {std::cos(angle), std::sin(angle)},
                    radial[static_cast<std::size_t>(r)]);
      if (s == 0) p[1] = 0.0;
      if (s == 2 * n) p[0] = 0.0;
      ring[static_cast<std::size_t>(r)].push_back(add(p));
    }
  }
  for (std::size_t r = 0; r < static_cast<std::size_t>(m); ++r) {
    for (std::size_t s = 0; s < 2 * static_cast<std::size_t>(n); ++s)
      d.quads.push_back({ring[r][s], ring[r + 1][s], ring[r + 1][s + 1], ring[r][s + 1]});
  }
  d.rim = ring.back();
  return d;
}

std::vector<Index> Sweep::layer(int k) const {
  std::vector<Index> out;
  for (int p = 0; p < points; ++p) out.push_back(at(p, k));
  return out;
}

std::vector<std::array<Index, 4>> Sweep::cap(bool last) const {
  std::vector<std::array<Index, 4>> faces;
  for (const auto& q : quads) {
    if (last) {
      faces.push_back({at(q[0], layers), at(q[1], layers), at(q[2], layers), at(q[3], layers)});
    } else {
      faces.push_back({at(q[3], 0), at(q[2], 0), at(q[1], 0), at(q[0], 0)});
    }
  }
  return faces;
}

std::vector<std::array<Index, 4>> turned(std::vector<std::array<Index, 4>> faces) {
  for (auto& f : faces) f = {f[3], f[2], f[1], f[0]};
  return faces;
}

std::vector<double> nodal_areas(const Scene& scene, const std::vector<Index>& surfaces) {
  std::vector<double> area(scene.model.node_x.size(), 0.0);
  for (const Index s : surfaces) {
    for (const model::Segment& f : scene.model.surfaces[static_cast<std::size_t>(s)].segments) {
      const auto at = [&](std::size_t k) { return scene.model.node_x[static_cast<std::size_t>(f.nodes[k])]; };
      const double share = 0.125 * norm(cross(at(2) - at(0), at(3) - at(1)));
      for (const Index n : f.nodes) area[static_cast<std::size_t>(n)] += share;
    }
  }
  return area;
}

Sweep sweep(Scene& scene, int points, const std::vector<std::array<int, 4>>& quads, int layers, const std::function<Vec3(int, int)>& place,
            const std::function<Index(const Corners&)>& part_of) {
  Sweep s;
  s.points = points;
  s.layers = layers;
  s.quads = quads;
  for (int k = 0; k <= layers; ++k) {
    for (int p = 0; p < points; ++p) s.nodes.push_back(scene.node(place(p, k)));
  }
  for (int k = 0; k < layers; ++k) {
    for (const auto& q : quads) {
      const std::array<Index, 8> nodes{s.at(q[0], k),     s.at(q[1], k),     s.at(q[2], k),     s.at(q[3], k),
                                       s.at(q[0], k + 1), s.at(q[1], k + 1), s.at(q[2], k + 1), s.at(q[3], k + 1)};
      Corners corners;
      for (std::size_t c = 0; c < 8; ++c) corners[c] = scene.model.node_x[static_cast<std::size_t>(nodes[c])];
      scene.brick(part_of(corners), nodes);
    }
  }
  return s;
}

EqualStepParts::EqualStepParts(Scene& scene, Index property, double young, double poisson, double density, double size)
    : scene_(&scene), property_(property), young_(young), poisson_(poisson), density_(density), size_(size) {}

Index EqualStepParts::operator()(const Corners& x) {
  // Edges of the mid-planes: 8 det J and the mid-faces of numerics.md 2.1.5.
  Vec3 xi{}, eta{}, zeta{};
  constexpr double sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  for (std::size_t k = 0; k < 8; ++k) {
    xi += 0.25 * sign[k][0] * x[k];
    eta += 0.25 * sign[k][1] * x[k];
    zeta += 0.25 * sign[k][2] * x[k];
  }
  const double volume = std::abs(dot(xi, cross(eta, zeta)));
  const double face = std::max({norm(cross(xi, eta)), norm(cross(eta, zeta)), norm(cross(zeta, xi))});
  const int size_class = static_cast<int>(std::lround(2.0 * std::log2(volume / face / size_)));
  auto [found, added] = part_.try_emplace(size_class, no_index);
  if (added) found->second = scene_->part(property_, scene_->elastic(density_ * std::exp2(-size_class), young_, poisson_));
  return found->second;
}

std::vector<Index> nodes_on(const Scene& scene, const std::vector<Index>& nodes, int axis, double value, double tolerance) {
  std::vector<Index> out;
  for (const Index n : nodes) {
    const Vec3& x = scene.model.node_x[static_cast<std::size_t>(n)];
    const double c = axis == 0 ? x.x : axis == 1 ? x.y : x.z;
    if (std::abs(c - value) <= tolerance) out.push_back(n);
  }
  return out;
}

}  // namespace abut::scenes
