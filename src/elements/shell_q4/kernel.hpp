// One step of the one-point quadrilateral shell (Belytschko-Tsay family, Ishell 1 to 4).
//
// Equation contract (numerics.md 3.2, 3.3, 3.8; Belytschko, Lin, Tsay, CMAME 42 (1984) 225; Belytschko, Tsay, IJNME 19 (1983) 405):
//   rates   A e_xx = P_x . v_x, A kappa_xx = P_x . w_y, A gamma_zx = P_x . v_z + A/4 sum w_y, ... at the centre, in the frame of x^n
//   forces  f_xI = t (F_xx P_xI + F_xy P_yI), m_yI = t^2 (M_xx P_xI + M_xy P_yI) + t A F_zx/4, ... plus hourglass
// Symbols: d13 = value at node 1 minus value at node 3; hg = value_1 - value_2 + value_3 - value_4. Since P_3 = -P_1 and P_4 = -P_2, only
// d13, d24 and hg of the velocities (and the sum of the rotations) are needed, and only these are rotated into the frame.
// Rates are those of mid-step (docs/theory/elements.md, strain increments; Profile::StrainIncrement): the membrane by
// membrane_at_midpoint(), all others along the frame of mid-step, gamma . v also with the turn of the pattern that gamma of x^n sees late.
// The reference instead takes part of the stretch of theta^2/2 out of the velocities that a finite rotation out of the plane leaves
// (numerics.md 3.3). Ishell 1, 2: delta_x = c h (d13 v_z - d24 v_z)^2/(P_y1 + P_y2), likewise y, c = 1/4; for a rectangle turning about e2
// that changes the strain by -4 c theta^2, so c = 1/8 would be right (Profile::ShellRotation).
// Elements that are off or rigid see zero rates and write zeros.
#pragma once

#include "elements/shell_common/finish_block.hpp"
#include "elements/shell_common/kernel_args.hpp"
#include "elements/shell_common/section.hpp"
#include "elements/shell_q4/frozen.hpp"
#include "elements/shell_q4/geometry.hpp"
#include "elements/shell_q4/hourglass.hpp"
#include "elements/shell_q4/parameters.hpp"
#include "elements/shell_q4/step_length.hpp"
#include "simd/prefetch.hpp"

