// Coulomb friction of one pair as return mapping on an elastic slip vector.
//
// Radioss Theory Manual, TYPE3, friction (T19..T23): dFt = (K/10) C0C1, |Ft| <= mu |Fn|. In the language of plasticity [Giannakopoulos
// 1989; Wriggers 2006]: elastic slip e (a length, tangential), Ft = k_t e, trial e + dg, cut back to the limit L:
//   e' = min(1, L/(k_t |e + dg|)) (e + dg),   plastic slip dp = (e + dg) - e',
//   work dissipated D = (k_t_old e + k_t e').dp / 2 >= 0.
// D is what the trapezoidal work of the friction force leaves after the change of k_t |e|^2/2: the energy balance of sliding
// closes to rounding. Where the force reverses within one step D could be negative: then it counts as zero.
#pragma once

#include <cmath>

#include "abut/vec3.hpp"

namespace abut::contact {

struct SlipResult {
  Vec3 elastic;             ///< e'
  double dissipated = 0.0;  ///< D >= 0
  bool slips = false;
};

/// @param elastic      e, already in the present tangent plane
/// @param force_before k_t_old e as it acted in the last cycle, turned with the surface
/// @param increment    dg, tangential
/// @param stiffness    k_t > 0
/// @param limit        >= 0
[[nodiscard]] inline SlipResult slip(const Vec3& elastic, const Vec3& force_before, const Vec3& increment, double stiffness, double limit) {
  const Vec3 trial = elastic + increment;
  const double size = stiffness * norm(trial);
  if (size <= limit) return {trial, 0.0, false};
  const Vec3 next = (limit / size) * trial;
  const double work = 0.5 * dot(force_before + stiffness * next, trial - next);
  return {next, work > 0.0 ? work : 0.0, true};
}

/// v turned with the smallest rotation that takes unit vector a to unit vector b (objective, keeps lengths).
[[nodiscard]] inline Vec3 turned(const Vec3& v, const Vec3& a, const Vec3& b) {
  const double c = dot(a, b);
  const Vec3 w = cross(a, b);
  if (c <= -0.999999) return v;  // no smallest rotation: the projection that follows takes over
  return c * v + cross(w, v) + (dot(w, v) / (1.0 + c)) * w;
}

}  // namespace abut::contact
