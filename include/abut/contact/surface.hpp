// A contact surface: facets of 3 or 4 nodes, checked once, immutable.
#pragma once

#include <array>
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

/// Topology of a surface. What changes (stiffness, thickness, activity) is handed to Interface as spans, #F each.
class Surface {
 public:
  Surface() = default;
  /// @param facets  #F faces; degenerate spellings (n4 = 0, n4 = n1, n2 = n3, n1 = n2) must already be normalised
  /// @param node_key  #N keys (ids) of the host's nodes that order every sum; empty: the host's index is the key
  /// @throws std::invalid_argument naming the facet (0-based) when it has fewer than three distinct nodes, a negative
  ///         node, or appears twice
  explicit Surface(std::vector<Facet> facets, std::span<const Id> node_key = {});

  [[nodiscard]] std::span<const Facet> facets() const { return facets_; }              ///< #F, as given
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }                ///< #S host nodes, by key, distinct
  /// Facets by surface-local node numbers (positions in nodes()).
  [[nodiscard]] std::span<const std::array<Index, 4>> local() const { return local_; }
  /// Facets at surface node s (each once), ascending.
  [[nodiscard]] std::span<const Index> facets_at(Index s) const;
  /// Facet across edge e (corner e to corner e+1) of facet f; no_index at a free border or a junction of more than two.
  [[nodiscard]] Index neighbour(Index f, int e) const { return neighbours_[static_cast<std::size_t>(f)][static_cast<std::size_t>(e)]; }
  [[nodiscard]] Index facet_count() const { return static_cast<Index>(facets_.size()); }
  [[nodiscard]] Index node_count() const { return static_cast<Index>(nodes_.size()); }

 private:
  std::vector<Facet> facets_;
  std::vector<Index> nodes_;
  std::vector<std::array<Index, 4>> local_;
  std::vector<Index> at_first_;
  std::vector<Index> at_facet_;
  std::vector<std::array<Index, 4>> neighbours_;
};

}  // namespace abut::contact
