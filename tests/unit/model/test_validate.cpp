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
