#include "contact/search/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace abut::contact {

void BoxTree::build(const std::vector<Bounds>& boxes) {
  boxes_ = boxes;
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.clear();
  if (!boxes.empty()) split(0, static_cast<Index>(boxes.size()));
}

Index BoxTree::split(Index first, Index last) {
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  Bounds centres;
  const auto centre = [this](Index i) {
    const Bounds& b = boxes_[static_cast<std::size_t>(i)];
    return 0.5 * (b.low + b.high);
  };
  for (Index k = first; k < last; ++k) {
    const Index i = items_[static_cast<std::size_t>(k)];
    node.bounds.include(boxes_[static_cast<std::size_t>(i)]);
    centres.include(centre(i));
  }
  constexpr Index leaf = 8;
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
