// The brick kernel of the SSE2 path with a number type that counts (shells.cpp).
#include "tally.hpp"
// The number type first.
#include "elements/brick8/brick_kernel.hpp"

namespace abut::elements::sse2 {

void brick8(const SolidTask& task) {
  bench::count(bench::of_elements, [&] { brick_step<simd::Counted>(task); });
}

}  // namespace abut::elements::sse2
