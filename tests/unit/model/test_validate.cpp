// Checks of a whole model, and the decks that must build (type3.md T6; deck-format.md E.1).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/model/deck_text.hpp"
#include "unit/model/fixture.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

/// A row of `n` shells; its surfaces 1 and 2 share all their nodes.
std::string shared_strip(int n) {
  std::string deck = "/BEGIN\nstrip\n      2022         0\n/NODE\n";
  for (int i = 0; i <= n; ++i) {
    deck += fmt::format("{:>10}{:>20}{:>20}{:>20}\n{:>10}{:>20}{:>20}{:>20}\n", 2 * i + 1, i, 0, 0, 2 * i + 2, i, 1, 0);
  }
  deck += testing::steel;
  deck += "/PROP/SHELL/1\nplate\n\n\n         0         0                 .01\n/PART/1\na\n         1         1\n/SHELL/1\n";
  for (int i = 0; i < n; ++i) deck += fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}\n", i + 1, 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
  return deck + "/SURF/PART/1\na\n         1\n/SURF/PART/2\nb\n        -1\n/INTER/TYPE3/5\nboth\n         1         2\n\n\n/END\n";
}

TEST(Validate, SharedNodesOfAType3AreListedUpToTwenty) {  // T6
  const Built b = build_text(shared_strip(14));
  ASSERT_EQ(b.diagnostics.error_count(), 1);
  EXPECT_TRUE(
      b.has("/INTER/TYPE3/5: 30 nodes are on both surfaces (1 and 2): 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, "
            "20 (and 10 more); "
            "a node may belong to one of them only"));
}

TEST(Validate, PartsWithoutElementsAndUnusedFunctionsAreNoted) {
  const Built b =
      build_text(with_line(base_starter, "/SENSOR/TIME/1", 0,
                           "/PART/9\nspare\n         2         2         0\n/FUNCT/8\nspare\n                   0                   1\n"
                           "                   1                   1\n/SENSOR/TIME/1"));
  EXPECT_EQ(b.messages(), (std::vector<std::string>{"note: this part has no element: 9", "note: nothing uses this /FUNCT: 8"}));
}

TEST(Validate, AModelWithoutMassIsAnError) {
  const std::string head = std::string("/BEGIN\nempty\n      2022         0\n\n\n");
  const std::string node = "/NODE\n" + testing::node(1, "0", "0", "0");
  EXPECT_TRUE(build_text(head + "/TITLE\nempty\n/END\n")
                  .has("deck_0000.rad: the model has no element and no mass; give it elements, or nodes masses by"));
  EXPECT_TRUE(build_text(head + node + "/END\n").has("deck_0000.rad: the model has no element and no mass"));
  const std::string mass = "/ADMAS/5/1\nball\n                   1         1\n";
  EXPECT_FALSE(build_text(head + node + mass + "/END\n").diagnostics.has_errors());
}

/// Two shells side by side, nodes 1 2 | 3 4 | 5 6 and a free node 7; `body` is the rigid body's first card, nodes 3 to 6 are its group.
std::string half_rigid_strip(const std::string& body, const std::string& more = "") {
  std::string deck = "/BEGIN\nstrip\n      2022         0\n/NODE\n";
  for (int i = 0; i < 3; ++i) {
    deck += fmt::format("{:>10}{:>20}{:>20}{:>20}\n{:>10}{:>20}{:>20}{:>20}\n", 2 * i + 1, i, 0, 0, 2 * i + 2, i, 1, 0);
  }
  deck += fmt::format("{:>10}{:>20}{:>20}{:>20}\n", 7, 1.5, 0.5, 0) + testing::steel;
  deck += "/PROP/SHELL/1\nplate\n\n\n         0         0                 .01\n/PART/1\na\n         1         1\n/SHELL/1\n";
  deck += integers({"1", "1", "3", "4", "2"}) + "\n" + integers({"2", "3", "5", "6", "4"}) + "\n/GRNOD/NODE/1\nright\n";
  return deck + integers({"3", "4", "5", "6"}) + "\n" + more + "/RBODY/8\nright half\n" + body + "\n\n\n/END\n";
}

std::string body_card(const char* main, const char* icog) {
  return integers({main, "0", "0", "0"}) + reals({"0"}) + integers({"1", "0", icog});
}

