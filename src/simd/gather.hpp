// Gathering node vectors (#N by 3, 24 bytes apart) into number types: the first visible step of every element kernel.
//
// A lane's (x, y) and (y, z) are read as two 16-byte pieces, so nothing outside the node's own 24 bytes is touched; pieces
// of two lanes are joined while they are loaded and one shuffle per component and register does the rest.
#pragma once

#include <cstdint>

#include "simd/pack.hpp"

namespace abut::simd {

template <class R>
struct Triple {
  R x, y, z;
};

template <class R>
ABUT_INLINE Triple<R> operator+(const Triple<R>& a, const Triple<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
ABUT_INLINE Triple<R> operator-(const Triple<R>& a, const Triple<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
ABUT_INLINE Triple<R> operator*(R s, const Triple<R>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class R>
ABUT_INLINE R dot(const Triple<R>& a, const Triple<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
ABUT_INLINE Triple<R> cross(const Triple<R>& a, const Triple<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The same pointer, of whose target the compiler knows nothing: it loads a list of offsets again for the next array instead of keeping
/// all of it on the stack.
template <class T>
ABUT_INLINE const T* forgotten(const T* p) {
  asm("" : "+r"(p));
  return p;
}

typedef double Pair __attribute__((vector_size(16)));

ABUT_INLINE Pair load_pair(const double* p) {
  Pair a;
  __builtin_memcpy(&a, p, sizeof(a));
  return a;
}

/// Vectors of `array` whose first doubles stand at `offset[0..W)` (three times the node's index: the multiplication is done once, at
/// set-up).
ABUT_INLINE Triple<double> gather3(const double* array, const std::int32_t* offset, double /*type*/) {
  const double* p = array + offset[0];
  return {p[0], p[1], p[2]};
}

ABUT_INLINE Triple<Pack<2>> gather3(const double* array, const std::int32_t* offset, Pack<2> /*type*/) {
  const double* p = array + offset[0];
  const double* q = array + offset[1];
  const Pair a = load_pair(p), b = load_pair(q);
  const Pair c = load_pair(p + 1), d = load_pair(q + 1);
  return {Pack<2>(__builtin_shufflevector(a, b, 0, 2)), Pack<2>(__builtin_shufflevector(a, b, 1, 3)),
          Pack<2>(__builtin_shufflevector(c, d, 1, 3))};
}

/// Two doubles from p, two from q.
ABUT_INLINE VectorOf<4>::real join(const double* p, const double* q) {
#if defined(__AVX__)
  // As an intrinsic the second piece is loaded by the instruction that joins them.
  return (VectorOf<4>::real)_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p)), _mm_loadu_pd(q), 1);
#else
  return __builtin_shufflevector(load_pair(p), load_pair(q), 0, 1, 2, 3);
#endif
}

ABUT_INLINE Triple<Pack<4>> gather3(const double* array, const std::int32_t* offset, Pack<4> /*type*/) {
  const double* p0 = array + offset[0];
  const double* p1 = array + offset[1];
  const double* p2 = array + offset[2];
  const double* p3 = array + offset[3];
  const auto a = join(p0, p2), b = join(p1, p3), c = join(p0 + 1, p2 + 1), d = join(p1 + 1, p3 + 1);
  return {Pack<4>(__builtin_shufflevector(a, b, 0, 4, 2, 6)), Pack<4>(__builtin_shufflevector(a, b, 1, 5, 3, 7)),
          Pack<4>(__builtin_shufflevector(c, d, 1, 5, 3, 7))};
}

ABUT_INLINE Triple<Pack<8>> gather3(const double* array, const std::int32_t* offset, Pack<8> /*type*/) {
  const Triple<Pack<4>> a = gather3(array, offset, Pack<4>());
  const Triple<Pack<4>> b = gather3(array, offset + 4, Pack<4>());
  return {Pack<8>(__builtin_shufflevector(a.x.r, b.x.r, 0, 1, 2, 3, 4, 5, 6, 7)),
          Pack<8>(__builtin_shufflevector(a.y.r, b.y.r, 0, 1, 2, 3, 4, 5, 6, 7)),
          Pack<8>(__builtin_shufflevector(a.z.r, b.z.r, 0, 1, 2, 3, 4, 5, 6, 7))};
}

}  // namespace abut::simd
