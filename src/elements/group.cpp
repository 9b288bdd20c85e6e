#include "elements/group.hpp"

#include "parallel/ordered_sum.hpp"

namespace abut::elements {

PartSums Group::NodalShares::sums(const ChunkTable& chunks, std::span<const Vec3> v, std::span<const Vec3> w, parallel::ThreadPool* pool) {
  const std::span<const Index> nodes = chunks.nodes();
  const bool rotations = !inertia.empty() && !w.empty();
  const auto leaf = [&](std::size_t begin, std::size_t end) {
    PartSums sums;
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(nodes[k]);
      sums.mass += mass[k];
      sums.kinetic_energy += 0.5 * mass[k] * squared_norm(v[i]);
      sums.momentum += mass[k] * v[i];
      if (rotations) sums.rotational_energy += 0.5 * inertia[k] * squared_norm(w[i]);
    }
    return sums;
  };
  if (pool != nullptr) return parallel::ordered_sum(nodes.size(), leaves, *pool, leaf);
  parallel::ThreadPool alone(1);
  return parallel::ordered_sum(nodes.size(), leaves, alone, leaf);
}

}  // namespace abut::elements
