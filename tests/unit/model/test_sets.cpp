// Groups, boxes, surfaces and sets: deck-format.md C.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fixture.hpp"
#include "model/topology.hpp"

namespace abut::model::testing {
namespace {

using Nodes = std::vector<Index>;

/// n x n x n unit cubes; nodes and bricks numbered from 1 along x, then y, then z. The lowest layer is part 2, the others part 3.
/// Shells 1001 ... of part 1 lie on the plane z = 0 with normals along +z.
std::string blocks(int n) {
  std::string s = std::string(begin_2022) + steel + shell_property + solid_property + shell_part + solid_part +
                  "/PART/3\nupper\n         2         1         6\n/NODE\n";
  const auto id = [n](int i, int j, int k) { return 1 + i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) s += node(id(i, j, k), std::to_string(i), std::to_string(j), std::to_string(k));
    }
  }
  long e = 0;
  for (int k = 0; k < n; ++k) {
    s += k == 0 ? "/BRICK/2\n" : "/BRICK/3\n";
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        s += ints({++e, id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1), id(i + 1, j, k + 1),
                   id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)});
      }
    }
  }
  s += "/SHELL/1\n";
  e = 1000;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) s += ints({++e, id(i, j, 0), id(i + 1, j, 0), id(i + 1, j + 1, 0), id(i, j + 1, 0)});
  }
  return s;
}

const Nodes& group(const Reading& r, Id id) {
  return r.model.node_groups[static_cast<std::size_t>(r.context.tables.node_groups.at(id))].nodes;
}
const std::vector<Segment>& surface(const Reading& r, Id id) {
  return r.model.surfaces[static_cast<std::size_t>(r.context.tables.surfaces.at(id))].segments;
}

/// Sum of x . n dA over the segments, a third of it: the enclosed volume if they are closed and outward.
double enclosed_volume(const Reading& r, const std::vector<Segment>& segments) {
  double v = 0.0;
  for (const Segment& s : segments) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = r.model.node_x[static_cast<std::size_t>(s.nodes[k])];
    const Vec3 area = 0.5 * cross(x[2] - x[0], x[3] - x[1]);
    const bool triangle = s.nodes[2] == s.nodes[3];
    const Vec3 centre = triangle ? (x[0] + x[1] + x[2]) / 3.0 : 0.25 * (x[0] + x[1] + x[2] + x[3]);
    v += dot(centre, area) / 3.0;
  }
  return v;
}

TEST(Groups, NodeListsSkipRepetitionsAndSort) {
  Reading r;
  r.read(blocks(1) + "/GRNOD/NODE/5\ng\n" + ints({3, 1, 0, 3}) + "\n" + ints({2, 7777}) + "/GRNOD/NODENS/6\ng\n" + ints({8, 7}) +
         "/SUBSET/6\nupper\n");
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(group(r, 5), (Nodes{0, 1, 2}));
  EXPECT_EQ(group(r, 6), (Nodes{6, 7}));
  EXPECT_EQ(r.messages(Severity::warning), Strings{"t_0000.rad:41: warning: /GRNOD/NODE/5: no /NODE with id 7777: left out"});
}

