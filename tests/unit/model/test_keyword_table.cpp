// The table of keywords is what the readers do.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/keyword_table.hpp"

namespace abut::model {
namespace {

const KeywordSupport& find(const std::vector<KeywordSupport>& all, std::string_view keyword) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const KeywordSupport& k) { return k.keyword == keyword; });
  if (found == all.end()) throw std::out_of_range(std::string(keyword));
  return *found;
}

const FieldSupport& field(const KeywordSupport& k, std::string_view name, int first_column) {
  const auto found = std::find_if(k.fields.begin(), k.fields.end(),
                                  [&](const FieldSupport& f) { return f.use.name == name && f.use.columns.first == first_column; });
  if (found == k.fields.end()) throw std::out_of_range(std::string(name));
  return *found;
}

TEST(KeywordTable, Type3HasItsFieldsInAllVersionsButIdelAndPtlim) {
  const std::vector<KeywordSupport> all = starter_keywords();
  const KeywordSupport& type3 = find(all, "/INTER/TYPE3");
  EXPECT_EQ(type3.treatment, Treatment::taken);
  const FieldSupport& gap = field(type3, "Gap", 41);
  EXPECT_EQ(gap.use.card, 2U);
  EXPECT_EQ(gap.use.columns.last, 60);
  EXPECT_EQ(gap.versions, probed_versions());
  EXPECT_EQ(field(type3, "Idel", 71).versions.front(), 51);
  EXPECT_EQ(field(type3, "Ptlim", 61).use.card, 4U);
}

TEST(KeywordTable, FieldsThatOnlyAFrictionLawAsksForAreFound) {
  const std::vector<KeywordSupport> all = starter_keywords();
  EXPECT_EQ(field(find(all, "/INTER/TYPE7"), "C6", 1).use.columns.last, 20);
}

// Fields that are read only where the ids before them are there, and types of more than one word.
TEST(KeywordTable, FieldsBehindIdsAndTypesOfTwoWordsAreFound) {
  const std::vector<KeywordSupport> all = starter_keywords();
  EXPECT_EQ(field(find(all, "/SHELL"), "Thick", 81).use.columns.last, 100);
  EXPECT_EQ(field(find(all, "/SH3N"), "Thick", 81).use.columns.last, 100);
  const auto has = [&](const char* keyword, const char* type) {
    const std::vector<std::string>& types = find(all, keyword).types;
    return std::count(types.begin(), types.end(), type) == 1;
  };
  EXPECT_TRUE(has("/SURF", "GRBRIC/EXT"));
  EXPECT_TRUE(has("/SURF", "PART/EXT"));
  EXPECT_FALSE(has("/SURF", "GRBRIC"));
  EXPECT_TRUE(has("/GRNOD", "NODENS"));
  EXPECT_EQ(find(all, "/ADMAS").types, (std::vector<std::string>{"0", "1", "2", "3", "5", "6"}));
  EXPECT_EQ(field(find(all, "/ADMAS"), "part_ID", 21).use.card, 1U);
  EXPECT_EQ(find(all, "/SET").fields.front().use.columns.last, 10);
}

// Every keyword that deck-format.md H.1 marks "must" is read, with its type where it is a set; less LAW36, whose decks stop with its name.
TEST(KeywordTable, KeywordsThatADeckMayNotDoWithoutAreRead) {
  const std::vector<KeywordSupport> all = starter_keywords();
  for (const char* keyword :
       {"/BEGIN",          "/UNIT",      "/TITLE",       "/ANALY",       "/DEF_SHELL",   "/DEF_SOLID",   "/SUBSET",     "/NODE",
        "/PART",           "/SHELL",     "/SH3N",        "/BRICK",       "/TETRA4",      "/PROP/SHELL",  "/PROP/SOLID", "/PROP/VOID",
        "/MAT/PLAS_JOHNS", "/MAT/ELAST", "/MAT/VOID",    "/FUNCT",       "/BCS",         "/INIVEL/TRA",  "/IMPVEL",     "/IMPDISP",
        "/CLOAD",          "/RBODY",     "/RWALL/PLANE", "/INTER/TYPE3", "/INTER/TYPE5", "/INTER/TYPE7", "/TH"}) {
    EXPECT_EQ(find(all, keyword).treatment, Treatment::taken) << keyword;
  }
  const std::vector<std::pair<const char*, std::vector<const char*>>> sets{
      {"/GRNOD", {"NODE", "GRNOD", "PART", "SURF", "GENE", "SUBSET", "GRSHEL"}},
      {"/GRSHEL", {"SHEL"}},
      {"/GRSH3N", {"SH3N"}},
      {"/GRBRIC", {"BRIC"}},
      {"/SURF", {"PART", "PART/EXT", "PART/ALL", "SEG", "GRSHEL", "GRSH3N", "SURF", "GRBRIC/EXT"}},
      {"/TH", {"NODE", "PART", "SHEL", "SH3N", "BRIC", "INTER", "RWALL", "RBODY"}}};
  for (const auto& [keyword, types] : sets) {
    const std::vector<std::string>& known = find(all, keyword).types;
    for (const char* type : types) EXPECT_EQ(std::count(known.begin(), known.end(), type), 1) << keyword << "/" << type;
  }
}

