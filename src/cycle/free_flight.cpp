#include "cycle/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace abut::cycle {

namespace {

constexpr double largest_angle = 0.05;  // rad per step

}  // namespace

FreeFlight::FreeFlight(const model::Model& model) : t_end_(model.controls.t_end) {
  const auto add = [&](const auto& items) {
    for (const auto& item : items) {
      const model::Sensor* sensor = item.sensor == no_index ? nullptr : &model.sensors[static_cast<std::size_t>(item.sensor)];
      const double start = sensor == nullptr ? 0.0 : sensor->t_on;
      if (sensor != nullptr) events_.insert(events_.end(), {sensor->t_on, sensor->t_off});
      if constexpr (requires { item.t_start; }) events_.insert(events_.end(), {item.t_start, item.t_stop});
      if (item.function == no_index) continue;
      for (const double x : model.functions[static_cast<std::size_t>(item.function)].x) events_.push_back(start + x * item.scale_x);
    }
  };
  add(model.imposed_motions);
  add(model.concentrated_loads);
  add(model.pressure_loads);
  add(model.gravities);
  std::sort(events_.begin(), events_.end());
  events_.erase(std::unique(events_.begin(), events_.end()), events_.end());
}

double FreeFlight::between_events(double t) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto next = std::upper_bound(events_.begin(), events_.end(), t);
  if (next == events_.end()) return never;
  const double here = next == events_.begin() ? never : *next - *(next - 1);
  const double then = next + 1 == events_.end() ? never : *(next + 1) - *next;
  return std::min(0.1 * here, std::max(*next - t, 0.1 * then));
}

double FreeFlight::step(const state::State& s) const {
  const bool first = s.times.cycle == 0;
  double step = t_end_ > 0.0 ? std::min((first ? 1e-3 : 1e-2) * t_end_, std::max(between_events(s.times.t), 1e-6 * t_end_)) : 1.0;
  double fastest = 0.0;
  for (std::size_t i = 0; i < s.w.size(); ++i) {
    if (s.inertia[i] > 0.0) fastest = std::max(fastest, squared_norm(s.w[i]));
  }
  if (fastest > 0.0) step = std::min(step, largest_angle / std::sqrt(fastest));
  return step;
}

}  // namespace abut::cycle
