// Chunks: what goes in comes out, within half a quantum where it is quantised.
#include "report/chunk.hpp"

#include <gtest/gtest.h>

#include <random>

#include "read_back.hpp"

namespace abut::report {
namespace {

TEST(Chunk, Base64IsThatOfRfc4648) {
  const auto encoded = [](std::string_view text) { return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()}); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(Chunk, QuantisedValuesAreWithinHalfAQuantumOfEachComponent) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<float> values;
  for (int i = 0; i < 3000; ++i) {
    for (const float scale : {1.0f, 1e-6f, 1e7f}) values.push_back(scale * (normal(random) + 3.0f));
  }
  const Chunk chunk = quantised(values, 3);
  EXPECT_EQ(chunk.count, 3000u);
  const auto back = test::read_values(chunk);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double quantum = (chunk.high[i % 3] - chunk.low[i % 3]) / 65534.0;
    ASSERT_NEAR(back[i], static_cast<double>(values[i]), 0.5000001 * quantum);
  }
}

TEST(Chunk, ZeroStaysZeroWhereBothSignsOccur) {
  const std::vector<float> values{-0.37f, 0.0f, 1.91f, 0.0f, 0.004f};
  const Chunk chunk = quantised(values, 1);
  const auto back = test::read_values(chunk);
  EXPECT_NEAR(back[1], 0.0, 1e-15);
  EXPECT_NEAR(back[3], 0.0, 1e-15);
  EXPECT_LE(chunk.low[0], -0.37);
  EXPECT_GE(chunk.high[0], 1.91);
  EXPECT_NEAR(back[4], 0.004, 2.3 / 65534.0);
}

TEST(Chunk, WhatIsNotANumberIsNoValue) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto back = test::read_values(quantised(std::vector<float>{1.0f, nan, 2.0f, std::numeric_limits<float>::infinity()}, 1));
  EXPECT_EQ(back[0], 1.0);
  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_EQ(back[2], 2.0);
  EXPECT_TRUE(std::isnan(back[3]));
  const Chunk none = quantised(std::vector<float>{nan, nan}, 1);
  EXPECT_TRUE(std::isnan(test::read_values(none)[0])) << "all of them";
}

TEST(Chunk, AConstantNeedsNoText) {
  const Chunk chunk = quantised(std::vector<float>(100, 2.5f), 1);
  EXPECT_TRUE(chunk.text.empty());
  EXPECT_EQ(test::read_values(chunk)[99], 2.5);
}

TEST(Chunk, IntegersAndSinglesKeepTheirBits) {
  const std::vector<std::uint32_t> integers_in{0, 4294967295u, 7, 7, 2147483648u, 3, 1000000000u, 0};
  const Chunk i = integers(integers_in, 2);
  EXPECT_EQ(test::read_integers("u32", 4, 2, i.text), integers_in);
  const std::vector<float> singles_in{0.0f, -1.5f, 3e38f, 1e-42f};
  const Chunk s = singles(singles_in, 1);
  const auto words = test::read_integers("f32", 4, 1, s.text);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(std::bit_cast<float>(words[k]), singles_in[k]);
  const std::vector<std::uint8_t> flags{1, 0, 0, 255};
  const auto back = test::read_integers("u8", 4, 1, bytes(flags).text);
  EXPECT_TRUE(std::equal(back.begin(), back.end(), flags.begin()));
}

TEST(Chunk, SmoothFieldsBecomeSmall) {
  std::vector<float> wave;
  for (int i = 0; i < 20000; ++i) wave.push_back(std::sin(0.001f * static_cast<float>(i)));
  EXPECT_LT(quantised(wave, 1).text.size(), wave.size());  // two bytes each before
}

}  // namespace
}  // namespace abut::report
