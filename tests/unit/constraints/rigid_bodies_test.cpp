#include "constraints/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "constraints/body_frequency.hpp"
#include "constraints/rotation.hpp"
#include "unit/constraints/bodies.hpp"

namespace abut::constraints::test {
namespace {

/// Inertia of point masses about c from its definition.
Symmetric points_inertia(const state::State& s, const std::vector<std::size_t>& nodes, const std::vector<double>& mass, const Vec3& c) {
  Symmetric j{};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 r = s.x[nodes[k]] - c;
    const double m = mass[k];
    j[0] += m * (squared_norm(r) - r.x * r.x);
    j[1] += m * (squared_norm(r) - r.y * r.y);
    j[2] += m * (squared_norm(r) - r.z * r.z);
    j[3] -= m * r.x * r.y;
    j[4] -= m * r.y * r.z;
    j[5] -= m * r.z * r.x;
  }
  return j;
}

void expect_tensor(const RigidBodies& bodies, const Symmetric& j, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    Vec3 e{};
    e[k] = 1.0;
    EXPECT_LT(norm(bodies.times_inertia(0, e) - times(j, e)), tolerance) << k;
  }
}

TEST(Rotation, SeriesMatchesSineAndCosine) {
  for (const double t : {1e-9, 1e-3, 0.3, 1.0}) {
    const Vec3 r = rotated({1, 0, 0.5}, {0, 0, t});
    EXPECT_NEAR(r.x, std::cos(t), 4e-16);
    EXPECT_NEAR(r.y, std::sin(t), 4e-16);
    EXPECT_EQ(r.z, 0.5);
  }
}

TEST(Rotation, DiagonalisesToAxesThatRebuildTheTensor) {
  const Symmetric a{2, 5, 3, 0.4, -0.7, 1.1};
  std::array<double, 3> values{};
  std::array<Vec3, 3> axes{};
  diagonalise(a, values, axes);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(times(a, axes[k]) - values[k] * axes[k]), 1e-14);
  EXPECT_LT(norm(cross(axes[0], axes[1]) - axes[2]), 1e-15);
}

// numerics.md 6.2.1: ICoG 1 to 4. Masses are point masses, the card adds mass 2 to the main node.
// ICoG 3 leaves the main node where it is; the tensor is then about the centre of gravity, in the reference profile about the node.
TEST(RigidBody, MassCentreAndInertiaForEveryICoG) {
  for (int icog = 1; icog <= 5; ++icog) {
    const bool reference = icog == 5;
    auto m = body_of_points(reference ? 3 : icog);
    m.rigid_bodies[0].mass = 2.0;
    m.rigid_bodies[0].j_diagonal = {0.1, 0.2, 0.3};
    m.rigid_bodies[0].j_off = {0.01, 0.02, 0.03};
    Rig rig(m, 1.0, 0.0, reference ? Profile::reference() : Profile::standard());
    set_masses(rig.s);
    rig.s.inertia[0] = 0.05;
    rig.s.inertia[3] = 0.02;
    const state::State before = rig.s;
    const std::vector<std::size_t> all{1, 2, 3, 4, 5};
    double secondary = 0.0;
    Vec3 moment{};
    for (const std::size_t i : all) {
      secondary += before.mass[i];
      moment += before.mass[i] * before.x[i];
    }
    const double m0 = 2.5;
    rig.start();
    Vec3 centre = cloud[0];
    if (icog == 1) centre = (m0 * cloud[0] + moment) / (m0 + secondary);
    if (icog == 2) centre = moment / secondary;
    EXPECT_LT(norm(rig.s.x[0] - centre), 1e-15) << icog;
    EXPECT_NEAR(rig.s.mass[0], icog == 4 ? m0 : m0 + secondary, 1e-14);
    std::vector<double> masses;
    for (const std::size_t i : all) masses.push_back(icog == 4 ? 0.0 : before.mass[i]);
    if (icog == 3) centre = (m0 * cloud[0] + moment) / (m0 + secondary);
    Symmetric j = points_inertia(before, all, masses, centre);
    if (icog == 1 || icog == 3) {
      const Symmetric own = points_inertia(before, {0}, {m0}, centre);
      for (std::size_t k = 0; k < 6; ++k) j[k] += own[k];
    }
    const double nodal = 0.05 + (icog == 4 ? 0.0 : 0.02);
    const Symmetric given{0.1 + nodal, 0.2 + nodal, 0.3 + nodal, 0.01, 0.02, 0.03};
    for (std::size_t k = 0; k < 6; ++k) j[k] += given[k];
    expect_tensor(rig.bodies, j, 1e-13);
    const auto& principal = rig.bodies.inertia(0).principal;
    EXPECT_EQ(rig.s.inertia[0], std::min({principal[0], principal[1], principal[2]}));
  }
}

