// Point laws of solids: update of the stress deviator over one step.
//
// Equation contract
//   LAW1, elastic (numerics.md 5.1):   s += 2 G dev(D) h;  p = B mu, mu = rho/rho_0 - 1.
//   LAW2, Johnson-Cook (numerics.md 5.2.1, 5.2.3, 5.2.5, 5.2.7; [Johnson Cook 1983]):
//     Y  = min(sigma_max*, (a + b ep^n) Q),  Q = (1 + c <ln(rate/rate_0)>) (1 - T*^m),  T* = <(T - T_r)/(T_melt - T_r)>
//     H  = n b ep^(n-1) Q at the old ep; 0 where Y is capped, and 0 while ep = 0 unless n = 1
//     dep = <s_vM - Y>/(3G + H),  Y += H dep,  s = min(1, Y/s_vM) s_trial,  s_vM = sqrt(3/2 s:s)
//     p  = max(B mu, p_min);  ep > eps_max: s = 0 from then on, the pressure stays;
//     adiabatic heating: T = min(T_max, T + Y dep/(rho C_p)) where rho C_p > 0.
//   With p_min the pressure cut-off acts as the card says (the reference notes leave it open).
// Symbols: D rate of deformation, h step, ep equivalent plastic strain. Tension is positive, p positive in compression.
//
// A static part a + b ep^n and its slope are kept beside ep, so that the power is evaluated only after plastic flow.
#pragma once

#include "simd/math.hpp"
#include "simd/pack.hpp"

namespace abut::materials {

/// Symmetric tensor; shear entries are tensor components (not engineering strains).
template <class R>
struct Sym {
  R xx, yy, zz, xy, yz, zx;
};

/// a : b
template <class R>
ABUT_INLINE R contract(const Sym<R>& a, const Sym<R>& b) {
  const R shear = a.xy * b.xy + a.yz * b.yz + a.zx * b.zx;
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + (shear + shear);
}

template <class R>
ABUT_INLINE Sym<R> deviator(const Sym<R>& a) {
  const R mean = (a.xx + a.yy + a.zz) * R(1.0 / 3.0);
  return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.yz, a.zx};
}

template <class R>
ABUT_INLINE Sym<R> scaled(const Sym<R>& a, R f) {
  return {f * a.xx, f * a.yy, f * a.zz, f * a.xy, f * a.yz, f * a.zx};
}

/// s += 2 G dev(D) h
template <class R>
ABUT_INLINE void add_elastic(Sym<R>& s, const Sym<R>& dev_rate, R two_shear_h) {
  s.xx += two_shear_h * dev_rate.xx;
  s.yy += two_shear_h * dev_rate.yy;
  s.zz += two_shear_h * dev_rate.zz;
  s.xy += two_shear_h * dev_rate.xy;
  s.yz += two_shear_h * dev_rate.yz;
  s.zx += two_shear_h * dev_rate.zx;
}

/// Constants of LAW2. Stresses in the deck's units, rates per time unit, temperatures in kelvin.
struct JohnsonCook {
  double a = 0.0, b = 0.0, n = 1.0;
  double eps_max = 1e20, sigma_max = 1e20;
  double c = 0.0, eps_rate_0 = 0.0;  ///< no rate factor unless both are positive
  int cap_scaled = 1;                ///< ICC = 1: sigma_max is scaled by Q
  int rate_measure = 2;              ///< VP: 1 plastic (previous cycle), 2 sqrt(D:D), 3 2/3 sqrt(3/2 dev D:dev D)
  double filter = 0.0;               ///< 2 pi F_cut; 0 = no filter
  double m = 1.0, t_melt = 1e20, rho_cp = 0.0, t_ref = 300.0, t_max = 1e20;
};

/// History of LAW2 at a point.
template <class R>
struct JohnsonCookState {
  R strain;  ///< equivalent plastic strain
  R yield;   ///< a + b ep^n
  R slope;   ///< n b ep^(n-1); 0 while ep = 0 unless n = 1
  R rate;    ///< filtered strain rate
  R temperature;
};

inline constexpr int johnson_cook_fields = 5;

/// a + b ep^n and its slope for ep = 0.
ABUT_INLINE JohnsonCookState<double> initial_state(const JohnsonCook& m) { return {0.0, m.a, m.n == 1.0 ? m.b : 0.0, 0.0, m.t_ref}; }

/// Returns the trial deviator `s` to the yield surface and moves the history on.
/// @param d,dev   D and dev(D)
/// @param inv_dt  1/h, 0 in the first cycle (h = 0)
template <class R>
ABUT_INLINE void return_map(const JohnsonCook& m, double shear, double dt, double inv_dt, const Sym<R>& d, const Sym<R>& dev, Sym<R>& s,
                            JohnsonCookState<R>& state) {
  const R zero(0.0), one(1.0);
  const double alpha = m.filter > 0.0 ? simd::min(1.0, m.filter * dt) : 1.0;
  R factor = one;
  if (m.c > 0.0 && m.eps_rate_0 > 0.0) {
    if (m.rate_measure != 1) {
      const R now = m.rate_measure == 2 ? simd::sqrt(contract(d, d)) : R(2.0 / 3.0) * simd::sqrt(R(1.5) * contract(dev, dev));
      state.rate = R(alpha) * now + R(1.0 - alpha) * state.rate;
    }
    const R ratio = simd::max(one, state.rate * R(1.0 / m.eps_rate_0));
    if (simd::any(ratio > one)) factor = one + R(m.c) * simd::log(ratio);
  }
  if (m.rho_cp > 0.0) {
    const R hot = simd::max(zero, (state.temperature - R(m.t_ref)) * R(1.0 / (m.t_melt - m.t_ref)));
    if (simd::any(hot > zero)) factor = factor * (one - simd::pow(hot, R(m.m)));
  }
  factor = simd::max(factor, R(1e-20));

  const R cap = m.cap_scaled != 0 ? R(m.sigma_max) * factor : R(m.sigma_max);
  const R uncapped = state.yield * factor;
  const auto capped = uncapped >= cap;
  R y = simd::min(cap, uncapped);
  const R von_mises = simd::sqrt(R(1.5) * contract(s, s));
  const auto flows = von_mises > y;
  if (simd::any(flows)) {
    const R h = simd::select(capped, zero, state.slope * factor);
    const R dep = simd::max(zero, von_mises - y) / (R(3.0 * shear) + h);
    y = y + h * dep;
    const R ratio = simd::select(flows, simd::min(one, y / simd::select(flows, von_mises, one)), one);
    s = scaled(s, ratio);
    state.strain = state.strain + dep;
    if (m.rho_cp > 0.0) { state.temperature = simd::min(R(m.t_max), state.temperature + y * dep * R(1.0 / m.rho_cp)); }
    if (m.n == 1.0) {
      state.yield = R(m.a) + R(m.b) * state.strain;
    } else if (m.b != 0.0) {
      const auto strained = state.strain > zero;
      const R base = simd::pow(simd::select(strained, state.strain, one), R(m.n - 1.0)) * R(m.b);
      state.slope = simd::select(strained, R(m.n) * base, zero);
      state.yield = simd::select(strained, R(m.a) + base * state.strain, R(m.a));
    }
    if (m.rate_measure == 1) state.rate = R(alpha * inv_dt) * dep + R(1.0 - alpha) * state.rate;
  } else if (m.rate_measure == 1) {
    state.rate = R(1.0 - alpha) * state.rate;
  }
  const auto failed = state.strain > R(m.eps_max);
  if (simd::any(failed)) s = scaled(s, simd::select(failed, zero, one));
}

}  // namespace abut::materials
