// Rigid bodies that are held or moved at a point beside their centre of gravity.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "constraints/rigid_bodies.hpp"
#include "unit/constraints/bodies.hpp"

namespace abut::constraints::test {
namespace {

constexpr double g = 10.0;

model::Model hanging(std::array<bool, 3> translation, std::array<bool, 3> rotation = {}) {
  auto m = body_of_points(3);
  m.gravities.push_back({});
  m.gravities[0].direction = 2;
  m.gravities[0].scale_y = -g;
  for (Index i = 0; i < 6; ++i) m.gravities[0].nodes.push_back(i);
  m.boundary_conditions.push_back({.id = 1, .translation = translation, .rotation = rotation, .nodes = {0}});
  return m;
}

struct Body {
  double mass = 0.0;
  Vec3 centre;
};
Body body_of(const Rig& rig, const std::vector<double>& masses) {
  Body b;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    b.mass += masses[i];
    b.centre += masses[i] * rig.s.x[i];
  }
  b.centre = b.centre / b.mass;
  return b;
}

double agm(double a, double b) {
  for (int i = 0; i < 40; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

struct Swing {
  double period = 0.0, theory = 0.0;
  double drift = 0.0;   ///< of the held point
  double energy = 0.0;  ///< largest |T* - work of gravity| over the depth of the swing, M g d (1 - cos)
  double last = 0.0;    ///< the same after the last full period
};

/// Pendulum about the y axis through the main node, from rest; its first periods at `steps` steps each.
Swing swing(int steps, int periods, bool uneven_steps = false) {
  Rig rig(hanging({true, true, true}, {true, false, true}), 1.0, 0.02);
  set_masses(rig.s);
  const std::vector<double> masses(rig.s.mass.begin(), rig.s.mass.end());
  const Vec3 pivot = rig.s.x[0];
  rig.start();
  const Body b = body_of(rig, masses);
  const Vec3 r = b.centre - pivot, across{r.x, 0.0, r.z};
  const double d = norm(across), angle = std::acos(-across.z / d);
  double inertia = 0.0;  // about the axis
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Vec3 a = rig.s.x[i] - pivot;
    inertia += masses[i] * (a.x * a.x + a.z * a.z) + 0.02;
  }
  Swing out;
  out.theory = 2.0 * std::numbers::pi * std::sqrt(inertia / (b.mass * g * d)) / agm(1.0, std::cos(0.5 * angle));
  const double h = out.theory / steps, depth = b.mass * g * d * (1.0 - std::cos(angle));
  double before = 0.0, first = -1.0, last = 0.0;
  int crossings = 0;
  for (int n = 0; n < (periods + 1) * steps && crossings < 2 * periods + 1; ++n) {
    rig.step(uneven_steps ? h * uneven(n) : h);
    EXPECT_LT(std::fabs(rig.ledger()), 1e-12 * depth) << n;
    out.drift = std::max(out.drift, norm(rig.s.x[0] - pivot));
    const double made = std::fabs(rig.kinetic - rig.work_gravity) / depth;
    out.energy = std::max(out.energy, made);
    out.last = made;
    const double spin = rig.s.w[0].y, middle = rig.s.times.t - 0.5 * rig.s.times.h_minus;  // of the velocity
    if (n > steps / 4 && spin * before < 0.0) {                                            // turns back: twice in a period
      const double at = middle - rig.s.times.h_bar * spin / (spin - before);
      if (first < 0.0) first = at;
      last = at;
      ++crossings;
    }
    before = spin;
  }
  EXPECT_EQ(crossings, 2 * periods + 1);
  out.period = (last - first) / periods;
  return out;
}

// Physical pendulum, T = 2 pi sqrt(I/(M g d))/agm(1, cos(theta/2)) [Gauss], theta the amplitude. Period and energy of second order in the
// step, energy bounded for a hundred periods, the held point where it was to rounding.
TEST(HeldBody, SwingsAboutAPointBesideItsCentre) {
  double previous_period = 1.0, previous_energy = 1.0;
  for (const int steps : {50, 100, 200, 400}) {
    const Swing s = swing(steps, 3);
    const double off = std::fabs(s.period / s.theory - 1.0);
    std::printf("[found] pendulum, %d steps per period: period off by %.2e, energy by %.2e, point by %.1e\n", steps, off, s.energy,
                s.drift);
    EXPECT_LT(s.drift, 1e-13);
    if (steps > 50) {
      EXPECT_LT(off, 0.3 * previous_period);
      EXPECT_LT(s.energy, 0.3 * previous_energy);
    }
    previous_period = off;
    previous_energy = s.energy;
  }
  EXPECT_LT(previous_period, 1e-4);
  EXPECT_LT(previous_energy, 1e-4);
  const Swing longer = swing(100, 100);
  EXPECT_LT(longer.energy, 1.5 * swing(100, 3).energy);
  EXPECT_LT(longer.drift, 1e-12);
  EXPECT_LT(swing(400, 3, true).energy, 1e-3);
}

// Without gravity: energy and angular momentum about the held point, of second order in the step; no external work at all.
TEST(HeldBody, SpinsAboutAPointAsAFreeTop) {
  double previous = 1.0;
  for (const double h : {0.02, 0.01, 0.005}) {
    auto m = hanging({true, true, true});
    m.gravities.clear();
    Rig rig(m, 1.0, 0.02);
    set_masses(rig.s);
    const std::vector<double> masses(rig.s.mass.begin(), rig.s.mass.end());
    rig.s.w[0] = {2.0, -1.0, 3.0};
    rig.start();
    const double energy = 0.5 * [&] {
      double sum = 0.0;
      for (std::size_t i = 0; i < 6; ++i) sum += masses[i] * squared_norm(rig.s.v[i]) + 0.02 * squared_norm(rig.s.w[i]);
      return sum;
    }();
    const Vec3 pivot = rig.s.x[0];
    const auto spin = [&] {
      Vec3 sum{};
      for (std::size_t i = 0; i < 6; ++i)
        sum += masses[i] * cross(rig.s.x[i] - 0.5 * rig.s.times.h_minus * rig.s.v[i] - pivot, rig.s.v[i]) + 0.02 * rig.s.w[i];
      return sum;
    };
    const Vec3 first = spin();
    double worst = 0.0, turned = 0.0;
    for (int n = 0; n < static_cast<int>(20.0 / h); ++n) {
      rig.step(h);
      worst = std::max(worst, std::fabs(rig.kinetic / energy - 1.0));
      turned = std::max(turned, norm(spin() - first) / norm(first));
      ASSERT_LT(std::fabs(rig.ledger()), 1e-11 * energy) << n;
      ASSERT_LT(std::fabs(rig.work_hold), 1e-11 * energy) << n;
    }
    std::printf("[found] top, step %.3f: energy off by %.2e, angular momentum by %.2e\n", h, worst, turned);
    EXPECT_LT(norm(rig.s.x[0] - pivot), 1e-12);
    EXPECT_LT(std::max(worst, turned), 0.3 * previous);
    previous = std::max(worst, turned);
  }
  EXPECT_LT(previous, 1e-3);
}

// The point slides along x: momentum along x stays what it was, whatever the body does.
TEST(HeldBody, OnASliderKeepsTheMomentumAlongIt) {
  Rig rig(hanging({false, true, true}), 1.0, 0.02);
  set_masses(rig.s);
  const std::vector<double> masses(rig.s.mass.begin(), rig.s.mass.end());
  rig.start();
  const Vec3 pivot = rig.s.x[0];
  double mass = 0.0;
  for (const double m : masses) mass += m;
  const double depth = mass * g * 0.1;  // an arm is longer
  for (int n = 0; n < 2000; ++n) {
    rig.step(0.002 * uneven(n));
    double momentum = 0.0;
    for (std::size_t i = 1; i < 6; ++i) momentum += masses[i] * rig.s.v[i].x;
    momentum += masses[0] * rig.s.v[0].x;
    ASSERT_NEAR(momentum, 0.0, 1e-9) << n;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-11 * depth) << n;
    ASSERT_NEAR(rig.kinetic - rig.work_gravity, 0.0, 2e-3 * depth) << n;
  }
  EXPECT_NEAR(rig.s.x[0].y, pivot.y, 1e-12);
  EXPECT_NEAR(rig.s.x[0].z, pivot.z, 1e-12);
  EXPECT_GT(std::fabs(rig.s.x[0].x - pivot.x), 1e-3);
}

// A point that is moved goes where its curve says, in a velocity and in a displacement; what moves it does the work that the body gains.
TEST(HeldBody, ThatIsMovedTakesItsWorkFromOutside) {
  for (const auto kind : {model::ImposedMotion::Kind::velocity, model::ImposedMotion::Kind::displacement}) {
    auto m = hanging({false, true, true});
    m.gravities.clear();
    const bool velocity = kind == model::ImposedMotion::Kind::velocity;
    const Index f = velocity ? add_function(m, {0, 1, 10}, {0, 2, 2}) : add_function(m, {0, 2, 10}, {0, 1, -3});
    model::ImposedMotion motion;
    motion.id = 1;
    motion.kind = kind;
    motion.direction = 0;
    motion.function = f;
    motion.nodes = {0};
    m.imposed_motions.push_back(motion);
    Rig rig(m, 1.0, 0.02);
    set_masses(rig.s);
    rig.start();
    const Vec3 pivot = rig.s.x[0];
    double energy = 0.0, largest = 0.0;
    for (int n = 0; n < 2000; ++n) {
      rig.step(0.002 * uneven(n));
      const auto& t = rig.s.times;
      if (velocity) {
        ASSERT_NEAR(rig.s.v[0].x, rig.curves.scaled(f, no_index, 1, 1, t.t - 0.5 * t.h_minus), 1e-12) << n;
      } else {
        ASSERT_NEAR(rig.s.x[0].x - pivot.x, rig.curves.scaled(f, no_index, 1, 1, t.t), 1e-12) << n;
      }
      largest = std::max(largest, rig.kinetic);
      energy = std::max(energy, std::fabs(rig.kinetic - rig.work_hold));
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-11 * (1.0 + rig.kinetic)) << n;
    }
    EXPECT_NEAR(rig.s.x[0].z, pivot.z, 1e-12);
    EXPECT_GT(largest, 0.5);
    EXPECT_LT(energy, 2e-3 * largest);
  }
}

