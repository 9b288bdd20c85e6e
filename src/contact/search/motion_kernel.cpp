#include "contact/search/motion_kernel.hpp"

#include "simd/isa.hpp"

namespace abut::contact {

// motion_kernel.isa.cpp, once per instruction set
namespace sse2 {
MotionPart motions(const MotionArgs& args, std::size_t begin, std::size_t end);
}
namespace avx2 {
MotionPart motions(const MotionArgs& args, std::size_t begin, std::size_t end);
}
namespace avx512 {
MotionPart motions(const MotionArgs& args, std::size_t begin, std::size_t end);
}

MotionKernel motion_kernel() {
  switch (simd::active_isa()) {
    case simd::Isa::avx512:
      return avx512::motions;
    case simd::Isa::avx2:
      return avx2::motions;
    case simd::Isa::sse2:
      break;
  }
  return sse2::motions;
}

}  // namespace abut::contact