TEST(KeywordTable, EveryKeywordThatIsReadNamesItsFields) {
  for (const KeywordSupport& k : starter_keywords()) {
    if (k.treatment != Treatment::taken || k.keyword == "/SHFRA" || k.keyword == "/END" || k.keyword == "#INCLUDE") continue;
    EXPECT_FALSE(k.fields.empty()) << k.keyword;
  }
}

TEST(KeywordTable, KeywordsWithTextsAndTypesAreProbedInTheirOwnForms) {
  const std::vector<KeywordSupport> all = starter_keywords();
  const KeywordSupport& skew = find(all, "/SKEW");
  EXPECT_EQ(skew.types, (std::vector<std::string>{"FIX", "MOV", "MOV2"}));
  EXPECT_EQ(field(skew, "Dir", 31).use.card, 1U);
  EXPECT_EQ(field(skew, "X2", 1).use.card, 3U);  // after the origin, which decks have from version 120 on
  EXPECT_EQ(field(find(all, "/UNIT"), "local length unit", 21).versions, probed_versions());
  const KeywordSupport& history = find(all, "/TH");
  EXPECT_EQ(field(history, "var", 1).use.card, 1U);
  EXPECT_EQ(field(history, "object", 1).use.card, 2U);
  EXPECT_EQ(std::count(history.types.begin(), history.types.end(), "ACCEL"), 1);
  EXPECT_EQ(std::count(history.types.begin(), history.types.end(), "SPRING"), 0);  // is left out by the reader
  EXPECT_EQ(field(find(all, "/MOVE_FUNCT"), "Fshift_y", 61).use.card, 1U);
}

TEST(KeywordTable, ListsStandOnce) {
  const std::vector<KeywordSupport> all = starter_keywords();
  EXPECT_EQ(find(all, "/SHELL").fields.size(), 6U);
}

TEST(KeywordTable, WhatIsNotReadSaysWhy) {
  for (const KeywordSupport& k : starter_keywords()) EXPECT_EQ(k.reason.empty(), k.treatment != Treatment::refused) << k.keyword;
}

TEST(KeywordTable, EngineKeywordsAreAskedOfTheReader) {
  const std::vector<KeywordSupport> all = engine_keywords();
  for (const char* keyword :
       {"/RUN", "/TFILE", "/PRINT", "/TITLE", "/DT", "/DT/NODA", "/DT/NODA/CST", "/DTIX", "/ANIM/DT"}) {  // "must" of H.1
    EXPECT_EQ(find(all, keyword).treatment, Treatment::taken) << keyword;
  }
  EXPECT_EQ(find(all, "/PROC").treatment, Treatment::harmless);
  EXPECT_EQ(find(all, "/DAMP").treatment, Treatment::refused);
}

TEST(KeywordTable, AnimationsAreListedByName) {
  const std::vector<KeywordSupport> all = engine_keywords();
  for (const char* keyword : {"/ANIM/VECT/PCONT", "/ANIM/ELEM/EPSD", "/ANIM/VECT/FOPT", "/ANIM/MASS", "/ANIM/TENS/STRESS/UPPER"}) {
    EXPECT_EQ(find(all, keyword).treatment, Treatment::taken) << keyword;
  }
}

// Lines with ids and names, as decks have them.
TEST(KeywordTable, TheReadersAreAskedAboutALine) {
  EXPECT_EQ(starter_line("/SURF/SEG/1").treatment, Treatment::taken);
  EXPECT_EQ(starter_line("/SURF/PART/EXT/1").treatment, Treatment::taken);
  EXPECT_EQ(starter_line("/INTER/TYPE11/2").treatment, Treatment::refused);
  EXPECT_EQ(starter_line("/SURF/ELLIPS/2").treatment, Treatment::refused);
  EXPECT_EQ(starter_line("/FOO").reason, "/FOO is not supported: not known to abut; it may change the mechanics");
  EXPECT_EQ(starter_line("/TH/MONV/1").treatment, Treatment::harmless);  // left out with a warning
  EXPECT_EQ(starter_line("/FRAME/FIX/1").treatment, Treatment::harmless);
  EXPECT_EQ(starter_line("/END").treatment, Treatment::taken);
  EXPECT_EQ(engine_line("/RUN/NAME/1").treatment, Treatment::taken);
  EXPECT_EQ(engine_line("/PRINT/-100").treatment, Treatment::taken);
  EXPECT_EQ(engine_line("/DT/AMS").treatment, Treatment::refused);
  EXPECT_EQ(engine_line("/ANIM/SHELL/TENS/STRESS/3").treatment, Treatment::taken);
  EXPECT_EQ(engine_line("/ANIM/FOO").treatment, Treatment::harmless);
}

}  // namespace
}  // namespace abut::model
