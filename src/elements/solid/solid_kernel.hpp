// Pieces of a step that the one-point solids share: objective rate, law, viscosity, energy and stability limit.
//
// Equation contract (numerics.md)
//   1.6.1  energy, trapezoidal; LAW1 works with s:D and p dV, LAW2 with sigma:D; the old stress enters turned to the axes of D (small
//          strain: as it was, since its forces act on axes that do not turn; Profile::StressRotation: always as it was)
//   4.3.1  sigma <- Q sigma Q^T, Q = (1 - W/2)^-1 (1 + W/2) [Hughes Winget 1980]; the program and StressRotation: to first order, Jaumann,
//          sigma += W sigma - sigma W
//   4.5    q = rho l <-tr D> (qa^2 l <-tr D> + qb c), l = V^(1/3)
//   2.1.5  reference step: dt = dx/(Q + sqrt(Q^2 + c^2)), Q = qb c + qa^2 l <-tr D>
// Bound step, exact for a parallelepiped of isotropic gradients, never above the element's limit
//   (after [Flanagan Belytschko 1984], J. Appl. Mech. 51, 35-40, who bound the same problem by tr G alone):
//   nodal force f_I = V sigma P_I with P_I = grad N_I, equal nodal masses m_n = m_e/n, G = sum_I P_I P_I^T, g = its largest eigenvalue.
//   With u_I given, H = sum_I u_I P_I^T satisfies |H|^2 <= g |u|^2 and (tr H)^2 <= tr G |u|^2. Hence
//     u.K.u = V [lambda (tr H)^2 + 2 mu |sym H|^2 + stress terms] <= V [lambda* tr G + (2 mu)* g] |u|^2
//   lambda* = <B V_ref/V - 2/3 G - p>, (2 mu)* = max(2G + p + q, -p - q) + 2.05 s_vM: the tangent of p = B(V_ref/V - 1) and the
//   initial-stress terms of V sigma P under the Jaumann rate (|D:(Ws - sW)| <= max|eig s| |H|^2, ...). A plastic tangent is softer.
//   Small strain on axes that do not turn: V and P stay, only D:(Ws - sW) = sum over pairs of axes of 2 D_ij W_ij (s_j - s_i) is left, so
//     lambda* = B - 2/3 G, (2 mu)* = G + sqrt(G^2 + s:s/2), the larger eigenvalue of a pair's form with |s_i - s_j|^2 <= 2 s:s.
//   A looser bound costs more than steps: it follows the ringing of the stress, and a step that does so makes a leap-frog unstable
//   far below its limit [Skeel 1993].
//   g <= t/3 + sqrt(2/3 (|G|^2 - t^2/3)), t = tr G: exact for G = g 1 and G of rank one [Wolkowicz Styan 1980].
//   Viscosity lags half a step: stable iff lambda_max(h^2 K + 2 h C) <= 4 M, so with k, c bounds of K/M and C/M
//     1/h = (c + sqrt(c^2 + 4 k))/4, which is h = (2/omega)(sqrt(1 + xi^2) - xi).
//   Hourglass viscosity acts on gamma = Gamma - P.X: a 2 x 2 block matrix of the P space and the Gamma space bounds the sum.
// Nodal stiffness handed out with it: K_I = 1/2 m_I lambda_max(h_s^2 K + 2 h_s C)/(h_s^2 M) with h_s the step just made: any h >= h_s with
//   h <= sqrt(2 m_I/sum K_I) at every node then satisfies h^2 K + 2 h C <= 4 M for the assembled system.
#pragma once

#include "elements/add_block.hpp"
#include "elements/solid/solid_layout.hpp"
#include "materials/solid_law.hpp"
#include "simd/gather.hpp"
#include "simd/pack.hpp"

