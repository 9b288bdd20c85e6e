// One animation state, read back from its file (output/animation.hpp says what is in it).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/types.hpp"

namespace abut::report {

enum class Shape : std::uint8_t { triangle, quadrilateral, tetrahedron, pyramid, wedge, hexahedron };

/// Corners in VTK's order; the faces of a solid look outward.
struct Cell {
  Shape shape = Shape::triangle;
  std::array<Index, 8> nodes{};
  Id id = 0, part = 0;
  [[nodiscard]] bool solid() const { return shape >= Shape::tetrahedron; }
};

/// Values of one field, interleaved (x y z x y z ...).
struct Field {
  std::string name;
  int components = 1;
  std::vector<float> values;
};

struct Grid {
  double time = 0.0;
  std::int64_t cycle = 0;
  std::vector<double> points;  ///< #N by 3, interleaved
  std::vector<Id> node_id;     ///< #N; empty when the file has none
  std::vector<Cell> cells;
  std::vector<Field> node_fields;  ///< #N each
  std::vector<Field> cell_fields;  ///< #cells each
  /// The field of that name, or null.
  [[nodiscard]] static const Field* find(const std::vector<Field>& fields, const std::string& name);
};

/// @param with_fields  false: points and cells only
/// @throws RunError when the file cannot be read as a VTK unstructured grid whose cells and fields fit its points
[[nodiscard]] Grid read_grid(const std::filesystem::path& file, bool with_fields = true);

/// Contact surfaces of a run (NAME_contact.vtu): segments by node, in the order of interface, side.
struct ContactSurface {
  Id interface = 0, surface = 0;
  int side = 1;                                ///< 1 first, 2 second surface of the card
  std::vector<std::array<Index, 4>> segments;  ///< a triangle repeats its third node
};
/// Empty when there is no such file. @throws RunError when it cannot be read, or its nodes are not `node_id`
[[nodiscard]] std::vector<ContactSurface> read_contact_surfaces(const std::filesystem::path& file, const std::vector<Id>& node_id);

}  // namespace abut::report
