// What a pair has taken from its bodies and given back: its last force settles the account.
//
// In leap-frog the force f at t^n changes the kinetic energy by exactly f (h + h')/2 (v + v')/2, h and h' the steps before and after, v and
// v' the opening speeds in them. Sums of that over a contact miss the potential wherever force or step change abruptly within a step:
// at its start, at folds between facets, where the step falls or rises. The account M is the energy made so far in that sense,
//   M_n = M' + f_n n_n.dr/2 + Psi_n - work of a growing gap over the last step,
//   M'  = M_n-1 - Psi_n-1 + f_n-1 n_n-1.dr/2 + f_n-1 (h_n-1 - h)(v - v_n-1)/4   (the last term: what leap-frog adds when the step changes),
// dr the motion over the last step relative to the point where the force acted, Psi the energy that it holds; and the last force gives
// the bodies what is left: with R = -M' and w = v + (h + h') a/4,
//   J = f (h + h')/2 = m (sqrt(w^2 + 2 R/m) - w),
// which is exact for a pair alone, whatever its law. m effective mass, a opening acceleration by all other forces.
// A pair that holds more by the law than it was given on the way there gives no more than that in any cycle (`NodeState::passive`): the
// same J with R >= 0 bounds its force [Hannaford, Ryu 2002, IEEE Trans. Robotics Automat. 18(1), 1-10: time-domain passivity control].
#pragma once

#include <algorithm>
#include <cmath>

namespace abut::contact {

/// The first step of a run has none before it: the mean of the two is half of it.
[[nodiscard]] inline bool is_first_step(double step, double mean) { return 2.0 * mean <= 1.0001 * step; }
/// The step before the last one, from the last one and the mean of the two.
[[nodiscard]] inline double step_before(double step, double mean) { return is_first_step(step, mean) ? step : 2.0 * mean - step; }

struct LastForce {
  double rate = 0.0;          ///< v, > 0: opens
  double step = 0.0;          ///< h
  double coming = 0.0;        ///< h'
  double inverse_mass = 0.0;  ///< 1/m; 0: speeds do not change
  double others = 0.0;        ///< a
  double left = 0.0;          ///< R
};

/// Force that gives all that is left. @pre rate > 0 where inverse_mass is 0
[[nodiscard]] inline double last_force(const LastForce& s) {
  const double bar = 0.5 * (s.step + s.coming);
  const double w = s.rate + 0.5 * bar * s.others;
  if (s.inverse_mass <= 0.0) return w > 0.0 ? s.left / (bar * w) : 0.0;
  const double square = w * w + 2.0 * s.left * s.inverse_mass;
  if (square <= 0.0) return 0.0;
  // sqrt(square) - w without its cancellation
  const double gained = w > 0.0 ? 2.0 * s.left * s.inverse_mass / (std::sqrt(square) + w) : std::sqrt(square) - w;
  return gained / (s.inverse_mass * bar);
}

/// What leap-frog adds to the kinetic energy, beyond trapezoidal work, when the step changes from `before` to `now` under force f.
[[nodiscard]] inline double made_by_changing_step(double f, double before, double now, double rate_before, double rate_now) {
  return 0.25 * f * (before - now) * (rate_now - rate_before);
}

/// The coming step as a contact foresees it: steps that grow go on growing. A step that falls is not taken to fall on, for the contact asks
/// for what it foresees and would make it so.
[[nodiscard]] inline double foreseen_step(double before, double now) {
  return now * (before > 0.0 ? std::clamp(now / before, 1.0, 1.1) : 1.0);
}

}  // namespace abut::contact
