// One-point brick with viscous hourglass control: Isolid 1 and 2, Iframe 1 (Jaumann) and 2 (co-rotational).
//
// Equation contract (numerics.md 4.1 to 4.5, 4.8, 2.1.5; [Flanagan Belytschko 1981], [Hallquist 1983])
//   Rows r_k = sum_I (xi, eta, zeta)_I x_I (8 J_0), det = r_xi . (r_eta x r_zeta), V = det/64 (the centre-Jacobian volume; the program and
//   hence we do not use the exact trilinear one), P_I = xi_I a + eta_I b + zeta_I c with (a, b, c) = (r_eta x r_zeta, ...)/det.
//   D = at_midpoint() of L (the program, Profile::StrainIncrement: Iframe 2 sym L - h/2 L^T L, Iframe 1 sym L).
//   L = v_xi a^T + v_eta b^T + v_zeta c^T with the same rows of v. f_I = V (sigma - q 1) P_I + sum_alpha gamma_I F_alpha.
//   Gamma: products xi eta, eta zeta, zeta xi, -xi eta zeta. gamma = Gamma - P.X, X = sum_J Gamma_J x_J, in Isolid 1 (the program and
//   Profile::HourglassModes: mode 4 as it is); Isolid 2: gamma = Gamma. Rates qdot = gamma . v = Gamma . v - L X. F = qdot (c_l + c_q
//   |qdot|), c_l = h/4 rho V^(2/3) c, c_q = 25 h c_l / c. Small strain (Ismstr 1): rows, X and face areas are those of cycle 0, in the
//   frame of cycle 0. Iframe 2 lets the frame rotate with the element; with Iframe 1 they stay attached to the global axes, so that it is
//   meant for small rotations only.
// The eight nodal forces are combinations of seven vectors (three rows, four modes): both frames rotate only those.
// Differs from [Flanagan Belytschko 1981]: V and P are those at the centre (numerics.md 4.1).
#pragma once

#include "elements/solid/solid_kernel.hpp"
#include "simd/prefetch.hpp"

