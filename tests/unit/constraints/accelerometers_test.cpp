#include "constraints/accelerometers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {
namespace {

constexpr double cut_off = 50.0;

/// One node with an accelerometer; `record` gives it an acceleration at the end of a step of length h.
struct Recorder {
  model::Model m = nodes_at({{0, 0, 0}});
  state::State s = state_of(m);
  std::unique_ptr<Axes> axes;
  std::unique_ptr<Accelerometers> instruments;

  explicit Recorder(double filter, Index skew = no_index) {
    m.accelerometers.push_back({.id = 1, .node = 0, .skew = skew, .cut_off = filter});
    if (skew != no_index) {
      model::Skew turned;
      turned.id = 1;
      turned.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
      m.skews.push_back(turned);
    }
    axes = std::make_unique<Axes>(m);
    instruments = std::make_unique<Accelerometers>(m, *axes);
  }
  const AccelerometerSums& record(double h, const Vec3& a) {
    s.times.h_minus = h;
    s.a[0] = a;
    instruments->record(s);
    return instruments->results()[0];
  }
};

/// Largest filtered value of sin(2 pi f t) once the start has died away; steps are uneven (1 : 1.5), some 400 per period.
double gain(double f) {
  Recorder r(cut_off);
  const double step = 1.0 / (500.0 * f);
  double t = 0.0, largest = 0.0;
  const double settled = 20.0 / cut_off, end = settled + 3.0 / f;
  for (int n = 0; t < end; ++n) {
    const double h = n % 2 == 0 ? step : 1.5 * step;
    t += h;
    const double y = r.record(h, {std::sin(2.0 * std::numbers::pi * f * t), 0, 0}).filtered.x;
    if (t > settled) largest = std::max(largest, std::abs(y));
  }
  return largest;
}

// |H(f)| = 1 / sqrt(1 + (f/Fcut)^8), four poles, at any spacing of the steps.
TEST(Accelerometer, FiltersLikeButterworthWithFourPoles) {
  for (const double ratio : {0.1, 0.5, 0.8, 1.0, 1.25, 2.0, 4.0}) {
    const double exact = 1.0 / std::sqrt(1.0 + std::pow(ratio, 8));
    EXPECT_NEAR(gain(ratio * cut_off), exact, 1e-3 * exact + 2e-5) << ratio;
  }
}

// A step of acceleration is reached exactly, after an overshoot of 10.8 % (four poles: 1.108).
TEST(Accelerometer, StepResponse) {
  Recorder r(cut_off);
  const double h = 1e-3 / cut_off;
  double largest = 0.0, last = 0.0;
  for (int n = 0; n < 12000; ++n) {
    last = r.record(h, {7.0, 0, 0}).filtered.x / 7.0;
    largest = std::max(largest, last);
  }
  EXPECT_NEAR(last, 1.0, 1e-9);
  EXPECT_NEAR(largest, 1.108, 0.001);
}

TEST(Accelerometer, WithoutCutOffTheRawValueIsWritten) {
  Recorder r(0.0);
  EXPECT_EQ(r.record(0.1, {1, -2, 3}).filtered, (Vec3{1, -2, 3}));
}

// Components are those along the axes of the skew; their integral is the change of velocity, filtered or not.
TEST(Accelerometer, MeasuresAlongItsSkewAndIntegratesTheRawSignal) {
  Recorder r(cut_off, 0);
  double t = 0.0;
  r.record(0.0, {0, 0, 2});
  for (int n = 0; n < 100; ++n) {
    const double h = 0.001 * (1 + n % 3);
    t += h;
    r.record(h, {3.0 * t, 0, 2});  // linear in time: the trapezoidal rule is exact
  }
  const Vec3 w = r.instruments->results()[0].integral;
  EXPECT_NEAR(w.x, 0.0, 1e-15);
  EXPECT_NEAR(w.y, -1.5 * t * t, 1e-13);
  EXPECT_NEAR(w.z, 2.0 * t, 1e-13);
}

}  // namespace
}  // namespace abut::constraints::test
