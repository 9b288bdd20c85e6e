// Which kernels the counted operations belong to.
#pragma once

#include "number.hpp"

namespace abut::bench {

inline simd::Operations of_elements, of_contact;

/// Runs a kernel and adds what it counts to `into`.
template <class Kernel>
void count(simd::Operations& into, Kernel&& kernel) {
  const simd::Operations before = simd::operations;
  kernel();
  into.simple += simd::operations.simple - before.simple;
  into.divisions += simd::operations.divisions - before.divisions;
  into.roots += simd::operations.roots - before.roots;
}

}  // namespace abut::bench
