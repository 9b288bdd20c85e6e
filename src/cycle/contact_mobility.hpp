// How the nodes of the interfaces answer to impulses where they are not free: what contact makes effective masses of pairs with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/mobility.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/imposed_motions.hpp"
#include "constraints/rigid_bodies.hpp"
#include "init/contact_setup.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Boundary conditions and imposed motions (also of one or two directions, in skews), rigid bodies with what holds their main node.
/// A direction that IBC of an interface lifts counts as free for all nodes of that interface: a node in contact is released in the
/// cycle in which it touches. Rigid walls are not in it: whether one stops a node is known after the forces only.
class ContactMobility {
 public:
  ContactMobility() = default;
  ContactMobility(const model::Model& model, std::span<const init::RunInterface> interfaces,
                  const constraints::BoundaryConditions& conditions);

  /// At t^n, before the contact forces.
  void update(const state::State& state, const constraints::BoundaryConditions& conditions, const constraints::ImposedMotions& imposed,
              const constraints::RigidBodies& bodies);

  /// As contact::HostState wants them; empty where nothing holds a node of an interface.
  [[nodiscard]] std::span<const Index> constrained() const { return entry_; }
  [[nodiscard]] std::span<const contact::Mobility> mobility() const { return mobility_; }

 private:
  using Held = constraints::BoundaryConditions::Held;
  const model::Model* model_ = nullptr;
  std::vector<Index> entry_;              ///< #N
  std::vector<contact::Mobility> mobility_;  ///< of bodies, then of bound nodes
  std::vector<Index> nodes_;              ///< of interfaces, that are bound or belong to a body of the model
  std::vector<std::int32_t> bound_;       ///< #N: place in held_ of nodes with conditions or imposed motions, else -1
  std::vector<Held> held_, held_rotation_;
  std::vector<Index> bound_nodes_;
  std::vector<std::uint8_t> lifted_;      ///< #N, bits as of BoundaryConditions
};

}  // namespace abut::cycle
