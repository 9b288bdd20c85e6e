// Options of the TYPE3 card in whole runs (issue: run a real deck, 4): IBC, Tstart and Tstop, Idel, Ptlim. Default profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Block;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

constexpr double young = 210e9, density = 7800.0;

Recorder solve(const Scene& s, const std::vector<Index>& watched = {}) {
  Recorder recorder(watched);
  const auto report = abut::cycle::run(s.model, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  return recorder;
}

/// Two short bars, the upper one falls on the lower one.
struct Drop {
  Drop() : scene("drop") {
    const auto material = scene.elastic(density, young, 0.0);
    const auto property = scene.solid_property();
    lower = scene.block(scene.part(property, material), {0, 0, -0.02}, {0.01, 0.01, 0.02}, {1, 1, 4});
    upper = scene.block(scene.part(property, material), {0, 0, 1e-5}, {0.01, 0.01, 0.02}, {1, 1, 4});
    scene.velocity(upper.nodes, {0, 0, -2.0});
    scene.contact(scene.surface(lower, 2, true), scene.surface(upper, 2, false));
    scene.end(8e-5);
  }
  Scene scene;
  Block lower, upper;
};

// IBC: a boundary condition is released while the node is in contact and comes back after (the reference never gives it back).
TEST(InterfaceOptions, BoundaryConditionIsReleasedInContactAndGivenBack) {
  Drop held;
  const auto top = held.lower.plane(2, true);
  held.scene.fix(top, {true, true, true});
  for (const auto& sample : solve(held.scene, top).samples) {
    for (const Vec3& u : sample.u) EXPECT_EQ(u.z, 0.0);
  }
  Drop d;
  d.scene.fix(top, {true, true, true});
  d.scene.model.interfaces[0].ibc = {false, false, true};
  const Recorder r = solve(d.scene, top);
  bool touched = false;
  double moved = 0.0;
  int after = 0;
  Vec3 kept;
  for (std::size_t i = 1; i < r.samples.size(); ++i) {
    const auto& s = r.samples[i];
    for (const Vec3& u : s.u) {
      EXPECT_EQ(u.x, 0.0) << "only z is released";
      EXPECT_EQ(u.y, 0.0);
    }
    if (s.interfaces[0].in_contact > 0) {
      touched = true;
      after = 0;
      moved = std::max(moved, std::abs(s.u[0].z));
    } else if (touched) {
      // The velocity of the step in which contact ended still moves the node once.
      if (++after == 2) kept = s.u[0];
      if (after > 2) { EXPECT_EQ(s.u[0].z, kept.z) << "held again at " << s.time; }
    } else {
      EXPECT_EQ(s.u[0].z, 0.0);
    }
  }
  std::printf("[found] IBC: released node moves %.3e m in contact, then stays (%d cycles)\n", moved, after);
  EXPECT_TRUE(touched);
  EXPECT_GT(moved, 1e-6);
  EXPECT_GT(after, 10);
}

// Tstart, Tstop: outside the window there is no force; inside it works as without.
TEST(InterfaceOptions, ActsBetweenItsBirthAndDeath) {
  Drop free;
  const Recorder all = solve(free.scene);
  Drop late;
  late.scene.model.interfaces[0].t_start = 1e-5;
  const Recorder r = solve(late.scene);
  Drop early;
  early.scene.model.interfaces[0].t_stop = 1.2e-5;
  const Recorder e = solve(early.scene);
  double before = 0.0, inside = 0.0, after = 0.0, same = 0.0;
  bool whole = false;
  for (const auto& s : all.samples) whole = whole || (s.time < 1e-5 && s.interfaces[0].in_contact > 0);
  EXPECT_TRUE(whole) << "contact would begin before Tstart";
  for (const auto& s : r.samples) (s.time < 1e-5 ? before : inside) += norm(s.interfaces[0].normal_force);
  for (std::size_t i = 0; i < e.samples.size(); ++i) {
    const auto& s = e.samples[i];
    if (s.time > 1.2e-5) {
      after += norm(s.interfaces[0].normal_force);
    } else if (i < all.samples.size() && s.time == all.samples[i].time) {
      same = std::max(same, norm(s.interfaces[0].normal_force - all.samples[i].interfaces[0].normal_force));
    }
  }
  EXPECT_EQ(before, 0.0);
  EXPECT_GT(inside, 0.0);
  EXPECT_EQ(after, 0.0);
  EXPECT_EQ(same, 0.0) << "until Tstop nothing differs";
  // What the springs held at Tstop is booked as lost, not hidden.
  const auto& last = e.samples.back().balance;
  std::printf("[found] Tstop: CX %.3e of the largest term, ERR %.1e\n", last.cx / last.largest, last.err);
  EXPECT_EQ(last.ce, 0.0);
}

/// A brick coated with a shell that breaks (LAW2, eps_max), hit by a block. The coating's facets have two elements: shell, brick.
struct Coated {
  Coated(int idel, bool brick_behind) : scene("coated") {
    const auto steel = scene.elastic(density, young, 0.3);
    const auto brittle = scene.johnson_cook(density, young, 0.3, 1e7, 1e7, 1.0);
    std::get<model::LawJohnsonCook>(scene.model.materials[static_cast<std::size_t>(brittle)].law).eps_max = 1e-6;
    const auto solid = scene.solid_property();
    const auto shell = scene.part(scene.shell_property(0.0005, 3), brittle);
    const auto corner = [](double u, double v) { return Vec3{0.03 * u, 0.03 * v, 0.0}; };
    const auto skin = scene.shells(shell, 3, 3, corner);
    std::vector<Index> rim;
    for (Index j = 0; j <= 3; ++j) {
      for (Index i = 0; i <= 3; ++i) {
        if (i == 0 || i == 3 || j == 0 || j == 3) rim.push_back(skin[static_cast<std::size_t>(i + 4 * j)]);
      }
    }
    if (brick_behind) {
      const auto body = scene.block(scene.part(solid, steel), {0, 0, -0.02}, {0.03, 0.03, 0.02}, {3, 3, 2});
      const auto face = body.plane(2, true);
      // The shells take the nodes of the brick's face.
      for (auto& nodes : scene.model.shells.nodes) {
        for (Index& n : nodes) n = face[static_cast<std::size_t>(n - skin.front())];
      }
      scene.fix(body.plane(2, false), {true, true, true});
      scene.fix(skin, {true, true, true}, {true, true, true});  // left without elements
    } else {
      scene.fix(rim, {true, true, true}, {true, true, true});
    }
    const auto ram = scene.block(scene.part(solid, steel), {0.007, 0.008, 1e-5}, {0.016, 0.015, 0.02}, {2, 2, 2});
    scene.velocity(ram.nodes, {0, 0, -60.0});
    scene.contact(scene.shell_surface(shell), scene.surface(ram, 2, false));
    scene.model.interfaces[0].idel = idel;
    for (const Index n : ram.plane(2, false)) bottom.push_back(n);
    scene.model.controls.stop_energy_error = 10.0;  // springs that go with their facets take what they held (CX): let it run
    scene.end(2.5e-4);
  }
  Scene scene;
  std::vector<Index> bottom;
};

struct Fate {
  double depth = 0.0;  // how far the ram's face went below where it started
  double speed = 0.0;  // of its face at the end
  double last_force = 0.0;
  double xe = 0.0, err = 0.0;
};

Fate hit(const Coated& c) {
  const Recorder r = solve(c.scene, c.bottom);
  Fate f;
  for (const auto& s : r.samples) f.depth = std::max(f.depth, -s.u[0].z);
  const auto& last = r.samples.back();
  f.speed = last.v[0].z;
  f.last_force = norm(last.interfaces[0].normal_force);
  f.err = last.balance.err;
  return f;
}

// Idel 1: a facet goes when all its elements are gone; Idel 2: when one is. T11 goes on acting on facets that stay.
TEST(InterfaceOptions, IdelLetsGoOfErodedFacets) {
  const Fate plate_1 = hit(Coated(1, false));
  const Fate plate_2 = hit(Coated(2, false));
  const Fate brick_1 = hit(Coated(1, true));
  const Fate brick_2 = hit(Coated(2, true));
  std::printf("[found] Idel, plate: depth %.3e (1), %.3e (2); coated brick: depth %.3e (1), %.3e (2); end speeds %.1f %.1f %.1f %.1f m/s\n",
              plate_1.depth, plate_2.depth, brick_1.depth, brick_2.depth, plate_1.speed, plate_2.speed, brick_1.speed, brick_2.speed);
  EXPECT_GT(plate_1.depth, 0.005) << "through the broken plate";
  EXPECT_EQ(plate_1.last_force, 0.0);
  EXPECT_GT(plate_2.depth, 0.005);
  EXPECT_LT(brick_1.depth, 0.002) << "the brick behind the broken coating still holds the facet";
  EXPECT_GT(brick_1.speed, 0.0) << "and throws the block back";
  // The facets went with their shells, but their nodes still belong to the bricks behind: the pass that holds them against the
  // ram goes on (numerics.md 7.4.7), with fewer springs.
  EXPECT_GT(brick_2.depth, 1.1 * brick_1.depth);
  EXPECT_GT(brick_2.speed, 0.0);
  EXPECT_LT(brick_2.speed, 0.9 * brick_1.speed);
}

// Ptlim: the friction stress is at most Ptlim (the reference reads and ignores it). A block pressed by 2000 psi at mu = 0.3 would
// be slowed by 600 psi; with Ptlim = 300 psi it is slowed by 300 psi.
TEST(InterfaceOptions, PtlimLimitsTheFrictionStress) {
  constexpr double area = 5.0, pressure = 2000.0;
  const auto slowed = [&](double ptlim) {
    Scene s("ptlim");
    const auto material = s.elastic(7.3e-4, 30e6, 0.3);
    const auto property = s.solid_property();
    const auto base = s.block(s.part(property, material), {-0.875, -0.375, -0.5}, {7.0, 1.75, 0.5},
                              {28, 7, 1});  // its nodes under the block stand for just 5 in^2
    const auto block = s.block(s.part(property, material), {0, 0, 0}, {5, 1, 1}, {10, 2, 2});
    s.fix(base.nodes, {true, true, true});
    s.contact(s.surface(base, 2, true), s.surface(block, 2, false), 0.2, 0.3, 0.0);
    s.model.interfaces[0].ptlim = ptlim;
    std::vector<double> x{0.0}, y{0.0};
    for (int i = 1; i <= 40; ++i) {
      x.push_back(1e-4 * i / 40.0);
      y.push_back((i / 40.0) * (i / 40.0) * (3.0 - 2.0 * i / 40.0));
    }
    x.push_back(1.0);
    y.push_back(1.0);
    s.traction(block, 2, true, 2, -pressure * area, s.function(x, y));
    s.velocity(block.nodes, {400, 0, 0});
    s.end(4e-4);
    const Recorder r = solve(s);
    double force = 0.0;
    double normal = 0.0;
    double time = 0.0;
    for (const auto& sample : r.samples) {
      if (sample.time < 2e-4) continue;
      force += sample.dt * std::abs(sample.interfaces[0].tangential_force.x);
      normal += sample.dt * std::abs(sample.interfaces[0].normal_force.z);
      time += sample.dt;
    }
    return std::pair{force / time / area, normal / time / area};
  };
  const auto [coulomb, pressed] = slowed(model::infinity);
  const double limited = slowed(300.0).first;
  const double loose = slowed(5000.0).first;
  std::printf("[found] Ptlim: friction stress %.2f psi without (0.3 x %.1f), %.1f psi with 300, %.1f psi with 5000\n", coulomb, pressed,
              limited, loose);
  EXPECT_NEAR(coulomb, 0.3 * pressed, 1e-5 * coulomb);  // x and z parts: facets tilt a little
  EXPECT_NEAR(pressed, pressure, 0.02 * pressure);
  EXPECT_NEAR(loose, coulomb, 1e-9 * coulomb);
  EXPECT_NEAR(limited, 300.0, 0.02 * 300.0);
}

}  // namespace
