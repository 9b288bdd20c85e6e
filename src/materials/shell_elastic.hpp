// LAW1 in plane stress (numerics.md 0.4, 3.4, 5.1): C = [A11 A12 0; A12 A11 0; 0 0 G].
#pragma once

#include "simd/pack.hpp"

namespace abut::materials {

struct ShellElastic {
  double young = 0.0, poisson = 0.0;
  double a11 = 0.0, a12 = 0.0, shear = 0.0;  ///< E/(1 - nu^2), nu A11, E/(2 (1 + nu))

  [[nodiscard]] static ShellElastic of(double young, double poisson) {
    const double a11 = young / (1.0 - poisson * poisson);
    return {young, poisson, a11, poisson * a11, 0.5 * young / (1.0 + poisson)};
  }
};

}  // namespace abut::materials
