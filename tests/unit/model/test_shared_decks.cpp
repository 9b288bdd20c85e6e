// Every shared deck is read without an error, and its tables have the sizes counted from its text.
#include <gtest/gtest.h>

#include <cstdio>

#include "fixture.hpp"

namespace abut::model::testing {
namespace {

struct Counts {
  std::size_t nodes = 0, shells = 0, sh3ns = 0, bricks = 0;
};

/// Data lines below the keywords, found without the deck reader's rules for fields.
Counts count_lines(const std::string& path) {
  Counts counts;
  std::FILE* f = std::fopen(path.c_str(), "r");
  if (f == nullptr) return counts;
  char line[1024];
  std::size_t unused = 0;
  std::size_t* target = &unused;
  while (std::fgets(line, sizeof line, f) != nullptr) {
    const std::string s(line);
    if (s[0] == '#') continue;
    if (s[0] == '/') {
      const std::string word = s.substr(0, s.find_first_of("/ \r\n", 1));
      target = word == "/NODE"    ? &counts.nodes
               : word == "/SHELL" ? &counts.shells
               : word == "/SH3N"  ? &counts.sh3ns
               : word == "/BRICK" ? &counts.bricks
                                  : &unused;
      continue;
    }
    if (s.find_first_not_of(" \r\n") != std::string::npos) ++*target;
  }
  std::fclose(f);
  return counts;
}

TEST(SharedDecks, AreReadWithoutAnErrorAndCompletely) {
  const std::filesystem::path folder = decks_folder();
  if (folder.empty()) GTEST_SKIP() << "no shared decks: set ABUT_DECKS to the folder that holds them";
  int decks = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() < 9 || name.substr(name.size() - 9) != "_0000.rad") continue;
    SCOPED_TRACE(name);
    Reading r;
    deck::DeckPair pair = deck::read(entry.path(), r.diagnostics);
    EXPECT_TRUE(pair.has_engine);
    r.deck = std::move(pair.starter);
    r.attach();
    read_control(r.context);
    check_keywords(r.context);
    read_mesh(r.context);
    read_sets(r.context);
    EXPECT_EQ(r.errors(), std::vector<std::string>{});
    const Counts counts = count_lines(entry.path().string());
    EXPECT_EQ(r.model.node_id.size(), counts.nodes);
    EXPECT_EQ(r.model.shells.id.size(), counts.shells);
    EXPECT_EQ(r.model.sh3ns.id.size(), counts.sh3ns);
    EXPECT_EQ(r.model.bricks.id.size(), counts.bricks);
    for (const Surface& s : r.model.surfaces) {
      EXPECT_FALSE(s.segments.empty());
      for (const Segment& seg : s.segments) EXPECT_NE(seg.element.kind, ElementKind::none) << "surface " << s.id;
    }
    std::printf("%-24s v%d nodes %zu shells %zu sh3n %zu bricks %zu parts %zu groups %zu surfaces %zu warnings %d\n", name.c_str(),
                r.model.version, counts.nodes, counts.shells, counts.sh3ns, counts.bricks, r.model.parts.size(), r.model.node_groups.size(),
                r.model.surfaces.size(), r.diagnostics.warning_count());
    ++decks;
  }
  EXPECT_GT(decks, 0);
}

TEST(ExampleDeck, TwoBlocksHasTheSurfacesItsTextSays) {
  Reading r;
  deck::DeckPair pair = deck::read(std::filesystem::path(ABUT_SOURCE_DIR) / "examples/decks/twoblocks/twoblocks_0000.rad", r.diagnostics);
  EXPECT_TRUE(pair.has_engine);
  r.deck = std::move(pair.starter);
  r.attach();
  read_control(r.context);
  check_keywords(r.context);
  read_mesh(r.context);
  read_sets(r.context);
  EXPECT_EQ(r.errors(), std::vector<std::string>{});
  EXPECT_EQ(r.model.node_id.size(), 16u);
  EXPECT_EQ(r.model.bricks.size(), 2);
  ASSERT_EQ(r.model.surfaces.size(), 2u);
  for (const Surface& s : r.model.surfaces) EXPECT_EQ(s.segments.size(), 6u);
  EXPECT_EQ(r.model.node_groups[0].nodes.size(), 8u);
  EXPECT_EQ(r.model.units.length, 1e-3);
}

}  // namespace
}  // namespace abut::model::testing
