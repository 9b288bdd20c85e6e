// Small strain of the one-point quadrilateral: gradients of the shape in which an element was frozen.
//
// Equation contract: strains and hourglass displacements are linear in the local coordinates, seen from the frame of the element as it is:
//   rates = (local coordinates of x^n - those of x^(n-1))/h with the frozen P and gamma; a rotation does not show in them, whatever the
//   strain rotations and slopes of v_z (shear, the frame of mid-step) by the gradients of the shape as it is; curvatures by the frozen ones
//   forces likewise: shear by the gradients as they are; what the others have of a moment on the shape as it is goes back by its spin
// The reference has rates from velocities with the frozen gradients.
#pragma once

#include "elements/shell_common/section.hpp"
#include "elements/shell_q4/geometry.hpp"
#include "elements/shell_q4/hourglass.hpp"
#include "elements/shell_q4/parameters.hpp"

namespace abut::elements {

/// Forces of nodes 1 and 2 in the frame; those of 3 and 4 are their opposites.
template <class T>
struct Q4GradientForces {
  T x1, y1, z1, x2, y2, z2;
};

namespace q4_detail {

/// Small strain: takes the coordinates of the lanes that freeze now, returns those of the frozen ones.
template <class T>
ABUT_INLINE void freeze(double* frozen, Q4Geometry<T>& g) {
  using section_detail::get;
  using section_detail::put;
  const T flag = get<T>(frozen, 6);
  const auto old = flag >= T(1.0);
  const auto held = flag > T(0.0);
  T* const current[6] = {&g.x2, &g.y2, &g.x3, &g.y3, &g.x4, &g.y4};
  for (int i = 0; i < 6; ++i) {
    *current[i] = select(old, get<T>(frozen, i), *current[i]);
    put(frozen, i, *current[i]);
  }
  put(frozen, 6, select(held, T(1.0), T(0.0)));
  g.z2 = select(held, T(0.0), g.z2);
}

/// Small strain: rates of the local coordinates of frozen lanes, which know no rotation; the step is from `now` of the last to this one.
template <class T>
ABUT_INLINE void rates_of_frozen(const Q4Parameters& q, double* state, const Q4Geometry<T>& g, const Q4Shape<T>& now, double h,
                                 ShellRates<T>& rate, T& rate_x, T& rate_y, T& rate_z) {
  using section_detail::get;
  using section_detail::put;
  const T per_h = T(h > 0.0 ? 1.0 / h : 0.0), zero = T(0.0);
  const auto frozen = get<T>(state, q.at_frozen + 6) > zero;
  int at = q.at_frozen + 7;
  const auto moved = [&](T value) __attribute__((always_inline)) {
    const T change = value - get<T>(state, at);
    put(state, at++, value);
    return change * per_h;
  };
  const T x13 = moved(now.x13), y13 = moved(now.y13), x24 = moved(now.x24), y24 = moved(now.y24);
  const T xh = moved(now.xh), yh = moved(now.yh), zh = moved(now.zh);
  const T xx = g.px1 * x13 + g.px2 * x24, xy = g.py1 * x13 + g.py2 * x24, yx = g.px1 * y13 + g.px2 * y24, yy = g.py1 * y13 + g.py2 * y24;
  rate.exx = select(frozen, xx * g.inverse_area, rate.exx);
  rate.eyy = select(frozen, yy * g.inverse_area, rate.eyy);
  rate.gxy = select(frozen, (xy + yx) * g.inverse_area, rate.gxy);
  rate_x = select(frozen, xh - xx * g.hx - xy * g.hy, rate_x);
  rate_y = select(frozen, yh - yx * g.hx - yy * g.hy, rate_y);
  rate_z = select(frozen, zh, rate_z);
}

/// Forces of frozen lanes: no moment of their own on the shape as it is.
template <class T>
ABUT_INLINE void balance_frozen(const Q4Parameters& q, double* state, const Q4Geometry<T>& g, const Q4Shape<T>& now, const Q4Gradient<T>& p,
                                const ShellForces<T>& n, const Q4Hourglass<T>& hg, Q4GradientForces<T>& f) {
  const auto frozen = section_detail::get<T>(state, q.at_frozen + 6) > T(0.0);
  const T t = n.thickness, per_area = p.inverse_area;
  const T qx = n.off * hg.qx, qy = n.off * hg.qy, qz = n.off * hg.qz;
  T x1 = t * (n.fxx * g.px1 + n.fxy * g.py1), x2 = t * (n.fxx * g.px2 + n.fxy * g.py2);
  T y1 = t * (n.fyy * g.py1 + n.fxy * g.px1), y2 = t * (n.fyy * g.py2 + n.fxy * g.px2);
  // gamma . x and gamma . y of the shape as it is
  const T x = now.xh - (g.px1 * now.x13 + g.px2 * now.x24) * g.hx - (g.py1 * now.x13 + g.py2 * now.x24) * g.hy;
  const T y = now.yh - (g.px1 * now.y13 + g.px2 * now.y24) * g.hx - (g.py1 * now.y13 + g.py2 * now.y24) * g.hy;
  const T moment = (now.x13 * y1 - now.y13 * x1) + (now.x24 * y2 - now.y24 * x2) + (x * qy - y * qx);
  const T twist = T(0.5) * moment * per_area;
  x1 += twist * p.py1;
  x2 += twist * p.py2;
  y1 -= twist * p.px1;
  y2 -= twist * p.px2;
  const T zx = per_area * (t * g.area * n.fzx + (now.zh * qx - x * qz)), yz = per_area * (t * g.area * n.fyz + (now.zh * qy - y * qz));
  f.x1 = select(frozen, x1, f.x1);
  f.y1 = select(frozen, y1, f.y1);
  f.z1 = select(frozen, zx * p.px1 + yz * p.py1 + (hg.dn_1 + hg.dn_2), f.z1);
  f.x2 = select(frozen, x2, f.x2);
  f.y2 = select(frozen, y2, f.y2);
  f.z2 = select(frozen, zx * p.px2 + yz * p.py2 + (hg.dn_1 - hg.dn_2), f.z2);
}

}  // namespace q4_detail

}  // namespace abut::elements
