#include "contact/search/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace abut::contact {

void BoxTree::update() {
  constexpr double worse = 1.3;
  if (items_.size() == boxes_.size() && refit() <= worse * size_) return;
  items_.resize(boxes_.size());
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.clear();
  if (boxes_.size() > 16) nodes_.reserve(boxes_.size() / 4);  // leaves of eight to sixteen boxes, and as many nodes above them
  if (!boxes_.empty()) split(0, static_cast<Index>(boxes_.size()));
  size_ = refit();
}

double BoxTree::refit() {
  double sum = 0.0;
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    Node& node = nodes_[n];
    CoarseBounds bounds;
    if (node.count > 0) {
      for (Index k = node.first; k < node.first + node.count; ++k) {
        bounds.include(boxes_[static_cast<std::size_t>(items_[static_cast<std::size_t>(k)])]);
      }
    } else {
      bounds = nodes_[static_cast<std::size_t>(node.first)].bounds;
      bounds.include(nodes_[static_cast<std::size_t>(node.second)].bounds);
    }
    node.bounds = bounds;
    const Bounds wide = bounds.bounds();
    const Vec3 side = wide.high - wide.low;
    sum += side.x * side.y + side.y * side.z + side.z * side.x;
  }
  return sum;
}

Index BoxTree::split(Index first, Index last) {
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  Bounds centres;
  const auto centre = [this](Index i) {
    const Bounds b = box(i);
    return 0.5 * (b.low + b.high);
  };
  for (Index k = first; k < last; ++k) {
    const Index i = items_[static_cast<std::size_t>(k)];
    centres.include(centre(i));
  }
  constexpr Index leaf = 16;
  if (last - first <= leaf) {
    node.first = first;
    node.count = last - first;
  } else {
    const Vec3 width = centres.high - centres.low;
    const int axis = width.x >= width.y && width.x >= width.z ? 0 : width.y >= width.z ? 1 : 2;
    const Index middle = first + (last - first) / 2;
    std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last, [&](Index a, Index b) {
      const double ca = centre(a)[axis];
      const double cb = centre(b)[axis];
      return ca < cb || (ca == cb && a < b);
    });
    node.first = split(first, middle);
    node.second = split(middle, last);
  }
  nodes_[static_cast<std::size_t>(number)] = node;
  return number;
}

}  // namespace abut::contact
