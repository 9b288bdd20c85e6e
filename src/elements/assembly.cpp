#include "elements/assembly.hpp"

#include <limits>
#include <stdexcept>

namespace abut::elements {

Assembly::Assembly(Index node_count, std::span<const std::unique_ptr<Group>> groups) {
  for (const std::unique_ptr<Group>& g : groups) {
    g->set_slot_offset(slot_count_);
    slot_count_ += g->layout().size();
    g->set_sum_offset(sum_count_);
    sum_count_ += g->chunks().sum_count();
  }
  if (sum_count_ > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("too many elements for the index of sums");
  const auto gather = [&](int components) {
    Entries entries;
    entries.first.assign(static_cast<std::size_t>(node_count) + 1, 0);
    const auto for_entries = [&](auto&& visit) {
      for (const std::unique_ptr<Group>& g : groups) {
        const ChunkTable& chunks = g->chunks();
        if (chunks.components() != components) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(chunks.size()); ++c) {
          std::size_t at = chunks.sum_offset(c);
          for (const Index node : chunks.nodes(c)) {
            visit(static_cast<std::size_t>(node), at);
            at += static_cast<std::size_t>(components);
          }
        }
      }
    };
    for_entries([&](std::size_t node, std::size_t) { ++entries.first[node + 1]; });
    for (std::size_t i = 1; i < entries.first.size(); ++i) entries.first[i] += entries.first[i - 1];
    if (entries.first.back() == 0) return Entries();
    entries.at.resize(entries.first.back() + Entries::padding);
    std::vector<std::uint32_t> next(entries.first.begin(), entries.first.end() - 1);
    for_entries([&](std::size_t node, std::size_t at) { entries.at[next[node]++] = static_cast<std::uint32_t>(at); });
    return entries;
  };
  shells_ = gather(8);
  solids_ = gather(4);
}

}  // namespace abut::elements
