// Requests of a deck for time history and sections (deck-format.md F).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "model/th_variables.hpp"
#include "unit/model/deck_text.hpp"

namespace abut::model {
namespace {

using namespace base_deck;

const ThRequest* find(const Model& m, ThKind kind, Id id) {
  const auto found =
      std::find_if(m.th_requests.begin(), m.th_requests.end(), [&](const ThRequest& r) { return r.kind == kind && r.id == id; });
  return found == m.th_requests.end() ? nullptr : &*found;
}

TEST(Outputs, DefIsExpandedInTheOrderOfTheTable) {
  const Built b = build_text(base_starter);
  const ThRequest* inter = find(b.model, ThKind::inter, 1);
  ASSERT_NE(inter, nullptr);
  EXPECT_EQ(inter->variables, (std::vector<std::string>{"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ"}));
  EXPECT_EQ(inter->index, 0);
  EXPECT_EQ(inter->name, "block to block");
  const ThRequest* node = find(b.model, ThKind::node, 13);
  ASSERT_NE(node, nullptr);
  EXPECT_EQ(node->variables, (std::vector<std::string>{"DX", "DY", "DZ", "VX", "VY", "VZ"}));
  EXPECT_EQ(node->name, "corner");
  EXPECT_EQ(b.model.th_requests.size(), 7u);
}

TEST(Outputs, BlankListOfNamesAsksForDef) {
  const Built b = build_changed("/TH/INTER/1", 2, "");
  ASSERT_FALSE(b.diagnostics.has_errors());
  ASSERT_NE(find(b.model, ThKind::inter, 2), nullptr);
  EXPECT_EQ(find(b.model, ThKind::inter, 2)->variables.size(), 6u);
}

TEST(Outputs, NamesMayTakeSeveralLinesAndRepeat) {
  const Built b = build_changed("/TH/NODE/3", 2, "XYZ       A         DX\nREACZ     DX");
  ASSERT_EQ(b.messages(), std::vector<std::string>{});
  EXPECT_EQ(find(b.model, ThKind::node, 13)->variables, (std::vector<std::string>{"DX", "AX", "AY", "AZ", "X", "Y", "Z", "REACZ"}));
}

TEST(Outputs, TwoGroupsOfOneObjectAreOneRequest) {
  const Built b =
      build_text(with_line(base_starter, "/TH/PART/2", 0, "/ATH/PART/7\nmore\nMASS      PW\n" + integers({"2"}) + "\n/TH/PART/2"));
  ASSERT_EQ(b.messages(), std::vector<std::string>{});
  EXPECT_EQ(find(b.model, ThKind::part, 2)->variables.back(), "PW");
  EXPECT_EQ(find(b.model, ThKind::part, 2)->variables.size(), 10u);
  EXPECT_EQ(find(b.model, ThKind::part, 1)->variables.size(), 9u);
}

// The first request of a node names its columns: it stays the first whatever skew the later ones have.
TEST(Outputs, RequestsOfOneNodeKeepTheOrderOfTheDeck) {
  for (const bool global_first : {false, true}) {
    const std::string in_skew = "/TH/NODE/20\nturned\nDX\n" + integers({"13", "1"}) + "\n";
    const Built b = build_text(global_first ? with_line(base_starter, "/END", 0, in_skew + "/END")
                                            : with_line(base_starter, "/TH/PART/2", 0, in_skew + "/TH/PART/2"));
    ASSERT_EQ(b.messages(), std::vector<std::string>{});
    std::vector<Index> skews;
    for (const ThRequest& r : b.model.th_requests) {
      if (r.kind == ThKind::node && r.id == 13) skews.push_back(r.skew);
    }
    EXPECT_EQ(skews, global_first ? (std::vector<Index>{no_index, 0}) : (std::vector<Index>{0, no_index}));
  }
}

TEST(Outputs, ElementsWallsBodiesAndAccelerometers) {
  const Built b =
      build_text(with_line(base_starter, "/TH/PART/2", 0,
                           "/TH/SHELL/11\nshells\nSTRESS    THIC\n" + integers({"3", "0"}) + "plate\n/TH/BRICK/12\nbricks\nSTRESS\n" +
                               integers({"2"}) + "\n/TH/RWALL/13\nwall\nFN\n" + integers({"1"}) + "\n/TH/RBODY/14\nbody\nF         V\n" +
                               integers({"1"}) + "\n/ACCEL/5\nsensor\n" + integers({"13", "1", ""}) + reals({"1.65"}) +
                               "\n/TH/ACCEL/15\nacc\nDEF\n" + integers({"5"}) + "\n/TH/PART/2"));
  ASSERT_EQ(b.messages(), std::vector<std::string>{});
  EXPECT_EQ(find(b.model, ThKind::shell, 3)->variables,
            (std::vector<std::string>{"F1", "F2", "F12", "Q1", "Q2", "M1", "M2", "M12", "THIC"}));
  EXPECT_EQ(find(b.model, ThKind::brick, 2)->index, 1);
  EXPECT_EQ(find(b.model, ThKind::rwall, 1)->variables, (std::vector<std::string>{"FNX", "FNY", "FNZ"}));
  EXPECT_EQ(find(b.model, ThKind::rbody, 1)->variables.size(), 9u);
  const ThRequest* acc = find(b.model, ThKind::accelerometer, 5);
  ASSERT_NE(acc, nullptr);
  const Accelerometer& instrument = b.model.accelerometers.at(static_cast<std::size_t>(acc->index));
  EXPECT_EQ(b.model.node_id[static_cast<std::size_t>(instrument.node)], 13);
  EXPECT_EQ(instrument.skew, 0);
  EXPECT_EQ(instrument.cut_off, 1.65);
}

TEST(Outputs, SectionTakesGroupsFrameAndInterfaces) {
  const Built b = build_text(with_line(base_starter, "/TH/PART/2", 0,
                                       "/GRSHEL/SHEL/8\nplate\n" + integers({"3"}) + "\n/GRBRIC/BRIC/9\nblock\n" + integers({"2"}) +
                                           "\n/SECT/4\ncut\n" + integers({"9", "10", "12", "3", "0", "0"}) + reals({"0", "0"}) + "\n\n" +
                                           integers({"9", "", "8", "0", "0", "0", "0", "2", "", "11"}) + "\n" + integers({"1", "3"}) +
                                           "\n/TH/SECTIO/16\nforces\nDEF\n" + integers({"4"}) + "\n/TH/PART/2"));
  ASSERT_EQ(b.messages(), std::vector<std::string>{
                              "deck_0000.rad:186: warning: /SECT/4 field 'Niter' (columns 71-80): forces of interfaces do not count in "
                              "those of section 4; add the force of each by /TH/INTER, or write 0"});
  const Section& s = b.model.sections.at(0);
  EXPECT_EQ(s.nodes.size(), 4u);
  EXPECT_EQ(s.shells, std::vector<Index>{0});
  EXPECT_EQ(s.bricks, std::vector<Index>{1});
  EXPECT_EQ(s.interfaces, (std::vector<Index>{0, 2}));
  EXPECT_EQ(s.iframe, 11);
  EXPECT_EQ(b.model.node_id[static_cast<std::size_t>(s.frame_nodes[2])], 12);
  EXPECT_EQ(find(b.model, ThKind::section, 4)->variables.size(), 9u);
}

TEST(Outputs, SectionWithoutElementsIsToldOf) {
  const auto section = [](const std::string& cards) {
    return build_text(with_line(base_starter, "/TH/PART/2", 0,
                                "/GRBRIC/BRIC/9\nblock\n" + integers({"2"}) + "\n/SECT/4\ncut\n" + integers({"9", "10", "12", "3"}) + "\n" +
                                    cards + "\n/TH/PART/2"));
  };
  EXPECT_EQ(section("cut file\n" + integers({"9"})).messages(), std::vector<std::string>{});
  const std::string what =
      " /SECT/4 field 'grbric_ID, grshel_ID, grsh3n_ID' (columns 1-70): this section holds no element, and its force is zero; name the "
      "elements on one side of its nodes (on the card after the file name, which has a line of its own even if blank)";
  EXPECT_TRUE(section("\n" + integers({"", "", "0"})).has("warning:" + what));
  EXPECT_TRUE(section(integers({"9"})).has(" /SECT/4")) << "the card of the file name is left out";
}

// deck-format.md F.2, F.3: no card for a file name; a cut-off frequency in columns 27 to 42.
TEST(Outputs, SectionAndAccelerometerOfTheOldLayout) {
  std::string deck = "#RADIOSS STARTER      41old                    0\n/UNIT/MASS/kg\n/UNIT/LENGTH/mm\n/UNIT/TIME/ms\n/NODE\n";
  const char* const corners[] = {"0. 0.", "1. 0.", "1. 1.", "0. 1."};
  for (int n = 0; n < 4; ++n) {
    deck += fmt::format("{:>8}{:>16}{:>16}{:>16}\n", n + 1, std::string(corners[n]).substr(0, 2), std::string(corners[n]).substr(3), "0.");
  }
  deck += fmt::format("/MAT/ELAST/1/steel\n{:>16}\n{:>16}{:>16}\n", "7.8e-6", "210.", "0.3");
  deck += fmt::format("/PROP/SHELL/1/plate\n{:>8}{:>8}\n\n{:>8}{:>8}{:>16}\n/PART/1/a\n{:>8}{:>8}\n", 1, 2, 0, 0, ".1", 1, 1);
  deck +=
      fmt::format("/SHELL/1\n{:>8}{:>8}{:>8}{:>8}{:>8}\n/GRSHEL/SHEL/8/g\n{:>8}\n/GRNOD/NODE/2/n\n{:>8}{:>8}\n", 1, 1, 2, 3, 4, 1, 1, 2);
  deck += fmt::format("/SECT/4/cut\n{:>8}{:>8}{:>8}{:>8}\n{:>24}\n/ACCEL/5/a\n{:>8}{:>8}{:>26}\n/END\n", 1, 2, 3, 2, 8, 3, 0, "1.65");
  const Built b = build_text(deck);
  ASSERT_EQ(b.messages(), std::vector<std::string>{});
  EXPECT_EQ(b.model.sections.at(0).shells, std::vector<Index>{0});
  EXPECT_EQ(b.model.sections.at(0).nodes.size(), 2u);
  EXPECT_EQ(b.model.accelerometers.at(0).cut_off, 1.65);
}

TEST(Outputs, EveryGroupOfEveryKindExpandsToVariablesOfItsTable) {
  for (const ThKind kind : {ThKind::node, ThKind::part, ThKind::shell, ThKind::sh3n, ThKind::brick, ThKind::inter, ThKind::rwall,
                            ThKind::rbody, ThKind::section, ThKind::accelerometer}) {
    const std::vector<std::string>& all = th_variables(kind);
    for (const char* group : {"DEF", "D",    "V",   "A", "VR", "AR", "XYZ", "STRESS", "STRAIN", "PLAS",   "SIG_3", "LOCSTRS", "FN",
                              "FT",  "|FN|", "|F|", "F", "M",  "R",  "FI",  "MI",     "CENTER", "GLOBAL", "LOCAL", "W"}) {
      for (const std::string& name : th_expand(kind, group))
        EXPECT_NE(std::find(all.begin(), all.end(), name), all.end()) << th_word(kind) << " " << group << " " << name;
    }
    EXPECT_FALSE(th_expand(kind, "def").empty());
    EXPECT_TRUE(th_expand(kind, "NOTHING").empty());
    EXPECT_EQ(th_kind(th_word(kind)), kind);
  }
  EXPECT_EQ(th_kind("MONV"), std::nullopt);
}

}  // namespace
}  // namespace abut::model
