// Faces and volumes of elements (deck-format.md C.6), and what lies behind a segment (numerics.md 7.2.2).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace abut::model {

/// Signed volume of a hexahedron by one-point integration: 8 times the Jacobian at its centre.
[[nodiscard]] double one_point_volume(const std::array<Vec3, 8>& x);
/// How many corners of a hexahedron are turned inside out: their three edges have a negative volume.
[[nodiscard]] int inverted_corners(const std::array<Vec3, 8>& x);
/// Sides of one of its faces cross.
[[nodiscard]] bool has_crossed_face(const std::array<Vec3, 8>& x);
/// What a deck calls it; 0 of none.
[[nodiscard]] Id element_id(const Model& model, const ElementRef& element);
/// Exact volume of its trilinear shape.
[[nodiscard]] double shape_volume(const std::array<Vec3, 8>& x);
/// Signed volume; positive when the right-hand normal of the first three corners points away from the fourth.
[[nodiscard]] double tetra_volume(const std::array<Vec3, 4>& x);
/// Area of a facet as half of |x13 x x24|; a triangle repeats its third corner.
[[nodiscard]] double facet_area(const std::array<Vec3, 4>& x);
/// What is wrong with a facet without area: "its nodes must be distinct and not on one line", or that their order is crossed.
[[nodiscard]] const char* why_no_area(const std::array<Vec3, 4>& x);
/// How many corners of a quadrilateral turn against the others: 0 convex, 1 the inner angle there is beyond 180 degrees, 2 sides cross.
[[nodiscard]] int turned_corners(const std::array<Vec3, 4>& x);

/// A face: up to four distinct nodes in order, outward; unused places hold no_index. Empty (nodes[0] == no_index): the face does not exist.
using Face = std::array<Index, 4>;

/// The faces of brick or tetrahedron `solid` (tetrahedra follow the bricks), with repeated nodes dropped.
[[nodiscard]] std::array<Face, 6> solid_faces(const Model& m, Index solid);
[[nodiscard]] std::span<const Index> solid_nodes(const Model& m, Index solid);
[[nodiscard]] Index solid_count(const Model& m);
[[nodiscard]] ElementRef solid_ref(const Model& m, Index solid);
[[nodiscard]] Index solid_part(const Model& m, Index solid);

/// A face with its nodes sorted: equal for faces on the same nodes.
[[nodiscard]] Face sorted_face(Face f);
/// Face -> segment nodes (a triangle repeats its third node).
[[nodiscard]] std::array<Index, 4> segment_nodes(const Face& f);

struct SolidFace {
  Index solid = no_index;
  Face face{};
};

/// Faces of `solids` (sorted) that no solid of `candidates` (sorted, contains `solids`) shares in the opposite sense; in order of solid and
/// face.
[[nodiscard]] std::vector<SolidFace> external_faces(const Model& m, const std::vector<Index>& solids, const std::vector<Index>& candidates);

/// Elements at each node, in compressed rows.
class NodeElements {
 public:
  explicit NodeElements(const Model& m);
  /// The element behind a segment: a solid with this face; a shell with these nodes overrides it (thickest, then stiffest, wins).
  [[nodiscard]] ElementRef behind(const Model& m, const std::array<Index, 4>& segment) const;

 private:
  struct Rows {
    std::vector<Index> start, element;
    [[nodiscard]] std::span<const Index> at(Index node) const {
      const auto i = static_cast<std::size_t>(node);
      return std::span(element).subspan(static_cast<std::size_t>(start[i]), static_cast<std::size_t>(start[i + 1] - start[i]));
    }
  };
  template <class Nodes>
  static Rows make_rows(Index node_count, Index element_count, const Nodes& nodes_of);

  Rows shells_, sh3ns_, solids_;
};

}  // namespace abut::model
