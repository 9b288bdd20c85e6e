// Chunks of a group: consecutive blocks of elements whose nodal forces are summed together.
//
// The elements of a chunk lie close to each other (init/locality.hpp), so that most of their nodes belong to no other chunk and the sums
// stay in the caches nearest to the processor. A node's total is the sum of its chunks' sums (`Assembly`). Both sums have a fixed order,
// whatever the threads and the instruction set: within a chunk block by block, corner by corner, lane by lane; then chunk by chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "elements/nodes_ahead.hpp"

namespace abut::elements {

inline constexpr int lanes = 8;  ///< elements in a block, for every instruction set

class ChunkTable {
 public:
  ChunkTable() = default;
  /// @param nodes  #E by corners
  /// @param components  doubles per node
  ChunkTable(std::span<const Index> nodes, int corners, int components);

  [[nodiscard]] Index size() const { return static_cast<Index>(first_.size()) - 1; }
  [[nodiscard]] int components() const { return components_; }
  /// Blocks [begin, end) of a chunk.
  [[nodiscard]] std::size_t first_block(std::size_t chunk) const { return chunk * blocks_per_chunk_; }
  [[nodiscard]] std::size_t end_block(std::size_t chunk) const;
  /// Nodes of a chunk, ascending.
  [[nodiscard]] std::span<const Index> nodes(std::size_t chunk) const;

  /// Those of the chunk after this one.
  [[nodiscard]] NodesAhead ahead_of(std::size_t chunk) const;
  /// Nodes of all chunks, one after the other.
  [[nodiscard]] std::span<const Index> nodes() const { return node_; }
  /// Place in nodes() of a corner of an element.
  [[nodiscard]] std::size_t place(Index element, int corner) const;

  /// Doubles that the sums of all chunks take.
  [[nodiscard]] std::size_t sum_count() const { return node_.size() * static_cast<std::size_t>(components_); }
  void set_offset(std::size_t offset) { offset_ = offset; }
  /// Where the sums of a chunk begin: `components` doubles per node, in the order of nodes().
  [[nodiscard]] std::size_t sum_offset(std::size_t chunk) const { return offset_ + first_[chunk] * static_cast<std::size_t>(components_); }
  /// Position in its chunk's nodes of corner k of lane l of block b, at (b * corners + k) * 8 + l.
  [[nodiscard]] const std::uint16_t* positions() const { return position_.data(); }

 private:
  int components_ = 0;
  std::size_t blocks_ = 0, blocks_per_chunk_ = 0, offset_ = 0, corners_ = 0;
  std::vector<std::size_t> first_{0};
  std::vector<Index> node_;
  std::vector<std::uint16_t> position_;
};

}  // namespace abut::elements
