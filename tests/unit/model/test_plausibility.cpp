// What a deck may say but rarely means: each with its message, and silence where it is meant.
#include <gtest/gtest.h>

#include "unit/model/deck_text.hpp"
#include "unit/model/fixture.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

/// A 1 x 1 shell of steel; `units` a line of /BEGIN, `more` further blocks.
std::string plate(const std::string& units, const std::string& young, const std::string& more) {
  std::string deck = "/BEGIN\nplate\n      2022         0\n" + units + units + "/NODE\n";
  int id = 0;
  for (const char* xyz : {"0 0", "1 0", "1 1", "0 1", "5 5"}) {
    const std::string both(xyz);
    deck += testing::ints({++id}).substr(0, 10) + testing::reals({both.substr(0, 1), both.substr(2), "0"});
  }
  deck += "/MAT/ELAST/3\nsteel\n" + testing::reals({"7800"}) + testing::reals({young, "0.3"});
  deck += "/PROP/SHELL/1\nplate\n\n\n         0         0                 .01\n/PART/1\na\n         1         3\n/SHELL/1\n";
  return deck + testing::ints({1, 1, 2, 3, 4}) + more + "/END\n";
}

const std::string si = "                  kg                   m                   s\n";
const std::string millimetres = "                  Mg                  mm                   s\n";

TEST(Plausibility, SpeedOfSoundOfAMaterialInOtherUnits) {
  EXPECT_TRUE(build_text(plate(si, "2.1e11", "")).messages().empty());
  EXPECT_TRUE(build_text(plate(millimetres, "2.1e11", ""))
                  .has("note: /MAT/ELAST/3: the speed of sound in this material would be 5.19 m/s; are its density and Young's modulus "
                       "in the units of "
                       "/BEGIN (Mg, mm, s)?"));
  EXPECT_TRUE(build_text(plate(si, "1e6", "")).messages().empty());  // rubber, 11 m/s
}

TEST(Plausibility, FieldsThatDoNothing) {
  const std::string total =
      with_line(base_starter, "/MAT/PLAS_JOHNS/2", 5,
                "                 0.1                 1.0         0                             5                   0");
  EXPECT_FALSE(build_text(total).has("F_cut"));
  EXPECT_TRUE(build_text(with_line(total, "/MAT/PLAS_JOHNS/2", 3, "                 210                 0.3         0         1"))
                  .has("warning: /MAT/PLAS_JOHNS/2 field 'F_cut' (columns 61-80): the plastic strain rate of VP 1 is always filtered at 10 "
                       "kHz, this field is not used"));
  const auto triangle = [](const char* ismstr) {
    return build_text(with_line(with_line(plate(si, "2.1e11", ""), "/SHELL/1", 0, "/SH3N/1"), "/PROP/SHELL/1", 2,
                                "         0" + testing::field(ismstr, 10)));
  };
  EXPECT_TRUE(triangle("1").has("warning: /PROP/SHELL/1: Ismstr 1 (small strain) does nothing for 3-node shells"));
  EXPECT_FALSE(triangle("2").has("Ismstr"));
}

/// A brick of steel: corners by their numbers in the unit cube, 9 its corner 7 moved along the face.
auto brick_of(const std::vector<long>& corners, long isolid = 0) {
  std::string deck = "/BEGIN\nbrick\n      2022         0\n" + millimetres + millimetres + "/NODE\n";
  long id = 0;
  for (const auto& [x, y, z] : std::vector<std::array<const char*, 3>>{{"0", "0", "0"},
                                                                       {"1", "0", "0"},
                                                                       {"1", "1", "0"},
                                                                       {"0", "1", "0"},
                                                                       {"0", "0", "1"},
                                                                       {"1", "0", "1"},
                                                                       {"1", "1", "1"},
                                                                       {"0", "1", "1"},
                                                                       {"1.1", "1", "1"}}) {
    deck += testing::ints({++id}).substr(0, 10) + testing::reals({x, y, z});
  }
  deck += "/MAT/ELAST/3\nsteel\n" + testing::reals({"7.8e-9"}) + testing::reals({"2.1e5", "0.3"}) + "/PROP/SOLID/1\nsolid\n" +
          testing::ints({isolid}) + "\n\n/PART/4\na\n" + testing::ints({1, 3}) + "/BRICK/4\n";
  std::vector<long> card = corners;
  card.insert(card.begin(), 9);
  return build_text(deck + testing::ints(card) + "/END\n");
}

