// Four-node tetrahedron with constant strain, global frame.
//
// Equation contract (numerics.md 4.9, 2.1.7; constant-strain tetrahedron of any textbook)
//   6V = (x2 - x1).[(x3 - x1) x (x4 - x1)], grad N_2 = (x3 - x1) x (x4 - x1)/(6V), ..., grad N_1 = -(grad N_2 + grad N_3 + grad N_4).
//   L = sum_I v_I grad N_I^T, D = at_midpoint() (small strain: sym L; the program: sym L - h/2 L^T L), spin increment W = h skew L, f_I = V
//   (sigma - q 1) grad N_I. reference step: dx = 1/max |grad N_I|.
// Bound step: solid_kernel.hpp with G = sum_I grad N_I grad N_I^T / (m_I/m_e), which covers unequal nodal masses.
// The reference also subtracts h/2 (L^T L)_ij from the three spin components, a symmetric term that is no rotation: choice
// Profile::TetraSpin.
// Small strain (Ismstr 1): edges of cycle 0 in global axes, for small rotations.
#pragma once

#include "elements/solid/solid_kernel.hpp"

namespace abut::elements {

inline constexpr int tetra_frozen_fields = 9;  // three edges
inline constexpr int tetra_share_fields = 8;   // m_I/m_e, then m_e/m_I

template <class R>
ABUT_INLINE void tetra_lanes(const SolidTask& task, std::int32_t block, int lane, ChunkSums& sums) {
  using N = simd::NumberTraits<R>;
  const SolidConfig& c = *task.config;
  const R zero(0.0);
  const double dt = task.dt, inv_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  const Lanes<R> state{task.state + static_cast<std::ptrdiff_t>(block) * c.fields * 8 + lane};
  const std::int32_t* offsets = task.offsets + static_cast<std::ptrdiff_t>(block) * 32 + lane;

  // ---- gather
  Vec<R> x[4], v[4];
  for (int k = 0; k < 4; ++k) {
    x[k] = simd::gather3(task.x, offsets + 8 * k, R());
    v[k] = simd::gather3(task.v, offsets + 8 * k, R());
  }
  Vec<R> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
  if (c.small_strain) {
    const int f = c.frozen_field;
    e1 = {state.get(f), state.get(f + 1), state.get(f + 2)};
    e2 = {state.get(f + 3), state.get(f + 4), state.get(f + 5)};
    e3 = {state.get(f + 6), state.get(f + 7), state.get(f + 8)};
  }

  // ---- compute. A collapsed or inactive element gets zero gradients and hence no force.
  const Vec<R> c1 = cross(e2, e3), c2 = cross(e3, e1), c3 = cross(e1, e2);
  const R det = dot(e1, c1);
  const auto sound = (det > zero) & (state.get(f_live) > zero);
  const R inv = simd::select(sound, R(1.0) / simd::select(sound, det, R(1.0)), zero);
  const Vec<R> p1 = inv * c1, p2 = inv * c2, p3 = inv * c3;
  const Vec<R> p0 = Vec<R>{zero, zero, zero} - (p1 + p2 + p3);
  const Vec<R> w1 = v[1] - v[0], w2 = v[2] - v[0], w3 = v[3] - v[0];
  Matrix<R> l;
  l.x = w1.x * p1 + w2.x * p2 + w3.x * p3;
  l.y = w1.y * p1 + w2.y * p2 + w3.y * p3;
  l.z = w1.z * p1 + w2.z * p2 + w3.z * p3;

  PointInput<R> in;
  in.volume = simd::select(sound, det * R(1.0 / 6.0), state.get(f_volume));
  in.inverse_volume = simd::select(sound, R(6.0) * inv, zero);
  const R h(0.5 * dt);
  in.spin = {h * (l.z.y - l.y.z), h * (l.x.z - l.z.x), h * (l.y.x - l.x.y)};
  if (c.midpoint_strain) {
    in.d = at_midpoint(l, dt);
  } else {
    in.d = symmetric_part(l);
    if (!c.small_strain) {
      const Sym<R> quadratic = second_order(l, h);
      in.d = in.d - quadratic;
      if (c.literal_spin) {
        const R step(dt);
        in.spin = in.spin - Vec<R>{step * quadratic.yz, step * quadratic.zx, step * quadratic.xy};
      }
    }
  }
  update_length(c, state, in.volume);
  const PointResult<R> point = update_point<false>(c, dt, inv_dt, state, in);

  // ---- stability
  const R mass = state.get(f_mass);
  const int share = c.share_field;
  R inverse_step, stiffness[4];
  if (c.reference_step) {
    const R steepest = simd::max(simd::max(dot(p0, p0), dot(p1, p1)), simd::max(dot(p2, p2), dot(p3, p3)));
    inverse_step = reference_inverse_step(c, point, simd::sqrt(steepest));
    for (R& k : stiffness) k = R(0.5) * mass * inverse_step * inverse_step;
  } else {
    const R i0 = state.get(share + 4), i1 = state.get(share + 5), i2 = state.get(share + 6), i3 = state.get(share + 7);
    const Vec<R> q0 = i0 * p0, q1 = i1 * p1, q2 = i2 * p2, q3 = i3 * p3;
    const Vec<R> diagonal{p0.x * q0.x + p1.x * q1.x + p2.x * q2.x + p3.x * q3.x, p0.y * q0.y + p1.y * q1.y + p2.y * q2.y + p3.y * q3.y,
                          p0.z * q0.z + p1.z * q1.z + p2.z * q2.z + p3.z * q3.z};
    const Vec<R> mixed{p0.x * q0.y + p1.x * q1.y + p2.x * q2.y + p3.x * q3.y, p0.y * q0.z + p1.y * q1.z + p2.y * q2.z + p3.y * q3.z,
                       p0.z * q0.x + p1.z * q1.x + p2.z * q2.x + p3.z * q3.x};
    const R trace = diagonal.x + diagonal.y + diagonal.z;
    const R g = largest_gradient(trace, dot(diagonal, diagonal) + R(2.0) * dot(mixed, mixed));
    const StabilityTerms<R> t = stability_terms(c, point, in.volume * state.get(f_inverse_mass), trace, g);
    inverse_step = c.step_wanted || !(dt > 0.0) ? bound_inverse_step(t) : zero;
    const R eigenvalue = R(0.5) * mass * effective_eigenvalue(t, dt > 0.0 ? R(c.viscous_rate * inv_dt) : inverse_step);
    for (int k = 0; k < 4; ++k) stiffness[k] = state.get(share + k) * eigenvalue;
  }
  const auto bad = !(sound & (inverse_step < R(1e30)) & (stiffness[0] < R(1e300)) & (simd::abs(state.get(f_energy)) < R(1e300)));
  book(c, state, block, lane, inverse_step, bad, sums);
  const auto acts = state.get(f_live) > zero;

  // ---- scatter
  const Sym<R>& s = point.stress;
  const R vol = simd::select(acts, in.volume, zero);
  const Matrix<R> t{{vol * s.xx, vol * s.xy, vol * s.zx}, {vol * s.xy, vol * s.yy, vol * s.yz}, {vol * s.zx, vol * s.yz, vol * s.zz}};
  const Vec<R> f[4] = {apply(t, p0), apply(t, p1), apply(t, p2), apply(t, p3)};
  double* slots = task.slots + static_cast<std::ptrdiff_t>(block) * task.slot_stride + lane;
  for (int k = 0; k < 4; ++k) {
    N::store(slots + k * 32, f[k].x);
    N::store(slots + k * 32 + 8, f[k].y);
    N::store(slots + k * 32 + 16, f[k].z);
    N::store(slots + k * 32 + 24, simd::select(acts, stiffness[k], zero));
  }
}

/// Steps a chunk of blocks.
template <class R>
ABUT_INLINE void tetra_step(const SolidTask& task) {
  ChunkSums sums;
  for (std::int32_t block = task.first; block < task.last; ++block) {
    ask(task.ahead, static_cast<std::size_t>(block - task.first), static_cast<std::size_t>(task.last - task.first), {task.x, task.v});
    for (int lane = 0; lane < 8; lane += simd::NumberTraits<R>::width) tetra_lanes<R>(task, block, lane, sums);
    add_to_chunk<4>(task, block);
  }
  finish(sums, *task.chunk);
}

}  // namespace abut::elements
