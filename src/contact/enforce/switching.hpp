// Contact that starts or ends inside a step: choose its first and last force so that switching makes no energy.
//
// In leap-frog a force f changes the kinetic energy by exactly f (h + h')/2 (v + v')/2, h and h' the steps before and after it, v and v'
// the opening speeds in them. With the law's force in every cycle these works miss the potential by what happens in the two steps in which
// P changes sign. So, with F = kappa phi', Psi = kappa phi, D the motion over the last step and D' over the coming one:
//   first cycle, at P after moving D > P inwards (D, D' > 0 inwards):
//     f (h + h')/(4 h) (D + D' h/h') = Psi(P + D') - F(P + D') D'/2,   D' = D h'/h - h' (h + h')/2 (f/m + a),   -F(P) <= f <= 2 F(P)
//     in and out again, P + D' <= 0:                         f = Psi(P)/D + Psi(P)/|D'|, at most 2 F(P)
//     turns around at once, (1 + h'/h)(D + D' h/h') <= D 2/5:  f as it was one iteration before; the account (account.hpp) settles the rest
//   last cycle, at P before moving D' > P outwards (D, D' > 0 outwards), the first with time reversed and h' = h:
//     f (D + D')/2 = Psi(P + D) - F(P + D) D/2,              D' = D + h^2 (f/m + a)
//     still closing over the last step, D <= 0:              f = F(P)/2 + Psi(P)/D',   D' = D + h^2 (F(P)/m + a)
//   any other cycle: F(P). Which one is the last is asked of the law: D + h^2 (F(P)/m + a) > P.
// For the linear law, constant speed and h' = h both are f = F (1 + P/D)/2. With h' = h they are continuous: where the step just ends at
// the surface (D or D' = P) the law's own force solves them.
// In these two cycles the energy that the force holds is what it took in the step before, f D/2, or will give back in the step
// after, f D'/2: with it, as with Psi in between, every single step of leap-frog balances.
// h' as `coming` foresees it (0: h); m effective mass of the pair; a the opening acceleration by all other forces as seen over the last
// step. With masses not given, speeds count as constant. Fixed point, 16 iterations: contracts for h^2 K/m < 1.
#pragma once

#include <algorithm>

#include "contact/enforce/law.hpp"

namespace abut::contact {

struct Switching {
  NormalLaw law;
  double stiffness = 0.0;     ///< kappa
  double penetration = 0.0;   ///< P > 0
  double step = 0.0;          ///< h > 0
  double rate = 0.0;          ///< speed of opening over the last step
  double inverse_mass = 0.0;  ///< 1/m
  double others = 0.0;        ///< a
  double coming = 0.0;        ///< h', the step that follows; 0: as long as h
};

struct Switched {
  double force = 0.0;   ///< instead of kappa phi'(P)
  double stored = 0.0;  ///< instead of kappa phi(P)
};

/// @param first  contact began in the last step
[[nodiscard]] inline Switched switched_spring(const Switching& s, bool first) {
  const auto force = [&s](double p) { return s.stiffness * s.law.force(p); };
  const auto missing = [&](double p, double moved) { return s.stiffness * s.law.potential(p) - 0.5 * force(p) * moved; };
  const double plain = force(s.penetration);
  const double stored = s.stiffness * s.law.potential(s.penetration);
  const double kick = s.step * s.step * s.inverse_mass;
  const double drift = s.step * s.step * s.others;
  const double inwards = -s.rate * s.step;
  constexpr int iterations = 16;
  if (first && inwards > s.penetration) {
    const double coming = s.coming > 0.0 ? s.coming : s.step;
    const double longer = coming / s.step;
    const double turn = 0.5 * (s.step + coming) * coming;
    double f = 0.5 * plain + stored / inwards;
    for (int i = 0; i < iterations; ++i) {
      const double next = longer * inwards - turn * (s.inverse_mass * f + s.others);
      if (s.penetration + next <= 0.0) {  // in and out again: both steps carry half of the work
        f = stored / inwards + stored / -next;
        break;
      }
      const double work = 0.25 * (1.0 + longer) * (inwards + next / longer);  // of a unit force, as it changes the speed
      if (work <= 0.1 * inwards) break;                                       // turns around: no work to correct
      // Long steps of a light node: the sum of the two forces cannot be had, and the account settles the rest at the end.
      const double last = f;
      f = std::clamp(missing(s.penetration + next, next) / work, -plain, 2.0 * plain);
      if (f == last) break;
    }
    f = std::min(f, 2.0 * plain);
    return {f, 0.5 * f * inwards};
  }
  const double outwards = -inwards;
  if (outwards + kick * plain + drift <= s.penetration) return {plain, stored};
  if (outwards <= 0.0) {
    const double next = outwards + kick * plain + drift;
    const double f = 0.5 * plain + stored / next;
    return {f, 0.5 * f * next};
  }
  const double work = missing(s.penetration + outwards, outwards);
  double f = plain;
  double next = 0.0;
  for (int i = 0; i < iterations; ++i) {
    next = outwards + kick * f + drift;
    if (next <= 0.0) return {plain, stored};
    const double last = f;
    f = 2.0 * work / (outwards + next);
    if (f == last) break;
  }
  return {f, work - 0.5 * f * outwards};
}

/// The same for the whole law: a stiffening law that is passed beyond its bend is two springs, and the hard one is switched on and
/// off at the bend as the soft one is at the surface.
[[nodiscard]] inline Switched switched_force(const Switching& s, bool first) {
  if (!s.law.stiffens()) return switched_spring(s, first);
  const double hard = s.penetration - NormalLaw::bend * s.law.gap;
  Switching near = s;
  near.law.capped = true;
  if (hard <= 0.0) return switched_spring(near, first);
  Switching far{NormalLaw{}, s.stiffness * NormalLaw::hard_stiffness(), hard, s.step, s.rate, s.inverse_mass, s.others, s.coming};
  near.others += s.inverse_mass * far.stiffness * hard;
  const Switched soft = switched_spring(near, first);
  far.others += s.inverse_mass * soft.force;
  const Switched rest = switched_spring(far, true);
  return {soft.force + rest.force, soft.stored + rest.stored};
}

}  // namespace abut::contact