// Middle nodes carry mass of two shells, end nodes of one: the centre is at x = (2 * 1 + 1 * 2) / 3 of them, and of nodes 4, 5, 6 alone
// at (1 * 2 + 2 + 2) / 4 and y = (2 + 1) / 4.
TEST(Validate, AMainNodeOfTheMeshThatTheStartWouldMoveIsAnError) {
  const Built all = build_text(half_rigid_strip(body_card("3", "0")));
  EXPECT_EQ(all.diagnostics.error_count(), 1);
  EXPECT_TRUE(
      all.has("/RBODY/8 field 'node_ID': node 3 belongs to element 1, and ICoG 1 moves it by 0.6009, to the centre of gravity at "
              "1.33333 0.5 0: that tears the mesh; give a free node, or ICoG 3"))
      << fmt::format("{}", fmt::join(all.messages(), "\n"));
  const Built secondary = build_text(half_rigid_strip(body_card("3", "2")));
  EXPECT_TRUE(secondary.has("node 3 belongs to element 1, and ICoG 2 moves it by 0.9014, to the centre of gravity at 1.5 0.75 0: that"))
      << fmt::format("{}", fmt::join(secondary.messages(), "\n"));
  for (const char* icog : {"3", "4"}) EXPECT_FALSE(build_text(half_rigid_strip(body_card("3", icog))).has("tears")) << icog;
  for (const char* icog : {"0", "2"}) EXPECT_TRUE(build_text(half_rigid_strip(body_card("7", icog))).messages().empty()) << icog;
  const std::string sensor = "/SENSOR/TIME/1\nlate\n                   1\n";
  const std::string late = integers({"3", "1", "0", "0"}) + reals({"0"}) + integers({"1", "0", "0"});
  EXPECT_FALSE(build_text(half_rigid_strip(late, sensor)).has("tears"));  // ICoG 3 is forced
  EXPECT_FALSE(build_text(half_rigid_strip(body_card("3", "0")), "/RUN/strip/1\n1\n/TFILE\n1\n/RBODY/OFF\n3\n").has("tears"));
}

// Shell 2 is wholly inside the body and has no forces: its corner may move, unless a contact segment has the old form.
TEST(Validate, AMainNodeOfTheBodysOwnElementsIsAWarningUnlessContactIsThere) {
  const Built inside = build_text(half_rigid_strip(body_card("6", "0")));
  EXPECT_FALSE(inside.diagnostics.has_errors());
  EXPECT_TRUE(
      inside.has("warning: /RBODY/8 field 'node_ID': node 6 belongs to element 2, and ICoG 1 moves it by 0.8333, to the centre of "
                 "gravity at 1.33333 0.5 0: elements inside a body have no forces, but pictures show this one torn; give a free "
                 "node, or ICoG 3"));
  const std::string contact = "/SURF/SEG/4\nskin\n" + integers({"1", "3", "5", "6", "4"}) + "\n/INTER/TYPE7/2\nown\n" +
                              integers({"1", "4"}) + "\n\n\n" + reals({"0", "0", "0.1"}) + "\n\n\n";
  EXPECT_TRUE(
      build_text(half_rigid_strip(body_card("6", "0"), contact))
          .has("node 6 belongs to a segment of surface 4, and ICoG 1 moves it by 0.8333, to the centre of gravity at 1.33333 0.5 0: "
               "that tears the mesh"));
}

// A corner in the middle of its body, by the digits that a deck has, stays in the mesh as it is.
TEST(Validate, AMainNodeAtTheCentreOfGravityMayBeOneOfTheMesh) {
  std::string deck = "/BEGIN\nplate\n      2022         0\n/NODE\n";
  const auto third = [](int k) { return fmt::format("{:.7f}", k / 3.0); };
  for (int k = 0; k < 9; ++k) deck += testing::node(k + 1, third(k % 3), third(k / 3), "0");
  deck += std::string(testing::steel) +
          "/PROP/SHELL/1\nplate\n\n\n         0         0                 .01\n/PART/1\na\n         1         1\n/SHELL/1\n";
  for (int k : {1, 2, 4, 5}) deck += testing::ints({k, k, k + 1, k + 4, k + 3});
  deck += "/GRNOD/NODE/1\nall but the middle\n" + testing::ints({1, 2, 3, 4, 6, 7, 8, 9}) + "/RBODY/8\nplate\n";
  EXPECT_TRUE(build_text(deck + body_card("5", "0") + "\n\n\n/END\n").messages().empty());
  EXPECT_TRUE(build_text(deck + body_card("1", "0") + "\n\n\n/END\n").has("node 1 belongs to element 1"));
}

TEST(SharedDecks, BuildWithoutAnError) {
  const std::filesystem::path folder = testing::decks_folder();
  if (folder.empty()) GTEST_SKIP() << "no shared decks: set ABUT_DECKS to the folder that holds them";
  int decks = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.path().filename().string().ends_with("_0000.rad")) continue;
    SCOPED_TRACE(entry.path().filename().string());
    Diagnostics diagnostics;
    const Model m = build(deck::read(entry.path(), diagnostics), diagnostics);
    for (const Diagnostic& d : diagnostics.all()) EXPECT_NE(d.severity, Severity::error) << to_string(d);
    EXPECT_GT(m.controls.t_end, 0.0);
    EXPECT_LT(m.controls.history_interval, infinity);
    EXPECT_FALSE(m.th_requests.empty());
    ++decks;
  }
  EXPECT_GT(decks, 0);
}

}  // namespace
}  // namespace abut::model
