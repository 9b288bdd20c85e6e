// LAW1 and LAW2 through the thickness of a shell: closed forms of uniaxial tension, rate, failure, bending, thickness.
#include <gtest/gtest.h>

#include "elements/shell_common/setup.hpp"
#include "unit/elements/shell_support.hpp"

namespace abut::elements::test {
namespace {

constexpr double e = 210.0, nu = 0.3;

/// A unit square (or a right triangle) that is strained in its own axes: node 1 at the origin, side 1-2 along x.
struct Strained {
  ShellModel s;
  bool quad;
  std::unique_ptr<Runner> r;

  explicit Strained(bool as_quad = true, double t = 1.0) : s({e, nu, 7.8e-6}, t), quad(as_quad) {
    std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    if (!quad) x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.single(x);
  }
  void start(Profile profile = Profile::standard()) { r = std::make_unique<Runner>(s, quad, profile); }

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
    double a = -nu * xx, fa = lateral(a), b = -0.5 * xx, fb = lateral(b);
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

// Numerics.md 3.4: sum w = 1, sum wm zeta = 1/12 (linear stress gives M = s/6 exactly), and a row of its table.
TEST(ShellSectionWeights, ConstantAndLinearStressAreExact) {
  for (int n = 2; n <= 10; ++n) {
    ShellSection s;
    set_thickness_points(s, n);
    double force = 0.0, moment = 0.0, coupling = 0.0, constant = 0.0;
    for (int k = 0; k < n; ++k) {
      force += s.weight[k];
      constant += s.moment_weight[k];
      moment += s.moment_weight[k] * s.zeta[k];
      coupling += s.weight[k] * s.zeta[k];
    }
    EXPECT_NEAR(force, 1.0, 1e-15) << n;
    EXPECT_NEAR(moment, 1.0 / 12.0, 1e-16) << n;
    EXPECT_NEAR(coupling, 0.0, 1e-16) << n;
    EXPECT_NEAR(constant, 0.0, 1e-16) << n;
  }
  ShellSection six;
  set_thickness_points(six, 6);
  EXPECT_NEAR(six.moment_weight[5], 13.0 / 300.0, 1e-16);
  EXPECT_NEAR(six.moment_weight[4], 3.0 / 50.0, 1e-16);
  EXPECT_NEAR(six.zeta[3], 0.1, 1e-16);
  EXPECT_THROW(set_thickness_points(six, 11), std::invalid_argument);
}

// LAW2 that never yields is LAW1, for every number of points, quads and triangles: forces, moments, energies.
TEST(ShellLaw2, ElasticRangeIsLaw1ForEveryNumberOfPoints) {
  for (const bool quad : {true, false}) {
    Strained elastic(quad);
    elastic.start();
    elastic.step(1.0, 3e-4, -1e-4, 2e-4, 5e-4, -2e-4);
    const ElementOutput a = elastic.out();
    for (int n = 0; n <= 10; ++n) {
      if (n == 1) continue;
      Strained plastic(quad);
      plastic.s.johnson_cook().a = 1e9;
      plastic.s.property().points = n;
      plastic.start();
      plastic.step(1.0, 3e-4, -1e-4, 2e-4, 5e-4, -2e-4);
      const ElementOutput b = plastic.out();
      for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(a.resultants[i], b.resultants[i], 1e-15) << n << ' ' << i;
      EXPECT_NEAR(a.bending_energy, b.bending_energy, 1e-13 * a.bending_energy);
      EXPECT_NEAR(a.membrane_energy, b.membrane_energy, 1e-13 * a.membrane_energy);
    }
  }
}

// Stress through the thickness of an elastic shell that is stretched and bent: C (e + z kappa) at z = +-t/2 and at the points, in
// global axes (the shell is turned by 90 degrees about z), whether the law keeps points (LAW2) or not (LAW1).
TEST(ShellLayers, StressIsLinearThroughTheThickness) {
  const double small = 1e-7;  // the triangle has second-order terms (kernel.hpp): some small^2
  const double t = 0.8, exx = 3 * small, eyy = -small, gxy = 2 * small, kxx = 5 * small, kyy = -2 * small;
  const auto exact = [&](double z) {
    const double c = e / (1.0 - nu * nu), x = exx + z * kxx, y = eyy + z * kyy;
    return std::array{c * (x + nu * y), c * (y + nu * x), e / (2.0 * (1.0 + nu)) * gxy};
  };
  for (const bool quad : {true, false}) {
    for (const int points : {0, 4}) {
      Strained shell(quad, t);
      if (points > 0) {
        shell.s.johnson_cook().a = 1e9;
        shell.s.property().points = points;
      }
      shell.start();
      shell.step(1.0, exx, eyy, gxy, kxx, kyy);
      const std::vector<Vec3> flat = shell.r->x;
      for (Vec3& x : shell.r->x) x = {-x.y, x.x, x.z};  // `output` takes the axes from where the nodes are now
      const auto expect = [&](ShellLayer layer, const std::array<double, 3>& own) {
        const auto s = shell.r->group->layer_stress(0, layer);
        // The transverse shear of the turning nodes is constant through the thickness; bending has none.
        std::array<double, 6> turned = layer.kind == ShellLayer::Kind::bending ? std::array<double, 6>{} : shell.out().stress;
        turned[0] = own[1];
        turned[1] = own[0];
        turned[3] = -own[2];
        for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(s[i], turned[i], 10.0 * e * small * small) << quad << points << i;
      };
      using Kind = ShellLayer::Kind;
      expect({Kind::upper}, exact(0.5 * t));
      expect({Kind::lower}, exact(-0.5 * t));
      const auto top = exact(0.5 * t), bottom = exact(-0.5 * t);
      expect({Kind::bending}, {0.5 * (top[0] - bottom[0]), 0.5 * (top[1] - bottom[1]), 0.5 * (top[2] - bottom[2])});
      for (int k = 1; k <= points; ++k) expect({Kind::point, k}, exact(t * (-0.5 + (k - 1.0) / (points - 1.0))));
      EXPECT_EQ(shell.r->group->layer_stress(0, {Kind::point, points + 1}), (std::array<double, 6>{}));
      shell.r->x = flat;
    }
  }
}

// N = 1: membrane only.
TEST(ShellLaw1, OnePointHasNoBendingAndNoShear) {
  Strained m;
  m.s.property().points = 1;
  m.start();
  m.step(1.0, 1e-4, 0.0, 0.0, 5e-4, 1e-4);
  const ElementOutput o = m.out();
  EXPECT_NEAR(o.resultants[0], e / (1.0 - nu * nu) * 1e-4, 1e-15);
  for (const std::size_t i : {3U, 4U, 5U, 6U, 7U}) EXPECT_EQ(o.resultants[i], 0.0);
}

// Uniaxial tension to 10 % plastic strain: sigma = a + b p^n with p = eps - sigma/E, all three mappings (numerics.md 5.5: equal in
// uniaxial tension). The radial mapping uses the yield stress at the start of the step, the others at its end.
TEST(ShellLaw2, UniaxialTensionFollowsTheHardeningCurve) {
  for (const bool quad : {true, false}) {
    for (const int iplas : {1, 2, 3}) {
      for (const double n : {1.0, 0.4}) {
        Strained t(quad);
        auto& law = t.s.johnson_cook();
        law.a = 0.3;
        law.b = 0.5;
        law.n = n;
        t.s.property().iplas = iplas;
        t.start();
        double strain = 0.0, p_old = 0.0;
        const double rate = 1e-4;
        for (int i = 0; i < 1000; ++i) {
          t.uniaxial(1.0, rate);
          strain += rate;
          const ElementOutput o = t.out();
          const double p = o.plastic_max;
          const auto curve = [&](double q) { return 0.3 + 0.5 * std::pow(q, n); };
          if (i > 30) {
            if (iplas == 2) {
              EXPECT_NEAR(p, strain - o.resultants[0] / e, 1e-11);
              EXPECT_NEAR(o.resultants[0], curve(p_old), 1e-11);
            } else {
              // Iplas 3 takes dp = (mises - Y)/(3G + H) of a trial that is not uniaxial: less than the strain it relaxes.
              if (iplas == 1) { EXPECT_NEAR(p, strain - o.resultants[0] / e, 2e-6) << "n " << n; }
              EXPECT_NEAR(o.resultants[0], curve(p), 2e-3 * curve(p)) << "Iplas " << iplas << " n " << n;
            }
          }
          p_old = p;
        }
        EXPECT_GT(p_old, 0.09);
      }
    }
  }
}

// Biaxial paths: the iterative mapping satisfies the yield condition and normality of plane-stress J2; with n = 1 its two
// Newton corrections converge. Plastic strain increments are d(eps) - C^-1 d(sigma).
TEST(ShellLaw2, IterativeMappingIsNormalToTheYieldSurface) {
  Strained t;
  auto& law = t.s.johnson_cook();
  law.a = 0.3;
  law.b = 0.5;
  t.s.property().iplas = 1;
  t.start();
  const double rate[3] = {2e-5, -0.7e-5, 1.5e-5};
  ElementOutput old = t.out();
  for (int i = 0; i < 400; ++i) {
    t.step(1.0, rate[0], rate[1], rate[2]);
    const ElementOutput o = t.out();
    const double sx = o.resultants[0], sy = o.resultants[1], sxy = o.resultants[2];
    const double dx = sx - old.resultants[0], dy = sy - old.resultants[1], dxy = sxy - old.resultants[2];
    const double px = rate[0] - (dx - nu * dy) / e, py = rate[1] - (dy - nu * dx) / e, pxy = rate[2] - dxy * 2.6 / e;
    const double dp = o.plastic_max - old.plastic_max;
    if (old.plastic_max > 0.0) {
      EXPECT_NEAR(o.von_mises, 0.3 + 0.5 * o.plastic_max, 1e-7);
      const double f = dp / o.von_mises;
      EXPECT_NEAR(px, f * (sx - 0.5 * sy), 1e-8);
      EXPECT_NEAR(py, f * (sy - 0.5 * sx), 1e-8);
      EXPECT_NEAR(pxy, f * 3.0 * sxy, 1e-8);
    }
    old = o;
  }
  EXPECT_GT(old.plastic_max, 3e-3);
}

// sigma_max caps the stress.
TEST(ShellLaw2, StressStopsAtSigmaMax) {
  for (const int iplas : {1, 2, 3}) {
    Strained t;
    auto& law = t.s.johnson_cook();
    law.a = 0.3;
    law.b = 5.0;
    law.sigma_max = 0.4;
    t.s.property().iplas = iplas;
    t.start();
    for (int i = 0; i < 400; ++i) t.uniaxial(1.0, 1e-4);
    EXPECT_NEAR(t.out().resultants[0], 0.4, 1e-6) << iplas;
  }
}

// A fully plastic section: M = t^2 Y/4 in the limit of many points, i.e. M/t^2 = Y/4 (uniaxial bending with nu = 0).
TEST(ShellLaw2, PlasticMoment) {
  Strained t;
  auto& law = t.s.johnson_cook();
  law.poisson = 0.0;
  law.a = 0.3;
  t.s.property().points = 10;
  t.s.property().shear_factor = 0.0;
  t.start();
  for (int i = 0; i < 200; ++i) t.step(1.0, 0.0, 0.0, 0.0, 1e-3);
  EXPECT_NEAR(t.out().resultants[5], 0.3 / 4.0, 0.02 * 0.3 / 4.0);
  EXPECT_NEAR(t.out().resultants[0], 0.0, 1e-15);
}

// Johnson-Cook rate factor at a constant strain rate, for the three measures of the rate (numerics.md 5.2.3).
TEST(ShellLaw2, RateFactor) {
  const double rate = 2e-3, rate_0 = 1e-6, c = 0.05;
  for (const int vp : {1, 2, 3}) {
    for (const int icc : {1, 2}) {
      Strained t;
      auto& law = t.s.johnson_cook();
      law.a = 0.3;
      law.c = c;
      law.eps_rate_0 = rate_0;
      law.vp = vp;
      law.icc = icc;
      law.sigma_max = icc == 2 ? 0.31 : 1e20;
      // 10 kHz in units of 10 us: 0.1. The explicit feedback rate -> Y -> rate needs the filter's inertia to settle.
      t.s.model.units.time = 1e-5;
      t.start();
      const double h = 0.1;
      double p_old = 0.0;
      for (int i = 0; i < 300; ++i) {
        p_old = t.out().plastic_max;
        t.step(h, rate, -0.5 * rate);
      }
      const ElementOutput o = t.out();
      // e_xx = rate, e_yy = -rate/2: the equivalent rate of the total strains is 4/3 (1 + 1/4 - 1/2) = rate^2.
      double measure = rate;
      if (vp == 1) measure = (o.plastic_max - p_old) / h;  // steady by now: the filter has no effect
      if (vp == 3) {
        const double m = rate * 0.5 / 3.0, dx = rate - m, dy = -0.5 * rate - m;
        measure = 2.0 / 3.0 * std::sqrt(1.5 * (dx * dx + dy * dy + m * m));
      }
      const double factor = 1.0 + c * std::log(measure / rate_0);
      EXPECT_NEAR(o.von_mises, icc == 2 ? 0.31 : 0.3 * factor, vp == 1 ? 1e-4 : 1e-10) << "VP " << vp;
    }
  }
}

// The filter: after n steps of a suddenly applied rate it has reached 1 - (1 - alpha)^n of it.
TEST(ShellLaw2, RateFilter) {
  Strained t;
  auto& law = t.s.johnson_cook();
  law.a = 1e-4;
  law.c = 0.05;
  law.eps_rate_0 = 1e-6;
  law.cutoff = 0.1;
  t.start();
  const double h = 0.05, rate = 2e-3, alpha = 2.0 * std::numbers::pi * 0.1 * h;
  for (int i = 1; i <= 20; ++i) {
    t.step(h, rate, -0.5 * rate);
    const double filtered = rate * (1.0 - std::pow(1.0 - alpha, i));
    EXPECT_NEAR(t.out().von_mises, 1e-4 * (1.0 + 0.05 * std::log(filtered / 1e-6)), 1e-14);
  }
}

// Kinematic hardening: after uniaxial loading to sigma_1, reverse yielding starts at sigma_1 - 2 a (chi = 1, pure kinematic).
TEST(ShellLaw2, BauschingerEffect) {
  for (const int iplas : {1, 2}) {
    Strained t;
    auto& law = t.s.johnson_cook();
    law.a = 0.3;
    law.b = 2.0;
    law.kinematic = 1.0;
    t.s.property().iplas = iplas;
    t.start();
    for (int i = 0; i < 400; ++i) t.uniaxial(1.0, 5e-5);
    const double top = t.out().resultants[0], p = t.out().plastic_max;
    EXPECT_NEAR(top, 0.3 + 2.0 * p, 3e-4);
    double turned = 0.0;
    for (int i = 0; i < 200 && turned == 0.0; ++i) {
      const double before = t.out().resultants[0];
      t.uniaxial(1.0, -5e-5);
      if (t.out().plastic_max > p) turned = before;
    }
    EXPECT_NEAR(turned, top - 0.6, 0.0105 + 3e-4) << iplas;  // one step of unloading is 0.0105
  }
}

// Adiabatic heating: T - T_r = integral of Y dp / (rho C_p), and Y = a (1 - T*).
TEST(ShellLaw2, AdiabaticSoftening) {
  Strained t;
  auto& law = t.s.johnson_cook();
  law.a = 0.3;
  law.rho_cp = 1e-4;
  law.t_melt = 1300.0;
  t.start();
  for (int i = 0; i < 500; ++i) t.uniaxial(1.0, 1e-4);
  // dT/dp = a (1 - (T - Tr)/1000)/1e-4: Y = a exp(-a p/(1e-4 * 1000))
  const double p = t.out().plastic_max;
  EXPECT_NEAR(t.out().resultants[0], 0.3 * std::exp(-0.3 * p / 0.1), 2e-4);
  EXPECT_LT(t.out().resultants[0], 0.27);
}

// Failure: OFF = 0.8, 0.64, ... and 0 in the twelfth cycle; forces fade with it; then nothing (numerics.md 3.7).
TEST(ShellLaw2, FailureFadesAndRemoves) {
  Strained t;
  auto& law = t.s.johnson_cook();
  law.a = 0.3;
  law.eps_max = 0.01;
  t.start();
  double off = 1.0;
  int counted = 0;
  for (int i = 0; i < 400 && counted < 14; ++i) {
    // Equal stretch of both directions: the stress is Y at every step.
    const GroupResult g = t.step(1.0, 1e-4, 1e-4);
    const ElementOutput o = t.out();
    if (o.off < 1.0) {
      ++counted;
      off = counted < 12 ? off * 0.8 : 0.0;
      EXPECT_DOUBLE_EQ(o.off, off);
      EXPECT_NEAR(o.resultants[0], 0.3 * off, 1e-12);
      EXPECT_EQ(g.removed, counted == 12 ? 1 : 0);
      EXPECT_EQ(t.r->group->active(0), counted < 12);
      if (counted >= 12) {
        EXPECT_EQ(length(t.r->f) + length(t.r->m), 0.0);
        EXPECT_EQ(g.step, 1e30);
        EXPECT_EQ(t.r->stiffness[0], 0.0);
      }
    } else {
      EXPECT_LT(o.plastic_max, 0.01);
    }
    if (counted == 12) {
      const double left = o.internal_energy;
      t.step(1.0, 1e-4, 1e-4);
      EXPECT_EQ(t.out().internal_energy, left);
      EXPECT_GT(left, 0.0);
      ++counted;
    }
  }
  EXPECT_GE(counted, 13);
}

// Thickness: elastic t (1 - nu/(1-nu) (exx + eyy)); plastic flow keeps the volume: e_zz = -(exx + eyy) up to elasticity.
TEST(ShellThickness, FollowsTheStrain) {
  Strained elastic;
  elastic.s.property().thickness_changes = true;
  elastic.start();
  elastic.step(1.0, 1e-3, 2e-3);
  EXPECT_NEAR(elastic.out().thickness, 1.0 - 0.3 / 0.7 * 3e-3, 1e-15);
  EXPECT_NEAR(elastic.r->group->thickness(0), elastic.out().thickness, 0.0);

  // Equal biaxial flow, iterative mapping: ln t = -(exx + eyy) + elastic volume change (1 - 2 nu)(sxx + syy)/E.
  Strained biaxial;
  biaxial.s.property().thickness_changes = true;
  biaxial.s.property().iplas = 1;
  biaxial.s.johnson_cook().a = 0.3;
  biaxial.start();
  for (int i = 0; i < 500; ++i) biaxial.step(1.0, 1e-4, 1e-4);
  const ElementOutput o = biaxial.out();
  const double volume = (1.0 - 2.0 * nu) * (o.resultants[0] + o.resultants[1]) / e;
  EXPECT_NEAR(std::log(o.thickness), -0.1 + volume, 1e-5);
  // Uniaxial flow: ln t = -nu sigma/E - p/2. (The radial mapping keeps the direction of stress: its lateral strain stays elastic.)
  Strained uniaxial;
  uniaxial.s.property().thickness_changes = true;
  uniaxial.s.property().iplas = 1;
  uniaxial.s.johnson_cook().a = 0.3;
  uniaxial.start();
  for (int i = 0; i < 500; ++i) uniaxial.uniaxial(1.0, 1e-4);
  EXPECT_NEAR(std::log(uniaxial.out().thickness), -nu * uniaxial.out().resultants[0] / e - 0.5 * uniaxial.out().plastic_max, 1e-5);
  Strained fixed;
  fixed.start();
  fixed.step(1.0, 1e-3, 2e-3);
  EXPECT_EQ(fixed.out().thickness, 1.0);
}

// Membrane damping, numerics.md 3.6: added to F and to the energy, not kept.
TEST(ShellDamping, MembraneDampingIsViscous) {
  for (const bool plastic : {false, true}) {
    Strained t;
    if (plastic) t.s.johnson_cook().a = 1e9;
    t.s.property().dm = 0.1;
    t.start();
    const double mu = 1.414 * 0.1 * 7.8e-6 * std::sqrt(e / 7.8e-6);
    t.step(1.0, 1e-4, 0.0);
    const double elastic = e / (1.0 - nu * nu) * 1e-4;
    EXPECT_NEAR(t.out().resultants[0], elastic + mu * 1e-4, 1e-15);
    EXPECT_NEAR(t.out().resultants[1], nu * elastic + 0.5 * mu * 1e-4, 1e-15);
    t.step(1.0, 0.0, 0.0);
    EXPECT_NEAR(t.out().resultants[0], elastic, 1e-15);
  }
}

// LAW0: mass, nothing else.
TEST(ShellVoid, HasMassOnly) {
  Strained t;
  t.s.model.materials[0].law = model::LawVoid{};
  t.start();
  EXPECT_EQ(t.r->group->family(), Family::inert);
  EXPECT_NEAR(t.r->mass[0] * 4.0, 7.8e-6, 1e-18);
  const GroupResult g = t.step(1.0, 0.1, 0.1);
  EXPECT_EQ(g.step, 1e30);
  EXPECT_EQ(g.internal_energy, 0.0);
  EXPECT_EQ(length(t.r->f), 0.0);
  EXPECT_TRUE(t.r->group->history().empty());
}

}  // namespace
}  // namespace abut::elements::test
