// A contact surface: facets of 3 or 4 nodes, checked once, immutable.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/types.hpp"

namespace abut::contact {

/// One face. Host node indices; a triangle repeats its third node. Its positive side, from which it is touched, is
/// given by the right-hand rule over the nodes (T27).
struct Facet {
  std::array<Index, 4> node{no_index, no_index, no_index, no_index};
  [[nodiscard]] bool is_triangle() const { return node[3] == node[2]; }
  [[nodiscard]] int corners() const { return is_triangle() ? 3 : 4; }
};

/// Which nodes and facets of a surface belong together. Spans live as long as it does.
class SurfaceTopology {
 public:
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }  ///< #S host nodes, by key, distinct
  /// Facets by surface-local node numbers (positions in nodes()).
  [[nodiscard]] std::span<const std::array<Index, 4>> local() const { return local_; }
  /// Facet f by host nodes, as given. @pre 0 <= f < facet_count(); the next two, too
  [[nodiscard]] Facet facet(Index f) const {
    Facet out;
    for (std::size_t k = 0; k < 4; ++k) out.node[k] = nodes_[static_cast<std::size_t>(local_[static_cast<std::size_t>(f)][k])];
    return out;
  }
  [[nodiscard]] bool is_triangle(Index f) const {
    const std::array<Index, 4>& n = local_[static_cast<std::size_t>(f)];
    return n[3] == n[2];
  }
  [[nodiscard]] int corners(Index f) const { return is_triangle(f) ? 3 : 4; }
  /// Facets at surface node s (each once), ascending. @pre 0 <= s < node_count()
  [[nodiscard]] std::span<const Index> facets_at(Index s) const;
  /// Facet across edge e (corner e to corner e+1) of facet f; no_index at a free border or a junction of more than two.
  /// A triangle has edges 0, 1 and 2 (corner 2 to corner 0). @pre 0 <= f < facet_count(), 0 <= e < corners(f); free_border() too
  [[nodiscard]] Index neighbour(Index f, int e) const;
  /// True when edge e of facet f belongs to no other facet.
  [[nodiscard]] bool free_border(Index f, int e) const { return (borders_[static_cast<std::size_t>(f)] >> e & 1) != 0; }
  [[nodiscard]] Index facet_count() const { return static_cast<Index>(local_.size()); }
  [[nodiscard]] Index node_count() const { return static_cast<Index>(nodes_.size()); }
  /// Position of a host node in nodes(); no_index when it is not on this surface.
  [[nodiscard]] Index find(Index host_node) const;

 protected:
  std::vector<Index> nodes_;
  std::vector<std::array<Index, 4>> local_;

  /// Makes the rest from nodes_.
  void connect(std::span<const Facet> facets);

 private:
  std::vector<Index> at_first_;
  std::vector<Index> at_facet_;
  std::vector<std::uint8_t> borders_;
  std::vector<Index> by_host_;  // surface nodes by ascending host node; empty: nodes_ ascend

  /// How many other facets edge e of facet f belongs to, and the last of them.
  struct Across {
    Index facet = no_index;
    int count = 0;
  };
  [[nodiscard]] Across across(Index f, int e) const;
};

/// A surface as its host gives it. What changes (stiffness, thickness, activity) is handed to Interface as spans, #F each.
class Surface : public SurfaceTopology {
 public:
  Surface() = default;
  /// @param facets  #F faces; degenerate spellings (n4 = 0, n4 = n1, n2 = n3, n1 = n2) must already be normalised
  /// @param node_key  #N keys (ids) of the host's nodes that order every sum; empty: the host's index is the key
  /// @throws std::invalid_argument naming the facet (0-based) when it has fewer than three distinct nodes, a negative
  ///         node, or appears twice; naming the node when node_key is not empty and too short for it
  explicit Surface(std::vector<Facet> facets, std::span<const Id> node_key = {});

  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }  ///< #F, as given

  /// Order of the facets that does not depend on how they were listed: by their nodes' keys.
  [[nodiscard]] std::vector<Index> canonical_order() const;
  /// The same surface with its facets listed as facets()[order[0]], facets()[order[1]], ...
  /// @param order  #F, a permutation of 0 ... facet_count() - 1: a precondition, not checked
  [[nodiscard]] Surface reordered(std::span<const Index> order) const;

 private:
  std::vector<Facet> facets_;
};

}  // namespace abut::contact
