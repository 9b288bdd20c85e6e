// The exact discrete work of forces and of changes of velocity or acceleration: what GLOBAL/LEDGER is made of.
//
// Leap-frog, one node, one cycle. V: velocity as it enters the cycle; v: after all changes of the half-step velocity (walls,
// boundary conditions); a: final acceleration; V' = v + hb a the velocity it leaves with (hb = h_bar). The energy
//     T*_n = 1/2 m v . V'
// then changes from one cycle to the next by
//     T*_n - T*_(n-1) = 1/2 m (|v|^2 - |V|^2)            jump of the velocity in cycle n
//                     + 1/2 m hb a . v                   first half of the kick of cycle n
//                     + 1/2 m [hb a . V']_(n-1)          second half of the kick of cycle n - 1,
// exactly, for any sequence of steps. The kick is linear in a, so each contribution da (a force f: da = f / m) books
//     1/2 m hb da . v now and 1/2 m hb da . V' in the next cycle,
// and jumps telescope over the constraints that cause them. The sum of all bookings is T*_n - T*_0. For a constant step,
// force bookings are the trapezoidal work (f_old + f_new)/2 . dx. Rotations alike with inertia and angular velocity; for the
// main node of a rigid body with its inertia tensor. The bookings need v, a and hb of step 25 (everything final).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "state/state.hpp"

namespace abut::constraints {

class RigidBodies;

/// T*_n summed over all nodes, translation and rotation, step 25. With rigid bodies add RigidBodies::ledger_correction.
[[nodiscard]] double ledger_kinetic_energy(const state::State& state);

/// Two-half booking of a family of nodal forces and moments.
class ForceWork {
 public:
  /// Step 25: work booked for the time up to t^n. @param force #N by 3; @param moment #N by 3 or empty
  double settle(const state::State& state, std::span<const Vec3> force, std::span<const Vec3> moment = {});
  void persist(state::Archive& a) { a(second_half_); }

 private:
  double second_half_ = 0.0;
};

/// Energies that are computed from motion (of elements, of contact) take the work of their force g over the whole step up to t^n at the
/// velocity V that enters the cycle, leap-frog gives the second half of it at v. Where a wall or a host has changed the velocity, what is
/// missing,
///     1/2 hb g . (v - V),
/// is theirs: without it the balance is wrong to first order in the step where nodes under force are stopped. (Bodies feel impulses of
/// walls as accelerations, which are no jumps.)
class StopWork {
 public:
  /// @param nodes whose velocity may jump
  explicit StopWork(std::vector<Index> nodes) : nodes_(std::move(nodes)), entry_(nodes_.size()) {}
  void before(const state::State& state);
  /// Where others may change velocities later in the cycle: what they change is not of these jumps.
  void after(const state::State& state);
  /// Step 25.
  [[nodiscard]] double settle(const state::State& state) const;
  /// Momentum that jumps of v since before() brought to the nodes; secondary nodes of active bodies are left out (they are overwritten).
  [[nodiscard]] Vec3 gained(const state::State& state, const RigidBodies& bodies) const;

 private:
  struct Entry {
    Vec3 v, w;
  };
  std::vector<Index> nodes_;
  std::vector<Entry> entry_;
  std::vector<Entry> left_;  ///< empty: as it is in settle()
};

/// Measures the work of whatever changes v, w, a, alpha of its nodes between before() and after().
class WorkMeter {
 public:
  /// @param nodes distinct nodes that the constraint may touch
  /// @param bodies secondary nodes of active bodies are left out (they are overwritten), main nodes use the body's inertia
  WorkMeter(std::vector<Index> nodes, const RigidBodies* bodies);

  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }
  void before(const state::State& state);
  void after(const state::State& state);
  /// A force added to state.f of `node` before accelerations exist (step 12).
  void add_force(Index node, const Vec3& force);

  /// After the last after() of a cycle: the part of its work that changes of v and w are.
  [[nodiscard]] double jump_work() const { return jump_; }
  /// Step 25: work booked for the time up to t^n; clears the cycle's contributions.
  double settle(const state::State& state);
  /// Between two cycles: what the next settle() still has to book.
  void persist(state::Archive& a) { a(second_half_); }

 private:
  struct Kick {
    Vec3 v, w, a, alpha;
  };  ///< values at before()
  std::vector<Index> nodes_;
  const RigidBodies* bodies_;
  std::vector<Kick> entry_;
  std::vector<Vec3> da_, dalpha_;  ///< sum of the changes in this cycle
  std::vector<std::pair<Index, Vec3>> forces_;
  double jump_ = 0.0, second_half_ = 0.0;
};

}  // namespace abut::constraints
