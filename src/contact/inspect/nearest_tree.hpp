// Nearest-first search over boxes and slabs: no radius has to be known beforehand. A node's slab holds its items between two planes across
// their mean normal. Along that normal it is second order in the node's size where a box is first order: facets that are about equally far
// from a point, as a sphere's around a body in its middle, would else all have to be looked at.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "contact/search/box_tree.hpp"

namespace abut::contact {

class NearestTree {
 public:
  /// @param items  `normal(item)`: unit or zero; `corners(item, take)`: calls take(point) for every corner
  template <class Items>
  void build(std::span<const CoarseBounds> boxes, const Items& items) {
    items_.resize(boxes.size());
    std::iota(items_.begin(), items_.end(), 0);
    nodes_.clear();
    if (!boxes.empty()) split(boxes, 0, count());
    nodes_.shrink_to_fit();
    if (!nodes_.empty()) fit(0, 0, count(), boxes, items);
  }

  /// Frees what refit() makes again.
  void forget_bounds() { std::vector<Node>().swap(nodes_); }

  /// The same items elsewhere: the same tree with other bounds.
  template <class Items>
  void refit(std::span<const CoarseBounds> boxes, const Items& items) {
    if (nodes_.empty() && !items_.empty()) join(0, count());
    if (!nodes_.empty()) fit(0, 0, count(), boxes, items);
  }

  /// Visits items until none can be nearer than sqrt(limit); `visit(item, limit)` lowers the limit when it finds something nearer.
  template <class Visit>
  void search(const Vec3& from, double limit, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, from, limit, visit);
  }

  /// Visits items whose leaf may meet the segment from a to b until `visit(item)` says true. @return whether it did
  template <class Visit>
  bool any(const Vec3& a, const Vec3& b, Visit&& visit) const {
    return !nodes_.empty() && any_below(0, Segment(a, b), visit);
  }

 private:
  struct Node {
    CoarseBounds bounds;
    Vec3 normal;                                 // of the disc; zero: none
    double low = 0.0, high = 0.0, radius = 0.0;  // along the normal, and across it, from the middle of the bounds
    Index first = 0, second = 0, count = 0;      // leaf (count > 0): first item; else two children
  };
  struct Segment {
    Segment(const Vec3& a, const Vec3& b) : middle(0.5 * (a + b)), half(0.5 * (b - a)) {
      Bounds around;
      around.include(a);
      around.include(b);
      box = CoarseBounds(around);
    }
    CoarseBounds box;
    Vec3 middle, half;
  };
  static constexpr Index leaf = 4;       // items, at most
  static constexpr double slack = 1e-9;  // of lengths: far above rounding
  std::vector<Node> nodes_;
  std::vector<Index> items_;

  [[nodiscard]] Index count() const { return static_cast<Index>(items_.size()); }
  [[nodiscard]] Index item(Index k) const { return items_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] static Vec3 middle_of(const CoarseBounds& box) { return 0.5 * (box.bounds().low + box.bounds().high); }

