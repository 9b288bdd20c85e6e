// Coulomb friction through TYPE3 against closed forms (issue: run a real deck, 6.1; T1: in contact from the start; T19 to T23).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::scenes::Block;
using abut::scenes::Recorder;
using abut::scenes::Scene;

/// A block on a fixed base, pressed by a total force N that grows smoothly to its value at t_press. inch, lbf, s.
struct Sliding {
  explicit Sliding(double mu, int cells = 10)
      : scene("sliding"), material(scene.elastic(7.3e-4, 30e6, 0.3)), property(scene.solid_property()) {
    const Index lower = scene.part(property, material);
    const Index upper = scene.part(property, material);
    base = scene.block(lower, {-1, -0.5, -0.5}, {7.03, 2.03, 0.5}, {cells, 3, 1});
    block = scene.block(upper, {0, 0, 0}, {5, 1, 1}, {cells, 2, 2});
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

double mean_x(const Recorder& recorder, std::size_t sample, bool velocity) {
  const auto& s = recorder.samples[sample];
  double sum = 0.0;
  for (const auto& value : velocity ? s.v : s.u) sum += value.x;
  return sum / static_cast<double>(s.u.size());
}

// A block that slides at 200 in/s under 2000 psi with mu = 0.15 stops after v/(mu g') and v^2/(2 mu g'), g' = p A / m.
TEST(Friction, StopsASlidingBlockWhereCoulombSays) {
  constexpr double mu = 0.15, v0 = 200.0, pressed = 2e-4;
  Sliding s(mu);
  const auto [x, y] = Sliding::ramp(0.0, 0.8 * pressed);
  s.scene.traction(s.block, 2, true, 2, -Sliding::normal, s.scene.function(x, y));
  s.scene.velocity(s.block.nodes, {v0, 0, 0});
  // Held at v0 while the pressure builds up, then left to friction.
  abut::model::ImposedMotion hold;
  hold.id = 1;
  hold.scale_y = v0;
  hold.t_stop = pressed;
  hold.nodes = s.block.nodes;
  s.scene.model.imposed_motions.push_back(hold);
  s.scene.end(pressed + 7e-4);
  Recorder recorder(s.block.nodes);
  const auto report = abut::cycle::run(s.scene.model, {}, recorder);
  ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;

  const double expected_time = v0 * Sliding::mass / (mu * Sliding::normal);
  const double expected_way = 0.5 * v0 * expected_time;
  EXPECT_NEAR(expected_time, 4.866e-4, 1e-7);
  EXPECT_NEAR(expected_way, 4.866e-2, 1e-5);
  double start_time = 0.0, start_way = 0.0, stop_time = -1.0, stop_way = 0.0;
  for (std::size_t i = 1; i < recorder.samples.size(); ++i) {
    if (recorder.samples[i].time <= pressed) {
      start_time = recorder.samples[i].time;
      start_way = mean_x(recorder, i, false);
    }
    if (stop_time < 0.0 && recorder.samples[i].time > pressed && mean_x(recorder, i, true) <= 0.0) {
      stop_time = recorder.samples[i].time;
      stop_way = mean_x(recorder, i, false);
    }
  }
  std::printf("[found] sliding block, s 0.2, gap 0: stops after %.4e s (%.4e), %.4e in (%.4e)\n", stop_time - start_time, expected_time,
              stop_way - start_way, expected_way);
  ASSERT_GT(stop_time, 0.0) << "the block never stopped";
  EXPECT_NEAR(stop_time - start_time, expected_time, 0.01 * expected_time);
  EXPECT_NEAR(stop_way - start_way, expected_way, 0.01 * expected_way);
}

struct Pushed {
  double way = 0.0;           // mean displacement at the end
  double acceleration = 0.0;  // mean over the last half of the push
  double creep = 0.0;         // mean displacement gained while the push is constant
  double elastic = 0.0;       // tangential force over the sum of tangential stiffness
  double friction_work = 0.0;
};

/// Presses a block, then pushes it with `factor` times the friction limit, in its contact face: a push at mid-height tilts the
/// block, and the side that is relieved slips long before the mean force reaches the limit. The push grows over several periods
/// of the block on its tangential springs (1.8e-4 s), so that it hardly swings beyond the limit.
Pushed push(double factor) {
  constexpr double mu = 0.3, pressed = 3e-4, pushed = 9e-4, end = 1.5e-3;
  Sliding s(mu);
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
  out.way = mean_x(recorder, last, false);
  std::size_t held = 0;
  while (recorder.samples[held].time < pushed) ++held;
  out.creep = std::abs(out.way - mean_x(recorder, held, false));
  out.acceleration =
      (mean_x(recorder, last, true) - mean_x(recorder, half, true)) / (recorder.samples[last].time - recorder.samples[half].time);
  out.friction_work = recorder.samples[last].balance.fw;
  // Penetration under N is N / sum K, the elastic slip under F is F / (0.1 sum K): ten times F/N of the penetration.
  double sink = 0.0;
  for (const Index n : s.block.plane(2, false)) sink -= recorder.last_state.u[static_cast<std::size_t>(n)].z;
  sink /= static_cast<double>(s.block.plane(2, false).size());
  out.elastic = 10.0 * force / Sliding::normal * sink;
  return out;
}

// T21, T22: below the limit the block hangs on its tangential springs.
TEST(Friction, SticksBelowTheLimit) {
  const Pushed p = push(0.95);
  std::printf("[found] stick at 0.95 mu N, s 0.2, gap 0, 10 x 2 x 2 on 10 x 3 x 1: way %.4e, elastic %.4e, creep while held %.3e\n", p.way,
              p.elastic, p.creep);
  EXPECT_GT(p.way, 0.9 * p.elastic);
  EXPECT_LT(p.creep, p.elastic) << "creep under the constant push";
  EXPECT_LT(p.way, 2.0 * p.elastic) << "creep altogether, with the ramp";
}

// T22: above the limit the block accelerates with (F - mu N)/m.
TEST(Friction, SlidesAboveTheLimit) {
  const Pushed p = push(1.5);
  const double expected = 0.5 * 0.3 * Sliding::normal / Sliding::mass;
  std::printf("[found] slip at 1.5 mu N: acceleration %.5e (%.5e)\n", p.acceleration, expected);
  EXPECT_NEAR(p.acceleration, expected, 0.01 * expected);
  EXPECT_GT(p.friction_work, 0.0);
}

}  // namespace
