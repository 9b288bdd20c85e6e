// Rigid bodies on rigid walls: plastic impact of all their points at once.
#include <gtest/gtest.h>

#include <cmath>

#include "constraints/rigid_walls.hpp"
#include "constraints/rotation.hpp"
#include "unit/constraints/bodies.hpp"

namespace abut::constraints::test {
namespace {

/// Main node 0 in the middle of a block of eight masses; wall z >= 0 for the corners. `turn`: rotation vector of the block.
model::Model block(double height, const Vec3& turn, int slide = 0, double friction = 0.0, int icog = 1) {
  std::vector<Vec3> x{{0, 0, height}};
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner{(k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.3 : -0.3, (k & 4) != 0 ? 0.2 : -0.2};
    x.push_back(Vec3{0, 0, height} + rotated(corner, turn));
  }
  auto m = nodes_at(x);
  model::RigidBody body = card(1, 0, {1, 2, 3, 4, 5, 6, 7, 8}, 3);
  body.icog = icog;
  body.keep_in_walls = true;
  m.rigid_bodies.push_back(body);
  model::RigidWall wall;
  wall.id = 1;
  wall.normal = {0, 0, 1};
  wall.slide = slide;
  wall.friction = friction;
  wall.nodes = {1, 2, 3, 4, 5, 6, 7, 8};
  m.rigid_walls.push_back(wall);
  return m;
}

double lowest(const state::State& s) {
  double z = s.x[1].z;
  for (std::size_t i = 2; i < 9; ++i) z = std::min(z, s.x[i].z);
  return z;
}

void add_gravity(model::Model& m, double g) {
  m.gravities.push_back({});
  m.gravities[0].direction = 2;
  m.gravities[0].scale_y = -g;
  m.gravities[0].nodes = {0};
}

// Flat: the block stops as a whole, impulse M v, energy M v^2 / 2, no turn, no penetration.
TEST(WallAndBody, FlatBlockStops) {
  Rig rig(block(0.3, {}), 0.5);
  rig.s.v[0] = {0.7, 0, -2.0};
  rig.start();
  const double mass = rig.s.mass[0];
  for (int n = 0; n < 100; ++n) {
    rig.step(0.01);
    ASSERT_GE(lowest(rig.s), -1e-14) << n;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-12) << n;
  }
  EXPECT_NEAR(rig.s.v[0].z, 0.0, 1e-12);
  EXPECT_EQ(rig.s.v[0].x, 0.7);
  EXPECT_LT(norm(rig.s.w[0]), 1e-12);
  EXPECT_NEAR(rig.walls.results()[0].normal_impulse.z, -2.0 * mass, 1e-12);
  EXPECT_EQ(norm(rig.walls.results()[0].tangential_impulse), 0.0);
  EXPECT_NEAR(rig.work_walls, -0.5 * mass * 4.0, 1e-11);
}

// Springs on the corners of a block that falls flat. The impulse of the wall is an acceleration of the block: no velocity jumps.
TEST(WallAndBody, StopsABlockUnderForceWithABalance) {
  Rig rig(block(0.3, {}), 0.5);
  rig.s.v[0] = {0, 0, -2.0};
  const double rest = rig.s.x[1].z;
  double stored = 0.0;
  std::vector<double> last(9, 0.0);
  rig.forces = [&](state::State& s) {
    for (std::size_t i = 1; i < 5; ++i) {  // the lower corners
      const double force = -100.0 * (s.x[i].z - rest);
      stored -= 0.5 * s.times.h_minus * (last[i] + force) * s.v[i].z;
      s.f_contact[i] = {0, 0, last[i] = force};
    }
  };
  rig.start();
  for (int n = 0; n < 60; ++n) {
    rig.step(0.01);
    ASSERT_NEAR(rig.kinetic + stored - rig.work_walls - rig.work_bodies - rig.work_stops, rig.baseline, 1e-11) << n;
  }
  EXPECT_LT(rig.work_walls, -1.0);
  EXPECT_EQ(rig.work_stops, 0.0);
}

// On one corner r beside the centre: impulse j = v / a, a = N.(1/M + turn (r x N).J^-1 (r x N)), energy lost v^2 / 2a; the
// block goes on turning with w = J^-1 (r x N) j until the next corners hit, none of which goes through.
TEST(WallAndBody, CornerHitsInClosedForm) {
  for (const int icog : {1, 3}) {
    auto m = block(0.9, {0.4, 0.5, 0.1}, 0, 0.0, icog);
    if (icog == 3) m.node_x[0] += Vec3{0.2, -0.1, 0.1};  // a massless main node beside the centre of gravity
    Rig rig(m, 1.0);
    if (icog == 3) rig.s.mass[0] = 0.0;
    rig.s.v[0] = {0, 0, -1.0};
    rig.start();
    const double mass = rig.s.mass[0], h = 1e-4;
    Vec3 centre{};
    for (std::size_t i = 1; i < 9; ++i) centre += rig.s.x[i] / 8.0;
    std::size_t first = 1;
    for (std::size_t i = 2; i < 9; ++i) first = rig.s.x[i].z < rig.s.x[first].z ? i : first;
    const Vec3 r = rig.s.x[first] - centre, n{0, 0, 1};
    const Vec3 moment = cross(r, n);
    const auto answer = rig.bodies.answer(rig.s, 0, {}, {});
    const double a = dot(n, answer.velocity(rig.s.x[first], rig.s.x[first], n));
    EXPECT_GT(a, 1.5 / mass);
    for (int k = 0; k < 20000 && rig.walls.in_contact(0) == 0; ++k) rig.step(h);
    EXPECT_NEAR(rig.walls.results()[0].normal_impulse.z, -1.0 / a, 1e-3 / a) << icog;  // of first order in w h
    EXPECT_NEAR(dot(rig.bodies.times_inertia(0, rig.s.w[0]) - moment / a, moment), 0.0, 1e-3 * squared_norm(moment) / a);
    Vec3 after{};
    for (std::size_t i = 1; i < 9; ++i) after += rig.s.v[i] / 8.0;
    EXPECT_NEAR(after.z, -1.0 + 1.0 / (a * mass), 1e-3);
    rig.step(h);
    EXPECT_NEAR(rig.work_walls, -0.5 / a, 1e-3 / a);
    double before = rig.kinetic;
    for (int k = 0; k < 20000; ++k) {
      rig.step(h);
      ASSERT_GE(lowest(rig.s), -1e-9) << k;
      ASSERT_LT(rig.kinetic, before * (1.0 + 1e-9)) << k;  // a plastic impact makes no energy
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-11) << k;
      before = rig.kinetic;
    }
    const auto& sums = rig.walls.results()[0];
    Vec3 v{};
    for (std::size_t i = 1; i < 9; ++i) v += rig.s.v[i] / 8.0;
    EXPECT_NEAR(mass * (v.z + 1.0), -sums.normal_impulse.z, 1e-11);  // momentum
    EXPECT_NEAR(v.x, 0.0, 1e-11);
    EXPECT_LT(lowest(rig.s), 0.02);
  }
}

