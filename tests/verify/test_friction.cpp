// Coulomb friction through TYPE3 against closed forms (issue: run a real deck, 6.1; T1: in contact from the start; T19 to T23).
//
// The closed forms are those of a rigid block under a constant normal force; every scene runs on three meshes. While all nodes slip,
// friction over normal impulse is mu to rounding on each of them: there is nothing left to converge. What is left of times, ways and
// accelerations (0.1 %) is no error of the mesh: an elastic block rings (speeds of tau/(rho c_s) = 3 in/s), its normal force with it, and
// its nodes do not stop in the same instant.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::scenes::Block;
using abut::scenes::Recorder;
using abut::scenes::Scene;

/// Bricks of block and base, along x and y and z.
struct Mesh {
  std::array<int, 3> block, base;
};
constexpr std::array<Mesh, 3> meshes{{{{5, 1, 1}, {5, 2, 1}}, {{10, 2, 2}, {10, 3, 1}}, {{20, 4, 4}, {20, 6, 2}}}};

std::string to_text(const Mesh& m) {
  const auto text = [](const std::array<int, 3>& n) {
    return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]);
  };
  return text(m.block) + " on " + text(m.base);
}

/// A block on a fixed base, pressed by a total force N that grows smoothly to its value at t_press. inch, lbf, s.
struct Sliding {
  Sliding(double mu, const Mesh& mesh) : scene("sliding"), material(scene.elastic(7.3e-4, 30e6, 0.3)), property(scene.solid_property()) {
    const Index lower = scene.part(property, material);
    const Index upper = scene.part(property, material);
    base = scene.block(lower, {-1, -0.5, -0.5}, {7.03, 2.03, 0.5}, mesh.base);
    block = scene.block(upper, {0, 0, 0}, {5, 1, 1}, mesh.block);
    scene.fix(base.nodes, {true, true, true});
    scene.contact(scene.surface(base, 2, true), scene.surface(block, 2, false), 0.2, mu, 0.0);
  }
  Scene scene;
  Index material, property;
  Block base, block;
  static constexpr double pressure = 2000.0, area = 5.0, mass = 7.3e-4 * 5.0;
  static constexpr double normal = pressure * area;

  /// Smooth rise 0 -> 1 over [0, t], constant after.
  static std::pair<std::vector<double>, std::vector<double>> ramp(double from, double to) {
    std::vector<double> x{0.0}, y{0.0};
    for (int i = 0; i <= 40; ++i) {
      const double s = i / 40.0;
      x.push_back(from + (to - from) * s + (from == 0.0 && i == 0 ? 1e-12 : 0.0));
      y.push_back(s * s * (3.0 - 2.0 * s));
    }
    x.push_back(to + 1.0);
    y.push_back(1.0);
    return {x, y};
  }
};

/// Displacement or velocity along x of the centre of mass of the watched nodes.
double mean_x(const Recorder& recorder, const Block& block, std::size_t sample, bool velocity) {
  const auto& s = recorder.samples[sample];
  const auto& values = velocity ? s.v : s.u;
  double sum = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double m = recorder.last_state.mass[static_cast<std::size_t>(block.nodes[i])];
    sum += m * values[i].x;
    mass += m;
  }
  return sum / mass;
}

/// Friction over normal impulse of the interface between two samples.
double friction_share(const Recorder& recorder, std::size_t from, std::size_t to) {
  const auto& a = recorder.samples[from].interfaces[0];
  const auto& b = recorder.samples[to].interfaces[0];
  return abut::norm(b.tangential_impulse - a.tangential_impulse) / abut::norm(b.normal_impulse - a.normal_impulse);
}

struct Stop {
  double time = -1.0, way = 0.0;
  double share = 0.0;  // friction over normal impulse while the block has between 95 % and 10 % of its speed
};

