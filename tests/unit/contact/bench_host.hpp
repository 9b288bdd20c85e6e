// A host of a few free nodes: leap-frog in the order of numerics.md 1.1, for tests of the contact library alone.
#pragma once

#include <abut/contact/interface.hpp>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace abut::contact::test {

struct Host {
  std::vector<Vec3> x, v, f;
  std::vector<double> m, k;  ///< m = 0: does not move
  double time = 0.0, dt = 0.0, before = 0.0;
  StepResult last;

  Index add(Vec3 at, double mass = 0.0, Vec3 velocity = {}) {
    x.push_back(at);
    v.push_back(velocity);
    m.push_back(mass);
    return static_cast<Index>(x.size()) - 1;
  }
  [[nodiscard]] HostState state() const { return {x, v, m, time, dt, 0.5 * (dt + before)}; }

  StepResult contact(Interface& interface) {
    f.assign(x.size(), {});
    k.assign(x.size(), 0.0);
    interface.search(state());
    last = interface.evaluate(state(), f, k);
    interface.commit(dt);
    return last;
  }
  /// Contact forces at t, then kick and drift by h.
  StepResult step(Interface& interface, double h, const std::function<void(Host&)>& loads = {}) {
    contact(interface);
    if (loads) loads(*this);
    const double bar = 0.5 * (dt + h);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (m[i] > 0.0) v[i] += (bar / m[i]) * f[i];
      x[i] += h * v[i];
    }
    before = dt;
    dt = h;
    time += h;
    return last;
  }
  /// Moves nodes to where they are told and asks for the forces there (quasi-static paths).
  StepResult place(Interface& interface, const std::vector<Vec3>& positions, double h = 1.0) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] = (positions[i] - x[i]) / h;
      x[i] = positions[i];
    }
    before = dt;
    dt = h;
    time += h;
    return contact(interface);
  }
};

/// Regular nx by ny quadrilaterals over [x0, x1] x [y0, y1], at z = height(x, y); up: normals to +z.
inline std::vector<Facet> grid(Host& host, int nx, int ny, double x0, double x1, double y0, double y1,
                               const std::function<double(double, double)>& height, bool up = true, bool triangles = false,
                               double mass = 0.0) {
  const auto base = static_cast<Index>(host.x.size());
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const double px = x0 + (x1 - x0) * i / nx;
      const double py = y0 + (y1 - y0) * j / ny;
      host.add({px, py, height(px, py)}, mass);
    }
  }
  std::vector<Facet> facets;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Index a = base + j * (nx + 1) + i;
      const Index b = a + 1;
      const Index c = b + nx + 1;
      const Index d = a + nx + 1;
      const auto push = [&](Index p, Index q, Index r, Index s) {
        facets.push_back(up ? Facet{{p, q, r, s}} : (r == s ? Facet{{p, r, q, q}} : Facet{{p, s, r, q}}));
      };
      if (triangles) {
        push(a, b, c, c);
        push(a, c, d, d);
      } else {
        push(a, b, c, d);
      }
    }
  }
  return facets;
}

inline double flat(double, double) { return 0.0; }

inline void set_stiffness(Interface& interface, int side, std::size_t facets, double value) {
  const std::vector<double> k(facets, value);
  interface.set_surface(side, {k, {}, {}});
}

}  // namespace abut::contact::test
