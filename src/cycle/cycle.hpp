// One cycle of central differences, in the order of numerics.md 1.2.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "constraints/accelerometers.hpp"
#include "constraints/axes.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/curves.hpp"
#include "constraints/imposed_motions.hpp"
#include "constraints/loads.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rigid_walls.hpp"
#include "constraints/sections.hpp"
#include "constraints/work_meter.hpp"
#include "cycle/contact_facing.hpp"
#include "cycle/contact_mobility.hpp"
#include "cycle/contact_thickness.hpp"
#include "cycle/ledger.hpp"
#include "cycle/run.hpp"
#include "cycle/sink.hpp"
#include "cycle/time_step.hpp"
#include "elements/assembly.hpp"
#include "init/contact_setup.hpp"
#include "init/face_owners.hpp"
#include "init/start.hpp"
#include "simd/aligned.hpp"

namespace abut::cycle {

class Cycle {
 public:
  Cycle(const model::Model& model, const RunOptions& options);

  /// Forces at t^n, step, constraints, balance, output, integration to t^(n+1).
  /// @throws RunError when a result is not finite or an error limit of the deck is exceeded
  void advance(Sink& sink);
  /// Begins the outputs of a run that ends before its first cycle had any; nothing where they were begun.
  void begin(Sink& sink);
  /// An exception has ended a cycle: the state is that of no moment, and no cycle can follow.
  [[nodiscard]] bool broken_off() const { return under_way_; }

  /// The run is over when t > t_end (numerics.md 2.4), a cycle later where an animation state is still due.
  [[nodiscard]] bool finished() const { return state_.times.t > model_.controls.t_end && !animation_left(); }
  [[nodiscard]] const state::State& state() const { return state_; }
  [[nodiscard]] const state::Balance& balance() const { return balance_; }
  [[nodiscard]] const StepController& controller() const { return controller_; }
  [[nodiscard]] std::span<const InterfaceResult> interface_results() const { return interface_results_; }
  [[nodiscard]] std::vector<PhaseTime> phases() const;
  [[nodiscard]] double element_count() const;
  [[nodiscard]] double worst_error() const { return worst_error_; }
  [[nodiscard]] double worst_contact_error() const { return worst_contact_error_; }
  /// What an output may read, between two cycles: positions are one step ahead of forces.
  [[nodiscard]] Snapshot view();
  /// Velocities to be changed by the caller, #N: the next cycle takes them over before it accelerates (cycle/edits.cpp).
  [[nodiscard]] std::span<Vec3> edit_velocities();
  [[nodiscard]] std::span<Vec3> edit_angular_velocities();
  /// Velocities with what the caller has changed.
  [[nodiscard]] std::span<const Vec3> velocities() const { return edited_v_.empty() ? std::span<const Vec3>(state_.v) : edited_v_; }
  [[nodiscard]] std::span<const Vec3> angular_velocities() const { return edited_w_.empty() ? std::span<const Vec3>(state_.w) : edited_w_; }
  /// Everything that the next cycles depend on and that their outputs accumulate, between two cycles (cycle/persist.cpp). A cycle
  /// made from the same model that reads what another one wrote goes on with the same bits.
  void persist(state::Archive& a);
  /// Hash over t, the last step, x, v, w and mass of nodes, and the histories of elements and contacts. Not in it, but in persist():
  /// inertia, forces, bodies, walls, conditions, motions, loads, the controls of the step, balance, outputs, and changes that wait to be
  /// taken over.
  [[nodiscard]] std::uint64_t hash();

 private:
  enum Phase { p_elements, p_assembly, p_search, p_contact, p_constraints, p_integrate, p_output, phase_count };
  class Timer;

  void decide_outputs();
  void switch_off_rigid_elements();
  void check_minimum_step(const elements::Group& group, const elements::GroupResult& result) const;
  void forces(StepLimits& limits);
  void internal_forces(StepLimits& limits);
  void contact_forces(StepLimits& limits);
  void record_contacts();
  void erode();
  void assemble();
  void accelerate_again();
  void release_boundary_conditions();
  void book_impulses();
  void close_balance();
  void integrate();
  void check_finite();
  [[nodiscard]] Snapshot snapshot() const;
  [[nodiscard]] Snapshot snapshot_of_cycle();
  void fill_contact_fields();
  void fill_option_forces();
  void persist_output_times(state::Archive& a);
  [[nodiscard]] double take_over_edits();
  [[nodiscard]] Id element_id(const elements::Group& group, Index element) const;

