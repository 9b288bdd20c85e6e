// Geometry and connections of one side as it is, however faulty: what every part of the inspection looks at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/inspect.hpp"
#include "contact/inspect/nearest_tree.hpp"
#include "contact/search/box_tree.hpp"

namespace abut::contact {

/// A point of a side near some place.
struct NearPoint {
  Index item = no_index;  ///< facet, or position in the node set
  double squared = 1e300;
  Vec3 point;
  [[nodiscard]] bool found() const { return item != no_index; }
};

class Shape {
 public:
  Shape(const InspectedSide& side, std::span<const Vec3> x);
  /// The same facets elsewhere. What connect() finds is found again only where other facets have no area than before.
  void move(const InspectedSide& side, std::span<const Vec3> x);
  /// Frees all that move() makes anew, shared_edges(), and the nodes() of facets.
  void keep_connections();
  /// Frees shared_edges(): a look at facing normals does not ask for them.
  void forget_shared_edges();

  [[nodiscard]] bool is_nodes() const { return side_.facets.empty(); }
  [[nodiscard]] Index count() const { return static_cast<Index>(box_.size()); }  ///< facets, or nodes of a node set
  [[nodiscard]] const InspectedSide& side() const { return side_; }
  [[nodiscard]] const Facet& facet(Index f) const { return side_.facets[static_cast<std::size_t>(f)]; }
  [[nodiscard]] Vec3 corner(Index f, int k) const { return x_[static_cast<std::size_t>(facet(f).node[static_cast<std::size_t>(k)])]; }
  [[nodiscard]] Vec3 centre(Index f) const { return centre_[static_cast<std::size_t>(f)]; }
  /// Unit normal; zero where the facet has no area.
  [[nodiscard]] Vec3 normal(Index f) const { return normal_[static_cast<std::size_t>(f)]; }
  [[nodiscard]] double area(Index f) const { return area_[static_cast<std::size_t>(f)]; }
  [[nodiscard]] double mean_size() const { return mean_size_; }  ///< mean of sqrt(area); 0 for nodes
  [[nodiscard]] Bounds bounds() const { return bounds_; }
  /// Host nodes of the side, ascending, distinct.
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }

  /// Facets without three distinct nodes or without area: they have no normal.
  [[nodiscard]] const std::vector<Index>& degenerate() const { return degenerate_; }
  /// Facets on the same nodes as an earlier one.
  [[nodiscard]] const std::vector<Index>& duplicates() const { return duplicates_; }
  /// Facets at edges of more than two.
  [[nodiscard]] const std::vector<Index>& at_junctions() const { return at_junctions_; }

  /// An edge shared by two facets.
  struct Shared {
    std::array<Index, 2> facet;
    std::array<Index, 2> node;
    bool alike;  ///< both run through it in opposite directions: their normals agree
  };
  [[nodiscard]] std::span<const Shared> shared_edges() const { return shared_; }
  /// Piece (connected over shared edges) of a facet, and which of the two orientations within the piece it has.
  [[nodiscard]] Index piece(Index f) const { return piece_.empty() ? 0 : piece_[static_cast<std::size_t>(f)]; }
  [[nodiscard]] bool turned(Index f) const { return turned_[static_cast<std::size_t>(f)] != 0; }
  [[nodiscard]] Index piece_count() const { return static_cast<Index>(one_sided_.size()); }
  /// True for a piece like a Moebius band, which no flipping makes alike.
  [[nodiscard]] bool one_sided(Index piece) const { return one_sided_[static_cast<std::size_t>(piece)] != 0; }
  /// +1 normals of a closed piece that point out of it, -1 into it, 0 an open or mixed piece.
  [[nodiscard]] int closed(Index piece) const { return closed_[static_cast<std::size_t>(piece)]; }
  /// +1 the normal looks out of the solid behind the facet, -1 into it, 0 no solid is known.
  [[nodiscard]] int out_of_solid(Index f) const { return side_.outward.empty() ? 0 : side_.outward[static_cast<std::size_t>(f)]; }
  /// The same, where no solid is known of the closed piece.
  [[nodiscard]] int outward(Index f) const { return out_of_solid(f) != 0 ? out_of_solid(f) : closed(piece(f)); }

  /// Nearest point within `radius`, on facets that do not have the node `except` for a corner.
  /// @param guess  an item that may be near: it only makes the search short
  [[nodiscard]] NearPoint nearest(const Vec3& from, double radius, Index except = no_index, Index guess = no_index) const;
  /// True when a facet other than `except` crosses the segment from a to b (ends excluded).
  [[nodiscard]] bool hides(const Vec3& a, const Vec3& b, Index except) const;

 private:
  InspectedSide side_;
  std::span<const Vec3> x_;
  std::vector<Vec3> centre_, normal_;
  std::vector<double> area_;
  std::vector<CoarseBounds> box_;
  std::vector<Index> nodes_, degenerate_, duplicates_, at_junctions_;
  std::vector<Shared> shared_;
  std::vector<Index> piece_;                                 ///< empty: all are one piece
  std::vector<std::uint8_t> turned_, one_sided_, closable_;  ///< of a piece: no borders, and its normals agree
  std::vector<int> closed_;
  NearestTree tree_;
  Bounds bounds_;
  double mean_size_ = 0.0;

  struct Items;
  void measure();
  void connect();
  void find_pieces(std::span<const Index> borders);
  void find_outside();
};

/// Closest point of a triangle [Ericson 2005, 5.1.5].
[[nodiscard]] Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace abut::contact
