// What must not matter: where the model lies, how it is turned, numbered and measured, and which surface is called first
// (issue: run a real deck, 6.4; T2). Every scene runs until every node that touches has done so for 50 cycles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <random>

#include "support/impacts.hpp"
#include "support/recorder.hpp"

namespace {

using abut::Id;
using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
namespace model = abut::model;

struct Case {
  const char* name;
  std::function<model::Model()> build;
};

using abut::scenes::corner;
using abut::scenes::mixed;
using abut::scenes::plates;
using abut::scenes::slide;

struct Result {
  std::vector<Vec3> u;  // by node as built
  std::vector<double> energies;
  Index in_contact = 0;
  std::size_t steady = 0;  // cycles since the number of touching nodes last reached a new high
  std::size_t cycles = 0;
};

Result solve(const model::Model& m) {
  Recorder recorder;
  const auto report = abut::cycle::run(m, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  Result r;
  r.u.assign(recorder.last_state.u.begin(), recorder.last_state.u.end());
  const auto& b = recorder.samples.back().balance;
  r.energies = {b.ie, b.he, b.ke, b.ker, b.ce, b.fw};
  std::size_t latest = 0;
  for (std::size_t i = 0; i < recorder.samples.size(); ++i) {
    if (recorder.samples[i].interfaces[0].in_contact > r.in_contact) {
      r.in_contact = recorder.samples[i].interfaces[0].in_contact;
      latest = i;
    }
  }
  r.cycles = recorder.samples.size();
  r.steady = r.cycles - latest;
  return r;
}

/// Largest difference of displacements over the largest displacement, and of energies over the largest energy.
double difference(const Result& a, const Result& b, const std::function<Vec3(Vec3)>& back, double energy_scale) {
  double largest = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < a.u.size(); ++i) {
    largest = std::max(largest, norm(a.u[i]));
    off = std::max(off, norm(a.u[i] - back(b.u[i])));
  }
  double energy = 0.0;
  double energy_off = 0.0;
  for (std::size_t i = 0; i < a.energies.size(); ++i) {
    energy = std::max(energy, std::abs(a.energies[i]));
    energy_off = std::max(energy_off, std::abs(a.energies[i] - energy_scale * b.energies[i]));
  }
  return std::max(off / largest, energy_off / energy);
}

Vec3 same(Vec3 v) { return v; }

model::Model moved(model::Model m, const Vec3& by) {
  for (Vec3& x : m.node_x) x += by;
  return m;
}

/// Rotation by `angle` about `axis` (Rodrigues).
Vec3 turn(const Vec3& v, const Vec3& axis, double angle) {
  const Vec3 e = normalized(axis);
  return std::cos(angle) * v + std::sin(angle) * cross(e, v) + (1.0 - std::cos(angle)) * dot(e, v) * e;
}

model::Model turned(model::Model m, const Vec3& axis, double angle) {
  for (Vec3& x : m.node_x) x = turn(x, axis, angle);
  for (auto& v : m.initial_velocities) v.value = turn(v.value, axis, angle);
  return m;
}

std::vector<std::size_t> shuffled(std::size_t n, unsigned seed) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(seed);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

template <std::size_t N>
void renumber_elements(model::Elements<N>& e, const std::vector<Index>& node, unsigned seed, std::vector<Index>& new_place) {
  const auto order = shuffled(e.id.size(), seed);
  const model::Elements<N> old = e;
  new_place.assign(order.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    e.part[i] = old.part[order[i]];
    if (!old.thickness.empty()) e.thickness[i] = old.thickness[order[i]];
    for (std::size_t k = 0; k < N; ++k) e.nodes[i][k] = node[static_cast<std::size_t>(old.nodes[order[i]][k])];
    new_place[order[i]] = static_cast<Index>(i);
  }
}

/// Other numbers for nodes and elements: ids stay 1..n, what they stand for is shuffled. @return model and new place of each node
std::pair<model::Model, std::vector<Index>> renumbered(model::Model m) {
  const auto order = shuffled(m.node_id.size(), 7);
  std::vector<Index> node(order.size());
  const auto old = m.node_x;
  for (std::size_t i = 0; i < order.size(); ++i) {
    m.node_x[i] = old[order[i]];
    node[order[i]] = static_cast<Index>(i);
  }
  std::vector<Index> shell, brick;
  renumber_elements(m.shells, node, 8, shell);
  renumber_elements(m.bricks, node, 9, brick);
  const auto map_all = [&node](std::vector<Index>& list) {
    for (Index& n : list) n = node[static_cast<std::size_t>(n)];
    std::sort(list.begin(), list.end());
  };
  for (auto& v : m.initial_velocities) map_all(v.nodes);
  for (auto& b : m.boundary_conditions) map_all(b.nodes);
  for (auto& surface : m.surfaces) {
    for (auto& segment : surface.segments) {
      for (Index& n : segment.nodes) n = node[static_cast<std::size_t>(n)];
      auto& e = segment.element;
      e.index = e.kind == model::ElementKind::brick ? brick[static_cast<std::size_t>(e.index)] : shell[static_cast<std::size_t>(e.index)];
    }
  }
  return {m, node};
}

/// kg, m, s -> Mg, mm, s.
model::Model in_millimetres(model::Model m) {
  for (Vec3& x : m.node_x) x *= 1e3;
  for (auto& v : m.initial_velocities) v.value *= 1e3;
  for (auto& material : m.materials) {
    material.density *= 1e-12;
    material.reference_density *= 1e-12;
    if (auto* e = std::get_if<model::LawElastic>(&material.law)) e->young *= 1e-6;
    if (auto* p = std::get_if<model::LawJohnsonCook>(&material.law)) {
      p->young *= 1e-6;
      p->a *= 1e-6;
      p->b *= 1e-6;
    }
  }
  for (auto& p : m.properties) {
    if (auto* shell = std::get_if<model::ShellProperty>(&p.data)) shell->thickness *= 1e3;
  }
  for (auto& i : m.interfaces) i.gap *= 1e3;
  return m;
}

model::Model swapped(model::Model m) {
  auto& t3 = std::get<model::InterfaceType3>(m.interfaces[0].type);
  std::swap(t3.surface_1, t3.surface_2);
  return m;
}

class Invariance : public testing::TestWithParam<Case> {};

TEST_P(Invariance, NothingButThePhysicsMatters) {
  const model::Model m = GetParam().build();
  const Result base = solve(m);
  EXPECT_GT(base.in_contact, 0);
  EXPECT_GE(base.steady, 50U) << "nodes still come into contact";
  const auto report = [&](const char* what, double off, double limit) {
    std::printf("[found] invariance, %s, %s: %.1e (%d nodes touch, %zu of %zu cycles since the last came)\n", GetParam().name, what, off,
                static_cast<int>(base.in_contact), base.steady, base.cycles);
    EXPECT_LT(off, limit) << what;
  };
  report("moved by its size", difference(base, solve(moved(m, {0.0317, -0.0523, 0.0711})), same, 1.0), 1e-6);
  report("turned by 0.7 about (1 2 3)",
         difference(
             base, solve(turned(m, {1, 2, 3}, 0.7)),
             [](Vec3 v) {
               return turn(v, {1, 2, 3}, -0.7);
             },
             1.0),
         1e-6);
  const auto [other, place] = renumbered(m);
  Result numbered = solve(other);
  std::vector<Vec3> u(numbered.u.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = numbered.u[static_cast<std::size_t>(place[i])];
  numbered.u = u;
  report("renumbered", difference(base, numbered, same, 1.0), 1e-6);
  report("Mg mm s",
         difference(
             base, solve(in_millimetres(m)), [](Vec3 v) { return 1e-3 * v; }, 1e-3),
         1e-6);
  report("surfaces swapped", difference(base, solve(swapped(m)), same, 1.0), 1e-6);
  // Far from the origin positions lose digits: at 1e4 sizes 1e-16 * 1e3 m against penetrations of 1e-6 m.
  std::printf("[found] invariance, %s, moved by 1 km: %.1e\n", GetParam().name,
              difference(base, solve(moved(m, {1000.0, 1000.0, 1000.0})), same, 1.0));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Invariance,
                         testing::Values(Case{"plates", [] { return plates(); }}, Case{"slide", [] { return slide(); }},
                                         Case{"mixed", [] { return mixed(); }}, Case{"corner", [] { return corner(); }}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
