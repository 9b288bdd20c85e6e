// Which facets each held node must be measured against: lists from a box tree, kept until something has moved by a skin.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "contact/search/box_tree.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

/// Lists hold every active facet whose distance to the node is at most its reach, now and until slack() exceeds the skin.
class Candidates {
 public:
  struct Entry {
    Index facet;
    double distance;  ///< to the node when the list was made
  };

  /// Rebuilds the lists when the motion since the last build exceeds `skin` (or `force` is set).
  /// Motion common to the whole surface does not count: it is measured relative to the surface's mean displacement.
  /// @param reach  #held, distance within which facets matter (< 0: this node needs none)
  void update(const Side& held, const Side& surface, const std::function<double(Index)>& reach, double skin, bool force);

  [[nodiscard]] std::span<const Entry> of(Index node) const {
    return std::span(entries_).subspan(at(first_[at(node)]), at(first_[at(node) + 1] - first_[at(node)]));
  }
  /// Distance of the node's nearest facet when the lists were made; 1e300: none listed.
  [[nodiscard]] double nearest_then(Index node) const { return nearest_[at(node)]; }
  /// Upper bound of the change of any node-to-facet distance since the lists were made.
  [[nodiscard]] double slack() const { return slack_; }
  /// Facets whose box at the last build, moved with the surface, comes within `margin` (beyond slack) of the box.
  template <class Visit>
  void near(Bounds box, double margin, Visit&& visit) const {
    box.low -= shift_;
    box.high -= shift_;
    box.inflate(margin + slack_);
    tree_.query(box, visit);
  }

 private:
  BoxTree tree_;
  std::vector<Bounds> boxes_;
  std::vector<Index> first_;
  std::vector<Entry> entries_;
  std::vector<double> nearest_;
  std::vector<Vec3> held_then_, surface_then_;
  Vec3 shift_;
  double slack_ = 0.0;
};

/// Box of a facet with its strips.
[[nodiscard]] Bounds facet_bounds(const Patch& patch);

}  // namespace abut::contact
