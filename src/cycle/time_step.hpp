// The step that begins at t^n: element, nodal and interface limits, growth and mass scaling (numerics.md 2.2 to 2.5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/profile.hpp"
#include "cycle/free_flight.hpp"
#include "cycle/node_kernels.hpp"
#include "cycle/sink.hpp"
#include "model/model.hpp"
#include "parallel/thread_pool.hpp"
#include "state/state.hpp"

namespace abut::constraints {
class RigidBodies;
}

namespace abut::cycle {

/// What limits the coming step, collected during the cycle.
struct StepLimits {
  double element = 1e30;  ///< smallest scaled element step
  StepController element_controller;
  double interface_step = 1e30;  ///< kinematic limits of interfaces (closing speed against gap)
  StepController interface_controller;
};

class TimeStep {
 public:
  /// @param free_translation, free_rotation  #N: 0 where a node cannot move (all directions fixed): it does not control
  TimeStep(const model::Model& model, const Profile& profile, bool has_two_sided_interface, std::vector<std::uint8_t> free_translation,
           std::vector<std::uint8_t> free_rotation);

  /// Adds mass where /DT/NODA/CST asks for it (2.3): m <- 1.00001 K/2 (dt_min/s)^2, inertia likewise; of a rigid body to the body and
  /// its tensor. Clamped nodes get none (reference profile: they do). The step of a cycle that adds mass is at most dt_min.
  /// @return energy that the added mass brings, m v.v/2
  double scale_masses(state::State& s, constraints::RigidBodies& bodies);

  /// Chooses h_plus and h_bar of s.times; says who controls.
  /// @param contact_stiffness  #N: share of s.stiffness that comes from interfaces
  StepController choose(state::State& s, const StepLimits& limits, std::span<const double> contact_stiffness, parallel::ThreadPool& pool);

  /// First node whose mass grew by more than `ratio` of its first one (/STOP); no_index: none, or ratio 0.
  [[nodiscard]] Index first_beyond(double ratio, const state::State& s) const;
  [[nodiscard]] double added_mass() const { return added_mass_; }
  [[nodiscard]] std::span<const double> added_masses() const { return added_; }  ///< #N, or empty: none so far
  [[nodiscard]] double nodal_scale() const { return nodal_scale_; }
  void persist(state::Archive& a);

 private:
  struct Smallest : LimitLeaf {
    Smallest& operator+=(const Smallest& b);
  };
  /// Throws RunError where time stands still, the first step asks for more cycles than any machine can do, or the step has collapsed.
  void refuse_endless(const state::State& s, double step, const StepController& who);
  /// Mean step of the last cycles, where it is a millionth of the largest one and does not get to the end in 1e9 cycles; else 0.
  [[nodiscard]] double mean_of_collapse(const state::State& s, double step);
  [[nodiscard]] Smallest nodal(const state::State& s, bool rotations, parallel::ThreadPool& pool);

  const model::Model& model_;
  Profile profile_;
  bool two_sided_;
  FreeFlight free_flight_;
  std::vector<std::uint8_t> free_translation_, free_rotation_;
  std::vector<std::uint8_t> scaled_;  ///< nodes that may receive mass
  std::vector<Smallest> leaves_;
  double nodal_scale_;
  double previous_step_ = 1e30;                    ///< before the first cycle: no limit on growth
  double largest_step_ = 0.0, window_time_ = 0.0;  ///< of the run so far; where the present window of cycles began
  double added_mass_ = 0.0;
  std::vector<double> added_;     ///< #N, mass added so far, when masses may be scaled
  Index scaled_node_ = no_index;  ///< first node that got mass or inertia in this cycle
};

}  // namespace abut::cycle