/// Sliding block of the issue. Held at v0 while the pressure builds up, then left to friction. Positions are of t^n, velocities of
/// t^(n-1/2): the end of the hold and the instant at which the mean velocity is zero are interpolated.
Stop slide(double mu, double v0, const Mesh& mesh) {
  constexpr double pressed = 2e-4;
  Sliding s(mu, mesh);
  const auto [x, y] = Sliding::ramp(0.0, 0.8 * pressed);
  s.scene.traction(s.block, 2, true, 2, -Sliding::normal, s.scene.function(x, y));
  s.scene.velocity(s.block.nodes, {v0, 0, 0});
  abut::model::ImposedMotion hold;
  hold.id = 1;
  hold.scale_y = v0;
  hold.t_stop = pressed;
  hold.nodes = s.block.nodes;
  s.scene.model.imposed_motions.push_back(hold);
  s.scene.end(pressed + 7e-4);
  Recorder recorder(s.block.nodes);
  const auto report = abut::cycle::run(s.scene.model, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;

  Stop out;
  const auto& samples = recorder.samples;
  double free_from = 0.0;  // last half step with the speed of the hold
  double way_from = 0.0;
  std::size_t fast = 0;
  for (std::size_t i = 2; i < samples.size() && out.time < 0.0; ++i) {
    const double v = mean_x(recorder, s.block, i, true);
    const double half = samples[i].time - 0.5 * samples[i - 1].dt;
    const double before = samples[i - 1].time - 0.5 * samples[i - 2].dt;
    if (v >= v0 * (1.0 - 1e-12)) {
      free_from = half;
      way_from = mean_x(recorder, s.block, i, false) - 0.5 * samples[i - 1].dt * v;
    } else if (v > 0.1 * v0) {
      if (fast == 0 && v < 0.95 * v0) fast = i;
      if (fast > 0 && i > fast) out.share = friction_share(recorder, fast, i);
    } else if (v <= 0.0) {
      const double v_before = mean_x(recorder, s.block, i - 1, true);
      const double zero = before + (half - before) * v_before / (v_before - v);
      // From `before` (half a step before position i - 1) to zero the mean speed is v_before / 2.
      out.way = mean_x(recorder, s.block, i - 1, false) - 0.5 * samples[i - 2].dt * v_before + 0.5 * v_before * (zero - before) - way_from;
      out.time = zero - free_from;
    }
  }
  return out;
}

// A block that slides at 200 in/s under 2000 psi with mu = 0.15 stops after v/(mu g') and v^2/(2 mu g'), g' = p A / m.
TEST(Friction, StopsASlidingBlockWhereCoulombSays) {
  constexpr double mu = 0.15, v0 = 200.0;
  const double expected_time = v0 * Sliding::mass / (mu * Sliding::normal);
  const double expected_way = 0.5 * v0 * expected_time;
  EXPECT_NEAR(expected_time, 4.866e-4, 1e-7);
  EXPECT_NEAR(expected_way, 4.866e-2, 1e-5);
  for (const Mesh& mesh : meshes) {
    const Stop found = slide(mu, v0, mesh);
    std::printf("[found] sliding block, s 0.2, gap 0, %s: stops after %.4e s (%.4e), %.4e in (%.4e), friction / normal impulse %.8f (%g)\n",
                to_text(mesh).c_str(), found.time, expected_time, found.way, expected_way, found.share, mu);
    ASSERT_GT(found.time, 0.0) << "the block never stopped";
    EXPECT_NEAR(found.time, expected_time, 0.01 * expected_time) << to_text(mesh);
    EXPECT_NEAR(found.way, expected_way, 0.01 * expected_way) << to_text(mesh);
    EXPECT_NEAR(found.share, mu, 1e-5 * mu) << to_text(mesh);
  }
}

struct Pushed {
  double way = 0.0;           // mean displacement at the end
  double acceleration = 0.0;  // mean over the last half of the push
  double creep = 0.0;         // mean displacement gained while the push is constant
  double elastic = 0.0;       // tangential force over the sum of tangential stiffness
  double share = 0.0;         // friction over normal impulse over the last half of the push
  double friction_work = 0.0;
};

/// Presses a block, then pushes it with `factor` times the friction limit, in its contact face: a push at mid-height tilts the
/// block, and the side that is relieved slips long before the mean force reaches the limit. The push grows over several periods
/// of the block on its tangential springs (1.8e-4 s), so that it hardly swings beyond the limit.
Pushed push(double factor, const Mesh& mesh) {
  constexpr double mu = 0.3, pressed = 3e-4, pushed = 9e-4, end = 1.5e-3;
  Sliding s(mu, mesh);
  const auto [x, y] = Sliding::ramp(0.0, pressed);
  const auto [px, py] = Sliding::ramp(pressed, pushed);
  s.scene.traction(s.block, 2, true, 2, -Sliding::normal, s.scene.function(x, y));
  const double force = factor * mu * Sliding::normal;
  s.scene.traction(s.block, 2, false, 0, force, s.scene.function(px, py));
  s.scene.end(end);
  Recorder recorder(s.block.nodes);
  const auto report = abut::cycle::run(s.scene.model, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  Pushed out;
  const std::size_t last = recorder.samples.size() - 1;
  std::size_t half = 0;
  while (recorder.samples[half].time < 0.5 * (pushed + end)) ++half;
  out.way = mean_x(recorder, s.block, last, false);
  std::size_t held = 0;
  while (recorder.samples[held].time < pushed) ++held;
  out.creep = std::abs(out.way - mean_x(recorder, s.block, held, false));
  out.acceleration = (mean_x(recorder, s.block, last, true) - mean_x(recorder, s.block, half, true)) /
                     (recorder.samples[last].time - recorder.samples[half].time);
  out.share = friction_share(recorder, half, last);
  out.friction_work = recorder.samples[last].balance.fw;
  // Penetration under N is N / sum K, the elastic slip under F is F / (0.1 sum K): ten times F/N of the penetration.
  double sink = 0.0;
  for (const Index n : s.block.plane(2, false)) sink -= recorder.last_state.u[static_cast<std::size_t>(n)].z;
  sink /= static_cast<double>(s.block.plane(2, false).size());
  out.elastic = 10.0 * force / Sliding::normal * sink;
  return out;
}

// T21, T22: below the limit the block hangs on its tangential springs, whose share falls with the size of the facets: Coulomb's block
// does not move at all.
TEST(Friction, SticksBelowTheLimit) {
  double previous = 1e30;
  for (const Mesh& mesh : meshes) {
    const Pushed p = push(0.95, mesh);
    std::printf("[found] stick at 0.95 mu N, s 0.2, gap 0, %s: way %.4e in, elastic %.4e, creep while held %.3e\n", to_text(mesh).c_str(),
                p.way, p.elastic, p.creep);
    EXPECT_GT(p.way, 0.9 * p.elastic);
    EXPECT_LT(p.creep, p.elastic) << "creep under the constant push";
    EXPECT_LT(p.way, 2.0 * p.elastic) << "creep altogether, with the ramp";
    EXPECT_LT(p.way, previous) << to_text(mesh);
    previous = p.way;
  }
}

// T22: above the limit the block accelerates with (F - mu N)/m.
TEST(Friction, SlidesAboveTheLimit) {
  const double expected = 0.5 * 0.3 * Sliding::normal / Sliding::mass;
  for (const Mesh& mesh : meshes) {
    const Pushed p = push(1.5, mesh);
    std::printf("[found] slip at 1.5 mu N, s 0.2, gap 0, %s: acceleration %.5e in/s2 (%.5e), friction / normal impulse %.8f (0.3)\n",
                to_text(mesh).c_str(), p.acceleration, expected, p.share);
    EXPECT_NEAR(p.acceleration, expected, 0.01 * expected) << to_text(mesh);
    EXPECT_NEAR(p.share, 0.3, 1e-5 * 0.3) << to_text(mesh);
    EXPECT_GT(p.friction_work, 0.0);
  }
}

}  // namespace
