// Time functions of a deck: /FUNCT as loads and imposed motion read them (numerics.md 6.5).
#pragma once

#include "abut/types.hpp"
#include "model/model.hpp"

namespace abut::constraints {

/// Piecewise linear; outside the given range the first or last segment goes on with its slope.
class Curves {
 public:
  explicit Curves(const model::Model& model) : model_(&model) {}

  /// f(t). `function` == no_index: constant 1; a function with one point: that constant.
  [[nodiscard]] double value(Index function, double t) const;

  /// scale_y f((t - t0) / scale_x), t0 = activation time of the sensor, 0 without one.
  [[nodiscard]] double scaled(Index function, Index sensor, double scale_x, double scale_y, double t) const;

  /// True when there is no sensor or when t_on <= t < t_off.
  [[nodiscard]] bool on(Index sensor, double t) const;

 private:
  const model::Model* model_;
};

}  // namespace abut::constraints
