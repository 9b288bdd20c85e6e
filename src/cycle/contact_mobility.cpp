#include "cycle/contact_mobility.hpp"

#include <algorithm>
#include <limits>
#include <variant>

namespace abut::cycle {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

ContactMobility::ContactMobility(const model::Model& model, std::span<const init::RunInterface> interfaces,
                                 const constraints::BoundaryConditions& conditions)
    : model_(&model) {
  const auto n = at(model.node_count());
  std::vector<std::uint8_t> touches(n, 0), lifted(n, 0), corner(n, 0), of_body(n, 0);
  for (const init::RunInterface& i : interfaces) {
    const model::Interface& card = model.interfaces[at(i.model_index)];
    const auto& ibc = card.ibc;
    const auto bits = static_cast<std::uint8_t>((ibc[0] ? 1U : 0U) | (ibc[1] ? 2U : 0U) | (ibc[2] ? 4U : 0U));
    const bool both_are_surfaces = std::holds_alternative<model::InterfaceType3>(card.type);
    for (std::size_t side = 0; side < i.sides.size(); ++side) {
      for (const Index node : i.sides[side].nodes) {
        touches[at(node)] = 1;
        if (side == 0 || both_are_surfaces) lifted[at(node)] = static_cast<std::uint8_t>(lifted[at(node)] | bits);
        if (side == 1 || both_are_surfaces) corner[at(node)] = 1;
      }
    }
  }
  bound_.assign(n, -1);
  const auto bind = [&](Index node) {
    if (bound_[at(node)] >= 0) return;
    bound_[at(node)] = static_cast<std::int32_t>(bound_nodes_.size());
    bound_nodes_.push_back(node);
    lifted_.push_back(corner[at(node)] != 0 ? std::uint8_t{0} : lifted[at(node)]);
  };
  // Main nodes whether they touch or not: they move their bodies.
  for (const model::RigidBody& body : model.rigid_bodies) {
    bind(body.main);
    of_body[at(body.main)] = 1;
    for (const Index node : body.nodes) of_body[at(node)] = 1;
  }
  for (const model::ImposedMotion& motion : model.imposed_motions) {
    for (const Index node : motion.nodes) {
      if (touches[at(node)] != 0) bind(node);
    }
  }
  for (const Index node : conditions.nodes()) {
    if (touches[at(node)] == 0) continue;
    if (bound_[at(node)] < 0 && of_body[at(node)] == 0 && lifted[at(node)] == 0 && conditions.is_plain(node)) {
      steady_nodes_.push_back(node);
    } else {
      bind(node);
    }
  }
  for (Index node = 0; node < model.node_count(); ++node) {
    if (touches[at(node)] != 0 && (of_body[at(node)] != 0 || bound_[at(node)] >= 0)) nodes_.push_back(node);
  }
  if (nodes_.empty()) bound_ = std::vector<std::int32_t>();
  if (nodes_.empty() && steady_nodes_.empty()) return;
  entry_.assign(n, no_index);
  mobility_.resize(nodes_.size() + steady_nodes_.size());
  steady_mass_.assign(steady_nodes_.size(), std::numeric_limits<double>::quiet_NaN());
  held_.resize(bound_nodes_.size());
  held_rotation_.resize(bound_nodes_.size());
  answer_.resize(model.rigid_bodies.size());
  pushed_.resize(model.rigid_bodies.size());
}

void ContactMobility::update(const state::State& state, const constraints::BoundaryConditions& conditions,
                             const constraints::ImposedMotions& imposed, const constraints::RigidBodies& bodies,
                             std::span<const double> stiffness) {
  update_steady(state, conditions);
  if (nodes_.empty()) return;
  for (std::size_t k = 0; k < bound_nodes_.size(); ++k) {
    const Index node = bound_nodes_[k];
    held_[k] = conditions.held(node, false, lifted_[k]);
    held_rotation_[k] = bodies.main_of(node) == no_index ? Held{} : conditions.held(node, true);
  }
  imposed.for_each_imposed(state.times.t, [this](Index node, bool rotation, const Vec3& axis) {
    const std::int32_t k = bound_[at(node)];
    if (k >= 0) (rotation ? held_rotation_ : held_)[static_cast<std::size_t>(k)].add(axis);
  });
  update_bodies(state, bodies, stiffness);
}

void ContactMobility::update_steady(const state::State& state, const constraints::BoundaryConditions& conditions) {
  for (std::size_t i = 0; i < steady_nodes_.size(); ++i) {
    const Index node = steady_nodes_[i];
    const double mass = state.mass[at(node)];
    if (mass == steady_mass_[i]) continue;
    steady_mass_[i] = mass;
    const Held held = conditions.held(node, false);
    entry_[at(node)] = held.count == 0 ? no_index : static_cast<Index>(nodes_.size() + i);
    mobility_[nodes_.size() + i] = held.mobility(mass);
  }
}

void ContactMobility::update_bodies(const state::State& state, const constraints::RigidBodies& bodies, std::span<const double> stiffness) {
  const auto body_of = [&bodies](Index node) { return bodies.body_of(node) != no_index ? bodies.body_of(node) : bodies.main_of(node); };
  for (std::size_t b = 0; b < pushed_.size(); ++b) {
    const auto body = static_cast<Index>(b);
    const Index main = model_->rigid_bodies[b].main;
    const auto k = static_cast<std::size_t>(bound_[at(main)]);
    pushed_[b] = {};
    if (bodies.main_of(main) == body) answer_[b] = bodies.answer(state, body, held_[k], held_rotation_[k]);
  }
  for (const Index node : nodes_) {
    const Index body = body_of(node);
    if (body == no_index) continue;
    pushed_[at(body)].stiffness += stiffness[at(node)];
    pushed_[at(body)].moment += stiffness[at(node)] * (state.x[at(node)] - answer_[at(body)].centre);
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Index node = nodes_[i];
    const Index body = body_of(node);
    entry_[at(node)] = static_cast<Index>(i);
    if (body == no_index) {
      const std::int32_t k = bound_[at(node)];
      const Held held = k < 0 ? Held{} : held_[static_cast<std::size_t>(k)];
      if (held.count == 0) entry_[at(node)] = no_index;
      mobility_[i] = held.mobility(state.mass[at(node)]);
      continue;
    }
    const auto& answer = answer_[at(body)];
    const Pushed& pushed = pushed_[at(body)];
    const Vec3& x = state.x[at(node)];
    const double own = stiffness[at(node)];
    const double share = own > 0.0 ? pushed.stiffness / own : 1.0;
    const Vec3 to = own > 0.0 ? answer.centre + pushed.moment / pushed.stiffness : x;
    std::array<Vec3, 3> column;  // of what an impulse at the node along k does at `to`
    for (int k = 0; k < 3; ++k) {
      Vec3 unit{};
      unit[k] = 1.0;
      column[static_cast<std::size_t>(k)] = answer.velocity(to, x, unit);
    }
    const auto& [a, b, c] = column;
    mobility_[i].a = {a.x, b.y, c.z, 0.5 * (a.y + b.x), 0.5 * (b.z + c.y), 0.5 * (c.x + a.z)};
    for (double& entry : mobility_[i].a) entry *= share;
    mobility_[i].stiffness = own;
  }
}

}  // namespace abut::cycle
