// The shape under an eight-node brick with repeated nodes, in VTK's node order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::output {

enum class CellKind { triangle, quadrilateral, tetrahedron, wedge, pyramid, hexahedron };

/// VTK's number of a kind of cell (vtkCellType.h).
[[nodiscard]] std::uint8_t vtk_number(CellKind kind);

struct CellShape {
  CellKind kind = CellKind::hexahedron;
  std::array<Index, 8> nodes{};
  int count = 8;
};

/// 8 distinct nodes: hexahedron; 6 with two triangles: wedge; 5 with one quadrilateral: pyramid; 4: tetrahedron; anything
/// else stays a hexahedron with repeated nodes. Which edges the deck collapsed does not matter. Nodes are ordered as VTK
/// wants them (positive volume, wedge base outward, pyramid base towards the apex) in the configuration `x`.
/// @param x  #N by 3
[[nodiscard]] CellShape brick_shape(const std::array<Index, 8>& nodes, std::span<const Vec3> x);

/// A tetrahedron with positive volume in `x`.
[[nodiscard]] CellShape tetra_shape(const std::array<Index, 4>& nodes, std::span<const Vec3> x);

}  // namespace abut::output
