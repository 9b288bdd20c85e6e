// Normal law per unit of pair stiffness: force(P), its potential and its tangent.
//
// Radioss Theory Manual, "Solid and Shell Element Contact (TYPE3)" (T24): Fn = K0 Gap/(Gap - P) P, and the constant law
// Fn = K0 P where Gap = 0 or where asked. P penetration = Gap - distance, both lengths; all results per unit of K0:
//   constant     phi = P^2/2                           phi' = P             phi'' = 1
//   stiffening   phi = g^2 (-P/g - ln(1 - P/g))        phi' = g P/(g - P)   phi'' = (g/(g - P))^2
// Where we differ: the stiffening law has a pole at P = g. Beyond P = 0.9 g (`bend`) it goes on along its tangent (C1, slope
// 100): finite for every P, a potential still, and stable with a time step that knows the slope.
// P <= 0 gives zero everywhere. phi enters forces (the gradient of the pair stiffness), so ln is our own: no libm.
#pragma once

namespace abut::contact {

struct NormalLaw {
  double gap = 0.0;     ///< <= 0: constant law
  bool capped = false;  ///< without the tangent beyond the bend: what a spring of hard_stiffness() from there on leaves over

  static constexpr double bend = 0.9;
  /// Slope beyond the bend.
  [[nodiscard]] static constexpr double hard_stiffness() { return 1.0 / ((1.0 - bend) * (1.0 - bend)); }

  [[nodiscard]] constexpr bool stiffens() const { return gap > 0.0; }

  [[nodiscard]] constexpr double force(double p) const {
    if (p <= 0.0) return 0.0;
    if (!stiffens()) return p;
    const double u = p / gap;
    if (u <= bend) return gap * u / (1.0 - u);
    return gap * (bend / (1.0 - bend) + (capped ? 0.0 : (u - bend) * hard_stiffness()));
  }

  [[nodiscard]] constexpr double tangent(double p) const {
    if (p <= 0.0) return 0.0;
    if (!stiffens()) return 1.0;
    const double u = p / gap;
    if (u > bend) return capped ? 0.0 : hard_stiffness();
    return 1.0 / ((1.0 - u) * (1.0 - u));
  }

  /// d phi/dg at fixed P: phi is g^2 times a function of P/g.
  [[nodiscard]] constexpr double gap_slope(double p) const {
    return p > 0.0 && stiffens() ? (2.0 * potential(p) - p * force(p)) / gap : 0.0;
  }

  [[nodiscard]] constexpr double potential(double p) const {
    if (p <= 0.0) return 0.0;
    if (!stiffens()) return 0.5 * p * p;
    const double u = p / gap;
    if (u <= bend) return gap * gap * minus_u_minus_log(u);
    const double over = u - bend;
    const double slope = capped ? 0.0 : hard_stiffness();
    return gap * gap * (minus_u_minus_log(bend) + over * (bend / (1.0 - bend) + 0.5 * over * slope));
  }

  /// -u - ln(1 - u) for 0 <= u < 1, to about 4e-16 relative (TYPE7 uses it up to its pole).
  [[nodiscard]] static constexpr double minus_u_minus_log(double u) {
    if (u < 0.125) {  // the series itself: the difference would cancel
      constexpr double c[] = {1. / 20, 1. / 19, 1. / 18, 1. / 17, 1. / 16, 1. / 15, 1. / 14, 1. / 13, 1. / 12, 1. / 11,
                              1. / 10, 1. / 9,  1. / 8,  1. / 7,  1. / 6,  1. / 5,  1. / 4,  1. / 3,  1. / 2};
      double sum = 0.0;
      for (const double one : c) sum = sum * u + one;
      return sum * u * u;
    }
    constexpr double ln2 = 0.693147180559945309417232121458;
    double y = 1.0 - u;
    double log = 0.0;
    while (y < 0.70710678) {
      y *= 2.0;
      log -= ln2;
    }
    // ln y = 2 artanh((y - 1)/(y + 1)); |z| <= 0.172, z^24 < 1e-18.
    const double z = (y - 1.0) / (y + 1.0);
    const double zz = z * z;
    constexpr double c[] = {1. / 23, 1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11, 1. / 9, 1. / 7, 1. / 5, 1. / 3, 1.};
    double sum = 0.0;
    for (const double one : c) sum = sum * zz + one;
    return -u - (log + 2.0 * z * sum);
  }
};

}  // namespace abut::contact
