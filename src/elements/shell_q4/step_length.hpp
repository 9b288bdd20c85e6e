// Element step and nodal stiffness of the one-point quadrilateral.
//
// Reference (numerics.md 2.1.1, 2.2): length over sound speed, literally; not a strict bound.
//
// Bound: h is stable for M a + C v(n-1/2) + K u = f when M - (h/2) C - (h^2/4) K is positive semi-definite, and that holds
// for a mesh when it holds for every element (its lumped masses and inertias against its own K and C). With largest
// eigenvalues k >= lambda(K, M) and c >= lambda(C, M) of one element:   h^2 k/4 + h c/2 <= 1, that is
//   h = 2 / (c/2 + sqrt(c^2/4 + k)).
// The element's K is a sum of parts with few non-zero eigenvalues each. mu = m/4, J = mu r^2: mass and inertia of a node;
// P = (P_x, P_y) the gradient vectors, p = P P^T (2 by 2), S = tr p = 2 (b1 + b2), det p = A^2 (exactly, for any quad).
//   membrane    K = (t/A) B^T C B, B M^-1 B^T = [pxx 0 pxy; 0 pyy pxy; pxy pxy S]/mu. In the principal axes of p it is diagonal,
//               and C is isotropic, so that exactly  k_m = t/(2 A mu) (A11 S + sqrt(A11^2 S^2 - 4 A^2 A11 E))
//               (the shear branch G S t/(A mu) is never larger for nu >= 0).
//   bending     the same operator on the rotations: k_b = k_m (t^2/12) / r^2.
//   shear       two rows, P.v_z/A and the mean rotation: k_s = kappa_s G t A (p_max/(A^2 mu) + 1/(4 J)),
//               p_max = (S + sqrt(S^2 - 4 A^2))/2. The mean rotation is orthogonal to the patterns P of bending, hence
//               bending and shear do not add up: max(k_b, k_s).
//   hourglass   rank one each: membrane k_h = E h_m t/8 |gamma|^2/mu (both directions alike, orthogonal), normal
//               k_z |gamma|^2/mu. gamma is not orthogonal to P on a distorted quad: they add to k_m and to k_s.
//   gamma = Gamma without what rotations make of its X = Gamma . x (Profile::WarpedShell): all rows at most |Gamma|^2 + X^2 S/A^2.
//   warped quads (reference: Ishell 3, 4 only): rates see the rotations on which the forces act, through z2/2: k (|gamma|^2/mu + z2^2/J),
//               added to the largest. Membranes (N = 1) have none: k (|gamma|^2/mu + 4 z2^2 p_max/(A^2 mu)). Where rates see v_z and forces
//               act on rotations (Profile::WarpedShell) K is not symmetric; its norm is at most the root of the product of both.
// Viscous parts: membrane damping has the form of the membrane with d [1 1/2; 1/2 1] and d/3 in shear in place of C. That is not isotropic
// (d/4 would be); it is majorised by the isotropic d [13 5; 5 13]/12, d/3, exact for squares; the quadratic hourglass
// terms enter with their tangent 2 c |rate|; linear ones (Ishell 3 rotations, N = 1 with dn) as they are. N = 1 has no bending and no
// shear. Left out: stress (geometric) stiffness, of relative size stress/E.
//
// Nodal stiffness: K_I = k_e m_I/2 with k_e = k + 2 c/h_ref, so that h <= sqrt(2 m/K) at every node implies the condition above
// for the sum (h^2 k_e m_I/4 summed over elements <= m_I, while h >= h_ref). h_ref is half of the last step: the step may halve from one
// cycle to the next without leaving the bound.
#pragma once

#include "elements/shell_common/section.hpp"
#include "elements/shell_common/stable_step.hpp"
#include "elements/shell_q4/geometry.hpp"

