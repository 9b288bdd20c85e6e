#include "driver.hpp"

#include <algorithm>

#include "cycle/cycle.hpp"

namespace abut::app {

cycle::Outcome run_model(const model::Model& model, const RunSettings& settings, cycle::Sink& sink,
                         std::vector<output::PhaseTime>& phases) {
  RunSettings with_phases = settings;
  with_phases.phases = &phases;
  return cycle::run(model, with_phases, sink).outcome;
}

namespace {

/// Keeps what the first cycle of a model without its interfaces shows.
class FirstCycle final : public cycle::Sink {
 public:
  explicit FirstCycle(std::vector<double>& part_mass) : part_mass_(part_mass) {}
  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot& now) override {
    for (const auto& group : now.groups) {
      for (Index e = 0; e < group->size(); ++e) part_mass_[static_cast<std::size_t>(group->part())] += group->element_mass(e);
    }
    x = now.state->x;
    v = now.state->v;
    mass = now.state->mass;
    step = now.state->times.h_plus;
  }
  void end(const cycle::Outcome&) override {}
  std::vector<Vec3> x, v;
  std::vector<double> mass;
  double step = 0.0;

 private:
  std::vector<double>& part_mass_;
};

}  // namespace

Description describe_model(const model::Model& model, const RunSettings& settings, bool with_step) {
  Description out;
  out.part_mass.assign(model.parts.size(), 0.0);
  FirstCycle first(out.part_mass);
  {
    model::Model bare = model;
    bare.interfaces.clear();
    bare.sections.clear();
    bare.th_requests.clear();
    cycle::Cycle(bare, settings).advance(first);
  }
  out.contact = init::inspect_contacts(model, {first.x, first.v, first.mass, first.step});
  const auto is_error = [](const init::ContactFinding& c) { return c.finding.severity == contact::Severity::error; };
  // Interfaces with errors may refuse to be built.
  if (with_step && std::none_of(out.contact.begin(), out.contact.end(), is_error)) out.step = cycle::describe_first_step(model, settings);
  return out;
}

}  // namespace abut::app
