// Conditions of a deck come out in work units, with defaults explicit and sets resolved (deck-format.md D).
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "model/measure.hpp"
#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

/// Ids behind node indices.
std::vector<Id> ids(const Model& m, const std::vector<Index>& nodes) {
  std::vector<Id> result;
  for (const Index n : nodes) result.push_back(m.node_id[static_cast<std::size_t>(n)]);
  return result;
}

double added_mass_at(const Model& m, Id node) {
  double mass = 0.0;
  for (const AddedMass& a : m.added_masses) mass += m.node_id[static_cast<std::size_t>(a.node)] == node ? a.mass : 0.0;
  return mass;
}

/// The base deck with text put before the keyword line.
Built with_text_before(std::string_view keyword, const std::string& text) {
  return build_text(with_line(base_starter, keyword, 0, text + "\n" + std::string(keyword)));
}

TEST(Conditions, BaseDeckHasNoFinding) {
  const Built b = build_text(base_starter);
  EXPECT_EQ(b.messages(), std::vector<std::string>{});
}

TEST(Conditions, BoundaryConditionFlagsAreSingleColumns) {
  const Built b = build_changed("/BCS/1", 2, "   101 010" + integers({"1", "1"}));
  ASSERT_FALSE(b.diagnostics.has_errors());
  const BoundaryCondition& bc = b.model.boundary_conditions.at(0);
  EXPECT_EQ(bc.translation, (std::array{true, false, true}));
  EXPECT_EQ(bc.rotation, (std::array{false, true, false}));
  EXPECT_EQ(bc.skew, 0);
  EXPECT_EQ(ids(b.model, bc.nodes), (std::vector<Id>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Conditions, InitialVelocityInASkewIsTurnedToGlobalAxes) {
  // y' = (0, 0, 1), z' = (1, 0, 0), so x' = y' x z' = (0, 1, 0): local (1, 2, 3) is global (3, 1, 2).
  std::string deck = with_line(base_starter, "/SKEW/FIX/1", 3, reals({"0", "0", "1"}));
  deck = with_line(deck, "/SKEW/FIX/1", 4, reals({"1", "0", "0"}));
  deck = with_line(deck, "/INIVEL/TRA/1", 2, reals({"1", "2", "3"}) + integers({"2", "1"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const InitialVelocity& v = b.model.initial_velocities.at(0);
  EXPECT_EQ(v.value, (Vec3{3, 1, 2}));
  EXPECT_FALSE(v.rotational);
  EXPECT_EQ(v.nodes.size(), 9u);
}

TEST(Conditions, InitialVelocitiesKeepTheOrderOfTheDeck) {
  const Built b = with_text_before("/INIVEL/TRA/1", "/INIVEL/ROT/5\nspin\n" + reals({"0", "0", "7"}) + integers({"3", "0"}) +
                                                        "\n/INIVEL/NODE/4\nsingle\n" + integers({"30", "0"}) + reals({"1", "2", "3"}) +
                                                        "\n" + integers({"", ""}) + reals({"0", "5", "0"}) + "\n/INIVEL/AXIS/6\nrotor\n" +
                                                        integers({"Y", "0", "3"}) + "\n" + reals({"0", "0", "2", "9"}));
  ASSERT_EQ(b.messages(), std::vector<std::string>{});
  const auto& v = b.model.initial_velocities;
  ASSERT_EQ(v.size(), 5u);
  EXPECT_EQ(v[0].id, 5);
  EXPECT_TRUE(v[0].rotational);
  EXPECT_EQ(v[1].value, (Vec3{1, 2, 3}));
  EXPECT_EQ(v[2].value, (Vec3{0, 5, 0}));
  EXPECT_TRUE(v[2].rotational);
  EXPECT_TRUE(v[3].about_axis);
  EXPECT_FALSE(v[3].rotational);
  EXPECT_EQ(v[3].spin, (Vec3{0, 9, 0}));
  EXPECT_EQ(v[3].value, (Vec3{0, 0, 2}));
  EXPECT_EQ(v[4].id, 1);
}

TEST(Conditions, ZeroScaleIsOneInTheUnitOfTheDeck) {
  // Input mm and ms, work m and s: a velocity scale of 0 is 1 mm/ms = 1 m/s, an abscissa scale of 0 is 1 ms.
  std::string deck = with_line(base_starter, "/BEGIN", 4, reals({"kg", "m", "s"}));
  deck = with_line(deck, "/IMPVEL/1", 3, reals({"0", "0", "0", "0"}));
  deck = with_line(deck, "/CLOAD/1", 2, integers({"1", "X", "1", "0", "5", "0"}) + reals({"0", "0"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const ImposedMotion& motion = b.model.imposed_motions.at(0);
  EXPECT_DOUBLE_EQ(motion.scale_x, 1e-3);
  EXPECT_DOUBLE_EQ(motion.scale_y, 1.0);
  EXPECT_EQ(motion.t_stop, infinity);
  EXPECT_DOUBLE_EQ(b.model.sensors.at(0).t_on, 1e-5);
  EXPECT_DOUBLE_EQ(b.model.concentrated_loads.at(0).scale_y, 1e3);  // kg mm/ms2 = 1000 N
  EXPECT_DOUBLE_EQ(b.model.gravities.at(0).scale_y, -9.81);
  EXPECT_DOUBLE_EQ(b.model.pressure_loads.at(0).scale_y, 4e9);  // kg/(mm ms2) = 1 GPa
}

TEST(Conditions, LoadsReferToFunctionSkewSensorAndGroup) {
  const Built b = build_text(base_starter);
  const ImposedMotion& motion = b.model.imposed_motions.at(0);
  EXPECT_EQ(motion.kind, ImposedMotion::Kind::velocity);
  EXPECT_EQ(motion.direction, 2);
  EXPECT_EQ(motion.function, 0);
  EXPECT_EQ(motion.sensor, 0);
  EXPECT_EQ(motion.skew, no_index);
  EXPECT_EQ(motion.scale_y, -2.0);
  EXPECT_EQ(motion.t_stop, 0.5);
  const ConcentratedLoad& load = b.model.concentrated_loads.at(0);
  EXPECT_EQ(load.direction, 0);
  EXPECT_EQ(load.skew, 0);
  EXPECT_EQ(ids(b.model, load.nodes), std::vector<Id>{30});
  EXPECT_EQ(b.model.pressure_loads.at(0).segments.size(), 1u);
}

TEST(Conditions, RotationHasItsOwnDimensions) {
  std::string deck = with_line(base_starter, "/BEGIN", 4, reals({"kg", "m", "s"}));
  deck = with_line(deck, "/IMPVEL/1", 2, integers({"1", "ZZ", "0", "0", "4", "0", "0"}));
  deck = with_line(deck, "/CLOAD/1", 2, integers({"1", "YY", "0", "0", "5", "0"}) + reals({"0", "3"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  EXPECT_EQ(b.model.imposed_motions.at(0).direction, 5);
  EXPECT_DOUBLE_EQ(b.model.imposed_motions.at(0).scale_y, -2000.0);  // rad/ms
  EXPECT_DOUBLE_EQ(b.model.concentrated_loads.at(0).scale_y, 3.0);   // kg mm2/ms2 = 1 N m
}

TEST(Conditions, GravityWithoutGroupActsOnAllNodes) {
  const Built b = build_changed("/GRAV/1", 2, integers({"0", "Y", "0", "0", "0", ""}) + reals({"0", "-9.81E-3"}));
  ASSERT_FALSE(b.diagnostics.has_errors());
  EXPECT_EQ(static_cast<Index>(b.model.gravities.at(0).nodes.size()), b.model.node_count());
  EXPECT_EQ(b.model.gravities.at(0).direction, 1);
  EXPECT_EQ(b.model.gravities.at(0).function, no_index);
}

TEST(Conditions, AddedMassPerNodeSharedPerAreaAndPerPart) {
  const Built each = build_text(base_starter);
  EXPECT_DOUBLE_EQ(added_mass_at(each.model, 25), 1e-6);
  const Built shared = build_changed("/ADMAS/0/1", 0, "/ADMAS/1/1");
  EXPECT_DOUBLE_EQ(added_mass_at(shared.model, 25), 0.25e-6);
  std::string deck = with_line(base_starter, "/ADMAS/0/1", 2, reals({"1E-6"}) + integers({"3"}));
  const Built area = build_text(with_line(deck, "/ADMAS/0/1", 0, "/ADMAS/2/1"));  // 1 mm2 of plate
  EXPECT_DOUBLE_EQ(added_mass_at(area.model, 21), 0.25e-6);
  EXPECT_DOUBLE_EQ(added_mass_at(area.model, 25), 0.0);
  deck = with_line(base_starter, "/ADMAS/0/1", 0, "/ADMAS/5/1");
  const Built list = build_text(with_line(deck, "/ADMAS/5/1", 2, reals({"3E-6"}) + integers({"30"})));
  EXPECT_DOUBLE_EQ(added_mass_at(list.model, 30), 3e-6);
  deck = with_line(base_starter, "/ADMAS/0/1", 0, "/ADMAS/6/1");
  const Built part = build_text(with_line(deck, "/ADMAS/6/1", 2, reals({"8E-6"}) + integers({"2"})));
  EXPECT_DOUBLE_EQ(added_mass_at(part.model, 9), 1e-6);
}

TEST(Conditions, AddedMassOfAGroupOfPartsFollowsTheirMasses) {
  // Two bricks of one material, the upper one twice as high: it takes two thirds of the mass, shared by its 8 nodes.
  std::string deck = base_starter;
  for (int k = 0; k < 4; ++k) {
    constexpr std::array<std::array<const char*, 2>, 4> xy{{{"0", "0"}, {"1", "0"}, {"1", "1"}, {"0", "1"}}};
    const auto i = static_cast<std::size_t>(k);
    deck = with_line(deck, "/NODE", 13 + k, integers({std::to_string(13 + k)}) + reals({xy[i][0], xy[i][1], "3.1"}));
  }
  deck = with_line(deck, "/ADMAS/0/1", 2, reals({"3E-6"}) + integers({"9"}));
  deck = with_line(deck, "/ADMAS/0/1", 0, "/GRPART/PART/9\nblocks\n" + integers({"1", "2"}) + "\n/ADMAS/3/1");
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  EXPECT_DOUBLE_EQ(added_mass_at(b.model, 1), 1e-6 / 8);
  EXPECT_DOUBLE_EQ(added_mass_at(b.model, 9), 2e-6 / 8);
}

TEST(Conditions, RigidBodyDefaultsAreExplicit) {
  const Built b = build_text(base_starter);
  const RigidBody& body = b.model.rigid_bodies.at(0);
  EXPECT_EQ(body.ispher, 2);
  EXPECT_EQ(body.icog, 1);
  EXPECT_FALSE(body.keep_in_walls);
  EXPECT_EQ(ids(b.model, body.nodes), (std::vector<Id>{13, 14, 15, 16}));
  EXPECT_TRUE(body.active);
}

TEST(Conditions, RigidBodyWithASensorTakesOnlyItsNodesFromTheCard) {
  const Built b = build_changed("/RBODY/1", 2, integers({"30", "1", "1", "1"}) + reals({"1E-6"}) + integers({"3", "0", "2", "0"}));
  ASSERT_FALSE(b.diagnostics.has_errors());
  const RigidBody& body = b.model.rigid_bodies.at(0);
  EXPECT_EQ(body.sensor, 0);
  EXPECT_EQ(body.mass, 0.0);
  EXPECT_EQ(body.skew, no_index);
  EXPECT_EQ(body.icog, 0);
  EXPECT_TRUE(body.keep_in_walls);
}

TEST(Conditions, WallTakesNodesWithinItsSearchDistanceOnItsPositiveSide) {
  const Built b = build_text(base_starter);  // plane z = -0.5 looking up, Dsearch 0.75
  const RigidWall& wall = b.model.rigid_walls.at(0);
  EXPECT_EQ(ids(b.model, wall.nodes), (std::vector<Id>{1, 2, 3, 4}));
  EXPECT_EQ(wall.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(wall.slide, 2);
  const Built exact = build_changed("/RWALL/PLANE/1", 3, reals({"0.5", ".2", "0", "0"}));
  EXPECT_EQ(exact.model.rigid_walls.at(0).nodes.size(), 4u);  // the limit itself counts
  const Built turned = build_changed("/RWALL/PLANE/1", 5, reals({"0", "0", "-1"}));
  EXPECT_TRUE(turned.model.rigid_walls.at(0).nodes.empty());
}

TEST(Conditions, WallGroupsAddAndRemoveNodes) {
  const Built b = build_changed("/RWALL/PLANE/1", 2, integers({"0", "0", "2", "3"}));
  ASSERT_FALSE(b.diagnostics.has_errors());
  EXPECT_EQ(ids(b.model, b.model.rigid_walls.at(0).nodes), (std::vector<Id>{1, 2, 3, 4, 9, 10, 11, 12, 30}));
}

TEST(Conditions, MovingWallStartsAtItsNode) {
  std::string deck = with_line(base_starter, "/RWALL/PLANE/1", 2, integers({"30", "1", "0", "0"}));
  deck = with_line(deck, "/RWALL/PLANE/1", 4, reals({"2E-6", "0", "0", "-5"}));
  deck = with_line(deck, "/RWALL/PLANE/1", 5, reals({".5", ".5", "13"}));
  deck = with_line(deck, "/RWALL/PLANE/1", 3, reals({"10", "0", "0", "0"}));
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors());
  const RigidWall& wall = b.model.rigid_walls.at(0);
  EXPECT_EQ(wall.point, (Vec3{.5, .5, 3}));
  EXPECT_EQ(wall.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(wall.velocity, (Vec3{0, 0, -5}));
  EXPECT_EQ(wall.mass, 2e-6);
  EXPECT_EQ(ids(b.model, wall.nodes), (std::vector<Id>{21, 22, 23, 24, 25, 26, 27, 28, 31}));  // its own node is not among them
}

TEST(Conditions, OldLayoutHasEightColumnsAndNoAbscissaScale) {
  const auto narrow = [](const std::vector<std::string>& fields) {
    std::string s;
    for (const std::string& f : fields) s += std::string(8 - f.size(), ' ') + f;
    return s;
  };
  const std::string deck =
      "#RADIOSS STARTER      44old                    0\n/NODE\n" + narrow({"1"}) + "             0.0             0.0             0.0\n" +
      narrow({"2"}) + "             1.0             0.0             0.0\n/ADMAS/0/1/mass\n             2.0" + narrow({"1"}) +
      "\n/GRNOD/NODE/1/all\n" + narrow({"1", "2"}) +
      "\n/FUNCT/1/ramp\n             0.0             0.0\n             1.0             1.0\n/BCS/1/clamp\n 110 001" + narrow({"0", "1"}) +
      "\n/CLOAD/1/pull\n" + narrow({"1", "Y", "0", "0"}) + "             5.0" + narrow({"1"}) + "\n/IMPVEL/1/push\n" +
      narrow({"1", "X", "0", "0", "1"}) +
      "\n             3.0             0.1             0.2\n/INIVEL/TRA/1/go\n             1.0             2.0             3.0" +
      narrow({"1"}) + "\n/END\n";
  const Built b = build_text(deck);
  ASSERT_FALSE(b.diagnostics.has_errors()) << b.messages().front();
  const Model& m = b.model;
  EXPECT_EQ(m.boundary_conditions.at(0).translation, (std::array{true, true, false}));
  EXPECT_EQ(m.boundary_conditions.at(0).rotation, (std::array{false, false, true}));
  EXPECT_EQ(m.concentrated_loads.at(0).scale_y, 5.0);
  EXPECT_EQ(m.concentrated_loads.at(0).nodes.size(), 2u);
  EXPECT_EQ(m.imposed_motions.at(0).scale_y, 3.0);
  EXPECT_EQ(m.imposed_motions.at(0).t_start, 0.1);
  EXPECT_EQ(m.imposed_motions.at(0).t_stop, 0.2);
  EXPECT_EQ(m.initial_velocities.at(0).value, (Vec3{1, 2, 3}));
  EXPECT_EQ(added_mass_at(m, 2), 2.0);
}

TEST(Measure, VolumesAndMassesOfElements) {
  const Built b = build_text(base_starter);
  EXPECT_DOUBLE_EQ(brick_volume(b.model, 0), 1.0);
  EXPECT_DOUBLE_EQ(shell_mass(b.model, 0), 7.8e-6 * 0.5);
  const std::vector<double> parts = part_masses(b.model);
  EXPECT_DOUBLE_EQ(parts.at(1), 7.8e-6);
  const std::vector<double> nodes = nodal_masses(b.model);
  EXPECT_DOUBLE_EQ(nodes.at(0), 7.8e-6 / 8);
}

}  // namespace
}  // namespace abut::model
