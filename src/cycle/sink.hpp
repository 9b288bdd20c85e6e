// Outputs as the cycle sees them: it hands a snapshot to sinks and knows nothing of files.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abut/contact/interface.hpp"
#include "abut/results.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "constraints/accelerometers.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rigid_walls.hpp"
#include "constraints/sections.hpp"
#include "elements/group.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::cycle {

using abut::InterfaceResult;
using abut::Outcome;
using abut::StepController;

struct PartResult {
  double ie = 0.0, he = 0.0;
  elements::PartSums sums;
  Index eroded = 0;
};
using WallResult = constraints::WallSums;
using BodyResult = constraints::BodySums;
using SectionResult = constraints::SectionSums;
using AccelerometerResult = constraints::AccelerometerSums;

/// Everything that an output may read at t^n (numerics.md 1.2 step 26). Views are valid during the call only.
struct Snapshot {
  const model::Model* model = nullptr;
  const state::State* state = nullptr;
  const state::Balance* balance = nullptr;
  std::span<const std::unique_ptr<elements::Group>> groups;
  std::span<const PartResult> parts;            ///< per model part; `sums` valid when history_due
  std::span<const InterfaceResult> interfaces;  ///< per model interface
  std::span<const Vec3> contact_normal;  ///< #N by 3, nodal normal contact force of all interfaces; these four: empty unless animation_due
  std::span<const Vec3> contact_tangential;              ///< #N by 3
  std::span<const double> contact_area;                  ///< #N, tributary area of contact surfaces (0: not on one)
  std::span<const contact::NodalContact> contact_state;  ///< #N, of all interfaces
  /// Empty unless animation_due and there are such options; #N by 3. Rigid bodies: force and moment of the secondary nodes, at the main
  /// node. Walls: force on the wall, at the node that carries it, else at each node that presses on it. Sections: force and moment (global
  /// axes), at the first node of their frame. Sums where several meet.
  std::span<const Vec3> option_force, option_moment;
  std::span<const double> added_mass;  ///< #N by mass scaling so far; empty: none
  double nodal_scale = 0.0;            ///< factor of the step of nodes
  std::span<const WallResult> walls;
  std::span<const BodyResult> bodies;
  std::span<const SectionResult> sections;
  std::span<const AccelerometerResult> accelerometers;
  StepController controller;
  bool history_due = false;      ///< a time-history row belongs to this cycle
  bool animation_due = false;    ///< an animation state belongs to this cycle
  bool listing_due = false;      ///< a line of the cycle listing belongs to this cycle
  std::uint64_t state_hash = 0;  ///< valid when hash_due
  bool hash_due = false;
};

class Sink {
 public:
  virtual ~Sink() = default;
  virtual void begin(const Snapshot& first) = 0;  ///< before the first cycle's output, once
  virtual void cycle(const Snapshot& now) = 0;    ///< every cycle, at step 26
  virtual void end(const Outcome& outcome) = 0;   ///< once, also after a failure
  /// What a later run needs to go on from here: written after a cycle, read before begin(). begin() is then told of the first
  /// cycle that goes on.
  virtual void persist(state::Archive& /*archive*/) {}
};

}  // namespace abut::cycle
