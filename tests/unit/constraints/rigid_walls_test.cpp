#include "constraints/rigid_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "unit/constraints/rig.hpp"

namespace abut::constraints::test {
namespace {

/// A node above the plane z = 0, wall over all nodes but its main node.
model::Model above_a_wall(std::vector<Vec3> x, int slide = 0, double friction = 0.0) {
  auto m = nodes_at(x);
  model::RigidWall wall;
  wall.id = 1;
  wall.slide = slide;
  wall.friction = friction;
  wall.normal = {0, 0, 1};
  for (Index i = 0; i < m.node_count(); ++i) wall.nodes.push_back(i);
  m.rigid_walls.push_back(wall);
  return m;
}

// numerics.md 9, item 11: a ball of mass m at normal speed v0: impulse -m v0 N, the node stops, work -(1/2) m v0^2 once the
// reference's booking (h_- / h_bar) meets a constant step. The node stops before it crosses.
TEST(RigidWall, StopsANodeBeforeItCrosses) {
  Rig rig(above_a_wall({{0, 0, 0.095}}), 2.0);
  rig.s.v[0] = {0.5, 0, -3};
  rig.start();
  for (int n = 0; n < 20; ++n) {
    rig.step(0.01);
    ASSERT_GE(rig.s.x[0].z, 0.0);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-13);
  }
  EXPECT_LT(rig.s.x[0].z, 3.0 * 0.01);  // residual distance between 0 and |v_n| h
  EXPECT_EQ(rig.s.v[0].z, 0.0);
  EXPECT_EQ(rig.s.v[0].x, 0.5);
  const WallSums& sums = rig.walls.results()[0];
  EXPECT_NEAR(sums.normal_impulse.z, -6.0, 1e-14);
  EXPECT_EQ(norm(sums.tangential_impulse), 0.0);
  EXPECT_NEAR(rig.external, -9.0, 1e-14);
  EXPECT_NEAR(rig.work_walls, -9.0, 1e-14);
}

// A node that a spring pushes is stopped: the spring's energy by the trapezoidal rule, which counts the force over the whole step to the
// stop, and the kinetic energy balance with the wall's work and what it stops of the force's, at any step.
TEST(RigidWall, StopsANodeUnderForceWithABalance) {
  for (const int slide : {0, 1, 2}) {
    for (const double h : {0.01, 0.0025}) {
      Rig rig(above_a_wall({{0, 0, 0.1}}, slide, 0.3), 2.0);
      rig.s.v[0] = {0.5, 0, -3};
      const Vec3 rest{0, 0, 0.1};
      const double k = 900.0;
      double stored = 0.0;
      Vec3 last{};
      rig.forces = [&](state::State& s) {
        const Vec3 force = -k * (s.x[0] - rest);
        stored -= 0.5 * s.times.h_minus * dot(last + force, s.v[0]);
        s.f_contact[0] = last = force;
      };
      rig.start();
      double largest_stop = 0.0;
      for (int n = 0; n < static_cast<int>(0.6 / h); ++n) {
        rig.step(h);
        ASSERT_NEAR(rig.ledger(), 0.0, 1e-12);
        ASSERT_NEAR(rig.kinetic + stored - rig.work_walls - rig.work_stops, rig.baseline, 1e-12) << slide << " " << n;
        largest_stop = std::max(largest_stop, std::abs(rig.work_stops));
      }
      EXPECT_GT(largest_stop, 10.0 * h);  // of first order in the step
    }
  }
}

TEST(RigidWall, LetsANodeGoThatMovesAway) {
  Rig rig(above_a_wall({{0, 0, 0.001}}, 1));
  rig.s.v[0] = {0, 0, -1};
  rig.forces = [](state::State& s) { s.f_contact[0] = {0, 0, s.times.t > 0.05 ? 2.0 : 0.0}; };
  rig.start();
  for (int n = 0; n < 20; ++n) rig.step(0.01);
  EXPECT_GT(rig.s.v[0].z, 0.2);
  EXPECT_EQ(rig.walls.in_contact(0), 0);
}

TEST(RigidWall, TiedStopsTangentialMotionToo) {
  Rig rig(above_a_wall({{0, 0, 0.005}}, 1), 2.0);
  rig.s.v[0] = {4, 0, -1};
  rig.start();
  for (int n = 0; n < 5; ++n) rig.step(0.01);
  EXPECT_EQ(rig.s.v[0], (Vec3{}));
  EXPECT_EQ(rig.walls.results()[0].tangential_impulse, (Vec3{8, 0, 0}));
  EXPECT_EQ(rig.walls.results()[0].normal_impulse, (Vec3{0, 0, -2}));
  EXPECT_NEAR(rig.work_walls, -0.5 * 2.0 * 17.0, 1e-13);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
}

// Coulomb: pressed by N, pulled by T < mu N the node stays; by T > mu N it accelerates with (T - mu N) / m.
TEST(RigidWall, FrictionSticksAndSlips) {
  for (const double pull : {5.9, 6.1, 10.0}) {
    Rig rig(above_a_wall({{0, 0, 0}}, 2, 0.3), 2.0);
    rig.forces = [&](state::State& s) { s.f_contact[0] = {pull, 0, -20.0}; };
    rig.start();
    const double h = 0.01;
    for (int n = 0; n < 100; ++n) {
      rig.step(h);
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-12);
    }
    const double slip = std::max(0.0, (pull - 6.0) / 2.0);
    EXPECT_NEAR(rig.s.v[0].x, slip * 99.5 * h, 1e-12) << pull;
    EXPECT_NEAR(rig.walls.results()[0].normal_force.z, -20.0, 1e-12);
    EXPECT_NEAR(rig.walls.results()[0].tangential_force.x, std::min(pull, 6.0), 1e-12);
    EXPECT_NEAR(rig.walls.results()[0].normal_impulse.z, -20.0 * 99.5 * h, 1e-10);
  }
}

