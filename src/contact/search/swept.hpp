// Did a node cross a facet from front to back within one step? All five points move on straight lines.
//
// A quadrilateral is tested as its two pairs of triangles (both diagonals): the bilinear facet lies between the two, so a node
// that was in front of it and is behind it has crossed at least one pair. Coplanarity of node and triangle is a cubic in the
// time; its monotone pieces are bracketed by the roots of its derivative and halved to rounding [Bridson et al. 2002].
#pragma once

#include "contact/project/closest_point.hpp"

namespace abut::contact {

struct Crossing {
  bool crossed = false;
  double fraction = 1.0;  ///< of the step, 0 to 1
};

/// @param before, after  facet and node at both ends of the step
[[nodiscard]] Crossing crosses(const Patch& before, const Vec3& x_before, const Patch& after, const Vec3& x_after);

}  // namespace abut::contact
