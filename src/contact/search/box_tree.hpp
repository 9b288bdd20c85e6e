// Bounding-box tree over facets or points: build O(N log N), query by a box. Results never depend on its shape: it only
// leaves out what a box test excludes, and callers take minima with ties broken by index.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::contact {

struct Bounds {
  Vec3 low{1e300, 1e300, 1e300};
  Vec3 high{-1e300, -1e300, -1e300};

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void include(const Bounds& b) {
    include(b.low);
    include(b.high);
  }
  void inflate(double by) {
    low -= Vec3{by, by, by};
    high += Vec3{by, by, by};
  }
  [[nodiscard]] bool meets(const Bounds& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z && b.low.z <= high.z;
  }
};

/// Squared distance of a point to a box; 0 inside.
[[nodiscard]] inline double squared_distance(const Bounds& box, const Vec3& p) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({0.0, box.low[k] - p[k], p[k] - box.high[k]});
    sum += d * d;
  }
  return sum;
}

/// Bounds in single precision, rounded outwards: half of the memory, and what they leave out lies outside of the true ones too.
class CoarseBounds {
 public:
  CoarseBounds() = default;
  explicit CoarseBounds(const Bounds& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = below(b.low[static_cast<int>(k)]);
      high_[k] = -below(-b.high[static_cast<int>(k)]);
    }
  }
  void include(const CoarseBounds& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = std::min(low_[k], b.low_[k]);
      high_[k] = std::max(high_[k], b.high_[k]);
    }
  }
  [[nodiscard]] bool meets(const CoarseBounds& b) const {
    return low_[0] <= b.high_[0] && b.low_[0] <= high_[0] && low_[1] <= b.high_[1] && b.low_[1] <= high_[1] && low_[2] <= b.high_[2] &&
           b.low_[2] <= high_[2];
  }
  [[nodiscard]] Bounds bounds() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }

 private:
  static constexpr float largest = std::numeric_limits<float>::max();
  std::array<float, 3> low_{largest, largest, largest}, high_{-largest, -largest, -largest};

  /// A float that is not above d. Rounding moves d by at most 2^-24 of its size, or half of the least float.
  static float below(double d) {
    const auto f = static_cast<float>(std::clamp(d, -3e38, 3e38));
    return f - (1.2e-7F * std::abs(f) + std::numeric_limits<float>::min());
  }
};

class BoxTree {
 public:
  /// How many boxes there are, and box i, to be set before update().
  void resize(std::size_t count) { boxes_.resize(count); }
  void set(Index i, const Bounds& box) { boxes_[static_cast<std::size_t>(i)] = CoarseBounds(box); }
  /// Frees the boxes until resize(): query() then visits all of a leaf that meets.
  void forget_boxes() { std::vector<CoarseBounds>().swap(boxes_); }
  /// @pre not forgotten
  [[nodiscard]] bool meets(Index i, const CoarseBounds& query) const { return boxes_[static_cast<std::size_t>(i)].meets(query); }
  /// Box i or a little more. @pre not forgotten
  [[nodiscard]] Bounds box(Index i) const { return boxes_[static_cast<std::size_t>(i)].bounds(); }
  /// Makes the tree of the boxes: median splits along the widest side, leaves of at most sixteen boxes. Where the boxes of the last time
  /// have only moved, its nodes get new bounds, as long as these are not much larger.
  void update();

  /// Calls visit(i) for every box i that meets `query`, and perhaps for some that come as near to it as rounding (or, with boxes forgotten,
  /// as near as others of their leaf).
  template <class Visit>
  void query(const Bounds& query, Visit&& visit) const {
    if (nodes_.empty()) return;
    const CoarseBounds coarse(query);
    Index stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
      if (!node.bounds.meets(coarse)) continue;
      if (node.count > 0) {
        for (Index k = node.first; k < node.first + node.count; ++k) {
          const Index box = items_[static_cast<std::size_t>(k)];
          if (boxes_.empty() || boxes_[static_cast<std::size_t>(box)].meets(coarse)) visit(box);
        }
      } else {
        stack[depth++] = node.first;
        stack[depth++] = node.second;
      }
    }
  }

 private:
  struct Node {
    CoarseBounds bounds;
    Index first = 0;   ///< leaf: first item; else: a child
    Index second = 0;  ///< the other child
    Index count = 0;   ///< leaf: items
  };
  std::vector<Node> nodes_;
  std::vector<Index> items_;
  std::vector<CoarseBounds> boxes_;
  double size_ = 0.0;  ///< sum of the nodes' surfaces when they were last split

  Index split(Index first, Index last);
  /// Gives the nodes new bounds. @return sum of their surfaces
  double refit();
};

}  // namespace abut::contact
