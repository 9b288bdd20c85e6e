// One shell of LAW1 or LAW2 that is strained in its own axes, for the tests of laws through the thickness.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "unit/elements/shell_support.hpp"

namespace abut::elements::test {

namespace strained {
inline constexpr double e = 210.0, nu = 0.3;
}

/// A unit square (or a right triangle) that is strained in its own axes: node 1 at the origin, side 1-2 along x.
struct Strained {
  ShellModel s;
  bool quad;
  std::unique_ptr<Runner> r;

  explicit Strained(bool as_quad = true, double t = 1.0) : s({strained::e, strained::nu, 7.8e-6}, t), quad(as_quad) {
    std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    if (!quad) x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.single(x);
  }
  void start(Profile profile = Profile::standard()) {
    profile.strain_increment = Profile::StrainIncrement::reference;  // in steps of constant geometry the strain is h D
    r = std::make_unique<Runner>(s, quad, profile);
  }

  /// One step of constant geometry: rates xx, yy, xy and curvature rates.
  GroupResult step(double h, double xx, double yy, double xy = 0.0, double kxx = 0.0, double kyy = 0.0) {
    for (std::size_t k = 0; k < r->x.size(); ++k) {
      const Vec3 x = r->x[k];
      r->v[k] = {xx * x.x + xy * x.y, yy * x.y, 0.0};
      r->w[k] = {-kyy * x.y, kxx * x.x, 0.0};
    }
    return r->step(h);
  }

  /// One step with the lateral rate that leaves sigma_yy = 0 (secant on the whole group, history put back in between).
  GroupResult uniaxial(double h, double xx) {
    auto state = r->group->history();
    const std::vector<double> saved(state[0].begin(), state[0].end());
    const auto lateral = [&](double yy) {
      std::copy(saved.begin(), saved.end(), state[0].begin());
      result = step(h, xx, yy);
      return r->group->output(0).resultants[1];
    };
    double a = -strained::nu * xx, fa = lateral(a), b = -0.5 * xx, fb = lateral(b);
    for (int i = 0; i < 60 && std::abs(fb) > 1e-13 && fa != fb; ++i) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b;
      fa = fb;
      b = c;
      fb = lateral(b);
    }
    EXPECT_LT(std::abs(fb), 1e-9);
    return result;
  }
  [[nodiscard]] ElementOutput out() const { return r->group->output(0); }
  GroupResult result;
};

}  // namespace abut::elements::test
