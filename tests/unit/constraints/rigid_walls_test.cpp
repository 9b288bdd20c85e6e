#include "constraints/rigid_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(RigidWall, LeavesOutSecondaryNodesOfRigidBodiesUnlessKept) {
  for (const bool keep : {false, true}) {
    auto m = above_a_wall({{0, 0, 1}, {0, 0, 0.001}});
    model::RigidBody body;
    body.main = 0;
    body.keep_in_walls = keep;
    body.nodes = {1};
    m.rigid_bodies.push_back(body);
    Rig rig(m);
    rig.s.v[0] = {0, 0, -1};
    rig.start();
    rig.step(0.1);
    EXPECT_EQ(rig.walls.in_contact(0), keep ? 1 : 0);
  }
}

}  // namespace
}  // namespace abut::constraints::test