// Friction decelerates a sliding node by mu N / m until it stops; the ledger's work is the kinetic energy lost plus the (zero)
// work of the pressing force.
TEST(RigidWall, FrictionStopsASlidingNode) {
  Rig rig(above_a_wall({{0, 0, 0}}, 2, 0.5), 1.0);
  rig.s.v[0] = {1, 0, 0};
  rig.forces = [](state::State& s) { s.f_contact[0] = {0, 0, -4.0}; };
  rig.start();
  const double h = 1e-3;
  for (int n = 0; n < 400; ++n) rig.step(h);
  EXPECT_NEAR(rig.s.v[0].x, 1.0 - 2.0 * 399.5 * h, 1e-12);
  for (int n = 0; n < 200; ++n) rig.step(h);
  EXPECT_EQ(rig.s.v[0].x, 0.0);
  EXPECT_NEAR(rig.s.u[0].x, 0.25, 1e-3);  // v0^2 / (2 mu N / m)
  EXPECT_NEAR(rig.work_walls, -0.5, 1e-12);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

// Filter: the tangential impulse approaches its limit geometrically; J_k = (1 - (1 - f)^k) J for constant J below the limit.
TEST(RigidWall, FilteredFrictionApproachesTheForce) {
  auto m = above_a_wall({{0, 0, 0}}, 2, 10.0);
  m.rigid_walls[0].filter_kind = 1;
  m.rigid_walls[0].filter = 0.25;
  Rig rig(m);
  rig.forces = [](state::State& s) { s.f_contact[0] = {1.0, 0, -4.0}; };
  rig.start();
  rig.step(0.01);
  EXPECT_NEAR(rig.walls.results()[0].tangential_force.x, 0.25, 1e-14);
  EXPECT_NEAR(rig.s.v[0].x, 0.005 * 0.75, 1e-15);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-15);
}

