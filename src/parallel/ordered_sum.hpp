// Sums whose order depends on the number of terms only: leaves of 256 terms, added one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "parallel/thread_pool.hpp"

namespace abut::parallel {

inline constexpr std::size_t leaf_size = 256;

/// Calls body(leaf, begin, end) for consecutive ranges of leaf_size terms.
template <class Body>
void for_leaves(std::size_t count, ThreadPool& pool, Body&& body) {
  pool.for_ranges((count + leaf_size - 1) / leaf_size, 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i, i * leaf_size, std::min(count, (i + 1) * leaf_size));
  });
}

/// Sum of leaf(begin, end) over consecutive ranges of leaf_size terms. T needs a default (zero) and operator+=.
/// @param scratch reused between calls, so that a cycle allocates nothing
template <class T, class Leaf>
T ordered_sum(std::size_t count, std::vector<T>& scratch, ThreadPool& pool, Leaf&& leaf) {
  scratch.resize((count + leaf_size - 1) / leaf_size);
  for_leaves(count, pool, [&](std::size_t i, std::size_t begin, std::size_t end) { scratch[i] = leaf(begin, end); });
  T total{};
  for (const T& part : scratch) total += part;
  return total;
}

}  // namespace abut::parallel