  Index split(std::span<const CoarseBounds> boxes, Index first, Index last) {
    const auto number = static_cast<Index>(nodes_.size());
    nodes_.emplace_back();
    Node node;
    Bounds centres;
    const auto centre = [boxes](Index i) { return middle_of(boxes[static_cast<std::size_t>(i)]); };
    for (Index k = first; k < last; ++k) centres.include(centre(item(k)));
    if (last - first <= leaf) {
      node.first = first;
      node.count = last - first;
    } else {
      const Vec3 width = centres.high - centres.low;
      const int axis = width.x >= width.y && width.x >= width.z ? 0 : width.y >= width.z ? 1 : 2;
      const Index middle = first + (last - first) / 2;
      std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last, [&](Index a, Index b) {
        const double ca = centre(a)[axis], cb = centre(b)[axis];
        return ca < cb || (ca == cb && a < b);
      });
      node.first = split(boxes, first, middle);
      node.second = split(boxes, middle, last);
    }
    nodes_[static_cast<std::size_t>(number)] = node;
    return number;
  }

  /// The nodes of split() over items that it has ordered.
  Index join(Index first, Index last) {
    const auto number = static_cast<Index>(nodes_.size());
    nodes_.emplace_back();
    Node node;
    if (last - first <= leaf) {
      node.first = first;
      node.count = last - first;
    } else {
      const Index middle = first + (last - first) / 2;
      node.first = join(first, middle);
      node.second = join(middle, last);
    }
    nodes_[static_cast<std::size_t>(number)] = node;
    return number;
  }

  /// Bounds and discs of a node of the items [first, last) and of all below it.
  template <class Items>
  void fit(Index number, Index first, Index last, std::span<const CoarseBounds> boxes, const Items& items) {
    Node& node = nodes_[static_cast<std::size_t>(number)];
    node.bounds = CoarseBounds();
    if (node.count > 0) {
      for (Index k = first; k < last; ++k) node.bounds.include(boxes[static_cast<std::size_t>(item(k))]);
    } else {
      const Index between = first + (last - first) / 2;
      fit(node.first, first, between, boxes, items);
      fit(node.second, between, last, boxes, items);
      node.bounds.include(nodes_[static_cast<std::size_t>(node.first)].bounds);
      node.bounds.include(nodes_[static_cast<std::size_t>(node.second)].bounds);
    }
    Vec3 sum;
    for (Index k = first; k < last; ++k) {
      const Vec3 n = items.normal(item(k));
      sum += dot(n, sum) < 0.0 ? -1.0 * n : n;
    }
    const double length = norm(sum);
    node.normal = length > 0.0 ? sum / length : Vec3{};
    node.low = 1e300;
    node.high = -1e300;
    double across = 0.0;
    const Vec3 from = middle_of(node.bounds);
    for (Index k = first; k < last && length > 0.0; ++k) {
      items.corners(item(k), [&](const Vec3& corner) {
        const double along = dot(node.normal, corner - from);
        node.low = std::min(node.low, along);
        node.high = std::max(node.high, along);
        across = std::max(across, squared_norm(corner - from - along * node.normal));
      });
    }
    node.radius = std::sqrt(across);
  }

  /// At most the squared distance of a point to any item of the node; not looked at closer when it is above the limit.
  [[nodiscard]] static double squared_least(const Node& node, const Vec3& from, double limit) {
    const double to_box = squared_distance(node.bounds.bounds(), from);
    if (to_box > limit || squared_norm(node.normal) == 0.0) return to_box;
    const auto sum = [](const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
    const Vec3 d = from - middle_of(node.bounds);
    const double along = dot(node.normal, d);
    const double rounding = slack * (sum(from) + sum(d) + node.radius);
    const double to_plane = std::max(0.0, std::max(node.low - along, along - node.high) - rounding);
    const double across = squared_norm(d - along * node.normal);
    const double rim = node.radius + rounding;
    const double to_rim = across > rim * rim ? std::sqrt(across) - rim : 0.0;
    return std::max(to_box, to_plane * to_plane + to_rim * to_rim);
  }

  /// Separating axes of a segment and a box [Ericson 2005, 5.3.3].
  [[nodiscard]] static bool meets(const CoarseBounds& bounds, const Segment& s) {
    if (!bounds.meets(s.box)) return false;
    const Bounds box = bounds.bounds();
    const Vec3 size = 0.5 * (box.high - box.low);
    const Vec3 t = s.middle - middle_of(bounds);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double room = size[i] * std::abs(s.half[j]) + size[j] * std::abs(s.half[i]);
      const double rounding = slack * (std::abs(t[i] * s.half[j]) + std::abs(t[j] * s.half[i]) + room);
      if (std::abs(t[i] * s.half[j] - t[j] * s.half[i]) > room + rounding) return false;
    }
    return true;
  }

  template <class Visit>
  bool any_below(Index number, const Segment& segment, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (!meets(node.bounds, segment)) return false;
    if (node.count == 0) return any_below(node.first, segment, visit) || any_below(node.second, segment, visit);
    return std::any_of(items_.begin() + node.first, items_.begin() + node.first + node.count, visit);
  }

  template <class Visit>
  void descend(Index number, const Vec3& from, double& limit, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.count > 0) {
      for (Index k = node.first; k < node.first + node.count; ++k) visit(item(k), limit);
      return;
    }
    const double d1 = squared_least(nodes_[static_cast<std::size_t>(node.first)], from, limit);
    const double d2 = squared_least(nodes_[static_cast<std::size_t>(node.second)], from, limit);
    const bool first_nearer = d1 <= d2;
    if (std::min(d1, d2) <= limit) descend(first_nearer ? node.first : node.second, from, limit, visit);
    if (std::max(d1, d2) <= limit) descend(first_nearer ? node.second : node.first, from, limit, visit);
  }
};

}  // namespace abut::contact
