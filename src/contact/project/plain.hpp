// The plain rule's projection: one normal per facet, hard tolerance beyond its edges (numerics.md 7.3.4 to 7.3.6).
#pragma once

#include <array>

#include "contact/project/closest_point.hpp"

namespace abut::contact {

struct PlainPoint {
  bool inside = false;              ///< |s|, |t| <= 1 + tolerance
  double raw_s = 0.0, raw_t = 0.0;  ///< before clipping
  double s = 0.0, t = 0.0;          ///< clipped to [-1, 1]
  std::array<double, 4> weight{};   ///< H_i
  Vec3 point;                       ///< sum H_i x_i
  Vec3 normal;                      ///< of the facet
  double area = 0.0;                ///< of the facet in projection
  double distance = 0.0;            ///< n.(x - point)
};

/// @param area_ratios  closed form by areas (exact for parallelograms); false: Newton on the bilinear facet
/// Triangles repeat their third corner: patch.x[3] == patch.x[2].
[[nodiscard]] PlainPoint project_plain(const Patch& patch, const Vec3& x, double gap, bool area_ratios);

/// Edge tolerance clip(2 |gap| / sqrt(A), 0.05, 0.2) in s and t.
[[nodiscard]] double edge_tolerance(double gap, double area);

}  // namespace abut::contact