// A rotation is no hourglass motion: Isolid 2 sees one in what is no parallelepiped, Isolid 1 (and 0) does not.
TEST(Plausibility, HourglassForcesOfIsolid2BrakeRotations) {
  EXPECT_TRUE(brick_of({1, 2, 3, 4, 5, 6, 9, 8}, 2)
                  .has("warning: /PART/4: the hourglass forces of Isolid 2 brake every rotation of 1 brick that is no parallelepiped: 9; "
                       "Isolid 1 leaves rotations alone"));
  for (const auto& quiet : {brick_of({1, 2, 3, 4, 5, 6, 9, 8}), brick_of({1, 2, 3, 4, 5, 6, 9, 8}, 1),
                            brick_of({1, 2, 3, 4, 5, 6, 7, 8}, 2), brick_of({2, 3, 7, 6, 1, 4, 8, 5}, 2)}) {
    EXPECT_FALSE(quiet.has("brake"));
  }
}

// LAW2 has no global integration; 3 points have the limit moment of first yield.
TEST(Plausibility, PointsOfPlasticShells) {
  const auto yielding = [](const std::string& points) {
    const std::string law = testing::reals({"2.1e11", "0.3"}) + testing::reals({"3e8"}) + "\n";
    const std::string deck = with_line(plate(si, "2.1e11", ""), "/MAT/ELAST/3", 3, law);
    return build_text(with_line(with_line(deck, "/MAT/ELAST/3", 0, "/MAT/PLAS_JOHNS/3"), "/PROP/SHELL/1", 4,
                                testing::field(points, 10) + "         0                 .01"));
  };
  for (const char* none : {"0", ""}) {
    EXPECT_TRUE(yielding(none).has("warning: /PROP/SHELL/1: N is blank or 0, and LAW2 knows no global integration: 3 points are used."));
  }
  EXPECT_FALSE(yielding("3").has("N is"));
  EXPECT_FALSE(build_text(plate(si, "2.1e11", "")).has("N is"));  // LAW1 integrates in closed form
}

// One-point volumes: of a box and a prism exact, of a pyramid and a tetrahedron 1/4 and 1/8 of a box instead of 1/3 and 1/6.
TEST(Plausibility, CollapsedBricksWithAnotherMassThanTheirShape) {
  EXPECT_FALSE(brick_of({1, 2, 3, 4, 5, 6, 7, 8}).has("the mass of"));
  EXPECT_FALSE(brick_of({1, 2, 3, 3, 5, 6, 7, 7}).has("the mass of"));
  EXPECT_TRUE(
      brick_of({1, 2, 3, 4, 5, 5, 5, 5})
          .has("warning: /PART/4: the mass of 1 brick is that of the volume at the centre and differs by more than 5 % from that of "
               "the shape: 9 (element 9 by -25 %)"));
  EXPECT_TRUE(brick_of({1, 2, 3, 3, 5, 5, 5, 5}).has("(element 9 by -25 %)"));
}

