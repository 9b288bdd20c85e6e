#include "constraints/boundary_conditions.hpp"

#include <algorithm>
#include <cstddef>

#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

namespace {

std::vector<Index> conditioned_nodes(const model::Model& model) {
  std::vector<Index> nodes;
  for (const model::BoundaryCondition& card : model.boundary_conditions) nodes.insert(nodes.end(), card.nodes.begin(), card.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void remove(Vec3& v, const Vec3& axis) { v -= dot(v, axis) * axis; }

/// The same for global axes. @param bits bit k: direction k
void remove(Vec3& v, unsigned bits) {
  for (int k = 0; k < 3; ++k) {
    if ((bits >> static_cast<unsigned>(k) & 1U) != 0U) v[k] = 0.0;
  }
}

}  // namespace

BoundaryConditions::BoundaryConditions(const model::Model& model, const Axes& axes, const RigidBodies& bodies, const Profile& profile)
    : axes_(&axes),
      bodies_(&bodies),
      secondary_too_(profile.rigid_body == Profile::RigidBody::reference),
      nodes_(conditioned_nodes(model)),
      released_(static_cast<std::size_t>(model.node_count()), 0),
      meter_(nodes_, &bodies) {
  std::vector<Entry> all;
  for (const model::BoundaryCondition& card : model.boundary_conditions) {
    unsigned bits = 0;
    for (unsigned k = 0; k < 3; ++k) bits |= (card.translation[k] ? 1U << k : 0U) | (card.rotation[k] ? 8U << k : 0U);
    for (const Index node : card.nodes) all.push_back({node, card.skew, static_cast<std::uint8_t>(bits)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Entry& a, const Entry& b) { return a.node != b.node ? a.node < b.node : a.skew < b.skew; });
  for (const Entry& entry : all) {
    if (!entries_.empty() && entries_.back().node == entry.node && entries_.back().skew == entry.skew) {
      entries_.back().bits = static_cast<std::uint8_t>(entries_.back().bits | entry.bits);
    } else {
      entries_.push_back(entry);
    }
  }
  first_.assign(static_cast<std::size_t>(model.node_count()) + 1, 0);
  for (const Entry& entry : entries_) ++first_[static_cast<std::size_t>(entry.node) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

void BoundaryConditions::apply(state::State& state) {
  meter_.before(state);
  for (const Index node : nodes_) {
    if (!secondary_too_ && (bodies_->body_of(node) != no_index || bodies_->holds(node))) continue;
    const auto i = static_cast<std::size_t>(node);
    if (const Index e = plain_entry(node); e != no_index) {
      const unsigned bits = held_bits(entries_[static_cast<std::size_t>(e)]);
      remove(state.a[i], bits & 7U);
      remove(state.v[i], bits & 7U);
      remove(state.alpha[i], bits >> 3U);
      remove(state.w[i], bits >> 3U);
      continue;
    }
    const Held translation = held(node, false);
    for (std::size_t k = 0; k < static_cast<std::size_t>(translation.count); ++k) {
      remove(state.a[i], translation.axis[k]);
      remove(state.v[i], translation.axis[k]);
    }
    const Held rotation = held(node, true);
    for (std::size_t k = 0; k < static_cast<std::size_t>(rotation.count); ++k) {
      remove(state.alpha[i], rotation.axis[k]);
      remove(state.w[i], rotation.axis[k]);
    }
  }
  meter_.after(state);
}

BoundaryConditions::Held BoundaryConditions::held(Index node, bool rotation, unsigned without) const {
  Held result;
  const auto i = static_cast<std::size_t>(node);
  for (Index e = first_[i]; e < first_[i + 1]; ++e) {
    const Entry& entry = entries_[static_cast<std::size_t>(e)];
    const unsigned all = held_bits(entry) & ~without;
    const unsigned bits = rotation ? all >> 3U : all & 7U;
    for (int k = 0; k < 3 && result.count < 3; ++k) {
      if ((bits >> static_cast<unsigned>(k) & 1U) == 0U) continue;
      const Vec3 axis = axes_->axis(entry.skew, k);
      if (e == first_[i]) {
        result.axis[static_cast<std::size_t>(result.count++)] = axis;
      } else {
        result.add(axis);
      }
    }
  }
  return result;
}

void BoundaryConditions::Held::add(Vec3 direction) {
  if (count == 3) return;
  direction = free_part(direction);
  if (squared_norm(direction) < 1e-12) return;
  axis[static_cast<std::size_t>(count++)] = normalized(direction);
}

Vec3 BoundaryConditions::Held::free_part(Vec3 b) const {
  if (count == 3) return {};
  for (int k = 0; k < count; ++k) remove(b, axis[static_cast<std::size_t>(k)]);
  return b;
}

contact::Mobility BoundaryConditions::Held::mobility(double mass) const {
  contact::Mobility m;
  if (count == 3 || mass <= 0.0) return m;
  m.a = {1.0 / mass, 1.0 / mass, 1.0 / mass, 0.0, 0.0, 0.0};
  for (int k = 0; k < count; ++k) m.add(-1.0 / mass, axis[static_cast<std::size_t>(k)]);
  return m;
}

void BoundaryConditions::release(Index node, int direction) {
  auto& bits = released_[static_cast<std::size_t>(node)];
  bits = static_cast<std::uint8_t>(bits | 1U << static_cast<unsigned>(direction));
}

void BoundaryConditions::restore(Index node, int direction) {
  auto& bits = released_[static_cast<std::size_t>(node)];
  bits = static_cast<std::uint8_t>(bits & ~(1U << static_cast<unsigned>(direction)));
}

void BoundaryConditions::restore_all() { std::fill(released_.begin(), released_.end(), std::uint8_t{0}); }

bool BoundaryConditions::fixed(Index node, int direction) const {
  const auto i = static_cast<std::size_t>(node);
  for (Index e = first_[i]; e < first_[i + 1]; ++e) {
    if ((held_bits(entries_[static_cast<std::size_t>(e)]) >> static_cast<unsigned>(direction) & 1U) != 0U) return true;
  }
  return false;
}

}  // namespace abut::constraints
