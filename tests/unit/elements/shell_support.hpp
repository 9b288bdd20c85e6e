// Hand-made shell models, one step of a group, and a small explicit loop.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "elements/group.hpp"
#include "parallel/thread_pool.hpp"

namespace abut::elements::test {

using Matrix3 = std::array<Vec3, 3>;  // rows

inline Vec3 operator*(const Matrix3& r, const Vec3& a) { return {dot(r[0], a), dot(r[1], a), dot(r[2], a)}; }

/// Rotation by `angle` about the unit vector along `axis` (Rodrigues).
inline Matrix3 rotation(Vec3 axis, double angle) {
  const Vec3 n = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](const Vec3& a) { return c * a + s * cross(n, a) + (1.0 - c) * dot(n, a) * n; };
  const Vec3 x = turn({1, 0, 0}), y = turn({0, 1, 0}), z = turn({0, 0, 1});
  return {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
}

struct Material {
  double young = 210.0, poisson = 0.3, density = 7.8e-6;
};

/// A model with one part, one shell property and one law; quads or triangles are added by hand.
struct ShellModel {
  model::Model model;

  explicit ShellModel(Material m = {}, double thickness = 1.0) {
    model::Property property;
    property.id = 1;
    model::ShellProperty shell;
    shell.thickness = thickness;
    property.data = shell;
    model.properties.push_back(property);
    model::Material material;
    material.id = 1;
    material.density = material.reference_density = m.density;
    material.law = model::LawElastic{m.young, m.poisson};
    model.materials.push_back(material);
    model::Part part;
    part.id = 1;
    part.property = 0;
    part.material = 0;
    model.parts.push_back(part);
  }

  model::ShellProperty& property() { return std::get<model::ShellProperty>(model.properties[0].data); }
  model::LawJohnsonCook& johnson_cook() {
    auto& law = model.materials[0].law;
    if (const auto* e = std::get_if<model::LawElastic>(&law)) {
      model::LawJohnsonCook j;
      j.young = e->young;
      j.poisson = e->poisson;
      law = j;
    }
    return std::get<model::LawJohnsonCook>(law);
  }

  Index node(Vec3 x) {
    model.node_x.push_back(x);
    model.node_id.push_back(static_cast<Id>(model.node_x.size()));
    return static_cast<Index>(model.node_x.size()) - 1;
  }
  void quad(Index a, Index b, Index c, Index d) {
    model.shells.id.push_back(static_cast<Id>(model.shells.id.size()) + 1);
    model.shells.part.push_back(0);
    model.shells.nodes.push_back({a, b, c, d});
    model.shells.thickness.push_back(0.0);
  }
  void triangle(Index a, Index b, Index c) {
    model.sh3ns.id.push_back(static_cast<Id>(model.sh3ns.id.size()) + 1);
    model.sh3ns.part.push_back(0);
    model.sh3ns.nodes.push_back({a, b, c});
    model.sh3ns.thickness.push_back(0.0);
  }
  /// One element with nodes at `x` (4: quad, 3: triangle).
  void single(const std::vector<Vec3>& x) {
    std::vector<Index> n;
    for (const Vec3& p : x) n.push_back(node(p));
    if (x.size() == 4)
      quad(n[0], n[1], n[2], n[3]);
    else
      triangle(n[0], n[1], n[2]);
  }
};

inline std::vector<Index> all_of(Index count) {
  std::vector<Index> e(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) e[static_cast<std::size_t>(i)] = i;
  return e;
}

/// One group with its slots, positions and velocities.
struct Runner {
  const model::Model* model;
  std::unique_ptr<Group> group;
  parallel::ThreadPool pool{1};
  std::vector<double> slots;
  std::vector<Vec3> x, v, w;
  std::vector<double> mass, inertia;
  std::vector<Vec3> f, m;  ///< internal force and moment (of the element on nothing), assembled
  std::vector<double> stiffness, rotational;

  Runner(const ShellModel& s, bool quads, Profile profile = Profile::standard(),
         model::StepControl::Action action = model::StepControl::Action::none, double minimum = 0.0)
      : model(&s.model) {
    GroupInput in;
    in.model = model;
    in.part = 0;
    in.elements = all_of(quads ? model->shells.size() : model->sh3ns.size());
    in.profile = profile;
    in.step_scale = 1.0;
    in.step_action = action;
    in.step_minimum = minimum;
    group = quads ? make_shell_q4(in) : make_shell_c0(in);
    slots.assign(group->layout().size(), 0.0);
    x = model->node_x;
    v.assign(x.size(), {});
    w.assign(x.size(), {});
    mass.assign(x.size(), 0.0);
    inertia.assign(x.size(), 0.0);
    group->add_masses(mass, inertia);
  }

  [[nodiscard]] std::vector<double> sum(int component) const {
    std::vector<double> total(x.size(), 0.0);
    for (Index e = 0; e < group->size(); ++e) {
      const auto nodes = group->nodes(e);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        total[static_cast<std::size_t>(nodes[k])] += slots[group->layout().at(e, static_cast<int>(k), component)];
      }
    }
    return total;
  }
  [[nodiscard]] std::vector<Vec3> sum3(int component) const {
    const auto a = sum(component), b = sum(component + 1), c = sum(component + 2);
    std::vector<Vec3> total(x.size());
    for (std::size_t i = 0; i < total.size(); ++i) total[i] = {a[i], b[i], c[i]};
    return total;
  }

  GroupResult step(double dt) {
    const GroupResult r = group->step({x.data(), v.data(), w.data(), 0.0, dt, true}, {nullptr, slots.data()}, pool);
    f = sum3(0);
    stiffness = sum(3);
    m = sum3(4);
    rotational = sum(7);
    return r;
  }

  [[nodiscard]] double kinetic() const {
    double t = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) t += 0.5 * (mass[i] * squared_norm(v[i]) + inertia[i] * squared_norm(w[i]));
    return t;
  }

  /// Leap-frog with constant step: forces at x, kick, drift. `fix` may change velocities after the kick.
  GroupResult cycle(double dt, bool first, const std::function<void(Runner&)>& fix = {}) {
    const GroupResult r = step(first ? 0.0 : dt);
    const double h = first ? 0.5 * dt : dt;
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] -= (h / mass[i]) * f[i];
      w[i] -= (h / inertia[i]) * m[i];
    }
    if (fix) fix(*this);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];
    return r;
  }
};

inline double length(const std::vector<Vec3>& a) {
  double s = 0.0;
  for (const Vec3& b : a) s += squared_norm(b);
  return std::sqrt(s);
}

/// A quad of size about 1: unit square pushed about by up to `distortion`, sheared, stretched by `aspect`, warped by `warp`.
inline std::vector<Vec3> random_quad(std::mt19937& random, double distortion, double aspect, double warp) {
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Vec3> x;
  for (const auto& c : corner) x.push_back({aspect * (c[0] + distortion * d(random)), c[1] + distortion * d(random), warp * d(random)});
  return x;
}

inline bool convex(const std::vector<Vec3>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 a = x[(i + 1) % x.size()] - x[i], b = x[(i + 2) % x.size()] - x[(i + 1) % x.size()];
    if (a.x * b.y - a.y * b.x < 0.15 * norm(a) * norm(b)) return false;
  }
  return true;
}

}  // namespace abut::elements::test
