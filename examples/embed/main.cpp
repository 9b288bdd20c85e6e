// A solver of another author that takes its contacts from abut: nodes, springs, leap-frog; nothing of abut but its contact library.
//
// A block (a lattice of springs) is pressed into the corner of a box (nodes on springs) by Nz and Ny and pushed off along x. Three
// interfaces: floor (two surfaces), side wall (nodes to surface), end wall (both sides); a corner of the block belongs to all of them.
// Friction brakes it at
//   a = mu (Nz + Ny)/M,   so it comes to rest after the path  s = v0^2/(2 a),   and  M v0^2/2  has become friction work,
// also when the end wall has thrown it back in between: to 2 %, which its vibrations take. On the way a facet of the floor is eroded
// and a checkpoint is taken; a second solver goes on from it and must end with the same bits.
#include <abut/contact/interface.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <tuple>
#include <vector>

namespace {

using abut::Index;
using abut::Vec3;
namespace contact = abut::contact;

constexpr double mu = 0.1, Nz = 0.5, Ny = 1.0 / 3.0, M = 1.0, v0 = 1.0;
constexpr double settled = 6.0, eroded = settled + 1.5, saved = settled + 3.0, rested = settled + 16.0;  // times

struct Spring {
  Index a, b;
  double k, c, length;
};

/// Everything a restart needs.
struct Checkpoint {
  std::vector<Vec3> x, v;
  double t, dt, dtBefore, path;
  bool pushed, hole;
  std::vector<std::vector<std::byte>> history;
};

class Solver {
 public:
  Solver() {
    // The block: 3 x 3 x 3 nodes in [0, 2]^3, each on springs to its 26 neighbours at most.
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) node({1.0 * i, 1.0 * j, 1.0 * k}, M / 27);
    for (Index a = 0; a < 27; ++a)
      for (Index b = a + 1; b < 27; ++b) {
        const double length = norm(x[at(b)] - x[at(a)]);
        if (length < 1.8) springs.push_back({a, b, 100.0, 0.005, length});
      }
    // The box: facets see the block on their positive side; its nodes are on stiff springs to the ground.
    const double g = clearance;
    const auto floor = grid({-1.3, -g, -g}, {9.3, 0, 0}, {0, 4.1, 0}, 8, 4);
    const auto side = grid({-1.3, -g, -g}, {0, 0, 4.1}, {9.3, 0, 0}, 4, 8);
    const auto end = grid({6.9, -g, -g}, {0, 0, 4.1}, {0, 4.1, 0}, 1, 1);
    box = 27;
    home = x;
    force.resize(x.size());
    stiffness.resize(x.size());

