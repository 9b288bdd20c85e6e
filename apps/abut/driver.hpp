// The one place where the command line meets the mechanics.
#pragma once

#include <string>
#include <vector>

#include "cycle/run.hpp"
#include "init/contact_inspection.hpp"
#include "model/model.hpp"
#include "output/run_info.hpp"

namespace abut::app {

using RunSettings = cycle::RunOptions;

/// Initialises the model and runs it to its end. The sink has seen begin(), cycle() and end() when this returns.
/// @param phases  receives the time spent in each phase; read by the manifest in end()
[[nodiscard]] cycle::Outcome run_model(const model::Model& model, const RunSettings& settings, cycle::Sink& sink,
                                       std::vector<output::PhaseTime>& phases);

/// What can be said of a model before it runs, beyond the model itself.
struct Description {
  std::vector<double> part_mass;  ///< #parts; empty: not known
  std::string step;               ///< first time step and what controls it; empty: not asked for, or not known
  std::vector<init::ContactFinding> contact;
};
[[nodiscard]] Description describe_model(const model::Model& model, const RunSettings& settings, bool with_step);

}  // namespace abut::app
