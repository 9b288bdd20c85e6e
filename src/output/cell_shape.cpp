#include "output/cell_shape.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace abut::output {
namespace {

// Corners of the faces of a hexahedron (numerics.md 0.5), and its edges.
constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

using Face = std::vector<Index>;

/// Six times the volume of the tetrahedron a b c d; positive when d lies on the side of the normal of a b c.
double volume6(std::span<const Vec3> x, Index a, Index b, Index c, Index d) {
  const auto at = [x](Index n) { return x[static_cast<std::size_t>(n)]; };
  return dot(cross(at(b) - at(a), at(c) - at(a)), at(d) - at(a));
}

/// The faces that keep three or four distinct corners.
std::vector<Face> proper_faces(const std::array<Index, 8>& nodes) {
  std::vector<Face> result;
  for (const auto& corners : faces) {
    Face face;
    for (const int corner : corners) {
      const Index node = nodes[static_cast<std::size_t>(corner)];
      if (std::find(face.begin(), face.end(), node) == face.end()) face.push_back(node);
    }
    if (face.size() >= 3) result.push_back(face);
  }
  return result;
}

bool connected(const std::array<Index, 8>& nodes, Index a, Index b) {
  return std::any_of(std::begin(edges), std::end(edges), [&](const int(&edge)[2]) {
    const Index p = nodes[static_cast<std::size_t>(edge[0])];
    const Index q = nodes[static_cast<std::size_t>(edge[1])];
    return (p == a && q == b) || (p == b && q == a);
  });
}

bool contains(const Face& face, Index node) { return std::find(face.begin(), face.end(), node) != face.end(); }

/// @return true when `nodes` is a wedge; fills `shape`
bool make_wedge(const std::array<Index, 8>& nodes, std::span<const Vec3> x, CellShape& shape) {
  std::vector<Face> triangles;
  for (const Face& face : proper_faces(nodes)) {
    if (face.size() == 3) triangles.push_back(face);
  }
  if (triangles.size() != 2) return false;
  Face& base = triangles[0];
  if (std::any_of(base.begin(), base.end(), [&](Index n) { return contains(triangles[1], n); })) return false;
  Face top;
  for (const Index corner : base) {
    for (const Index above : triangles[1]) {
      if (connected(nodes, corner, above) && !contains(top, above)) {
        top.push_back(above);
        break;
      }
    }
  }
  if (top.size() != 3) return false;
  if (volume6(x, base[0], base[1], base[2], top[0]) > 0.0) {  // VTK: the base's normal points outward
    std::swap(base[1], base[2]);
    std::swap(top[1], top[2]);
  }
  shape.kind = CellKind::wedge;
  shape.count = 6;
  std::copy(base.begin(), base.end(), shape.nodes.begin());
  std::copy(top.begin(), top.end(), shape.nodes.begin() + 3);
  return true;
}

bool make_pyramid(const std::array<Index, 8>& nodes, const Face& distinct, std::span<const Vec3> x, CellShape& shape) {
  std::vector<Face> quads;
  for (const Face& face : proper_faces(nodes)) {
    if (face.size() == 4) quads.push_back(face);
  }
  if (quads.size() != 1) return false;
  Face& base = quads[0];
  const Index apex = *std::find_if(distinct.begin(), distinct.end(), [&](Index n) { return !contains(base, n); });
  if (volume6(x, base[0], base[1], base[2], apex) < 0.0) std::swap(base[1], base[3]);  // VTK: towards the apex
  shape.kind = CellKind::pyramid;
  shape.count = 5;
  std::copy(base.begin(), base.end(), shape.nodes.begin());
  shape.nodes[4] = apex;
  return true;
}

}  // namespace

std::uint8_t vtk_number(CellKind kind) {
  constexpr std::array<std::uint8_t, 6> numbers{5, 9, 10, 13, 14, 12};
  return numbers[static_cast<std::size_t>(kind)];
}

CellShape tetra_shape(const std::array<Index, 4>& nodes, std::span<const Vec3> x) {
  CellShape shape;
  shape.kind = CellKind::tetrahedron;
  shape.count = 4;
  std::copy(nodes.begin(), nodes.end(), shape.nodes.begin());
  if (volume6(x, nodes[0], nodes[1], nodes[2], nodes[3]) < 0.0) std::swap(shape.nodes[1], shape.nodes[2]);
  return shape;
}

CellShape brick_shape(const std::array<Index, 8>& nodes, std::span<const Vec3> x) {
  Face distinct;
  for (const Index node : nodes) {
    if (!contains(distinct, node)) distinct.push_back(node);
  }
  CellShape shape;
  shape.nodes = nodes;
  if (distinct.size() == 4) return tetra_shape({distinct[0], distinct[1], distinct[2], distinct[3]}, x);
  if (distinct.size() == 5) make_pyramid(nodes, distinct, x, shape);
  if (distinct.size() == 6) make_wedge(nodes, x, shape);
  return shape;
}

}  // namespace abut::output