    const auto blockNode = [](int i, int j, int k) { return static_cast<Index>(i + 3 * j + 9 * k); };
    std::vector<contact::Facet> bottom;
    std::vector<Index> sideNodes, endNodes;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        bottom.push_back({{blockNode(i, j, 0), blockNode(i, j + 1, 0), blockNode(i + 1, j + 1, 0), blockNode(i + 1, j, 0)}});
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        sideNodes.push_back(blockNode(i, 0, k));
        endNodes.push_back(blockNode(2, i, k));
      }
    contact::Options rub;
    rub.gap = 0.1;
    rub.friction = mu;
    contact::BothSidesOptions bounce;
    bounce.gap = 0.3;
    bounce.damping = 0.0;
    contacts.push_back(contact::Interface::two_surfaces(contact::Surface(floor), contact::Surface(bottom), rub));
    contacts.push_back(contact::Interface::nodes_to_surface(sideNodes, std::vector<double>(9, 10.0), contact::Surface(side), rub));
    contacts.push_back(contact::Interface::both_sides(endNodes, contact::Surface(end), bounce));
    floorFacets = floor.size();
    contacts[0].set_surface(0, {.stiffness = std::vector<double>(floor.size(), 20.0)});
    contacts[0].set_surface(1, {.stiffness = std::vector<double>(bottom.size(), 20.0)});
    contacts[1].set_surface(1, {.stiffness = std::vector<double>(side.size(), 20.0)});
    contacts[2].set_surface(1, {.stiffness = std::vector<double>(end.size(), 20.0)});
  }

  void recordFloor(std::ostream& log) { contacts[0].record(log, "examples/embed, floor"); }

  void step() {
    if (!hole && t >= eroded) makeHole();
    if (!pushed && t >= settled) {
      for (Index n = 0; n < box; ++n) v[at(n)].x += v0;
      pushed = true;
    }
    std::fill(force.begin(), force.end(), Vec3{});
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    const contact::HostState now{.x = x, .v = v, .mass = mass, .time = t, .dt = dt, .dt_bar_old = 0.5 * (dt + dtBefore)};
    double limit = 1e30;
    for (contact::Interface& c : contacts) c.search(now);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      result[i] = contacts[i].evaluate(now, force, stiffness);
      limit = std::min(limit, result[i].kinematic_step);
    }
    springForces();
    for (std::size_t n = 0; n < x.size(); ++n) limit = std::min(limit, 0.8 * std::sqrt(2.0 * mass[n] / stiffness[n]));
    const double next = dt > 0.0 ? std::min(limit, 1.1 * dt) : 0.1 * limit;
    Vec3 moved;
    for (std::size_t n = 0; n < x.size(); ++n) {
      v[n] += (0.5 * (dt + next) / mass[n]) * force[n];
      x[n] += next * v[n];
      if (n < at(box)) moved += (next / 27.0) * v[n];
    }
    if (pushed) path += std::abs(moved.x);
    for (contact::Interface& c : contacts) c.commit(next);
    dtBefore = dt;
    dt = next;
    t += next;
  }

  [[nodiscard]] Checkpoint save() const {
    Checkpoint c{x, v, t, dt, dtBefore, path, pushed, hole, {}};
    for (const contact::Interface& i : contacts) c.history.push_back(i.history());
    return c;
  }
  void load(const Checkpoint& c) {
    x = c.x, v = c.v, t = c.t, dt = c.dt, dtBefore = c.dtBefore, path = c.path, pushed = c.pushed;
    if (c.hole) makeHole();  // what set_surface() was given belongs to the host
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].restore(c.history[i]);
  }

  std::vector<Vec3> x, v;
  double t = 0.0, path = 0.0;
  std::array<contact::StepResult, 3> result;

 private:
  static constexpr double clearance = 0.08;  // less than the gap of floor and side wall
  std::vector<Vec3> home, force;
  std::vector<double> mass, stiffness;
  std::vector<Spring> springs;
  std::vector<contact::Interface> contacts;
  std::map<std::tuple<double, double, double>, Index> boxNodes;  // the planes of the box share the nodes of their common edges
  Index box = 0;                                                 // first node of the box
  std::size_t floorFacets = 0;
  double dt = 0.0, dtBefore = 0.0;
  bool pushed = false, hole = false;

  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  Index node(const Vec3& p, double m) {
    x.push_back(p);
    v.push_back({});
    mass.push_back(m);
    return static_cast<Index>(x.size() - 1);
  }

  /// Quadrilaterals over p + s a + u b with the normal a x b.
  std::vector<contact::Facet> grid(const Vec3& p, const Vec3& a, const Vec3& b, int na, int nb) {
    std::vector<Index> n;
    for (int j = 0; j <= nb; ++j)
      for (int i = 0; i <= na; ++i) {
        const Vec3 q = p + (1.0 * i / na) * a + (1.0 * j / nb) * b;
        const auto [found, fresh] = boxNodes.try_emplace({q.x, q.y, q.z}, 0);
        if (fresh) found->second = node(q, 0.1);
        n.push_back(found->second);
      }
    std::vector<contact::Facet> facets;
    for (int j = 0; j < nb; ++j)
      for (int i = 0; i < na; ++i) {
        const auto k = static_cast<std::size_t>(j * (na + 1) + i), up = k + static_cast<std::size_t>(na) + 1;
        facets.push_back({{n[k], n[k + 1], n[up + 1], n[up]}});
      }
    return facets;
  }

  void makeHole() {  // under the block when it comes by
    std::vector<std::uint8_t> active(floorFacets, 1);
    active[2] = 0;
    contacts[0].set_surface(0, {.active = active});
    hole = true;
  }

  void springForces() {
    for (const Spring& s : springs) {
      const Vec3 d = x[at(s.b)] - x[at(s.a)];
      const double length = norm(d);
      const Vec3 n = d / length;
      const Vec3 f = (s.k * (length - s.length) + s.c * dot(v[at(s.b)] - v[at(s.a)], n)) * n;
      force[at(s.a)] += f;
      force[at(s.b)] -= f;
      for (const Index i : {s.a, s.b}) stiffness[at(i)] += s.k;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (i < at(box)) {
        force[i] += Vec3{0.0, -Ny / 27, -Nz / 27};
        if (!pushed) force[i] -= (2.0 * mass[i]) * v[i];
      } else {
        force[i] -= 1000.0 * (x[i] - home[i]) + 0.2 * v[i];
        stiffness[i] += 1000.0;
      }
    }
  }
};

bool check(const char* what, double got, double expected, double tolerance) {
  const bool good = std::abs(got - expected) <= tolerance * std::abs(expected);
  std::printf("%-28s %.6f, closed form %.6f%s\n", what, got, expected, good ? "" : "  <-- not within its tolerance");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Solver a;
  std::ofstream log;
  if (argc > 1) {  // embed FILE: keep the calls of the floor for abut replay
    log.open(argv[1], std::ios::binary);
    a.recordFloor(log);
  }
  Checkpoint checkpoint;
  double endWall = 0.0, supported = 0.0;
  while (a.t < rested) {
    if (checkpoint.x.empty() && a.t >= saved) checkpoint = a.save();
    a.step();
    endWall = std::max(endWall, a.result[2].normal_force.x);
    if (a.t < settled) supported = a.result[0].normal_force.z - a.result[1].tangential_force.z;
  }
  Solver b;
  b.load(checkpoint);
  while (b.t < rested) b.step();

  bool good = check("weight carried at rest", supported, Nz, 1e-3);
  good = check("path until rest", a.path, M * v0 * v0 / (2.0 * mu * (Nz + Ny)), 0.02) && good;
  good = check("friction work", a.result[0].friction_work + a.result[1].friction_work, 0.5 * M * v0 * v0, 0.02) && good;
  double made = 0.0;
  for (const contact::StepResult& r : a.result) made += std::abs(r.made);
  std::printf("largest force of the end wall %.3f; energy made by the contacts %.1e\n", endWall, made);
  good = good && endWall > 1.0 && made < 2e-3 && checkpoint.hole;
  const auto same = [](const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
    return std::memcmp(p.data(), q.data(), p.size() * sizeof(Vec3)) == 0;
  };
  const bool bits = same(a.x, b.x) && same(a.v, b.v) && a.result[0].friction_work == b.result[0].friction_work;
  std::printf("resumed at t = %.3f: %s\n", checkpoint.t, bits ? "the same bits" : "DIFFERENT BITS");
  return good && bits ? 0 : 1;
}
