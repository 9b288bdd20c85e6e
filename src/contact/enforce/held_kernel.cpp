#include "contact/enforce/held_kernel.hpp"

#include "simd/isa.hpp"

namespace abut::contact {

// held_kernel.isa.cpp, once per instruction set
namespace sse2 {
void held_nodes(const HeldRules& rules, HeldBatch& batch);
}
namespace avx2 {
void held_nodes(const HeldRules& rules, HeldBatch& batch);
}
namespace avx512 {
void held_nodes(const HeldRules& rules, HeldBatch& batch);
}

HeldKernel held_kernel() { return simd::of_active_isa(sse2::held_nodes, avx2::held_nodes, avx512::held_nodes); }

}  // namespace abut::contact
