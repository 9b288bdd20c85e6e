// Concentrated and pressure loads, gravity (numerics.md 6.4, 6.5; work: 1.6.4).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "constraints/axes.hpp"
#include "constraints/curves.hpp"
#include "constraints/work_meter.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

class RigidBodies;

/// /CLOAD: F = scale_y f(t / scale_x) along the axis at t^n. /PLOAD, quadrilateral: P/8 (x3 - x1) x (x4 - x2) on each node,
/// triangle (last node repeated): P/6 (x3 - x1) x (x3 - x2); positive P pushes along the segment's normal, until the segment's elements are
/// deleted.
class Loads {
 public:
  Loads(const model::Model& model, const Curves& curves, const Axes& axes);

  /// Switches off the pressure on facets all of whose elements are gone. @param owners  elements of a facet; empty: it stays
  void erode(const std::function<std::vector<model::ElementRef>(const std::array<Index, 4>&)>& owners,
             const std::function<bool(const model::ElementRef&)>& alive);

  /// Step 3: sets (not adds to) f_external and m_external at t^n.
  void apply(state::State& state);

  /// Step 15: external work of this cycle as the reference program books it (numerics.md 1.6.4):
  /// /CLOAD (F^(n-1) + F^n)/2 . v h_+, /PLOAD f . v h_-, v as it enters the cycle. After apply(), once per cycle.
  double book_work(const state::State& state);

  /// Step 25: exact discrete work (work_meter.hpp) of f_external and m_external.
  double ledger_work(const state::State& state) { return work_.settle(state, state.f_external, state.m_external); }

  void persist(state::Archive& a) {
    a.fixed(pressure_);
    work_.persist(a);
  }

 private:
  void add_pressure(state::State& state);

  const model::Model* model_;
  const Curves* curves_;
  const Axes* axes_;
  std::vector<Vec3> pressure_;                   ///< #N by 3, /PLOAD forces of the cycle; empty without /PLOAD
  std::vector<std::vector<std::uint8_t>> gone_;  ///< per /PLOAD and segment: no element left; empty: none
  ForceWork work_;
};

/// /GRAV: a += scale_y f(t / scale_x) axis, after f/m and before boundary conditions.
class Gravities {
 public:
  Gravities(const model::Model& model, const Curves& curves, const Axes& axes, const RigidBodies& bodies);

  /// Step 17: adds to a. Secondary nodes of active rigid bodies are left out: step 23 overwrites them.
  void apply(state::State& state);

  /// Step 17, next to apply(): (g^(n-1) + g^n)/2 m v h_- (numerics.md 1.6.4).
  double book_work(const state::State& state);

  /// Step 25: exact discrete work.
  double ledger_work(const state::State& state) { return meter_.settle(state); }

  void persist(state::Archive& a) { meter_.persist(a); }

 private:
  const model::Model* model_;
  const Curves* curves_;
  const Axes* axes_;
  const RigidBodies* bodies_;
  WorkMeter meter_;
};

}  // namespace abut::constraints