TEST(RigidBody, InertiaOfTheCardIsGivenInItsSkew) {
  auto m = nodes_at({{0, 0, 0}});
  m.skews.push_back({.id = 1, .axes = {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}});
  m.rigid_bodies.push_back(card(1, 0, {}, 3));
  m.rigid_bodies[0].skew = 0;
  m.rigid_bodies[0].j_diagonal = {1, 2, 3};
  Rig rig(m);
  rig.start();
  expect_tensor(rig.bodies, {3, 1, 2, 0, 0, 0}, 1e-15);
}

TEST(RigidBody, SphericalAndCorrectedInertia) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}});
  for (int ispher = 1; ispher <= 3; ++ispher) {
    m.rigid_bodies = {card(1, 0, {1, 2}, ispher)};
    Rig rig(m);
    rig.start();
    // A stick of two unit masses: 0, 2, 2.
    const Symmetric expected = ispher == 1   ? Symmetric{4.0 / 3, 4.0 / 3, 4.0 / 3, 0, 0, 0}
                               : ispher == 2 ? Symmetric{0.2, 2, 2, 0, 0, 0}
                                             : Symmetric{0, 2, 2, 0, 0, 0};
    expect_tensor(rig.bodies, expected, 1e-15);
  }
}

TEST(RigidBody, SecondaryVelocitiesStartRigid) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.s.v[0] = {1, 2, 3};
  rig.s.w[0] = {0.1, -0.2, 0.3};
  rig.s.v[2] = {99, 99, 99};
  rig.start();
  EXPECT_EQ(rig.s.v[0], (Vec3{1, 2, 3}));
  EXPECT_LT(norm(rig.s.v[2] - (rig.s.v[0] + cross(rig.s.w[0], rig.s.x[2] - rig.s.x[0]))), 1e-15);
  EXPECT_EQ(rig.s.w[2], rig.s.w[0]);
}

// A free body: momentum, energy and the size of the angular momentum are invariants of the scheme (to rounding) for steps that
// change by a factor of three from cycle to cycle, the half kick of cycle 0 included; distances do not drift, and the correction of 1.6.2
// turns nodal sums into (1/2) M v^2 + (1/2) w.Jw.
TEST(RigidBody, FreeSpinKeepsEnergyMomentumAndShape) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.s.v[0] = {0.3, -0.1, 0.2};
  rig.s.w[0] = {2.0, 1.0, -1.5};
  rig.start();
  const double d12 = norm(rig.s.x[1] - rig.s.x[2]), d03 = norm(rig.s.x[0] - rig.s.x[3]);
  const double l0 = norm(angular_momentum(rig)), e0 = rig.baseline;
  const double rotation = 0.5 * dot(rig.s.w[0], angular_momentum(rig));
  for (int n = 0; n < 20000; ++n) {
    rig.step(0.005 * uneven(n));
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-9 * e0);
  }
  EXPECT_NEAR(norm(angular_momentum(rig)) / l0, 1.0, 1e-11);
  EXPECT_NEAR(0.5 * dot(rig.s.w[0], angular_momentum(rig)) / rotation, 1.0, 1e-11);
  EXPECT_NEAR(norm(rig.s.x[1] - rig.s.x[2]), d12, 1e-10);
  EXPECT_NEAR(norm(rig.s.x[0] - rig.s.x[3]), d03, 1e-10);
  EXPECT_LT(norm(rig.s.v[0] - Vec3{0.3, -0.1, 0.2}), 1e-13);
  EXPECT_LT(std::fabs(rig.work_bodies), 1e-4 * e0);
}

