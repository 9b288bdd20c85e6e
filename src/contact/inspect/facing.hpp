// The facing rule (docs/findings/index.md): what each facet sees of the other side.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/inspect/shape.hpp"

namespace abut::contact {

/// Answers per facet of one side.
struct Views {
  Facing facing;
  std::vector<std::uint8_t> overlaps;  ///< #F: the other side lies inside the body behind the facet, near its face
  std::vector<std::uint8_t> alike;     ///< #F: touches a facet of the other side whose normal points the same way
  double away_distance = 0.0;          ///< largest distance of a facet that faces away to what it faces away from
};

struct BothViews {
  std::array<Views, 2> side;
  double reach = 0.0;       ///< distance within which facets count as near
  double smallest = 1e300;  ///< smallest distance of a facet's centre (a node) to the other side

  /// Gives away what facing() says of both sides.
  [[nodiscard]] std::array<Facing, 2> take_facing();
};

/// @throws std::invalid_argument when the gap, the stiffness scale or the element step is negative or not finite
void check(const InspectionInput& input);

[[nodiscard]] BothViews look(const std::array<Shape, 2>& shapes, double gap);
/// Where facets repel on both sides: only the reach and the smallest distance of a node of side 0 to the facets that it is no corner of.
[[nodiscard]] BothViews look_unsigned(const std::array<Shape, 2>& shapes, std::span<const Vec3> x, double gap);

/// Net answer of a piece in one of its two orientations, by area; without facets that see the other side behind them but look out of their
/// solid.
struct PieceVote {
  double facing = 0.0, away = 0.0;   ///< as the facets are
  double score = 0.0, weight = 0.0;  ///< with all facets turned to the orientation of the piece's first facet
};
/// #pieces by 2 (orientation within the piece): `facing`, `away`; score and weight are in [0] for the whole piece.
[[nodiscard]] std::vector<std::array<PieceVote, 2>> piece_votes(const Shape& shape, const Facing& facing);

}  // namespace abut::contact
