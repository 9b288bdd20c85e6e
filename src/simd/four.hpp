// Four doubles, whatever the registers hold: passes over nodes and over motions go by four for every instruction set, so that their sums
// have one order.
//
// Where registers hold four or more, Four is Pack<4>; where they hold two, it is two of them side by side, which the compiler keeps in
// registers (a Pack<4> that is no register goes through memory).
#pragma once

#include "simd/gather.hpp"

namespace abut::simd {

#if defined(__AVX__)

using Four = Pack<4>;

/// (p[0], p[1], p[2], fourth)
ABUT_INLINE Four load3(const double* p, double fourth) {
  return Four(__builtin_shufflevector(load_pair(p), Pair{p[2], fourth}, 0, 1, 2, 3));
}
/// The first three.
ABUT_INLINE void store3(double* p, Four a) {
  const Pair low = __builtin_shufflevector(a.r, a.r, 0, 1);
  __builtin_memcpy(p, &low, sizeof(low));
  p[2] = a.r[2];
}
ABUT_INLINE double fourth(Four a) { return a.r[3]; }
ABUT_INLINE Four load4(const double* p) { return load<4>(p); }
/// Rows become columns.
ABUT_INLINE void transpose(Four (&m)[4]) {
  const auto a = __builtin_shufflevector(m[0].r, m[1].r, 0, 4, 2, 6), b = __builtin_shufflevector(m[0].r, m[1].r, 1, 5, 3, 7);
  const auto c = __builtin_shufflevector(m[2].r, m[3].r, 0, 4, 2, 6), d = __builtin_shufflevector(m[2].r, m[3].r, 1, 5, 3, 7);
  m[0] = Four(__builtin_shufflevector(a, c, 0, 1, 4, 5));
  m[1] = Four(__builtin_shufflevector(b, d, 0, 1, 4, 5));
  m[2] = Four(__builtin_shufflevector(a, c, 2, 3, 6, 7));
  m[3] = Four(__builtin_shufflevector(b, d, 2, 3, 6, 7));
}
/// s0 s0 s0 s1 | s1 s1 s2 s2 | s2 s3 s3 s3
ABUT_INLINE Triple<Four> spread(const double* s) {
  const auto r = load<4>(s).r;
  return {Four(__builtin_shufflevector(r, r, 0, 0, 0, 1)), Four(__builtin_shufflevector(r, r, 1, 1, 2, 2)),
          Four(__builtin_shufflevector(r, r, 2, 3, 3, 3))};
}

#else

// The same vocabulary with two registers.
struct FourMask {
  Mask<2> low, high;
};

struct Four {
  Pack<2> low, high;

  Four() = default;
  [[gnu::always_inline]] inline Four(double s) : low(s), high(s) {}  // NOLINT: broadcast
  [[gnu::always_inline]] inline Four(Pack<2> l, Pack<2> h) : low(l), high(h) {}

  [[gnu::always_inline]] friend inline Four operator+(Four a, Four b) { return {a.low + b.low, a.high + b.high}; }
  [[gnu::always_inline]] friend inline Four operator-(Four a, Four b) { return {a.low - b.low, a.high - b.high}; }
  [[gnu::always_inline]] friend inline Four operator*(Four a, Four b) { return {a.low * b.low, a.high * b.high}; }
  [[gnu::always_inline]] friend inline Four operator/(Four a, Four b) { return {a.low / b.low, a.high / b.high}; }
  [[gnu::always_inline]] inline Four& operator+=(Four b) { return *this = *this + b; }
  [[gnu::always_inline]] friend inline FourMask operator<(Four a, Four b) { return {a.low < b.low, a.high < b.high}; }
};

ABUT_INLINE bool any(FourMask a) { return any(a.low | a.high); }
ABUT_INLINE Four max(Four a, Four b) { return {max(a.low, b.low), max(a.high, b.high)}; }

ABUT_INLINE Four load4(const double* p) { return {load<2>(p), load<2>(p + 2)}; }
ABUT_INLINE void store(double* p, Four a) {
  store(p, a.low);
  store(p + 2, a.high);
}
ABUT_INLINE Four load3(const double* p, double fourth) { return {load<2>(p), Pack<2>(Pair{p[2], fourth})}; }
ABUT_INLINE void store3(double* p, Four a) {
  store(p, a.low);
  p[2] = a.high.r[0];
}
ABUT_INLINE double fourth(Four a) { return a.high.r[1]; }
ABUT_INLINE Triple<Four> spread(const double* s) {
  const Pair a = load_pair(s), b = load_pair(s + 2);
  const Pack<2> s0(__builtin_shufflevector(a, a, 0, 0)), s1(__builtin_shufflevector(a, a, 1, 1));
  const Pack<2> s2(__builtin_shufflevector(b, b, 0, 0)), s3(__builtin_shufflevector(b, b, 1, 1));
  return {{s0, Pack<2>(a)}, {s1, s2}, {Pack<2>(b), s3}};
}
ABUT_INLINE void transpose(Four (&m)[4]) {
  const auto both = [](Pack<2> p, Pack<2> q, int k) {
    return Pack<2>(k == 0 ? __builtin_shufflevector(p.r, q.r, 0, 2) : __builtin_shufflevector(p.r, q.r, 1, 3));
  };
  const Four a = m[0], b = m[1], c = m[2], d = m[3];
  m[0] = {both(a.low, b.low, 0), both(c.low, d.low, 0)};
  m[1] = {both(a.low, b.low, 1), both(c.low, d.low, 1)};
  m[2] = {both(a.high, b.high, 0), both(c.high, d.high, 0)};
  m[3] = {both(a.high, b.high, 1), both(c.high, d.high, 1)};
}
ABUT_INLINE Triple<Four> gather3(const double* array, const std::int32_t* offset, Four /*type*/) {
  const Triple<Pack<2> > a = gather3(array, offset, Pack<2>()), b = gather3(array, offset + 2, Pack<2>());
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}

#endif

}  // namespace abut::simd