// A filter by a frequency, in steps that are too long for it (2 pi f h = 3): a node slides and stops as without a filter.
TEST(RigidWall, AFilterOfLongStepsDoesNotAmplify) {
  auto m = above_a_wall({{0, 0, 0}}, 2, 0.5);
  m.rigid_walls[0].filter_kind = 3;
  m.rigid_walls[0].filter = 1500.0 / std::numbers::pi;
  Rig rig(m);
  rig.s.v[0] = {1, 0, 0};
  rig.forces = [](state::State& s) { s.f_contact[0] = {0, 0, -4.0}; };
  rig.start();
  for (int n = 0; n < 600; ++n) rig.step(1e-3);
  EXPECT_NEAR(rig.s.v[0].x, 0.0, 1e-15);
  EXPECT_NEAR(rig.s.u[0].x, 0.25, 1e-3);  // v0^2 / (2 mu N / m)
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

// That of the reference profile has no bound: the first force is 1.5 times what would hold the node.
TEST(RigidWall, ReferenceFilterHasNoBound) {
  auto m = above_a_wall({{0, 0, 0}}, 2, 10.0);
  m.rigid_walls[0].filter_kind = 3;
  m.rigid_walls[0].filter = 150.0 / std::numbers::pi;  // the first kick is half a step
  Rig rig(m, 1.0, 0.0, Profile::reference());
  rig.forces = [](state::State& s) { s.f_contact[0] = {1.0, 0, -4.0}; };
  rig.start();
  rig.step(0.01);
  EXPECT_NEAR(rig.walls.results()[0].tangential_force.x, 1.5, 1e-14);
}

// A free wall of mass 3 at 0.5 is hit by two nodes of mass 1 at -2, one after the other: plastic impacts, momentum conserved. The
// first goes on with the wall at (1.5 - 2) / 4 and is left behind when the second drives the wall away at (-0.375 - 2) / 4.
TEST(RigidWall, MovingWallConservesMomentum) {
  auto m = above_a_wall({{0, 0, -0.5}, {0, 0, 0.4}, {1, 0, 0.42}});
  m.rigid_walls[0].node = 0;
  m.rigid_walls[0].mass = 3.0;
  m.rigid_walls[0].velocity = {0, 0, 0.5};
  Rig rig(m);
  rig.s.mass[0] = 0.0;
  rig.s.v[1] = rig.s.v[2] = {0, 0, -2.0};
  rig.start();
  EXPECT_EQ(rig.s.mass[0], 3.0);
  EXPECT_EQ(rig.s.v[0].z, 0.5);
  for (int n = 0; n < 100; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-13) << n;
  }
  double momentum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) momentum += rig.s.mass[i] * rig.s.v[i].z;
  EXPECT_NEAR(momentum, 3.0 * 0.5 - 4.0, 1e-12);
  EXPECT_NEAR(rig.s.v[1].z, -0.125, 1e-13);
  EXPECT_NEAR(rig.s.v[0].z, -0.59375, 1e-13);
  EXPECT_NEAR(rig.s.v[2].z, -0.59375, 1e-13);
  EXPECT_NEAR(rig.walls.results()[0].normal_impulse.z, -1.875 - 1.40625, 1e-12);
}

// A wall pushed by a force accelerates with the mass that it carries.
TEST(RigidWall, PushedWallCarriesItsNodes) {
  auto m = above_a_wall({{0, 0, 0}, {0, 0, 0}});
  m.rigid_walls[0].node = 0;
  m.rigid_walls[0].mass = 2.0;
  Rig rig(m);
  rig.s.mass[0] = 1.0;
  rig.forces = [](state::State& s) { s.f_contact[0] = {0, 0, 8.0}; };
  rig.start();
  for (int n = 0; n < 200; ++n) {
    rig.step(0.005);
    ASSERT_NEAR(rig.s.v[1].z, rig.s.v[0].z, 1e-13);
  }
  EXPECT_NEAR(rig.s.v[0].z, 8.0 / 4.0 * 199.5 * 0.005, 1e-10);
  // Work between wall and node cancels but for this cycle's: the node's half-step velocity is already the new one.
  EXPECT_NEAR(rig.work_walls, 0.5 * 1.0 * 0.01 * rig.s.v[0].z, 1e-12);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-11);
}

