// Sums whose order depends on the number of terms only: leaves of 256 terms, added one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "parallel/thread_pool.hpp"

namespace abut::parallel {

inline constexpr std::size_t leaf_size = 256;

/// Sum of leaf(begin, end) over consecutive ranges of leaf_size terms. T needs a default (zero) and operator+=.
/// @param scratch reused between calls, so that a cycle allocates nothing
template <class T, class Leaf>
T ordered_sum(std::size_t count, std::vector<T>& scratch, ThreadPool& pool, Leaf&& leaf) {
  const std::size_t leaves = (count + leaf_size - 1) / leaf_size;
  scratch.resize(leaves);
  pool.for_ranges(leaves, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) scratch[i] = leaf(i * leaf_size, std::min(count, (i + 1) * leaf_size));
  });
  T total{};
  for (const T& part : scratch) total += part;
  return total;
}

}  // namespace abut::parallel
