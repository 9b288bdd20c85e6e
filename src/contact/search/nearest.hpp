// The truth about one node: the closest point of the one-sided surface (docs/theory/contact.md, "Who touches").
#pragma once

#include "contact/search/candidates.hpp"

namespace abut::contact {

/// Relative difference of distances that count as the same.
inline constexpr double equally_near = 1e-8;

/// A node measured against a surface.
struct Measure {
  Index facet = no_index;
  ClosestPoint closest;
  Vec3 normal;            ///< unit, along which the contact pushes the node
  double distance = 0.0;  ///< signed: > 0 in front
  [[nodiscard]] bool found() const { return facet != no_index; }
};

/// Gives the closest point on facet f its sign and direction.
[[nodiscard]] Measure signed_measure(const Side& surface, Index f, const ClosestPoint& closest, const Vec3& x);

/// What a held node remembers.
struct HeldBy {
  Index facet = no_index;  ///< no_index: a free node
  Vec3 normal;
  double strip = border_strip;  ///< where it looks beyond free borders
};

/// Free node: the smallest |distance| among the candidates. Held node: the smallest |distance| among facets that push in
/// about the same direction (n . n_held > -1/2), or any facet it is in front of while it is in front of its own: it is so
/// never handed to the far side of a thin body.
/// Distances that it measures go back into the node's list.
[[nodiscard]] Measure nearest(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held);

/// No listed facet but the one that holds the node comes within `distance` of it, by bounds that go back into its list. False where bounds
/// do not tell, or where that facet is not listed.
[[nodiscard]] bool none_within(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held, double distance);

/// It pushes in about the direction of `normal`.
[[nodiscard]] inline bool pushes_alike(const Measure& m, const Vec3& normal) { return dot(m.normal, normal) > -0.5; }

/// Facet f extended beyond its free borders by `strip` of a side.
[[nodiscard]] inline Patch extended(const Side& surface, Index f, double strip) {
  Patch patch = surface.patch(f);
  patch.strip = strip;
  return patch;
}

}  // namespace abut::contact
