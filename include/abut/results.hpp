// What a run says about itself: energies, interfaces, the time step, how it ended. Value types in the model's units.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut {

/// Who gives the time step.
struct StepController {
  enum class Kind { none, shell, sh3n, brick, tetra, node, interface, fixed, contact_node } kind = Kind::none;
  Id id = 0;  ///< of the element, node or interface; 0 when there is none
};

/// Terms of the balance at t^n (columns GLOBAL/... of the time history).
struct Balance {
  double ie = 0.0, he = 0.0, ke = 0.0, ker = 0.0;  ///< internal, hourglass, kinetic of translation and of rotation
  double ce = 0.0, fw = 0.0, dw = 0.0, cx = 0.0;   ///< interfaces: stored, friction, damping, made or lost
  double extw = 0.0, xe = 0.0;                     ///< external work; energy of eroded elements and added mass
  double initial = 0.0;                            ///< sum of the terms at the start
  double largest = 0.0;                            ///< largest term so far, from what rounding makes on
  double err = 0.0;                                ///< GLOBAL/ERR: sum of the terms less the start, over the largest
  double ledger = 0.0;                             ///< GLOBAL/LEDGER: the same with the discrete works
  Vec3 momentum;                                   ///< of all nodes
  double mass = 0.0, added_mass = 0.0;             ///< of all nodes; of it what mass scaling has added
};

/// Forces are those of the last cycle; impulses their time integrals (numerics.md 7.4.2, 6.1.5).
struct InterfaceResult {
  Vec3 normal_force, tangential_force;            ///< on the second (main) surface
  Vec3 normal_impulse, tangential_impulse;        ///< force x time, since the start
  double ce = 0.0, fw = 0.0, dw = 0.0, cx = 0.0;  ///< stored, friction, damping, made or lost
  double sw = 0.0;                                ///< work put in by a gradual start; part of the external work
  Index in_contact = 0;                           ///< held nodes that touch, both passes
  double largest_penetration = 0.0;               ///< length
  Index deepest_node = no_index;                  ///< the one that has penetrated by that much
  /// Largest normal approach of a held node in the last step, in units of the gap (contact::StepResult::largest_approach), and the largest
  /// in any step since the last row of the time history before this one. 0 without a gap.
  double largest_approach = 0.0, peak_approach = 0.0;
  /// Share of the first and second surface near the other one that faces it, by area, when it was last looked at (docs/guide/outputs.md).
  /// NaN: TYPE7, a set of nodes, or nothing decided yet.
  std::array<double, 2> facing{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  std::span<const Index> crossed;  ///< nodes that would have jumped through in the last step; valid until the next cycle
  std::span<const Index> lost;     ///< nodes that went over a free border in the last step; valid until the next cycle
};

/// Why and how a run ended.
struct Outcome {
  enum class Kind { finished, stopped, interrupted, failed } kind = Kind::finished;
  std::string message;
  std::int64_t cycles = 0;  ///< done
  double time = 0.0;        ///< reached
};

/// "finished at time 0.2 after 77 cycles" with the outcome's message behind a colon.
[[nodiscard]] std::string to_string(const Outcome& outcome);

/// Wall-clock seconds of one phase of a run.
struct PhaseTime {
  std::string name;
  double seconds = 0.0;
};

}  // namespace abut