TEST(Groups, Surprise22NestingExclusionAndRangesInAnyOrder) {
  Reading r;
  r.read(blocks(1) + "/GRNOD/GRNOD/1\ng\n" + ints({2, -3}) + "/GRNOD/GENE/2\ng\n" + ints({1, 999999999}) + "/GRNOD/NODE/3\ng\n" +
         ints({1, 2}) + "/GRNOD/GEN_INCR/4\ng\n" + ints({2, 8, 3}) + "/GRNOD/PART/5\ng\n" + ints({2, -1}) + "/GRNOD/MAT/6\ng\n" +
         ints({1}) + "/GRNOD/GRNOD/7\ng\n" + ints({1, 3, -4}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(group(r, 1), (Nodes{2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(group(r, 2).size(), 8u);
  EXPECT_EQ(group(r, 4), (Nodes{1, 4, 7}));
  EXPECT_EQ(group(r, 5), (Nodes{4, 5, 6, 7}));
  EXPECT_EQ(group(r, 6).size(), 8u);
  EXPECT_EQ(group(r, 7), (Nodes{0, 2, 3, 5, 6}));
}

TEST(Groups, CyclesAndUnknownTypesAreErrors) {
  Reading r;
  r.read(std::string(begin_2022) + "/GRNOD/GRNOD/1\ng\n" + ints({2}) + "/GRNOD/GRNOD/2\ng\n" + ints({1}) +
         "/GRNOD/LINE/3\ng\n/GRSHEL/BRIC/4\ng\n/GRNOD/NODE/1\ng\n" + "/GRNOD/GENE/9\ng\n" + ints({5, 3}));
  EXPECT_EQ(
      r.errors(),
      (Strings{
          "t_0000.rad:16: /GRNOD/NODE/1: a second /GRNOD with id 1 (the first is at t_0000.rad:6): ids must be unique",
          "t_0000.rad:6: /GRNOD/GRNOD/1: the set contains itself, or sets are nested too deeply",
          "t_0000.rad:12: /GRNOD/LINE/3: type 'LINE' of /GRNOD is not supported: NODE, GENE, GEN_INCR, PART, SUBSET, MAT, PROP, GRNOD, "
          "GRSHEL, GRSH3N, GRBRIC, "
          "SURF and BOX are",
          "t_0000.rad:14: /GRSHEL/BRIC/4: type 'BRIC' of /GRSHEL is not supported: SHEL, GENE, GEN_INCR, PART, SUBSET, MAT, PROP, GRSHEL, "
          "BOX and BOX2 are",
          "t_0000.rad:20: /GRNOD/GENE/9 field 'last' (columns 11-20): the range 5 to 3 is empty: it goes from a smaller to a larger id"}));
}

TEST(Groups, DeepNestingEndsWithAMessage) {
  std::string text = begin_2022;
  for (long k = 1; k < 3000; ++k) text += "/GRNOD/GRNOD/" + std::to_string(k) + "\ng\n" + ints({k + 1});
  Reading r;
  r.read(text);
  EXPECT_TRUE(r.diagnostics.has_errors());
}

TEST(Groups, SubsetsAreATree) {
  Reading r;
  r.read(blocks(2) + "/SUBSET/4\nroot\n" + ints({5, 6}) + "/SUBSET/5\nchild\n/SUBSET/6\nchild\n/GRPART/SUBSET/1\ng\n" + ints({4}) +
         "/GRNOD/SUBSET/2\ng\n" + ints({4}) + "/GRBRIC/SUBSET/3\ng\n" + ints({6}) + "/SUBSET/9\nempty\n");
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.context.part_groups[0].members, (Nodes{2}));
  EXPECT_EQ(group(r, 2).size(), 18u);
  EXPECT_EQ(r.context.brick_groups[0].members, (Nodes{4, 5, 6, 7}));
  EXPECT_EQ(r.messages(Severity::warning), Strings{});
}

TEST(Groups, SubsetsThatHoldThemselvesAreErrors) {
  Reading r;
  r.read(blocks(2) + "/SUBSET/6\nof a part\n/SUBSET/4\nround\n" + ints({5, 6}) + "/SUBSET/5\nround\n" + ints({7}) + "/SUBSET/7\nround\n" +
         ints({6, 4}) + "/SUBSET/8\nholds a round\n" + ints({4, 6}) + "/SUBSET/9\nitself\n" + ints({9}) + "/GRNOD/SUBSET/1\ng\n" +
         ints({8}));
  EXPECT_EQ(r.errors(),
            (Strings{"t_0000.rad:73: /SUBSET/4: the subset contains itself", "t_0000.rad:85: /SUBSET/9: the subset contains itself"}));
  EXPECT_EQ(group(r, 1).size(), 18u);
}

// What stands in a group is the same with and without the definition of a subset that parts name; that it is missing is said.
TEST(Groups, SubsetsThatAreNotDefinedAreNamed) {
  Reading r;
  r.read(blocks(2) + "/SUBSET/4\nroot\n" + ints({6, 60}) + "/GRBRIC/SUBSET/3\ng\n" + ints({4}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.context.brick_groups[0].members, (Nodes{4, 5, 6, 7}));
  EXPECT_EQ(
      r.messages(Severity::warning),
      (Strings{"t_0000.rad:71: warning: /SUBSET/4: no /SUBSET with id 6: it is taken as that of the parts that name it",
               "t_0000.rad:71: warning: /SUBSET/4: no /SUBSET with id 60: left out",
               "t_0000.rad:27: warning: /PART/3 field 'subset_ID' (columns 21-30): no /SUBSET with id 6: parts that name it are reached by "
               "this id alone"}));
}

TEST(Boxes, EveryShapeHoldsItsBoundary) {
  Reading r;
  r.read(blocks(2) + "/SKEW/FIX/1\ns\n\n" + reals({"-1", "1", "0"}) + reals({"0", "0", "1"}) + "/BOX/RECTA/1\nb\n\n" +
         reals({"1", "1", "1"}) + reals({"0", "0", "0"}) + "/BOX/SPHER/2\nb\n" + field("14", 10) + field("2", 40) + "\n\n" +
         "/BOX/CYLIN/3\nb\n" + ints({1, 19}).substr(0, 20) + field("2.0", 30) + "\n\n\n" + "/BOX/BOX/4\nb\n" + ints({1, -2}) +
         "/BOX/RECTA/5\nb\n" + ints({0, 0, 1}) + reals({"0", "0", "0"}) + reals({"0", "2", "2"}) + "/GRNOD/BOX/1\ng\n" + ints({1}) +
         "/GRNOD/BOX/2\ng\n" + ints({2}) + "/GRNOD/BOX/3\ng\n" + ints({3}) + "/GRNOD/BOX/4\ng\n" + ints({4}) + "/GRNOD/BOX/5\ng\n" +
         ints({5}) + "/GRBRIC/BOX/1\ng\n" + ints({1}) + "/GRBRIC/BOX2/2\ng\n" + ints({1}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(group(r, 1), (Nodes{0, 1, 3, 4, 9, 10, 12, 13}));
  EXPECT_EQ(group(r, 2), (Nodes{4, 10, 12, 13, 14, 16, 22}));       // the centre and its six neighbours
  EXPECT_EQ(group(r, 3), (Nodes{0, 1, 3, 9, 10, 12, 18, 19, 21}));  // axis along z through the origin, radius 1
  EXPECT_EQ(group(r, 4), (Nodes{0, 1, 3, 9}));
  // edges along (1,1,0)/sqrt2, (-1,1,0)/sqrt2: corners (0,0,0) and (0,2,2) span a square with corner (1,1) and (-1,1)
  EXPECT_EQ(group(r, 5), (Nodes{0, 3, 4, 6, 9, 12, 13, 15, 18, 21, 22, 24}));
  EXPECT_EQ(r.context.brick_groups[0].members, (Nodes{0}));
  EXPECT_EQ(r.context.brick_groups[1].members.size(), 8u);
}

TEST(Boxes, BoxesOfBoxesMustEnd) {
  Reading r;
  r.read(blocks(1) + "/BOX/BOX/1\nb\n" + ints({2, 2}) + "/BOX/BOX/2\nb\n" + ints({1, 8}) + "/GRNOD/BOX/1\ng\n" + ints({1}));
  EXPECT_EQ(r.errors().size(), 2u);
  EXPECT_EQ(r.errors()[1], "t_0000.rad:44: /BOX/BOX/2: no /BOX with id 8");
}

TEST(Surfaces, ShellsKeepTheirOrderAndNegativePartsAreReversed) {
  Reading r;
  r.read(blocks(1) + "/SH3N/1\n" + ints({1, 5, 6, 7}) + "/SURF/PART/1\ns\n" + ints({1}) + "/SURF/PART/2\ns\n" + ints({-1}) +
         "/SURF/PART/3\ns\n" + ints({-1, 1}) + "/GRSHEL/SHEL/1\ng\n" + ints({1001}) + "/SURF/GRSHEL/4\ns\n" + ints({-1}) +
         "/GRSH3N/SH3N/1\ng\n" + ints({1}) + "/SURF/GRSH3N/5\ns\n" + ints({-1}) + "/SURF/SURF/6\ns\n" + ints({-2}));
  EXPECT_EQ(r.errors(), Strings{});
  using Quad = std::array<Index, 4>;
  EXPECT_EQ(surface(r, 1)[0].nodes, (Quad{0, 1, 3, 2}));
  EXPECT_EQ(surface(r, 1)[1].nodes, (Quad{4, 5, 6, 6}));
  EXPECT_EQ(surface(r, 2)[0].nodes, (Quad{2, 3, 1, 0}));
  EXPECT_EQ(surface(r, 2)[1].nodes, (Quad{6, 5, 4, 4}));
  EXPECT_EQ(surface(r, 3)[0].nodes, (Quad{0, 1, 3, 2}));  // both signs: positive
  EXPECT_EQ(surface(r, 4)[0].nodes, (Quad{2, 3, 1, 0}));
  EXPECT_EQ(surface(r, 5)[0].nodes, (Quad{6, 5, 4, 4}));
  EXPECT_EQ(surface(r, 6)[0].nodes, (Quad{0, 1, 3, 2}));
  EXPECT_EQ(surface(r, 1)[0].element.kind, ElementKind::shell4);
  EXPECT_EQ(surface(r, 2)[1].element.kind, ElementKind::shell3);
}

TEST(Surfaces, ExternalFacesAreClosedAndOutward) {
  Reading r;
  r.read(blocks(3) + "/SURF/PART/EXT/1\ns\n" + ints({2, 3}) + "/SURF/PART/EXT/2\ns\n" + ints({2}) + "/SURF/PART/ALL/3\ns\n" + ints({2, 3}) +
         "/SURF/SUBSET/EXT/4\ns\n" + ints({6}) + "/SURF/MAT/EXT/5\ns\n" + ints({1}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(surface(r, 1).size(), 54u);
  EXPECT_DOUBLE_EQ(enclosed_volume(r, surface(r, 1)), 27.0);
  EXPECT_EQ(surface(r, 2).size(), 30u);  // the side to part 3, which is not listed, is external
  EXPECT_DOUBLE_EQ(enclosed_volume(r, surface(r, 2)), 9.0);
  EXPECT_EQ(surface(r, 3).size(), 6u * 27u);
  EXPECT_NEAR(enclosed_volume(r, surface(r, 3)), 27.0, 1e-12);
  EXPECT_DOUBLE_EQ(enclosed_volume(r, surface(r, 4)), 18.0);
  // With the shell part listed, its shells supply the bottom, inward as they are: 45 faces and 9 shells.
  EXPECT_EQ(surface(r, 5).size(), 54u);
  EXPECT_EQ(
      std::count_if(surface(r, 5).begin(), surface(r, 5).end(), [](const Segment& s) { return s.element.kind == ElementKind::shell4; }), 9);
}

TEST(Surfaces, DegenerateBricksAndTetrahedraHaveTheirTrueFaces) {
  Reading r;
  r.read(blocks(1) + "/BRICK/3\n" + ints({11, 1, 3, 2, 5}) + ints({12, 1, 2, 3, 5, 6, 7}) + "/TETRA4/3\n" + ints({13, 1, 3, 2, 5}) +
         "/GRBRIC/BRIC/1\ng\n" + ints({11}) + "/GRBRIC/BRIC/2\ng\n" + ints({12}) + "/GRBRIC/BRIC/3\ng\n" + ints({13}) +
         "/SURF/GRBRIC/EXT/1\ns\n" + ints({1}) + "/SURF/GRBRIC/EXT/2\ns\n" + ints({2}) + "/SURF/GRBRIC/EXT/3\ns\n" + ints({3}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(surface(r, 1).size(), 4u);
  EXPECT_NEAR(enclosed_volume(r, surface(r, 1)), 1.0 / 6.0, 1e-15);
  EXPECT_EQ(surface(r, 2).size(), 5u);
  EXPECT_NEAR(enclosed_volume(r, surface(r, 2)), 0.5, 1e-15);
  EXPECT_EQ(surface(r, 3).size(), 4u);
  EXPECT_NEAR(enclosed_volume(r, surface(r, 3)), 1.0 / 6.0, 1e-15);
  EXPECT_EQ(surface(r, 3)[0].element.kind, ElementKind::tetra);
}

TEST(Surfaces, GroupFacesAreExternalToTheGroupFreeOnesToTheModel) {
  Reading r;
  r.read(blocks(2) + "/GRBRIC/BRIC/1\ng\n" + ints({1, 2}) + "/SURF/GRBRIC/EXT/1\ns\n" + ints({1}) + "/SURF/GRBRIC/FREE/2\ns\n" + ints({1}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(surface(r, 1).size(), 10u);
  EXPECT_EQ(surface(r, 2).size(), 6u);  // two bricks at an edge of the block: y = 0 and z = 0 twice, both ends
}

TEST(Surfaces, SegmentsFindTheElementBehindThem) {
  Reading r;
  r.read(blocks(2) +
         "/PROP/SHELL/7\nthick\n         0\n                   0\n         0         0                 .05\n/PART/7\nthick\n         7     "
         "    1\n/SHELL/7\n" +
         ints({2001, 4, 5, 2, 1}) + "/SURF/SEG/1\ns\n" + ints({0, 1, 2, 5, 4}) + ints({2, 2, 3, 6, 5}) + ints({3, 19, 20, 23, 22}) +
         ints({4, 1, 2, 27}) + ints({1, 10, 11, 14, 13}));
  EXPECT_EQ(r.errors(), Strings{});
  const auto& s = surface(r, 1);
  ASSERT_EQ(s.size(), 5u);
  EXPECT_EQ(s[0].element.kind, ElementKind::shell4);                                 // T18: a shell wins over the brick,
  EXPECT_EQ(r.model.shells.id[static_cast<std::size_t>(s[0].element.index)], 2001);  // the thicker shell over the other
  EXPECT_EQ(r.model.shells.id[static_cast<std::size_t>(s[1].element.index)], 1002);
  EXPECT_EQ(s[2].element.kind, ElementKind::brick);
  EXPECT_EQ(r.model.bricks.id[static_cast<std::size_t>(s[2].element.index)], 5);
  EXPECT_EQ(s[3].element.kind, ElementKind::none);
  EXPECT_EQ(s[3].nodes[3], s[3].nodes[2]);
  EXPECT_EQ(s[4].element.kind, ElementKind::brick);
}

TEST(Surfaces, FaultsSayWhatWouldBeRight) {
  Reading r;
  r.read(blocks(1) + "/SURF/SEG/1\ns\n" + ints({1, 1, 2}) + ints({2, 1, 2, 99, 4}) + ints({3, 1, 2, 1, 2}) + "/SURF/PART/2\ns\n" +
         ints({2}) + "/SURF/GRBRIC/3\ns\n" + "/SURF/PLANE/4\ns\n/SURF/PART/EXT/x\n");
  EXPECT_EQ(r.errors(),
            (Strings{"t_0000.rad:43: /SURF/SEG/1 field 'n3' (columns 31-40): a segment needs three or four nodes; the first field is the "
                     "segment's own id",
                     "t_0000.rad:44: /SURF/SEG/1 field 'n3' (columns 31-40): no /NODE with id 99",
                     "t_0000.rad:45: /SURF/SEG/1 field 'n1-n4' (columns 11-50): the segment has no area: its nodes must be distinct and "
                     "not on one line",
                     "t_0000.rad:46: /SURF/PART/2: part 2 holds solids: use /SURF/.../EXT for their outer faces or /SURF/.../ALL for all",
                     "t_0000.rad:49: /SURF/GRBRIC/3: /SURF/GRBRIC needs a choice of faces: /SURF/GRBRIC/EXT or /SURF/GRBRIC/FREE",
                     "t_0000.rad:51: /SURF/PLANE/4: type 'PLANE' of /SURF is not supported: SEG, PART, SUBSET, MAT, PROP (with /EXT or "
                     "/ALL for solids), GRSHEL, GRSH3N, "
                     "GRBRIC/EXT, GRBRIC/FREE, SURF and BOX are",
                     "t_0000.rad:53: /SURF/PART/EXT/x: 'x' is not an id: a positive integer is needed"}));
}

TEST(GeneralSets, Surprise21OneSetServesAsGroupAndSurface) {
  Reading r;
  r.read(blocks(2) +
         "/SET/GENERAL/5\ns\nPART               2\nNODE              27\n/SET/GENERAL/6\ns\nPART_A             2\nNODE_D             1     "
         "    2\n                   3\n" +
         "/SET/GENERAL/7\ns\nSHELL_O         1001\nSEG                1         1         2         5         "
         "4\n/SET/GENERAL/8\ns\nALL\nPART_D             1\n" +
         "/SET/GENERAL/9\ns\nSET                5\nSOLID_D            1\n/GRNOD/GRNOD/77\nof a set\n" + ints({5}));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(group(r, 5).size(), 19u);
  EXPECT_EQ(group(r, 77), group(r, 5));
  EXPECT_EQ(surface(r, 5).size(), 16u);
  EXPECT_DOUBLE_EQ(enclosed_volume(r, surface(r, 5)), 4.0);
  EXPECT_EQ(surface(r, 6).size(), 24u);
  EXPECT_EQ(group(r, 6).size(), 15u);
  ASSERT_EQ(surface(r, 7).size(), 2u);
  EXPECT_EQ(surface(r, 7)[0].nodes, (std::array<Index, 4>{3, 4, 1, 0}));
  EXPECT_EQ(surface(r, 7)[1].element.kind, ElementKind::shell4);
  EXPECT_EQ(surface(r, 8).size(), 24u);
  EXPECT_EQ(group(r, 8).size(), 27u);
  EXPECT_EQ(surface(r, 9).size(), 14u);
  EXPECT_DOUBLE_EQ(enclosed_volume(r, surface(r, 9)), 3.0);
}

TEST(GeneralSets, GroupsOfTheSameIdAreNamed) {
  Reading r;
  r.read(blocks(1) + "/SET/GENERAL/5\ns\nPART               2\n/GRNOD/NODE/5\ng\n" + ints({1}) + "/GRSHEL/SHEL/5\ng\n" + ints({1001}) +
         "/SURF/SEG/5\ns\n" + ints({1, 1, 2, 4, 3}) + "/SUBSET/6\nupper\n");
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(group(r, 5), (Nodes{0}));
  EXPECT_EQ(r.messages(Severity::warning),
            Strings{"t_0000.rad:41: warning: /SET/GENERAL/5: /SURF, /GRNOD with the same id: references to id 5 get those, not this set"});
}

TEST(GeneralSets, UnknownClausesAreErrors) {
  Reading r;
  r.read(std::string(begin_2022) +
         "/SET/GENERAL/5\ns\n                   1\nBEAM               2\nNODE_G             1         9         2\n/SET/COLLECT/6\n");
  EXPECT_EQ(r.errors(),
            (Strings{
                "t_0000.rad:11: /SET/COLLECT/6: of the types of /SET only GENERAL is supported",
                "t_0000.rad:8: /SET/GENERAL/5 field 'KEY' (columns 1-10): the first line of a set names a kind, such as NODE or PART",
                "t_0000.rad:9: /SET/GENERAL/5 field 'KEY' (columns 1-10): clause 'BEAM' is not supported: NODE, PART, SUBS, SHELL, SH3N, "
                "SOLID, SEG, SET and "
                "ALL are, with the suffixes _D, _O, _A and _E",
                "t_0000.rad:10: /SET/GENERAL/5 field 'KEY' (columns 1-10): clause 'NODE_G' is not supported: NODE, PART, SUBS, SHELL, "
                "SH3N, SOLID, SEG, SET "
                "and ALL are, with the suffixes _D, _O, _A and _E",
            }));
}

}  // namespace
}  // namespace abut::model::testing
