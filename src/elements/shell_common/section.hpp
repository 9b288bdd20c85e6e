// Through-thickness integration of a shell: rates at the mid-surface -> resultants, energies, thickness, activity.
//
// Equation contract (numerics.md 3.4 to 3.7, 1.6.1, 5.1, 5.2):
//   strain at point k: e + zeta_k t kappa;   F = sum w_k sigma_k (mean stress),   M = sum wm_k sigma_k (moment / t^2)
//   LAW1 integrates in closed form: dF = C de, dM = t/12 C dkappa (none for N = 1)
//   transverse shear: d tau = kappa_s G d gamma, elastic in every law
//   membrane damping: mu = 1.414 dm rho c sqrt(A); F += mu (e_xx + e_yy/2, e_yy + e_xx/2, g_xy/3) of the rates
//   activity: 1 -> 0.8 when the failure criterion is met, then times 0.8, 0 in the cycle that starts below 0.1
//   dE_m = V/2 (F_old + F_new) . de,   dE_b = V t/2 (M_old + M_new) . dkappa, with F, M damped and times the activity; V and V t are means
//   of the step (Profile::StrainIncrement; the reference: those at its end). Strains are of mid-step, so that V = A t (1 - tr de/2) but
//   where thickness or frozen shapes do not follow the strain: there the last step's are kept.
// The thickness changes at the end: everything of a cycle uses the thickness at its start.
#pragma once

#include <cstddef>
#include <cstdint>

#include "materials/shell_elastic.hpp"
#include "materials/shell_johnson_cook.hpp"
#include "simd/pack.hpp"

namespace abut::elements {

// Found for double too, where argument-dependent lookup finds nothing.
using simd::abs;
using simd::max;
using simd::min;
using simd::select;
using simd::sqrt;

inline constexpr int shell_lanes = 8;
inline constexpr int max_thickness_points = 10;

enum class ShellLaw { elastic, johnson_cook };

/// Variables of one element that every shell has; each is 8 doubles (one per lane) in its block.
namespace shell_state {
enum : int {
  f = 0,  ///< F xx yy xy yz zx as used for forces at the end of the last step
  m = 5,  ///< M xx yy xy, likewise
  membrane_energy = 8,
  bending_energy = 9,
  hourglass_energy = 10,
  thickness = 11,
  off = 12,  ///< activity
  common = 13
};
}

/// Constants of a group's section. Offsets of optional variables are -1 where the group does not have them.
struct ShellSection {
  materials::ShellElastic elastic;
  materials::ShellJohnsonCook plastic;
  double density = 0.0, sound = 0.0;  ///< rho_0, sqrt(E/rho_0)
  int points = 0;
  double shear_factor = 0.0;  ///< kappa_s; 0 for N = 1
  bool bending = true;        ///< false for N = 1
  bool thickness_changes = false;
  bool step_wanted = true;        ///< GroupInput
  double viscous_rate = 1.0;      ///< group.hpp
  bool mean_volume = true;        ///< Profile::StrainIncrement
  double membrane_damping = 0.0;  ///< 1.414 dm rho c; 0 = none
  double zeta[max_thickness_points] = {}, weight[max_thickness_points] = {}, moment_weight[max_thickness_points] = {};

  enum class Rate { none, total, deviatoric, plastic } rate = Rate::none;
  double filter = 0.0;  ///< 2 pi F_cut; 0 = no filter
  bool temperature = false;
  bool mean_yield = false;  ///< the hourglass rule wants the mean yield stress

