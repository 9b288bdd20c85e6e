// Infinite plane rigid walls, fixed or attached to a node (numerics.md 6.1).
#pragma once

#include <span>
#include <vector>

#include "constraints/work_meter.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

class RigidBodies;

/// What a wall received from the structure. Forces of this cycle (impulse / h_bar), impulses accumulated since t = 0;
/// "normal" points against the wall's normal.
struct WallSums { Vec3 normal_force, tangential_force, normal_impulse, tangential_impulse; };

class RigidWalls {
 public:
  RigidWalls(const model::Model& model, const RigidBodies& bodies);

  /// Moving walls: mass of the card added to the main node, velocity of the card given to it. After element masses and
  /// initial velocities are set, before RigidBodies::initialise.
  void initialise(state::State& state);

  /// Step 12, before a = f/m: reaction of the previous cycle on the main nodes of moving walls; their total force acts on the
  /// mass that they carry.
  void add_reaction(state::State& state);

  /// Step 21: nodes whose predicted position and velocity go into a wall are stopped; changes v and a.
  void apply(state::State& state);

  /// External work of this cycle as the reference program books it (numerics.md 1.6.4, 6.1.4). After apply().
  [[nodiscard]] double work() const { return work_; }
  /// Step 25: exact discrete work, including the reaction on moving walls.
  double ledger_work(const state::State& state) { return meter_.settle(state); }

  [[nodiscard]] std::span<const WallSums> results() const { return sums_; }  ///< per model rigid wall
  [[nodiscard]] Index in_contact(Index wall) const { return walls_[static_cast<std::size_t>(wall)].count; }

 private:
  struct Wall {
    std::vector<Index> nodes;          ///< tested nodes, main excluded
    std::vector<Vec3> filtered;        ///< friction filter: last tangential impulse per node
    Vec3 reaction;                     ///< on the main node, of the previous cycle
    double impacted_mass = 0.0;        ///< of the previous cycle
    Index count = 0;                   ///< nodes in contact in this cycle
  };
  void apply_wall(std::size_t index, state::State& state);

  const model::Model* model_;
  std::vector<Wall> walls_;
  std::vector<WallSums> sums_;
  double work_ = 0.0;
  WorkMeter meter_;
};

}  // namespace abut::constraints