/// Torque-free Euler equations in body axes and attitude, integrated by Runge-Kutta: angular velocity in space at time t.
struct Gyroscope {
  std::array<double, 3> j;
  Frame axes;
  Vec3 w;  ///< body components
  struct Rate {
    Vec3 w;
    Frame axes;
  };
  [[nodiscard]] Vec3 space(const Vec3& c) const { return c.x * axes[0] + c.y * axes[1] + c.z * axes[2]; }
  [[nodiscard]] Rate rate() const {
    const Vec3 dw{(j[1] - j[2]) * w.y * w.z / j[0], (j[2] - j[0]) * w.z * w.x / j[1], (j[0] - j[1]) * w.x * w.y / j[2]};
    const Vec3 s = space(w);
    return {dw, {cross(s, axes[0]), cross(s, axes[1]), cross(s, axes[2])}};
  }
  [[nodiscard]] Gyroscope moved(const Rate& r, double h) const {
    Gyroscope g = *this;
    g.w += h * r.w;
    for (std::size_t k = 0; k < 3; ++k) g.axes[k] += h * r.axes[k];
    return g;
  }
  void advance(double h) {
    const Rate k1 = rate(), k2 = moved(k1, h / 2).rate(), k3 = moved(k2, h / 2).rate(), k4 = moved(k3, h).rate();
    *this = moved(k1, h / 6).moved(k2, h / 3).moved(k3, h / 3).moved(k4, h / 6);
  }
};

double precession_error(double h, Profile profile, bool even = true) {
  Rig rig(body_of_points(), 1.0, 0.0, profile);
  set_masses(rig.s);
  rig.s.w[0] = {0.4, 2.0, -0.3};
  rig.start();
  const auto& inertia = rig.bodies.inertia(0);
  Gyroscope exact{inertia.principal,
                  inertia.axes,
                  {dot(inertia.axes[0], rig.s.w[0]), dot(inertia.axes[1], rig.s.w[0]), dot(inertia.axes[2], rig.s.w[0])}};
  const Vec3 arm = rig.s.x[3] - rig.s.x[0];
  const Vec3 local{dot(exact.axes[0], arm), dot(exact.axes[1], arm), dot(exact.axes[2], arm)};
  const int steps = static_cast<int>(std::lround(6.0 / h));
  double worst = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double step = even ? h : h * uneven(n);
    rig.step(step);
    for (int k = 0; k < 4; ++k) exact.advance(step / 4);
    worst = std::max(worst, norm(rig.s.x[3] - rig.s.x[0] - exact.space(local)));
  }
  return worst;
}

// Torque-free precession of an asymmetric body against Euler's equations: second order in h.
TEST(RigidBody, PrecessionConvergesToEulersEquations) {
  const double coarse = precession_error(0.02, Profile::standard());
  const double fine = precession_error(0.01, Profile::standard());
  const double finest = precession_error(0.005, Profile::standard());
  EXPECT_LT(finest, 2e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_NEAR(fine / finest, 4.0, 0.4);
}

// The gyroscopic moment at the middle of the kick is of second order for uneven steps too.
TEST(RigidBody, PrecessionConvergesWithUnevenSteps) {
  const double fine = precession_error(0.01, Profile::standard(), false);
  const double finest = precession_error(0.005, Profile::standard(), false);
  EXPECT_LT(finest, 2e-4);
  EXPECT_GT(fine / finest, 3.5);
}

TEST(RigidBody, ReferenceRulesConvergeToEulersEquationsToo) {
  const double fine = precession_error(0.0025, Profile::reference());
  const double finest = precession_error(0.00125, Profile::reference());
  EXPECT_LT(finest, fine);
  EXPECT_LT(finest, 0.02);
  EXPECT_LT(precession_error(0.0025, Profile::standard()), 0.1 * fine);
}

// Forces on secondary nodes give the body the acceleration F/M and the angular acceleration of T = sum r x f about its centre.
TEST(RigidBody, GathersForcesMomentsAndStiffness) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.start();
  const Vec3 f1{1, -2, 0.5}, f4{0.3, 0.7, -1};
  const Vec3 t = cross(rig.s.x[1] - rig.s.x[0], f1) + cross(rig.s.x[4] - rig.s.x[0], f4);
  rig.s.f[1] = f1;
  rig.s.f[4] = f4;
  rig.s.stiffness[4] = 10.0;
  rig.s.rotational_stiffness[4] = 3.0;
  rig.bodies.gather(rig.s, rig.conditions);
  EXPECT_LT(norm(rig.s.f[0] - f1 - f4), 1e-15);
  BodySprings springs;
  springs.add(rig.s.x[4] - rig.s.x[0], 10.0, 3.0);
  const double about_all_axes = (3.0 + 10.0 * squared_norm(rig.s.x[4] - rig.s.x[0])) / rig.s.inertia[0];
  const double rate = std::max(largest_rate(springs, rig.s.mass[0], rig.bodies.inertia(0)), about_all_axes);
  EXPECT_NEAR(rig.s.stiffness[0], rate * rig.s.mass[0], 1e-13);
  EXPECT_NEAR(rig.s.rotational_stiffness[0], rate * rig.s.inertia[0], 1e-13);
  EXPECT_EQ(rig.s.stiffness[4], 0.0);
  rig.bodies.accelerate(rig.s, rig.conditions);
  EXPECT_LT(norm(rig.bodies.times_inertia(0, rig.s.alpha[0]) - t), 1e-14);
  EXPECT_LT(norm(rig.bodies.results()[0].moment - t), 1e-15);
  EXPECT_EQ(rig.bodies.results()[0].force, f1 + f4);
}

