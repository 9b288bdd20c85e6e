#include "constraints/curves.hpp"

#include <algorithm>
#include <cstddef>

namespace abut::constraints {

double Curves::value(Index function, double t) const {
  if (function == no_index) return 1.0;
  const model::Function& f = model_->functions[static_cast<std::size_t>(function)];
  const std::size_t n = f.x.size();
  if (n == 0) return 0.0;
  if (n == 1) return f.y[0];
  // First point to the right of t; clamped so that the first and the last segment extend to infinity.
  const auto right = std::upper_bound(f.x.begin() + 1, f.x.end() - 1, t);
  const auto i = static_cast<std::size_t>(right - f.x.begin());
  const double dx = f.x[i] - f.x[i - 1];
  if (dx == 0.0) return f.y[i];
  return f.y[i - 1] + (f.y[i] - f.y[i - 1]) / dx * (t - f.x[i - 1]);
}

double Curves::scaled(Index function, Index sensor, double scale_x, double scale_y, double t) const {
  const double t0 = sensor == no_index ? 0.0 : model_->sensors[static_cast<std::size_t>(sensor)].t_on;
  return scale_y * value(function, (t - t0) / scale_x);
}

bool Curves::on(Index sensor, double t) const {
  if (sensor == no_index) return true;
  const model::Sensor& s = model_->sensors[static_cast<std::size_t>(sensor)];
  return t >= s.t_on && t < s.t_off;
}

}  // namespace abut::constraints