  int at_elastic = -1;         ///< LAW1 with damping: F xx yy xy; LAW2: tau yz zx, both without damping and activity
  int at_rate = -1;            ///< filtered rate of the element
  int at_rate_thickness = -1;  ///< thickness of the bending term of the rate while the thickness itself is constant
  int at_volume = -1;          ///< half of A t and of A t^2 in the last step's forces
  int at_points = -1;          ///< per point: sigma xx yy xy, p, hardening; then the optional ones below
  int point_size = 0;
  int point_back = -1, point_rate = -1, point_temperature = -1;
  int variables = shell_state::common;  ///< in all
};

/// Velocity strains and curvature rates at the centre, element frame.
template <class T>
struct ShellRates {
  T exx, eyy, gxy, gyz, gzx, kxx, kyy, kxy;
};

/// Membrane strains of the motion at mid-step as the turning frame saw them (docs/theory/elements.md): E + h E^2 + h/2 (O E - E O),
/// E = sym L - h/2 L^T L with the velocity gradient L in the frame, whose third row is the rotation out of the plane; O the frame's spin
/// beyond that of L.
/// @param dxx to dzy  rows of L. @param turn  O_yx, over 2 E_xy
template <class T>
ABUT_INLINE void membrane_at_midpoint(ShellRates<T>& rate, T dxx, T dxy, T dyx, T dyy, T dzx, T dzy, T h, double turn) {
  const T half = T(0.5) * h;
  const T x = dxx - half * (dxx * dxx + dyx * dyx + dzx * dzx), y = dyy - half * (dxy * dxy + dyy * dyy + dzy * dzy);
  const T shear = (dxy + dyx) - h * (dxx * dxy + dyx * dyy + dzx * dzy);
  const T quarter = T(0.25) * h, four = T(4.0);
  const T both = quarter * (shear * shear), turned = T(turn) * half * (shear * shear);
  rate.exx = x + (quarter * four * (x * x) + both - turned);
  rate.eyy = y + (quarter * four * (y * y) + both + turned);
  rate.gxy = shear + shear * (quarter * four * (x + y) + T(turn) * h * (x - y));
}

/// Curvature rates from the gradients of the angular velocity at mid-step: `xx` is that of omega_x along x, `xy` along y.
/// @param cxx cyx cxy cyy  half of the strain increments by which gradients of x^n become those of mid-step, C^T grad
template <class T>
ABUT_INLINE void curvature_at_midpoint(ShellRates<T>& rate, T xx, T xy, T yx, T yy, T cxx, T cyx, T cxy, T cyy) {
  rate.kxx = yx + (cxx * yx + cyx * yy);
  rate.kyy = -(xy + (cxy * xx + cyy * xy));
  rate.kxy = (yy + (cxy * yx + cyy * yy)) - (xx + (cxx * xx + cyx * xy));
}

template <class T>
struct ShellForces {
  T fxx, fyy, fxy, fyz, fzx, mxx, myy, mxy;
  T thickness;  ///< at the start of the step
  T off;        ///< activity at the end of the step
  T yield;      ///< mean yield stress (1e30 for LAW1)
};

namespace section_detail {

template <class T>
ABUT_INLINE T get(const double* state, int variable) {
  return simd::NumberTraits<T>::load(state + variable * shell_lanes);
}
template <class T>
ABUT_INLINE void put(double* state, int variable, T value) {
  simd::NumberTraits<T>::store(state + variable * shell_lanes, value);
}

/// LAW2: the points' stresses to the end of the step; F, M without damping. `d` holds increments.
/// @return elongation through the thickness
template <class T>
ABUT_INLINE T integrate_johnson_cook(const ShellSection& s, double* state, const ShellRates<T>& rate, double h, T t, T off,
                                     ShellForces<T>& out, T& failing) {
  const materials::ShellJohnsonCook& law = s.plastic;
  const T zero = T(0.0), one = T(1.0), step = T(h);
  const T a11 = T(s.elastic.a11), a12 = T(s.elastic.a12), g = T(s.elastic.shear);
  const double filter = s.filter > 0.0 ? (s.filter * h < 1.0 ? s.filter * h : 1.0) : 1.0;

  T q_element = one;
  if (s.rate == ShellSection::Rate::total) {
    const T tr = s.at_rate_thickness >= 0 ? get<T>(state, s.at_rate_thickness) : t;
    const T membrane = rate.exx * rate.exx + rate.eyy * rate.eyy + rate.exx * rate.eyy + T(0.25) * (rate.gxy * rate.gxy);
    const T bending = rate.kxx * rate.kxx + rate.kyy * rate.kyy + rate.kxx * rate.kyy + T(0.25) * (rate.kxy * rate.kxy);
    T value = sqrt(T(4.0 / 3.0) * membrane + T(1.0 / 9.0) * (tr * tr) * bending);
    if (s.at_rate >= 0) {
      value = T(filter) * value + T(1.0 - filter) * get<T>(state, s.at_rate);
      put(state, s.at_rate, value);
    }
    q_element = max(materials::rate_factor(law, value), T(1e-20));
  }

  out.fxx = out.fyy = out.fxy = out.mxx = out.myy = out.mxy = zero;
  T dilatation = zero, yield_sum = zero;
  failing = zero;
  for (int k = 0; k < s.points; ++k) {
    double* point = state + (s.at_points + k * s.point_size) * shell_lanes;
    const T z = T(s.zeta[k]) * t;
    const T rxx = rate.exx + z * rate.kxx, ryy = rate.eyy + z * rate.kyy, rxy = rate.gxy + z * rate.kxy;
    const T dxx = rxx * step, dyy = ryy * step, dxy = rxy * step;
    materials::PlaneStress<T> sigma{get<T>(point, 0) + (a11 * dxx + a12 * dyy), get<T>(point, 1) + (a12 * dxx + a11 * dyy),
                                    get<T>(point, 2) + g * dxy};
    T back_xx = zero, back_yy = zero, back_xy = zero;
    if (s.point_back >= 0) {
      back_xx = get<T>(point, s.point_back);
      back_yy = get<T>(point, s.point_back + 1);
      back_xy = get<T>(point, s.point_back + 2);
      sigma.xx -= back_xx;
      sigma.yy -= back_yy;
      sigma.xy -= back_xy;
    }
    T q = q_element;
    T point_rate = zero;
    if (s.rate == ShellSection::Rate::deviatoric) {
      const T mean = T(1.0 / 3.0) * (rxx + ryy);
      const T dx = rxx - mean, dy = ryy - mean;
      point_rate = T(2.0 / 3.0) * sqrt(T(1.5) * (dx * dx + dy * dy + mean * mean + T(0.5) * (rxy * rxy)));
      if (s.point_rate >= 0) {
        point_rate = T(filter) * point_rate + T(1.0 - filter) * get<T>(point, s.point_rate);
        put(point, s.point_rate, point_rate);
      }
      q = materials::rate_factor(law, point_rate);
    } else if (s.rate == ShellSection::Rate::plastic) {
      point_rate = get<T>(point, s.point_rate);
      q = materials::rate_factor(law, point_rate);
    }
    T temperature = zero;
    if (s.temperature) {
      temperature = get<T>(point, s.point_temperature);
      q = q * materials::temperature_factor(law, temperature);
    }
    q = max(q, T(1e-20));
    const T cap = law.icc == 1 ? T(law.sigma_max) * q : T(law.sigma_max);
    T yield = min(cap, get<T>(point, 4) * q);
    const T mises2 = materials::von_mises_squared(sigma);
    T increment = zero;
    auto yields = mises2 > yield * yield;
    if (law.mapping != 2) yields = yields & (off >= one);
    if (simd::any(yields)) {
      const T mises = sqrt(select(yields, mises2, yield * yield));
      const T p = get<T>(point, 3);
      const materials::PlasticUpdate<T> u = law.mapping == 1   ? materials::iterative_return(law, sigma, mises, yield, p, q, cap)
                                            : law.mapping == 3 ? materials::normal_return(law, sigma, mises, yield, p, q, cap)
                                                               : materials::radial_return(law, sigma, mises, yield, p, off);
      sigma.xx = select(yields, u.stress.xx, sigma.xx);
      sigma.yy = select(yields, u.stress.yy, sigma.yy);
      sigma.xy = select(yields, u.stress.xy, sigma.xy);
      increment = select(yields, u.increment, zero);
      const T p_new = p + increment;
      put(point, 3, p_new);
      put(point, 4, select(yields, u.hardening, get<T>(point, 4)));
      dilatation += T(s.weight[k]) * select(yields, u.dilatation, zero);
      failing = select(yields & (p_new >= T(law.eps_max)), one, failing);
      if (s.point_back >= 0) {
        const T factor = select(yields, materials::back_stress_factor(law, u, p, q, cap), zero);
        back_xx += factor * sigma.xx;
        back_yy += factor * sigma.yy;
        back_xy += factor * sigma.xy;
        put(point, s.point_back, back_xx);
        put(point, s.point_back + 1, back_yy);
        put(point, s.point_back + 2, back_xy);
      }
      if (s.temperature) {
        const T heated = temperature + u.yield * increment * T(law.inverse_rho_cp);
        put(point, s.point_temperature, select(yields, min(heated, T(law.t_max)), temperature));
      }
      yield = select(yields, u.yield, yield);
    }
    if (s.rate == ShellSection::Rate::plastic && h > 0.0) {
      put(point, s.point_rate, T(filter) * (increment * T(1.0 / h)) + T(1.0 - filter) * point_rate);
    }
    if (s.point_back >= 0) {
      sigma.xx += back_xx;
      sigma.yy += back_yy;
      sigma.xy += back_xy;
    }
    put(point, 0, sigma.xx);
    put(point, 1, sigma.yy);
    put(point, 2, sigma.xy);
    yield_sum += yield;
    const T w = T(s.weight[k]), wm = T(s.moment_weight[k]);
    out.fxx += w * sigma.xx;
    out.fyy += w * sigma.yy;
    out.fxy += w * sigma.xy;
    out.mxx += wm * sigma.xx;
    out.myy += wm * sigma.yy;
    out.mxy += wm * sigma.xy;
  }
  if (s.mean_yield) out.yield = yield_sum * T(1.0 / s.points);
  const T elastic = T(-s.elastic.poisson / (1.0 - s.elastic.poisson)) * ((rate.exx + rate.eyy) * step);
  return elastic - T((1.0 - 2.0 * s.elastic.poisson) / (1.0 - s.elastic.poisson)) * dilatation;
}

}  // namespace section_detail

/// One step of the section. @param state the element's variables: its block's state plus its lane
/// @param rate zero in lanes that must not change; @param h length of the step; @param area current area
template <class T, ShellLaw law>
ABUT_INLINE ShellForces<T> update_section(const ShellSection& s, double* state, const ShellRates<T>& rate, double h, T area) {
  using section_detail::get;
  using section_detail::put;
  const T one = T(1.0), step = T(h);
  const T dexx = rate.exx * step, deyy = rate.eyy * step, dgxy = rate.gxy * step;
  const T dgyz = rate.gyz * step, dgzx = rate.gzx * step;
  const T dkxx = rate.kxx * step, dkyy = rate.kyy * step, dkxy = rate.kxy * step;
  const T t = get<T>(state, shell_state::thickness), off_old = get<T>(state, shell_state::off);
  const T a11 = T(s.elastic.a11), a12 = T(s.elastic.a12), g = T(s.elastic.shear);
  const T shear = T(s.shear_factor * s.elastic.shear);
  const T old_fxx = get<T>(state, 0), old_fyy = get<T>(state, 1), old_fxy = get<T>(state, 2);
  const T old_fyz = get<T>(state, 3), old_fzx = get<T>(state, 4);
  const T old_mxx = get<T>(state, 5), old_myy = get<T>(state, 6), old_mxy = get<T>(state, 7);

  ShellForces<T> out;
  out.thickness = t;
  out.yield = T(1e30);
  T elongation;
  T off = select(off_old < one, select(off_old < T(0.1), T(0.0), T(0.8) * off_old), off_old);
  if constexpr (law == ShellLaw::elastic) {
    T exx = old_fxx, eyy = old_fyy, exy = old_fxy;
    if (s.at_elastic >= 0) {
      exx = get<T>(state, s.at_elastic);
      eyy = get<T>(state, s.at_elastic + 1);
      exy = get<T>(state, s.at_elastic + 2);
    }
    out.fxx = exx + (a11 * dexx + a12 * deyy);
    out.fyy = eyy + (a12 * dexx + a11 * deyy);
    out.fxy = exy + g * dgxy;
    if (s.at_elastic >= 0) {
      put(state, s.at_elastic, out.fxx);
      put(state, s.at_elastic + 1, out.fyy);
      put(state, s.at_elastic + 2, out.fxy);
    }
    out.fyz = old_fyz + shear * dgyz;
    out.fzx = old_fzx + shear * dgzx;
    const T twelfth = s.bending ? T(1.0 / 12.0) * t : T(0.0);
    out.mxx = old_mxx + twelfth * (a11 * dkxx + a12 * dkyy);
    out.myy = old_myy + twelfth * (a12 * dkxx + a11 * dkyy);
    out.mxy = old_mxy + twelfth * (g * dkxy);
    elongation = T(-s.elastic.poisson / (1.0 - s.elastic.poisson)) * (dexx + deyy);
  } else {
    T failing;
    elongation = section_detail::integrate_johnson_cook<T>(s, state, rate, h, t, off_old, out, failing);
    out.fyz = get<T>(state, s.at_elastic) + shear * dgyz;
    out.fzx = get<T>(state, s.at_elastic + 1) + shear * dgzx;
    put(state, s.at_elastic, out.fyz);
    put(state, s.at_elastic + 1, out.fzx);
    off = select((failing > T(0.0)) & (off_old >= one), T(0.8), off);
    if (s.at_rate_thickness >= 0) {
      const T tr = get<T>(state, s.at_rate_thickness);
      put(state, s.at_rate_thickness, tr * (one + elongation));
    }
  }
  if (s.membrane_damping > 0.0 && h > 0.0) {
    const T mu = T(s.membrane_damping) * sqrt(area);
    out.fxx += mu * (rate.exx + T(0.5) * rate.eyy);
    out.fyy += mu * (rate.eyy + T(0.5) * rate.exx);
    out.fxy += T(1.0 / 3.0) * mu * rate.gxy;
  }
  if constexpr (law == ShellLaw::johnson_cook) {
    out.fxx *= off;
    out.fyy *= off;
    out.fxy *= off;
    out.fyz *= off;
    out.fzx *= off;
    out.mxx *= off;
    out.myy *= off;
    out.mxy *= off;
  }
  out.off = off;

  T half_volume = T(0.5) * area * t, half_moment = half_volume * t;
  if (s.at_volume >= 0) {
    const T force = half_volume, moment = half_moment;
    half_volume = T(0.5) * (get<T>(state, s.at_volume) + force);
    half_moment = T(0.5) * (get<T>(state, s.at_volume + 1) + moment);
    put(state, s.at_volume, force);
    put(state, s.at_volume + 1, moment);
  } else if (s.mean_volume) {
    half_volume -= half_volume * (T(0.5) * (dexx + deyy));
    half_moment = half_volume * t;
  }
  const T membrane = (old_fxx + out.fxx) * dexx + (old_fyy + out.fyy) * deyy + (old_fxy + out.fxy) * dgxy + (old_fyz + out.fyz) * dgyz +
                     (old_fzx + out.fzx) * dgzx;
  const T bending = (old_mxx + out.mxx) * dkxx + (old_myy + out.myy) * dkyy + (old_mxy + out.mxy) * dkxy;
  const auto on = off_old > T(0.0);  // a deleted element keeps its energies, whatever becomes of its shape
  put(state, shell_state::membrane_energy, get<T>(state, shell_state::membrane_energy) + select(on, half_volume * membrane, T(0.0)));
  put(state, shell_state::bending_energy, get<T>(state, shell_state::bending_energy) + select(on, half_moment * bending, T(0.0)));
  put(state, 0, out.fxx);
  put(state, 1, out.fyy);
  put(state, 2, out.fxy);
  put(state, 3, out.fyz);
  put(state, 4, out.fzx);
  put(state, 5, out.mxx);
  put(state, 6, out.myy);
  put(state, 7, out.mxy);
  put(state, shell_state::off, off);
  if (s.thickness_changes) put(state, shell_state::thickness, t * (one + elongation));
  return out;
}

}  // namespace abut::elements
