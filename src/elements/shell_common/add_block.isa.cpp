// Sums of shell blocks, one object per instruction set.
#include "elements/add_block.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {

void add_quad_block(const double* slots, const std::uint16_t* positions, double* sums) { add_block<4, 8>(slots, positions, sums); }

void add_triangle_block(const double* slots, const std::uint16_t* positions, double* sums) { add_block<3, 8>(slots, positions, sums); }

}  // namespace abut::elements::ABUT_ISA
