// The reference program's search: nearest node, then a facet around it (numerics.md 7.3.2, 7.3.3), used by the plain rule.
//
// Where we differ: after the one-ring update the nearest node is compared with all nodes within reach, and a nearer one is
// taken: the search cannot be left behind or stop at a local minimum. Wherever the one-ring update finds the nearest node,
// ties included, the result is its result. Reach, somewhat more than the largest diagonal of a facet and the gap, is that of
// the positions now: what is tracked depends on them and on what was tracked before, not on when the tree was made.
#pragma once

#include <vector>

#include "contact/search/box_tree.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

/// What a node remembers: surface node and facet.
struct Tracked {
  Index node = no_index;
  Index facet = no_index;
};

class IncrementalSearch {
 public:
  /// First nearest nodes (7.2.5): the last of equally near ones wins.
  void start(const Side& held, const Side& surface, std::vector<Tracked>& tracked);
  /// One cycle for all held nodes.
  void update(const Side& held, const Side& surface, std::vector<Tracked>& tracked, double gap);

 private:
  BoxTree tree_;
  std::vector<Vec3> then_;
  double moved_ = 0.0;  ///< the furthest that any node has since the tree was made

  /// Brings the tree up to date. @return reach: the distance within which update() finds every node
  double refresh(const Side& surface, double gap);
};

/// 7.3.3: the facet around node n that x projects on. @param previous  the stored facet or no_index
[[nodiscard]] Index choose_facet(const Side& surface, Index n, Index previous, const Vec3& x);

}  // namespace abut::contact
