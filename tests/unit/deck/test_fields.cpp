// Fixed-column fields: deck-format.md A.4, A.6.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "deck/fields.hpp"
#include "deck/text.hpp"

namespace abut::deck {
namespace {

TEST(Fields, RunTogetherNumbersAreSeparatedByColumnsOnly) {
  const std::string card = "         1               160.0-1.5258789062500E-05                 0.0";
  EXPECT_EQ(parse_integer(field_text(card, {1, 10})), 1);
  EXPECT_EQ(parse_real(field_text(card, {11, 30})), 160.0);
  EXPECT_EQ(parse_real(field_text(card, {31, 50})), -1.5258789062500E-05);
  EXPECT_EQ(parse_real(field_text(card, {51, 70})), 0.0);
}

TEST(Fields, BeyondTheEndOfTheCardIsBlank) {
  EXPECT_EQ(field_text("abc", {11, 20}), "");
  EXPECT_EQ(field_text("", {1, 10}), "");
  EXPECT_EQ(field_text("abc", {0, 0}), "");
  EXPECT_EQ(field_text("abc", {3, 10}), "c");
}

TEST(Fields, NothingRightOfColumn100Counts) { EXPECT_EQ(field_text(std::string(99, ' ') + "12", {91, 110}), "1"); }

TEST(Fields, TabIsABlank) { EXPECT_EQ(field_text("\t 7\t\t", {1, 10}), "7"); }

TEST(Fields, BlankIsZero) {
  EXPECT_EQ(parse_real(""), 0.0);
  EXPECT_EQ(parse_integer(""), 0);
}

TEST(Fields, EverySpellingOfARealIsRead) {
  EXPECT_EQ(parse_real("1"), 1.0);
  EXPECT_EQ(parse_real("1."), 1.0);
  EXPECT_EQ(parse_real("+.5"), 0.5);
  EXPECT_EQ(parse_real("-.0333333"), -0.0333333);
  EXPECT_EQ(parse_real("5E-4"), 5e-4);
  EXPECT_EQ(parse_real(".500000007E-01"), .500000007E-01);
  EXPECT_EQ(parse_real("210000003000"), 210000003000.0);
  EXPECT_EQ(parse_real("1.000000e-001"), 0.1);
  EXPECT_EQ(parse_real("1.D0"), 1.0);
  EXPECT_EQ(parse_real("-2.5d+03"), -2500.0);
  EXPECT_EQ(parse_real("1.5-5"), 1.5e-5);
  EXPECT_EQ(parse_real("+1+2"), 100.0);
  EXPECT_EQ(parse_real("1E30"), 1e30);
  EXPECT_EQ(parse_real("1E-999"), 0.0);
}

TEST(Fields, WhatIsNotARealIsRefused) {
  for (const char* bad : {"1.2.3", "abc",  "inf", "-inf",  "nan",   "NAN",   "1e",   "1D+", "--1",   "+",    "-",        ".",
                          "1,5",   "0x10", "1 2", "1e5e5", "1e999", "1D999", "&gap", "e5",  "1.5e-", "\xff", "infinity", "1_0"}) {
    EXPECT_FALSE(parse_real(bad).has_value()) << bad;
  }
}

TEST(Fields, RealsAreCorrectlyRounded) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t digits = random() % 100000000000000000ULL;
    const int exponent = static_cast<int>(random() % 600) - 300;
    const std::string text = "0." + std::to_string(digits) + "E" + std::to_string(exponent);
    ASSERT_EQ(parse_real(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Fields, IntegersAndIntegralReals) {
  EXPECT_EQ(parse_integer("999999999"), 999999999);
  EXPECT_EQ(parse_integer("-42"), -42);
  EXPECT_EQ(parse_integer("+7"), 7);
  EXPECT_EQ(parse_integer("3.0"), 3);
  EXPECT_EQ(parse_integer("1E3"), 1000);
  for (const char* bad : {"3.5", "abc", "12a", "1e300", "99999999999999999999999", "+-1", "--1", "1-"}) {
    EXPECT_FALSE(parse_integer(bad).has_value()) << bad;
  }
}

TEST(Text, PrintableIsAlwaysUtf8) {
  EXPECT_EQ(printable("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(printable("caf\xe9"), "caf\xc3\xa9");
  EXPECT_EQ(printable("a\tb\x01"), "a b ");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80");  // a surrogate is not UTF-8
}

}  // namespace
}  // namespace abut::deck
