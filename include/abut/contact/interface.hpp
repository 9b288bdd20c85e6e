// An interface: what is held, what holds it, and the three verbs of a step.
//
//   search(x, v)    who can touch
//   evaluate(...)   adds forces and nodal contact stiffness into the host's spans; returns energies, resultants, counts
//   commit(dt)      friction and energy history move on
//
// The host turns the summed nodal stiffness of its elements and of all interfaces into one time step:
// h <= s sqrt(2 m / K) for every node keeps central differences stable (numerics.md 2.3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/inspect.hpp"
#include "abut/contact/mobility.hpp"
#include "abut/contact/options.hpp"
#include "abut/contact/surface.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::contact {

/// Runs body(begin, end) on disjoint ranges that cover [0, count), on any threads and in any order; returns when all are done and
/// hands on what a body throws. The results of an interface do not depend on how the ranges are cut.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)>;

/// What changes about a surface: spans of #F values, copied when set.
struct SurfaceState {
  std::span<const double> stiffness = {};     ///< own stiffness per facet: E t (shell) or B A^2/V (brick face) (T16..T18)
  std::span<const double> thickness = {};     ///< shell thickness per facet, 0: of a solid; empty: none
  std::span<const std::uint8_t> active = {};  ///< 0: eroded facet; never given: all active
  /// #S in the order of Surface::nodes(): 0 is let go, others stay held with the stiffness of all their facets, eroded ones
  /// too. Never given: nodes are held by what is left of their facets.
  std::span<const std::uint8_t> node_active = {};
};

/// Host arrays at t^n. Lengths #N of the host.
struct HostState {
  std::span<const Vec3> x;  ///< positions at t^n
  std::span<const Vec3> v;  ///< velocities at n - 1/2
  /// Nodal masses, 0 for a node that cannot move (clamped, imposed motion): first and last contact forces are predicted with them
  /// (and TYPE7 damps with them; a node of mass 0 with the mass of the pair). Empty: speeds count as constant over a step, which costs
  /// accuracy in CX only; TYPE7 does not damp, and refuses viscous friction.
  std::span<const double> mass;
  double time = 0.0;  ///< t^n
  /// h_-, the step that ended at t^n (0 in the first cycle). Left 0 it is the one committed last; the first step after restore() must
  /// say it (std::logic_error). Friction, first and last forces and the swept test are made with it.
  /// Steps may shrink as they like, but must not grow by more than 1.1 from one to the next: forces are foreseen that far.
  double dt = 0.0;
  /// (h_- + the one before)/2. First and last forces and accounts of pairs need it, as do reference impulses and incremental friction. Left
  /// 0 with dt: of the steps that were committed; left 0 beside a dt that is given: the step is constant.
  double dt_bar_old = 0.0;
  /// #N or empty: entry of `mobility` for nodes that are held or belong to a rigid body, no_index for those that move freely with
  /// their `mass`. Effective masses of pairs are made with it; the dampers of TYPE7 take `mass`.
  std::span<const Index> constrained = {};
  std::span<const Mobility> mobility = {};
};

/// #N is the number of the host's nodes: spans of #N may be longer than the interface needs, not shorter. set_surface()
/// and the three verbs leave the interface as it was when they throw std::invalid_argument or std::logic_error. One thread at a time;
/// different interfaces are independent. A moved-from interface may be assigned to or destroyed, nothing else.
class Interface {
 public:
  /// TYPE3: two passes; neither surface is main (T2, T10).
  /// @throws std::invalid_argument when a node lies on both (T6), or an option is out of its range (options.hpp)
  static Interface two_surfaces(Surface first, Surface second, const Options& options);
  /// TYPE5: the nodes are held against the surface, one pass. `node_stiffness` #nodes: their own stiffness
  /// (sum of a quarter per facet around them); used in series unless rules.one_pass_half_stiffness. Empty: half of the
  /// facet's stiffness is taken. Their order is the order of sums: sort them by key.
  /// @param nodes  #nodes host indices, each >= 0; they may lie on the surface
  /// @throws std::invalid_argument when a node is listed twice, node_stiffness is neither empty nor #nodes long or has a value that is
  ///         negative or not finite, or an option is out of its range (options.hpp)
  static Interface nodes_to_surface(std::vector<Index> nodes, std::vector<double> node_stiffness, Surface surface, const Options& options);

