#include "cycle/contact_mobility.hpp"

#include <algorithm>

namespace abut::cycle {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

ContactMobility::ContactMobility(const model::Model& model, std::span<const init::RunInterface> interfaces,
                                 const constraints::BoundaryConditions& conditions)
    : model_(&model) {
  const std::size_t n = static_cast<std::size_t>(model.node_count());
  std::vector<std::uint8_t> touches(n, 0), constrained(n, 0);
  lifted_.assign(n, 0);
  for (const init::RunInterface& i : interfaces) {
    const auto& ibc = model.interfaces[at(i.model_index)].ibc;
    const auto bits = static_cast<std::uint8_t>((ibc[0] ? 1U : 0U) | (ibc[1] ? 2U : 0U) | (ibc[2] ? 4U : 0U));
    const auto take = [&](Index node) {
      if (node == no_index) return;
      touches[at(node)] = 1;
      lifted_[at(node)] = static_cast<std::uint8_t>(lifted_[at(node)] | bits);
    };
    for (const init::RunInterface::Side& side : i.sides) {
      for (const Index node : side.nodes) take(node);
      for (const auto& corners : side.corners) {
        for (const Index node : corners) take(node);
      }
    }
  }
  bound_.assign(n, -1);
  const auto bind = [&](Index node) {
    if (bound_[at(node)] >= 0) return;
    bound_[at(node)] = static_cast<std::int32_t>(bound_nodes_.size());
    bound_nodes_.push_back(node);
  };
  // Main nodes are bound whether they touch or not: they move their bodies.
  for (const model::RigidBody& body : model.rigid_bodies) {
    bind(body.main);
    constrained[at(body.main)] = 1;
    for (const Index node : body.nodes) constrained[at(node)] = 1;
  }
  for (const Index node : conditions.nodes()) {
    if (touches[at(node)] != 0) bind(node);
  }
  for (const model::ImposedMotion& motion : model.imposed_motions) {
    for (const Index node : motion.nodes) {
      if (touches[at(node)] != 0) bind(node);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (touches[i] != 0 && (constrained[i] != 0 || bound_[i] >= 0)) nodes_.push_back(static_cast<Index>(i));
  }
  if (nodes_.empty()) return;
  held_.resize(bound_nodes_.size());
  held_rotation_.resize(bound_nodes_.size());
  entry_.assign(n, no_index);
  mobility_.resize(model.rigid_bodies.size() + bound_nodes_.size());
}

void ContactMobility::update(const state::State& state, const constraints::BoundaryConditions& conditions,
                             const constraints::ImposedMotions& imposed, const constraints::RigidBodies& bodies) {
  if (nodes_.empty()) return;
  for (std::size_t k = 0; k < bound_nodes_.size(); ++k) {
    const Index node = bound_nodes_[k];
    held_[k] = conditions.held(node, false, lifted_[at(node)]);
    held_rotation_[k] = bodies.main_of(node) == no_index ? Held{} : conditions.held(node, true);
  }
  imposed.for_each_imposed(state.times.t, [this](Index node, bool rotation, const Vec3& axis) {
    const std::int32_t k = bound_[at(node)];
    if (k >= 0) (rotation ? held_rotation_ : held_)[static_cast<std::size_t>(k)].add(axis);
  });
  const std::size_t count = model_->rigid_bodies.size();
  for (std::size_t b = 0; b < count; ++b) {
    const auto body = static_cast<Index>(b);
    const auto k = static_cast<std::size_t>(bound_[at(model_->rigid_bodies[b].main)]);
    if (bodies.main_of(bound_nodes_[k]) == body) mobility_[b] = bodies.mobility(state, body, held_[k], held_rotation_[k]);
  }
  for (const Index node : nodes_) {
    const Index body = bodies.body_of(node) != no_index ? bodies.body_of(node) : bodies.main_of(node);
    const std::int32_t k = bound_[at(node)];
    Index& entry = entry_[at(node)];
    entry = body;
    if (body != no_index || k < 0) continue;
    const Held& held = held_[static_cast<std::size_t>(k)];
    if (held.count == 0) continue;
    const std::size_t own = count + static_cast<std::size_t>(k);
    entry = static_cast<Index>(own);
    mobility_[own] = {};
    if (held.count == 3) continue;
    const double inverse = state.mass[at(node)] > 0.0 ? 1.0 / state.mass[at(node)] : 0.0;
    for (int c = 0; c < 3; ++c) {
      Vec3 unit{};
      unit[c] = 1.0;
      mobility_[own].translation.add(inverse, unit);
    }
    for (int c = 0; c < held.count; ++c) mobility_[own].translation.add(-inverse, held.axis[static_cast<std::size_t>(c)]);
  }
}

}  // namespace abut::cycle
