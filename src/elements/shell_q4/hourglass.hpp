// Hourglass control of the one-point quadrilateral, forms 1 to 4 and the membrane element.
//
// Equation contract (numerics.md 3.9; Belytschko, Tsay, IJNME 19 (1983) 405):
//   Ishell 1, 2, 4: elastic Q += k h rate plus quadratic viscosity; rotations: quadratic viscosity
//   Ishell 3: elastic Q within +- a plastic cap; rotations: linear and quadratic viscosity
//   N = 1: elastic only, the normal mode as stiff as the membrane; with dn two viscous normal modes
// All coefficients vanish on a quad whose nodes 3 and 4 coincide. Rates, gamma and moments carry the activity `off`.
// Rotational viscosity: the reference's quadratic constants have the dimension of a moment over a length; `homogeneous` multiplies them by
// sqrt(A).
#pragma once

#include "elements/shell_common/section.hpp"
#include "elements/shell_q4/step_length.hpp"

namespace abut::elements {

template <class T>
struct Q4Hourglass {
  T qx, qy, qz;  ///< generalised forces, to be multiplied by off gamma_I
  T mx, my;      ///< moments of node 1; pattern + - + -
  T dn_1, dn_2;  ///< N = 1 with dn: normal forces of patterns (+ + - -) and (+ - - +)
  Q4HourglassStiffness<T> stiffness;
};

/// `rx ry rz tx ty`: rates with the activity; `d1 d2`: rates of the two dn modes.
template <class T>
ABUT_INLINE Q4Hourglass<T> q4_hourglass(const ShellSection& s, const Q4Parameters& p, double* state, T regular, T t, T area, T b_sum, T off,
                                        T yield, T rx, T ry, T rz, T tx, T ty, T d1, T d2, double h) {
  using section_detail::get;
  using section_detail::put;
  const T zero = T(0.0);
  const double e = s.elastic.young, rho = s.density;
  const T thick = t * regular, root_area = sqrt(area);
  Q4Hourglass<T> o;
  o.mx = o.my = o.dn_1 = o.dn_2 = zero;
  Q4HourglassStiffness<T>& k = o.stiffness;
  k.viscous_membrane = k.viscous_normal = k.viscous_rotation = k.viscous_dn = zero;
  k.membrane = T(0.125 * e * p.hm) * thick;
  const double bending = s.shear_factor / (3.0 * (1.0 + s.elastic.poisson));
  k.normal = s.bending ? T(0.125 * e * p.hf * bending) * (thick * t * t) / b_sum : T(0.125 * e * p.hf) * thick;
  const T step = T(h);
  T ex = get<T>(state, p.at_hourglass) + k.membrane * step * rx;
  T ey = get<T>(state, p.at_hourglass + 1) + k.membrane * step * ry;
  T ez = get<T>(state, p.at_hourglass + 2) + k.normal * step * rz;
  if (!s.bending) {
    o.qx = ex;
    o.qy = ey;
    o.qz = ez;
    if (p.dn > 0.0) {
      const double root = __builtin_sqrt(0.5 * p.dn);
      const T linear = T(0.25 * rho * root * s.sound) * thick * root_area * off;
      const T quadratic = T(0.25 * rho * root * 100.0 * root) * thick * root_area * off;
      o.dn_1 = d1 * (linear + quadratic * abs(d1));
      o.dn_2 = d2 * (linear + quadratic * abs(d2));
      k.viscous_dn = linear + T(2.0) * quadratic * max(abs(d1), abs(d2));
    }
  } else if (p.ishell == 3) {
    const T cap = T(0.5 * p.hm) * yield * thick * root_area, cap_z = T(0.25 * p.hf) * yield * thick * t;
    ex = max(-cap, min(cap, ex));
    ey = max(-cap, min(cap, ey));
    ez = max(-cap_z, min(cap_z, ez));
    o.qx = ex;
    o.qy = ey;
    o.qz = ez;
    const double root = __builtin_sqrt(p.hr);
    const T base = T(0.072169 * root * 0.25 * rho) * thick * t * area;
    const T linear = T(s.sound) * base;
    T quadratic = T(100.0 * root) * base;
    if (p.homogeneous) quadratic *= root_area;
    o.mx = tx * (linear + quadratic * abs(tx));
    o.my = ty * (linear + quadratic * abs(ty));
    k.viscous_rotation = linear + T(2.0) * quadratic * max(abs(tx), abs(ty));
  } else {
    const T c = T(12.5 * rho * p.hm) * thick * root_area;
    const T cz = T(12.5 * rho * p.hf * __builtin_sqrt(bending)) * thick * t;
    T cr = T(12.5 * 0.072169 * rho * p.hr) * thick * t * area;
    if (p.homogeneous) cr *= root_area;
    o.qx = ex + rx * (c * abs(rx));
    o.qy = ey + ry * (c * abs(ry));
    o.qz = ez + rz * (cz * abs(rz));
    o.mx = tx * (cr * abs(tx));
    o.my = ty * (cr * abs(ty));
    k.viscous_membrane = T(2.0) * c * max(abs(rx), abs(ry));
    k.viscous_normal = T(2.0) * cz * abs(rz);
    k.viscous_rotation = T(2.0) * cr * max(abs(tx), abs(ty));
  }
  put(state, p.at_hourglass, ex);
  put(state, p.at_hourglass + 1, ey);
  put(state, p.at_hourglass + 2, ez);

  T work = o.qx * rx + o.qy * ry + o.qz * rz + o.mx * tx + o.my * ty;
  if (p.at_hourglass_old >= 0) {
    const int at = p.at_hourglass_old;
    work = T(0.5) * (work + (get<T>(state, at) * rx + get<T>(state, at + 1) * ry + get<T>(state, at + 2) * rz + get<T>(state, at + 3) * tx +
                             get<T>(state, at + 4) * ty));
    put(state, at, o.qx);
    put(state, at + 1, o.qy);
    put(state, at + 2, o.qz);
    put(state, at + 3, o.mx);
    put(state, at + 4, o.my);
  }
  T normal_work = o.dn_1 * d1 + o.dn_2 * d2;
  if (p.at_normal_old >= 0) {
    const int at = p.at_normal_old;
    normal_work = T(0.5) * (normal_work + (get<T>(state, at) * d1 + get<T>(state, at + 1) * d2));
    put(state, at, o.dn_1);
    put(state, at + 1, o.dn_2);
  }
  work = (work + normal_work) * off;
  put(state, shell_state::hourglass_energy, get<T>(state, shell_state::hourglass_energy) + select(off > zero, work * step, zero));
  o.mx *= off;
  o.my *= off;
  return o;
}

}  // namespace abut::elements