// An impulse on a node of a held body: the velocity that response() says, and push() gives it; nothing moves at the held point.
TEST(HeldBody, AnswersToAnImpulseAboutItsPoint) {
  auto m = hanging({true, false, true}, {true, false, false});
  m.gravities.clear();
  for (const bool pushed : {false, true}) {
    Rig rig(m, 1.0, 0.02);
    set_masses(rig.s);
    rig.start();
    const RigidBodies::Carrier carrier{4, 0, 0, rig.conditions.held(0, false), rig.conditions.held(0, true)};
    const Vec3 impulse{1e-6, 2e-6, -1e-6};
    const Vec3 expected = rig.bodies.response(rig.s, carrier, impulse);
    const RigidBodies::Answer answer = rig.bodies.answer(rig.s, 0, carrier.translation, carrier.rotation);
    const Vec3 point = answer.velocity(rig.s.x[0], rig.s.x[4], impulse);
    EXPECT_LT(std::fabs(point.x) + std::fabs(point.z), 1e-14 * norm(expected));
    EXPECT_GT(std::fabs(point.y), 0.01 * norm(expected));
    EXPECT_LT(std::fabs(answer.motion(rig.s.x[4], impulse).w.x), 1e-14 * norm(expected));
    expect_response(rig, carrier, impulse, expected, pushed);
    if (pushed) continue;
    EXPECT_LT(norm(rig.s.v[0] - point), 1e-5 * norm(expected));
  }
}

}  // namespace
}  // namespace abut::constraints::test
