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

TEST(KeywordTable, EveryKeywordThatIsReadNamesItsFields) {
  for (const KeywordSupport& k : starter_keywords()) {
    if (k.treatment != Treatment::taken || k.keyword == "/SHFRA") continue;
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
  EXPECT_EQ(find(all, "/SHELL").fields.size(), 5U);
}

TEST(KeywordTable, WhatIsNotReadSaysWhy) {
  for (const KeywordSupport& k : starter_keywords()) EXPECT_EQ(k.reason.empty(), k.treatment != Treatment::refused) << k.keyword;
}

TEST(KeywordTable, EngineKeywordsAreAskedOfTheReader) {
  const std::vector<KeywordSupport> all = engine_keywords();
  EXPECT_EQ(find(all, "/DT/NODA/CST").treatment, Treatment::taken);
  EXPECT_EQ(find(all, "/PROC").treatment, Treatment::harmless);
  EXPECT_EQ(find(all, "/DAMP").treatment, Treatment::refused);
}

}  // namespace
}  // namespace abut::model