// Under gravity the block comes to lie: reaction M g, no motion, no drift through the wall.
TEST(WallAndBody, TumblesAndComesToRest) {
  auto m = block(0.8, {0.3, 0.2, 0.0}, 2, 0.4);
  add_gravity(m, 10.0);
  Rig rig(m, 1.0);
  rig.start();
  const double mass = rig.s.mass[0];
  for (int k = 0; k < 20000; ++k) {
    rig.step(5e-4);
    ASSERT_GE(lowest(rig.s), -1e-9) << k;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-10) << k;
  }
  EXPECT_LT(norm(rig.s.v[0]), 1e-6);
  EXPECT_LT(norm(rig.s.w[0]), 1e-5);
  EXPECT_NEAR(rig.s.x[0].z, 0.2, 1e-4);
  const double before = rig.walls.results()[0].normal_impulse.z, t = rig.s.times.t;
  for (int k = 0; k < 1000; ++k) rig.step(5e-4);
  EXPECT_NEAR((rig.walls.results()[0].normal_impulse.z - before) / (rig.s.times.t - t), -mass * 10.0, 1e-3 * mass * 10.0);
}

// Coulomb: a flat block with speed v stops after v^2 / 2 mu g; tied it stops at once.
TEST(WallAndBody, FrictionStopsASlidingBlock) {
  for (const int slide : {1, 2}) {
    auto m = block(0.2, {}, slide, 0.25);
    add_gravity(m, 10.0);
    Rig rig(m, 1.0);
    rig.s.v[0] = {1.0, 0, 0};
    rig.start();
    for (int k = 0; k < 1000; ++k) {
      rig.step(1e-3);
      ASSERT_NEAR(rig.ledger(), 0.0, 1e-11) << k;
    }
    EXPECT_NEAR(norm(rig.s.v[0]), 0.0, 1e-12);
    EXPECT_NEAR(rig.s.u[0].x, slide == 1 ? 0.0 : 0.2, slide == 1 ? 1e-3 : 1e-3);
    EXPECT_NEAR(rig.walls.results()[0].tangential_impulse.x, rig.s.mass[0], 1e-9);
  }
}

// A block falls on a free moving wall of mass 3: common velocity, momentum of both kept to rounding.
TEST(WallAndBody, MovingWallAndBlockShareMomentum) {
  auto m = block(0.25, {});
  m.node_x.push_back({0, 0, 0});
  m.node_id.push_back(10);
  m.rigid_walls[0].node = 9;
  m.rigid_walls[0].mass = 2.0;
  Rig rig(m, 1.0);
  rig.s.v[0] = {0, 0, -2.0};
  rig.start();
  const double mass = rig.s.mass[0], wall = rig.s.mass[9];
  EXPECT_EQ(wall, 3.0);
  for (int k = 0; k < 100; ++k) {
    rig.step(0.01);
    ASSERT_NEAR(mass * rig.s.v[0].z + wall * rig.s.v[9].z, -2.0 * mass, 1e-12) << k;
    ASSERT_NEAR(rig.ledger(), 0.0, 1e-11) << k;
    ASSERT_GE(lowest(rig.s) - rig.s.x[9].z, -1e-12) << k;
  }
  EXPECT_NEAR(rig.s.v[9].z, -2.0 * mass / (mass + wall), 1e-12);
  EXPECT_NEAR(rig.s.v[0].z, rig.s.v[9].z, 1e-12);
}

// What the animation shows of a wall: the forces of the nodes on it, whose sum is the wall's.
TEST(WallAndBody, ForcesOfTheNodesAddUp) {
  Rig rig(block(0.2001, {}, 2, 0.1), 1.0);
  rig.s.v[0] = {0.5, 0, -2.0};
  rig.start();
  rig.step(1e-3);
  std::vector<Vec3> force(9);
  rig.walls.add_forces(force);
  Vec3 sum{};
  for (const Vec3& f : force) sum += f;
  const auto& sums = rig.walls.results()[0];
  EXPECT_LT(norm(sum - sums.normal_force - sums.tangential_force), 1e-12 * norm(sum));
  EXPECT_NEAR(sums.tangential_force.x, -0.1 * sums.normal_force.z, 1e-9 * norm(sum));
  EXPECT_LT(sums.normal_force.z, 0.0);
  for (std::size_t i = 5; i < 9; ++i) EXPECT_EQ(force[i], Vec3{});  // the upper corners
}

}  // namespace
}  // namespace abut::constraints::test
