// A double that counts what is done with it: the number type with which the production kernels say how many operations they need.
//
// Include before the kernels' headers. One thread only. A comparison, a selection, a minimum, a maximum and a change of sign count as one
// operation each, as they are one instruction.
#pragma once

#include <cstdint>

#include "simd/gather.hpp"
#include "simd/math.hpp"
#include "simd/pack.hpp"

namespace abut::simd {

struct Operations {
  double simple = 0.0;  ///< + - * and what is as cheap
  double divisions = 0.0, roots = 0.0;
};
inline Operations operations;

struct CountedMask {
  bool m = false;
  friend CountedMask operator&(CountedMask a, CountedMask b) { return {a.m && b.m}; }
  friend CountedMask operator|(CountedMask a, CountedMask b) { return {a.m || b.m}; }
  friend CountedMask operator!(CountedMask a) { return {!a.m}; }
};
inline bool any(CountedMask a) { return a.m; }

struct Counted {
  static constexpr int width = 1;
  double r = 0.0;

  Counted() = default;
  Counted(double value) : r(value) {}  // NOLINT: broadcast, as the packs do it

  static Counted simple(double value) {
    operations.simple += 1.0;
    return {value};
  }
  friend Counted operator+(Counted a, Counted b) { return simple(a.r + b.r); }
  friend Counted operator-(Counted a, Counted b) { return simple(a.r - b.r); }
  friend Counted operator*(Counted a, Counted b) { return simple(a.r * b.r); }
  friend Counted operator-(Counted a) { return simple(-a.r); }
  friend Counted operator/(Counted a, Counted b) {
    operations.divisions += 1.0;
    return {a.r / b.r};
  }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend CountedMask operator<(Counted a, Counted b) { return {simple(a.r).r < b.r}; }
  friend CountedMask operator<=(Counted a, Counted b) { return {simple(a.r).r <= b.r}; }
  friend CountedMask operator>(Counted a, Counted b) { return {simple(a.r).r > b.r}; }
  friend CountedMask operator>=(Counted a, Counted b) { return {simple(a.r).r >= b.r}; }
};

inline Counted select(CountedMask c, Counted a, Counted b) { return Counted::simple(c.m ? a.r : b.r); }
inline Counted max(Counted a, Counted b) { return Counted::simple(max(a.r, b.r)); }
inline Counted min(Counted a, Counted b) { return Counted::simple(min(a.r, b.r)); }
inline Counted abs(Counted a) { return Counted::simple(abs(a.r)); }
inline Counted sqrt(Counted a) {
  operations.roots += 1.0;
  return {sqrt(a.r)};
}

template <>
struct NumberTraits<Counted> {
  static constexpr int width = 1;
  static Counted load(const double* p) { return {*p}; }
  static void store(double* p, Counted a) { *p = a.r; }
};

inline Triple<Counted> gather3(const double* array, const std::int32_t* offset, Counted /*type*/) {
  const double* p = array + offset[0];
  return {{p[0]}, {p[1]}, {p[2]}};
}

template <>
struct BitsOf<Counted> {
  using type = std::uint64_t;
};
inline std::uint64_t to_bits(Counted a) { return to_bits(a.r); }
inline Counted from_bits(Counted /*type*/, std::uint64_t u) { return {from_bits(0.0, u)}; }

}  // namespace abut::simd
