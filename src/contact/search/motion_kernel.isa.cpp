#include "contact/search/motion_kernel.hpp"

#include "simd/four.hpp"
#include "simd/isa_object.hpp"

namespace abut::contact::ABUT_ISA {

namespace {

using simd::Four;
using V = simd::Triple<Four>;

ABUT_INLINE V all(const double* a) { return {Four(a[0]), Four(a[1]), Four(a[2])}; }
ABUT_INLINE Four square(const V& a) { return dot(a, a); }
ABUT_INLINE double largest(Four a) {
  double each[4];
  simd::store(each, a);
  return simd::max(simd::max(each[0], each[1]), simd::max(each[2], each[3]));
}

}  // namespace

MotionPart motions(const MotionArgs& args, std::size_t begin, std::size_t end) {
  const Four zero(0.0), dt(args.dt);
  const V common[2] = {all(args.common[0]), all(args.common[1])};
  V sum{zero, zero, zero};
  Four of_all[2] = {zero, zero};
  for (std::size_t first = begin; first < end; first += MotionArgs::block) {
    const std::size_t last = first + MotionArgs::block < end ? first + MotionArgs::block : end;
    Four of_block = zero;
    const auto four = [&](std::size_t i, const std::int32_t(&own)[4], const std::int32_t(&host)[4]) {
      const V d = simd::gather3(args.x + 3 * i, own, Four()) - simd::gather3(args.before + 3 * i, own, Four());
      for (int k = 0; k < 2; ++k) {
        const Four s = square(d - common[k]);
        of_all[k] = simd::max(of_all[k], s);
        if (k == args.facing) of_block = simd::max(of_block, s);
      }
      of_block = simd::max(of_block, square(dt * simd::gather3(args.v, host, Four()) - common[args.facing]));
      return d;
    };
    std::size_t i = first;
    for (; i + 4 <= last; i += 4) {
      const std::int32_t* node = args.node + i;
      sum = sum + four(i, {0, 3, 6, 9}, {3 * node[0], 3 * node[1], 3 * node[2], 3 * node[3]});
    }
    if (i < last) {
      // Places beyond the last node repeat it; the sum leaves them out.
      std::int32_t own[4], host[4];
      double counts[4];
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t n = i + k < last ? i + k : last - 1;
        own[k] = static_cast<std::int32_t>(3 * (n - i));
        host[k] = 3 * args.node[n];
        counts[k] = i + k < last ? 1.0 : 0.0;
      }
      sum = sum + simd::load4(counts) * four(i, own, host);
    }
    args.of_block[first / MotionArgs::block] = largest(of_block);
  }
  MotionPart part;
  const Four sums[3] = {sum.x, sum.y, sum.z};
  for (int k = 0; k < 3; ++k) {
    double each[4];
    simd::store(each, sums[k]);
    part.sum[k] = ((each[0] + each[1]) + each[2]) + each[3];
  }
  for (int k = 0; k < 2; ++k) part.largest[k] = largest(of_all[k]);
  return part;
}

}  // namespace abut::contact::ABUT_ISA