TEST(Plausibility, NodesOfARigidBodyPassAWall) {
  const auto body_with = [](int ikrem) {
    return "/GRNOD/NODE/1\nall\n" + testing::ints({1, 2, 3, 4}) + "/RBODY/1\nbody\n" + testing::ints({5, 0, 0, 0}).substr(0, 40) +
           "                   0" + testing::ints({1, ikrem, 0, 0}) + "\n\n\n";
  };
  const std::string body = body_with(0);
  const auto wall = [](const std::string& node) {
    return "/RWALL/PLANE/7\nwall\n" + testing::field(node, 10) + testing::ints({0, 1, 0}) + testing::reals({"0", "0", "0", "0"}) +
           (node == "0" ? testing::reals({"0", "0", "-1"}) : testing::reals({"2", "0", "0", "3"})) + testing::reals({"0", "0", "1"});
  };
  EXPECT_TRUE(build_text(plate(si, "2.1e11", body + wall("0")))
                  .has("note: /RWALL/PLANE/7: 4 nodes follow a rigid body (the first is node 1, of rigid body 1) and are not stopped by "
                       "this wall, because Ikrem = 0 of /RBODY takes secondary nodes out of walls; write 1 where the wall is to stop the "
                       "body"));
  EXPECT_TRUE(build_text(plate(si, "2.1e11", body_with(1) + wall("0"))).messages().empty());
  // Friction with a filter: free nodes have it, those of bodies that the wall stops do not.
  const auto rough = [](const char* ifq) {
    return "/RWALL/PLANE/7\nwall\n" + testing::ints({0, 2, 1, 0}) + testing::reals({"0", "0.2"}).substr(0, 40) + std::string(20, ' ') +
           testing::field("0.5", 20) + testing::field(ifq, 10) + "\n" + testing::reals({"0", "0", "-1"}) + testing::reals({"0", "0", "1"});
  };
  EXPECT_TRUE(
      build_text(plate(si, "2.1e11", body_with(1) + rough("1")))
          .has("note: /RWALL/PLANE/7: ifq filters the friction of free nodes; that of 4 nodes of rigid bodies (the first is node 1, of "
               "rigid body 1) acts in full at once: 0 of ifq filters none"));
  for (const std::string& quiet :
       {body_with(1) + rough("0"), body_with(0) + rough("1"), "/GRNOD/NODE/1\nall\n" + testing::ints({1, 2}) + rough("1")}) {
    EXPECT_FALSE(build_text(plate(si, "2.1e11", quiet)).has("ifq")) << quiet;
  }
  EXPECT_TRUE(build_text(plate(si, "2.1e11", body + wall("2")))
                  .has("warning: /RWALL/PLANE/7: the wall's initial velocity is not used: its node 2 follows a rigid body, give the "
                       "velocity to the body's "
                       "main node (/INIVEL)"));
}

TEST(Plausibility, ABodyWithAMovingWallBesideItsCentre) {
  const auto deck = [](const char* node, const std::string& held) {
    const std::string text = plate(si, "2.1e11",
                                   "/SENSOR/TIME/2\nlate\n" + testing::reals({"0.001"}) + "/GRNOD/NODE/1\nall\n" +
                                       testing::ints({1, 2, 3, 4}) + "/RBODY/1\nbody\n" + testing::ints({5, 2, 0, 0}).substr(0, 40) +
                                       "                   0" + testing::ints({1, 0, 0, 0}) + "\n\n\n" + held);
    return with_line(text, "/NODE", 5, testing::ints({5}).substr(0, 10) + node);
  };
  const std::string held = "/GRNOD/NODE/2\nmain\n" + testing::ints({5}) + "/BCS/1\nslide\n   001 000         0         2\n";
  const std::string wall = "/RWALL/PLANE/7\nwall\n" + testing::field("5", 10) + testing::ints({0, 1, 0}) +
                           testing::reals({"0", "0", "0", "0"}) + testing::reals({"2", "0", "0", "3"}) + testing::reals({"0", "0", "1"});
  const char* beside = "                 0.5                   0                   0";
  EXPECT_TRUE(
      build_text(deck(beside, wall))
          .has("warning: /RBODY/1: its main node carries a moving wall and stays 0.5 beside the centre of gravity: the body then moves as "
               "if its mass were there, which makes energy when it turns; put node 5 at 0.5 0.5 0"));
  EXPECT_FALSE(build_text(deck(beside, held)).has("centre of gravity"));
  EXPECT_FALSE(build_text(deck("                 0.5                 0.5                   0", wall)).has("centre of gravity"));
}

TEST(Plausibility, TabsAreNamedWhereAFieldCannotBeRead) {
  const std::string deck = with_line(plate(si, "2.1e11", ""), "/NODE", 2, "2\t1\t0\t0");
  EXPECT_TRUE(build_text(deck).has(
      "'2 1 0 0' is not an integer; the line has tabs, and a tab counts as one column: fields need blanks up to their columns"));
}

TEST(Plausibility, NamesOfAHistoryThatShareAField) {
  const std::string history = "/TH/NODE/1\nn\nDEF       VR  WX\n" + testing::ints({1});
  EXPECT_TRUE(build_text(plate(si, "2.1e11", history))
                  .has("'VR  WX' is not a variable of /TH/NODE; it is left out (each name has a field of its own)"));
}

}  // namespace
}  // namespace abut::model
