// Contact that starts or ends inside a step: scale its first and last force so that switching makes no energy.
//
// Leap-frog counts trapezoidal work. A node found at penetration P after moving dP > P towards the surface in the step has been in
// contact for P/dP of it only. For constant velocity over that step the trapezoidal work equals the potential if the force is
//   f = F/2 + Phi(P)/dP       ( = F (1 + P/dP)/2 for the linear law)
// and the next step starts from the true F. The same holds mirrored for the last force before separation. Both are continuous: at
// P = dP nothing changes. The last cycle is predicted from the present normal velocity, the contact's own deceleration F/m (m the
// pair's effective mass) and the acceleration by all other forces as seen over the last step.
#pragma once

namespace abut::contact {

struct Switching {
  double force = 0.0;      ///< F, per law
  double potential = 0.0;  ///< Phi(P)
  double penetration = 0.0;
  double step = 0.0;       ///< the last step, taken for the coming one too; 0: nothing known, F stands
};

/// @param closed  dP that led in during the last step, when the contact began in it; else 0
/// @param opening normal speed of separation expected over the coming step
[[nodiscard]] inline double switched_force(const Switching& s, double closed, double opening) {
  double force = s.force;
  if (s.step <= 0.0) return force;
  if (closed > s.penetration) force += s.potential / closed - 0.5 * s.force;
  const double opened = opening * s.step;
  if (opened > s.penetration) force += s.potential / opened - 0.5 * s.force;
  return force;
}

}  // namespace abut::contact