// A free wall takes up the friction of its nodes: what sticks ends with the common velocity, also on a light wall, what slips gets mu J_n
// and goes on slipping the same way; momentum is conserved and the ledger closes.
TEST(RigidWall, FrictionTakesTheWallAlong) {
  for (const double wall_mass : {0.01, 0.1, 1.0, 10.0}) {
    for (const double mass : {0.1, 1.0, 10.0}) {
      auto m = above_a_wall({{0, 0, 0}, {0, 0, 0}}, 2, 0.5);
      m.rigid_walls[0].node = 0;
      Rig rig(m);
      rig.s.mass = std::vector<double>{wall_mass, mass};
      rig.s.v[1] = {1, 0, -10};
      rig.start();
      for (int n = 0; n < 10; ++n) {
        rig.step(0.01);
        ASSERT_NEAR(rig.ledger(), 0.0, 1e-12 * mass * 100.0);
      }
      for (const std::size_t i : {0u, 1u}) {
        EXPECT_NEAR(rig.s.v[i].x, mass / (mass + wall_mass), 1e-13) << wall_mass << " " << mass << " " << i;
        EXPECT_NEAR(rig.s.v[i].z, -10.0 * mass / (mass + wall_mass), 1e-12) << wall_mass << " " << mass << " " << i;
      }
    }
  }
  // Three nodes of 1 against a wall of 1 that goes to -3/4 of 2: each presses with J_n = 2 / 4, so friction takes at most mu / 2 of each.
  auto m = above_a_wall({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2, 0.4);
  m.rigid_walls[0].node = 0;
  Rig rig(m);
  rig.s.v[1] = {5, 0, -2};
  rig.s.v[2] = {0, 3, -2};
  rig.s.v[3] = {0.2, 0.2, -2};
  rig.start();
  rig.step(0.01);
  const Vec3 wall = rig.s.v[0];
  Vec3 momentum = wall;
  for (const std::size_t i : {1u, 2u, 3u}) {
    momentum += rig.s.v[i];
    EXPECT_NEAR(rig.s.v[i].z, -1.5, 1e-14);
  }
  EXPECT_LT(norm(momentum - Vec3{5.2, 3.2, -6}), 1e-14);
  EXPECT_LT(norm(rig.s.v[3] - wall), 1e-14);
  const Vec3 before[] = {{5, 0, -1.5}, {0, 3, -1.5}};
  for (const std::size_t i : {1u, 2u}) {  // the loss is 0.2 against the slip that is left
    const Vec3 slip = rig.s.v[i] - wall, loss = before[i - 1] - rig.s.v[i];
    EXPECT_NEAR(norm(loss), 0.2, 1e-14);
    EXPECT_NEAR(dot(loss, slip), 0.2 * norm(slip), 1e-13);
  }
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
}

// Held along (1, 0, 1) a node slides down along (1, 0, -1) and comes to rest on the wall, where the impulse of the wall and of the
// condition together stop it; held along z above a slope it stays where the slope stops it.
TEST(RigidWall, StopsANodeHeldObliquely) {
  const double s = std::sqrt(0.5);
  for (const bool skew : {true, false}) {
    for (const int slide : {0, 2}) {
      auto m = above_a_wall({{0, 0, 0.1}}, slide, 0.3);
      if (skew) {
        m.skews.push_back({.id = 1, .axes = {Vec3{s, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, s}}});
      } else {
        m.rigid_walls[0].normal = {s, 0, s};
      }
      m.boundary_conditions.push_back({.id = 1, .translation = {skew, false, !skew}, .skew = skew ? 0 : no_index, .nodes = {0}});
      Rig rig(m, 2.0);
      rig.forces = [skew](state::State& state) { state.f_contact[0] = skew ? Vec3{0, 0, -20} : Vec3{-20, 0, 0}; };
      rig.start();
      const Vec3 n = m.rigid_walls[0].normal;
      for (int k = 0; k < 400; ++k) {
        rig.step(0.002);
        ASSERT_GE(dot(rig.s.x[0], n), -1e-15) << k;
        ASSERT_NEAR(rig.ledger(), 0.0, 1e-12) << k;
      }
      EXPECT_LT(dot(rig.s.x[0], n), 0.01);
      EXPECT_LT(norm(rig.s.v[0]), 1e-13);
      const double held = dot(rig.s.x[0] - Vec3{0, 0, 0.1}, skew ? Vec3{s, 0, s} : Vec3{0, 0, 1});
      EXPECT_NEAR(held, 0.0, 1e-15);
      EXPECT_EQ(rig.walls.in_contact(0), 1);
    }
  }
}

/// Model of a rigid body of nodes 0 (main) to 3 with a wall on its node 3, hit by nodes 4 to 6.
model::Model wall_on_a_body(int slide) {
  auto m = nodes_at({{0, 0, -1}, {1, 0, -1}, {-0.5, 0.8, -1.2}, {0.4, 0.6, -0.5}, {0, 0, 0.1}, {2, 0, 0.12}, {0, 1, 0.3}});
  model::RigidBody body;
  body.id = 1;
  body.main = 0;
  body.ispher = 3;
  body.nodes = {1, 2, 3};
  m.rigid_bodies.push_back(body);
  model::RigidWall wall;
  wall.id = 1;
  wall.slide = slide;
  wall.normal = {0, 0, 1};
  wall.node = 3;
  wall.nodes = {4, 5, 6};
  m.rigid_walls.push_back(wall);
  return m;
}

// A wall on a node of a free rigid body hands what hits it to the body: linear momentum of all and angular momentum of the body
// about what the wall's node received are kept to rounding, and the ledger closes.
TEST(RigidWall, PushesTheRigidBodyThatCarriesIt) {
  for (const int slide : {0, 1}) {
    Rig rig(wall_on_a_body(slide), 1.0, 0.02);
    rig.s.v[0] = {0.1, 0, 0.3};
    rig.s.w[0] = {0.2, -0.1, 0.3};
    for (const std::size_t i : {4u, 5u, 6u}) rig.s.v[i] = {0.5, 0.2, -2.0};
    rig.start();
    const auto momentum = [&] {
      Vec3 sum = rig.s.mass[0] * rig.s.v[0];
      for (const std::size_t i : {4u, 5u, 6u}) sum += rig.s.mass[i] * rig.s.v[i];
      return sum;
    };
    const auto spin = [&] { return rig.bodies.times_inertia(0, rig.s.w[0]); };
    const Vec3 before = momentum();
    double scale = 0.0;
    for (std::size_t i = 0; i < 7; ++i) scale += (i == 0 || i > 3 ? rig.s.mass[i] : 0.0) * norm(rig.s.v[i]);
    Vec3 turned = spin(), impulse{};
    rig.output = [&](const state::State& s) {  // moment of the wall's impulse about the centre of the body
      const WallSums& sums = rig.walls.results()[0];
      const Vec3 now = sums.normal_impulse + sums.tangential_impulse;
      turned += cross(s.x[3] - s.x[0], now - impulse);
      impulse = now;
    };
    for (int n = 0; n < 200; ++n) {
      rig.step(0.004 * (1.0 + 0.5 * std::sin(2.0 * n)));
      ASSERT_LT(norm(momentum() - before), 1e-12 * scale) << n;
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-12) << n;
    }
    EXPECT_LT(impulse.z, -1.0);
    EXPECT_EQ(slide == 0, norm(rig.walls.results()[0].tangential_impulse) == 0.0);
    EXPECT_LT(norm(spin() - turned), 0.02 * norm(turned));  // its axes turn between the bookings
  }
}

