// /IMPVEL, /IMPDISP, /IMPACC (numerics.md 6.3; work: 1.6.4).
#pragma once

#include <cstdint>
#include <vector>

#include "constraints/axes.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/curves.hpp"
#include "constraints/work_meter.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

class RigidBodies;

/// Replaces one component of the acceleration so that the motion meets its curve, for t_start <= t^n <= t_stop:
///   velocity      a = (F f(t + h_+/2) - v) / h_bar        displacement  a = ((F f(t + h_+) - u) / h_+ - v) / h_bar
///   displacement started by a sensor: F (f(tau + h_+) - f(tau)) / h_+ in place of (.. - u) / h_+
///   acceleration  a = F f(t + h_+)
/// Rotational displacement: the rotation accumulated here since t = 0.
class ImposedMotions {
 public:
  ImposedMotions(const model::Model& model, const Curves& curves, const Axes& axes, RigidBodies& bodies);

  /// Step 20. Secondary nodes of active rigid bodies are left alone; of main nodes beside the centre only the velocity wanted is found, for
  /// RigidBodies::hold().
  void apply(state::State& state, const BoundaryConditions& conditions);

  /// After apply(), once per cycle: (a - a_free)/2 m (v + h_bar a / 2) times h_- now, and times h_+ in the next cycle if the
  /// condition is still active then (numerics.md 1.6.4).
  double book_work(const state::State& state);

  /// Step 25: exact discrete work.
  double ledger_work(const state::State& state) { return meter_.settle(state); }

  /// 1/2 m |v|^2 and 1/2 J |w|^2 of the nodes with an imposed motion, velocities of the half step, which a jump shows though the energies
  /// at t^n do not.
  [[nodiscard]] double half_step_energy(const state::State& state) const;

  void persist(state::Archive& a);

  /// Adds the directions in which `node` is moved in this cycle to those that are held. @param rotation rotations, else translations
  void add_imposed(Index node, bool rotation, BoundaryConditions::Held& held) const;

  /// Calls take(node, rotation, axis) for every component that is imposed at time t.
  template <class Take>
  void for_each_imposed(double t, const Take& take) const {
    for (const Dof& dof : dofs_) {
      const model::ImposedMotion& motion = model_->imposed_motions[static_cast<std::size_t>(dof.motion)];
      if (acts(dof, motion, t)) take(dof.node, motion.direction >= 3, axes_->axis(motion.skew, motion.direction % 3));
    }
  }

  /// After apply(): calls take(rotation, axis, velocity wanted at n + 1/2) for every component of a main node beside the centre.
  template <class Take>
  void for_each_wanted(Index node, const Take& take) const {
    for (const Dof& dof : dofs_) {
      if (dof.node != node || !dof.active) continue;
      const model::ImposedMotion& motion = model_->imposed_motions[static_cast<std::size_t>(dof.motion)];
      take(motion.direction >= 3, axes_->axis(motion.skew, motion.direction % 3), dof.wanted);
    }
  }

  /// Reaction of motion i on each of its nodes in this cycle, m (a - a_free) along the axis (force or moment); none where
  /// RigidBodies::hold() moves the node.
  [[nodiscard]] double reaction(Index motion) const { return reaction_[static_cast<std::size_t>(motion)]; }

 private:
  struct Dof {
    Index motion, node;
    double angle = 0.0;      ///< accumulated rotation (rotational displacement only)
    double power = 0.0;      ///< m (a - a_free) (v + h_bar a / 2) / 2 of this cycle
    double old_power = 0.0;  ///< of the previous cycle
    double wanted = 0.0;     ///< velocity at n + 1/2; of this cycle, where RigidBodies::hold() moves the node
    bool active = false;
  };
  /// Rotations of main nodes that are the centre of their body, together.
  struct Turn {
    Index node;
    BoundaryConditions::Held held;
    Vec3 given, moment;  ///< angular acceleration along the held directions; what that takes
  };
  void turn_bodies(state::State& state, const BoundaryConditions& conditions);
  /// Acceleration along its axis that the motion wants of a component of velocity v. @param reached  angle or displacement so far
  [[nodiscard]] double wanted_acceleration(const model::ImposedMotion& motion, const state::StepTimes& times, double v,
                                           double reached) const;
  [[nodiscard]] bool acts(const Dof& dof, const model::ImposedMotion& motion, double t) const;

  const model::Model* model_;
  const Curves* curves_;
  const Axes* axes_;
  RigidBodies* bodies_;
  std::vector<Dof> dofs_;
  std::vector<double> reaction_;
  std::vector<Turn> turns_;  ///< of this cycle
  WorkMeter meter_;
};

}  // namespace abut::constraints
