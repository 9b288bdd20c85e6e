// What a pass sees of the other side at one moment, and what the two sides are where they are near each other.
#pragma once

#include <optional>
#include <vector>

#include "contact/inspect/findings.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

/// A node measured against the other side.
struct Seen {
  Index node, facet;
  double distance;  // signed; where facets repel on both sides >= 0
  double closing;   // speed of approach, > 0 when the distance shrinks
  double gap;
  std::size_t place;  // of the node in the shape's nodes()
};

/// Everything that pass `k` (nodes of side k against the facets of the other one) sees within reach.
struct PassView {
  std::vector<Seen> seen;
  std::vector<Index> blind;
};

/// @param k  the pass: nodes of side k against the facets of the other one, `surface`
[[nodiscard]] PassView view_of(const InspectionContext& c, std::size_t k, const Side& surface);

/// Own stiffness of the nodes of a side: a quarter (third) of each facet around them, or as given for a set of nodes; by position in
/// nodes(). Empty: not known.
[[nodiscard]] std::vector<double> node_stiffness(const Shape& s);

/// Means over the part of a side that is near the other one; 0: not known.
struct NearPart {
  double size = 0.0, stiffness = 0.0;
  double smallest = 1e300;  ///< facet (its shortest side where facets repel on both sides: the theory's measure for that gap)
};

/// @param own      what the side's own nodes see: the facets around them are near
/// @param seen_by  what the other side's nodes see of its facets
[[nodiscard]] NearPart near_facets(const Shape& s, bool both_sides, const std::optional<PassView>& own,
                                   const std::optional<PassView>& seen_by);
/// The same of a set of nodes.
[[nodiscard]] NearPart near_nodes(const Shape& s, const PassView& own);

}  // namespace abut::contact
