// Included by the sources that are built once per instruction set (*.isa.cpp); the build defines ABUT_ISA (the namespace,
// e.g. avx2) and ABUT_ISA_WIDTH (doubles per register; 1: plain doubles, see ABUT_SCALAR). Such sources include no standard library header.
#pragma once

#include "simd/pack.hpp"

#if !defined(ABUT_ISA) || !defined(ABUT_ISA_WIDTH)
#error "build this file with abut_stage() (cmake/AbutStage.cmake)"
#endif

namespace abut::simd::ABUT_ISA {
#if ABUT_ISA_WIDTH == 1
using Real = double;
#else
using Real = Pack<ABUT_ISA_WIDTH>;
#endif
}  // namespace abut::simd::ABUT_ISA
