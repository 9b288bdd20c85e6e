// Laws through the thickness of a shell: weights of the points, LAW1, an elastic LAW2, thickness, damping, LAW0.
#include <gtest/gtest.h>

#include "elements/shell_common/setup.hpp"
#include "unit/elements/shell_strained.hpp"

namespace abut::elements::test {
namespace {

using strained::e;
using strained::nu;

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

// Thickness: elastic t (1 - nu/(1-nu) (exx + eyy)); plastic flow keeps the volume: e_zz = -(exx + eyy) up to elasticity.
TEST(ShellThickness, FollowsTheStrain) {
  Strained elastic;
  elastic.s.property().thickness_changes = true;
  elastic.start();
  elastic.step(1.0, 1e-3, 2e-3);
  EXPECT_NEAR(elastic.r->group->thickness(0), 1.0 - 0.3 / 0.7 * 3e-3, 1e-15);
  Strained plain;
  plain.start();
  plain.step(1.0, 1e-3, 2e-3);
  EXPECT_EQ(plain.r->group->thickness(0), 1.0);

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
