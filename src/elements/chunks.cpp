#include "elements/chunks.hpp"

#include <algorithm>

namespace abut::elements {

ChunkTable::ChunkTable(std::span<const Index> nodes, int corners, int components) : components_(components) {
  const auto per_element = static_cast<std::size_t>(corners);
  corners_ = per_element;
  const std::size_t elements = nodes.size() / per_element;
  blocks_ = (elements + lanes - 1) / lanes;
  // 18 kB of sums for a chunk of quadrilaterals, 23 kB for one of bricks: half of the first cache.
  blocks_per_chunk_ = components == 8 ? 32 : 64;
  const std::size_t chunks = (blocks_ + blocks_per_chunk_ - 1) / blocks_per_chunk_;
  first_.reserve(chunks + 1);
  position_.resize(blocks_ * lanes * per_element);
  std::vector<Index> mine;
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t begin = first_block(c) * lanes, end = std::min(end_block(c) * lanes, elements);
    mine.assign(nodes.begin() + static_cast<std::ptrdiff_t>(begin * per_element),
                nodes.begin() + static_cast<std::ptrdiff_t>(end * per_element));
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    for (std::size_t slot = begin; slot < end_block(c) * lanes; ++slot) {
      const std::size_t e = std::min(slot, elements - 1);  // padding repeats the last element; its forces are zero
      for (std::size_t k = 0; k < per_element; ++k) {
        const auto found = std::lower_bound(mine.begin(), mine.end(), nodes[e * per_element + k]);
        position_[((slot / lanes) * per_element + k) * lanes + slot % lanes] = static_cast<std::uint16_t>(found - mine.begin());
      }
    }
    node_.insert(node_.end(), mine.begin(), mine.end());
    first_.push_back(node_.size());
  }
}

std::size_t ChunkTable::end_block(std::size_t chunk) const { return std::min(blocks_, (chunk + 1) * blocks_per_chunk_); }

std::size_t ChunkTable::place(Index element, int corner) const {
  const auto e = static_cast<std::size_t>(element), block = e / lanes;
  return first_[block / blocks_per_chunk_] + position_[(block * corners_ + static_cast<std::size_t>(corner)) * lanes + e % lanes];
}

std::span<const Index> ChunkTable::nodes(std::size_t chunk) const {
  return std::span<const Index>(node_).subspan(first_[chunk], first_[chunk + 1] - first_[chunk]);
}

NodesAhead ChunkTable::ahead_of(std::size_t chunk) const {
  if (chunk + 1 >= static_cast<std::size_t>(size())) return {};
  const std::span<const Index> next = nodes(chunk + 1);
  return {next.data(), next.size()};
}

}  // namespace abut::elements
