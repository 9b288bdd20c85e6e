#include "simd/isa.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace abut::simd {

namespace {

bool has(Isa isa) {
  switch (isa) {
    case Isa::sse2:
      return true;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
  return false;
}

Isa choose() {
  if (const char* asked = std::getenv("ABUT_ISA"); asked != nullptr && *asked != '\0') {
    for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512}) {
      if (name(isa) != asked) continue;
      if (!has(isa)) throw std::runtime_error("ABUT_ISA=" + std::string(asked) + ": this CPU does not have it");
      return isa;
    }
    throw std::runtime_error("ABUT_ISA=" + std::string(asked) + ": unknown; use sse2, avx2 or avx512");
  }
  // AVX-512 by itself only where there is VBMI2 too (Intel since Ice Lake, AMD since Zen 4): older processors lower their clock for it.
  if (has(Isa::avx512) && __builtin_cpu_supports("avx512vbmi2") != 0) return Isa::avx512;
  return has(Isa::avx2) ? Isa::avx2 : Isa::sse2;
}

}  // namespace

std::string_view name(Isa isa) {
  switch (isa) {
    case Isa::sse2:
      return "sse2";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
  }
  return "?";
}

Isa active_isa() {
  static const Isa isa = choose();
  return isa;
}

}  // namespace abut::simd
