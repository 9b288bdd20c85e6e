#include "elements/brick8/brick_kernel.hpp"

#include "simd/isa_object.hpp"

namespace abut::elements::ABUT_ISA {
void brick8(const SolidTask& task) { brick_step<simd::ABUT_ISA::Real>(task); }
}  // namespace abut::elements::ABUT_ISA
