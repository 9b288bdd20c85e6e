// One brick of steel whose nodes follow a given motion, for the tests of its laws.
#pragma once

#include <vector>

#include "unit/elements/solid_fixture.hpp"

namespace abut::elements::test::brick {

inline const std::vector<std::vector<Index>> one = {{0, 1, 2, 3, 4, 5, 6, 7}};
inline constexpr double young = 210.0, nu = 0.3, bulk = young / 1.2, shear = young / 2.6;

inline SolidSetup without_viscosity() {
  SolidSetup s;
  s.property.qa = s.property.qb = 0.0;
  return s;
}

inline model::LawJohnsonCook plastic(double a, double b = 0.0, double n = 1.0) {
  model::LawJohnsonCook law;
  law.young = young;
  law.poisson = nu;
  law.a = a;
  law.b = b;
  law.n = n;
  return law;
}

/// Moves every node along `field` (per unit time) for `steps` steps of 1/steps; `v` is set from the initial positions.
template <class Field>
void drive(SolidBody& body, Field field, int steps, double duration = 1.0) {
  body.step(0.0);
  const auto start = body.x;
  for (int i = 0; i < steps; ++i) {
    for (std::size_t k = 0; k < body.x.size(); ++k) body.v[k] = (1.0 / duration) * field(start[k]);
    body.advance(duration / steps);
  }
}

}  // namespace abut::elements::test::brick