// In one impact, body at rest and not turning: V_w = n.A n sum m v.n / (1 + n.A n sum m), A = 1/M + turning (r x n).J^-1(r x n); a
// tied wall takes all components. The body's node moves with what stuck to it.
TEST(RigidWall, PlasticImpactOnARigidBodyInClosedForm) {
  for (const int slide : {0, 1}) {
    auto m = wall_on_a_body(slide);
    for (std::size_t i = 4; i < 7; ++i) m.node_x[i].z = -0.4999;
    Rig rig(m, 1.0, 0.02);
    for (const std::size_t i : {4u, 5u, 6u}) rig.s.v[i] = {0.5, 0.2, -2.0};
    rig.start();
    const RigidBodies::Carrier carrier{3, 0, 0, {}, {}};
    Vec3 column[3];
    for (int k = 0; k < 3; ++k) {
      Vec3 e{};
      e[k] = 1.0;
      column[k] = rig.bodies.response(rig.s, carrier, e);
    }
    rig.step(1e-3);
    const Vec3 v = rig.s.v[4];
    if (slide == 0) {
      const double a = column[2].z;
      EXPECT_NEAR(v.z, -2.0 * 3.0 * a / (1.0 + 3.0 * a), 1e-14);
      EXPECT_EQ(v.x, 0.5);
    } else {  // (1 + 3 A) V = 3 A v
      const Vec3 hit{0.5, 0.2, -2.0};
      for (int row = 0; row < 3; ++row) {
        double left = v[row], right = 0.0;
        for (int k = 0; k < 3; ++k) {
          left += 3.0 * column[k][row] * v[k];
          right += 3.0 * column[k][row] * hit[k];
        }
        EXPECT_NEAR(left, right, 1e-13) << row;
      }
    }
    EXPECT_NEAR(rig.s.v[3].z, v.z, 2e-3);  // the body turns on chords: to first order in the angle per step
  }
}

