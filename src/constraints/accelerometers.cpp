#include "constraints/accelerometers.hpp"

#include <cstddef>
#include <numbers>

namespace abut::constraints {

namespace {
/// 2 cos(pi/8) and 2 cos(3 pi/8): 1/Q of the two sections.
constexpr std::array<double, 2> damping{1.8477590650225735, 0.7653668647301796};
}  // namespace

Accelerometers::Accelerometers(const model::Model& model, const Axes& axes)
    : model_(&model), axes_(&axes), instruments_(model.accelerometers.size()), sums_(model.accelerometers.size()) {}

void Accelerometers::record(const state::State& state) {
  const double h = state.times.h_minus;
  for (std::size_t i = 0; i < instruments_.size(); ++i) {
    const model::Accelerometer& card = model_->accelerometers[i];
    Instrument& instrument = instruments_[i];
    const Vec3 a = state.a[static_cast<std::size_t>(card.node)];
    const Frame& frame = axes_->frame(card.skew);
    const Vec3 raw{dot(a, frame[0]), dot(a, frame[1]), dot(a, frame[2])};
    sums_[i].integral += 0.5 * h * (instrument.raw + raw);
    instrument.raw = raw;

    Vec3 signal = raw;
    if (card.cut_off > 0.0) {
      const double w = 2.0 * std::numbers::pi * card.cut_off;
      for (std::size_t k = 0; k < instrument.sections.size(); ++k) {
        Section& s = instrument.sections[k];
        const double c = w * damping[k];
        const double half = 0.5 * h;
        // Implicit trapezoidal step for y' with y = y_old + half (y'_old + y').
        const Vec3 reached = s.value + half * s.rate;
        const Vec3 rate = (s.rate + half * (s.pull + w * w * (signal - reached))) / (1.0 + half * (c + half * w * w));
        s.value = reached + half * rate;
        s.rate = rate;
        s.pull = w * w * (signal - s.value) - c * rate;
        signal = s.value;
      }
    }
    sums_[i].filtered = signal;
  }
}

void Accelerometers::persist(state::Archive& a) {
  a.each(instruments_, [&a](Instrument& instrument) {
    a(instrument.raw);
    for (Section& s : instrument.sections) {
      for (Vec3* v : {&s.value, &s.rate, &s.pull}) a(*v);
    }
  });
  a.each(sums_, [&a](AccelerometerSums& s) {
    a(s.filtered);
    a(s.integral);
  });
}

}  // namespace abut::constraints
