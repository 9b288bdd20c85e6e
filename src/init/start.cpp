#include "init/start.hpp"

#include <utility>

#include "init/locality.hpp"
#include "model/step_scale.hpp"

namespace abut::init {

namespace {

template <std::size_t N>
std::vector<std::vector<Index>> by_part(const model::Elements<N>& table, std::size_t parts) {
  std::vector<std::vector<Index>> lists(parts);
  for (Index e = 0; e < table.size(); ++e) lists[static_cast<std::size_t>(table.part[static_cast<std::size_t>(e)])].push_back(e);
  return lists;
}

template <std::size_t N>
Vec3 centre(const model::Model& model, const std::array<Index, N>& nodes) {
  Vec3 sum;
  for (const Index n : nodes) sum += model.node_x[static_cast<std::size_t>(n)];
  return (1.0 / static_cast<double>(N)) * sum;
}

}  // namespace

std::vector<std::unique_ptr<elements::Group>> make_groups(const model::Model& model, const Profile& profile) {
  const std::size_t parts = model.parts.size();
  auto shells = by_part(model.shells, parts);
  auto triangles = by_part(model.sh3ns, parts);
  auto bricks = by_part(model.bricks, parts);
  auto tetras = by_part(model.tetras, parts);

  const double scale = model::system_step_scale(model);
  std::vector<std::unique_ptr<elements::Group>> groups;
  const auto add = [&](auto make, std::vector<Index>& list, std::size_t part, const model::StepControl& control, const auto& table) {
    if (list.empty()) return;
    order_for_locality(list, [&](Index e) { return centre(model, table.nodes[static_cast<std::size_t>(e)]); });
    elements::GroupInput in;
    in.model = &model;
    in.part = static_cast<Index>(part);
    in.elements = std::move(list);
    in.profile = profile;
    in.step_scale = control.scale;
    in.system_scale = scale;
    in.step_minimum = control.minimum;
    const Index property = model.parts[part].property;
    if (const auto* solid = std::get_if<model::SolidProperty>(&model.properties[static_cast<std::size_t>(property)].data)) {
      if (solid->dt_min > 0.0 && control.action == model::StepControl::Action::remove) in.step_minimum = solid->dt_min;
    }
    in.step_action = control.action;
    // With a nodal step the elements' own steps matter only to those who act on them.
    const bool nodal = model.controls.nodal_step || profile.system_step != Profile::SystemStep::reference;
    in.step_wanted = !nodal || control.action != model::StepControl::Action::none;
    groups.push_back(make(in));
  };
  for (std::size_t p = 0; p < parts; ++p) {
    add(elements::make_shell_q4, shells[p], p, model.controls.shell, model.shells);
    add(elements::make_shell_c0, triangles[p], p, model.controls.sh3n, model.sh3ns);
    add(elements::make_brick8, bricks[p], p, model.controls.brick, model.bricks);
    add(elements::make_tetra4, tetras[p], p, model.controls.tetra, model.tetras);
  }
  return groups;
}

state::State make_state(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups) {
  state::State s = state::State::zeros(model.node_count());
  for (std::size_t i = 0; i < model.node_x.size(); ++i) s.x[i] = model.node_x[i];

  for (const std::unique_ptr<elements::Group>& g : groups) g->add_masses(s.mass, s.inertia);
  for (const model::AddedMass& m : model.added_masses) s.mass[static_cast<std::size_t>(m.node)] += m.mass;

  std::vector<bool> turns(s.x.size(), false);
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = s.inertia[i] > 0.0;
  for (const model::RigidBody& body : model.rigid_bodies) turns[static_cast<std::size_t>(body.main)] = true;  // its inertia comes later
  // The last card that names a node wins (deck-format.md D.2).
  for (const model::InitialVelocity& card : model.initial_velocities) {
    for (const Index n : card.nodes) {
      const auto i = static_cast<std::size_t>(n);
      (card.rotational ? s.w : s.v)[i] = card.value;
      if (!card.about_axis) continue;
      s.v[i] += cross(card.spin, s.x[i] - card.origin);
      if (turns[i]) s.w[i] = card.spin;
    }
  }
  return s;
}

}  // namespace abut::init
