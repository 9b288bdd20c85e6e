// The production kernels of the triangle, one object per instruction set.
#include "elements/shell_c0/kernel.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {

void c0_elastic(const ShellKernelArgs& args, const C0Parameters& q, double damping, std::size_t begin, std::size_t end) {
  c0_blocks<simd::ABUT_ISA::Real, ShellLaw::elastic>(args, q, damping, begin, end);
}

void c0_johnson_cook(const ShellKernelArgs& args, const C0Parameters& q, double damping, std::size_t begin, std::size_t end) {
  c0_blocks<simd::ABUT_ISA::Real, ShellLaw::johnson_cook>(args, q, damping, begin, end);
}

}  // namespace abut::elements::ABUT_ISA
