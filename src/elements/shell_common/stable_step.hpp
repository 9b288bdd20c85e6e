// From bounds of an element's eigenvalues to its step and its nodal stiffness; derivation in shell_q4/step_length.hpp.
#pragma once

#include "simd/pack.hpp"

namespace abut::elements {

// Found for double too, where argument-dependent lookup finds nothing.
using simd::abs;
using simd::max;
using simd::min;
using simd::select;
using simd::sqrt;

/// Step of each lane, and the nodal stiffness that goes to the slots.
template <class T>
struct ShellStep {
  T step;
  T per_mass;               ///< bound: K_I = per_mass * m_I
  T stiffness, rotational;  ///< reference: the same for every node
};

/// The step h with h^2 k/4 + h c/2 = 1.
template <class T>
ABUT_INLINE T stable_step(T k, T c) {
  const T half_c = T(0.5) * c;
  return T(2.0) / (half_c + sqrt(half_c * half_c + k));
}

/// Largest eigenvalue of B^T D B for the isotropic D = [13 5 0; 5 13 0; 0 0 4]/12 that majorises the membrane damping's
/// [1 1/2 0; 1/2 1 0; 0 0 1/3]; trace and determinant of the tensor P P^T.
template <class T>
ABUT_INLINE T damping_eigenvalue(T trace, T det) {
  return T(1.0 / 24.0) * (T(13.0) * trace + sqrt(max(T(169.0) * trace * trace - T(576.0) * det, T(0.0))));
}

/// 2 c r / h_ref, h_ref half of the last step `h`, r = `rate` (group.hpp, viscous_rate); in the first cycle of the element's own step.
template <class T>
ABUT_INLINE T viscous_stiffness(T c, T step, double h, double rate) {
  return h > 0.0 ? T(4.0 * rate / h) * c : T(4.0) * c / step;
}

/// Step and stiffness of an element with eigenvalues k and c; the step itself only where it is read.
template <class T>
ABUT_INLINE ShellStep<T> bounded_step(bool wanted, T k, T c, double h, double rate) {
  ShellStep<T> out;
  out.step = wanted || !(h > 0.0) ? stable_step(k, c) : T(1e30);
  out.per_mass = T(0.5) * (k + viscous_stiffness(c, out.step, h, rate));
  out.stiffness = T(0.0);
  out.rotational = T(0.0);
  return out;
}

}  // namespace abut::elements