namespace abut::elements {

template <class R>
using Vec = simd::Triple<R>;
using materials::Sym;

/// Rows of a 3 x 3 matrix.
template <class R>
struct Matrix {
  Vec<R> x, y, z;
};

/// A a
template <class R>
ABUT_INLINE Vec<R> apply(const Matrix<R>& m, const Vec<R>& a) {
  return {dot(m.x, a), dot(m.y, a), dot(m.z, a)};
}
/// A^T a
template <class R>
ABUT_INLINE Vec<R> apply_transposed(const Matrix<R>& m, const Vec<R>& a) {
  return {m.x.x * a.x + m.y.x * a.y + m.z.x * a.z, m.x.y * a.x + m.y.y * a.y + m.z.y * a.z, m.x.z * a.x + m.y.z * a.y + m.z.z * a.z};
}
template <class R>
ABUT_INLINE Sym<R> symmetric_part(const Matrix<R>& l) {
  const R half(0.5);
  return {l.x.x, l.y.y, l.z.z, half * (l.x.y + l.y.x), half * (l.y.z + l.z.y), half * (l.z.x + l.x.z)};
}
/// 1/2 h L^T L (4.3.3).
template <class R>
ABUT_INLINE Sym<R> second_order(const Matrix<R>& l, R half_h) {
  return {half_h * (l.x.x * l.x.x + l.y.x * l.y.x + l.z.x * l.z.x), half_h * (l.x.y * l.x.y + l.y.y * l.y.y + l.z.y * l.z.y),
          half_h * (l.x.z * l.x.z + l.y.z * l.y.z + l.z.z * l.z.z), half_h * (l.x.x * l.x.y + l.y.x * l.y.y + l.z.x * l.z.y),
          half_h * (l.x.y * l.x.z + l.y.y * l.y.z + l.z.y * l.z.z), half_h * (l.x.z * l.x.x + l.y.z * l.y.x + l.z.z * l.z.x)};
}
template <class R>
ABUT_INLINE Sym<R> operator-(const Sym<R>& a, const Sym<R>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
}
template <class R>
ABUT_INLINE Sym<R> operator+(const Sym<R>& a, const Sym<R>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}

/// Strain increment at mid-step in the axes at its end, over h [Hughes Winget 1980]: E + h E^2, E = sym L - 1/2 h L^T L, which is zero in a
/// finite rotation.
template <class R>
ABUT_INLINE Sym<R> at_midpoint(const Matrix<R>& l, double dt) {
  const Sym<R> e = symmetric_part(l) - second_order(l, R(0.5 * dt));
  const R h(dt), xy = e.xy * e.xy, yz = e.yz * e.yz, zx = e.zx * e.zx;
  return {e.xx + h * (e.xx * e.xx + xy + zx),
          e.yy + h * (e.yy * e.yy + xy + yz),
          e.zz + h * (e.zz * e.zz + yz + zx),
          e.xy + h * ((e.xx + e.yy) * e.xy + e.zx * e.yz),
          e.yz + h * ((e.yy + e.zz) * e.yz + e.xy * e.zx),
          e.zx + h * ((e.zz + e.xx) * e.zx + e.yz * e.xy)};
}

/// s + W s - s W with W_yx = w.z, W_zy = w.x, W_xz = w.y (4.3.1).
template <class R>
ABUT_INLINE Sym<R> jaumann(const Sym<R>& s, const Vec<R>& w) {
  const R two(2.0);
  return {s.xx + two * (w.y * s.zx - w.z * s.xy),
          s.yy + two * (w.z * s.xy - w.x * s.yz),
          s.zz + two * (w.x * s.yz - w.y * s.zx),
          s.xy + (w.z * (s.xx - s.yy) - w.x * s.zx + w.y * s.yz),
          s.yz + (w.x * (s.yy - s.zz) - w.y * s.xy + w.z * s.zx),
          s.zx + (w.y * (s.zz - s.xx) - w.z * s.yz + w.x * s.xy)};
}

/// Spin increment at mid-step from that of the velocity gradient on the geometry at the end, w, and the strain increment d over h: W + h/2
/// (D W + W D), whose axial vector is w + h/2 (tr D w - D w).
template <class R>
ABUT_INLINE Vec<R> spin_at_midpoint(const Vec<R>& w, const Sym<R>& d, double dt) {
  const R half(0.5 * dt);
  return {w.x + half * ((d.yy + d.zz) * w.x - d.xy * w.y - d.zx * w.z), w.y + half * ((d.zz + d.xx) * w.y - d.yz * w.z - d.xy * w.x),
          w.z + half * ((d.xx + d.yy) * w.z - d.zx * w.x - d.yz * w.y)};
}

/// Q s Q^T, Q = (1 - B)^-1 (1 + B) = 1 + 2/(1 + b.b) (B + B B), B a = b x a. b = w/2 (1 + w.w/4): a turn by an angle t has w = sin t, and
/// b = tan(t/2) to fourth order.
template <class R>
ABUT_INLINE Sym<R> turned(const Sym<R>& s, const Vec<R>& w) {
  const R one(1.0), u = R(0.25) * dot(w, w), half = R(0.5) + R(0.5) * u;
  const Vec<R> b = half * w;
  const R size = u * (one + u) * (one + u), c = R(2.0) / (one + size), rest = one - c * size;
  const Vec<R> t = c * b;
  const R xy = t.x * b.y, yz = t.y * b.z, zx = t.z * b.x;
  const Vec<R> qx{rest + t.x * b.x, xy - t.z, zx + t.y}, qy{xy + t.z, rest + t.y * b.y, yz - t.x}, qz{zx - t.y, yz + t.x, rest + t.z * b.z};
  const Vec<R> rows[3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
  const Vec<R> mx{dot(qx, rows[0]), dot(qx, rows[1]), dot(qx, rows[2])}, my{dot(qy, rows[0]), dot(qy, rows[1]), dot(qy, rows[2])};
  const Vec<R> mz{dot(qz, rows[0]), dot(qz, rows[1]), dot(qz, rows[2])};
  return {dot(mx, qx), dot(my, qy), dot(mz, qz), dot(mx, qy), dot(my, qz), dot(mz, qx)};
}

/// Memory of one register's worth of lanes inside a block.
template <class R>
struct Lanes {
  double* base;  ///< field 0 of these lanes
  [[gnu::always_inline]] inline R get(int field) const { return simd::NumberTraits<R>::load(base + field * 8); }
  [[gnu::always_inline]] inline void put(int field, R a) const { simd::NumberTraits<R>::store(base + field * 8, a); }
};

/// Keeps the frame for output in global axes.
template <class R>
ABUT_INLINE void put_frame(const Lanes<R>& state, int f, const Matrix<R>& e) {
  const Vec<R> rows[3] = {e.x, e.y, e.z};
  for (int i = 0; i < 3; ++i) {
    state.put(f + 3 * i, rows[i].x);
    state.put(f + 3 * i + 1, rows[i].y);
    state.put(f + 3 * i + 2, rows[i].z);
  }
}

/// What the kinematics of an element hand to its material point.
template <class R>
struct PointInput {
  Sym<R> d;     ///< rate of deformation
  Vec<R> spin;  ///< W h; unused when co-rotational
  R volume;     ///< V, geometric (frozen in small strain)
  R inverse_volume;
};

/// What comes back: total stress with viscosity, and what the stability limit needs.
template <class R>
struct PointResult {
  Sym<R> stress;  ///< s - (p + q) 1
  R density, inverse_length, length, compression, pressure, viscosity;
};

/// V^(-1/3) by a third-order iteration from the last value; the volume changes little in a step. A long chain: to be called early, where
/// other work does not wait for it.
template <class R>
ABUT_INLINE void update_length(const SolidConfig& c, const Lanes<R>& state, R volume) {
  if (c.small_strain) return;
  R y = state.get(f_inverse_length);
  for (int i = 0; i < 3; ++i) {
    const R e = R(1.0) - volume * y * y * y;
    y = y + y * e * (R(1.0 / 3.0) + R(2.0 / 9.0) * e);
  }
  state.put(f_inverse_length, y);
}

/// Stress update and energy of one material point, after update_length(): numerics.md 4.3, 4.5, 5.1, 5.2, 1.6.1.
template <bool Corotational, class R>
ABUT_INLINE PointResult<R> update_point(const SolidConfig& c, double dt, double inv_dt, const Lanes<R>& state, const PointInput<R>& in) {
  const R zero(0.0), one(1.0), half(0.5);
  PointResult<R> out;
  const R mass = state.get(f_mass);
  const R rate = in.d.xx + in.d.yy + in.d.zz;
  const R old_volume = state.get(f_volume);

  // Volume change of the step, mean volume, density.
  R delta_volume, mean_volume;
  if (c.small_strain) {
    delta_volume = old_volume * rate * R(dt);
    mean_volume = c.small_strain_work ? old_volume : old_volume - half * delta_volume;
    out.density = state.get(f_density) - R(c.rho_0 * dt) * rate;
    state.put(f_density, out.density);
  } else {
    delta_volume = in.volume - old_volume;
    mean_volume = half * (in.volume + old_volume);
    out.density = mass * in.inverse_volume;
    state.put(f_volume, in.volume);
  }

  const R y = state.get(f_inverse_length);
  out.inverse_length = y;
  out.length = in.volume * y * y;

  // Deviator.
  const Sym<R> old{state.get(f_sxx), state.get(f_syy), state.get(f_szz), state.get(f_sxy), state.get(f_syz), state.get(f_szx)};
  Sym<R> s = old, before = old;  // before: as it does its work
  if constexpr (!Corotational) {
    if (c.finite_rotation) {
      s = turned(old, c.midpoint_strain ? spin_at_midpoint(in.spin, in.d, dt) : in.spin);
      if (!c.small_strain) before = s;
    } else {
      s = jaumann(old, in.spin);
    }
  }
  const Sym<R> dev = materials::deviator(in.d);
  materials::add_elastic(s, dev, R(2.0 * c.shear * dt));
  if (c.law == 2) {
    const int f = c.law_field;
    materials::JohnsonCookState<R> point{state.get(f), state.get(f + 1), state.get(f + 2), state.get(f + 3), state.get(f + 4)};
    materials::return_map(c.plastic, c.shear, dt, inv_dt, in.d, dev, s, point);
    state.put(f, point.strain);
    state.put(f + 1, point.yield);
    state.put(f + 2, point.slope);
    state.put(f + 3, point.rate);
    state.put(f + 4, point.temperature);
  }
  state.put(f_sxx, s.xx);
  state.put(f_syy, s.yy);
  state.put(f_szz, s.zz);
  state.put(f_sxy, s.xy);
  state.put(f_syz, s.yz);
  state.put(f_szx, s.zx);

  // Pressure and bulk viscosity.
  const R mu = out.density * R(1.0 / c.rho_0) - one;
  const auto present = in.inverse_volume > zero;  // not a collapsed or inactive element, whose density means nothing
  const R old_pressure = state.get(f_pressure), old_viscosity = state.get(f_viscosity);
  out.pressure = simd::select(present, simd::max(R(c.p_min), R(c.bulk) * mu), old_pressure);
  out.compression = simd::max(zero, -rate);
  out.viscosity = out.density * out.length * out.compression * (R(c.qa_squared) * out.length * out.compression + R(c.qb * c.sound));
  state.put(f_pressure, out.pressure);
  state.put(f_viscosity, out.viscosity);

  // Internal energy.
  const R deviatoric = materials::contract(before + s, in.d);
  R power, pressures = old_viscosity + out.viscosity;
  if (c.law == 2) {
    power = deviatoric - (old_pressure + out.pressure) * rate;
  } else {
    power = deviatoric;
    pressures = pressures + (old_pressure + out.pressure);
  }
  const R gained = R(0.5 * dt) * mean_volume * power - half * delta_volume * pressures;
  state.put(f_energy, state.get(f_energy) + simd::select(state.get(f_live) > zero, gained, zero));

  const R total = out.pressure + out.viscosity;
  out.stress = {s.xx - total, s.yy - total, s.zz - total, s.xy, s.yz, s.zx};
  return out;
}

/// 1/dt_e of the reference (2.1.5) from 1/dx.
template <class R>
ABUT_INLINE R reference_inverse_step(const SolidConfig& c, const PointResult<R>& p, R inverse_dx) {
  const R q = R(c.qb * c.sound) + R(c.qa_squared) * p.length * p.compression;
  return (q + simd::sqrt(q * q + R(c.sound * c.sound))) * inverse_dx;
}

/// Bounds that the stability limit is made of, all divided by the nodal mass.
template <class R>
struct StabilityTerms {
  R k;          ///< stiffness
  R bulk;       ///< bulk viscosity
  R mixed;      ///< hourglass viscosity on the P space (0 for a parallelepiped)
  R hourglass;  ///< hourglass viscosity on the Gamma space
};

/// Largest eigenvalue of G (upper bound) from its trace and |G|^2.
template <class R>
ABUT_INLINE R largest_gradient(R trace, R squared) {
  const R spread = simd::max(R(0.0), squared - trace * trace * R(1.0 / 3.0));
  return trace * R(1.0 / 3.0) + simd::sqrt(R(2.0 / 3.0) * spread);
}

/// Stiffness and bulk-viscosity part of the terms.
template <class R>
ABUT_INLINE StabilityTerms<R> stability_terms(const SolidConfig& c, const PointResult<R>& p, R volume_over_mass, R trace, R g) {
  const R zero(0.0);
  const R total = p.pressure + p.viscosity;
  const Sym<R> s{p.stress.xx + total, p.stress.yy + total, p.stress.zz + total, p.stress.xy, p.stress.yz, p.stress.zx};
  const R squared = materials::contract(s, s);
  R lambda(simd::max(0.0, c.bulk - 2.0 / 3.0 * c.shear)), two_mu;
  if (c.small_strain && !c.corotational) {
    two_mu = R(c.shear) + simd::sqrt(R(c.shear * c.shear) + R(0.5) * squared);
  } else {
    lambda = simd::max(zero, p.density * R(c.bulk / c.rho_0) - R(2.0 / 3.0 * c.shear) - p.pressure);
    two_mu = simd::max(R(2.0 * c.shear) + total, -total) + R(2.05) * simd::sqrt(R(1.5) * squared);
  }
  const R eta = p.density * p.length * (R(c.qb * c.sound) + R(2.0 * c.qa_squared) * p.length * p.compression);
  return {volume_over_mass * (lambda * trace + two_mu * g), volume_over_mass * eta * trace, zero, zero};
}

/// lambda_max(h^2 K + 2 h C)/(h^2 M) for 1/h = y.
template <class R>
ABUT_INLINE R effective_eigenvalue(const StabilityTerms<R>& t, R y) {
  const R half(0.5);
  const R a = t.k + R(2.0) * y * t.bulk, d = R(2.0) * y * t.mixed, f = R(2.0) * y * t.hourglass;
  const R u = half * (a + d - f);
  return half * (a + d + f) + simd::sqrt(u * u + d * f);
}

/// 1/h of the largest h with lambda_max(h^2 K + 2 h C) <= 4 M, from above: exact without hourglass viscosity on the P space. A first value
/// bounds the 2 x 2 problem by its Schur complement; where hourglass viscosity counts, y <- sqrt(effective_eigenvalue(y))/2 falls
/// monotonically towards the solution.
template <class R>
ABUT_INLINE R bound_inverse_step(const StabilityTerms<R>& t) {
  const R least = t.hourglass * R(1.0 / 1.75);
  const R y0 = simd::max(R(0.5) * simd::sqrt(t.k), least);
  const R c = t.bulk + t.mixed * ((y0 + y0) / simd::max(R(1e-300), y0 + y0 - t.hourglass));
  R y = simd::max(R(0.25) * (c + simd::sqrt(c * c + R(4.0) * t.k)), least);
  const auto loose = (y <= least) | (t.mixed > R(0.02) * y);
  if (simd::any(loose)) {
    R better = y;
    for (int i = 0; i < 3; ++i) better = R(0.5) * simd::sqrt(effective_eigenvalue(t, better));
    y = simd::select(loose, simd::min(y, better), y);
  }
  return y;
}

/// Accumulates a chunk's results, lane by lane, so that the sums do not depend on the register width.
struct ChunkSums {
  alignas(64) double energy[8] = {}, hourglass[8] = {}, removed_energy[8] = {}, inverse_step[8] = {}, where[8] = {};
  std::int32_t removed = 0, bad = -1;
};

/// Books the step of these lanes: small-step action, sums, bad elements.
/// @return 1/dt_e of the lanes that stay live, 0 elsewhere
template <class R>
ABUT_INLINE void book(const SolidConfig& c, const Lanes<R>& state, std::int32_t block, int lane, R inverse_step, decltype(R() > R()) bad,
                      ChunkSums& sums) {
  using N = simd::NumberTraits<R>;
  const R zero(0.0);
  const R live = state.get(f_live), off = state.get(f_off);
  const auto is_live = live > zero;
  if (simd::any(is_live & bad)) {
    alignas(64) double b[8];
    N::store(b, simd::select(is_live & bad, R(1.0), zero));
    for (int l = 0; l < N::width; ++l) {
      const std::int32_t e = block * 8 + lane + l;
      if (b[l] > 0.0 && (sums.bad < 0 || e < sums.bad)) sums.bad = e;
    }
  }
  R y = simd::select(is_live, inverse_step, zero);
  // s_e dt_e <= T_min  <=>  1/dt_e >= s_e / T_min
  if (c.remove_small_step && c.step_minimum > 0.0) {
    const auto small = y >= R(c.step_scale / c.step_minimum);
    if (simd::any(small)) {
      alignas(64) double b[8];
      N::store(b, simd::select(small, R(1.0), zero));
      for (int l = 0; l < N::width; ++l) sums.removed += b[l] > 0.0 ? 1 : 0;
      state.put(f_live, simd::select(small, zero, live));
      state.put(f_off, simd::select(small, zero, off));
      y = simd::select(small, zero, y);
    }
  }
  const R present = state.get(f_off), energy = state.get(f_energy), hourglass = state.get(f_hourglass);
  const R gone = R(1.0) - present;
  N::store(sums.energy + lane, N::load(sums.energy + lane) + present * energy);
  N::store(sums.hourglass + lane, N::load(sums.hourglass + lane) + present * hourglass);
  N::store(sums.removed_energy + lane, N::load(sums.removed_energy + lane) + gone * (energy + hourglass));
  const R best = N::load(sums.inverse_step + lane);
  const auto better = y > best;
  N::store(sums.inverse_step + lane, simd::select(better, y, best));
  N::store(sums.where + lane, simd::select(better, R(static_cast<double>(block)), N::load(sums.where + lane)));
}

/// Adds the forces of a block to the sums of its chunk, where they are asked for.
template <int corners>
ABUT_INLINE void add_to_chunk(const SolidTask& task, std::int32_t block) {
  if (task.sums == nullptr) return;
  add_block<corners, 4>(task.slots + static_cast<std::ptrdiff_t>(block) * task.slot_stride,
                        task.positions + static_cast<std::ptrdiff_t>(block) * (corners * 8), task.sums);
}

ABUT_INLINE void finish(const ChunkSums& sums, SolidChunk& chunk) {
  chunk = SolidChunk{};
  for (int l = 0; l < 8; ++l) {
    chunk.energy += sums.energy[l];
    chunk.hourglass += sums.hourglass[l];
    chunk.removed_energy += sums.removed_energy[l];
    const auto e = static_cast<std::int32_t>(sums.where[l]) * 8 + l;
    if (sums.inverse_step[l] > chunk.inverse_step ||
        (sums.inverse_step[l] == chunk.inverse_step && sums.inverse_step[l] > 0.0 && e < chunk.step_element)) {
      chunk.inverse_step = sums.inverse_step[l];
      chunk.step_element = e;
    }
  }
  chunk.removed = sums.removed;
  chunk.bad_element = sums.bad;
}

}  // namespace abut::elements
