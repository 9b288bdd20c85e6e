// Adds the slots of one block to the sums of its chunk (chunks.hpp): the fixed order is corner by corner, lane by lane.
//
// Slots hold a component of 8 lanes in a row, sums the components of a node. Four lanes by four components are transposed in registers;
// every sum is still one addition per element and component, so that all instruction sets round alike.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/pack.hpp"

namespace abut::elements {

namespace add_block_detail {

ABUT_INLINE void add(double* sum, simd::VectorOf<4>::real value) { simd::store<4>(sum, simd::load<4>(sum) + simd::Pack<4>(value)); }

/// Four components of lanes l to l + 3 whose sums begin at sums + position * components.
template <int components>
ABUT_INLINE void add_four(const double* slot, const std::uint16_t* position, double* sums) {
  const auto a = simd::load<4>(slot).r, b = simd::load<4>(slot + 8).r, c = simd::load<4>(slot + 16).r, d = simd::load<4>(slot + 24).r;
  const auto ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const auto cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  add(sums + position[0] * components, __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5));
  add(sums + position[1] * components, __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5));
  add(sums + position[2] * components, __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7));
  add(sums + position[3] * components, __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7));
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
