// Asks for the nodes that the next chunk gathers while the present one is computed.
//
// Nodes keep the order of the deck: those of a chunk are short runs, one per row of a mesh, in as many pages, and the processor's own
// prefetch learns nothing from them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/pack.hpp"

namespace abut::elements {

struct NodesAhead {
  const std::int32_t* node = nullptr;  ///< of the next chunk, ascending
  std::size_t count = 0;               ///< 0: nothing to ask for
};

/// The share of part `part` of `parts` equal parts of the present chunk. @param arrays  #N by 3
template <int n>
ABUT_INLINE void ask(const NodesAhead& ahead, std::size_t part, std::size_t parts, const double* const (&arrays)[n]) {
  std::int32_t last = -2;
  for (std::size_t i = ahead.count * part / parts, end = ahead.count * (part + 1) / parts; i < end; ++i) {
    if (ahead.node[i] - last < 2) continue;  // two nodes take less than a line of the cache
    last = ahead.node[i];
    for (int k = 0; k < n; ++k) __builtin_prefetch(arrays[k] + 3 * static_cast<std::ptrdiff_t>(last), 0, 2);
  }
}

}  // namespace abut::elements
