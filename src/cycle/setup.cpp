// Construction of a Cycle: everything that happens once.
#include <algorithm>
#include <type_traits>
#include <variant>

#include "cycle/cycle.hpp"
#include "model/topology.hpp"

namespace abut::cycle {

namespace {

bool has_two_sided_interface(const model::Model& model) {
  return std::any_of(model.interfaces.begin(), model.interfaces.end(),
                     [](const model::Interface& i) { return std::holds_alternative<model::InterfaceType7>(i.type); });
}

}  // namespace

Cycle::Cycle(const model::Model& model, const RunOptions& options)
    : model_(model),
      options_(options),
      pool_(options.threads),
      groups_(init::make_groups(model, options.profile)),
      assembly_(model.node_count(), groups_),
      state_(init::make_state(model, groups_)),
      sums_(assembly_.sum_count(), 0.0),
      slots_(model.sections.empty() ? 0 : assembly_.slot_count(), 0.0),
      curves_(model),
      axes_(model),
      bodies_(model, options.profile),
      loads_(model, curves_, axes_),
      gravities_(model, curves_, axes_, bodies_),
      boundary_(model, axes_, bodies_, options.profile),
      imposed_(model, curves_, axes_, bodies_),
      walls_(model, bodies_, boundary_, imposed_, options.profile),
      sections_(model, groups_),
      accelerometers_(model, axes_) {
  const auto n = static_cast<std::size_t>(model.node_count());
  recording_.assign(options.recordings.size(), false);
  contact_stiffness_.resize(n);
  parts_.resize(model.parts.size());
  interface_results_.resize(model.interfaces.size());

  walls_.initialise(state_);
  bodies_.initialise(state_);
  if (options.interfaces) interfaces_ = init::make_interfaces(model, options.profile, options.contacts, state_);
  // The reference program's contact knows plain masses only.
  if (!options.profile.reference_contact) contact_mobility_ = ContactMobility(model, interfaces_, boundary_);
  // The reference program keeps the stiffness of the start.
  if (!options.profile.reference_contact) contact_thickness_ = ContactThickness(model, groups_, interfaces_);
  const auto release = [](auto&... values) { (std::remove_reference_t<decltype(values)>().swap(values), ...); };  // = {} keeps the memory
  for (init::RunInterface& i : interfaces_) {
    // Nobody else asks for them: the interface has its stiffness and thickness, and without Idel its nodes stay.
    for (init::RunInterface::Side& side : i.sides) {
      release(side.shell, side.stiffness, side.thickness, side.shares);
      if (model.interfaces[static_cast<std::size_t>(i.model_index)].idel == 0) release(side.nodes);
    }
  }
  if (options.interfaces) contact_facing_ = ContactFacing(model, options.facing);

  std::vector<std::uint8_t> free_translation(n, 1);
  std::vector<std::uint8_t> free_rotation(n, 1);
  for (const model::Interface& i : model.interfaces) releases_ = releases_ || (options.interfaces && (i.ibc[0] || i.ibc[1] || i.ibc[2]));
  if (releases_ && !options.profile.reference_contact) {
    caught_.emplace(std::vector<Index>(boundary_.nodes().begin(), boundary_.nodes().end()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = static_cast<Index>(i);
    // A boundary condition that contact may lift leaves the node free.
    if (!releases_ && boundary_.fixed(node, 0) && boundary_.fixed(node, 1) && boundary_.fixed(node, 2)) free_translation[i] = 0;
    if (boundary_.fixed(node, 3) && boundary_.fixed(node, 4) && boundary_.fixed(node, 5)) free_rotation[i] = 0;
  }
  time_step_ = std::make_unique<TimeStep>(model, options.profile, options.interfaces && has_two_sided_interface(model),
                                          std::move(free_translation), std::move(free_rotation));
  loaded_ = !model.concentrated_loads.empty() || !model.pressure_loads.empty();
  totals_wanted_ = !model.rigid_bodies.empty() || !model.rigid_walls.empty() || model.controls.mass_scaling;
  held_again_ = !model.imposed_motions.empty() || !model.rigid_walls.empty();
  rotations_ = !model.rigid_bodies.empty() || !model.imposed_motions.empty() ||
               std::any_of(state_.inertia.begin(), state_.inertia.end(), [](double j) { return j > 0.0; });
  ledger_ = Ledger(rotations_);
  for (init::RunInterface& i : interfaces_) {
    i.contact.set_executor([this](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
      constexpr std::size_t groups = 4;  // of nodes, some 10 us
      pool_.for_ranges(count, groups, body);
    });
  }
  ledger_.open(constraints::ledger_kinetic_energy(state_) + bodies_.ledger_correction(state_));
  next_animation_ = model.controls.animation_start;
}

void Cycle::switch_off_rigid_elements() {
  if (bodies_revision_ == bodies_.revision()) return;
  bodies_revision_ = bodies_.revision();
  for (const std::unique_ptr<elements::Group>& g : groups_) {
    std::vector<std::uint8_t> rigid(static_cast<std::size_t>(g->size()), 0);
    for (Index e = 0; e < g->size(); ++e) {
      const elements::ElementNodes nodes = g->nodes(e);
      rigid[static_cast<std::size_t>(e)] = bodies_.contains(nodes) ? 1 : 0;
    }
    g->set_rigid(rigid);
  }
}

double Cycle::element_count() const {
  double count = 0.0;
  for (const std::unique_ptr<elements::Group>& g : groups_) count += g->size();
  return count;
}

Id Cycle::element_id(const elements::Group& group, Index element) const {
  if (element == no_index) return 0;
  return model::element_id(model_, {group.kind(), group.elements()[static_cast<std::size_t>(element)]});
}

std::vector<PhaseTime> Cycle::phases() const {
  static constexpr const char* names[phase_count] = {"elements",    "assembly",  "contact search", "contact force",
                                                     "constraints", "integrate", "output"};
  std::vector<PhaseTime> out;
  for (int p = 0; p < phase_count; ++p) out.push_back({names[p], seconds_[static_cast<std::size_t>(p)]});
  static constexpr const char* families[] = {nullptr, "elements shells", "elements triangles", "elements bricks", "elements tetrahedra"};
  for (const model::ElementKind kind :
       {model::ElementKind::shell4, model::ElementKind::shell3, model::ElementKind::brick, model::ElementKind::tetra}) {
    const bool there = std::any_of(groups_.begin(), groups_.end(), [kind](const auto& g) { return g->kind() == kind && g->size() > 0; });
    const auto k = static_cast<std::size_t>(kind);
    if (there) out.push_back({families[k], family_seconds_[k]});
  }
  return out;
}

}  // namespace abut::cycle
