// One-point brick: kinematics, forces, masses, objectivity (numerics.md 4.1 to 4.4, 1.4).
#include <gtest/gtest.h>

#include <numbers>

#include "solid_fixture.hpp"

namespace abut::elements::test {
namespace {

const std::vector<std::vector<Index>> one = {{0, 1, 2, 3, 4, 5, 6, 7}};

std::vector<Vec3> distorted_cube(Random& random, double amount) {
  auto x = unit_cube();
  for (Vec3& p : x) p += amount * random.vec();
  return x;
}

double largest(const std::vector<Vec3>& f) {
  double m = 0.0;
  for (const Vec3& a : f) m = std::max(m, norm(a));
  return m;
}

class BrickVariants : public ::testing::TestWithParam<std::tuple<int, int>> {
 protected:
  [[nodiscard]] SolidSetup setup() const {
    SolidSetup s;
    s.property.isolid = std::get<0>(GetParam());
    s.property.iframe = std::get<1>(GetParam());
    return s;
  }
};

// A translation strains nothing, whatever the shape.
TEST_P(BrickVariants, TranslationGivesNoForce) {
  Random random(1);
  SolidBody body(distorted_cube(random, 0.2), one, setup());
  body.set_velocity([](const Vec3&) { return Vec3{3.0, -2.0, 1.0}; });
  for (int i = 0; i < 10; ++i) body.advance(1e-3);
  EXPECT_LT(largest(body.f), 1e-11);
  EXPECT_NEAR(body.result.internal_energy, 0.0, 1e-13);
}

// The slots of an element hold a self-equilibrated system: no net force, and with a linear velocity field no net moment.
TEST_P(BrickVariants, ForcesAreInEquilibrium) {
  Random random(2);
  SolidBody body(distorted_cube(random, 0.2), one, setup());
  for (Vec3& v : body.v) v = random.vec();
  body.advance(1e-3);
  Vec3 sum;
  for (const Vec3& f : body.f) sum += f;
  EXPECT_LT(norm(sum), 1e-12 * largest(body.f));
}

// Stress of a homogeneous deformation does no hourglass work and balances moments: x cross f sums to zero.
TEST_P(BrickVariants, StressBalancesMoments) {
  Random random(3);
  SolidSetup s = setup();
  s.property.h = 0.0;
  SolidBody body(distorted_cube(random, 0.2), one, s);
  body.set_velocity([](const Vec3& x) { return Vec3{x.x + 2 * x.y, -x.z, x.x - x.y}; });
  body.advance(1e-2);
  Vec3 moment;
  for (std::size_t i = 0; i < 8; ++i) moment += cross(body.x[i], body.f[i]);
  EXPECT_LT(norm(moment), 1e-13 * largest(body.f));
  EXPECT_GT(largest(body.f), 0.01);
}

// Virtual work: sum f_I . w_I = V sigma : grad w for linear w (the definition f = V sigma P).
TEST_P(BrickVariants, ForcesAreWorkConjugate) {
  Random random(4);
  SolidSetup s = setup();
  s.property.h = 0.0;
  s.property.qa = s.property.qb = 0.0;
  SolidBody body(distorted_cube(random, 0.15), one, s);
  for (Vec3& v : body.v) v = random.vec();
  body.advance(1e-2);
  const ElementOutput out = body.output();
  const double sigma[3][3] = {{out.stress[0], out.stress[3], out.stress[5]},
                              {out.stress[3], out.stress[1], out.stress[4]},
                              {out.stress[5], out.stress[4], out.stress[2]}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double work = 0.0;  // w_i = x_j
      for (std::size_t k = 0; k < 8; ++k) work += body.f[k][i] * body.x[k][j];
      EXPECT_NEAR(work, out.volume * sigma[i][j], 1e-12 * 210.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrickVariants, ::testing::Combine(::testing::Values(1, 2), ::testing::Values(1, 2)));

// gamma of Isolid 1 sees no linear field on any shape: velocities that are linear in space make no hourglass energy. The reference profile
// leaves mode 4 as it is (its X vanishes when opposite faces are distorted alike), Isolid 2 all four.
TEST(BrickHourglass, AllModesAreOrthogonalToLinearFields) {
  Random random(7);
  for (const int iframe : {1, 2}) {
    for (const int ismstr : {1, 4}) {
      for (const auto& profile : {Profile::standard(), Profile::reference()}) {
        SolidSetup s;
        s.profile = profile;
        s.property.iframe = iframe;
        s.property.ismstr = ismstr;
        SolidBody body(distorted_cube(random, 0.2), one, s);
        body.set_velocity([](const Vec3& p) { return Vec3{p.x + 2 * p.y, 3 * p.z, p.x - p.y}; });
        body.step(1e-3);
        if (profile.hourglass_modes == Profile::HourglassModes::orthogonal) {
          EXPECT_LT(body.result.hourglass_energy, 1e-20) << iframe << ismstr;
        } else {
          EXPECT_GT(body.result.hourglass_energy, 1e-8) << iframe << ismstr;
        }
      }
    }
  }
}

TEST(BrickHourglass, WithoutProductsOfThreeCoordinatesThreeModesAreEnough) {
  auto x = unit_cube();
  // Taper in every direction: x (1 + 0.3 y), y (1 + 0.2 z), z (1 + 0.25 x) gives X1, X2, X3 != 0 but no product of three coordinates.
  for (Vec3& p : x) p = {p.x * (1 + 0.3 * (p.y - 0.5)), p.y * (1 + 0.2 * (p.z - 0.5)), p.z * (1 + 0.25 * (p.x - 0.5))};
  for (const int isolid : {1, 2}) {
    SolidSetup s;
    s.profile = Profile::reference();
    s.property.isolid = isolid;
    SolidBody body(x, one, s);
    body.set_velocity([](const Vec3& p) { return Vec3{p.x + 2 * p.y, 3 * p.z, p.x - p.y}; });
    body.step(1e-3);
    if (isolid == 1) {
      EXPECT_LT(body.result.hourglass_energy, 1e-20);
    } else {
      EXPECT_GT(body.result.hourglass_energy, 1e-8);
    }
  }
}

// Closed form 13 of numerics.md 9: mode Gamma^1 of amplitude 1 on a cube gives qdot = 8 and the force 8 c_l (1 + 25 h 8/c) per node.
TEST(BrickHourglass, ModeForceClosedForm) {
  const double pattern[8] = {1, -1, 1, -1, 1, -1, 1, -1};
  SolidSetup s;
  s.profile = Profile::reference();
  SolidBody body(unit_cube(), one, s);
  for (std::size_t i = 0; i < 8; ++i) body.v[i] = {0.0, 0.0, pattern[i]};
  const double dt = 1e-3;
  body.step(dt);
  const double bulk = 210.0 / (3 * 0.4), shear = 210.0 / 2.6, c = std::sqrt((bulk + 1.333 * shear) / 7.8);
  const double cl = 0.25 * 0.1 * 7.8 * c;
  const double force = 8 * cl * (1 + 25 * 0.1 * 8 / c);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(body.f[i].z, pattern[i] * force, 1e-12 * force);
  EXPECT_NEAR(body.result.hourglass_energy, dt * 8 * force, 1e-12 * force);
  // The trapezoidal rule starts from no force: half of it.
  s.profile = Profile::standard();
  SolidBody other(unit_cube(), one, s);
  other.v = body.v;
  other.step(dt);
  const double exact = std::sqrt((bulk + 4.0 / 3.0 * shear) / 7.8);
  const double standard_force = 8 * 0.025 * 7.8 * exact * (1 + 20 / exact);
  EXPECT_NEAR(other.result.hourglass_energy, 0.5 * dt * 8 * standard_force, 1e-12 * force);
}

// The quadratic viscosity takes the size of a mode's rate: forces on a turned element with turned velocities are the turned forces. The
// reference profile takes component by component, and they are not.
TEST(BrickHourglass, DoesNotKnowTheAxes) {
  const double pattern[8] = {1, -1, 1, -1, -1, 1, -1, 1};
  const Rotation r = rotation({1, 2, 3}, 0.7);
  for (const bool standard : {true, false}) {
    SolidSetup s;
    s.profile = standard ? Profile::standard() : Profile::reference();
    std::vector<Vec3> x = unit_cube(), turned = x;
    for (Vec3& p : turned) p = r * p;
    SolidBody body(x, one, s), other(turned, one, s);
    for (std::size_t i = 0; i < 8; ++i) {
      body.v[i] = {3.0 * pattern[i], -1.0 * pattern[7 - i], 0.5 * pattern[i]};
      other.v[i] = r * body.v[i];
    }
    body.step(1e-6);
    other.step(1e-6);
    double off = 0.0, size = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
      off = std::max(off, norm(other.f[i] - r * body.f[i]));
      size = std::max(size, norm(body.f[i]));
    }
    if (standard) {
      EXPECT_LT(off, 1e-13 * size);
    } else {
      EXPECT_GT(off, 1e-3 * size);
    }
  }
}

// Constant-strain patch test [Taylor Simo 1986]: in a distorted mesh under a linear field every element has the same stress and interior
// nodes are in equilibrium. Cell centres see the field exactly; faces stay unwarped? They do not: P and V are those of the centre, which
// tessellate exactly only when the distortion keeps faces plane, so the mesh is distorted by a map that is linear per coordinate plane.
TEST(BrickPatch, ConstantStrain) {
  for (const int iframe : {1, 2}) {
    Box box(3, 3, 3, {1, 1, 1});
    const double px[4] = {0, 0.8, 2.3, 3}, py[4] = {0, 1.2, 1.9, 3}, pz[4] = {0, 1.1, 2.2, 3};
    for (int k = 0; k <= 3; ++k)
      for (int j = 0; j <= 3; ++j)
        for (int i = 0; i <= 3; ++i) {
          // General plane-faced bricks: planes x = a + 0.15 b y, y, z (the x planes are tilted differently).
          const double tilt = 0.15 * (i == 1 ? 1.0 : (i == 2 ? -0.7 : 0.0));
          box.nodes[static_cast<std::size_t>(box.node(i, j, k))] = {px[i] + tilt * (py[j] - 1.5), py[j], pz[k]};
        }
    SolidSetup s;
    s.property.iframe = iframe;
    s.property.qa = s.property.qb = 0.0;
    SolidBody body(box.nodes, box.bricks, s);
    body.set_velocity([](const Vec3& x) { return Vec3{0.1 * x.x + 0.2 * x.y, -0.1 * x.y + 0.3 * x.z, 0.05 * x.z + 0.1 * x.x}; });
    body.advance(1e-3);
    const auto first = body.output(0).stress;
    for (Index e = 1; e < body.group->size(); ++e) {
      const auto other = body.output(e).stress;
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(other[i], first[i], 1e-13 * 210.0);
    }
    for (int k = 1; k < 3; ++k)
      for (int j = 1; j < 3; ++j)
        for (int i = 1; i < 3; ++i) EXPECT_LT(norm(body.f[static_cast<std::size_t>(box.node(i, j, k))]), 1e-14 * 210.0);
    EXPECT_LT(body.result.hourglass_energy, 1e-20);
  }
}

/// Change of the stress (relative) when a body under stress turns by one revolution in `steps` steps.
/// @param size  of the deviator at the end over that at the start
double stress_error_after_turn(int iframe, int steps, const Profile& profile, double* size_of_deviator = nullptr) {
  SolidSetup s;
  s.profile = profile;
  s.property.iframe = iframe;
  s.property.qa = s.property.qb = s.property.h = 0.0;
  SolidBody body(unit_cube(), one, s);
  const Vec3 axis = normalized(Vec3{1, 2, -1});
  body.set_velocity([](const Vec3& x) { return Vec3{x.x + x.y, -0.5 * x.y, 0.3 * x.x - 0.5 * x.z}; });
  body.advance(1e-2);
  const auto before = body.output().stress;
  const double von_mises = body.output().von_mises, h = 1e-3;
  const Rotation r = rotation(axis, 2 * std::numbers::pi / steps);
  for (int i = 0; i < steps; ++i) {
    for (std::size_t k = 0; k < 8; ++k) body.v[k] = (1.0 / h) * (r * body.x[k] - body.x[k]);
    body.advance(h);
  }
  const auto after = body.output().stress;
  if (size_of_deviator != nullptr) *size_of_deviator = body.output().von_mises / von_mises;
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    error = std::max(error, std::abs(after[i] - before[i]));
    size = std::max(size, std::abs(before[i]));
  }
  return error / size;
}

TEST(BrickObjectivity, CorotationalIsExact) {
  // D of Iframe 2 is sym L - h/2 L^T L = 0 for x^n = R x^(n-1): L = (1 - R^T)/h.
  EXPECT_LT(stress_error_after_turn(2, 100, Profile::standard()), 1e-11);
}

// Iframe 1 turns the stress by a rotation [Hughes Winget 1980]: its size stays to rounding, its direction to fourth order of the turn per
// step (t^4/8 per radian in angle, twice that in stress). To first order it grows by a share of the order 1/N per turn.
TEST(BrickObjectivity, StressTurnsByARotation) {
  double size;
  EXPECT_LT(stress_error_after_turn(1, 1000, Profile::standard(), &size), 1e-8);
  EXPECT_NEAR(size, 1.0, 1e-11);
  EXPECT_LT(stress_error_after_turn(1, 50, Profile::standard(), &size), 4e-4);
  EXPECT_NEAR(size, 1.0, 1e-11);
  Profile first_order;
  first_order.stress_rotation = Profile::StressRotation::first_order;
  double coarse, fine;
  stress_error_after_turn(1, 2000, first_order, &coarse);
  stress_error_after_turn(1, 4000, first_order, &fine);
  EXPECT_GT(coarse, 1.005);
  EXPECT_NEAR((coarse - 1.0) / (fine - 1.0), 2.0, 0.05);
}

// The stress in global axes of a body that is turned rigidly in one go after loading is R sigma R^T.
TEST(BrickObjectivity, OutputStressTurnsWithTheBody) {
  SolidSetup s;
  s.property.iframe = 2;
  SolidBody body(unit_cube(), one, s), turned(unit_cube(), one, s);
  const Rotation r = rotation({1, 1, 0.3}, 0.7);
  for (Vec3& p : turned.x) p = r * p;
  SolidBody reference(turned.x, one, s);
  const auto field = [](const Vec3& x) { return Vec3{x.x + x.y, -0.5 * x.y, 0.3 * x.x - 0.5 * x.z}; };
  body.set_velocity(field);
  for (std::size_t k = 0; k < 8; ++k) reference.v[k] = r * body.v[k];
  body.advance(1e-2);
  reference.advance(1e-2);
  const auto a = body.output().stress, b = reference.output().stress;
  const double sa[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
  const double sb[3][3] = {{b[0], b[3], b[5]}, {b[3], b[1], b[4]}, {b[5], b[4], b[2]}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double expected = 0.0;
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) expected += r.rows[static_cast<std::size_t>(i)][p] * sa[p][q] * r.rows[static_cast<std::size_t>(j)][q];
      EXPECT_NEAR(sb[i][j], expected, 1e-11);
    }
  for (std::size_t k = 0; k < 8; ++k) EXPECT_LT(norm(reference.f[k] - r * body.f[k]), 1e-11);
}

// Masses: rho V/8 per slot, repeated nodes of a wedge or a tetrahedron take several shares; V is the centre-Jacobian volume.
TEST(BrickMass, SharesOfDegenerateForms) {
  SolidSetup s;
  SolidBody cube(unit_cube(), one, s);
  for (const double m : cube.m) EXPECT_DOUBLE_EQ(m, 7.8 / 8);
  const auto x = unit_cube();
  SolidBody wedge({x[0], x[1], x[2], x[4], x[5], x[6]}, {{0, 1, 2, 2, 3, 4, 5, 5}}, s);
  EXPECT_NEAR(wedge.group->element_mass(0), 7.8 / 2, 1e-14);
  EXPECT_NEAR(wedge.m[2], 2 * wedge.m[0], 1e-15);
  SolidBody tetra({x[0], x[1], x[2], x[5]}, {{0, 1, 2, 2, 3, 3, 3, 3}}, s);
  double total = 0.0;
  for (const double m : tetra.m) total += m;
  EXPECT_NEAR(total, tetra.group->element_mass(0), 1e-15);
  EXPECT_GT(total, 0.0);
}

// A wedge and a tetrahedron given as 8 nodes stress like any element under a homogeneous field.
TEST(BrickDegenerate, HomogeneousFieldGivesTheBrickStress) {
  const auto x = unit_cube();
  SolidSetup s;
  s.property.qa = s.property.qb = 0.0;
  const auto field = [](const Vec3& p) { return Vec3{p.x + p.y, -0.5 * p.y, 0.3 * p.x - 0.5 * p.z}; };
  SolidBody cube(x, one, s), wedge({x[0], x[1], x[2], x[4], x[5], x[6]}, {{0, 1, 2, 2, 3, 4, 5, 5}}, s);
  SolidBody tetra({x[0], x[1], x[2], x[5]}, {{0, 1, 2, 2, 3, 3, 3, 3}}, s);
  for (SolidBody* body : {&cube, &wedge, &tetra}) {
    body->set_velocity(field);
    body->advance(1e-3);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(body->output().stress[i], cube.output().stress[i], 1e-12);
    EXPECT_EQ(body->result.bad_element, no_index);
  }
}

// Left-handed numbering is turned, not reported; an element that folds through itself is reported, with finite forces.
TEST(BrickVolume, NegativeIsReported) {
  SolidSetup s;
  SolidBody left(unit_cube(), {{4, 5, 6, 7, 0, 1, 2, 3}}, s);
  EXPECT_EQ(left.step(0.0).bad_element, no_index);
  EXPECT_NEAR(left.group->element_mass(0), 7.8, 1e-14);

  Box box(3, 1, 1, {1, 1, 1});
  SolidBody body(box.nodes, box.bricks, s);
  body.step(0.0);
  for (int j = 0; j <= 1; ++j)
    for (int k = 0; k <= 1; ++k) body.x[static_cast<std::size_t>(box.node(2, j, k))].x = 0.5;
  EXPECT_EQ(body.step(1e-3).bad_element, 1);
  for (const Vec3& f : body.f) EXPECT_TRUE(std::isfinite(norm(f)));
}

TEST(BrickVolume, NanIsReported) {
  for (const auto& profile : {Profile::standard(), Profile::reference()}) {
    SolidSetup s;
    s.profile = profile;
    Box box(9, 1, 1, {1, 1, 1});
    SolidBody body(box.nodes, box.bricks, s);
    body.step(0.0);
    body.v[static_cast<std::size_t>(box.node(9, 0, 0))].x = std::nan("");
    EXPECT_EQ(body.advance(1e-3).bad_element, 8);
  }
}

}  // namespace
}  // namespace abut::elements::test