  /// TYPE7: every node-facet pair within the gap repels, on both sides. The surface is side 1.
  /// @param nodes  #nodes host indices, each >= 0 and listed once; they may lie on the surface
  /// @throws std::invalid_argument without a gap, with another option out of its range, with arrays that are not #nodes or #F long or
  ///         lack their partner
  static Interface both_sides(std::vector<Index> nodes, Surface surface, const BothSidesOptions& options);

  ~Interface();
  Interface(Interface&&) noexcept;
  Interface& operator=(Interface&&) noexcept;

  /// @param side 0 first, 1 second. Of nodes_to_surface and both_sides 1 is the surface and 0 the held nodes: stiffness and active
  ///        are then #nodes (an inactive node is let go), and so is thickness (automatic_gap; of both_sides with node_gap and
  ///        facet_gap: they become half of it).
  /// Of nodes_to_surface that was made without stiffness of nodes the facets' stiffness counts alone.
  /// Spans that are empty leave what was set before. May be called at any time; stiffness must have been given (0 is one) to all surfaces
  /// before the first search, of both_sides to what BothSidesOptions::stiffness takes.
  /// @throws std::invalid_argument on a side that is neither 0 nor 1, a wrong length, a negative or non-finite stiffness or thickness
  void set_surface(int side, const SurfaceState& state);

  /// Moves that take initial penetrations away, for the host to apply before its masses and reference geometry are made
  /// (numerics.md 7.2.5, 7.7.1: Inacti 3 and 4). Held nodes are moved, or with `move_surface` the nodes of the facets instead. One-sided
  /// interfaces treat their nodes one after the other, twice, each on what its predecessors left; a node moved several times
  /// appears once with the sum. Two-sided ones take the largest move of a node.
  /// @param x  #N by 3, positions; stiffness, activity and time window do not matter
  /// @return moves of host nodes, each node once; empty when nothing penetrates. The interface is as before.
  /// @throws std::invalid_argument when x is too short
  [[nodiscard]] std::vector<Projection> projections(std::span<const Vec3> x, bool move_surface) const;
  /// Loops over nodes run through `executor` from now on; without one, and those of both_sides, they run in the caller.
  void set_executor(Executor executor);

  /// contact::inspect() of what this interface knows of itself: its sides, the stiffness that set_surface() gave them, gap, stiffness
  /// scale and kind. Eroded facets are looked at like others. Any time, best before the first step; the interface is as before.
  /// @param host  x #N by 3; v #N by 3 or empty: at rest; mass #N or empty: not known, 0 for a node that cannot move. Times do not matter
  /// @param element_step  time: stable step without the interface; 0: not known
  /// @param outward  of both sides, see InspectedSide::outward: #F or empty
  /// @return findings, worst first; Finding::facets are positions in the surface as it was given, Finding::nodes host indices
  /// @throws std::invalid_argument when a span is too short, outward is neither empty nor #F long, element_step is negative or not
  ///         finite, or a limit is not a number
  [[nodiscard]] std::vector<Finding> inspect(const HostState& host, double element_step = 0.0,
                                             const std::array<std::span<const std::int8_t>, 2>& outward = {},
                                             const InspectionLimits& limits = {}) const;

