// The reference program's search: nearest node, then a facet around it (numerics.md 7.3.2, 7.3.3), used by the plain rule.
//
// Where we differ: after the one-ring update the nearest node is compared with all nodes within reach, and a nearer one is
// taken: the search cannot be left behind or stop at a local minimum. Wherever the one-ring update finds the nearest node,
// ties included, the result is its result.
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
  double reach_ = 0.0;
  double moved_ = 0.0;

  void refresh(const Side& surface, double gap);
};

/// 7.3.3: the facet around node n that x projects on. @param previous  the stored facet or no_index
[[nodiscard]] Index choose_facet(const Side& surface, Index n, Index previous, const Vec3& x);

}  // namespace abut::contact