// A rigid block of mass m_2 hit by a free body of mass m_1 that carries a wall on its centre: common velocity
// (m_1 v_1 + m_2 v_2) / (m_1 + m_2), as with a wall on a free node of mass m_1.
TEST(RigidWall, CommonVelocityOfTwoMasses) {
  for (const bool on_body : {false, true}) {
    auto m = nodes_at({{0, 0, 0}, {1, 1, 0}, {-1, -1, 0}, {1, 0, 0.2}, {0, 1, 0.2}, {-1, -1, 0.2}});
    if (on_body) {
      model::RigidBody body;
      body.id = 1;
      body.main = 0;
      body.nodes = {1, 2};
      m.rigid_bodies.push_back(body);
    }
    model::RigidWall wall;
    wall.id = 1;
    wall.normal = {0, 0, 1};
    wall.node = 0;
    wall.mass = 2.5;
    wall.velocity = {0.3, 0, 1.5};
    wall.nodes = {3, 4, 5};
    m.rigid_walls.push_back(wall);
    Rig rig(m, 1.0, 0.1);
    if (!on_body) rig.s.mass[0] = 3.0;  // the body: three nodes of mass 1
    for (const std::size_t i : {3u, 4u, 5u}) rig.s.v[i] = {0, 0, -1.0};
    rig.start();
    for (int n = 0; n < 40; ++n) {
      rig.step(0.005);
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-12);
    }
    const double common = (5.5 * 1.5 - 3.0) / 8.5;
    EXPECT_NEAR(rig.s.mass[0], 5.5, 1e-15);
    for (const std::size_t i : {0u, 3u, 4u, 5u}) EXPECT_NEAR(rig.s.v[i].z, common, 1e-13) << i;
    EXPECT_NEAR(rig.s.v[0].x, 0.3, 1e-13);
  }
}

