// Infinite plane rigid walls, fixed or attached to a node (numerics.md 6.1).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "constraints/boundary_conditions.hpp"
#include "constraints/imposed_motions.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/work_meter.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

/// What a wall received from the structure. Forces of this cycle (impulse / h_bar), impulses accumulated since t = 0;
/// "normal" points against the wall's normal.
struct WallSums {
  Vec3 normal_force, tangential_force, normal_impulse, tangential_impulse;
};

/// A moving wall is as heavy as what carries it: its main node, or the rigid body to which that node belongs. In the standard
/// profile the impact is plastic and momentum is exchanged in the same cycle, along those directions in which the carrier is neither
/// held nor moved by an imposed motion. With N the normal and A the response of the wall's node to an impulse on it, A p = velocity
/// gained (P p / M of a node, P the projection on its free directions; with the turn r x p of a body, RigidBodies::response),
///   V_w = V_p + A N sum m (v* - V_p).N / (1 + N.AN sum m)  over the nodes in contact; tied: V_p + A (1 + A sum m)^-1 sum m (v* - V_p),
/// with friction: V_p + A sum J(V_w), J of a node the impulse that a wall of that velocity takes from it, by Newton's iteration,
/// and the carrier gets the impulse sum J. The wall's plane keeps its normal, so its nodes press on it as if at its own node: the
/// couple of their offsets along the plane is the guide's. Reference profile: numerics.md 6.1.5; a rigid body overwrites what a wall
/// does to its nodes.
///
/// Points of a rigid body (its main node, and its secondary nodes unless Ikrem = 0 takes them out), standard profile: the wall stops the
/// body. Impulses p_i on the points that would cross, such that with V_i the velocity of point i after the impact
///   0 <= p_i.N  _|_  (V_i - V_w).N >= 0,   |p_i,t| <= mu p_i.N, against the slip where it slips     [Moreau 1988], [Jean 1999]
/// (mu = 0 without friction; without bound when tied), by projected Gauss-Seidel over the points in the order of the wall's nodes,
/// until no sweep changes a velocity by more than 1e-13 of the approach. The body gets p_i and its moment by RigidBodies::push, a moving
/// wall the opposite impulse, after the free nodes. Friction of these points is not filtered. A free node whose conditions hold it
/// in a direction oblique to the wall is such a point, too.
class RigidWalls {
 public:
  RigidWalls(const model::Model& model, const RigidBodies& bodies, const BoundaryConditions& conditions, const ImposedMotions& motions,
             const Profile& profile = {});

  /// Moving walls: mass of the card added to the main node, velocity of the card given to it. After element masses and
  /// initial velocities are set, before RigidBodies::initialise.
  void initialise(state::State& state);

  /// Step 12, before a = f/m. Reference profile: reaction of the previous cycle on the main nodes of moving walls, whose total
  /// force acts on the mass that they carry. Standard profile: nothing.
  void add_reaction(state::State& state);

  /// Step 21: nodes whose predicted position and velocity go into a wall are stopped; changes v and a.
  void apply(state::State& state);

  /// External work of this cycle as the reference program books it (numerics.md 1.6.4, 6.1.4). After apply().
  [[nodiscard]] double work() const { return work_; }
  /// Step 25: exact discrete work, including the reaction on moving walls.
  double ledger_work(const state::State& state) { return meter_.settle(state); }
  /// Before ledger_work: its part that jumps of the velocity are.
  [[nodiscard]] double jump_work() const { return meter_.jump_work(); }
  /// Step 25, of the external work: what the energies of elements and contact lack of the work up to the stop (StopWork).
  [[nodiscard]] double stop_work(const state::State& state) const { return stops_.settle(state); }

  /// Step 25: what the sum of m (v(n-1/2) + h-/2 a(n)) lacks of the momentum at t^n. Nodes are stopped by a jump of v, which that sum has
  /// whole, and the wall gets the impulse by its acceleration, of which it has h-/(2 h_bar): with this, both sides have the latter.
  /// Reference profile: nothing.
  [[nodiscard]] const Vec3& momentum_correction() const { return momentum_correction_; }

  void persist(state::Archive& a);

  [[nodiscard]] std::span<const WallSums> results() const { return sums_; }  ///< per model rigid wall
  /// Force on each wall of this cycle: at the node that carries it, else at the nodes that press on it. Added to `force`, #N.
  void add_forces(std::span<Vec3> force) const;
  [[nodiscard]] Index in_contact(Index wall) const { return walls_[static_cast<std::size_t>(wall)].count; }

 private:
  struct Wall {
    std::vector<Index> nodes;                      ///< tested nodes, main excluded
    std::vector<Vec3> filtered;                    ///< friction filter: last tangential impulse per node
    Vec3 reaction;                                 ///< on the main node, of the previous cycle
    double impacted_mass = 0.0;                    ///< of the previous cycle
    Index count = 0;                               ///< nodes in contact in this cycle
    std::vector<std::pair<Index, Vec3>> pressing;  ///< these, with the force on the wall
  };
  /// A point of a rigid body that a wall may stop.
  struct Point {
    RigidBodies::Carrier carrier;
    Vec3 impulse;  ///< on the body
  };
  /// The wall in a cycle.
  struct Plane {
    Vec3 point, velocity;  ///< at t^(n+1), at n + 1/2
    RigidBodies::Carrier carrier;
    bool yields = false;  ///< an impact changes the velocity in this cycle
  };
  void apply_wall(std::size_t index, state::State& state);
  void stop_bodies(std::size_t index, Plane& plane, state::State& state, Vec3& normal_impulse, Vec3& tangential_impulse);
  double press(const model::RigidWall& card, Point& point, Plane& plane, state::State& state) const;
  [[nodiscard]] RigidBodies::Carrier carrier_of(Index node) const;
  [[nodiscard]] Vec3 velocity_after_impact(const Wall& wall, const state::State& state, const model::RigidWall& card, const Vec3& before,
                                           const Vec3& point, const RigidBodies::Carrier& carrier) const;
  /// The same with friction, from the one without: V = V_p + A sum J(V), each J by the law of its node at V.
  [[nodiscard]] Vec3 velocity_with_friction(const Wall& wall, const state::State& state, const model::RigidWall& card, const Vec3& before,
                                            const Plane& plane) const;
  [[nodiscard]] bool of_body(Index node) const { return bodies_->body_of(node) != no_index || bodies_->main_of(node) != no_index; }
  /// Stopped along with the points of bodies: of a body, or held in a direction oblique to the wall, so that the impulse of the wall and of
  /// what holds it belong together.
  [[nodiscard]] bool is_point(Index node, const Vec3& normal) const;
  /// As a node of its own.
  [[nodiscard]] bool tested(Index node, const Vec3& normal) const { return !same_cycle_ || !is_point(node, normal); }
  /// Friction filter: J <- a J + (1 - a) J_old, with this a.
  [[nodiscard]] double weight_of_new(const model::RigidWall& card, double h_bar) const;
  [[nodiscard]] bool reaches(const state::State& state, Index node, const Vec3& point, const Vec3& normal) const;

  const model::Model* model_;
  const RigidBodies* bodies_;
  const BoundaryConditions* conditions_;
  const ImposedMotions* motions_;
  bool same_cycle_;
  bool bounded_filter_;
  std::vector<Wall> walls_;
  std::vector<WallSums> sums_;
  std::vector<Point> points_;  ///< of the wall at work
  double work_ = 0.0;
  Vec3 momentum_correction_;  ///< of this cycle
  WorkMeter meter_;
  StopWork stops_;
};

}  // namespace abut::constraints