  const model::Model& model_;
  RunOptions options_;
  parallel::ThreadPool pool_;
  std::vector<std::unique_ptr<elements::Group>> groups_;
  elements::Assembly assembly_;
  state::State state_;
  simd::AlignedVector<double> sums_;  // of chunks of elements
  std::vector<double> slots_;         // of elements, when a section asks for them

  constraints::Curves curves_;
  constraints::Axes axes_;
  constraints::RigidBodies bodies_;
  constraints::Loads loads_;
  constraints::Gravities gravities_;
  constraints::BoundaryConditions boundary_;
  constraints::ImposedMotions imposed_;
  constraints::RigidWalls walls_;
  constraints::Sections sections_;
  constraints::Accelerometers accelerometers_;
  int bodies_revision_ = -1;

  std::vector<init::RunInterface> interfaces_;
  std::vector<bool> recording_;                 // #recordings: begun
  state::ZeroArray<double> contact_stiffness_;  // #N
  bool contact_known_ = true;  // interfaces know where it and the contact forces are not zero: not so in the cycle after a checkpoint
  state::ZeroArray<Vec3> contact_normal_, contact_tangential_;  // #N when an animation is due, else empty
  ContactMobility contact_mobility_;
  ContactFacing contact_facing_;
  ContactThickness contact_thickness_;
  state::ZeroArray<double> contact_area_;
  std::vector<contact::NodalContact> contact_state_;
  std::vector<Vec3> option_force_, option_moment_;  // #N when an animation is due and there are such options
  bool releases_ = false;                           // some interface asks for IBC
  bool loaded_ = false;                             // there are concentrated or pressure loads; else external forces stay zero
  bool totals_wanted_ = false;  // bodies, walls or mass scaling read or change the total forces or the masses after assembly
  bool held_again_ = false;     // what comes after the boundary conditions may move what they hold
  bool rotations_ = false;      // some node has inertia, or can be turned by a condition

  std::unique_ptr<TimeStep> time_step_;
  Ledger ledger_;
  state::Balance balance_;
  StepController controller_;
  double next_history_ = 0.0, next_animation_ = 0.0;
  /// A state is due up to the end, and no cycle has come to it.
  [[nodiscard]] bool animation_left() const {
    constexpr double rounding = 1e-9;  // of the sum of intervals
    return next_animation_ <= (1.0 + rounding) * model_.controls.t_end;
  }
  bool history_written_ = false;  ///< in the cycle before
  bool history_due_ = false, animation_due_ = false, listing_due_ = false;
  bool begun_ = false;
  bool under_way_ = false;  ///< a cycle has begun and not come to its end
  bool eroded_ = false;
  std::optional<init::FaceOwners> face_owners_;  // once an element of a model with pressures is gone
  double scaled_energy_ = 0.0;
  double removed_energy_ = 0.0;                  // held by deleted elements that their groups no longer count
  std::vector<Vec3> edited_v_, edited_w_;        // #N, empty: nothing was changed
  std::optional<constraints::StopWork> stops_;   // of all nodes, in a cycle that takes over changes
  std::optional<constraints::StopWork> caught_;  // of nodes whose conditions contact lifts and gives back
  double start_work_ = 0.0;                      // of gradual starts, a part of the external work
  double edited_work_ = 0.0;                     // energy that the caller's changes brought in this cycle
  double waiting_work_ = 0.0;                    // of cycle 0, for the external work of the next one
  double booked_work_ = 0.0;                     // external work of this cycle as the reference program books it
  int beyond_limit_ = 0;                         // cycles in a row with an energy error beyond the limit
  double worst_error_ = 0.0, worst_contact_error_ = 0.0;
  std::vector<PartResult> parts_;
  std::vector<InterfaceResult> interface_results_;
  std::array<double, phase_count> seconds_{};
  std::array<double, 5> family_seconds_{};  // of p_elements, by element kind
};

}  // namespace abut::cycle