  /// Once per step, before evaluate, with the same positions. Until commit() a step may be searched and evaluated again; of both_sides it
  /// may not.
  /// @pre positions and velocities are finite, masses are >= 0
  /// @throws std::invalid_argument when x, v or a mass that is not empty is too short for the interface's nodes, `constrained` names an
  ///         entry that does not exist, the time is not finite, or a step is negative or not finite; std::logic_error for a both_sides
  ///         interface whose last evaluate was not committed, without dt after restore(), and where nobody gave the stiffness of a side
  void search(const HostState& host);
  /// Once per step, after search: `commit` moves its results into the history.
  /// @param force     #N by 3: contact forces are added
  /// @param stiffness #N: contact stiffness is added (numerics.md 2.3 convention: h <= sqrt(2 m / K))
  /// Forces are those of search()'s positions: a few nodes are compared, so that other ones do not pass for them.
  /// @throws std::logic_error without a search in this step and where one of these has moved since, std::invalid_argument as search()
  ///         and when a span is too short
  StepResult evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness);
  /// Sets to zero what the last evaluate() added to (of both_sides: at all of its nodes), for hosts that keep forces and stiffness of
  /// contact apart and would else clear all of their arrays in every step. After restore() it knows of nothing.
  /// @param force, stiffness  those of that evaluate()
  /// @throws std::invalid_argument when one is too short
  void clear(std::span<Vec3> force, std::span<double> stiffness) const;
  /// @param dt  h_+, the step that the host takes now
  /// The next step takes it where HostState::dt is left 0.
  /// @throws std::logic_error without an evaluate in this step, std::invalid_argument when dt is negative or not finite
  void commit(double dt);

  /// Normal and tangential contact force of the last evaluate() on host nodes are added (output).
  /// @param normal, tangential  #N by 3, forces
  /// @throws std::invalid_argument when one is too short
  void add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const;
  /// Adds the tributary area of the nodes of its surfaces: a quarter (third) of each facet around them.
  /// @param x     #N by 3, positions
  /// @param area  #N, length^2
  /// @throws std::invalid_argument when one is too short
  void add_nodal_area(std::span<const Vec3> x, std::span<double> area) const;
  /// Merges what this interface knows of its held nodes into #N values: the smallest opening, the deepest penetration, the larger state.
  /// At the positions of the last search(). Nothing is merged unless it acted in the last evaluate() and no restore() came after that.
  /// @param nodes  #N
  /// @throws std::invalid_argument when it is too short
  void add_nodal_contact(std::span<NodalContact> nodes) const;
  /// Held nodes in contact in the last evaluate (host indices, each once, empty before the first): boundary-condition release (IBC) asks
  /// for it. This span and the next two are valid until the next evaluate(), restore() or the interface's end or move.
  [[nodiscard]] std::span<const Index> nodes_in_contact() const;
  /// Held nodes of StepResult::crossed and StepResult::lost in the last evaluate (host indices). Empty for both_sides.
  [[nodiscard]] std::span<const Index> nodes_crossed() const;
  [[nodiscard]] std::span<const Index> nodes_lost() const;

  /// Explicit history (friction anchors, held pairs, energies, previous forces): a host can checkpoint it between commit and search.
  /// With what set_surface() was given it is all that an interface made anew needs to go on with the same bits.
  [[nodiscard]] std::vector<std::byte> history() const;
  /// @post the next verb is search(), with HostState::dt
  /// @throws std::invalid_argument, naming which, on a blob that is damaged, of another version of the library or of another interface
  void restore(std::span<const std::byte> history);

  /// From now on every input is written to `log`, see abut/contact/call_log.hpp. Results do not change by it.
  /// @param log    opened in binary mode; must live until stop_recording() or the interface's end
  /// @param label  what the host wants to find in the log: its name, version, job
  /// It takes the place of a recording that goes on. @throws std::runtime_error here and in later calls when the log cannot be written
  void record(std::ostream& log, std::string_view label = {});
  void stop_recording();  ///< nothing is written any more; nothing when there is no recording

 private:
  struct Made;
  explicit Interface(Made made);
  std::unique_ptr<Made> made_;
};

}  // namespace abut::contact
