// LAW2 in plane stress: Johnson-Cook hardening with three return mappings, at one thickness point.
//
// Equation contract (numerics.md 5.2; Johnson and Cook 1983; Simo and Taylor, IJNME 22 (1986) 649):
//   Y = min(sigma_max*, (a + (1 - chi) b p^n) Q),   Q = (1 + c ln(max(rate, rate_0)/rate_0)) (1 - T*^m),   Q >= 1e-20
//   H = n b Q (p + 1e-7)^(n-1), 0 where Y is capped; sigma_max* = sigma_max Q for ICC 1, sigma_max for ICC 2
//   radial (Iplas 0, 2), iterative (Iplas 1: Newton, three passes, the result of the third is not used) and approximate
//   normal projection (Iplas 3); kinematic part: the mapping acts on xi = trial - X, then X += chi H dp/Y xi.
// p: equivalent plastic strain. All mappings take the in-plane trial stress only; transverse shear stays elastic.
//
// Where the iterative form differs from a converged Newton: two corrections, H kept at its first value, and an increment
// that the bracket has set to zero stays zero, i.e. the trial stress is accepted for that cycle (reference behaviour).
#pragma once

#include "simd/math.hpp"
#include "simd/pack.hpp"

namespace abut::materials {

// Found for double too, where argument-dependent lookup finds nothing.
using simd::abs;
using simd::max;
using simd::min;
using simd::select;
using simd::sqrt;

/// Constants of the law; consistent units of the deck. `b_isotropic` = (1 - chi) b.
struct ShellJohnsonCook {
  double young = 0.0, poisson = 0.0, shear = 0.0;
  double a = 0.0, b = 0.0, b_isotropic = 0.0, n = 1.0;
  double eps_max = 1e20, sigma_max = 1e20;
  double c = 0.0, inverse_rate_0 = 0.0, rate_0 = 0.0;
  int icc = 1;
  double chi = 0.0;
  double m = 1.0, t_ref = 300.0, inverse_t_range = 0.0, inverse_rho_cp = 0.0, t_max = 1e20;
  int mapping = 2;  ///< 1 iterative, 2 radial, 3 approximate normal
};

template <class T>
struct PlaneStress {
  T xx, yy, xy;
};

/// State after a return mapping: `stress` (xi where chi > 0), plastic increment, in-plane plastic dilatation, Y used for the
/// scaling, and the hardening a + (1 - chi) b p^n at the new p.
template <class T>
struct PlasticUpdate {
  PlaneStress<T> stress;
  T increment, dilatation, yield, hardening;
};

template <class T>
ABUT_INLINE T von_mises_squared(const PlaneStress<T>& s) {
  return s.xx * s.xx + s.yy * s.yy - s.xx * s.yy + T(3.0) * (s.xy * s.xy);
}

/// a + (1 - chi) b p^n
template <class T>
ABUT_INLINE T hardening(const ShellJohnsonCook& law, T p) {
  if (law.b_isotropic == 0.0) return T(law.a);
  if (law.n == 1.0) return T(law.a) + T(law.b_isotropic) * p;
  return T(law.a) + T(law.b_isotropic) * simd::pow(p, T(law.n));
}

/// n b Q (p + 1e-7)^(n-1)
template <class T>
ABUT_INLINE T slope(const ShellJohnsonCook& law, T p, T q) {
  if (law.b == 0.0) return T(0.0);
  if (law.n == 1.0) return T(law.b) * q;
  return T(law.n * law.b) * q * simd::pow(p + T(1e-7), T(law.n - 1.0));
}

/// 1 + c ln(max(rate, rate_0)/rate_0)
template <class T>
ABUT_INLINE T rate_factor(const ShellJohnsonCook& law, T rate) {
  const auto above = rate > T(law.rate_0);
  if (!simd::any(above)) return T(1.0);
  return select(above, T(1.0) + T(law.c) * simd::log(rate * T(law.inverse_rate_0)), T(1.0));
}

/// 1 - T*^m
template <class T>
ABUT_INLINE T temperature_factor(const ShellJohnsonCook& law, T temperature) {
  const T star = max((temperature - T(law.t_ref)) * T(law.inverse_t_range), T(0.0));
  if (!simd::any(star > T(0.0))) return T(1.0);
  return T(1.0) - (law.m == 1.0 ? star : simd::pow(star, T(law.m)));
}

template <class T>
ABUT_INLINE PlasticUpdate<T> radial_return(const ShellJohnsonCook& law, const PlaneStress<T>& trial, T mises, T yield, T p, T activity) {
  const T ratio = yield / mises;
  PlasticUpdate<T> u;
  u.stress = {ratio * trial.xx, ratio * trial.yy, ratio * trial.xy};
  u.increment = (mises - yield) * T(1.0 / law.young) * activity;
  u.dilatation = u.increment * T(0.5) * (u.stress.xx + u.stress.yy) / yield;
  u.yield = yield;
  u.hardening = hardening(law, p + u.increment);
  return u;
}

template <class T>
ABUT_INLINE PlasticUpdate<T> iterative_return(const ShellJohnsonCook& law, const PlaneStress<T>& trial, T mises, T yield, T p, T q, T cap) {
  const T e = T(law.young), zero = T(0.0), one = T(1.0);
  const T sum = trial.xx + trial.yy, difference = trial.xx - trial.yy;
  const T a = T(0.25) * (sum * sum), b = T(0.75) * (difference * difference) + T(3.0) * (trial.xy * trial.xy);
  const T h = select(yield < cap, slope(law, p, q), zero);
  const T h_isotropic = T(1.0 - law.chi) * h;
  const T back = T(2.0 * law.chi / law.young) * h;
  const T nu_1 = T(1.0 / (1.0 - law.poisson)) + back, nu_2 = T(3.0 / (1.0 + law.poisson)) + back;
  T d = (mises - yield) / (T(3.0 * law.shear) + h);
  for (int pass = 0; pass < 2; ++pass) {
    const T y = min(cap, hardening(law, p + d) * q);
    const T r = T(0.5) * e * d / y;
    const T pp = one / (one + nu_1 * r), qq = one / (one + nu_2 * r);
    const T phi = a * pp * pp + b * qq * qq - y * y;
    const T slope_phi =
        -((a * pp * pp * pp * nu_1 + b * qq * qq * qq * nu_2) * (e - T(2.0) * r * h_isotropic) / y) - T(2.0) * h_isotropic * y;
    d = select(d > zero, max(d - phi / slope_phi, zero), zero);
  }
  PlasticUpdate<T> u;
  u.hardening = hardening(law, p + d);
  u.yield = min(cap, u.hardening * q);
  const T r = T(0.5) * e * d / u.yield;
  const T new_sum = sum / (one + nu_1 * r), qq = one / (one + nu_2 * r);
  const T new_difference = difference * qq;
  u.stress = {T(0.5) * (new_sum + new_difference), T(0.5) * (new_sum - new_difference), trial.xy * qq};
  u.increment = d;
  u.dilatation = r * new_sum * T(1.0 / law.young);
  return u;
}

template <class T>
ABUT_INLINE PlasticUpdate<T> normal_return(const ShellJohnsonCook& law, const PlaneStress<T>& trial, T mises, T yield, T p, T q, T cap) {
  const T one = T(1.0), two = T(2.0);
  const T m2 = mises * mises;
  const T beta = (m2 - yield * yield) / (T(5.0) * m2 + T(3.0) * (trial.xy * trial.xy - trial.xx * trial.yy));
  const PlaneStress<T> s{(one - two * beta) * trial.xx + beta * trial.yy, beta * trial.xx + (one - two * beta) * trial.yy,
                         (one - T(3.0) * beta) * trial.xy};
  const T h = select(yield < cap, slope(law, p, q), T(0.0));
  PlasticUpdate<T> u;
  u.increment = (mises - yield) / (T(3.0 * law.shear) + h);
  u.yield = yield + h * u.increment;
  const T ratio = min(one, u.yield / max(sqrt(von_mises_squared(s)), T(1e-300)));
  u.stress = {ratio * s.xx, ratio * s.yy, ratio * s.xy};
  u.dilatation = u.increment * T(0.5) * (u.stress.xx + u.stress.yy) / u.yield;
  u.hardening = hardening(law, p + u.increment);
  return u;
}

/// chi H / Y times the increment: the factor of xi in the back stress. Radial: H at the new p with the old Y; iterative: H at
/// the old p with the new Y.
template <class T>
ABUT_INLINE T back_stress_factor(const ShellJohnsonCook& law, const PlasticUpdate<T>& u, T p, T q, T cap) {
  const T at = law.mapping == 1 ? p : p + u.increment;
  const T h = select(u.yield < cap, slope(law, at, q), T(0.0));
  return T(law.chi) * h * u.increment / u.yield;
}

}  // namespace abut::materials
