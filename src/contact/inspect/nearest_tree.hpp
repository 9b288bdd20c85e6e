// Nearest-first search over boxes: no radius has to be known beforehand.
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "contact/search/box_tree.hpp"

namespace abut::contact {

class NearestTree {
 public:
  void build(std::span<const CoarseBounds> boxes) {
    items_.resize(boxes.size());
    std::iota(items_.begin(), items_.end(), 0);
    nodes_.clear();
    if (!boxes.empty()) split(boxes, 0, static_cast<Index>(boxes.size()));
    nodes_.shrink_to_fit();
  }

  /// Frees what refit() makes again.
  void forget_bounds() { std::vector<Node>().swap(nodes_); }

  /// The same items elsewhere: the same tree with other bounds.
  void refit(std::span<const CoarseBounds> boxes) {
    if (nodes_.empty() && !items_.empty()) join(0, static_cast<Index>(items_.size()));
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children have higher numbers
      Node& node = nodes_[n];
      node.bounds = CoarseBounds();
      for (Index k = node.first; k < node.first + node.count; ++k)
        node.bounds.include(boxes[static_cast<std::size_t>(items_[static_cast<std::size_t>(k)])]);
      if (node.count > 0) continue;
      node.bounds.include(nodes_[static_cast<std::size_t>(node.first)].bounds);
      node.bounds.include(nodes_[static_cast<std::size_t>(node.second)].bounds);
    }
  }

  /// Visits items until none can be nearer than sqrt(limit); `visit(item, limit)` lowers the limit when it finds something nearer.
  template <class Visit>
  void search(const Vec3& from, double limit, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, from, limit, visit);
  }

  /// Visits items whose leaf meets the box until `visit(item)` says true. @return whether it did
  template <class Visit>
  bool any(const Bounds& box, Visit&& visit) const {
    return !nodes_.empty() && any_below(0, CoarseBounds(box), visit);
  }

 private:
  struct Node {
    CoarseBounds bounds;
    Index first = 0, second = 0, count = 0;  // leaf (count > 0): first item; else two children
  };
  static constexpr Index leaf = 4;  // items, at most
  std::vector<Node> nodes_;
  std::vector<Index> items_;

  Index split(std::span<const CoarseBounds> boxes, Index first, Index last) {
    const auto number = static_cast<Index>(nodes_.size());
    nodes_.emplace_back();
    Node node;
    Bounds centres;
    const auto centre = [boxes](Index i) {
      const Bounds b = boxes[static_cast<std::size_t>(i)].bounds();
      return 0.5 * (b.low + b.high);
    };
    for (Index k = first; k < last; ++k) {
      const Index i = items_[static_cast<std::size_t>(k)];
      node.bounds.include(boxes[static_cast<std::size_t>(i)]);
      centres.include(centre(i));
    }
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

  template <class Visit>
  bool any_below(Index number, const CoarseBounds& box, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (!node.bounds.meets(box)) return false;
    if (node.count == 0) return any_below(node.first, box, visit) || any_below(node.second, box, visit);
    return std::any_of(items_.begin() + node.first, items_.begin() + node.first + node.count, visit);
  }

  template <class Visit>
  void descend(Index number, const Vec3& from, double& limit, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.count > 0) {
      for (Index k = node.first; k < node.first + node.count; ++k) visit(items_[static_cast<std::size_t>(k)], limit);
      return;
    }
    const double d1 = squared_distance(nodes_[static_cast<std::size_t>(node.first)].bounds.bounds(), from);
    const double d2 = squared_distance(nodes_[static_cast<std::size_t>(node.second)].bounds.bounds(), from);
    const bool first_nearer = d1 <= d2;
    if (std::min(d1, d2) <= limit) descend(first_nearer ? node.first : node.second, from, limit, visit);
    if (std::max(d1, d2) <= limit) descend(first_nearer ? node.second : node.first, from, limit, visit);
  }
};

}  // namespace abut::contact
