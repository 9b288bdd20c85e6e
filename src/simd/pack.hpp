// The number types that kernels are templated on: `double` in unit tests and set-up, Pack<W> in production.
//
// A Pack<W> is W doubles in one vector register (compiler vector extensions, GCC and clang). Only + - * / sqrt,
// comparison and selection exist: every operation is correctly rounded per lane, so that all widths give the same bits
// (with -ffp-contract=off). Objects built per instruction set may include only this header, kernel headers and
// <cstddef>/<cstdint>/<cmath>-free code, so that they export no inline symbol of a common library (docs/determinism.md).
//
// Every function is always inlined: nothing of it may survive as a weak symbol that another object could pick up.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define ABUT_INLINE [[gnu::always_inline]] static inline

namespace abut::simd {

template <int W>
struct VectorOf;
template <>
struct VectorOf<2> {
  typedef double real __attribute__((vector_size(16)));
  typedef std::int64_t mask __attribute__((vector_size(16)));
};
template <>
struct VectorOf<4> {
  typedef double real __attribute__((vector_size(32)));
  typedef std::int64_t mask __attribute__((vector_size(32)));
};
template <>
struct VectorOf<8> {
  typedef double real __attribute__((vector_size(64)));
  typedef std::int64_t mask __attribute__((vector_size(64)));
};

template <int W>
struct Mask {
  typename VectorOf<W>::mask m;
};

/// W doubles. Arithmetic is lane by lane; a plain double broadcasts.
template <int W>
struct Pack {
  static constexpr int width = W;
  typename VectorOf<W>::real r;

  Pack() = default;
  [[gnu::always_inline]] inline Pack(double s) : r(s - typename VectorOf<W>::real{}) {}  // NOLINT: broadcast
  [[gnu::always_inline]] inline explicit Pack(typename VectorOf<W>::real v) : r(v) {}

  [[gnu::always_inline]] friend inline Pack operator+(Pack a, Pack b) { return Pack(a.r + b.r); }
  [[gnu::always_inline]] friend inline Pack operator-(Pack a, Pack b) { return Pack(a.r - b.r); }
  [[gnu::always_inline]] friend inline Pack operator*(Pack a, Pack b) { return Pack(a.r * b.r); }
  [[gnu::always_inline]] friend inline Pack operator/(Pack a, Pack b) { return Pack(a.r / b.r); }
  [[gnu::always_inline]] friend inline Pack operator-(Pack a) { return Pack(-a.r); }
  [[gnu::always_inline]] inline Pack& operator+=(Pack b) {
    r += b.r;
    return *this;
  }
  [[gnu::always_inline]] inline Pack& operator-=(Pack b) {
    r -= b.r;
    return *this;
  }
  [[gnu::always_inline]] inline Pack& operator*=(Pack b) {
    r *= b.r;
    return *this;
  }
  [[gnu::always_inline]] friend inline Mask<W> operator<(Pack a, Pack b) { return {a.r < b.r}; }
  [[gnu::always_inline]] friend inline Mask<W> operator<=(Pack a, Pack b) { return {a.r <= b.r}; }
  [[gnu::always_inline]] friend inline Mask<W> operator>(Pack a, Pack b) { return {a.r > b.r}; }
  [[gnu::always_inline]] friend inline Mask<W> operator>=(Pack a, Pack b) { return {a.r >= b.r}; }
};

template <int W>
ABUT_INLINE Mask<W> operator&(Mask<W> a, Mask<W> b) {
  return {a.m & b.m};
}
template <int W>
ABUT_INLINE Mask<W> operator|(Mask<W> a, Mask<W> b) {
  return {a.m | b.m};
}
template <int W>
ABUT_INLINE Mask<W> operator!(Mask<W> a) {
  return {~a.m};
}

/// c ? a : b, lane by lane.
template <int W>
ABUT_INLINE Pack<W> select(Mask<W> c, Pack<W> a, Pack<W> b) {
  return Pack<W>(c.m ? a.r : b.r);
}
template <int W>
ABUT_INLINE bool any(Mask<W> a) {
  if constexpr (W == 2) {
#if defined(__SSE2__)
    return _mm_movemask_pd((__m128d)a.m) != 0;
#endif
  } else if constexpr (W == 4) {
#if defined(__AVX__)
    return _mm256_movemask_pd((__m256d)a.m) != 0;
#endif
  } else {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)a.m, (__m512i)a.m) != 0;
#endif
  }
  std::int64_t s = 0;
  for (int i = 0; i < W; ++i) s |= a.m[i];
  return s != 0;
}

