// Hertz contact of two equal spheres and of two parallel cylinders (issue: the contact heart, 6), TYPE3 in two passes, gap 0, no
// friction, meshes that do not match. H. Hertz 1882; K. L. Johnson, Contact Mechanics (1985), 4.2; E* = E / (2 (1 - nu^2)).
//   spheres, R* = R/2, approach d:    a = sqrt(R* d), F = 4/3 E* sqrt(R*) d^(3/2), p = p0 sqrt(1 - r^2/a^2), p0 = 3 F / (2 pi a^2)
//   cylinders, R* = R/2, force F':    a = sqrt(4 F' R* / (pi E*)), p0 = 2 F' / (pi a); no approach of its own
//
// What is compared
//   Each surface's nodal contact forces over the nodes' area of the undeformed mesh, as in the linear theory; both surfaces
//   together. a: radius of the elliptic distribution with the same second moment, a^2 = 5/2 (spheres), 4 (cylinders) times
//   sum f r^2 / sum f. p0: least squares of p^2 = p0^2 (1 - r^2/a^2) within 0.9 a. The approach is the imposed one less the
//   largest penetration, the springs' own share.
//
// Protocol: the bodies are pressed together by imposed displacements that start and end smoothly (quintic ramp), nothing is
// damped. Bricks are small near the contact and large far away; density goes with 1 / size^2, so that all have one time step
// (the static answer does not depend on it). KE stays below 1 % of IE after the ramp (asserted; found 1e-4).
//
// The theory is of half-spaces. Spheres: each body is a block of 60 mm with a spherical cap of R = 50 mm; its outer border
// follows the displacement of a half-space under a point load (Boussinesq; at 60 mm 6 % of the approach in each body), without
// which bodies on plane bases are too stiff. Small strain without bulk viscosity, as the theory: p0/E is 0.14. Cylinders: a
// strip of 40 mm of the true cylinder, plane strain, one brick thick, free sides, plane ends held at a distance; default property
// (finite strain, viscosity).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/csv.hpp"
#include "support/quasi_static.hpp"
#include "support/round.hpp"
#include "support/scene.hpp"

namespace abut::scenes::hertz {

inline constexpr double pi = std::numbers::pi;

/// Pressure over the distance from the middle of the contact, of every contact node of both bodies.
class Pressure {
 public:
  void add(double distance, double force, double area) { points_.push_back({distance, force, area}); }

  /// sqrt(factor sum f r^2 / sum f)
  [[nodiscard]] double radius(double factor) const {
    double force = 0.0;
    double moment = 0.0;
    for (const Point& p : points_) {
      force += p.force;
      moment += p.force * p.distance * p.distance;
    }
    return std::sqrt(factor * moment / force);
  }

  /// Peak of the fitted ellipse, nodes within `reach`.
  [[nodiscard]] double peak(double reach) const {
    double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Point& p : points_) {
      if (p.distance > reach) continue;
      const double rr = p.distance * p.distance;
      const double pp = (p.force / p.area) * (p.force / p.area);
      w += p.area;
      x += p.area * rr;
      y += p.area * pp;
      xx += p.area * rr * rr;
      xy += p.area * rr * pp;
    }
    const double slope = (w * xy - x * y) / (w * xx - x * x);
    return std::sqrt((y - slope * x) / w);
  }

  /// Mean pressure of the nodes in the middle.
  [[nodiscard]] double middle() const {
    double force = 0.0;
    double area = 0.0;
    for (const Point& p : points_) {
      if (p.distance > 0.0) continue;
      force += p.force;
      area += p.area;
    }
    return force / area;
  }

  void write(const std::string& name) const {
    Csv csv(name, "distance,pressure");
    for (const Point& p : points_) csv.row({p.distance, p.force / p.area});
  }

 private:
  struct Point {
    double distance, force, area;
  };
  std::vector<Point> points_;
};

struct Answer {
  double force = 0.0, radius = 0.0, pressure = 0.0, middle = 0.0;
  double penetration = 0.0, kinetic = 0.0, hourglass = 0.0;
  int bricks = 0, cycles = 0;
};

inline Answer energies_of(const Scene& scene, const StaticRecord& r, double ramp) {
  EXPECT_EQ(r.outcome.kind, cycle::Outcome::Kind::finished) << r.outcome.message;
  const auto& last = r.energies.back();
  Answer a;
  a.penetration = last.penetration;
  a.kinetic = r.kinetic_share(ramp);
  a.hourglass = last.he / last.ie;
  a.bricks = static_cast<int>(scene.model.bricks.size());
  a.cycles = static_cast<int>(r.energies.size());
  return a;
}

inline void expect_static(const Answer& a) {
  EXPECT_LT(a.kinetic, 0.01);
  EXPECT_LT(a.hourglass, 0.02);
}

/// Found over expected.
struct Shares {
  double force, radius, pressure;
};

/// E* of two equal bodies.
inline double modulus(double young, double poisson) { return young / (2.0 * (1.0 - poisson * poisson)); }

}  // namespace abut::scenes::hertz