// Work of forces on secondary nodes becomes kinetic energy of the body; the ledger closes with loads, gravity and changing steps.
TEST(RigidBody, LedgerClosesUnderLoads) {
  auto m = body_of_points();
  m.gravities.push_back({.id = 1, .direction = 2, .scale_y = -9.81, .nodes = {0, 1, 2, 3, 4, 5}});
  m.concentrated_loads.push_back({.id = 1, .direction = 1, .scale_y = 3.0, .nodes = {2, 0}});
  m.concentrated_loads.push_back({.id = 2, .direction = 3, .scale_y = 0.4, .nodes = {0, 4}});
  for (const Profile& profile : {Profile::standard(), Profile::reference()}) {
    Rig rig(m, 1.0, 0.01, profile);
    set_masses(rig.s);
    rig.s.w[0] = {0.5, 0.2, 1.0};
    rig.forces = [](state::State& s) { s.f_contact[3] = -20.0 * s.u[3]; };
    rig.start();
    for (int n = 0; n < 400; ++n) {
      rig.step(0.002 * (1.0 + 0.5 * std::sin(1.3 * n)));
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-12 * std::max(1.0, rig.kinetic)) << n;
    }
    EXPECT_GT(rig.kinetic, 10.0);
    EXPECT_LT(std::fabs(rig.work_bodies), 1e-2 * rig.kinetic);
  }
}

// What the bodies' numerics make or lose falls with the square of the step.
TEST(RigidBody, NumericalWorkIsOfSecondOrder) {
  const auto run = [](double h) {
    auto m = body_of_points();
    m.concentrated_loads.push_back({.id = 1, .direction = 1, .scale_y = 3.0, .nodes = {2}});
    Rig rig(m);
    set_masses(rig.s);
    rig.s.w[0] = {0.5, 0.2, 1.0};
    rig.start();
    const int steps = static_cast<int>(std::lround(4.0 / h));
    for (int n = 0; n < steps; ++n) rig.step(h);
    return std::fabs(rig.work_bodies);
  };
  const double coarse = run(0.02), fine = run(0.01);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);
}

