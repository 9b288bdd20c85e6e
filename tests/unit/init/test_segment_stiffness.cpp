// A surface's own stiffness per segment, from the model (T16, T17, T18; numerics.md 7.2.3).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "init/contact_stiffness.hpp"

namespace abut::init {
namespace {

/// A brick a x b x c of E = 6, nu = 0.25 (bulk modulus 4) with a shell (E = 5, t = 0.1) on its top face.
struct CoatedBrick {
  model::Model m;
  explicit CoatedBrick(double a, double b, double c) {
    for (const double z : {0.0, c}) {
      for (const Vec3 p : {Vec3{0, 0, z}, Vec3{a, 0, z}, Vec3{a, b, z}, Vec3{0, b, z}}) {
        m.node_id.push_back(static_cast<Id>(m.node_id.size()) + 1);
        m.node_x.push_back(p);
      }
    }
    m.materials = {{1, "", 1.0, 1.0, model::LawElastic{6.0, 0.25}}, {2, "", 1.0, 1.0, model::LawElastic{5.0, 0.3}}};
    model::ShellProperty shell;
    shell.thickness = 0.1;
    m.properties = {{1, "", model::SolidProperty{}}, {2, "", shell}};
    m.parts = {{1, "", 0, 0, 0.0}, {2, "", 1, 1, 0.0}};
    m.bricks.id = {1};
    m.bricks.part = {0};
    m.bricks.nodes = {{0, 1, 2, 3, 4, 5, 6, 7}};
    m.shells.id = {2};
    m.shells.part = {1};
    m.shells.nodes = {{4, 5, 6, 7}};
    m.shells.thickness = {0.0};
  }
  [[nodiscard]] double stiffness(model::ElementKind kind) const { return segment_stiffness(m, {{4, 5, 6, 7}, {kind, 0}}, m.node_x); }
};

// T17: B A^2/V = B A / height of a box.
TEST(SegmentStiffness, T17_brick_face) {
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{2, 3, 0.5}, Vec3{0.1, 0.2, 4}}) {
    const CoatedBrick brick(size.x, size.y, size.z);
    const double expected = 4.0 * size.x * size.y / size.z;
    EXPECT_NEAR(brick.stiffness(model::ElementKind::brick), expected, 1e-14 * expected);
  }
}

// T16: E t, whatever the size of the shell. T18: the reader names the shell behind a face that has both, so its value is used.
TEST(SegmentStiffness, T16_T18_shell) {
  for (const double size : {0.01, 1.0, 100.0})
    EXPECT_DOUBLE_EQ(CoatedBrick(size, 2 * size, 1.0).stiffness(model::ElementKind::shell4), 0.5);
}

// A node of TYPE7's surface: B (2 V)^(1/3), V its eighth of the brick, and E t of the shells at it.
TEST(NodeStiffness, OfANodeOfASolidWithAShell) {
  for (const Vec3 size : {Vec3{1, 1, 4}, Vec3{2, 3, 0.5}, Vec3{1e-3, 2e-3, 3e-3}}) {
    const CoatedBrick brick(size.x, size.y, size.z);
    const double solid = 4.0 * std::cbrt(size.x * size.y * size.z / 4.0);
    const std::vector<double> k = secondary_stiffness(brick.m, std::vector<Index>{0, 4}, brick.m.node_x);
    EXPECT_NEAR(k[0], solid, 4e-15 * solid);
    EXPECT_NEAR(k[1], solid + 0.5, 4e-15 * (solid + 0.5));
  }
}

/// A block of E = 6, nu = 0.25 (bulk modulus 4) on the corners of a unit cube, in the form the reader gives to degenerate solids.
struct DegenerateBlock {
  const char* name;
  std::array<Index, 8> nodes;
  std::size_t faces;
  [[nodiscard]] CoatedBrick model() const {
    CoatedBrick b(1, 1, 1);
    b.m.bricks.nodes = {nodes};
    b.m.shells = {};
    return b;
  }
};
const DegenerateBlock degenerate_blocks[] = {
    {"PENTA6", {0, 1, 2, 0, 4, 5, 6, 4}, 5}, {"pyramid", {0, 1, 2, 3, 4, 4, 4, 4}, 5}, {"BRICK with 4 nodes", {0, 0, 1, 1, 4, 2, 2, 4}, 4}};

// Sides that are collapsed to a line or a point are no faces; the faces that are left give the nodes their stiffness.
TEST(NodeStiffness, CollapsedSidesOfDegenerateSolidsAreNoFaces) {
  for (const DegenerateBlock& d : degenerate_blocks) {
    SCOPED_TRACE(d.name);
    const CoatedBrick block = d.model();
    const FaceOwners owners(block.m);
    EXPECT_EQ(owners.all().size(), d.faces);
    for (const auto& [key, elements] : owners.all()) {
      EXPECT_NE(key[2], no_index);
      const std::array<Index, 4> face = face_of(block.m, elements.front(), key);
      EXPECT_EQ(owners.of(face).size(), 1u);
    }
    const std::vector<Index> nodes(d.nodes.begin(), d.nodes.end());
    EXPECT_TRUE(owners.of({nodes[4], nodes[4], nodes[4], nodes[4]}).empty());
    double sum = 0.0;
    const std::vector<Index> eight{0, 1, 2, 3, 4, 5, 6, 7};
    for (const double k : node_stiffness(node_shares(block.m, owners, eight, block.m.node_x, 0.0), 8)) sum += k;
    EXPECT_GT(sum, 0.0);
    // B A^2/V of two triangles, two squares and the slanting side of half a cube.
    if (d.nodes[6] == 6) { EXPECT_NEAR(sum, 4.0 * (2 * 0.25 + 2 * 1.0 + 2.0) / 0.5, 1e-12); }
  }
}

TEST(SegmentStiffness, NothingBehindIsNoStiffness) { EXPECT_EQ(CoatedBrick(1, 1, 1).stiffness(model::ElementKind::none), 0.0); }

}  // namespace
}  // namespace abut::init