namespace abut::elements {

/// Stiffness of the hourglass modes (force per unit of gamma.u) and the largest viscous tangents (force per rate).
template <class T>
struct Q4HourglassStiffness {
  T membrane, normal;
  T viscous_membrane, viscous_normal, viscous_rotation, viscous_dn;
};

/// `mass`: m/4; `inertia`: r^2.
template <class T>
ABUT_INLINE ShellStep<T> q4_step_bound(const ShellSection& s, const Q4Parameters& q, const Q4Geometry<T>& g, T t, T mass, T inertia,
                                       const Q4HourglassStiffness<T>& hg, double h) {
  const T two = T(2.0), four = T(4.0), zero = T(0.0), half = T(0.5);
  // One division for 1/mass and 1/(mass inertia).
  const T inverse_inertia = T(1.0) / (mass * inertia), inverse_mass = inverse_inertia * inertia;
  const T a = g.area, a2 = a * a, inverse_area = g.inverse_area;
  const T trace = two * (g.px1 * g.px1 + g.py1 * g.py1 + g.px2 * g.px2 + g.py2 * g.py2);
  const T a11 = T(s.elastic.a11);
  const T t_per_am = t * inverse_mass * inverse_area;
  const T root = sqrt(max(a11 * a11 * trace * trace - four * a2 * T(s.elastic.a11 * s.elastic.young), zero));
  const T membrane = half * t_per_am * (a11 * trace + root);
  const T p_max = half * (trace + sqrt(max(trace * trace - four * a2, zero)));
  T gamma2 = (g.gamma1 * g.gamma1 + g.gamma2 * g.gamma2 + g.gamma3 * g.gamma3 + g.gamma4 * g.gamma4) * inverse_mass;
  if (q.plain_pattern) {
    const T x = pattern_x(g) * inverse_area, y = pattern_y(g) * inverse_area;
    gamma2 += (x * x + y * y) * trace * inverse_mass;
  }
  T out_of_plane = hg.normal * gamma2;
  if (s.bending) {
    const T kg = T(s.shear_factor * s.elastic.shear);
    const T shear = kg * (t_per_am * p_max + T(0.25) * t * a * inverse_inertia);
    out_of_plane = max(out_of_plane + shear, membrane * T(1.0 / 12.0) * t * t * (inverse_inertia * mass));
  }
  T k;
  if (q.balanced_warp || q.ishell >= 3) {
    const T z2 = g.z2 * g.z2;
    const T seen = gamma2 + four * z2 * p_max * inverse_mass * (inverse_area * inverse_area);
    const T on_rotations = gamma2 + z2 * inverse_inertia;
    const T coupling = (q.balanced_warp ? (s.bending ? on_rotations : seen) : sqrt(on_rotations * seen)) * hg.membrane;
    k = max(membrane, out_of_plane) + coupling;
  } else {
    k = max(membrane + hg.membrane * gamma2, out_of_plane);
  }
  T c = max(hg.viscous_membrane, hg.viscous_normal) * gamma2;
  c = max(c, four * hg.viscous_rotation * inverse_inertia);
  c = c + four * hg.viscous_dn * inverse_mass;
  if (s.membrane_damping > 0.0) {
    const T d = T(s.membrane_damping) * sqrt(a);
    c = c + t_per_am * d * damping_eigenvalue(trace, a2);
  }
  return bounded_step(s.step_wanted, k, c, h, s.viscous_rate);
}

/// `damping`: sqrt(1 + dm^2) - dm.
template <class T>
ABUT_INLINE ShellStep<T> q4_step_reference(const ShellSection& s, const Q4Parameters& q, const Q4Geometry<T>& g, T t, T regular,
                                           double damping, const Q4HourglassStiffness<T>& hg) {
  const T l12 = g.x2 * g.x2 + g.y2 * g.y2;
  const T x32 = g.x3 - g.x2, y32 = g.y3 - g.y2, x43 = g.x4 - g.x3, y43 = g.y4 - g.y3, x42 = g.x4 - g.x2, y42 = g.y4 - g.y2;
  const T l23 = x32 * x32 + y32 * y32, l34 = x43 * x43 + y43 * y43, l41 = g.x4 * g.x4 + g.y4 * g.y4;
  const T l13 = g.x3 * g.x3 + g.y3 * g.y3, l24 = x42 * x42 + y42 * y42;
  const T triangle = min(min(l12, l23), l41);
  const T all = min(min(triangle, l34), min(l13, l24));
  const T smallest = select(regular > T(0.5), all, triangle);
  T length2 = max(g.area * g.area / max(l13, l24), smallest);
  const double h_max = q.hm > q.hf ? q.hm : q.hf;
  if (h_max > 0.0) length2 = min(length2, (smallest + length2) * T(0.5 / h_max));
  ShellStep<T> out;
  out.step = sqrt(length2) * T(damping / s.sound);
  out.per_mass = T(0.0);
  if (q.nodal_step) {
    const T b1 = g.px1 * g.px1 + g.py1 * g.py1, b2 = g.px2 * g.px2 + g.py2 * g.py2;
    const T g1 = g.gamma1 * g.gamma1, g2 = g.gamma2 * g.gamma2, g3 = g.gamma3 * g.gamma3, g4 = g.gamma4 * g.gamma4;
    out.stiffness =
        max(b1, b2) * t * T(s.elastic.a11 / (damping * damping)) / g.area + max(max(g1, g2), max(g3, g4)) * max(hg.membrane, hg.normal);
    out.rotational = out.stiffness * (t * t * T(1.0 / 12.0) + g.area * T(1.0 / 9.0));
  } else {
    out.stiffness = g.area * t * T(0.81 * 0.5 * s.elastic.young / (damping * damping)) / length2;
    out.rotational = T(0.0);
  }
  return out;
}

}  // namespace abut::elements
