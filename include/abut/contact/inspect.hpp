// The inspection of an interface before the first step (and of its geometry at any time): typed findings.
//
// docs/findings/index.md has a section with a picture for every code. Nothing here throws for bad geometry: bad geometry is
// what it looks for. Lengths, stiffnesses and masses are in the host's consistent units.
//
// The one precondition, of all functions that take an InspectionInput: every node index of its sides lies in 0 ... #N - 1, x has finite
// #N positions, and a span that is not empty has the length written beside it. It is not checked: Interface::inspect() and Python do.
// All of them throw std::invalid_argument when gap, stiffness_scale or element_step is negative or not finite.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abut/contact/both_sides.hpp"
#include "abut/contact/surface.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::contact {

enum class Severity : std::uint8_t { note, warning, error };

/// One bar of a histogram: `count` items with low <= value < high.
struct Bar {
  double low = 0.0, high = 0.0;
  Index count = 0;
};

/// One thing that the inspection found. `code` is stable; it is the anchor of its section in docs/findings/index.md.
struct Finding {
  Severity severity = Severity::note;
  std::string code;           ///< e.g. "contact.normals_away"
  int side = -1;              ///< 0 first, 1 second surface; -1: the interface
  std::vector<Index> facets;  ///< positions in the side's list of facets, ascending
  std::vector<Index> nodes;   ///< host nodes, ascending
  std::string measure_name;   ///< what `measure` is, e.g. "facing fraction"
  double measure = 0.0;
  std::string what;    ///< one sentence: what was found, without ids
  std::string advice;  ///< one sentence: what to do
  std::vector<Bar> histogram;
};

/// One side of an interface as the host lists it. Nothing is checked beforehand.
struct InspectedSide {
  std::span<const Facet> facets;      ///< #F; empty: a set of nodes
  std::span<const Index> nodes;       ///< a set of nodes (host indices); used when facets is empty
  std::span<const double> stiffness;  ///< own stiffness, #F (E t, B A^2/V) or, for a set of nodes, #nodes; empty: not known
  /// #F, +1: the normal points out of the solid behind the facet, -1: into it, 0: a shell or not known. Empty: not known.
  std::span<const std::int8_t> outward;
  /// For a set of nodes, #nodes: size of the faces of the mesh around the node (a length); 0 where there are none. Empty: not known.
  std::span<const double> size = {};
};

/// #N is the number of the host's nodes; spans live as long as the call.
struct InspectionInput {
  std::array<InspectedSide, 2> side;
  bool both_sides = false;  ///< facets of side 1 repel nodes of side 0 on both sides (TYPE7): normals do not matter
  /// Of a both-sided interface: gap and stiffness of pairs, with arrays for the nodes and facets as listed here. Null: `gap`, and the
  /// facet's stiffness.
  const BothSidesOptions* pairs = nullptr;
  bool one_pass = false;         ///< only the nodes of side 0 are held (TYPE5; always so with both_sides)
  double stiffness_scale = 0.2;  ///< s (T14)
  double gap = 0.0;              ///< length; with `pairs` the largest of any pair
  std::span<const Vec3> x;       ///< #N by 3 positions
  std::span<const Vec3> v;       ///< #N by 3 velocities; empty: at rest
  std::span<const double> mass;  ///< #N nodal masses; empty: not known
  double element_step = 0.0;     ///< stable step without the interface; 0: not known
};

/// Beyond these the inspection speaks; std::invalid_argument for one that is not a number.
struct InspectionLimits {
  double aspect_ratio = 5.0;       ///< longest over shortest side (T7)
  double warp_degrees = 15.0;      ///< angle between the two triangles of a quadrilateral (T7)
  double size_ratio = 4.0;         ///< mean facet size of one side over that of the other, where they are near (T7)
  double stiffness_ratio = 10.0;   ///< K1/K2 (T15)
  double concave_degrees = 10.0;   ///< inward fold (T4)
  double gap_of_size = 0.5;        ///< gap over the smallest facet size (T30)
  double steps_through_gap = 5.0;  ///< steps that the fastest approach takes through the gap (T29)
};

/// Does each facet look at the other side? The rule is in docs/findings/index.md ("The facing rule").
struct Facing {
  std::vector<std::int8_t> facet;  ///< #F: +1 faces, -1 faces away, 0 nothing near, undecided or an overlap of solids
  double area_facing = 0.0, area_away = 0.0;
  double distance =
      std::numeric_limits<double>::infinity();  ///< smallest distance of the centre of a facet (a held node) to the other side
  /// Share of the decided area that faces; NaN when nothing is decided.
  [[nodiscard]] double fraction() const {
    const double decided = area_facing + area_away;
    return decided > 0.0 ? area_facing / decided : std::numeric_limits<double>::quiet_NaN();
  }
};
/// Both sides; a side without facets has an empty answer. O(F log F).
/// @pre indices lie inside x, see the head of this file; velocities, masses and stiffnesses are not looked at
[[nodiscard]] std::array<Facing, 2> facing(const InspectionInput& input);

/// Everything that can be said before the first step, worst first; findings of one severity in the order of the documentation.
/// A host that has an Interface asks Interface::inspect().
/// @param facing  not null: facing() of the input too, which is found on the way (not with both_sides)
/// @pre indices lie inside x, see the head of this file
[[nodiscard]] std::vector<Finding> inspect(const InspectionInput& input, const InspectionLimits& limits = {},
                                           std::array<Facing, 2>* facing = nullptr);

/// facing() of the same facets and nodes again and again, as they move: how they connect is found in the first look.
class FacingWatch {
 public:
  FacingWatch();
  ~FacingWatch();
  FacingWatch(FacingWatch&&) noexcept;
  FacingWatch& operator=(FacingWatch&&) noexcept;

  /// @pre facets, and nodes of a set, are those of the first look
  [[nodiscard]] std::array<Facing, 2> look(const InspectionInput& input);

 private:
  struct Known;
  std::unique_ptr<Known> known_;
};

/// Which facets to reverse so that each side is oriented alike and faces the other.
struct Orientation {
  std::array<std::vector<Index>, 2> flip;  ///< facets to reverse, ascending
  std::array<bool, 2> ambiguous{};         ///< some piece of this side has no clear answer; it is left as it is
};
/// @pre indices lie inside x, see the head of this file; velocities, masses and stiffnesses are not looked at
/// @post with the facets of `flip` replaced by reversed(), orient() has nothing more to flip
[[nodiscard]] Orientation orient(const InspectionInput& input);

/// The facet with its normal turned: the same nodes, a triangle stays a triangle.
[[nodiscard]] inline Facet reversed(const Facet& f) {
  return f.is_triangle() ? Facet{{f.node[1], f.node[0], f.node[2], f.node[2]}} : Facet{{f.node[3], f.node[2], f.node[1], f.node[0]}};
}

/// Every code that inspect() can give, in the order of the documentation; valid for the whole program.
[[nodiscard]] std::span<const std::string_view> inspection_codes();

}  // namespace abut::contact
