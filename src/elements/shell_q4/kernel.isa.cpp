// The production kernels of the quadrilateral, one object per instruction set.
#include "elements/shell_q4/kernel.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {

void q4_elastic(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  q4_blocks<simd::ABUT_ISA::Real, ShellLaw::elastic>(args, q, damping, begin, end);
}

void q4_johnson_cook(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  q4_blocks<simd::ABUT_ISA::Real, ShellLaw::johnson_cook>(args, q, damping, begin, end);
}

}  // namespace abut::elements::ABUT_ISA
