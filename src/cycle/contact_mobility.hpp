// How the nodes of the interfaces answer to impulses where they are not free: what contact makes effective masses of pairs with.
//
// Held nodes (boundary conditions, imposed motions; one or two directions, skews): (1 - sum e_k e_k^T)/m. IBC of an interface lifts
// conditions of nodes that are themselves in contact, in the cycle in which they touch. A node that is never a corner of a facet counts as
// free in these directions at all times, for only its own pairs ask; one that is a corner, too (TYPE3, self contact), as it was in the
// cycle before: held until it touches; a corner that is no contact node as held.
// Nodes of a rigid body: springs that act on it together share its mass in proportion to their stiffness K_i (that of the last cycle, which
// counts nodes that are about to touch),
//   A_i = (K/K_i) (T - sym([r_i] R [r]^T)),   K = sum K_i,  r = sum K_i r_i / K     ([r] the matrix of r x)
// which is the body's own answer at the contact point where one pair acts, and mass over number of pairs where it lands flat.
// Rigid walls are not in it: whether one stops a node is known after the forces only.
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

class ContactMobility {
 public:
  ContactMobility() = default;
  ContactMobility(const model::Model& model, std::span<const init::RunInterface> interfaces,
                  const constraints::BoundaryConditions& conditions);

  /// At t^n, before the contact forces. @param stiffness  #N: contact stiffness of the cycle before
  void update(const state::State& state, const constraints::BoundaryConditions& conditions, const constraints::ImposedMotions& imposed,
              const constraints::RigidBodies& bodies, std::span<const double> stiffness);

  /// As contact::HostState wants them; empty where nothing holds a node of an interface.
  [[nodiscard]] std::span<const Index> constrained() const { return entry_; }
  [[nodiscard]] std::span<const contact::Mobility> mobility() const { return mobility_; }

 private:
  using Held = constraints::BoundaryConditions::Held;
  void update_bodies(const state::State& state, const constraints::RigidBodies& bodies, std::span<const double> stiffness);
  void update_steady(const state::State& state, const constraints::BoundaryConditions& conditions);

  const model::Model* model_ = nullptr;
  std::vector<Index> entry_;                 ///< #N
  std::vector<Index> nodes_;                 ///< nodes of interfaces that may be held or belong to a body
  std::vector<Index> steady_nodes_;          ///< those of interfaces that are always held alike
  std::vector<double> steady_mass_;          ///< as steady_nodes_: what their mobility was made with
  std::vector<contact::Mobility> mobility_;  ///< as nodes_, then steady_nodes_
  std::vector<Index> bound_nodes_;           ///< nodes with conditions or imposed motions that are not steady, main nodes
  std::vector<std::int32_t> bound_;          ///< #N: place in bound_nodes_, or -1
  std::vector<Held> held_, held_rotation_;   ///< as bound_nodes_
  std::vector<std::uint8_t> lifted_;  ///< as bound_nodes_: directions that count as released at all times, bits as of BoundaryConditions
  struct Pushed {
    double stiffness = 0.0;
    Vec3 moment;  ///< sum K_i r_i
  };
  std::vector<constraints::RigidBodies::Answer> answer_;  ///< per body
  std::vector<Pushed> pushed_;
};

}  // namespace abut::cycle