// A heavy node at a distance from a held main node: imposed rotation, as in a centrifuge. Steady rotation at constant speed;
// the work of starting it is (1/2) J w^2, in the reference's booking of cycle 0 and 1 as well.
TEST(RigidBody, ImposedRotationOfTheMainNode) {
  for (const Profile& profile : {Profile::standard(), Profile::reference()}) {
    auto m = nodes_at({{0, 0, 0}, {1, 0, 0}});
    m.rigid_bodies.push_back(card(1, 0, {1}, 1));
    m.rigid_bodies[0].j_diagonal = {1, 1, 1};
    m.boundary_conditions.push_back({.id = 1, .translation = {true, true, true}, .nodes = {0, 1}});
    m.imposed_motions.push_back({.id = 1, .direction = 5, .scale_y = 2.0, .nodes = {0}});
    Rig rig(m, 0.0, 0.0, profile);  // massless: inertia of the card alone
    rig.start();
    const double h = 1e-3;
    const int steps = 1000;
    for (int n = 0; n < steps; ++n) rig.step(h);
    EXPECT_NEAR(rig.s.w[0].z, 2.0, 1e-14);
    EXPECT_NEAR(rig.external, 2.0, 1e-12);
    EXPECT_NEAR(rig.work_motions, 2.0, 1e-12);
    EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
    EXPECT_NEAR(rig.bodies.results()[0].rotation.z, 2.0 * (steps - 1) * h, 1e-12);
    const double radius = norm(rig.s.x[1]);
    if (profile.rigid_body == Profile::RigidBody::conserving) {
      EXPECT_NEAR(radius, 1.0, 1e-12);
      EXPECT_NEAR(std::atan2(rig.s.x[1].y, rig.s.x[1].x), 2.0 * steps * h, 1e-12);
    } else {
      // The reference's two-node rule draws the node inwards by (w h)^2 / 2 per step from the second on.
      EXPECT_NEAR(std::log(radius), -0.5 * 4.0 * h * h * (steps - 1), 1e-7);
    }
  }
}

// A free body whose rotation about z is imposed gets no torque about x and y: these components of its angular momentum stay, to second
// order in the step, and the work of the motion is the rotational energy.
TEST(RigidBody, ImposedRotationLeavesTheOtherAxesFree) {
  const auto run = [](double h) {
    auto m = body_of_points();
    const Index f = add_function(m, {0.0, 1.0}, {0.0, 2.0});
    m.imposed_motions.push_back({.id = 1, .function = f, .direction = 5, .nodes = {0}});
    Rig rig(m);
    set_masses(rig.s);
    rig.s.w[0] = {0.3, -0.2, 0};
    rig.start();
    const Vec3 before = angular_momentum(rig);
    const double energy = 0.5 * dot(rig.s.w[0], before);
    const int steps = static_cast<int>(std::lround(1.0 / h));
    for (int n = 0; n < steps; ++n) rig.step(h);
    EXPECT_NEAR(rig.s.w[0].z, 2.0 * (rig.s.times.t - 0.5 * h), 1e-12);
    EXPECT_NEAR(rig.ledger(), 0.0, 1e-11);
    const Vec3 after = rotated(angular_momentum(rig), 0.5 * h * rig.s.w[0]);  // the axes at the time of w
    const Vec3 change = after - before;
    const double gained = 0.5 * dot(rig.s.w[0], after) - energy;
    return std::pair{std::hypot(change.x, change.y) / norm(before), std::fabs(gained / rig.work_motions - 1.0)};
  };
  const auto [coarse, work_coarse] = run(0.01);
  const auto [fine, work_fine] = run(0.005);
  std::printf("[found] angular momentum about the free axes off by %.2e and %.2e at half the step, work by %.2e and %.2e\n", coarse, fine,
              work_coarse, work_fine);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);
  EXPECT_LT(work_fine, 0.01);
}

