#include "elements/tetra4/tetra_kernel.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {
void tetra4(const SolidTask& task) { tetra_step<simd::ABUT_ISA::Real>(task); }
}  // namespace abut::elements::ABUT_ISA
