// What can be seen of a mesh: shells, and faces of solids that no other active solid covers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "report/grid.hpp"

namespace abut::report {

struct Face {
  std::array<Index, 4> nodes{};  ///< a triangle repeats its third node; a solid's face looks outward
  Index cell = no_index;
};

/// Faces that are seen in some state, in the order of cells, and who else owns each.
class FaceSet {
 public:
  /// @param cells   all cells of the first state
  /// @param erodes  #cells, 1: the cell is deleted in some later state, which lays the faces behind it open
  FaceSet(std::span<const Cell> cells, std::span<const std::uint8_t> erodes);

  [[nodiscard]] std::span<const Face> faces() const { return faces_; }
  /// #faces, 1: not seen while these cells are active.
  /// @param active  #cells
  [[nodiscard]] std::vector<std::uint8_t> hidden(std::span<const std::uint8_t> active) const;

 private:
  std::vector<Face> faces_;
  std::vector<std::vector<Index>> others_;  ///< per face: other cells with the same face; empty for most
};

}  // namespace abut::report
