// NAME.out: what it says of the model, of each listed cycle, and of the end.
#include "output/listing.hpp"

#include "output/element_lookup.hpp"
#include "output/summary.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using test::Scene;
using test::slurp;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> w;
  for (std::string s; in >> s;) w.push_back(s);
  return w;
}

/// The first line that starts with `start` (blanks aside).
std::string line_with(const std::string& text, const std::string& start) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line.compare(first, start.size(), start) == 0) return line;
  }
  return {};
}

class ListingTest : public ::testing::Test {
 protected:
  test::TemporaryFolder temporary_;
  RunFolder folder_{temporary_.path(), "scene"};
  Scene scene_;
  RunInfo info_{.version = "1.2.3",
                .commit = "abc",
                .compiler = "gcc 12",
                .instruction_set = "avx2",
                .threads = 2,
                .profile = "standard",
                .interfaces = {"all:law=constant"},
                .hash_every = 0,
                .resumed = {},
                .decks = {"decks/scene_0000.rad"},
                .findings = {},
                .contact = {},
                .during = std::make_shared<RunFindings>()};
};

TEST_F(ListingTest, TheHeaderSaysWhatRunsAndWhatIsLeftOut) {
  Diagnostics findings;
  findings.warning("deck.x", {.file = "scene_0000.rad", .line = 7, .keyword = "/PART/1", .field = "", .first_column = 0, .last_column = 0},
                   "something odd");
  info_.findings = findings.all();
  scene_.model.controls.animation_fields = {"NODA/TEMP"};
  model::ThRequest r;
  r.kind = model::ThKind::part;
  r.id = 11;
  r.index = 0;
  r.variables = {"HEAT"};
  scene_.model.th_requests.push_back(r);
  Listing sink(folder_, info_);
  sink.begin(scene_.snapshot());
  const std::string text = slurp(folder_.listing());
  EXPECT_TRUE(has(text, "abut 1.2.3 (abc)\n"));
  EXPECT_TRUE(has(text, "Deck        decks/scene_0000.rad\n"));
  EXPECT_TRUE(has(text, "profile standard, 2 threads, avx2, gcc 12\nInterface   all:law=constant\n"));
  EXPECT_TRUE(has(text, "  scene_0000.rad:7: warning: /PART/1: something odd\n"));
  EXPECT_TRUE(has(text, "left out of the time history: PART HEAT\n"));
  EXPECT_TRUE(has(text, "left out of the animation: NODA/TEMP\n"));
}

TEST_F(ListingTest, TheSummaryCountsAndWeighsTheModel) {
  const std::vector<double> masses = part_masses(scene_.model, scene_.groups);
  EXPECT_EQ(masses, (std::vector<double>{8.0, 19.0}));         // fake masses 4 + index: shells 4 + 4, solids 4 + 5 + 6 + 4
  scene_.model.added_masses = {{2, 0.1}, {2, 0.2}, {5, 0.1}};  // a card of the deck makes one entry per node, element and corner
  const std::string text = model_summary(scene_.model, masses);
  EXPECT_TRUE(has(text, "Model       scene \"one of each\"\n"));
  EXPECT_TRUE(has(text, "Units       kg m s\n"));
  EXPECT_TRUE(has(text, "Counts      12 nodes, 1 shells, 1 3-node shells, 3 bricks, 1 tetrahedra\n"));
  EXPECT_EQ(words(line_with(text, "11 ")), (std::vector<std::string>{"11", "2", "elements", "mass", "8", "shell", "Ishell", "1", "N", "0",
                                                                     "t", "0,", "LAW1", "elastic", "\"shells\""}));
  EXPECT_TRUE(has(line_with(text, "22 "), "4 elements  mass 19 "));
  EXPECT_TRUE(has(text, "mass of all elements 27\n"));
  EXPECT_TRUE(has(text, "3  TYPE3 \"a with b\": nothing and nothing\n"));
  EXPECT_TRUE(has(text, "7  TYPE5: 0 nodes against nothing\n"));
  EXPECT_TRUE(has(text, "Conditions  2 nodes with added mass, 1 rigid bodies, 1 rigid walls, 1 sections\n"));
  EXPECT_FALSE(has(model_summary(scene_.model, {}), "elements  mass"));
  EXPECT_FALSE(has(model_summary(scene_.model, {}), "mass of all"));
}

TEST_F(ListingTest, ALinePerListedCycleWithTheValuesOfThatCycle) {
  Listing sink(folder_, info_);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  scene_.state.times.cycle = 300;
  scene_.state.times.t = 0.25;
  scene_.state.times.h_plus = 0.0015;
  scene_.balance = {.ie = 11.0,
                    .he = 0.5,
                    .ke = 12.0,
                    .ker = 13.0,
                    .ce = 1.0,
                    .fw = 2.0,
                    .dw = 4.0,
                    .cx = 0.125,
                    .extw = 15.0,
                    .xe = 0.0,
                    .err = -0.0123,
                    .momentum = {},
                    .mass = 110.0,
                    .added_mass = 10.0};
  s.controller = {cycle::StepController::Kind::interface, 3};
  sink.cycle(s);
  EXPECT_TRUE(line_with(slurp(folder_.listing()), "300 ").empty());
  s.listing_due = true;
  sink.cycle(s);
  const std::string text = slurp(folder_.listing());
  EXPECT_EQ(words(line_with(text, "CYCLE ")),
            (std::vector<std::string>{"CYCLE", "TIME", "TIME-STEP", "BY", "ID", "ERROR%", "I-ENERGY", "K-ENERGY-T", "K-ENERGY-R",
                                      "CONT-ENERGY", "CONT-MADE", "EXT-WORK", "MASS-ERR"}));
  EXPECT_EQ(words(line_with(text, "300 ")),
            (std::vector<std::string>{"300", "0.25", "0.0015", "INTER", "3", "-1.23", "11", "12", "13", "7", "0.125", "15", "0.1"}));
  EXPECT_EQ(line_with(text, "300 ").size(), line_with(text, "CYCLE ").size());  // numbers stand under their titles
}

TEST_F(ListingTest, TheEndSaysWhyAndHowBadItWas) {
  Listing sink(folder_, info_);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  scene_.state.times.t = 0.1;
  scene_.balance.err = -0.05;
  scene_.balance.cx = 3.0;
  s.hash_due = true;
  s.state_hash = 0xabcdULL;
  sink.cycle(s);
  scene_.state.times.t = 0.2;
  scene_.balance.err = 0.01;
  scene_.balance.cx = -2.0;
  s.hash_due = false;
  sink.cycle(s);
  sink.end({cycle::Outcome::Kind::failed, "node 31 has a velocity that is not a number", 77, 0.2});
  const std::string text = slurp(folder_.listing());
  EXPECT_TRUE(has(text, "The run failed at time 0.2 after 77 cycles: node 31 has a velocity that is not a number\n"));
  EXPECT_TRUE(has(text, "Worst       energy error -5.000 % at time 0.1, contact made 3 at time 0.1\n"));
  EXPECT_TRUE(has(text, "State hash  000000000000abcd at cycle 0\n"));
  EXPECT_TRUE(has(text, "element-cycles/s\n"));
}

}  // namespace
}  // namespace abut::output
