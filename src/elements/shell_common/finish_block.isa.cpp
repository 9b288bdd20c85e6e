// The end of a block of shells by itself, for groups that look at its steps before; one object per instruction set.
#include "elements/shell_common/finish_block.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {

void finish_quad_block(const ShellKernelArgs& args, std::size_t block) { finish_block<simd::ABUT_ISA::Real, 4>(args, block); }

void finish_triangle_block(const ShellKernelArgs& args, std::size_t block) { finish_block<simd::ABUT_ISA::Real, 3>(args, block); }

}  // namespace abut::elements::ABUT_ISA
