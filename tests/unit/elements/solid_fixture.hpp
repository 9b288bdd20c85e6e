// A hand-made model of one part, a group of its elements and a minimal explicit loop, for the tests of solids.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "elements/group.hpp"
#include "model/model.hpp"
#include "parallel/thread_pool.hpp"

namespace abut::elements::test {

inline model::LawElastic steel() { return {210.0, 0.3}; }

/// Corners of the cube [0,1]^3 in the order of numerics.md 0.5 (xi, eta, zeta = x, y, z).
inline std::vector<Vec3> unit_cube() { return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}; }

/// Deterministic uniform numbers in [-1, 1].
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return 2.0 * static_cast<double>(engine_()) / 4294967295.0 - 1.0; }
  Vec3 vec() {
    const double a = (*this)(), b = (*this)(), c = (*this)();
    return {a, b, c};
  }

 private:
  std::mt19937 engine_;
};

struct Rotation {
  std::array<Vec3, 3> rows;
  Vec3 operator*(const Vec3& a) const { return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)}; }
};

/// Rotation about a unit axis [Rodrigues].
inline Rotation rotation(Vec3 axis, double angle) {
  axis = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  Rotation r;
  for (int i = 0; i < 3; ++i) {
    Vec3 e;
    e[i] = 1.0;
    const Vec3 column = c * e + s * cross(axis, e) + ((1.0 - c) * dot(axis, e)) * axis;
    for (int j = 0; j < 3; ++j) r.rows[static_cast<std::size_t>(j)][i] = column[j];
  }
  return r;
}

struct SolidSetup {
  model::Law law = steel();
  double density = 7.8;
  model::SolidProperty property;
  Profile profile;
  double step_minimum = 0.0;
  model::StepControl::Action action = model::StepControl::Action::none;
  int threads = 1;
};

/// One part of bricks (8 nodes each) or tetrahedra (4), with nodal state.
class SolidBody {
 public:
  SolidBody(std::vector<Vec3> nodes, const std::vector<std::vector<Index>>& elements, const SolidSetup& setup)
      : pool(setup.threads), x(std::move(nodes)), v(x.size()), f(x.size()), m(x.size(), 0.0), k(x.size(), 0.0) {
    model.node_x = x;
    for (std::size_t i = 0; i < x.size(); ++i) model.node_id.push_back(static_cast<Id>(i) + 1);
    model.materials.push_back({1, "", setup.density, setup.density, setup.law});
    model.properties.push_back({1, "", setup.property});
    model.parts.push_back({1, "", 0, 0, 0.0});
    GroupInput in;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto id = static_cast<Id>(e) + 1;
      if (elements[e].size() == 8) {
        std::array<Index, 8> n{};
        std::copy(elements[e].begin(), elements[e].end(), n.begin());
        model.bricks.id.push_back(id);
        model.bricks.part.push_back(0);
        model.bricks.nodes.push_back(n);
      } else {
        std::array<Index, 4> n{};
        std::copy(elements[e].begin(), elements[e].end(), n.begin());
        model.tetras.id.push_back(id);
        model.tetras.part.push_back(0);
        model.tetras.nodes.push_back(n);
      }
      in.elements.push_back(static_cast<Index>(e));
    }
    in.model = &model;
    in.part = 0;
    in.profile = setup.profile;
    in.step_minimum = setup.step_minimum;
    in.step_action = setup.action;
    group = elements.front().size() == 8 ? make_brick8(in) : make_tetra4(in);
    slots.assign(group->layout().size(), -1.0);
    group->add_masses(m, {});
  }

  /// Steps the group over `dt` with the present x and v; f becomes the sum of internal forces, k of the stiffnesses.
  GroupResult step(double dt) {
    StepInput in;
    in.x = x.data();
    in.v = v.data();
    in.dt = dt;
    in.time = time;
    in.part_sums = true;
    result = group->step(in, {nullptr, slots.data()}, pool);
    std::fill(f.begin(), f.end(), Vec3{});
    std::fill(k.begin(), k.end(), 0.0);
    for_slots([this](Index node, std::size_t at) {
      f[static_cast<std::size_t>(node)] += Vec3{slots[at], slots[at + 8], slots[at + 16]};
      k[static_cast<std::size_t>(node)] += slots[at + 24];
    });
    return result;
  }

  /// Moves the nodes by v dt, then steps the group.
  GroupResult advance(double dt) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];
    time += dt;
    return step(dt);
  }

  template <class Field>
  void set_velocity(Field field) {
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = field(x[i]);
  }

  [[nodiscard]] ElementOutput output(Index e = 0) const { return group->output(e); }

  model::Model model;
  parallel::ThreadPool pool;
  std::unique_ptr<Group> group;
  std::vector<Vec3> x, v, f;
  std::vector<double> m, k, slots;
  GroupResult result;
  double time = 0.0;

 private:
  template <class Body>
  void for_slots(Body body) {
    for (Index e = 0; e < group->size(); ++e) {
      const auto nodes = group->nodes(e);
      for (std::size_t i = 0; i < nodes.size(); ++i) body(nodes[i], group->layout().at(e, static_cast<int>(i), 0));
    }
  }
};

/// Nodes and bricks of a box of nx by ny by nz cells of size `cell`.
struct Box {
  std::vector<Vec3> nodes;
  std::vector<std::vector<Index>> bricks;
  int nx, ny, nz;
  [[nodiscard]] Index node(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }
  Box(int nx_in, int ny_in, int nz_in, Vec3 cell) : nx(nx_in), ny(ny_in), nz(nz_in) {
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) nodes.push_back({cell.x * i, cell.y * j, cell.z * k});
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          bricks.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
                            node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  }
  [[nodiscard]] bool interior(int i, int j, int k) const { return i > 0 && i < nx && j > 0 && j < ny && k > 0 && k < nz; }
};

/// Six tetrahedra per brick around the diagonal 0-6.
inline std::vector<std::vector<Index>> split(const std::vector<std::vector<Index>>& bricks) {
  std::vector<std::vector<Index>> out;
  constexpr int ring[7] = {1, 2, 3, 7, 4, 5, 1};
  for (const auto& b : bricks)
    for (int i = 0; i < 6; ++i) out.push_back({b[0], b[static_cast<std::size_t>(ring[i])], b[static_cast<std::size_t>(ring[i + 1])], b[6]});
  return out;
}

}  // namespace abut::elements::test
