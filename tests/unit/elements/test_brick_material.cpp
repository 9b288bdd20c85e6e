// Point laws through the brick: pressure, shear, viscosity (numerics.md 5.1, 4.5), internal energy (1.6.1), small strain.
#include <gtest/gtest.h>

#include "unit/elements/brick_drive.hpp"

namespace abut::elements::test {
namespace {

using namespace brick;

// p = B (V0/V - 1) exactly, for any size of the compression, and no deviator.
TEST(BrickLaw1, HydrostaticPressureFromVolume) {
  for (const double e : {-0.3, -0.01, 0.2}) {
    SolidBody body(unit_cube(), one, without_viscosity());
    drive(
        body, [e](const Vec3& x) { return e * x; }, 7);
    const double v = std::pow(1 + e, 3);
    EXPECT_NEAR(body.output().pressure, bulk * (1 / v - 1), 1e-12 * bulk);
    EXPECT_NEAR(body.output().volume, v, 1e-14);
    EXPECT_NEAR(body.output().von_mises, 0.0, 1e-12);
    EXPECT_NEAR(body.output().density, 7.8 / v, 1e-13);
  }
}

// Simple shear of a small angle: sigma_xy = G gamma; and the energy 1/2 G gamma^2 V.
TEST(BrickLaw1, SmallShear) {
  const double gamma = 1e-5;
  for (const int iframe : {1, 2}) {
    SolidSetup s = without_viscosity();
    s.property.iframe = iframe;
    SolidBody body(unit_cube(), one, s);
    drive(
        body,
        [gamma](const Vec3& x) {
          return Vec3{gamma * x.y, 0, 0};
        },
        10);
    EXPECT_NEAR(body.output().stress[3], shear * gamma, 2 * gamma * shear * gamma);
    EXPECT_NEAR(body.result.internal_energy, 0.5 * shear * gamma * gamma, 2 * gamma * shear * gamma * gamma);
  }
}

// Uniaxial strain: sigma_xx = (B + 4/3 G) e, lateral (B - 2/3 G) e, for small e.
TEST(BrickLaw1, UniaxialStrain) {
  const double e = 1e-6;
  SolidBody body(unit_cube(), one, without_viscosity());
  drive(
      body,
      [e](const Vec3& x) {
        return Vec3{e * x.x, 0, 0};
      },
      4);
  EXPECT_NEAR(body.output().stress[0], (bulk + 4 * shear / 3) * e, 3 * e * e * young);
  EXPECT_NEAR(body.output().stress[1], (bulk - 2 * shear / 3) * e, 3 * e * e * young);
}

// Bulk viscosity (4.5): q = rho l <-tr D>(qa^2 l <-tr D> + qb c) in compression, none in expansion; the nodal force carries it.
TEST(BrickViscosity, ClosedForm) {
  SolidSetup s;
  SolidBody body(unit_cube(), one, s);
  constexpr double rate = 0.7;
  const double c = std::sqrt((bulk + 4.0 / 3.0 * shear) / 7.8);
  body.set_velocity([](const Vec3& x) { return Vec3{-rate * x.x, 0, 0}; });
  body.step(0.0);
  const double q = 7.8 * rate * (1.21 * rate + 0.05 * c);
  EXPECT_NEAR(body.output().bulk_viscosity, q, 1e-13);
  EXPECT_NEAR(body.f[1].x, -q / 4, 1e-13);
  body.set_velocity([](const Vec3& x) { return Vec3{rate * x.x, 0, 0}; });
  body.step(0.0);
  EXPECT_EQ(body.output().bulk_viscosity, 0.0);
}

// l = V^(1/3) follows the volume to rounding over four orders of magnitude of compression rate.
TEST(BrickViscosity, LengthFollowsVolume) {
  SolidSetup s;
  s.profile.strain_increment = Profile::StrainIncrement::reference;  // tr D of the shape at the end
  s.property.qa = 0.0;
  s.property.qb = 1.0;
  SolidBody body(unit_cube(), one, s);
  const double c = std::sqrt((bulk + 4.0 / 3.0 * shear) / 7.8);
  body.step(0.0);
  for (int i = 0; i < 20; ++i) {
    for (std::size_t k = 0; k < 8; ++k) body.v[k] = -1.0 * body.x[k];
    body.advance(0.05);
    const double v = body.output().volume, rate = 3.0 / 0.95;
    EXPECT_NEAR(body.output().bulk_viscosity / (7.8 / v * std::cbrt(v) * rate * c), 1.0, 1e-9);
  }
}

// Internal energy of LAW1: s:D work plus pressure work with the geometric volume change; the pressure part is a trapezoidal integral.
TEST(BrickEnergy, PressureWorkIsTrapezoidal) {
  SolidBody body(unit_cube(), one, without_viscosity());
  const int steps = 5;
  const double e = -0.2;
  drive(
      body, [e](const Vec3& x) { return e * x; }, steps);
  double expected = 0.0, v_old = 1.0;
  for (int i = 1; i <= steps; ++i) {
    const double v = std::pow(1 + e * i / steps, 3);
    expected -= 0.5 * (bulk * (1 / v_old - 1) + bulk * (1 / v - 1)) * (v - v_old);
    v_old = v;
  }
  EXPECT_NEAR(body.result.internal_energy, expected, 1e-12);
}

// The viscous pressure dissipates into internal energy: at constant rate, 1/2 (q_old + q) dV is included.
TEST(BrickEnergy, ViscosityIsInternalEnergy) {
  SolidSetup s;
  SolidBody body(unit_cube(), one, s), dry(unit_cube(), one, without_viscosity());
  for (SolidBody* b : {&body, &dry}) {
    b->set_velocity([](const Vec3& x) { return Vec3{-0.1 * x.x, 0, 0}; });
    b->step(0.0);
  }
  const double q0 = body.output().bulk_viscosity;
  body.advance(0.01);
  dry.advance(0.01);
  const double q1 = body.output().bulk_viscosity;
  EXPECT_NEAR(body.result.internal_energy - dry.result.internal_energy, 0.5 * (q0 + q1) * 0.001, 1e-15);
}

// LAW2 works with total stresses (1.6.1): sigma:D V h instead of p dV. In an elastic step the two rules differ by (V h tr D - dV) p.
TEST(BrickEnergy, Law2UsesTotalStress) {
  SolidSetup s1 = without_viscosity(), s2 = s1;
  s2.law = plastic(1e3);
  s2.profile.strain_increment = Profile::StrainIncrement::reference;  // tr D of the shape at the end
  const double e = 0.1;
  SolidBody b1(unit_cube(), one, s1), b2(unit_cube(), one, s2);
  for (SolidBody* b : {&b1, &b2})
    drive(
        *b, [e](const Vec3& x) { return e * x; }, 1);
  const double v = std::pow(1 + e, 3), p = bulk * (1 / v - 1);
  EXPECT_NEAR(b1.result.internal_energy, -0.5 * p * (v - 1), 1e-12);
  EXPECT_NEAR(b2.result.internal_energy, -0.5 * p * (3 * e / (1 + e)) * 0.5 * (1 + v), 1e-12);
}

// Small strain (Ismstr 1) with Iframe 2: density from the rate, rho_0 (1 - tr e), geometry of cycle 0; a small strain gives Hooke's law.
TEST(BrickSmallStrain, FrozenGeometry) {
  SolidSetup s = without_viscosity();
  s.property.ismstr = 1;
  s.property.iframe = 2;
  s.profile = Profile::reference();
  SolidBody body(unit_cube(), one, s);
  const double step = body.step(0.0).step;
  const double e = -0.1;
  drive(
      body,
      [e](const Vec3& x) {
        return Vec3{e * x.x, 0, 0};
      },
      1000);
  // Frozen gradients: tr D h = e/1000 (minus the second-order term 1/2 (e/1000)^2) in every step, without ln(1 + e).
  const double strain = 1000 * (e / 1000 - 0.5 * e * e / 1e6);
  EXPECT_NEAR(body.output().density, 7.8 * (1 - strain), 1e-12);
  EXPECT_NEAR(body.output().pressure, -bulk * strain, 1e-10);
  EXPECT_NEAR(body.result.step, step, 1e-3 * step);
  EXPECT_NEAR(body.output().stress[0], (bulk + 4 * shear / 3) * strain, 1e-10);
  EXPECT_NEAR(body.group->part_sums(body.v.data(), nullptr).mass, 7.8 * (1 - strain), 1e-12);
}

// Internal energy is the trapezoidal work of the nodal forces to rounding, also while the volume changes by tenths; the mean volume of
// the step (reference profile) leaves an error of the first order in the step.
TEST(BrickSmallStrain, EnergyIsTheWorkOfTheForces) {
  const auto error = [](const Profile& profile, int steps) {
    SolidSetup s = without_viscosity();
    s.property.ismstr = 1;
    s.property.h = 0.0;
    s.profile = profile;
    SolidBody body(unit_cube(), one, s);
    body.step(0.0);
    double work = 0.0, largest = 0.0;
    std::vector<Vec3> before(body.f.begin(), body.f.end());
    for (int n = 0; n < steps; ++n) {  // shortened by 30 % and back, three times
      const double rate = -0.15 * 6.283185307179586 * 3.0 * std::sin(6.283185307179586 * 3.0 * (n + 0.5) / steps);
      body.set_velocity([rate](const Vec3& x) { return Vec3{0, 0, rate * x.z}; });
      body.advance(1.0 / steps);
      for (std::size_t i = 0; i < 8; ++i) work += 0.5 / steps * dot(before[i] + body.f[i], body.v[i]);
      before.assign(body.f.begin(), body.f.end());
      largest = std::max(largest, work);
    }
    return std::abs(body.result.internal_energy - work) / largest;
  };
  EXPECT_LT(error(Profile::standard(), 60), 1e-13);
  const double coarse = error(Profile::reference(), 60), fine = error(Profile::reference(), 120);
  EXPECT_GT(coarse, 1e-4);
  EXPECT_NEAR(coarse / fine, 2.0, 0.5);
}

// ... and turns with the element: after a rigid turn of an unstrained element by 1 radian, loading gives the turned stress. (Once strained,
// a turn by theta adds a strain error of order strain x theta: the frozen gradients meet the velocities of the deformed shape.)
TEST(BrickSmallStrain, CorotationalFrameTurns) {
  SolidSetup s = without_viscosity();
  s.property.ismstr = 1;
  s.property.iframe = 2;
  SolidBody body(unit_cube(), one, s), still(unit_cube(), one, s);
  const Rotation r = rotation({0.3, 1, 0.2}, 0.01), all = rotation({0.3, 1, 0.2}, 1.0);
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 0; k < 8; ++k) body.v[k] = r * body.x[k] - body.x[k];
    body.advance(1.0);
  }
  EXPECT_NEAR(body.output().von_mises, 0.0, 1e-10);
  still.set_velocity([](const Vec3& x) { return Vec3{0.01 * x.x, 0, 0.005 * x.x}; });
  for (std::size_t k = 0; k < 8; ++k) body.v[k] = all * still.v[k];
  body.advance(1.0);
  still.advance(1.0);
  EXPECT_NEAR(body.output().von_mises, still.output().von_mises, 1e-10);
  EXPECT_NEAR(body.result.internal_energy, still.result.internal_energy, 1e-12);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_LT(norm(body.f[k] - all * still.f[k]), 1e-10);
}

}  // namespace
}  // namespace abut::elements::test
