// Nodes, parts, elements, functions, skews: deck-format.md B.
#include <gtest/gtest.h>

#include "fixture.hpp"
#include "model/topology.hpp"

namespace abut::model::testing {
namespace {

std::string head() { return std::string(begin_2022) + steel + shell_property + solid_property + shell_part + solid_part; }

/// Corners of the unit cube as nodes 1 to 8.
std::string cube() {
  std::string s = "/NODE\n";
  const std::array<std::array<const char*, 3>, 8> x{{{"0", "0", "0"},
                                                     {"1", "0", "0"},
                                                     {"1", "1", "0"},
                                                     {"0", "1", "0"},
                                                     {"0", "0", "1"},
                                                     {"1", "0", "1"},
                                                     {"1", "1", "1"},
                                                     {"0", "1", "1"}}};
  for (std::size_t k = 0; k < 8; ++k) s += node(static_cast<long>(k) + 1, x[k][0], x[k][1], x[k][2]);
  return s;
}

std::array<Vec3, 8> corners(const Model& m, std::size_t brick) {
  std::array<Vec3, 8> x;
  for (std::size_t k = 0; k < 8; ++k) x[k] = m.node_x[static_cast<std::size_t>(m.bricks.nodes[brick][k])];
  return x;
}

TEST(Mesh, TheOrderOfListingHasNoEffect) {
  Reading a;
  a.read(head() + cube() + "/SHELL/1\n" + ints({7, 1, 2, 3, 4}) + ints({9, 5, 6, 7, 8}));
  Reading b;
  b.read(std::string(begin_2022) + "/SHELL/1\n" + ints({9, 5, 6, 7, 8}) + "/NODE\n" + node(8, "0", "1", "1") + node(7, "1", "1", "1") +
         node(6, "1", "0", "1") + node(5, "0", "0", "1") + "/NODE\n" + node(4, "0", "1", "0") + node(3, "1", "1", "0") +
         node(2, "1", "0", "0") + node(1, "0", "0", "0") + solid_part + shell_part + "/SHELL/1\n" + ints({7, 1, 2, 3, 4}) + solid_property +
         shell_property + steel);
  EXPECT_EQ(b.errors(), Strings{});
  EXPECT_EQ(a.model.node_id, b.model.node_id);
  EXPECT_EQ(a.model.node_x, b.model.node_x);
  EXPECT_EQ(a.model.shells.id, b.model.shells.id);
  EXPECT_EQ(a.model.shells.nodes, b.model.shells.nodes);
  EXPECT_EQ(a.model.parts[0].title, b.model.parts[0].title);
  EXPECT_EQ(a.model.shells.part, b.model.shells.part);
}

TEST(Mesh, Surprise26ElementThicknessAndSolidsWithFourAndSixNodes) {
  Reading r;
  r.read(head() + cube() + "/SHELL/1\n" + field("1", 10) + ints({1, 2, 3, 4}).substr(0, 40) + std::string(10, ' ') + reals({"0", "0.02"}) +
         "/BRICK/2\n" + ints({1, 1, 2, 3, 4, 5, 6, 7, 8}) + ints({2, 1, 3, 2, 5}) + ints({3, 1, 2, 3, 5, 6, 7}) +
         ints({4, 1, 2, 3, 3, 5, 6, 7, 7}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.shells.thickness[0], 0.02);
  ASSERT_EQ(r.model.bricks.size(), 4);
  EXPECT_DOUBLE_EQ(one_point_volume(corners(r.model, 0)), 1.0);
  // tetrahedron n1 n2 n3 n4 = 1 3 2 5 as the brick (n1 n1 n2 n2 n4 n3 n3 n4)
  EXPECT_EQ(r.model.bricks.nodes[1], (std::array<Index, 8>{0, 0, 2, 2, 4, 1, 1, 4}));
  // pentahedron as the brick (n1 n2 n3 n1 n4 n5 n6 n4)
  EXPECT_EQ(r.model.bricks.nodes[2], (std::array<Index, 8>{0, 1, 2, 0, 4, 5, 6, 4}));
  EXPECT_EQ(r.model.bricks.nodes[3], (std::array<Index, 8>{0, 1, 2, 2, 4, 5, 6, 6}));
}

TEST(Mesh, NegativeVolumesAreTurned) {
  Reading r;
  r.read(head() + cube() + "/BRICK/2\n" + ints({1, 5, 6, 7, 8, 1, 2, 3, 4}) + ints({2, 1, 5, 2, 3}) + "/TETRA4/2\n" +
         ints({3, 1, 5, 2, 3}) + "/PENTA6/2\n" + ints({4, 5, 6, 7, 1, 2, 3}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.bricks.nodes[0], (std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(r.model.bricks.nodes[1], (std::array<Index, 8>{0, 0, 2, 2, 4, 1, 1, 4}));  // n2 and n4 exchanged
  EXPECT_EQ(r.model.tetras.nodes[0], (std::array<Index, 4>{0, 2, 1, 4}));
  EXPECT_EQ(r.model.bricks.nodes[2], (std::array<Index, 8>{0, 1, 2, 0, 4, 5, 6, 4}));
  EXPECT_GT(one_point_volume(corners(r.model, 0)), 0.0);
  EXPECT_EQ(r.messages(Severity::warning)[0],
            "t_0000.rad:34: warning: /BRICK/2: 2 elements with negative volume were turned inside out, the first is 1");
}

TEST(Mesh, BadElementsSayWhatWouldBeRight) {
  Reading r;
  r.read(head() + cube() + "/SHELL/1\n" + ints({1, 1, 2, 3, 99}) + ints({2, 1, 2, 1, 2}) + ints({3, 1, 2}) + ints({-4, 1, 2, 3, 4}) +
         "/BRICK/2\n" + ints({1, 1, 2, 3, 4, 1, 2, 3, 4}) + "/BRICK/1\n" + ints({5, 1, 2, 3, 4, 5, 6, 7, 8}) + "/SHELL/8\n" +
         ints({6, 1, 2, 3, 4}) + "/SHELL/1\n" + ints({7, 1, 2, 3, 4}) + ints({7, 1, 2, 3, 4}));
  EXPECT_EQ(
      r.errors(),
      (Strings{
          "t_0000.rad:35: /SHELL/1 field 'n4' (columns 41-50): no /NODE with id 99",
          "t_0000.rad:36: /SHELL/1 field 'n1-n4' (columns 11-50): element 2 has no area: its nodes must be distinct and not on one line",
          "t_0000.rad:37: /SHELL/1 field 'n3' (columns 31-40): element 3 lacks this node: a node id is needed",
          "t_0000.rad:37: /SHELL/1 field 'n4' (columns 41-50): element 3 lacks this node: a node id is needed",
          "t_0000.rad:38: /SHELL/1 field 'id' (columns 1-10): -4 is not an id: a positive integer is needed",
          "t_0000.rad:40: /BRICK/2 field 'n1-n8' (columns 11-90): element 1 has no volume: its nodes must not lie in one plane or coincide",
          "t_0000.rad:41: /BRICK/1: part 1 has property 1, which is not for solids: /PROP/SOLID is needed",
          "t_0000.rad:43: /SHELL/8: no /PART with id 8",
          "t_0000.rad:47: /SHELL/1: a second /SHELL with id 7 (the first is at t_0000.rad:46): ids must be unique",
      }));
}

TEST(Mesh, CrossedOrderOfNodesIsSaid) {
  Reading r;
  r.read(head() + cube() + "/SHELL/1\n" + ints({1, 1, 2, 4, 3}) + "/SURF/SEG/1\ns\n" + ints({1, 1, 2, 4, 3}) + ints({2, 1, 2, 1, 2}));
  const Strings errors = r.errors();
  ASSERT_EQ(errors.size(), 3u);
  const std::string crossed = "has no area: the order of its nodes is crossed: list them one after the other around its border";
  EXPECT_EQ(errors[0], "t_0000.rad:35: /SHELL/1 field 'n1-n4' (columns 11-50): element 1 " + crossed);
  EXPECT_EQ(errors[1], "t_0000.rad:38: /SURF/SEG/1 field 'n1-n4' (columns 11-50): the segment " + crossed);
  EXPECT_NE(errors[2].find("distinct and not on one line"), std::string::npos);
}

// Also where the area of the two halves is not the same; an arrow head is read, and said once for all.
TEST(Mesh, CrossedSidesAndCornersBeyondAStraightAngleAreSaid) {
  const std::string nodes = "/NODE\n" + node(1, "0", "0", "0") + node(2, "1", "0", "0") + node(3, "3", "2", "0") + node(4, "0", "1", "0") +
                            node(5, "0.9", "0.6", "0") + node(6, "1", "2", "0.5");
  Reading crossed;
  crossed.read(head() + nodes + "/SHELL/1\n" + ints({1, 1, 2, 4, 3}) + "/SURF/SEG/1\ns\n" + ints({1, 1, 2, 4, 3}));
  EXPECT_EQ(
      crossed.errors(),
      (Strings{"t_0000.rad:33: /SHELL/1 field 'n1-n4' (columns 11-50): sides of shell 1 cross: list its nodes one after the other around "
               "its border",
               "t_0000.rad:36: /SURF/SEG/1 field 'n1-n4' (columns 11-50): sides of the segment cross: list its nodes one after the other "
               "around its border"}));
  Reading arrow;
  arrow.read(head() + nodes + "/SHELL/1\n" + ints({1, 1, 2, 3, 4}) + ints({2, 5, 2, 3, 4}) + ints({3, 1, 2, 6, 4}) + ints({4, 2, 3, 4, 5}));
  EXPECT_EQ(arrow.errors(), Strings{});
  EXPECT_EQ(arrow.messages(Severity::warning),
            (Strings{"t_0000.rad:32: warning: /SHELL/1: 2 shells have a corner beyond 180 degrees, the first is 2: no "
                     "quadrilateral element is right there, make two triangles of each"}));
}

// A cube of which two nodes of a face change places, one node lies beyond the opposite one, or an edge is upside down; one that is only
// indented is read, and said once; a wedge has corners without volume.
TEST(Mesh, BricksThatFoldThroughThemselvesAreSaid) {
  const std::string nodes = cube() + node(9, "-0.3", "-0.3", "-0.3") + node(10, "1", "1", "-0.5") + node(11, "0.3", "0.3", "1");
  Reading folded;
  folded.read(head() + nodes + "/BRICK/2\n" + ints({1, 1, 2, 4, 3, 5, 6, 7, 8}) + ints({2, 1, 2, 3, 4, 5, 6, 9, 8}) +
              ints({3, 1, 2, 3, 4, 5, 6, 10, 8}) + ints({4, 6, 5, 8, 7, 2, 1, 3, 4}) + ints({5, 1, 2, 3, 4, 5, 6, 7, 8}));
  const auto message = [](int line, int id, int corners) {
    return "t_0000.rad:" + std::to_string(line) + ": /BRICK/2 field 'n1-n8' (columns 11-90): brick " + std::to_string(id) +
           " folds through itself (" + std::to_string(corners) +
           " of its corners are inside out): list the nodes of one face one after the other around its border, then those of the opposite "
           "face in the same order, and look where its nodes lie";
  };
  EXPECT_EQ(folded.errors(), (Strings{message(38, 1, 2), message(39, 2, 4), message(40, 3, 2), message(41, 4, 2)}));
  Reading indented;
  indented.read(head() + nodes + "/BRICK/2\n" + ints({1, 1, 2, 3, 4, 5, 6, 11, 8}) + ints({2, 1, 2, 3, 4, 5, 6, 7, 8}) +
                ints({3, 1, 2, 3, 3, 5, 6, 7, 7}) + ints({4, 5, 6, 7, 8, 1, 2, 3, 4}));
  EXPECT_EQ(indented.errors(), Strings{});
  EXPECT_EQ(indented.messages(Severity::warning)[1],
            "t_0000.rad:37: warning: /BRICK/2: 1 bricks have a corner that is turned inside out, the first is 1: no brick is right there, "
            "mesh it anew");
  ASSERT_EQ(indented.messages(Severity::warning).size(), 2u);
}

TEST(Mesh, BadNodesSayWhatWouldBeRight) {
  Reading r;
  r.read(std::string(begin_2022) + "/NODE\n" + node(1, "1.2.3", "0", "0") + node(1, "0", "0", "0") + node(0, "0", "0", "0") +
         node(-3, "0", "0", "0") + "       abc                   0                   0                   0\n\n" +
         node(9, "1e999", "&gap", "0"));
  EXPECT_EQ(r.errors(),
            (Strings{
                "t_0000.rad:7: /NODE field 'X' (columns 11-30): '1.2.3' is not a real number",
                "t_0000.rad:9: /NODE field 'node_ID' (columns 1-10): 0 is not an id: a positive integer is needed",
                "t_0000.rad:10: /NODE field 'node_ID' (columns 1-10): -3 is not an id: a positive integer is needed",
                "t_0000.rad:11: /NODE field 'node_ID' (columns 1-10): 'abc' is not an integer",
                "t_0000.rad:13: /NODE field 'X' (columns 11-30): '1e999' is not a real number",
                "t_0000.rad:13: /NODE field 'Y' (columns 31-50): '&gap' refers to a /PARAMETER, which is not supported: write the number",
                "t_0000.rad:8: /NODE: a second /NODE with id 1 (the first is at t_0000.rad:7): ids must be unique",
            }));
}

TEST(Mesh, PartsNeedAPropertyAndElementsAMaterial) {
  Reading r;
  r.read(std::string(begin_2022) + steel + shell_property +
         "/PART/1\na\n         0         1\n/PART/2\nb\n         7         8\n/PART/3\nc\n         1\n" + cube() + "/SHELL/3\n" +
         ints({1, 1, 2, 3, 4}) + "/PART/x\nd\n         1         1\n");
  EXPECT_EQ(r.errors(), (Strings{
                            "t_0000.rad:17: /PART/1 field 'prop_ID' (columns 1-10): a part needs a property: the id of a /PROP block",
                            "t_0000.rad:20: /PART/2 field 'prop_ID' (columns 1-10): no /PROP with id 7",
                            "t_0000.rad:20: /PART/2 field 'mat_ID' (columns 11-20): no /MAT with id 8",
                            "t_0000.rad:35: /PART/x: 'x' is not an id: a positive integer is needed",
                            "t_0000.rad:33: /SHELL/3: part 3 has elements but no material: give it a mat_ID",
                        }));
}

TEST(Mesh, DegenerateShellIsATriangleWithAWarning) {
  Reading r;
  r.read(head() + cube() + "/SHELL/1\n" + ints({1, 1, 2, 3, 3}) + ints({2, 1, 2, 3}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.shells.nodes[0], (std::array<Index, 4>{0, 1, 2, 2}));
  EXPECT_EQ(r.model.shells.nodes[1], (std::array<Index, 4>{0, 1, 2, 2}));
  EXPECT_EQ(r.diagnostics.warning_count(), 2);
}

TEST(Mesh, IdsMayBeHugeAndSparse) {
  Reading r;
  r.read(head() + "/NODE\n" + node(1, "0", "0", "0") + node(999999999, "1", "0", "0") + node(2147483648L, "1", "1", "0") +
         node(5, "0", "1", "0") + "/SHELL/1\n" + ints({9999999999L, 1, 999999999, 2147483648L, 5}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.shells.nodes[0], (std::array<Index, 4>{0, 2, 3, 1}));
}

TEST(Functions, MoveFunctionScalesShiftsAndReverses) {
  Reading r;
  r.read(std::string(begin_2022) + "/FUNCT/4\nf\n" + reals({"0", "1"}) + reals({"2", "5"}) + "/MOVE_FUNCT/4\nm\n" +
         reals({"-1", "0", "3", "10"}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.functions[0].x, (std::vector<double>{1.0, 3.0}));
  EXPECT_EQ(r.model.functions[0].y, (std::vector<double>{15.0, 11.0}));
}

TEST(Functions, AFunctionIsMovedOnce) {
  Reading r;
  const std::string move = "/MOVE_FUNCT/4\nm\n" + reals({"0", "2"});
  r.read(std::string(begin_2022) + "/FUNCT/4\nf\n" + reals({"0", "1"}) + reals({"2", "5"}) + move + move);
  EXPECT_EQ(r.errors(),
            (Strings{"t_0000.rad:13: /MOVE_FUNCT/4: a second /MOVE_FUNCT with id 4 (the first is at t_0000.rad:10): ids must be unique"}));
}

TEST(Functions, Surprise9MissingFieldsOfMoveFunctionAreZero) {
  Reading r;
  r.read(std::string(begin_2022) + "/FUNCT/4\nf\n" + reals({"0", "1"}) + reals({"2", "5"}) + "/MOVE_FUNCT/4\nm\n" + reals({"2"}));
  EXPECT_EQ(r.model.functions[0].x, (std::vector<double>{0.0, 4.0}));
  EXPECT_EQ(r.model.functions[0].y, (std::vector<double>{1.0, 5.0}));
}

TEST(Functions, PointsAscendAndAreAtLeastTwo) {
  Reading r;
  r.read(std::string(begin_2022) + "/FUNCT/4\nf\n" + reals({"1", "1"}) + reals({"1", "5"}) + "/FUNCT/5\nf\n" + reals({"1", "1"}) +
         "/MOVE_FUNCT/6\n");
  EXPECT_EQ(
      r.errors(),
      (Strings{
          "t_0000.rad:9: /FUNCT/4 field 'X' (columns 1-20): abscissa 1 is not larger than the one before, 1: points go in ascending order",
          "t_0000.rad:10: /FUNCT/5: 1 points: a function needs at least 2",
          "t_0000.rad:13: /MOVE_FUNCT/6: no /FUNCT with id 6 to move",
      }));
}

TEST(Skews, FixedAxesKeepZAndRebuildTheOthers) {
  Reading r;
  r.read(std::string(begin_2022) + "/SKEW/FIX/3\ns\n" + reals({"9", "9", "9"}) + reals({"0", "2", "1"}) + reals({"0", "0", "4"}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.skews[0].axes[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(r.model.skews[0].axes[1], (Vec3{0, 1, 0}));
  EXPECT_EQ(r.model.skews[0].axes[2], (Vec3{0, 0, 1}));
}

TEST(Skews, BeforeVersion120ThereIsNoOriginCard) {
  Reading r;
  r.read("/BEGIN\nx\n       110         0\n/SKEW/FIX/3\ns\n" + reals({"0", "0", "1"}) + reals({"-1", "0", "0"}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.skews[0].axes[2], (Vec3{-1, 0, 0}));
  EXPECT_EQ(r.model.skews[0].axes[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(r.model.skews[0].axes[0], (Vec3{0, -1, 0}));
}

// What a card too few or too many looks like.
TEST(Skews, OneVectorAloneIsNamed) {
  const std::string old = "/BEGIN\nx\n       110         0\n";
  const auto said = [](const std::string& text) {
    Reading r;
    r.read(text);
    EXPECT_EQ(r.errors(), Strings{});
    const Strings warnings = r.messages(Severity::warning);
    return warnings.empty() ? std::string() : warnings.front();
  };
  const std::string y = reals({"0", "0", "1"}), z = reals({"-1", "0", "0"}), none = "\n";
  EXPECT_EQ(said(std::string(begin_2022) + "/SKEW/FIX/3\ns\n" + none + z + none),
            "t_0000.rad:6: warning: /SKEW/FIX/3 field 'Z'' (columns 1-60): only y' is given, z' is taken as the global Z axis; from "
            "version 120 on "
            "three cards are read, the origin first, then y' and z': is one missing?");
  EXPECT_EQ(
      said(old + "/SKEW/FIX/3\ns\n" + none + z),
      "t_0000.rad:7: warning: /SKEW/FIX/3 field 'Y'' (columns 1-60): only z' is given, y' is taken as the global Y axis; up to version 110 "
      "two cards are read, y' and z', without an origin: is one too many?");
  EXPECT_EQ(said(old + "/SKEW/FIX/3\ns\n" + y + z), "");
  EXPECT_EQ(said(old + "/SKEW/FIX/3\ns\n" + none + none), "");
  EXPECT_EQ(said(old + "/SKEW/FIX/3\ns\n" + reals({"0", "2", "0"}) + none), "");
  EXPECT_EQ(said(old + "/SKEW/FIX/3\ns\n" + none + reals({"0", "0", "3"})), "");
}

TEST(Skews, VectorsOfAnyLength) {
  Reading r;
  r.read(std::string(begin_2022) + "/SKEW/FIX/3\ns\n\n" + reals({"0", "0", "1e200"}) + reals({"-1e-200", "0", "0"}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.skews[0].axes[0], (Vec3{0, -1, 0}));
  EXPECT_EQ(r.model.skews[0].axes[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(r.model.skews[0].axes[2], (Vec3{-1, 0, 0}));
}

TEST(Skews, MovingAxesFollowThreeNodesInEveryDirection) {
  Reading r;
  r.read(std::string(begin_2022) + cube() + "/SKEW/MOV/1\ns\n" + ints({1, 2, 3}) + "/SKEW/MOV/2\ns\n" + ints({1, 2, 3}).substr(0, 30) +
         "         Y\n/SKEW/MOV2/3\ns\n" + ints({1, 5, 2}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.model.skews[0].axes[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(r.model.skews[0].axes[1], (Vec3{0, 1, 0}));
  EXPECT_EQ(r.model.skews[0].axes[2], (Vec3{0, 0, 1}));
  // direction Y: y' = N1N2 = X; z0 = N1N3 = X + Y; x' = y' x z0 = Z; z' = x' x y' = Y
  EXPECT_EQ(r.model.skews[1].axes[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(r.model.skews[1].axes[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(r.model.skews[1].axes[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(r.model.skews[2].direction, 2);
  EXPECT_EQ(r.model.skews[2].axes[2], (Vec3{0, 0, 1}));
  EXPECT_EQ(r.model.skews[2].axes[0], (Vec3{1, 0, 0}));
}

TEST(Skews, DegenerateAxesAreErrors) {
  Reading r;
  r.read(std::string(begin_2022) + cube() + "/SKEW/MOV/1\ns\n" + ints({1, 2, 2}) + "/SKEW/MOV/2\ns\n" + ints({1, 2}) +
         "/SKEW/FIX/3\ns\n\n" + reals({"1"}) + reals({"2"}) + "/SKEW/OLD/4\n");
  EXPECT_EQ(r.errors(),
            (Strings{
                "t_0000.rad:17: /SKEW/MOV/1 field 'node_ID3' (columns 1-30): the three nodes lie on one line: they must span a plane",
                "t_0000.rad:20: /SKEW/MOV/2 field 'node_ID3' (columns 21-30): a moving skew needs three nodes",
                "t_0000.rad:25: /SKEW/FIX/3 field 'Z'' (columns 1-60): the vectors of y' and z' are parallel: they must span a plane",
                "t_0000.rad:26: /SKEW/OLD/4: the types of /SKEW are FIX, MOV and MOV2",
            }));
}

}  // namespace
}  // namespace abut::model::testing
