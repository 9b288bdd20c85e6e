// The instruction sets that kernels are built for, and the one that this process uses.
#pragma once

#include <string_view>

namespace abut::simd {

enum class Isa { sse2, avx2, avx512 };

/// The widest set that this CPU has, or the one that ABUT_ISA=sse2|avx2|avx512 in the environment asks for.
/// @throws std::runtime_error when ABUT_ISA is unknown or names a set that this CPU lacks
[[nodiscard]] Isa active_isa();
[[nodiscard]] std::string_view name(Isa isa);

/// Of a kernel that is built once per set, the one of the active set.
template <class Kernel>
[[nodiscard]] Kernel of_active_isa(Kernel sse2, Kernel avx2, Kernel avx512) {
  switch (active_isa()) {
    case Isa::avx512:
      return avx512;
    case Isa::avx2:
      return avx2;
    case Isa::sse2:
      break;
  }
  return sse2;
}

}  // namespace abut::simd
