// log, exp, pow and an arctangent over the number types, and a cube root: the same bits for double and for every Pack width, on every CPU.
//
// Only + - * /, comparison and operations on the bits of a double are used, so that the result does not depend on libm
// or on the instruction set. Method: x = 2^k m with m in [sqrt(1/2), sqrt(2)), ln(m) = 2 atanh((m - 1)/(m + 1)) by its series, e^r by its
// Taylor polynomial on |r| <= ln(2)/2. x^y = 2^(y k + y log2(m)): the product with k, the only large one, is exact in two parts, what
// is left of the exponent is below one half. Relative errors, measured against 80-bit arithmetic in tests/unit/simd: log and exp below
// 1e-15, pow below 4e-16 (1 + |y|): exponents of hardening and softening laws are of the order of one.
//
// Subnormal numbers count as zero, as argument and as result, results below 2^-1021 too: log(0) = -inf, exp(x < -708) = 0.
#pragma once

#include <cstdint>

#include "simd/pack.hpp"

namespace abut::simd {

/// 64-bit words, one per lane.
template <class T>
struct BitsOf;
template <>
struct BitsOf<double> {
  using type = std::uint64_t;
};
template <>
struct BitsOf<Pack<2>> {
  typedef std::uint64_t type __attribute__((vector_size(16)));
};
template <>
struct BitsOf<Pack<4>> {
  typedef std::uint64_t type __attribute__((vector_size(32)));
};
template <>
struct BitsOf<Pack<8>> {
  typedef std::uint64_t type __attribute__((vector_size(64)));
};

ABUT_INLINE std::uint64_t to_bits(double a) { return __builtin_bit_cast(std::uint64_t, a); }
ABUT_INLINE double from_bits(double /*type*/, std::uint64_t u) { return __builtin_bit_cast(double, u); }
template <int W>
ABUT_INLINE typename BitsOf<Pack<W>>::type to_bits(Pack<W> a) {
  return (typename BitsOf<Pack<W>>::type)a.r;
}
template <int W>
ABUT_INLINE Pack<W> from_bits(Pack<W> /*type*/, typename BitsOf<Pack<W>>::type u) {
  return Pack<W>((typename VectorOf<W>::real)u);
}

namespace math {

inline constexpr double ln2_high = 0x1.62e42fefa38p-1;   // 42 bits: its product with an exponent is exact
inline constexpr double ln2_low = 0x1.ef35793c7673p-45;  // ln 2 - ln2_high
inline constexpr double ln2 = 0x1.62e42fefa39efp-1;
inline constexpr double inverse_ln2 = 0x1.71547652b82fep+0;
inline constexpr double round_magic = 0x1.8p52;  // adding and subtracting it rounds to an integer
inline constexpr double infinity = __builtin_huge_val();

/// ln(x) = k ln 2 + small + rest, |small| <= 0.35, for normal x > 0.
template <class T>
struct Logarithm {
  T k, small, rest;
};

template <class T>
ABUT_INLINE Logarithm<T> logarithm(T x) {
  // x = 2^k m with m in [sqrt(1/2), sqrt(2))
  const std::uint64_t root_half = 0x3fe6a09e667f3bcdULL;
  const auto shifted = to_bits(x) + (std::uint64_t{0x3ff0000000000000ULL} - root_half);
  const T k = from_bits(T(0.0), (shifted >> std::uint64_t{52}) | std::uint64_t{0x4330000000000000ULL}) - T(0x1p52 + 1023.0);
  const T m = from_bits(T(0.0), (shifted & std::uint64_t{0x000fffffffffffffULL}) + root_half);
  const T s = (m - T(1.0)) / (m + T(1.0));
  const T z = s * s, z2 = z * z, z4 = z2 * z2;  // z <= 0.0295: z^12 is out of sight
  const T low = (T(2.0 / 3.0) + T(2.0 / 5.0) * z) + (T(2.0 / 7.0) + T(2.0 / 9.0) * z) * z2;
  const T middle = (T(2.0 / 11.0) + T(2.0 / 13.0) * z) + (T(2.0 / 15.0) + T(2.0 / 17.0) * z) * z2;
  const T high = (T(2.0 / 19.0) + T(2.0 / 21.0) * z) + T(2.0 / 23.0) * z2;
  return {k, s + s, (s * z) * (low + z4 * (middle + z4 * high))};
}

/// 2^k e^r for |r| <= 0.35; `shifted` is k + round_magic, k <= 1024.
template <class T>
ABUT_INLINE T scaled_exp(T r, T shifted) {
  const T r2 = r * r, r4 = r2 * r2;
  const T low = (T(0.5) + T(1.0 / 6.0) * r) + (T(1.0 / 24.0) + T(1.0 / 120.0) * r) * r2;
  const T middle = (T(1.0 / 720.0) + T(1.0 / 5040.0) * r) + (T(1.0 / 40320.0) + T(1.0 / 362880.0) * r) * r2;
  const T high = (T(1.0 / 3628800.0) + T(1.0 / 39916800.0) * r) + (T(1.0 / 479001600.0) + T(1.0 / 6227020800.0) * r) * r2;
  const T e = T(1.0) + (r + r2 * (low + r4 * (middle + r4 * high)));
  // 2^(k-1), then doubled: k may be 1024.
  const T half_scale = from_bits(T(0.0), (to_bits(shifted) << std::uint64_t{52}) + std::uint64_t{0x3fe0000000000000ULL});
  return (e * half_scale) * T(2.0);
}

}  // namespace math

/// Natural logarithm; -inf at 0, NaN below.
template <class T>
ABUT_INLINE T log(T x) {
  const math::Logarithm<T> l = math::logarithm(x);
  const T y = l.k * T(math::ln2_high) + (l.small + (l.rest + l.k * T(math::ln2_low)));
  const T zero = T(0.0), smallest = T(0x1p-1022), inf = T(math::infinity);
  const T special = select(x < zero, inf - inf, select(x < smallest, -inf, x));
  return select((x >= smallest) & (x < inf), y, special);
}

template <class T>
ABUT_INLINE T exp(T x) {
  const T lowest = T(-708.0), highest = T(709.782712893384);
  const T c = max(lowest, min(highest, x));
  const T shifted = c * T(math::inverse_ln2) + T(math::round_magic);
  const T k = shifted - T(math::round_magic);
  const T y = math::scaled_exp((c - k * T(math::ln2_high)) - k * T(math::ln2_low), shifted);
  const T value = select(x < lowest, T(0.0), select(x > highest, T(math::infinity), y));
  return select(x >= T(-1e308), value, select(x < T(0.0), T(0.0), x));
}

/// x^y for x >= 0 and finite y; 0^y is 0 for y > 0, 1 for y = 0, inf for y < 0. NaN for x < 0.
template <class T>
ABUT_INLINE T pow(T x, T y) {
  const T zero = T(0.0), smallest = T(0x1p-1022), inf = T(math::infinity);
  const auto proper = (x >= smallest) & (x < inf);
  const math::Logarithm<T> l = math::logarithm(select(proper, x, T(1.0)));
  // 41 bits of y times at most 11 of k; the sum of both parts of the exponent is rounded to n, and what is left of it is exact but for u.
  const T spread = T(4097.0) * y;
  const T y_high = spread - (spread - y);
  const T t = y_high * l.k;
  const T u = y * ((l.small + l.rest) * T(math::inverse_ln2)) + (y - y_high) * l.k;
  const T exponent = max(T(-1100.0), min(T(1100.0), t + u));
  const T shifted = exponent + T(math::round_magic);
  const T n = shifted - T(math::round_magic);
  const T power = math::scaled_exp(((t - n) + u) * T(math::ln2), shifted);
  const T value = select(exponent < T(-1021.0), zero, select(exponent >= T(1024.0), inf, power));
  const T at_zero = select(y > zero, zero, select(y < zero, inf, T(1.0)));
  const T at_infinity = select(y > zero, inf, select(y < zero, zero, T(1.0)));
  const T special = select(x < zero, inf - inf, select(x < smallest, at_zero, select(x >= inf, at_infinity, x)));
  return select(proper, value, special);
}

/// x^(-1/3) of a normal number x > 0: x = r 2^(3 n) with r in [1/2, 4), then Newton's steps y -> y (4 - r y^3)/3.
ABUT_INLINE double inverse_cube_root(double x) {
  const std::uint64_t bits = to_bits(x);
  const int exponent = static_cast<int>(bits >> 52) - 1022;
  const int n = exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
  const double m = from_bits(x, (bits & std::uint64_t{0x000fffffffffffffULL}) | std::uint64_t{0x3fe0000000000000ULL});  // in [1/2, 1)
  const double r = m * static_cast<double>(1 << (exponent - 3 * n));
  double y = 0.8;
  for (int i = 0; i < 60; ++i) y = y * (4.0 - r * y * y * y) * (1.0 / 3.0);
  return y * from_bits(x, static_cast<std::uint64_t>(1023 - n) << 52);
}

/// Angle of the point (x, y) from the x axis, 0 to pi, for y >= 0; 0 at the origin. atan2 of a finite y >= 0 to about 5e-16 relative:
/// the ratio in [0, 1] is halved twice in angle, t -> t/(1 + sqrt(1 + t^2)), then the series of the arctangent is summed.
template <class T>
ABUT_INLINE T angle_of(T x, T y) {
  const T zero = T(0.0), one = T(1.0);
  const T ax = abs(x), small = min(ax, y), large = max(ax, y);
  const auto proper = large > zero;
  T t = select(proper, small / select(proper, large, one), zero);
  for (int i = 0; i < 2; ++i) t = t / (one + sqrt(one + t * t));
  const T tt = t * t;  // at most tan(pi/16)^2 = 0.0396
  T sum = T(1.0 / 23.0);
  for (int k = 21; k >= 1; k -= 2) sum = T(1.0 / k) - tt * sum;
  constexpr double pi = 0x1.921fb54442d18p+1;
  T angle = T(4.0) * (t * sum);
  angle = select(y > ax, T(0.5 * pi) - angle, angle);
  return select(x < zero, T(pi) - angle, angle);
}

}  // namespace abut::simd
