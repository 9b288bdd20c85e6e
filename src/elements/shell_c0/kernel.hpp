// One step of the C0 triangle (Ish3n 1 and 2): constant strain, constant curvature, one-point assumed transverse shear.
//
// Equation contract (numerics.md 3.10; Belytschko, Stolarski, Carpenter, IJNME 20 (1984) 787; Kennedy, Belytschko, Lin (1986)):
//   frame e1 along side 1-2, e3 normal; P_x1 = -y3/2, P_y1 = (x3 - x2)/2, P_x2 = y3/2, P_y2 = -x3/2, P_x3 = 0, P_y3 = x2/2
//   rates as for the quad with these P; transverse shear with the rows below, moments with their transposes
//   all rates those of mid-step (Profile::StrainIncrement; docs/theory/elements.md), or the reference's second-order corrections a, b
//   (out-of-plane rotation), from absolute velocities in the frame, and a', b' in the plane (Ish3n 2)
// Step, reference (numerics.md 2.1.3, 2.2): L = 2A/longest side. Bound: the form of shell_q4/step_length.hpp with node masses mu_I:
// p = sum_I P_I P_I^T/mu_I is a 2 by 2 tensor, k_m = t/(2A) (A11 tr p + sqrt(A11^2 (tr^2 - 4 det) + 4 A12^2 det)) is exact,
// k_b = k_m t^2/(12 r^2), k_s = kappa_s G t A times the largest eigenvalue of the 2 by 2 matrix B_s M^-1 B_s^T (exact). Bending and shear
// see the same rotations: k = max(k_m, k_b + k_s). nu >= 0.
#pragma once

#include "elements/shell_c0/parameters.hpp"
#include "elements/shell_common/finish_block.hpp"
#include "elements/shell_common/kernel_args.hpp"
#include "elements/shell_common/section.hpp"
#include "elements/shell_common/stable_step.hpp"
#include "simd/prefetch.hpp"

