// Coulomb coefficients that depend on pressure and sliding speed, and the filter of friction forces: value types.
#pragma once

#include <array>

namespace abut::contact {

/// mu(P, v): Radioss' friction laws Ifric 0 to 4. P contact pressure (normal force over the facet's area), v tangential speed,
/// C1..C6 = c[0]..c[5]; Fric is the interface's `friction`.
struct FrictionLaw {
  enum class Model {
    coulomb,      ///< Fric
    polynomial,   ///< Fric + (C1 + C4 P) P + (C2 + C3 P) v + C5 v^2
    darmstadt,    ///< Fric + C1 e^(C2 v) P^2 + C3 e^(C4 v) P + C5 e^(C6 v)
    renard,       ///< C1 static, C2 dynamic, C3 largest, C4 smallest coefficient; C5, C6 the speeds of C3 and C4
    exponential,  ///< C1 + (Fric - C1) e^(-C2 v)
  } model = Model::coulomb;
  std::array<double, 6> c{};  ///< C1 to C6, in the host's units of pressure and speed; not looked at by coulomb
};

/// F <- a F + (1 - a) F_old with a constant share, or a = min(1, 2 pi frequency h) where a frequency is given.
struct FrictionFilter {
  double share = 1.0;      ///< a, in (0, 1]; 1: none
  double frequency = 0.0;  ///< 1/time; 0: `share` counts
  [[nodiscard]] bool acts() const { return share != 1.0 || frequency > 0.0; }
  /// a, at most 1. @param step  h > 0, in the time unit of `frequency`
  [[nodiscard]] double weight(double step) const {
    if (frequency <= 0.0) return share;
    const double a = 6.283185307179586476925 * frequency * step;
    return a < 1.0 ? a : 1.0;
  }
};

}  // namespace abut::contact
