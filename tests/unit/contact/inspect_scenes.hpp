// Pairs of surfaces for tests of the inspection.
#pragma once

#include <abut/contact/inspect.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace abut::contact::test {

struct Pair {
  std::vector<Vec3> x, v;
  std::vector<double> mass;
  std::array<std::vector<Facet>, 2> facets;
  std::vector<Index> held;  ///< side 0 as a set of nodes, when its facets are empty
  std::array<std::vector<double>, 2> stiffness;
  std::array<std::vector<std::int8_t>, 2> outward;
  double gap = 0.0, stiffness_scale = 0.2, element_step = 0.0;
  bool both_sides = false;

  [[nodiscard]] InspectionInput input() const {
    InspectionInput in;
    for (std::size_t k = 0; k < 2; ++k) in.side[k] = {facets[k], {}, stiffness[k], outward[k]};
    in.side[0].nodes = held;
    in.both_sides = both_sides;
    in.stiffness_scale = stiffness_scale;
    in.gap = gap;
    in.x = x;
    in.v = v;
    in.mass = mass;
    in.element_step = element_step;
    return in;
  }
  void apply(const Orientation& o) {
    for (std::size_t k = 0; k < 2; ++k) {
      for (const Index f : o.flip[k]) facets[k][static_cast<std::size_t>(f)] = reversed(facets[k][static_cast<std::size_t>(f)]);
    }
  }

  /// n by m quadrilaterals on a grid of new nodes; the normal is du x dv.
  template <class Place>
  std::vector<Facet> patch(int n, int m, Place place) {
    const auto base = static_cast<Index>(x.size());
    for (int j = 0; j <= m; ++j) {
      for (int i = 0; i <= n; ++i) x.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
    }
    std::vector<Facet> out;
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < n; ++i) {
        const Index a = base + i + j * (n + 1);
        out.push_back({{a, a + 1, a + n + 2, a + n + 1}});
      }
    }
    return out;
  }
  std::vector<Facet> plate(int n, int m, double low, double high, double z, bool up) {
    auto out = patch(n, m, [=](double u, double w) { return Vec3{low + (high - low) * u, low + (high - low) * w, z}; });
    return up ? out : turned(out);
  }
  /// In the plane x = at, standing on z = low, normal +x.
  std::vector<Facet> wall(int n, int m, double at, double low) {
    return patch(n, m, [=](double u, double w) { return Vec3{at, u, low + w}; });
  }
  /// About the y axis, y from 0 to 2; normals outward unless turned.
  std::vector<Facet> cylinder(double radius, int around, int along, bool inward) {
    const auto base = static_cast<Index>(x.size());
    for (int j = 0; j <= along; ++j) {
      for (int i = 0; i < around; ++i) {
        const double a = 2.0 * 3.141592653589793 * i / around;
        x.push_back({radius * std::sin(a), 2.0 * j / along, radius * std::cos(a)});
      }
    }
    std::vector<Facet> out;
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < around; ++i) {
        const Index a = base + i + j * around, b = base + (i + 1) % around + j * around;
        out.push_back({{a, a + around, b + around, b}});
      }
    }
    const Facet& f = out[0];
    const Vec3 normal = cross(x[static_cast<std::size_t>(f.node[2])] - x[static_cast<std::size_t>(f.node[0])],
                              x[static_cast<std::size_t>(f.node[3])] - x[static_cast<std::size_t>(f.node[1])]);
    const Vec3 at = x[static_cast<std::size_t>(f.node[0])];
    const bool outward = dot(normal, Vec3{at.x, 0.0, at.z}) > 0.0;
    return outward == inward ? turned(out) : out;
  }
  /// Closed box with merged nodes, n facets along every edge; normals outward unless turned.
  std::vector<Facet> box(Vec3 low, Vec3 size, int n, bool inward) {
    std::vector<Facet> out;
    const std::size_t first = x.size();
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        auto face = patch(n, n, [=](double u, double w) {
          std::array<double, 3> p{};
          p[static_cast<std::size_t>(axis)] = high ? 1.0 : 0.0;
          p[static_cast<std::size_t>((axis + 1) % 3)] = u;
          p[static_cast<std::size_t>((axis + 2) % 3)] = w;
          return Vec3{low.x + size.x * p[0], low.y + size.y * p[1], low.z + size.z * p[2]};
        });
        if (!high) face = turned(face);
        out.insert(out.end(), face.begin(), face.end());
      }
    }
    for (Facet& f : out) {
      for (Index& node : f.node) {
        for (std::size_t k = first; k < static_cast<std::size_t>(node); ++k) {
          if (norm(x[k] - x[static_cast<std::size_t>(node)]) < 1e-9) {
            node = static_cast<Index>(k);
            break;
          }
        }
      }
    }
    return inward ? turned(out) : out;
  }
  static std::vector<Facet> turned(std::vector<Facet> facets) {
    for (Facet& f : facets) f = reversed(f);
    return facets;
  }
};

inline const Finding* find(const std::vector<Finding>& all, const std::string& code, int side) {
  for (const Finding& f : all) {
    if (f.code == code && (side == f.side || side == -2)) return &f;
  }
  return nullptr;
}
inline bool has(const std::vector<Finding>& all, const std::string& code, int side = -2) { return find(all, code, side) != nullptr; }
inline bool has_errors(const std::vector<Finding>& all) {
  return std::any_of(all.begin(), all.end(), [](const Finding& f) { return f.severity == Severity::error; });
}

}  // namespace abut::contact::test
