// Options and results of an interface: value types.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "abut/contact/friction_law.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::contact {

/// Normal law (T24): F = K Gap/(Gap - P) P, or F = K P. With Gap = 0 both are the constant law.
enum class Law { stiffening, constant };

/// What acts between a node and the borders of facets: closest point on faces, edges and corners, or the plain rule
/// (one normal per facet, hard tolerance beyond its edges).
enum class Edges { closest, plain };

/// What happens with nodes that lie within the gap or behind the surface when the interface first acts.
enum class Initial {
  keep,     ///< they are pushed with the full force of their penetration
  offset,   ///< the gap of each begins at what is there (no force) and grows back to the full gap as the node moves away
  project,  ///< the host moves them out before the first step, with Interface::projections(); then as keep
  ignore,   ///< they do not touch until they have been outside of the gap
};

/// Rules on which abut's standard and reference profiles differ (numerics.md 7.9).
struct Rules {
  Law law = Law::stiffening;
  Edges edges = Edges::closest;
  /// false: two surfaces, one spring each, in series (T13). true: TYPE5 takes half of the facet's stiffness.
  bool one_pass_half_stiffness = false;
  /// true: a triangle's third node counts twice in its nodal stiffness (K/4 each), else K/3 per node.
  bool triangle_third_node_twice = false;
  /// true: anchors as in numerics.md 7.4.3 (no friction in the first cycle of a contact unless it exists at the start, slip
  /// test on the full vector), else return mapping.
  bool reference_friction = false;
  /// true: closed-form projection by area ratios (exact for parallelograms), else Newton.
  bool area_ratio_projection = false;
  /// true: first and last force of a contact are scaled so that switching inside a step makes no energy.
  bool switch_correction = true;
  /// true: no limit on how deep a node may lie behind a facet.
  bool unlimited_depth = false;
  /// false: the interface hands no stiffness and no kinematic limit to the time step.
  bool limits_step = true;

  [[nodiscard]] static Rules standard() { return {}; }
  [[nodiscard]] static Rules reference() { return {Law::constant, Edges::plain, true, true, true, true, false, true, false}; }
};

/// Options of a one-sided interface (TYPE3: two passes, TYPE5: one). The ranges are checked when the interface is made:
/// std::invalid_argument.
struct Options {
  double stiffness_scale = 0.2;   ///< s (T14); must be > 0
  double friction = 0.0;          ///< Coulomb coefficient (T19); >= 0
  FrictionLaw friction_law;       ///< how it depends on pressure and speed
  FrictionFilter filter;          ///< of the trial friction force
  double tangential_ratio = 0.1;  ///< K_t / K_n (T21); > 0
  double gap = 0.0;               ///< length (T25..T28); >= 0
  /// Gap of a pair from thickness: half of the held node's and half of the facet's at the contact point (SurfaceState::thickness: 0 for
  /// solids; averaged at nodes, interpolated over facets), at least `gap`; at inward folds each facet counts with its own. With closest
  /// points only (Rules::edges).
  bool automatic_gap = false;
  double birth = 0.0;   ///< time from which the interface acts
  double death = 1e30;  ///< time after which it does not, > birth
  /// Gradual start: what overlaps (or lies within the gap) at birth is pushed apart over this time, not at once. Each node's
  /// gap begins at what is there, as with Initial::offset, and grows to the full gap; 0: off. With `keep` and `offset` only.
  double start_duration = 0.0;
  double shear_limit = 1e30;  ///< Ptlim: largest friction stress, force/length^2; > 0
  /// Normal viscosity as a fraction of critical of the pair; 0 (as in the theory) to 1. It never pulls.
  double damping = 0.0;
  Initial initial = Initial::keep;
  double depth_limit = 0.0;  ///< length, >= 0: how far behind a facet a node is still held when first met; 0: from facet size
  Rules rules;

  /// Some coefficient is not zero.
  [[nodiscard]] bool rubs() const { return friction > 0.0 || friction_law.model != FrictionLaw::Model::coulomb; }
};

/// A node that is moved so that it no longer penetrates at the start.
struct Projection {
  Index node = no_index;
  Vec3 by;  ///< length
};

/// What a held node has to do with the other side, for output.
struct NodalContact {
  enum class State : std::uint8_t { apart, stick, slip };  ///< without friction every contact slips
  State state = State::apart;
  /// Signed distance to the nearest point of the other side less the interface's gap: contact begins at 0, below it the node
  /// penetrates. NaN: nothing near (beyond what the search looks at; both_sides: beyond the mean size of a facet), the node is not held, or
  /// the interface does not act.
  double opening = std::numeric_limits<double>::quiet_NaN();
  double penetration = 0.0;  ///< P of a node in contact, else 0
};

/// Merges what one interface says of a node into what others said: the smallest opening, the deepest penetration, the larger state.
inline void merge(NodalContact& into, const NodalContact& from) {
  into.state = std::max(into.state, from.state);
  into.penetration = std::max(into.penetration, from.penetration);
  if (!(into.opening <= from.opening)) into.opening = std::isnan(from.opening) ? into.opening : from.opening;
}

/// What an interface says after evaluate(). Energies are cumulative since the start, in the host's unit of work.
struct StepResult {
  double elastic = 0.0;        ///< CE: stored now in normal springs and elastic stick
  double friction_work = 0.0;  ///< FW: dissipated by slip, never decreases
  double damping_work = 0.0;   ///< DW
  double start_work =
      0.0;  ///< SW: work that the growing gap of a gradual start, or a time window that opens over nodes in the gap, has put in
  /// CX = discrete work of the contact forces + (CE - CE of the first step) + FW + DW - SW + what leap-frog makes where the step changes
  /// under a contact force: energy made (> 0) or lost by the numerics
  double made = 0.0;
  Vec3 normal_force;  ///< on the second (main) surface
  Vec3 tangential_force;
  Index in_contact = 0;              ///< held nodes with P > 0, both passes
  double largest_penetration = 0.0;  ///< P, length
  Index deepest_node = no_index;     ///< host node that has it
  Index crossed = 0;                 ///< nodes that the swept test caught in this step: they would have jumped through
  Index lost = 0;  ///< nodes that went over a free border with P > 0 in this step, held ones or straight through (closest points only)
  /// Largest normal approach in the last step (t^n - h_- to t^n) of a held node that is in contact or near it, in units of the gap: at 1 a
  /// node takes the whole gap in a step. TYPE7: of the pairs with P > 0, in units of their own gaps. 0 where nothing closes in, in the
  /// first cycle, and always with Gap = 0, which has no such unit.
  double largest_approach = 0.0;
  /// Upper limit of the coming step: gap - P against closing speed, and the step that a light pair's last force was made for; 1e30: none.
  /// It says nothing of the step before: a host lets its step grow by 1.1 from cycle to cycle and no more, see HostState::dt.
  double kinematic_step = 1e30;
  Index kinematic_node = no_index;  ///< host node that gives it
};

}  // namespace abut::contact
