// Axes of a skew at t^n (numerics.md 6.6.2), for output in skews.
#pragma once

#include <array>
#include <span>

#include "abut/vec3.hpp"
#include "model/model.hpp"

namespace abut::output {

/// Unit axes of a fixed skew, or of one that follows three nodes: the first axis (`direction`) along N1 N2, the next one
/// (cyclic) in the plane of N1 N2 N3.
/// @param x  #N by 3, positions at t^n
[[nodiscard]] inline std::array<Vec3, 3> skew_axes(const model::Skew& skew, std::span<const Vec3> x) {
  if (skew.nodes[0] == no_index) return skew.axes;
  const Vec3 origin = x[static_cast<std::size_t>(skew.nodes[0])];
  const Vec3 first = normalized(x[static_cast<std::size_t>(skew.nodes[1])] - origin);
  const Vec3 third = normalized(cross(first, x[static_cast<std::size_t>(skew.nodes[2])] - origin));
  const auto d = static_cast<std::size_t>(skew.direction);
  std::array<Vec3, 3> axes;
  axes[d] = first;
  axes[(d + 1) % 3] = cross(third, first);
  axes[(d + 2) % 3] = third;
  return axes;
}

/// Components of a vector along axes.
[[nodiscard]] inline Vec3 components(const Vec3& v, const std::array<Vec3, 3>& axes) {
  return {dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])};
}

}  // namespace abut::output