// A wall whose main node is guided: a tied node takes it along where it is free, the guide takes the rest.
TEST(RigidWall, GuidedWallYieldsAlongItsFreeDirection) {
  auto m = above_a_wall({{0, 0, 0}, {0, 0, 0.001}}, 1);
  m.rigid_walls[0].node = 0;
  m.rigid_walls[0].mass = 3.0;
  m.boundary_conditions.push_back({.id = 1, .translation = {false, true, true}, .nodes = {0}});
  Rig rig(m);
  rig.s.mass[0] = 0.0;
  rig.s.v[1] = {4, 1, -2};
  rig.start();
  for (int n = 0; n < 10; ++n) rig.step(0.01);
  EXPECT_NEAR(rig.s.v[0].x, 1.0, 1e-14);
  EXPECT_NEAR(rig.s.v[1].x, 1.0, 1e-14);
  EXPECT_EQ(rig.s.v[0].y, 0.0);
  EXPECT_EQ(rig.s.v[0].z, 0.0);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
}

// A wall driven by an imposed velocity is not slowed by what it hits.
TEST(RigidWall, DrivenWallKeepsItsVelocity) {
  auto m = above_a_wall({{0, 0, 0}, {0, 0, 0.03}});
  m.rigid_walls[0].node = 0;
  m.rigid_walls[0].mass = 1.0;
  m.imposed_motions.push_back({.id = 1, .direction = 2, .scale_y = 2.0, .nodes = {0}});
  Rig rig(m);
  rig.start();
  for (int n = 0; n < 20; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.s.v[0].z, 2.0, 1e-14);
  }
  EXPECT_NEAR(rig.s.v[1].z, 2.0, 1e-14);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-12);
}

// Reference profile: what the wall received in cycle n acts on it in cycle n + 1, on the mass of both (numerics.md 6.1.5).
TEST(RigidWall, ReferenceReactionComesOneCycleLater) {
  auto m = above_a_wall({{0, 0, 0}, {0, 0, 0.001}});
  m.rigid_walls[0].node = 0;
  m.rigid_walls[0].mass = 2.0;
  Rig rig(m, 1.0, 0.0, Profile::reference());
  rig.s.mass[0] = 1.0;
  rig.s.v[1] = {0, 0, -1};
  rig.start();
  rig.step(0.01);
  EXPECT_EQ(rig.s.v[0].z, 0.0);
  EXPECT_EQ(rig.s.v[1].z, 0.0);
  rig.step(0.01);
  // J / h_bar with the h_bar of cycle 0 (half a step), times h_bar of cycle 1, over 3 + 1.
  EXPECT_NEAR(rig.s.v[0].z, -1.0 / 0.005 * 0.01 / 4.0, 1e-14);
  EXPECT_NEAR(rig.ledger(), 0.0, 1e-13);
}

// Ikrem 0 takes the secondary nodes out of the walls. Kept nodes (1) stop the body; in the reference profile it overwrites what the wall
// did to them and goes on.
TEST(RigidWall, LeavesOutSecondaryNodesOfRigidBodies) {
  for (const auto& [keep, profile] : {std::pair{false, Profile::standard()}, std::pair{true, Profile::standard()},
                                      std::pair{false, Profile::reference()}, std::pair{true, Profile::reference()}}) {
    auto m = above_a_wall({{0, 0, 1}, {0, 0, 0.001}});
    model::RigidBody body;
    body.main = 0;
    body.keep_in_walls = keep;
    body.nodes = {1};
    m.rigid_bodies.push_back(body);
    Rig rig(m, 1.0, 0.0, profile);
    rig.s.v[0] = {0, 0, -1};
    rig.start();
    rig.step(0.1);
    EXPECT_EQ(rig.walls.in_contact(0), keep ? 1 : 0);
    const bool stops = keep && profile.moving_wall == Profile::MovingWall::same_cycle;
    EXPECT_EQ(rig.s.v[0].z, stops ? 0.0 : -1.0);
  }
}

}  // namespace
}  // namespace abut::constraints::test