// Rotational conditions of the main node reduce Euler's equations: a body that may turn about z only needs e_z.J e_z.
TEST(RigidBody, HeldRotationsReduceTheSystem) {
  auto m = body_of_points();
  m.boundary_conditions.push_back({.id = 1, .translation = {true, true, true}, .rotation = {true, true, false}, .nodes = {0}});
  m.concentrated_loads.push_back({.id = 1, .direction = 5, .scale_y = 0.7, .nodes = {0}});
  Rig rig(m);
  set_masses(rig.s);
  rig.start();
  const double jz = dot(Vec3{0, 0, 1}, rig.bodies.times_inertia(0, {0, 0, 1}));
  for (int n = 0; n < 100; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.s.w[0].z, 0.7 / jz * 0.995, 1e-12);
  EXPECT_EQ(rig.s.w[0].x, 0.0);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

TEST(RigidBody, EnergyCorrectionLeavesTheBodysOwnEnergy) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.s.v[0] = {1, 2, 3};
  rig.s.w[0] = {0.5, -1, 2};
  rig.start();
  rig.step(0.0001);
  double translation = 0.0, rotation = 0.0, mass = 0.0;
  Vec3 momentum{};
  const double total = rig.s.mass[0];
  // Sums at the start of the next cycle with a = 0: v^n = v.
  for (auto* field : {&rig.s.a, &rig.s.alpha}) field->assign(6, Vec3{});
  for (std::size_t i = 0; i < 6; ++i) {
    translation += 0.5 * rig.s.mass[i] * squared_norm(rig.s.v[i]);
    rotation += 0.5 * rig.s.inertia[i] * squared_norm(rig.s.w[i]);
    mass += rig.s.mass[i];
    momentum += rig.s.mass[i] * rig.s.v[i];
  }
  const EnergyCorrection c = rig.bodies.energy_correction(rig.s);
  EXPECT_NEAR(translation + c.translation, 0.5 * total * 14.0, 1e-12);
  EXPECT_NEAR(rotation + c.rotation, 0.5 * dot(rig.s.w[0], angular_momentum(rig)), 1e-12);
  EXPECT_NEAR(mass + c.mass, total, 1e-13);
  EXPECT_LT(norm(momentum + c.momentum - total * rig.s.v[0]), 1e-12);
}

TEST(RigidBody, ContainsElementsOfOneBodyOnly) {
  auto m = nodes_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}});
  m.rigid_bodies = {card(1, 0, {1, 2}), card(2, 3, {4}), card(3, 5, {})};
  m.rigid_bodies[2].active = false;
  const RigidBodies bodies(m);
  EXPECT_TRUE(bodies.contains(std::vector<Index>{0, 1, 2}));
  EXPECT_TRUE(bodies.contains(std::vector<Index>{1, 2}));
  EXPECT_FALSE(bodies.contains(std::vector<Index>{1, 4}));
  EXPECT_FALSE(bodies.contains(std::vector<Index>{1, 5}));
  EXPECT_FALSE(bodies.contains(std::vector<Index>{5}));
  EXPECT_EQ(bodies.body_of(4), 1);
  EXPECT_EQ(bodies.main_of(3), 1);
  EXPECT_EQ(bodies.main_of(5), no_index);
}

TEST(RigidBody, RefusesToTurnMoreThanARadianPerStep) {
  Rig rig(body_of_points());
  set_masses(rig.s);
  rig.s.w[0] = {0, 0, 11};
  rig.start();
  EXPECT_THROW(rig.step(0.1), RunError);
}

// A sensor makes free nodes a body: a plastic impact that keeps momentum and angular momentum; what it takes is booked.
TEST(RigidBody, SensorSwitchesOnAndOff) {
  auto m = body_of_points();
  m.sensors.push_back({1, 0.095, 0.195});
  m.rigid_bodies[0].sensor = 0;
  m.rigid_bodies[0].mass = 100.0;  // ignored with a sensor
  Rig rig(m, 1.0, 0.2);
  rig.s.v[1] = {0, 1, 0};
  rig.s.v[3] = {0.5, 0, -1};
  rig.s.w[2] = {0, 0, 1};
  rig.start();
  const auto momentum = [&](bool body) {
    Vec3 p{};
    for (std::size_t i = 0; i < (body ? 1U : 6U); ++i) p += rig.s.mass[i] * rig.s.v[i];
    return p;
  };
  const Vec3 before = momentum(false);
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  EXPECT_EQ(rig.bodies.body_of(3), no_index);
  const double free = rig.kinetic;
  rig.step(0.01);
  EXPECT_EQ(rig.bodies.body_of(3), 0);
  EXPECT_EQ(rig.s.mass[0], 6.0);
  EXPECT_LT(norm(momentum(true) - rig.s.mass[0] * rig.bodies.relative_velocity(0) - before), 1e-14);
  EXPECT_LT(rig.kinetic, free);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
  for (int n = 0; n < 20; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-12) << n;
  }
  EXPECT_EQ(rig.bodies.body_of(3), no_index);
  EXPECT_EQ(rig.s.mass[0], 1.0);
}

}  // namespace
}  // namespace abut::constraints::test