namespace abut::elements {

template <class T>
struct C0Geometry {
  Vec<T> e1, e2, e3;
  T x2, x3, y3;
  T px1, py1, py2, py3, area;  ///< P_x2 = -P_x1, P_x3 = 0
};

template <class T>
ABUT_INLINE C0Geometry<T> c0_geometry(const Vec<T>& x1, const Vec<T>& x2, const Vec<T>& x3) {
  C0Geometry<T> g;
  const T one = T(1.0), half = T(0.5);
  const Vec<T> d2 = x2 - x1, d3 = x3 - x1;
  const Vec<T> n = cross(d2, d3);
  g.x2 = sqrt(dot(d2, d2));
  g.e1 = (one / g.x2) * d2;
  g.e3 = (one / sqrt(dot(n, n))) * n;
  g.e2 = cross(g.e3, g.e1);
  g.x3 = dot(d3, g.e1);
  g.y3 = dot(d3, g.e2);
  g.px1 = -(half * g.y3);
  g.py1 = half * (g.x3 - g.x2);
  g.py2 = -(half * g.x3);
  g.py3 = half * g.x2;
  g.area = half * g.x2 * g.y3;
  return g;
}

/// Transverse shear on the rotations, times A: rows of gamma_zx and gamma_yz.
template <class T>
struct C0ShearRows {
  T zx_x1, zx_x2, zx_y1, zx_y2, zx_y3;
  T yz_x1, yz_x2, yz_x3, yz_y1, yz_y2, yz_y3;
};

template <class T>
ABUT_INLINE C0ShearRows<T> c0_shear_rows(const C0Geometry<T>& g) {
  const T two = T(2.0), three = T(3.0);
  const T c = T(1.0 / 3.0) * g.px1, third = T(1.0 / 3.0);
  const T sum = g.py1 + g.py2, one_two = g.py1 + two * g.py2, two_one = two * g.py1 + g.py2;
  C0ShearRows<T> r;
  r.zx_x1 = -(c * g.px1);
  r.zx_x2 = c * g.px1;
  r.zx_y1 = c * (two * g.py1 + three * g.py2);
  r.zx_y2 = c * (three * g.py1 + two * g.py2);
  r.zx_y3 = c * sum;
  r.yz_x1 = -(c * two_one);
  r.yz_x2 = -(c * one_two);
  r.yz_x3 = -(c * three * sum);
  r.yz_y1 = third * g.py1 * one_two;
  r.yz_y2 = -(third * g.py2 * two_one);
  r.yz_y3 = third * (g.py2 * g.py2 - g.py1 * g.py1);
  return r;
}

template <class T>
ABUT_INLINE ShellStep<T> c0_step_bound(const ShellSection& s, const C0Geometry<T>& g, const C0ShearRows<T>& r, T t, T m1, T m2, T m3,
                                       T inertia, double h) {
  const T one = T(1.0), four = T(4.0), half = T(0.5), zero = T(0.0);
  const T i1 = one / m1, i2 = one / m2, i3 = one / m3;
  const T pxx = g.px1 * g.px1 * (i1 + i2);
  const T pyy = g.py1 * g.py1 * i1 + g.py2 * g.py2 * i2 + g.py3 * g.py3 * i3;
  const T pxy = g.px1 * (g.py1 * i1 - g.py2 * i2);
  const T trace = pxx + pyy, det = max(pxx * pyy - pxy * pxy, zero);
  const T split = max(trace * trace - four * det, zero);
  const T t_per_a = t / g.area;
  const double a11 = s.elastic.a11, a12 = s.elastic.a12;
  const T membrane = half * t_per_a * (T(a11) * trace + sqrt(T(a11 * a11) * split + T(4.0 * a12 * a12) * det));
  T k = membrane;
  if (s.bending) {
    const T ir = one / inertia;
    const T bending = membrane * T(1.0 / 12.0) * t * t * ir;
    const T zz =
        pxx + ir * (i1 * (r.zx_x1 * r.zx_x1 + r.zx_y1 * r.zx_y1) + i2 * (r.zx_x2 * r.zx_x2 + r.zx_y2 * r.zx_y2) + i3 * (r.zx_y3 * r.zx_y3));
    const T yy = pyy + ir * (i1 * (r.yz_x1 * r.yz_x1 + r.yz_y1 * r.yz_y1) + i2 * (r.yz_x2 * r.yz_x2 + r.yz_y2 * r.yz_y2) +
                             i3 * (r.yz_x3 * r.yz_x3 + r.yz_y3 * r.yz_y3));
    const T zy =
        pxy + ir * (i1 * (r.zx_x1 * r.yz_x1 + r.zx_y1 * r.yz_y1) + i2 * (r.zx_x2 * r.yz_x2 + r.zx_y2 * r.yz_y2) + i3 * (r.zx_y3 * r.yz_y3));
    const T largest = half * (zz + yy + sqrt((zz - yy) * (zz - yy) + four * zy * zy));
    k = max(k, bending + T(s.shear_factor * s.elastic.shear) * t_per_a * largest);
  }
  T c = zero;
  if (s.membrane_damping > 0.0) { c = t_per_a * T(s.membrane_damping) * sqrt(g.area) * damping_eigenvalue(trace, det); }
  return bounded_step(s.step_wanted, k, c, h, s.viscous_rate);
}

template <class T>
ABUT_INLINE ShellStep<T> c0_step_reference(const ShellSection& s, const C0Parameters& q, const C0Geometry<T>& g, T t, double damping) {
  const T x32 = g.x3 - g.x2;
  const T longest = max(g.x2 * g.x2, max(g.x3 * g.x3, x32 * x32) + g.y3 * g.y3);
  const T length2 = T(4.0) * g.area * g.area / longest;
  ShellStep<T> out;
  out.step = sqrt(length2) * T(damping / s.sound);
  out.per_mass = T(0.0);
  const T base = g.area * t * T(s.elastic.a11 / (damping * damping)) / length2;
  if (q.nodal_step) {
    out.stiffness = base;
    out.rotational = base * (t * t * T(1.0 / 12.0) + T(0.5 * s.shear_factor * s.elastic.shear / s.elastic.a11) * g.area);
  } else {
    out.stiffness = T(0.81 * 0.81) * base;
    out.rotational = T(0.0);
  }
  return out;
}

/// The NumberTraits<T>::width elements from `lane` on of one block.
template <class T, ShellLaw law>
ABUT_INLINE void c0_lanes(const ShellKernelArgs& args, const C0Parameters& q, double damping, std::size_t block, int lane) {
  using section_detail::get;
  using section_detail::put;
  const ShellSection& s = *args.section;
  const double h = args.h;
  double* state = args.state + block * static_cast<std::size_t>(s.variables * shell_lanes) + lane;
  const double* constants = args.constants + block * (shell_constant::triangle_count * shell_lanes) + lane;
  const std::int32_t* nodes = args.nodes + block * (3 * shell_lanes) + lane;
  double* slots = args.slots + block * args.slot_stride + lane;
  const T zero = T(0.0), one = T(1.0);

  // gather
  const Vec<T> gv1 = gather(T{}, args.v, nodes), gv2 = gather(T{}, args.v, nodes + 8), gv3 = gather(T{}, args.v, nodes + 16);
  const Vec<T> gw1 = gather(T{}, args.w, nodes), gw2 = gather(T{}, args.w, nodes + 8), gw3 = gather(T{}, args.w, nodes + 16);
  const T not_rigid = simd::NumberTraits<T>::load(constants + shell_constant::active * shell_lanes);
  const auto alive = (get<T>(state, shell_state::off) > zero) & (not_rigid > zero);

  // geometry and velocities in the frame
  const C0Geometry<T> g = c0_geometry(gather(T{}, args.x, nodes), gather(T{}, args.x, nodes + 8), gather(T{}, args.x, nodes + 16));
  const T inverse_area = one / g.area;
  const T vx1 = dot(gv1, g.e1), vx2 = dot(gv2, g.e1), vx3 = dot(gv3, g.e1);
  const T vy1 = dot(gv1, g.e2), vy2 = dot(gv2, g.e2), vy3 = dot(gv3, g.e2);
  const T vz1 = dot(gv1, g.e3), vz2 = dot(gv2, g.e3), vz3 = dot(gv3, g.e3);
  T wx1 = dot(gw1, g.e1), wx2 = dot(gw2, g.e1), wx3 = dot(gw3, g.e1);
  T wy1 = dot(gw1, g.e2), wy2 = dot(gw2, g.e2), wy3 = dot(gw3, g.e2);

  // slopes of v_z, second-order corrections
  const T slope_x = g.px1 * (vz1 - vz2), slope_y = g.py1 * (vz1 - vz3) + g.py2 * (vz2 - vz3);
  T hx1 = vx1, hx2 = vx2, hx3 = vx3, hy1 = vy1, hy2 = vy2, hy3 = vy3;
  if (!q.midpoint) {
    const T quarter = T(0.25 * h);
    const T p_bar = g.py1 + g.py2, inverse_p = one / p_bar;
    const T per_p = quarter * inverse_p, per_x = quarter / g.px1;
    const T a = per_p * (vz1 - vz2), b = per_x * ((g.py1 * vz1 + g.py2 * vz2) * inverse_p - vz3);
    hx1 = vx1 - a * vz1;
    hx2 = vx2 - a * vz2;
    hx3 = vx3 - a * vz3;
    hy1 = vy1 - b * vz1;
    hy2 = vy2 - b * vz2;
    hy3 = vy3 - b * vz3;
    if (q.large_rotation) {
      const T a2 = per_p * (vy1 - vy2), b2 = per_x * ((g.py1 * vx1 + g.py2 * vx2) * inverse_p - vx3);
      hx1 -= a2 * vy1;
      hx2 -= a2 * vy2;
      hx3 -= a2 * vy3;
      hy1 -= b2 * vx1;
      hy2 -= b2 * vx2;
      hy3 -= b2 * vx3;
    }
  }

  // rates
  ShellRates<T> rate;
  rate.exx = g.px1 * (hx1 - hx2) * inverse_area;
  rate.eyy = (g.py1 * (hy1 - hy3) + g.py2 * (hy2 - hy3)) * inverse_area;
  const T gxy = (g.py1 * (hx1 - hx3) + g.py2 * (hx2 - hx3)) * inverse_area, gyx = g.px1 * (hy1 - hy2) * inverse_area;
  rate.gxy = gxy + gyx;
  T shear_x = slope_x, shear_y = slope_y;
  if (q.midpoint) {
    // As in shell_q4/kernel.hpp; the frame follows side 1-2.
    const T half = T(0.5 * h), dxx = rate.exx, dyy = rate.eyy, gx = slope_x * inverse_area, gy = slope_y * inverse_area;
    const T a = half * gyx, b = half * gx, c = half * gy, two = T(2.0);
    membrane_at_midpoint(rate, dxx, gxy, gyx, dyy, gx, gy, T(h), 0.5);
    shear_x = slope_x + g.area * (two * (b * dxx + c * gyx) - a * gy);
    shear_y = slope_y + g.area * (two * (b * gxy + c * dyy) + a * gx);
    const auto turn = [&](T & x, T & y, const Vec<T>& w) __attribute__((always_inline)) {
      const T was = x, z = dot(w, g.e3);
      x = (x - a * y) - b * z;
      y = (y + a * was) - c * z;
    };
    turn(wx1, wy1, gw1);
    turn(wx2, wy2, gw2);
    turn(wx3, wy3, gw3);
    curvature_at_midpoint(rate, g.px1 * (wx1 - wx2) * inverse_area, (g.py1 * (wx1 - wx3) + g.py2 * (wx2 - wx3)) * inverse_area,
                          g.px1 * (wy1 - wy2) * inverse_area, (g.py1 * (wy1 - wy3) + g.py2 * (wy2 - wy3)) * inverse_area, half * rate.exx,
                          T(0.0), half * rate.gxy, half * rate.eyy);
  } else {
    rate.kxx = g.px1 * (wy1 - wy2) * inverse_area;
    rate.kyy = -((g.py1 * (wx1 - wx3) + g.py2 * (wx2 - wx3)) * inverse_area);
    rate.kxy = (g.py1 * (wy1 - wy3) + g.py2 * (wy2 - wy3) - g.px1 * (wx1 - wx2)) * inverse_area;
  }
  const C0ShearRows<T> r = c0_shear_rows(g);
  const T zx = shear_x + (r.zx_x1 * wx1 + r.zx_x2 * wx2) + (r.zx_y1 * wy1 + r.zx_y2 * wy2 + r.zx_y3 * wy3);
  const T yz = shear_y + (r.yz_x1 * wx1 + r.yz_x2 * wx2 + r.yz_x3 * wx3) + (r.yz_y1 * wy1 + r.yz_y2 * wy2 + r.yz_y3 * wy3);
  rate.exx = select(alive, rate.exx, zero);
  rate.eyy = select(alive, rate.eyy, zero);
  rate.gxy = select(alive, rate.gxy, zero);
  rate.gyz = select(alive, yz * inverse_area, zero);
  rate.gzx = select(alive, zx * inverse_area, zero);
  rate.kxx = select(alive, rate.kxx, zero);
  rate.kyy = select(alive, rate.kyy, zero);
  rate.kxy = select(alive, rate.kxy, zero);

  const ShellForces<T> n = update_section<T, law>(s, state, rate, h, g.area);
  const T t = n.thickness, t2 = t * t;

  // forces and moments in the frame
  const T nxx = t * n.fxx, nyy = t * n.fyy, nxy = t * n.fxy, nyz = t * n.fyz, nzx = t * n.fzx;
  const T mxx = t2 * n.mxx, myy = t2 * n.myy, mxy = t2 * n.mxy;
  const T f1x = nxx * g.px1 + nxy * g.py1, f2x = nxy * g.py2 - nxx * g.px1, f3x = nxy * g.py3;
  const T f1y = nyy * g.py1 + nxy * g.px1, f2y = nyy * g.py2 - nxy * g.px1, f3y = nyy * g.py3;
  const T f1z = nzx * g.px1 + nyz * g.py1, f2z = nyz * g.py2 - nzx * g.px1, f3z = nyz * g.py3;
  const T m1x = nzx * r.zx_x1 + nyz * r.yz_x1 - (myy * g.py1 + mxy * g.px1);
  const T m2x = nzx * r.zx_x2 + nyz * r.yz_x2 - (myy * g.py2 - mxy * g.px1);
  const T m3x = nyz * r.yz_x3 - myy * g.py3;
  const T m1y = nzx * r.zx_y1 + nyz * r.yz_y1 + (mxx * g.px1 + mxy * g.py1);
  const T m2y = nzx * r.zx_y2 + nyz * r.yz_y2 + (mxy * g.py2 - mxx * g.px1);
  const T m3y = nzx * r.zx_y3 + nyz * r.yz_y3 + mxy * g.py3;

  // scatter
  T mass[3];
  for (int i = 0; i < 3; ++i) mass[i] = simd::NumberTraits<T>::load(constants + (shell_constant::mass + i) * shell_lanes);
  const T inertia = simd::NumberTraits<T>::load(constants + shell_constant::inertia * shell_lanes);
  const ShellStep<T> step =
      q.step_bound ? c0_step_bound(s, g, r, t, mass[0], mass[1], mass[2], inertia, h) : c0_step_reference(s, q, g, t, damping);
  const auto stays = alive & (n.off > zero);
  simd::NumberTraits<T>::store(args.steps + block * args.step_stride + static_cast<std::size_t>(lane), select(stays, step.step, T(1e30)));
  const Vec<T> f[3] = {f1x * g.e1 + f1y * g.e2 + f1z * g.e3, f2x * g.e1 + f2y * g.e2 + f2z * g.e3, f3x * g.e1 + f3y * g.e2 + f3z * g.e3};
  const Vec<T> m[3] = {m1x * g.e1 + m1y * g.e2, m2x * g.e1 + m2y * g.e2, m3x * g.e1 + m3y * g.e2};
  for (int i = 0; i < 3; ++i) {
    double* slot = slots + i * 8 * shell_lanes;
    const T k = q.step_bound ? step.per_mass * mass[i] : step.stiffness;
    const T kr = q.step_bound ? k * inertia : step.rotational;
    put(slot, 0, select(stays, f[i].x, zero));
    put(slot, 1, select(stays, f[i].y, zero));
    put(slot, 2, select(stays, f[i].z, zero));
    put(slot, 3, select(stays, k, zero));
    put(slot, 4, select(stays, m[i].x, zero));
    put(slot, 5, select(stays, m[i].y, zero));
    put(slot, 6, select(stays, m[i].z, zero));
    put(slot, 7, select(stays, kr, zero));
  }
}

/// Blocks [begin, end). `damping`: sqrt(1 + dm^2) - dm, the factor of the reference's step.
template <class T, ShellLaw law>
ABUT_INLINE void c0_blocks(const ShellKernelArgs& args, const C0Parameters& q, double damping, std::size_t begin, std::size_t end) {
  const auto stride = static_cast<std::size_t>(args.section->variables * shell_lanes);
  for (std::size_t b = begin; b < end; ++b) {
    simd::prefetch(args.state + (b + 1) * stride, stride);
    ask(args.ahead, b - begin, end - begin, {args.x, args.v, args.w});
    for (int lane = 0; lane < shell_lanes; lane += simd::NumberTraits<T>::width) c0_lanes<T, law>(args, q, damping, b, lane);
    finish_block<T, 3>(args, b);
  }
}

}  // namespace abut::elements
