// The step of a model in which nothing deforms: any is stable, so accuracy decides.
#pragma once

#include <vector>

#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// A thousandth of the run, later a hundredth; where something turns 0.05 rad at most; of the time between two events (points of functions
/// in use, sensors, start and end of imposed motions) a tenth, and not beyond the next event by more than a tenth of what follows it. Not
/// less than a millionth of the run for the sake of events.
class FreeFlight {
 public:
  explicit FreeFlight(const model::Model& model);
  [[nodiscard]] double step(const state::State& s) const;

 private:
  [[nodiscard]] double between_events(double t) const;

  double t_end_;
  std::vector<double> events_;  ///< ascending, distinct
};

}  // namespace abut::cycle
