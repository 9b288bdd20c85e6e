#include "contact/enforce/held_formulas.hpp"
#include "simd/isa_object.hpp"

namespace abut::contact::ABUT_ISA {

void held_nodes(const HeldRules& rules, HeldBatch& batch) {
  constexpr int width = simd::NumberTraits<simd::ABUT_ISA::Real>::width;
  for (int first = 0; first < batch.count; first += width) held::ordinary_nodes<simd::ABUT_ISA::Real>(rules, batch, first);
}

}  // namespace abut::contact::ABUT_ISA
