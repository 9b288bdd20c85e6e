#include "elements/group.hpp"

namespace abut::elements {

PartSums Group::NodalShares::sums(const ChunkTable& chunks, std::span<const Vec3> v, std::span<const Vec3> w) const {
  PartSums sums;
  const std::span<const Index> nodes = chunks.nodes();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes[k]);
    sums.mass += mass[k];
    sums.kinetic_energy += 0.5 * mass[k] * squared_norm(v[i]);
    sums.momentum += mass[k] * v[i];
    if (!inertia.empty() && !w.empty()) sums.rotational_energy += 0.5 * inertia[k] * squared_norm(w[i]);
  }
  return sums;
}

}  // namespace abut::elements
