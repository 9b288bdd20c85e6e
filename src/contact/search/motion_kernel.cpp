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

MotionKernel motion_kernel() { return simd::of_active_isa(sse2::motions, avx2::motions, avx512::motions); }

}  // namespace abut::contact
