// Frame, coordinates and one-point operators of the quadrilateral shell.
//
// Equation contract (numerics.md 3.2; Belytschko, Lin, Tsay, CMAME 42 (1984) 225; Flanagan, Belytschko, IJNME 17 (1981) 679):
//   r = x21 + x34, s = x32 + x41, e3 = r x s / |r x s|
//   element bisector frame: e1 ~ r + |r|/|s| (s x e3);   /SHFRA/V4: e1 ~ |s|^2 r + s x (r x s);   e2 = e3 x e1
//   P_x1 = (y2 - y4)/2, P_y1 = (x4 - x2)/2, P_x2 = y3/2, P_y2 = -x3/2, P_3 = -P_1, P_4 = -P_2
//   A = 2 (P_y2 P_x1 - P_y1 P_x2);   A H = Gamma . (x, y);   gamma_I = Gamma_I - P_xI H_x - P_yI H_y
#pragma once

#include "elements/shell_common/kernel_args.hpp"
#include "elements/shell_q4/parameters.hpp"

namespace abut::elements {

template <class T>
struct Q4Geometry {
  Vec<T> e1, e2, e3;
  T x2, y2, x3, y3, x4, y4, z2;  ///< local coordinates relative to node 1
  T px1, py1, px2, py2, area, inverse_area;
  T hx, hy;  ///< 0 where gamma = Gamma
  T gamma1, gamma2, gamma3, gamma4;
};

/// Corners in the frame as they are, frozen or not: node 1 minus node 3, 2 minus 4, and 1 - 2 + 3 - 4.
template <class T>
struct Q4Shape {
  T x13, y13, x24, y24, xh, yh, zh;
};

/// Gradient vectors and area of that shape.
template <class T>
struct Q4Gradient {
  T px1, py1, px2, py2, inverse_area;
};

template <class T>
ABUT_INLINE Q4Gradient<T> q4_gradient(const Q4Shape<T>& now) {
  const T half = T(0.5);
  Q4Gradient<T> p{half * now.y24, -(half * now.x24), -(half * now.y13), half * now.x13, T(0.0)};
  p.inverse_area = T(1.0) / (T(2.0) * (p.py2 * p.px1 - p.py1 * p.px2));
  return p;
}

/// Gamma . x
template <class T>
ABUT_INLINE T pattern_x(const Q4Geometry<T>& g) {
  return g.x3 - g.x2 - g.x4;
}

/// Gamma . y
template <class T>
ABUT_INLINE T pattern_y(const Q4Geometry<T>& g) {
  return g.y3 - g.y2 - g.y4;
}

template <class T>
ABUT_INLINE void q4_frame(bool frame_v4, const Vec<T>& x1, const Vec<T>& x2, const Vec<T>& x3, const Vec<T>& x4, Q4Geometry<T>& g) {
  const T one = T(1.0);
  const Vec<T> d31 = x3 - x1, d42 = x4 - x2;
  const Vec<T> r = d31 - d42, s = d31 + d42;
  const Vec<T> n = cross(r, s);
  g.e3 = (one / sqrt(dot(n, n))) * n;
  Vec<T> e1;
  if (frame_v4) {
    e1 = dot(s, s) * r + cross(s, n);
  } else {
    e1 = r + sqrt(dot(r, r) / dot(s, s)) * cross(s, g.e3);
  }
  g.e1 = (one / sqrt(dot(e1, e1))) * e1;
  g.e2 = cross(g.e3, g.e1);
  const Vec<T> d21 = x2 - x1, d41 = x4 - x1;
  g.x2 = dot(d21, g.e1);
  g.y2 = dot(d21, g.e2);
  g.z2 = dot(d21, g.e3);
  g.x3 = dot(d31, g.e1);
  g.y3 = dot(d31, g.e2);
  g.x4 = dot(d41, g.e1);
  g.y4 = dot(d41, g.e2);
}

/// Operators from the local coordinates that are in `g`.
template <class T>
ABUT_INLINE void q4_operators(bool plain_gamma, Q4Geometry<T>& g) {
  const T half = T(0.5), one = T(1.0), zero = T(0.0);
  g.px1 = half * (g.y2 - g.y4);
  g.py1 = half * (g.x4 - g.x2);
  g.px2 = half * g.y3;
  g.py2 = -(half * g.x3);
  g.area = T(2.0) * (g.py2 * g.px1 - g.py1 * g.px2);
  g.inverse_area = one / g.area;
  g.hx = zero;
  g.hy = zero;
  g.gamma1 = one;
  g.gamma2 = -one;
  g.gamma3 = one;
  g.gamma4 = -one;
  if (!plain_gamma) {
    g.hx = (g.x3 - g.x2 - g.x4) * g.inverse_area;
    g.hy = (g.y3 - g.y2 - g.y4) * g.inverse_area;
    const T p1 = g.px1 * g.hx + g.py1 * g.hy, p2 = g.px2 * g.hx + g.py2 * g.hy;
    g.gamma1 -= p1;
    g.gamma2 -= p2;
    g.gamma3 += p1;
    g.gamma4 += p2;
  }
}

}  // namespace abut::elements
