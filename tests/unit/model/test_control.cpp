// Version, units, defaults: deck-format.md A.4, A.8, A.12, A.13.
#include <gtest/gtest.h>

#include "fixture.hpp"
#include "model/units.hpp"

namespace abut::model::testing {
namespace {

std::string begin(const std::string& version, const Strings& input, const Strings& work) {
  return "/BEGIN\nrun\n" + field(version, 10) + "\n" + reals(input) + reals(work);
}

TEST(Units, CodesAreAPrefixAndABase) {
  EXPECT_EQ(unit_size("kg", 'g'), 1.0);
  EXPECT_EQ(unit_size("g", 'g'), 1e-3);
  EXPECT_EQ(unit_size("Mg", 'g'), 1e3);
  EXPECT_EQ(unit_size("mg", 'g'), 1e-6);
  EXPECT_EQ(unit_size("mm", 'm'), 1e-3);
  EXPECT_EQ(unit_size("cm", 'm'), 1e-2);
  EXPECT_EQ(unit_size("m", 'm'), 1.0);
  EXPECT_EQ(unit_size("dam", 'm'), 10.0);
  EXPECT_EQ(unit_size("ms", 's'), 1e-3);
  EXPECT_EQ(unit_size("mus", 's'), 1e-6);
  EXPECT_EQ(unit_size("\xb5s", 's'), 1e-6);
  EXPECT_EQ(unit_size("\xc2\xb5s", 's'), 1e-6);
  EXPECT_EQ(unit_size("1.D0", 's'), 1.0);
  EXPECT_EQ(unit_size("0.001", 'm'), 0.001);
}

TEST(Units, WhatIsNotAUnitIsRefused) {
  for (const char* bad : {"", "kilo", "inch", "0", "-1", "KG", "mms"}) EXPECT_FALSE(unit_size(bad, 'g').has_value()) << bad;
}

TEST(Control, WorkUnitsConvertEveryDimension) {
  Reading r;
  r.read(begin("2022", {"g", "mm", "ms"}, {"kg", "m", "s"}));
  const auto factor = [&](Dimension d) { return r.context.factor(d, 0); };
  EXPECT_DOUBLE_EQ(factor(dim::mass), 1e-3);
  EXPECT_DOUBLE_EQ(factor(dim::length), 1e-3);
  EXPECT_DOUBLE_EQ(factor(dim::time), 1e-3);
  EXPECT_DOUBLE_EQ(factor(dim::pressure), 1e6);  // g/(mm ms2) = MPa
  EXPECT_DOUBLE_EQ(factor(dim::density), 1e6);
  EXPECT_DOUBLE_EQ(factor(dim::velocity), 1.0);
  EXPECT_DOUBLE_EQ(factor(dim::force), 1.0);  // g mm/ms2 = N
  EXPECT_EQ(factor(dim::none), 1.0);
  EXPECT_EQ(r.model.name, "t");  // of t_0000.rad, not the "run" of the header: results of two decks of one folder stay apart
  EXPECT_EQ(r.model.units.length_name, "m");
}

// Numbers of an included file are read as the outer deck says (A.8): said where its own /BEGIN says another thing.
TEST(Control, BeginOfAnIncludedFileIsComparedWithTheDecks) {
  const auto warnings = [](const std::string& outer, const std::string& inner) {
    Reading r;
    const deck::Deck included = deck::read_starter_text(inner + "/END\n", "block.inc", r.diagnostics);
    r.deck = deck::read_starter_text(outer + "/END\n", "t_0000.rad", r.diagnostics);
    r.deck.inner_begins = included.blocks;
    r.attach();
    read_control(r.context);
    EXPECT_EQ(r.errors(), Strings{});
    return r.messages(Severity::warning);
  };
  const std::string outer = begin("2022", {"kg", "mm", "ms"}, {"kg", "m", "s"});
  EXPECT_EQ(
      warnings(outer, begin("2022", {"g", "m", "ms"}, {})),
      (Strings{"t_0000.rad:1: warning: /BEGIN: the /BEGIN of an included file is not read: it says mass in g, length in m, and the file "
               "is read with mass in kg, length in mm, as the deck that includes it; convert the file, or give its keywords a /UNIT"}));
  EXPECT_EQ(warnings(outer, begin("44", {}, {"kg", "mm", "s"})).size(), 1U);
  EXPECT_EQ(warnings(outer, begin("44", {}, {})),
            (Strings{"t_0000.rad:1: warning: /BEGIN: the /BEGIN of an included file is not read: it says version 44, and the file is read "
                     "with version 2022, as the deck that includes it; convert the file"}));
  EXPECT_EQ(warnings(outer, begin("2022", {"1.", "1e-3", ".001"}, {"Mg", "mm", "s"})), Strings{});  // work units are the deck's own affair
  EXPECT_EQ(warnings(outer, begin("0", {"", "mm", ""}, {})), Strings{});
  EXPECT_EQ(warnings(outer, "/BEGIN\nname\n"), Strings{});
}

TEST(Control, Surprise15OneSystemServesForBothAndNumbersAreUnits) {
  Reading input_only;
  input_only.read(begin("2022", {"1.D0", "0.001", "mus"}, {}));
  EXPECT_EQ(input_only.model.units.length, 0.001);
  EXPECT_EQ(input_only.model.units.time, 1e-6);
  EXPECT_EQ(input_only.context.factor(dim::energy, 0), 1.0);
  Reading work_only;
  work_only.read(begin("2022", {}, {"Mg", "mm", "s"}));
  EXPECT_EQ(work_only.context.input.mass, 1e3);
  Reading none;
  none.read("/BEGIN\nx\n        90         0\n");
  EXPECT_EQ(none.model.units.mass_name, "kg");
  EXPECT_EQ(none.model.version, 90);
  Reading narrow;
  narrow.read("/BEGIN\nx\n     100       0\n");
  EXPECT_EQ(narrow.model.version, 100);
  EXPECT_EQ(narrow.errors(), Strings{});
}

TEST(Control, OldUnitKeywordsSetBothSystems) {
  Reading r;
  r.read("/BEGIN\nx\n        90         0\n/UNIT/LENGTH/mm\n/UNIT/MASS/1000\n/UNIT/TIME/ms\n");
  EXPECT_EQ(r.model.units.length, 1e-3);
  EXPECT_EQ(r.model.units.mass, 1e3);
  EXPECT_EQ(r.context.input.time, 1e-3);
  EXPECT_EQ(r.errors(), Strings{});
}

TEST(Control, LocalUnitsApplyToTheirKeyword) {
  Reading r;
  r.read(begin("2022", {"kg", "m", "s"}, {"kg", "m", "s"}) + "/UNIT/7\nlocal\n" + reals({"g", "mm", "ms"}) + "/NODE/7\n" +
         node(1, "5", "0", "-2") + "/NODE\n" + node(2, "5", "0", "0"));
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_DOUBLE_EQ(r.model.node_x[0].x, 5e-3);
  EXPECT_DOUBLE_EQ(r.model.node_x[0].z, -2e-3);
  EXPECT_EQ(r.model.node_x[1].x, 5.0);
}

TEST(Control, BadUnitsSayWhatWouldBeRight) {
  Reading r;
  r.read(begin("2022", {"kilo", "m", "s"}, {"kg", "m", "-1"}) + "/NODE/9\n/UNIT/LENGTH/inch\n/UNIT/3\nt\n" + reals({"kg"}));
  EXPECT_EQ(r.errors(), (Strings{"t_0000.rad:4: /BEGIN field 'input mass unit' (columns 1-20): 'kilo' is not a unit of mass: write a code "
                                 "such as kg, g, Mg, or its size in SI as "
                                 "a positive number",
                                 "t_0000.rad:5: /BEGIN field 'work time unit' (columns 41-60): '-1' is not a unit of time: write a code "
                                 "such as s, ms, mus, or its size in SI as a "
                                 "positive number",
                                 "t_0000.rad:7: /UNIT/LENGTH/inch: 'inch' is not a unit of length: write a code such as m, mm, cm, or its "
                                 "size in SI as a positive number",
                                 "t_0000.rad:10: /UNIT/3 field 'local length unit' (columns 21-40): '' is not a unit of length: write a "
                                 "code such as m, mm, cm, or its size in SI as "
                                 "a positive number",
                                 "t_0000.rad:10: /UNIT/3 field 'local time unit' (columns 41-60): '' is not a unit of time: write a code "
                                 "such as s, ms, mus, or its size in SI as a "
                                 "positive number",
                                 "t_0000.rad:6: /NODE/9: no /UNIT with id 9"}));
}

TEST(Control, OldHeaderCarriesVersionAndName) {
  Reading r;
  r.read("#RADIOSS STARTER      41BAR2V41B               0\n/NODE\n");
  EXPECT_EQ(r.model.version, 41);
  Reading other;
  other.read("#RADIOSS STARTER      41BAR2V41B               0\n/NODE\n", "bar.rad");
  EXPECT_EQ(other.model.name, "BAR2V41B");  // the file is not called NAME_0000.rad
}

TEST(Control, OldLayoutHasEightColumnsAndTitlesOnTheKeywordLine) {
  Reading r;
  r.read(
      "#RADIOSS STARTER      44OLD                    0\n"
      "/NODE\n"
      "       1             0.0             0.0             0.0\n"
      "       2             1.0             0.0             0.0\n"
      "       3             1.0             2.0             0.0\n"
      "       4             0.0             2.0-1.00000000E-002\n"
      "/MAT/ELAST/1/steel / old\n"
      "          7800.0             0.0\n"
      "          210.E9             0.3\n"
      "/PROP/SHELL/3/sheet\n"
      "       2       4\n"
      "            0.02             0.0             0.0\n"
      "       5       0            0.01             0.0               1       1\n"
      "/PART/7/plate 7\n"
      "       3       1       0           0.003\n"
      "/SHELL/7\n"
      "      11       1       2       3       4\n"
      "/GRNOD/NODE/5/corner\n"
      "       1       4\n");
  EXPECT_EQ(r.errors(), Strings{});
  ASSERT_EQ(r.model.node_x.size(), 4u);
  EXPECT_EQ(r.model.node_x[3].y, 2.0);
  EXPECT_EQ(r.model.node_x[3].z, -0.01);
  EXPECT_EQ(r.model.materials[0].title, "steel / old");
  EXPECT_EQ(std::get<LawElastic>(r.model.materials[0].law).young, 210e9);
  const auto& p = std::get<ShellProperty>(r.model.properties[0].data);
  EXPECT_EQ(p.ishell, 2);
  EXPECT_EQ(p.ismstr, 4);
  EXPECT_EQ(p.hm, 0.02);
  EXPECT_EQ(p.points, 5);
  EXPECT_EQ(p.thickness, 0.01);
  EXPECT_TRUE(p.thickness_changes);
  EXPECT_EQ(p.iplas, 1);
  EXPECT_EQ(r.model.parts[0].title, "plate 7");
  EXPECT_EQ(r.model.parts[0].contact_thickness, 0.003);
  EXPECT_EQ(r.model.shells.id[0], 11);
  EXPECT_EQ(r.model.node_groups[0].nodes, (std::vector<Index>{0, 3}));
  EXPECT_EQ(r.model.node_groups[0].title, "corner");
}

TEST(Control, OldLayoutMessagesNameTheColumnsOfTheFile) {
  Reading r;
  r.read("#RADIOSS STARTER      44OLD                    0\n/NODE\n       1             0.0           1.2.3             0.0\n");
  EXPECT_EQ(r.errors(), Strings{"t_0000.rad:3: /NODE field 'Y' (columns 25-40): '1.2.3' is not a real number"});
}

TEST(Control, NoBeginMeansNewestVersion) {
  Reading r;
  r.read("/NODE\n");
  EXPECT_EQ(r.model.version, 2026);
  EXPECT_EQ(r.messages(Severity::warning), Strings{"t_0000.rad: warning: no /BEGIN block: version 2026 and units kg, m, s are assumed"});
}

TEST(Control, Surprise23TwoDimensionalDecksAreRefused) {
  Reading r;
  r.read(std::string(begin_2022) + "/ANALY\n         1                   0         0\n");
  EXPECT_EQ(r.errors(), Strings{"t_0000.rad:7: /ANALY field 'N2D3D' (columns 1-10): 1 asks for an axisymmetric or plane analysis: abut is "
                                "three-dimensional (0)"});
}

TEST(Control, Surprise28GeometricNoiseIsAWarning) {
  Reading r;
  r.read(std::string(begin_2022) + "/RANDOM\n               0.001                   0\n");
  EXPECT_EQ(r.messages(Severity::warning),
            Strings{"t_0000.rad:7: warning: /RANDOM field 'Xalea' (columns 1-20): geometric noise of 0.001 is not applied: results "
                    "differ from those of a perturbed mesh"});
}

TEST(Control, OnlyTheFirstDefaultsCount) {
  Reading r;
  r.read(
      std::string(begin_2022) +
      "/DEF_SHELL\n         4         0         1         1         0                             1         0\n/DEF_SHELL\n         2\n" +
      "/DEF_SOLID\n         2         0         0         0         0         0         1         2\n/SHFRA/V4\n/TITLE\n  two words \n");
  EXPECT_EQ(r.errors(), Strings{});
  EXPECT_EQ(r.context.shell_defaults.ishell, 4);
  EXPECT_EQ(r.context.shell_defaults.ismstr, 2);
  EXPECT_EQ(r.context.shell_defaults.ithick, 1);
  EXPECT_EQ(r.context.shell_defaults.iplas, 1);
  EXPECT_EQ(r.context.shell_defaults.ish3n, 1);
  EXPECT_EQ(r.context.solid_defaults.isolid, 2);
  EXPECT_EQ(r.context.solid_defaults.imas, 1);
  EXPECT_EQ(r.context.solid_defaults.iframe, 2);
  EXPECT_TRUE(r.model.shell_frame_v4);
  EXPECT_EQ(r.model.title, "two words");
}

TEST(Control, ADefaultOutOfRangeIsAnError) {
  Reading r;
  r.read(std::string(begin_2022) + "/DEF_SHELL\n         7\n");
  EXPECT_EQ(r.errors(), Strings{"t_0000.rad:7: /DEF_SHELL field 'Ishell' (columns 1-10): 7 is not one of 1, 2, 3, 4, 12, 24"});
}

TEST(Control, KeywordsThatChangePhysicsAreRefusedAndOthersListed) {
  Reading r;
  r.deck = deck::read_starter_text(
      std::string(begin_2022) + "/IOFLAG\n0\n/SPMD\n/SPMD\n/BEAM/3\n1 2\n3 4\n/BEAM/4\n5 6\n/INTER/TYPE11/2\nt\n/NOVELTY/1\n/FRAME/FIX/3\n",
      "t_0000.rad", r.diagnostics);
  r.attach();
  read_control(r.context);
  check_keywords(r.context);
  EXPECT_EQ(r.errors(), (Strings{"t_0000.rad:10: /BEAM/3: /BEAM (2 blocks with 3 lines) is not supported: abut has no elements of this "
                                 "kind; SHELL, SH3N, BRICK, TETRA4 "
                                 "and PENTA6 are supported",
                                 "t_0000.rad:15: /INTER/TYPE11/2: /INTER/TYPE11 is not supported: abut does not have this interface; "
                                 "TYPE3, TYPE5 and TYPE7 are supported",
                                 "t_0000.rad:17: /NOVELTY/1: /NOVELTY is not supported: not known to abut; it may change the mechanics"}));
  ASSERT_EQ(r.model.skipped.size(), 3u);
  EXPECT_EQ(r.model.skipped[2].keyword, "/SPMD");
  EXPECT_EQ(r.model.skipped[2].count, 2);
}

}  // namespace
}  // namespace abut::model::testing
