// The friction coefficient of a pair as a pure function of pressure and speed.
//
// Radioss Reference Guide, /INTER/TYPE5 and /INTER/TYPE7, Ifric 0 to 4; numerics.md 7.4.5 (confirmed by runs), 7.7.5. Symbols: P pressure
// (force over area, >= 0), v tangential speed (>= 0), Fric and C1..C6 of abut/contact/friction_law.hpp. Renard's last branch in
// the form C2 - D/(1 + D (v - C6)^2), D = C2 - C4, which has no pole for D = 0.
// Where we differ: a law that gives a negative coefficient gives 0 (friction would drive the motion).
// exp is our own: the coefficient is on the state path and libm's bits depend on the CPU.
#pragma once

#include <bit>
#include <cstdint>

#include "abut/contact/friction_law.hpp"

namespace abut::contact {

/// e^x, relative error below 4e-16; e^(-700) and e^700 beyond those ends.
[[nodiscard]] constexpr double exponential(double x) {
  x = x < -700.0 ? -700.0 : (x > 700.0 ? 700.0 : x);
  // x = k ln 2 + r, |r| <= ln 2/2; ln 2 in two parts so that r keeps its digits.
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  const double turns = x * 1.44269504088896338700;
  const auto k = static_cast<std::int64_t>(turns < 0.0 ? turns - 0.5 : turns + 0.5);
  const double r = (x - static_cast<double>(k) * ln2_high) - static_cast<double>(k) * ln2_low;
  double sum = 1.0;
  for (int n = 14; n >= 1; --n) sum = 1.0 + sum * r / n;
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52U);
}

[[nodiscard]] constexpr double friction_coefficient(const FrictionLaw& law, double fric, double p, double v) {
  const auto& c = law.c;
  double mu = fric;
  switch (law.model) {
    case FrictionLaw::Model::coulomb:
      break;
    case FrictionLaw::Model::polynomial:
      mu = fric + (c[0] + c[3] * p) * p + (c[1] + c[2] * p) * v + c[4] * v * v;
      break;
    case FrictionLaw::Model::darmstadt:
      mu = fric + c[0] * exponential(c[1] * v) * p * p + c[2] * exponential(c[3] * v) * p + c[4] * exponential(c[5] * v);
      break;
    case FrictionLaw::Model::renard:
      if (v < c[4]) {
        mu = c[0] + (c[2] - c[0]) * (v / c[4]) * (2.0 - v / c[4]);
      } else if (v < c[5]) {
        const double xi = (v - c[4]) / (c[5] - c[4]);
        mu = c[2] + (c[3] - c[2]) * xi * xi * (3.0 - 2.0 * xi);
      } else {
        const double d = c[1] - c[3];
        mu = c[1] - d / (1.0 + d * (v - c[5]) * (v - c[5]));
      }
      break;
    case FrictionLaw::Model::exponential:
      mu = c[0] + (fric - c[0]) * exponential(-c[1] * v);
      break;
  }
  return mu > 0.0 ? mu : 0.0;
}

}  // namespace abut::contact
