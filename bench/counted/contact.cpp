// The contact kernel of the SSE2 path with a number type that counts (shells.cpp); nodes that go the general way are not counted.
#include "tally.hpp"
// The number type first.
#include "contact/enforce/held_formulas.hpp"

namespace abut::contact::sse2 {

void held_nodes(const HeldRules& rules, HeldBatch& batch) {
  bench::count(bench::of_contact, [&] {
    for (int first = 0; first < batch.count; ++first) held::ordinary_nodes<simd::Counted>(rules, batch, first);
  });
}

}  // namespace abut::contact::sse2
