// Adds the slots of one block to the sums of its chunk (chunks.hpp): the fixed order is corner by corner, lane by lane.
//
// Slots hold a component of 8 lanes in a row, sums the components of a node. Four lanes by four components are transposed in registers;
// every sum is still one addition per element and component, so that all instruction sets round alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/four.hpp"

namespace abut::elements {

namespace add_block_detail {

/// Four components of lanes l to l + 3 whose sums begin at sums + position * components.
template <int components>
ABUT_INLINE void add_four(const double* slot, const std::uint16_t* position, double* sums) {
  simd::Four m[4] = {simd::load4(slot), simd::load4(slot + 8), simd::load4(slot + 16), simd::load4(slot + 24)};
  simd::transpose(m);
#pragma GCC unroll 4
  for (int l = 0; l < 4; ++l) {
    double* sum = sums + position[l] * components;
    simd::store(sum, simd::load4(sum) + m[l]);
  }
}

}  // namespace add_block_detail

/// @param slots  of the block: corners by components by 8
/// @param positions  corners by 8
template <int corners, int components>
ABUT_INLINE void add_block(const double* slots, const std::uint16_t* positions, double* sums) {
#pragma GCC unroll 8
  for (int k = 0; k < corners; ++k) {
#pragma GCC unroll 2
    for (int lane = 0; lane < 8; lane += 4) {
#pragma GCC unroll 2
      for (int c = 0; c < components; c += 4) {
        add_block_detail::add_four<components>(slots + (k * components + c) * 8 + lane, positions + k * 8 + lane, sums + c);
      }
    }
  }
}

}  // namespace abut::elements
