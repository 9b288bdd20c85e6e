// What can be said of a model before it runs.
#include <algorithm>
#include <utility>

#include "cycle/cycle.hpp"
#include "init/contact_inspection.hpp"
#include "output/element_lookup.hpp"
#include "run/loaded_model.hpp"

namespace abut {
namespace {

/// Keeps what the first cycle of a model without its interfaces shows.
class FirstCycle final : public cycle::Sink {
 public:
  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot& now) override {
    part_mass = output::part_masses(*now.model, now.groups);
    x.assign(now.state->x.begin(), now.state->x.end());
    v.assign(now.state->v.begin(), now.state->v.end());
    mass.assign(now.state->mass.begin(), now.state->mass.end());
    step = now.state->times.h_plus;
  }
  void end(const cycle::Outcome&) override {}
  std::vector<Vec3> x, v;
  std::vector<double> mass, part_mass;
  double step = 0.0;
};

}  // namespace

Inspection Model::inspect(const Choices& choices, bool with_step) const {
  run::check_choices(impl_->model, choices);
  return run::inspect(run::projected(*this, choices).impl().model, choices, with_step);
}

Inspection run::inspect(const model::Model& model, const Choices& choices, bool with_step, init::FacingShares* facing) {
  const cycle::RunOptions options = run::options_of(choices, 1);
  Inspection out;
  FirstCycle first;
  {
    cycle::RunOptions bare = options;
    bare.interfaces = false;
    cycle::Cycle(model, bare).advance(first);
  }
  out.part_mass = std::move(first.part_mass);
  // Choices may change the gap, which a run does not look at the normals with.
  if (!choices.interfaces.empty() || first.x != model.node_x) facing = nullptr;
  out.contact = init::inspect_contacts(model, {first.x, first.v, first.mass, first.step}, choices.interfaces, facing);
  const auto is_error = [](const ContactFinding& c) { return c.finding.severity == contact::Severity::error; };
  // Interfaces with errors may refuse to be built.
  if (with_step && std::none_of(out.contact.begin(), out.contact.end(), is_error)) {
    const cycle::FirstStep step = cycle::first_step(model, options);
    out.first_step = step.step;
    out.controller = step.controller;
  }
  return out;
}

Diagnostic to_diagnostic(const ContactFinding& finding) { return init::to_diagnostic(finding); }

}  // namespace abut
