// VTK's XML format for unstructured grids (.vtu): arrays compressed and written one after the other, a block at a time.
//
// The file is VTK file format 1.0 with raw appended data: a head of XML names every array and where it begins; behind an underscore
// follows for each array the number of blocks, the bytes of a block, of the last one where it is shorter (else 0) and of each compressed
// block, as 64-bit numbers, then the blocks as zlib writes them (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
// VTK's own writer needs the whole grid in memory, and then the whole file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace abut::output {

/// One array of a grid. Its values are asked for once, in their order: fill(count, to) writes the next `count` of them.
struct VtuArray {
  enum class Type { int64, int32, uint8, float32, float64 };
  std::string name;
  Type type = Type::float32;
  int components = 1;
  std::size_t tuples = 0;
  std::function<void(std::size_t count, void* to)> fill = {};
  std::vector<std::string> component_names = {};

  /// value(i): the i-th value
  template <class T, class Value>
  static VtuArray of(std::string name, Type type, int components, std::size_t tuples, Value value) {
    return {std::move(name), type, components, tuples, [next = std::size_t{0}, value](std::size_t count, void* to) mutable {
              T* out = static_cast<T*>(to);
              for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<T>(value(next++));
            }};
  }
};

struct VtuGrid {
  std::vector<VtuArray> field_data, point_data, cell_data;
  VtuArray points;                        ///< #N by 3
  VtuArray connectivity, offsets, types;  ///< nodes of all cells; behind the last node of each; VTK's numbers of their kinds
};

/// Writes the file under a temporary name and renames it: readers see the old content or the new. What an array's `fill` holds is freed
/// when the array is written. @throws RunError
void write_vtu(const std::filesystem::path& path, VtuGrid grid);

}  // namespace abut::output
