// Press fit: two clamped bars that overlap are pushed apart over a time (contact::Options::start_duration; issue 3, section 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::scenes::Block;
using abut::scenes::Recorder;
using abut::scenes::Scene;

constexpr double young = 200e9, density = 7800.0, side = 0.01, length = 0.08, overlap = 2e-5;
constexpr int cells = 8;

struct Pressed {
  Recorder recorder;
  double largest = 0.0, force = 0.0;
};

/// Bars of one brick across, nu = 0: all four nodes of an end move alike, so the statics are those of springs in a row.
Pressed press(double duration, double end) {
  Scene s("press fit");
  const Index material = s.elastic(density, young, 0.0);
  const Index property = s.linear_solid_property();
  const Block lower = s.block(s.part(property, material), {0, 0, -length}, {side, side, length}, {1, 1, cells});
  const Block upper = s.block(s.part(property, material), {0, 0, -overlap}, {side, side, length}, {1, 1, cells});
  s.fix(lower.plane(2, false), {true, true, true});
  s.fix(upper.plane(2, true), {true, true, true});
  s.contact(s.surface(lower, 2, true), s.surface(upper, 2, false), 0.2);
  s.end(end);
  abut::cycle::RunOptions options;
  if (duration > 0.0) {
    abut::InterfaceChoice choice;
    choice.interface_id = s.model.interfaces[0].id;
    choice.start_duration = duration;
    options.contacts.push_back(choice);
  }
  Pressed out;
  (void)abut::cycle::run(s.model, options, out.recorder);
  for (const auto& sample : out.recorder.samples) {
    out.force = sample.interfaces[0].normal_force.z;
    out.largest = std::max(out.largest, out.force);
  }
  return out;
}

// F = overlap/(2 L/(E A) + 1/Kc): Kc of four facing pairs, two passes, each s K1 K2/(K1 + K2) with K1 = B A^2/V and K2 = K1/4 (T13, T17).
// A start over 25 passages of the wave gets there without a bounce; its work is that of the static overlap, F overlap/2.
TEST(GradualStart, PressFitSettlesAtItsStaticForce) {
  const double speed = std::sqrt(young / density), passage = length / speed, duration = 25.0 * passage;
  const double area = side * side, facet = young / 3.0 * area * area / (area * length / cells);
  const double pairs = 4.0 * 2.0 * 0.2 * facet * 0.25 / 1.25;
  const double force = overlap / (2.0 * length / (young * area) + 1.0 / pairs);
  const Pressed gradual = press(duration, 1.4 * duration);
  const Pressed sudden = press(0.0, 1.4 * duration);
  const auto& last = gradual.recorder.samples.back();
  double err = 0.0, ledger = 0.0, made = 0.0;
  for (const auto& s : gradual.recorder.samples) {
    err = std::max(err, std::abs(s.balance.err) * s.balance.largest);
    ledger = std::max(ledger, std::abs(s.balance.ledger) * s.balance.largest);
    made = std::max(made, std::abs(s.balance.cx));
  }
  const double work = 0.5 * force * overlap;
  std::printf("  force %.3f N of %.3f, largest %.3f (at once: %.3f); start work %.6e J of %.6e; ERR %.1e LEDGER %.1e CX %.1e of it\n",
              gradual.force, force, gradual.largest, sudden.largest, last.interfaces[0].sw, work, err / work, ledger / work, made / work);
  EXPECT_EQ(gradual.recorder.samples.front().interfaces[0].normal_force.z, 0.0);
  EXPECT_NEAR(gradual.force, force, 5e-3 * force);
  EXPECT_LT(gradual.largest, 1.005 * force);
  EXPECT_GT(sudden.largest, 1.5 * force);
  EXPECT_NEAR(last.interfaces[0].sw, work, 5e-3 * work);
  EXPECT_EQ(last.balance.extw, last.interfaces[0].sw);
  EXPECT_LT(err, 1e-3 * work);
  EXPECT_LT(ledger, 1e-12 * work);
  EXPECT_LT(made, 1e-3 * work);
}

}  // namespace
