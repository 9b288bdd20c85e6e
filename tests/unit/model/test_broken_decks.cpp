// Bad input: each fault has its own message, which names the place and says what would be right (issue 2, section 6.6).
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "unit/model/broken_decks.hpp"
#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

std::string test_name(const ::testing::TestParamInfo<BrokenDeck>& info) {
  std::string name;
  for (const char* c = info.param.name; *c != 0; ++c) name += std::isalnum(static_cast<unsigned char>(*c)) != 0 ? *c : '_';
  return name;
}

class BrokenDecks : public ::testing::TestWithParam<BrokenDeck> {};

TEST_P(BrokenDecks, GivesExactlyTheseFindings) {
  const BrokenDeck& broken = GetParam();
  std::string starter = base_starter, engine = base_engine;
  std::string& changed = broken.deck == Changed::starter ? starter : engine;
  changed = with_line(changed, broken.keyword, broken.offset, broken.text);
  EXPECT_EQ(build_text(starter, engine).messages(), broken.findings);
}

INSTANTIATE_TEST_SUITE_P(Mesh, BrokenDecks, ::testing::ValuesIn(broken_meshes_and_sets()), test_name);
INSTANTIATE_TEST_SUITE_P(Conditions, BrokenDecks, ::testing::ValuesIn(broken_conditions()), test_name);
INSTANTIATE_TEST_SUITE_P(Interfaces, BrokenDecks, ::testing::ValuesIn(broken_interfaces()), test_name);
INSTANTIATE_TEST_SUITE_P(Outputs, BrokenDecks, ::testing::ValuesIn(broken_outputs_and_engines()), test_name);

TEST(BrokenDecksTogether, AllFaultsOfADeckAreFoundInOneGo) {
  // Three faults in different stages: none hides another.
  std::string deck = with_line(base_starter, "/BCS/1", 2, "   121 111" + integers({"0", "1"}));
  deck = with_line(deck, "/INTER/TYPE3/1", 3, reals({"0", "-.2", "1.2.3", "0", "0"}));
  const Built b = build_text(deck, with_line(base_engine, "/TFILE/4", 1, "-1"));
  EXPECT_EQ(b.diagnostics.error_count(), 4);
  EXPECT_TRUE(b.has("field 'Ty'"));
  EXPECT_TRUE(b.has("field 'Fric'"));
  EXPECT_TRUE(b.has("field 'Gap' (columns 41-60): '1.2.3' is not a real number"));
  EXPECT_TRUE(b.has("field 'dt_TH'"));
}

}  // namespace
}  // namespace abut::model
