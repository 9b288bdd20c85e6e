// Closest point on one facet whose free borders are extended by a taper strip.
//
// Facet: bilinear X(s,t) = sum H_i x_i (numerics.md 7.3.6) or a plane triangle (s, t: its second and third barycentric
// coordinate). A side that is a free border of the surface is extended by a strip of a fifth of the facet's length, along
// the same bilinear (or plane) form. Over the first half of it the taper T stays 1: a fall from the border on pushes
// facing borders off each other (its lateral stiffness is -4 phi per width^2), which ends the contact of two bars that meet
// edge to edge under load. Over the rest T falls from 1 to 0 as (1 - u^2)^2, u the share of the rest. Contact that slides over
// a free border so ends continuously, and moments stay balanced (weights extrapolate).
// The bilinear form folds over where its sides converge (an obtuse corner on a border, a slender trapezoid): strips end before that
// (fit_strips()), and where less than a quarter of one would be left, T falls to nothing at the border itself.
//
// Bilinear: projected Newton on |x - X|^2 over the box of (s,t), active set at its bounds, Gauss-Newton where the Hessian is
// not positive, halved steps until the distance falls: descends from every start, so it always ends in a minimum; a second set
// of starts (the corners) serves warped facets seen from far, where the minimum need not be unique.
// Triangle: Ericson, Real-Time Collision Detection (2005), 5.1.5.
#pragma once

#include <array>
#include <cstdint>

#include "abut/vec3.hpp"

namespace abut::contact {

/// Fraction of a side's length by which a free border is extended.
inline constexpr double border_strip = 0.2;
/// Fraction of the strip over which the taper stays 1.
inline constexpr double border_flat = 0.5;
/// Strips of a pair that was entered through the front widen with its depth behind the facet, at most by this fraction of a side.
inline constexpr double border_widening = 0.8;

/// Corners and the sides that are free borders.
struct Patch {
  std::array<Vec3, 4> x;
  bool triangle = false;
  std::uint8_t borders = 0;     ///< bit e: side e (corner e to e + 1) is a free border
  double strip = border_strip;  ///< where points are looked for beyond them
  double narrow = 1.0;          ///< share that is left of strips of the usual width,
  double widens = 1.0;          ///< and of what they widen by
  static constexpr double too_narrow = 0.25;
};

/// Makes the strips of a quadrilateral so narrow that the area over its sides nowhere falls below a quarter of that at the border's corner.
void fit_strips(Patch& patch);

enum class Feature : std::uint8_t { face, edge, corner };

struct ClosestPoint {
  Feature feature = Feature::face;
  std::uint8_t number = 0;  ///< edge or corner number
  bool beyond = false;      ///< at the outer end of a strip (or past it): no contact
  double s = 0.0, t = 0.0;
  double squared_distance = 0.0;
  Vec3 point;
  std::array<double, 4> weight{};  ///< H_i, sum 1
};

/// The mean plane of a facet without strips, moved up to its highest corner.
struct MeanPlane {
  Vec3 normal, center;
  double top = 0.0;  ///< of the highest corner over the center
  /// x in front of the facet, which lies within the hull of its corners, is at least this far from it.
  [[nodiscard]] double height(const Vec3& x) const { return dot(normal, x - center) - top; }
};
[[nodiscard]] MeanPlane mean_plane(const Patch& patch);

/// A lower bound of the distance from x to `patch` (with its strips), at a sixth of the cost of the closest point: x and the facet lie on
/// both sides of a plane that is this far from x. Exact where the closest point of a parallelogram is; 0 for triangles.
[[nodiscard]] double distance_at_least(const Patch& patch, const Vec3& x);

/// Closest point of `patch` (with its strips) to x.
[[nodiscard]] ClosestPoint closest_point(const Patch& patch, const Vec3& x);

/// Weights H_i at (s, t).
[[nodiscard]] std::array<double, 4> shape(bool triangle, double s, double t);
/// dH_i/ds, dH_i/dt at (s, t).
[[nodiscard]] std::array<std::array<double, 4>, 2> shape_gradient(bool triangle, double s, double t);
/// Position, and the two tangents dX/ds, dX/dt, at (s, t).
[[nodiscard]] Vec3 position(const Patch& patch, double s, double t);
[[nodiscard]] std::array<Vec3, 2> tangents(const Patch& patch, double s, double t);
/// Unit normal at (s, t); zero where the facet is degenerate.
[[nodiscard]] Vec3 normal_at(const Patch& patch, double s, double t);

/// Taper T(s, t; wider) and its gradient: 1 on the facet, falling to 0 over the strips.
struct Taper {
  double value = 1.0;
  double ds = 0.0, dt = 0.0;
  double dw = 0.0;
};
/// @param wider  >= 0: the flat part of the strips, and with it their end, lies further out by this fraction of a side
[[nodiscard]] Taper taper(const Patch& patch, double s, double t, double wider = 0.0);

/// Convergence of the projection in (s, t): |Newton step| below this.
inline constexpr double projection_tolerance = 1e-13;

}  // namespace abut::contact
