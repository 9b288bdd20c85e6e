// The shell kernels of the SSE2 path with a number type that counts. A program that is linked with the sources of this folder takes these
// kernels instead of the ones in the libraries: run it with ABUT_ISA=sse2.
#include "tally.hpp"
// The number type first.
#include "elements/shell_q4/kernel.hpp"

namespace abut::elements::sse2 {

void q4_elastic(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  bench::count(bench::of_elements, [&] { q4_blocks<simd::Counted, ShellLaw::elastic>(args, q, damping, begin, end); });
}

void q4_johnson_cook(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  bench::count(bench::of_elements, [&] { q4_blocks<simd::Counted, ShellLaw::johnson_cook>(args, q, damping, begin, end); });
}

}  // namespace abut::elements::sse2
