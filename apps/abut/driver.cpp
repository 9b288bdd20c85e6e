#include "driver.hpp"

#include "cycle/cycle.hpp"

namespace abut::app {

cycle::Outcome run_model(const model::Model& model, const RunSettings& settings, cycle::Sink& sink,
                         std::vector<output::PhaseTime>& phases) {
  RunSettings with_phases = settings;
  with_phases.phases = &phases;
  return cycle::run(model, with_phases, sink).outcome;
}

Description describe_model(const model::Model& model, const RunSettings& settings) {
  Description out;
  out.part_mass.assign(model.parts.size(), 0.0);
  for (const auto& group : init::make_groups(model, settings.profile)) {
    for (Index e = 0; e < group->size(); ++e) out.part_mass[static_cast<std::size_t>(group->part())] += group->element_mass(e);
  }
  out.step = cycle::describe_first_step(model, settings);
  return out;
}

}  // namespace abut::app
