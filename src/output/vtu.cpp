#include "output/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/diagnostic.hpp"
#include "output/files.hpp"

namespace abut::output {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 15;  // what VTK takes, too
constexpr int level = 5;

struct TypeInfo {
  std::string_view name;
  std::size_t bytes;
};
TypeInfo info(VtuArray::Type type) {
  constexpr std::array<TypeInfo, 5> all{{{"Int64", 8}, {"Int32", 4}, {"UInt8", 1}, {"Float32", 4}, {"Float64", 8}}};
  return all[static_cast<std::size_t>(type)];
}

std::size_t values_of(const VtuArray& array) { return array.tuples * static_cast<std::size_t>(array.components); }

class Deflater {
 public:
  Deflater() {
    if (deflateInit(&stream_, level) != Z_OK) throw RunError("no memory to compress an animation state");
    out_.resize(deflateBound(&stream_, block_bytes));
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Valid until the next call. @pre at most block_bytes
  std::string_view operator()(std::span<unsigned char> block) {
    deflateReset(&stream_);
    stream_.next_in = block.data();
    stream_.avail_in = static_cast<uInt>(block.size());
    stream_.next_out = out_.data();
    stream_.avail_out = static_cast<uInt>(out_.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END) throw RunError("an animation state cannot be compressed");
    return {reinterpret_cast<const char*>(out_.data()), out_.size() - stream_.avail_out};
  }

 private:
  z_stream stream_{};
  std::vector<unsigned char> out_;
};

std::string_view as_text(std::span<const std::uint64_t> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// Writes an array behind what the file has, and drops its values.
void write_array(AtomicFile& file, VtuArray& array, Deflater& deflater) {
  const std::size_t size = info(array.type).bytes, all = values_of(array), per_block = block_bytes / size;
  const std::size_t blocks = (all + per_block - 1) / per_block;
  std::vector<std::uint64_t> head(3 + blocks, 0);
  head[0] = blocks;
  head[1] = block_bytes;
  head[2] = all % per_block * size;
  const std::uint64_t head_at = file.size();
  file.write(as_text(head));
  alignas(16) std::array<unsigned char, block_bytes> block;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t count = std::min(per_block, all - b * per_block);
    array.fill(count, block.data());
    const std::string_view packed = deflater(std::span(block).first(count * size));
    head[3 + b] = packed.size();
    file.write(packed);
  }
  file.write_at(head_at, as_text(head));
  array.fill = nullptr;
}

struct Section {
  std::string_view name;
  std::vector<VtuArray*> arrays;
};

std::vector<VtuArray*> pointers(std::vector<VtuArray>& arrays) {
  std::vector<VtuArray*> out;
  for (VtuArray& a : arrays) out.push_back(&a);
  return out;
}

/// The head of the file. As long for all offsets: places of the arrays, in order.
std::string head_of(const VtuGrid& grid, const Section& field_data, std::span<const Section> sections,
                    std::span<const std::uint64_t> offsets) {
  std::size_t next = 0;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n";
  const auto add = [&](const Section& section, bool tuples) {
    text += fmt::format("    <{}>\n", section.name);
    for (const VtuArray* array : section.arrays) {
      text += fmt::format("      <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", info(array->type).name, array->name,
                          array->components);
      for (std::size_t c = 0; c < array->component_names.size(); ++c)
        text += fmt::format(" ComponentName{}=\"{}\"", c, array->component_names[c]);
      if (tuples) text += fmt::format(" NumberOfTuples=\"{}\"", array->tuples);
      text += fmt::format(" format=\"appended\" offset=\"{:<20}\"/>\n", offsets[next++]);
    }
    text += fmt::format("    </{}>\n", section.name);
  };
  add(field_data, true);
  text += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points.tuples, grid.types.tuples);
  for (const Section& section : sections) add(section, false);
  return text + "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void write_vtu(const std::filesystem::path& path, VtuGrid grid) {
  const Section field_data{"FieldData", pointers(grid.field_data)};
  const std::array<Section, 4> sections{{{"PointData", pointers(grid.point_data)},
                                         {"CellData", pointers(grid.cell_data)},
                                         {"Points", {&grid.points}},
                                         {"Cells", {&grid.connectivity, &grid.offsets, &grid.types}}}};
  std::vector<VtuArray*> all = field_data.arrays;
  for (const Section& section : sections) all.insert(all.end(), section.arrays.begin(), section.arrays.end());

  AtomicFile file(path);
  std::vector<std::uint64_t> offsets(all.size(), 0);
  file.write(head_of(grid, field_data, sections, offsets));
  const std::uint64_t data = file.size();
  Deflater deflater;
  for (std::size_t k = 0; k < all.size(); ++k) {
    offsets[k] = file.size() - data;
    write_array(file, *all[k], deflater);
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.write_at(0, head_of(grid, field_data, sections, offsets));
  file.finish();
}

}  // namespace abut::output
