// /ACCEL: the acceleration of a node as an instrument would record it (deck-format.md F.3; numerics.md 1.2 step 24).
//
//   r^n = (a^n . e_x, a^n . e_y, a^n . e_z)      components along the axes of the skew at t^n, after all constraints
//   W^n = W^(n-1) + h_- (r^(n-1) + r^n) / 2      integral of the raw components
//   filtered: 4-pole Butterworth low-pass with cut-off w = 2 pi Fcut [Butterworth 1930, "On the theory of filter amplifiers"],
//     two sections in series, from rest:  y'' = w^2 (input - y) - (w / Q) y',   Q = 1 / (2 cos(pi/8)), 1 / (2 cos(3 pi/8))
// Each section is integrated by the trapezoidal rule over the run's own steps: stable for any step, second order, and it needs no
// even sampling. Fcut = 0: not filtered.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "abut/vec3.hpp"
#include "constraints/axes.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

struct AccelerometerSums {
  Vec3 filtered;  ///< components along the skew's axes
  Vec3 integral;  ///< W: of the raw components
};

class Accelerometers {
 public:
  Accelerometers(const model::Model& model, const Axes& axes);

  /// Step 24: reads a^n of the nodes; state.times.h_minus is the time since the last call.
  void record(const state::State& state);

  void persist(state::Archive& a);

  [[nodiscard]] std::span<const AccelerometerSums> results() const { return sums_; }  ///< per model accelerometer

 private:
  struct Section {
    Vec3 value, rate, pull;  ///< y, y' and y'' at the last record
  };
  struct Instrument {
    Vec3 raw;
    std::array<Section, 2> sections;
  };
  const model::Model* model_;
  const Axes* axes_;
  std::vector<Instrument> instruments_;
  std::vector<AccelerometerSums> sums_;
};

}  // namespace abut::constraints
