// The solid kernels of each instruction set (built from *.isa.cpp) and their choice.
#pragma once

#include "elements/solid/solid_layout.hpp"
#include "simd/isa.hpp"

namespace abut::elements {

namespace sse2 {
void brick8(const SolidTask& task);
void tetra4(const SolidTask& task);
}  // namespace sse2
namespace avx2 {
void brick8(const SolidTask& task);
void tetra4(const SolidTask& task);
}  // namespace avx2
namespace avx512 {
void brick8(const SolidTask& task);
void tetra4(const SolidTask& task);
}  // namespace avx512

[[nodiscard]] inline SolidKernel brick8_kernel(simd::Isa isa) {
  switch (isa) {
    case simd::Isa::sse2:
      return sse2::brick8;
    case simd::Isa::avx2:
      return avx2::brick8;
    case simd::Isa::avx512:
      return avx512::brick8;
  }
  return sse2::brick8;
}

[[nodiscard]] inline SolidKernel tetra4_kernel(simd::Isa isa) {
  switch (isa) {
    case simd::Isa::sse2:
      return sse2::tetra4;
    case simd::Isa::avx2:
      return avx2::tetra4;
    case simd::Isa::avx512:
      return avx512::tetra4;
  }
  return sse2::tetra4;
}

}  // namespace abut::elements
