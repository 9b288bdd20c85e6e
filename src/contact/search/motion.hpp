// How far two sides have moved since lists between them were made or renewed.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "abut/vec3.hpp"

namespace abut::contact {

/// Motion of one step: what all of a surface does together does not change a distance to it.
struct Motion {
  Vec3 mean;             ///< of the surface's nodes
  double held = 0.0;     ///< largest |dx - mean| of a held node
  double surface = 0.0;  ///< the same of a surface node

  /// Upper bound of the change of any node-to-facet distance.
  // Strips extrapolate their corners' motion by weights of 1.4 in sum of magnitudes, beyond two borders 1.4 x 1.4. What all corners of a
  // facet do together is not extrapolated; 1.5 leaves out the rest, as for the wider strips of held nodes (Truth.*: no difference was
  // found).
  [[nodiscard]] double change() const { return held + 1.5 * surface; }
};

/// Sum of x - before.
[[nodiscard]] inline Vec3 sum_of_motions(std::span<const Vec3> x, std::span<const Vec3> before) {
  Vec3 sum{};
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] - before[i];
  return sum;
}

/// Largest |x - before - a|^2 and |x - before - b|^2.
struct TwoLargest {
  double from_a = 0.0, from_b = 0.0;
};
[[nodiscard]] inline TwoLargest largest_motion(std::span<const Vec3> x, std::span<const Vec3> before, const Vec3& a, const Vec3& b) {
  TwoLargest largest;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 d = x[i] - before[i];
    largest.from_a = std::max(largest.from_a, squared_norm(d - a));
    largest.from_b = std::max(largest.from_b, squared_norm(d - b));
  }
  return largest;
}

/// Motion of nodes and surface since `held_before` and `surface_before`.
[[nodiscard]] inline Motion motion_between(std::span<const Vec3> held, std::span<const Vec3> held_before, std::span<const Vec3> surface,
                                           std::span<const Vec3> surface_before) {
  const Vec3 mean = surface.empty() ? Vec3{} : sum_of_motions(surface, surface_before) / static_cast<double>(surface.size());
  return {mean, std::sqrt(largest_motion(held, held_before, mean, mean).from_a),
          std::sqrt(largest_motion(surface, surface_before, mean, mean).from_a)};
}

}  // namespace abut::contact