namespace abut::elements {

/// Rows (xi, eta, zeta) and modes (Gamma 1..4) of a nodal field.
template <class R>
struct BrickModes {
  Vec<R> xi, eta, zeta, g1, g2, g3, g4;
};

/// A nodal field of an element's eight nodes.
template <class R>
struct NodalField {
  const double* field;
  const std::int32_t* offsets;
  [[gnu::always_inline]] inline Vec<R> operator()(int node) const { return simd::gather3(field, offsets + 8 * node, R()); }
};

/// @param at  the field's value at a node, 0 to 7. Opposite corners first, so that few values are under way at a time.
template <class R, class At>
ABUT_INLINE BrickModes<R> brick_modes(const At& at) {
  const Vec<R> n0 = at(0), n6 = at(6), d17 = n6 - n0, s17 = n6 + n0;
  const Vec<R> n1 = at(1), n7 = at(7), d28 = n7 - n1, s28 = n7 + n1;
  const Vec<R> d1m2 = d17 - d28, d1p2 = d17 + d28, s1m2 = s17 - s28, s1p2 = s17 + s28;
  const Vec<R> n2 = at(2), n4 = at(4), d35 = n4 - n2, s35 = n4 + n2;
  const Vec<R> n3 = at(3), n5 = at(5), d46 = n5 - n3, s46 = n5 + n3;
  const Vec<R> d3m4 = d35 - d46, d3p4 = d35 + d46, s3m4 = s35 - s46, s3p4 = s35 + s46;
  return {d1m2 - d3m4, d1p2 - d3p4, d1p2 + d3p4, s1m2 + s3m4, s1p2 - s3p4, s1m2 - s3m4, Vec<R>{} - (d1m2 + d3m4)};
}

/// Fields frozen in small strain.
inline constexpr int brick_frozen_fields = 22;  // 3 rows, 4 X, largest |p x q|^2 of the faces

/// Largest |p x q|^2 = (2 A)^2 over the faces; p, q the diagonals (2.1.5).
template <class R, class At>
ABUT_INLINE R largest_face(const At& at) {
  Vec<R> n[8];
  for (int k = 0; k < 8; ++k) n[k] = at(k);
  constexpr int faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  R largest(0.0);
  for (const auto& f : faces) {
    const Vec<R> a = cross(n[f[0]] - n[f[2]], n[f[1]] - n[f[3]]);
    largest = simd::max(largest, dot(a, a));
  }
  return largest;
}

template <class R>
ABUT_INLINE Vec<R> unit(const Vec<R>& a) {
  const R n = dot(a, a);
  const auto proper = n > R(0.0);
  return simd::select(proper, R(1.0) / simd::sqrt(simd::select(proper, n, R(1.0))), R(0.0)) * a;
}

/// Frame of Iframe 2 (4.3.3): rows e1, e2, e3 from (r_eta, r_zeta, r_xi).
template <class R>
ABUT_INLINE Matrix<R> brick_frame(const Vec<R>& r, const Vec<R>& s, const Vec<R>& t) {
  Vec<R> u = unit(r), v = unit(s), w = unit(t);
  for (int i = 0; i < 3; ++i) {
    const Vec<R> nu = u + cross(v, w), nv = v + cross(w, u), nw = w + cross(u, v);
    u = unit(nu);
    v = unit(nv);
    w = unit(nw);
  }
  const Vec<R> e3 = unit(cross(u, v));
  return {u, cross(e3, u), e3};
}

/// Size of a mode's rate.
template <class R>
ABUT_INLINE R size_of(const Vec<R>& a) {
  return simd::sqrt(dot(a, a));
}

/// F = qdot (c_l + c_q |qdot|), or component by component.
template <class R>
ABUT_INLINE Vec<R> hourglass_force(const Vec<R>& rate, R cl, R cq, bool objective) {
  if (objective) return (cl + cq * size_of(rate)) * rate;
  return {rate.x * (cl + cq * simd::abs(rate.x)), rate.y * (cl + cq * simd::abs(rate.y)), rate.z * (cl + cq * simd::abs(rate.z))};
}

template <class R>
ABUT_INLINE R largest_component(const Vec<R>& a) {
  return simd::max(simd::max(simd::abs(a.x), simd::abs(a.y)), simd::abs(a.z));
}

/// One component of the nodal forces, into the slots of the eight nodes.
template <class R>
ABUT_INLINE void scatter_component(double* slot, R mask, R q0, R q1, R q2, R q3, R q4, R q5, R q6) {
  using N = simd::NumberTraits<R>;
  q0 = mask * q0;
  q1 = mask * q1;
  q2 = mask * q2;
  q3 = mask * q3;
  q4 = mask * q4;
  q5 = mask * q5;
  q6 = mask * q6;
  const R ap = q0 + q1, am = q0 - q1;  // +-(xi + eta), +-(xi - eta)
  const R gp = q3 + q6, gm = q3 - q6;  // Gamma1 +- Gamma4
  const R hp = q4 + q5, hm = q4 - q5;  // Gamma2 +- Gamma3
  const R up = q2 + ap, um = q2 - ap, wp = q2 + am, wm = q2 - am;
  N::store(slot, (gp + hp) - up);                   // - - -   + + + +
  N::store(slot + 32, (hm - gp) - wm);              // + - -   - + - -
  N::store(slot + 64, (gp - hp) - um);              // + + -   + - - +
  N::store(slot + 96, (R(0.0) - (gp + hm)) - wp);   // - + -   - - + -
  N::store(slot + 128, (gm - hp) + um);             // - - +   + - - -
  N::store(slot + 160, (R(0.0) - (gm + hm)) + wp);  // + - +   - - + +
  N::store(slot + 192, (gm + hp) + up);             // + + +   + + + -
  N::store(slot + 224, (hm - gm) + wm);             // - + +   - + - +
}

template <bool Corotational, class R>
ABUT_INLINE void brick_lanes(const SolidTask& task, std::int32_t block, int lane, ChunkSums& sums) {
  using N = simd::NumberTraits<R>;
  const SolidConfig& c = *task.config;
  const R zero(0.0);
  const double dt = task.dt, inv_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  const Lanes<R> state{task.state + static_cast<std::ptrdiff_t>(block) * c.fields * 8 + lane};
  const std::int32_t* offsets = task.offsets + static_cast<std::ptrdiff_t>(block) * 64 + lane;

  // ---- gather
  R face = zero;
  const NodalField<R> x{task.x, offsets}, v{task.v, simd::forgotten(offsets)};
  BrickModes<R> m = brick_modes<R>(x);
  if (c.reference_step && !c.small_strain) face = largest_face<R>(x);
  Matrix<R> frame{};
  if constexpr (Corotational) {
    frame = brick_frame(m.eta, m.zeta, m.xi);
    put_frame(state, c.frame_field, frame);
    m.xi = apply(frame, m.xi);
    m.eta = apply(frame, m.eta);
    m.zeta = apply(frame, m.zeta);
    if (c.orthogonal_hourglass) {
      m.g1 = apply(frame, m.g1);
      m.g2 = apply(frame, m.g2);
      m.g3 = apply(frame, m.g3);
      m.g4 = apply(frame, m.g4);
    }
  }
  if (c.small_strain) {
    const int f = c.frozen_field;
    m.xi = {state.get(f), state.get(f + 1), state.get(f + 2)};
    m.eta = {state.get(f + 3), state.get(f + 4), state.get(f + 5)};
    m.zeta = {state.get(f + 6), state.get(f + 7), state.get(f + 8)};
    m.g1 = {state.get(f + 9), state.get(f + 10), state.get(f + 11)};
    m.g2 = {state.get(f + 12), state.get(f + 13), state.get(f + 14)};
    m.g3 = {state.get(f + 15), state.get(f + 16), state.get(f + 17)};
    m.g4 = {state.get(f + 18), state.get(f + 19), state.get(f + 20)};
    face = state.get(f + 21);
  }
  if (!c.orthogonal_fourth) m.g4 = {zero, zero, zero};
  // ---- geometry. A collapsed or inactive element gets P = 0 and hence no force.
  const Vec<R> ca = cross(m.eta, m.zeta), cb = cross(m.zeta, m.xi), cc = cross(m.xi, m.eta);
  const R det = dot(m.xi, ca);
  const R live = state.get(f_live);
  const auto sound = (det > zero) & (live > zero);
  const R inv = simd::select(sound, R(1.0) / simd::select(sound, det, R(1.0)), zero);
  const R old_volume = state.get(f_volume);
  const R volume = simd::select(sound, det * R(1.0 / 64.0), old_volume);
  const R inverse_volume = simd::select(sound, R(64.0) * inv, zero);
  update_length(c, state, volume);
  const Vec<R> a = inv * ca, b = inv * cb, d = inv * cc;

  // ---- velocity gradient
  BrickModes<R> w = brick_modes<R>(v);
  if constexpr (Corotational) {
    w.xi = apply(frame, w.xi);
    w.eta = apply(frame, w.eta);
    w.zeta = apply(frame, w.zeta);
    w.g1 = apply(frame, w.g1);
    w.g2 = apply(frame, w.g2);
    w.g3 = apply(frame, w.g3);
    w.g4 = apply(frame, w.g4);
  }
  Matrix<R> l;
  l.x = w.xi.x * a + w.eta.x * b + w.zeta.x * d;
  l.y = w.xi.y * a + w.eta.y * b + w.zeta.y * d;
  l.z = w.xi.z * a + w.eta.z * b + w.zeta.z * d;

  PointInput<R> in;
  in.volume = volume;
  in.inverse_volume = inverse_volume;
  if (c.midpoint_strain) {
    in.d = at_midpoint(l, dt);
  } else {
    in.d = symmetric_part(l);
    if constexpr (Corotational) in.d = in.d - second_order(l, R(0.5 * dt));
  }
  if constexpr (Corotational) {
    in.spin = {zero, zero, zero};
  } else {
    const R h(0.5 * dt);
    in.spin = {h * (l.z.y - l.y.z), h * (l.x.z - l.z.x), h * (l.y.x - l.x.y)};
  }
  const PointResult<R> point = update_point<Corotational>(c, dt, inv_dt, state, in);

  // ---- hourglass
  if (c.orthogonal_hourglass) {
    w.g1 = w.g1 - apply(l, m.g1);
    w.g2 = w.g2 - apply(l, m.g2);
    w.g3 = w.g3 - apply(l, m.g3);
    w.g4 = w.g4 - apply(l, m.g4);
  }
  const R cl = simd::select(sound, R(0.25 * c.hourglass * c.sound) * point.density * point.length * point.length, zero);
  const R cq = cl * R(25.0 * c.hourglass / c.sound);
  const bool objective = c.objective_hourglass;
  const Vec<R> f1 = hourglass_force(w.g1, cl, cq, objective), f2 = hourglass_force(w.g2, cl, cq, objective);
  const Vec<R> f3 = hourglass_force(w.g3, cl, cq, objective), f4 = hourglass_force(w.g4, cl, cq, objective);
  R hourglass_power = dot(f1, w.g1) + dot(f2, w.g2) + dot(f3, w.g3) + dot(f4, w.g4);
  if (c.trapezoidal_hourglass) {
    const int f = c.force_field;
    const Vec<R> o1{state.get(f), state.get(f + 1), state.get(f + 2)}, o2{state.get(f + 3), state.get(f + 4), state.get(f + 5)};
    const Vec<R> o3{state.get(f + 6), state.get(f + 7), state.get(f + 8)}, o4{state.get(f + 9), state.get(f + 10), state.get(f + 11)};
    const R before = dot(o1, w.g1) + dot(o2, w.g2) + dot(o3, w.g3) + dot(o4, w.g4);
    hourglass_power = R(0.5) * (hourglass_power + simd::select(sound, before, zero));
    const Vec<R> now[4] = {f1, f2, f3, f4};
    for (int i = 0; i < 4; ++i) {
      state.put(f + 3 * i, now[i].x);
      state.put(f + 3 * i + 1, now[i].y);
      state.put(f + 3 * i + 2, now[i].z);
    }
  }
  state.put(f_hourglass, state.get(f_hourglass) + R(dt) * hourglass_power);

  // ---- stability
  const R mass = state.get(f_mass);
  R inverse_step, stiffness;
  if (c.reference_step) {
    inverse_step = reference_inverse_step(c, point, simd::sqrt(face) * R(32.0) * inv);  // dx = 2 V/|p x q|
    stiffness = R(0.25) * mass * inverse_step * inverse_step;
  } else {
    const R eight(8.0);
    const R trace = eight * (dot(a, a) + dot(b, b) + dot(d, d));
    const Vec<R> diagonal{a.x * a.x + b.x * b.x + d.x * d.x, a.y * a.y + b.y * b.y + d.y * d.y, a.z * a.z + b.z * b.z + d.z * d.z};
    const Vec<R> mixed{a.x * a.y + b.x * b.y + d.x * d.y, a.y * a.z + b.y * b.z + d.y * d.z, a.z * a.x + b.z * b.x + d.z * d.x};
    const R squared = R(64.0) * (dot(diagonal, diagonal) + R(2.0) * dot(mixed, mixed));
    const R g = largest_gradient(trace, squared);
    const R per_mass = eight * state.get(f_inverse_mass);
    StabilityTerms<R> t = stability_terms(c, point, per_mass * volume, trace, g);
    const auto rate = [objective](const Vec<R>& g) { return objective ? dot(g, g) : largest_component(g); };
    R fastest = simd::max(simd::max(rate(w.g1), rate(w.g2)), simd::max(rate(w.g3), rate(w.g4)));
    if (objective) fastest = simd::sqrt(fastest);
    const R viscosity = per_mass * (cl + R(2.0) * cq * fastest);
    t.hourglass = eight * viscosity;
    if (c.orthogonal_hourglass) t.mixed = viscosity * (dot(m.g1, m.g1) + dot(m.g2, m.g2) + dot(m.g3, m.g3) + dot(m.g4, m.g4)) * g;
    inverse_step = c.step_wanted || !(dt > 0.0) ? bound_inverse_step(t) : zero;
    stiffness = R(1.0 / 16.0) * mass * effective_eigenvalue(t, dt > 0.0 ? R(c.viscous_rate * inv_dt) : inverse_step);
  }
  // A NaN compares false: what is not below the limit is bad.
  const auto bad = !(sound & (inverse_step < R(1e30)) & (stiffness < R(1e300)) & (simd::abs(state.get(f_energy)) < R(1e300)));
  book(c, state, block, lane, inverse_step, bad, sums);
  const auto acts = state.get(f_live) > zero;

  // ---- nodal forces from rows and modes: sigma V P plus the part of gamma along P
  const Sym<R>& s = point.stress;
  const R vol = simd::select(acts, volume, zero);
  Matrix<R> t{{vol * s.xx, vol * s.xy, vol * s.zx}, {vol * s.xy, vol * s.yy, vol * s.yz}, {vol * s.zx, vol * s.yz, vol * s.zz}};
  if (c.orthogonal_hourglass) {
    t.x = t.x - (f1.x * m.g1 + f2.x * m.g2 + f3.x * m.g3 + f4.x * m.g4);
    t.y = t.y - (f1.y * m.g1 + f2.y * m.g2 + f3.y * m.g3 + f4.y * m.g4);
    t.z = t.z - (f1.z * m.g1 + f2.z * m.g2 + f3.z * m.g3 + f4.z * m.g4);
  }
  Vec<R> q[7] = {apply(t, a), apply(t, b), apply(t, d), f1, f2, f3, f4};
  for (Vec<R>& f : q) {
    if constexpr (Corotational) f = apply_transposed(frame, f);
  }
  const R mask = simd::select(acts, R(1.0), zero);
  stiffness = simd::select(acts, stiffness, zero);

  // ---- scatter: node I gets xi q0 + eta q1 + zeta q2 + Gamma . (q3..q6)
  double* slots = task.slots + static_cast<std::ptrdiff_t>(block) * task.slot_stride + lane;
  for (int k = 0; k < 8; ++k) N::store(slots + k * 32 + 24, stiffness);
  scatter_component(slots, mask, q[0].x, q[1].x, q[2].x, q[3].x, q[4].x, q[5].x, q[6].x);
  scatter_component(slots + 8, mask, q[0].y, q[1].y, q[2].y, q[3].y, q[4].y, q[5].y, q[6].y);
  scatter_component(slots + 16, mask, q[0].z, q[1].z, q[2].z, q[3].z, q[4].z, q[5].z, q[6].z);
}

/// Steps a chunk of blocks.
template <class R>
ABUT_INLINE void brick_step(const SolidTask& task) {
  ChunkSums sums;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(task.config->fields) * 8;
  for (std::int32_t block = task.first; block < task.last; ++block) {
    if (block + 1 < task.last) simd::prefetch(task.state + (block + 1) * stride, static_cast<std::size_t>(stride));
    ask(task.ahead, static_cast<std::size_t>(block - task.first), static_cast<std::size_t>(task.last - task.first), {task.x, task.v});
    for (int lane = 0; lane < 8; lane += simd::NumberTraits<R>::width) {
      if (task.config->corotational) {
        brick_lanes<true, R>(task, block, lane, sums);
      } else {
        brick_lanes<false, R>(task, block, lane, sums);
      }
    }
    add_to_chunk<8>(task, block);
  }
  finish(sums, *task.chunk);
}

}  // namespace abut::elements