namespace abut::elements {

namespace q4_detail {

/// |d| not below 1e-20, sign kept.
template <class T>
ABUT_INLINE T guarded(T d) {
  const T tiny = T(1e-20);
  return select(d < T(0.0), min(d, -tiny), max(d, tiny));
}

template <class T>
ABUT_INLINE void store_slot(double* slot, int component, T value) {
  simd::NumberTraits<T>::store(slot + component * shell_lanes, value);
}

}  // namespace q4_detail

/// Geometry at t^n and velocity differences in the frame: d13 = node 1 minus node 3, h = 1 - 2 + 3 - 4, s = sum.
template <class T>
struct Q4Motion {
  Q4Geometry<T> g;
  T vx13, vy13, vz13, vx24, vy24, vz24, vxh, vyh, vzh;
  T wx13, wy13, wz13, wx24, wy24, wz24, wxs, wys, wzs, wxh, wyh, wzh;
  Q4Shape<T> now;  ///< with local_rates
};

/// First stage: positions, frame, operators.
template <class T, bool local_rates>
ABUT_INLINE void q4_geometry(const ShellKernelArgs& args, const Q4Parameters& q, double* state, const std::int32_t* nodes,
                             Q4Motion<T>& motion) {
  Q4Geometry<T>& g = motion.g;
  q4_frame(q.frame_v4, gather(T{}, args.x, nodes), gather(T{}, args.x, nodes + 8), gather(T{}, args.x, nodes + 16),
           gather(T{}, args.x, nodes + 24), g);
  if constexpr (local_rates) motion.now = {-g.x3, -g.y3, g.x2 - g.x4, g.y2 - g.y4, pattern_x(g), pattern_y(g), T(-2.0) * g.z2};
  if (q.may_freeze) q4_detail::freeze(state + q.at_frozen * shell_lanes, g);
  q4_operators(q.plain_gamma, g);
}

/// Second stage: velocities in the frame.
template <class T>
ABUT_INLINE void q4_motion(const ShellKernelArgs& args, const std::int32_t* nodes, Q4Motion<T>& m) {
  const Q4Geometry<T>& g = m.g;
  // Differences first, then into the frame.
  {
    const Vec<T> v1 = gather(T{}, args.v, nodes), v3 = gather(T{}, args.v, nodes + 16);
    const Vec<T> v2 = gather(T{}, args.v, nodes + 8), v4 = gather(T{}, args.v, nodes + 24);
    const Vec<T> d13 = v1 - v3, d24 = v2 - v4, hg = (v1 - v2) + (v3 - v4);
    m.vx13 = dot(d13, g.e1);
    m.vy13 = dot(d13, g.e2);
    m.vz13 = dot(d13, g.e3);
    m.vx24 = dot(d24, g.e1);
    m.vy24 = dot(d24, g.e2);
    m.vz24 = dot(d24, g.e3);
    m.vxh = dot(hg, g.e1);
    m.vyh = dot(hg, g.e2);
    m.vzh = dot(hg, g.e3);
  }
  const Vec<T> w1 = gather(T{}, args.w, nodes), w3 = gather(T{}, args.w, nodes + 16);
  const Vec<T> w2 = gather(T{}, args.w, nodes + 8), w4 = gather(T{}, args.w, nodes + 24);
  const Vec<T> d13 = w1 - w3, d24 = w2 - w4, s13 = w1 + w3, s24 = w2 + w4;
  const Vec<T> sum = s13 + s24, hg = s13 - s24;
  m.wx13 = dot(d13, g.e1);
  m.wy13 = dot(d13, g.e2);
  m.wx24 = dot(d24, g.e1);
  m.wy24 = dot(d24, g.e2);
  m.wxs = dot(sum, g.e1);
  m.wys = dot(sum, g.e2);
  m.wxh = dot(hg, g.e1);
  m.wyh = dot(hg, g.e2);
  m.wz13 = dot(d13, g.e3);
  m.wz24 = dot(d24, g.e3);
  m.wzs = dot(sum, g.e3);
  m.wzh = dot(hg, g.e3);
}

/// Third stage: rates, section, hourglass, forces, for the NumberTraits<T>::width elements from `lane` on of one block.
template <class T, ShellLaw law, bool local_rates>
ABUT_INLINE void q4_lanes(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t block, int lane,
                          const Q4Motion<T>& motion) {
  using section_detail::get;
  const ShellSection& s = *args.section;
  const double h = args.h;
  double* state = args.state + block * static_cast<std::size_t>(s.variables * shell_lanes) + lane;
  const double* constants = args.constants + block * (shell_constant::quad_count * shell_lanes) + lane;
  double* slots = args.slots + block * args.slot_stride + lane;
  const T zero = T(0.0), two = T(2.0);

  const T regular = simd::NumberTraits<T>::load(constants + shell_constant::regular * shell_lanes);
  const T not_rigid = simd::NumberTraits<T>::load(constants + shell_constant::active * shell_lanes);
  const auto alive = (get<T>(state, shell_state::off) > zero) & (not_rigid > zero);
  const Q4Geometry<T>& g = motion.g;
  const T inverse_area = g.inverse_area;
  T vx13 = motion.vx13, vy13 = motion.vy13, vx24 = motion.vx24, vy24 = motion.vy24, vxh = motion.vxh, vyh = motion.vyh;
  const T vz13 = motion.vz13, vz24 = motion.vz24, vzh = motion.vzh;
  T wx13 = motion.wx13, wy13 = motion.wy13, wx24 = motion.wx24, wy24 = motion.wy24;
  T wxs = motion.wxs, wys = motion.wys, wxh = motion.wxh, wyh = motion.wyh;

  // slopes of v_z, hourglass rates, second-order corrections
  Q4Gradient<T> p_now{g.px1, g.py1, g.px2, g.py2, inverse_area};  // frozen elements turn as they are
  if constexpr (local_rates) p_now = q4_gradient(motion.now);
  T gy = (p_now.py1 * vz13 + p_now.py2 * vz24) * p_now.inverse_area, gx = (p_now.px1 * vz13 + p_now.px2 * vz24) * p_now.inverse_area;
  T rate_x, rate_y, rate_z = vzh - g.area * (g.hx * gx + g.hy * gy);
  const auto set_hourglass_rates = [&]() __attribute__((always_inline)) {
    rate_x = vxh - (g.px1 * vx13 + g.px2 * vx24) * g.hx - (g.py1 * vx13 + g.py2 * vx24) * g.hy;
    rate_y = vyh - (g.px1 * vy13 + g.px2 * vy24) * g.hx - (g.py1 * vy13 + g.py2 * vy24) * g.hy;
  };
  const T z_force = (q.balanced_warp || q.ishell >= 3) && s.bending ? g.z2 : zero;  // height at which hourglass forces act when warped
  if (q.midpoint || q.ishell <= 2) set_hourglass_rates();
  if (!q.midpoint && q.ishell <= 2) {
    const T factor = T(q.rotation_correction * h);
    const T minus = vz13 - vz24, plus = vz13 + vz24;
    const T below_x = q4_detail::guarded(g.py1 + g.py2), below_y = q4_detail::guarded(g.px2 - g.px1);
    const T reciprocal = factor / (below_x * below_y);  // one division for both
    const T dx = reciprocal * below_y * (minus * minus);
    const T dy = reciprocal * below_x * (plus * plus);
    vx13 -= dx;
    vx24 += dx;
    vy13 += dy;
    vy24 += dy;
  } else if (!q.midpoint) {
    const T qx = T(0.5 * h) * (gx * gx), qy = T(0.5 * h) * (gy * gy);
    vx13 -= two * qx * g.py2;
    vx24 += two * qx * g.py1;
    vy13 += two * qy * g.px2;
    vy24 -= two * qy * g.px1;
    vxh -= two * gx * g.z2;
    vyh -= two * gy * g.z2;
    if (q.ishell == 3) {
      // Velocities relative to the rigid rotation: the linear part of the correction drops out of gamma . v.
      vxh -= qx * g.area * g.hx;
      vyh -= qy * g.area * g.hy;
      rate_z += two * (qx + qy) * g.z2;
    }
    set_hourglass_rates();
  }

  // velocity strains and curvature rates
  ShellRates<T> rate;
  rate.exx = (p_now.px1 * vx13 + p_now.px2 * vx24) * p_now.inverse_area;
  rate.eyy = (p_now.py1 * vy13 + p_now.py2 * vy24) * p_now.inverse_area;
  const T gxy = (p_now.py1 * vx13 + p_now.py2 * vx24) * p_now.inverse_area;
  const T gyx = (p_now.px1 * vy13 + p_now.px2 * vy24) * p_now.inverse_area;
  rate.gxy = gxy + gyx;
  if (q.midpoint) {
    // Half a step's turn is (c, -b, a): the frame of mid-step is e1 - a e2 - b e3, e2 + a e1 - c e3, e3 + b e1 + c e2.
    const T half = T(0.5 * h), dxx = rate.exx, dyy = rate.eyy;
    const T a = half * (T(0.5) * (gyx - gxy)), b = half * gx, c = half * gy;
    membrane_at_midpoint(rate, dxx, gxy, gyx, dyy, gx, gy, T(h), 0.0);
    const T raw_x = gx;
    gx = gx + two * (b * dxx + c * gyx) - a * gy;
    gy = gy + two * (b * gxy + c * dyy) + a * raw_x;
    const auto turn = [&](T & x, T & y, T z) __attribute__((always_inline)) {
      const T was = x;
      x = (x - a * y) - b * z;
      y = (y + a * was) - c * z;
    };
    turn(wx13, wy13, motion.wz13);
    turn(wx24, wy24, motion.wz24);
    turn(wxs, wys, motion.wzs);
    turn(wxh, wyh, motion.wzh);
    // Hourglass: the operator of x^n sees the pattern half a step late too. What turns the corners' heights is no hourglass motion.
    T p = two * (g.z2 * gx), r = two * (g.z2 * gy), u = zero;
    if (q.plain_pattern) {  // nor what turns the pattern itself, where gamma does not leave it out
      const T spin = T(0.5) * (gyx - gxy);
      p -= spin * pattern_y(g);
      r += spin * pattern_x(g);
      u = gx * pattern_x(g) + gy * pattern_y(g);
    }
    const T x = rate_x - p, y = rate_y - r, z = rate_z - u;
    rate_x = x - two * (a * y + b * z) - a * r;
    rate_y = y + two * (a * x - c * z) + a * p;
    rate_z = z + (b * (two * x + p) + c * (two * y + r));
    if (q.plain_pattern) {
      rate_x -= b * u;
      rate_y -= c * u;
    }
    if (!q.balanced_warp && q.ishell <= 2) {  // flat elements see it
      rate_x += p;
      rate_y += r;
    } else if (s.bending && q.balanced_warp) {  // their forces act on the rotations, beyond which the corners' heights tilt by shear
      rate_x += two * (g.z2 * (gx + T(0.25) * wys));
      rate_y += two * (g.z2 * (gy - T(0.25) * wxs));
    }
    T along = half * rate.exx, across = half * rate.eyy, sheared = T(0.5) * half * rate.gxy;
    if constexpr (local_rates) {
      q4_detail::rates_of_frozen(q, state, g, motion.now, h, rate, rate_x, rate_y, rate_z);
      const auto frozen = get<T>(state, q.at_frozen + 6) > zero;
      along = select(frozen, zero, along);
      across = select(frozen, zero, across);
      sheared = select(frozen, zero, sheared);
    }
    curvature_at_midpoint(rate, (g.px1 * wx13 + g.px2 * wx24) * inverse_area, (g.py1 * wx13 + g.py2 * wx24) * inverse_area,
                          (g.px1 * wy13 + g.px2 * wy24) * inverse_area, (g.py1 * wy13 + g.py2 * wy24) * inverse_area, along, sheared,
                          sheared, across);
  } else {
    rate.kxx = (g.px1 * wy13 + g.px2 * wy24) * inverse_area;
    rate.kyy = -((g.py1 * wx13 + g.py2 * wx24) * inverse_area);
    rate.kxy = (g.py1 * wy13 + g.py2 * wy24 - g.px1 * wx13 - g.px2 * wx24) * inverse_area;
  }
  rate.exx = select(alive, rate.exx, zero);
  rate.eyy = select(alive, rate.eyy, zero);
  rate.gxy = select(alive, rate.gxy, zero);
  rate.gyz = select(alive, gy - T(0.25) * wxs, zero);
  rate.gzx = select(alive, gx + T(0.25) * wys, zero);
  rate.kxx = select(alive, rate.kxx, zero);
  rate.kyy = select(alive, rate.kyy, zero);
  rate.kxy = select(alive, rate.kxy, zero);

  // section and hourglass
  const ShellForces<T> n = update_section<T, law>(s, state, rate, h, g.area);
  const T t = n.thickness;
  const T b_sum = g.px1 * g.px1 + g.py1 * g.py1 + g.px2 * g.px2 + g.py2 * g.py2;
  const T d1 = vz13 + vz24, d2 = vz13 - vz24;
  const Q4Hourglass<T> hg =
      q4_hourglass<T>(s, q, state, regular, t, g.area, b_sum, n.off, n.yield, select(alive, n.off * rate_x, zero),
                      select(alive, n.off * rate_y, zero), select(alive, n.off * rate_z, zero), select(alive, wxh, zero),
                      select(alive, wyh, zero), select(alive, d1, zero), select(alive, d2, zero), h);

  // step; early, because its roots and divisions take long and the forces do not wait for them
  const T mass = simd::NumberTraits<T>::load(constants + shell_constant::mass * shell_lanes);
  const T inertia = simd::NumberTraits<T>::load(constants + shell_constant::inertia * shell_lanes);
  const ShellStep<T> step = q.step_bound ? q4_step_bound(s, q, g, t, mass, inertia, hg.stiffness, h)
                                         : q4_step_reference(s, q, g, t, regular, damping, hg.stiffness);

  // nodal forces and moments in the frame: gradient part of nodes 1 and 2, the rest
  T f1x = t * (n.fxx * g.px1 + n.fxy * g.py1), f2x = t * (n.fxx * g.px2 + n.fxy * g.py2);
  T f1y = t * (n.fyy * g.py1 + n.fxy * g.px1), f2y = t * (n.fyy * g.py2 + n.fxy * g.px2);
  T f1z = t * (n.fzx * g.px1 + n.fyz * g.py1) + (hg.dn_1 + hg.dn_2);
  T f2z = t * (n.fzx * g.px2 + n.fyz * g.py2) + (hg.dn_1 - hg.dn_2);
  if (q.balanced_warp && !s.bending) {  // what the hourglass rates do not see of v_z
    const T slope = two * g.z2 * n.off * inverse_area;
    f1z -= slope * (hg.qx * g.px1 + hg.qy * g.py1);
    f2z -= slope * (hg.qx * g.px2 + hg.qy * g.py2);
  }
  if (q.plain_pattern) {  // the moments of the hourglass forces, which the rates do not see
    const T per_area = n.off * inverse_area, x = pattern_x(g) * per_area, y = pattern_y(g) * per_area;
    const T twist = T(0.5) * (x * hg.qy - y * hg.qx);
    f1x += twist * g.py1;
    f2x += twist * g.py2;
    f1y -= twist * g.px1;
    f2y -= twist * g.px2;
    f1z -= hg.qz * (x * g.px1 + y * g.py1);
    f2z -= hg.qz * (x * g.px2 + y * g.py2);
  }
  if constexpr (local_rates) {
    Q4GradientForces<T> f{f1x, f1y, f1z, f2x, f2y, f2z};
    q4_detail::balance_frozen(q, state, g, motion.now, p_now, n, hg, f);
    f1x = f.x1, f1y = f.y1, f1z = f.z1, f2x = f.x2, f2y = f.y2, f2z = f.z2;
  }
  const T t2 = t * t;
  const T m1x = -(t2 * (n.myy * g.py1 + n.mxy * g.px1)), m2x = -(t2 * (n.myy * g.py2 + n.mxy * g.px2));
  const T m1y = t2 * (n.mxx * g.px1 + n.mxy * g.py1), m2y = t2 * (n.mxx * g.px2 + n.mxy * g.py2);
  const T ta = t * g.area;
  const T lift = two * n.off * z_force;  // gamma_1 + gamma_3 = 2
  const T msx = T(-0.25) * (ta * n.fyz + lift * hg.qy), msy = T(0.25) * (ta * n.fzx + lift * hg.qx);

  // scatter: into global axes, then per node
  const auto stays = alive & (n.off > zero);
  simd::NumberTraits<T>::store(args.steps + block * args.step_stride + static_cast<std::size_t>(lane), select(stays, step.step, T(1e30)));
  const T stiffness = select(stays, q.step_bound ? step.per_mass * mass : step.stiffness, zero);
  const T rotational = select(stays, q.step_bound ? step.per_mass * mass * inertia : step.rotational, zero);
  for (int i = 0; i < 4; ++i) {
    q4_detail::store_slot(slots + i * 8 * shell_lanes, 3, stiffness);
    q4_detail::store_slot(slots + i * 8 * shell_lanes, 7, rotational);
  }
  const T qx = n.off * hg.qx, qy = n.off * hg.qy, qz = n.off * hg.qz;
  const T ax = msx + hg.mx, ay = msy + hg.my, bx = msx - hg.mx, by = msy - hg.my;
  const auto scatter = [&](int component, T e1, T e2, T e3) __attribute__((always_inline)) {  // one at a time: few values are under way
    const T f1 = f1x * e1 + f1y * e2 + f1z * e3, f2 = f2x * e1 + f2y * e2 + f2z * e3, fh = qx * e1 + qy * e2 + qz * e3;
    const T m1 = m1x * e1 + m1y * e2, m2 = m2x * e1 + m2y * e2, ma = ax * e1 + ay * e2, mb = bx * e1 + by * e2;
    const T f[4] = {f1 + g.gamma1 * fh, f2 + g.gamma2 * fh, g.gamma3 * fh - f1, g.gamma4 * fh - f2};
    const T m[4] = {m1 + ma, m2 + mb, ma - m1, mb - m2};
    for (int i = 0; i < 4; ++i) {
      double* slot = slots + i * 8 * shell_lanes;
      q4_detail::store_slot(slot, component, select(stays, f[i], zero));
      q4_detail::store_slot(slot, 4 + component, select(stays, m[i], zero));
    }
  };
  scatter(0, g.e1.x, g.e2.x, g.e3.x);
  scatter(1, g.e1.y, g.e2.y, g.e3.y);
  scatter(2, g.e1.z, g.e2.z, g.e3.z);
}

/// q4_blocks with Q4Parameters::local_rates known when built: frozen shapes beside the ones as they are take registers that the others
/// need (docs/performance.md, "What changes brought").
template <class T, ShellLaw law, bool local_rates>
ABUT_INLINE void q4_blocks_of(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  constexpr int width = simd::NumberTraits<T>::width;
  const auto stride = static_cast<std::size_t>(args.section->variables * shell_lanes);
  Q4Motion<T> motion[shell_lanes / width];
  for (std::size_t b = begin; b < end; ++b) {
    // Stage by stage over the block: the processor works on one half while the other waits for the roots of its frame.
    const std::int32_t* nodes = args.nodes + b * (4 * shell_lanes);
    double* state = args.state + b * stride;
    simd::prefetch(state + stride, stride);
    ask(args.ahead, b - begin, end - begin, {args.x, args.v, args.w});
    for (int p = 0; p < shell_lanes / width; ++p) q4_geometry<T, local_rates>(args, q, state + p * width, nodes + p * width, motion[p]);
    for (int p = 0; p < shell_lanes / width; ++p) q4_motion(args, nodes + p * width, motion[p]);
    for (int p = 0; p < shell_lanes / width; ++p) q4_lanes<T, law, local_rates>(args, q, damping, b, p * width, motion[p]);
    finish_block<T, 4>(args, b);
  }
}

/// Blocks [begin, end). `damping`: sqrt(1 + dm^2) - dm, the factor of the reference's step.
template <class T, ShellLaw law>
ABUT_INLINE void q4_blocks(const ShellKernelArgs& args, const Q4Parameters& q, double damping, std::size_t begin, std::size_t end) {
  if (q.local_rates) {
    q4_blocks_of<T, law, true>(args, q, damping, begin, end);
  } else {
    q4_blocks_of<T, law, false>(args, q, damping, begin, end);
  }
}

}  // namespace abut::elements
