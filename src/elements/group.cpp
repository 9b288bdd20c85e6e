#include "elements/group.hpp"

namespace abut::elements {

void Group::NodalShares::sum(const ChunkTable& chunks, std::size_t chunk, const Vec3* v, const Vec3* w) {
  const std::span<const Index> nodes = chunks.nodes(chunk);
  const auto first = static_cast<std::size_t>(nodes.data() - chunks.nodes().data());
  const bool rotations = !inertia.empty() && w != nullptr;
  PartSums sums;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes[k]);
    const double m = mass[first + k];
    sums.mass += m;
    sums.kinetic_energy += 0.5 * m * squared_norm(v[i]);
    sums.momentum += m * v[i];
    if (rotations) sums.rotational_energy += 0.5 * inertia[first + k] * squared_norm(w[i]);
  }
  leaves[chunk] = sums;
}

PartSums Group::NodalShares::total() const {
  PartSums total;
  for (const PartSums& leaf : leaves) total += leaf;
  return total;
}

PartSums Group::NodalShares::sums(const ChunkTable& chunks, const Vec3* v, const Vec3* w, parallel::ThreadPool* pool) {
  const auto count = static_cast<std::size_t>(chunks.size());
  const auto leaf = [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) sum(chunks, c, v, w);
  };
  if (pool != nullptr) {
    pool->for_ranges(count, 1, leaf);
  } else {
    leaf(0, count);
  }
  return total();
}

}  // namespace abut::elements
