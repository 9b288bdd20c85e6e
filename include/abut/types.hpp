// Index and identifier types.
#pragma once

#include <cstdint>

namespace abut {

/// Dense position in an array of this run (0-based). -1 (`no_index`) means "none".
using Index = std::int32_t;
inline constexpr Index no_index = -1;

/// Identifier that the user gave (node 31, part 2): stable from run to run, the key of every ordered sum.
using Id = std::int64_t;

}  // namespace abut
