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

HeldKernel held_kernel() {
  switch (simd::active_isa()) {
    case simd::Isa::avx512:
      return avx512::held_nodes;
    case simd::Isa::avx2:
      return avx2::held_nodes;
    case simd::Isa::sse2:
      break;
  }
  return sse2::held_nodes;
}

}  // namespace abut::contact