template <int W>
ABUT_INLINE Pack<W> sqrt(Pack<W> a) {
  Pack<W> b;
  if constexpr (W == 2) {
#if defined(__SSE2__)
    b.r = (typename VectorOf<2>::real)_mm_sqrt_pd((__m128d)a.r);
    return b;
#endif
  } else if constexpr (W == 4) {
#if defined(__AVX__)
    b.r = (typename VectorOf<4>::real)_mm256_sqrt_pd((__m256d)a.r);
    return b;
#endif
  } else {
#if defined(__AVX512F__)
    // The zero-masked form: the plain one makes GCC 12 warn of an uninitialised register (GCC bug 105593).
    b.r = (typename VectorOf<8>::real)_mm512_maskz_sqrt_pd(static_cast<__mmask8>(0xff), (__m512d)a.r);
    return b;
#endif
  }
  for (int i = 0; i < W; ++i) b.r[i] = __builtin_sqrt(a.r[i]);
  return b;
}
// max, min and abs as the instructions have them: max is b where a < b, else a; min is b where b < a, else a (a where one is not a number).
template <int W>
ABUT_INLINE Pack<W> max(Pack<W> a, Pack<W> b) {
  if constexpr (W == 2) {
#if defined(__SSE2__)
    return Pack<W>((typename VectorOf<W>::real)_mm_max_pd((__m128d)b.r, (__m128d)a.r));
#endif
  } else if constexpr (W == 4) {
#if defined(__AVX__)
    return Pack<W>((typename VectorOf<W>::real)_mm256_max_pd((__m256d)b.r, (__m256d)a.r));
#endif
  } else {
#if defined(__AVX512F__)
    return Pack<W>((typename VectorOf<W>::real)_mm512_maskz_max_pd(static_cast<__mmask8>(0xff), (__m512d)b.r, (__m512d)a.r));
#endif
  }
  return select(a < b, b, a);
}
template <int W>
ABUT_INLINE Pack<W> min(Pack<W> a, Pack<W> b) {
  if constexpr (W == 2) {
#if defined(__SSE2__)
    return Pack<W>((typename VectorOf<W>::real)_mm_min_pd((__m128d)b.r, (__m128d)a.r));
#endif
  } else if constexpr (W == 4) {
#if defined(__AVX__)
    return Pack<W>((typename VectorOf<W>::real)_mm256_min_pd((__m256d)b.r, (__m256d)a.r));
#endif
  } else {
#if defined(__AVX512F__)
    return Pack<W>((typename VectorOf<W>::real)_mm512_maskz_min_pd(static_cast<__mmask8>(0xff), (__m512d)b.r, (__m512d)a.r));
#endif
  }
  return select(b < a, b, a);
}
/// Without the sign bit: abs(-0) is 0.
template <int W>
ABUT_INLINE Pack<W> abs(Pack<W> a) {
  constexpr std::int64_t magnitude = 0x7fffffffffffffff;
  return Pack<W>((typename VectorOf<W>::real)((typename VectorOf<W>::mask)a.r & magnitude));
}

template <int W>
ABUT_INLINE Pack<W> load(const double* p) {
  Pack<W> a;
  __builtin_memcpy(&a.r, p, sizeof(a.r));
  return a;
}
template <int W>
ABUT_INLINE void store(double* p, Pack<W> a) {
  __builtin_memcpy(p, &a.r, sizeof(a.r));
}

// The same vocabulary for plain doubles.
ABUT_INLINE double select(bool c, double a, double b) { return c ? a : b; }
ABUT_INLINE bool any(bool a) { return a; }
ABUT_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
ABUT_INLINE double max(double a, double b) { return a < b ? b : a; }
ABUT_INLINE double min(double a, double b) { return b < a ? b : a; }
ABUT_INLINE double abs(double a) { return __builtin_fabs(a); }

template <class T>
struct NumberTraits {
  static constexpr int width = T::width;
  [[gnu::always_inline]] static inline T load(const double* p) { return simd::load<T::width>(p); }
  [[gnu::always_inline]] static inline void store(double* p, T a) { simd::store<T::width>(p, a); }
};
template <>
struct NumberTraits<double> {
  static constexpr int width = 1;
  [[gnu::always_inline]] static inline double load(const double* p) { return *p; }
  [[gnu::always_inline]] static inline void store(double* p, double a) { *p = a; }
};

}  // namespace abut::simd
