// Asks for memory before it is needed.
#pragma once

#include <cstddef>

#include "simd/pack.hpp"

namespace abut::simd {

/// Brings `count` doubles from `p` on towards the second cache. A kernel asks for its next block's history while it works on the present
/// one: the blocks are a few kB long and the processor's own prefetch begins anew on every page. No access: any address is allowed.
ABUT_INLINE void prefetch(const double* p, std::size_t count) {
  constexpr std::size_t line = 8;
#pragma GCC unroll 8
  for (std::size_t i = 0; i < count; i += line) __builtin_prefetch(p + i, 0, 2);
}

}  // namespace abut::simd
