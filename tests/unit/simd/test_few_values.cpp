// Few or many different numbers: the same bits come back.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "simd/few_values.hpp"

namespace abut::simd {
namespace {

template <class Number>
void expect_the_same_bits(std::size_t count, std::size_t different) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(i % different == 0 ? -0.0 : 1.0 / static_cast<double>(i % different));
  const FewValues<Number> few(values);
  ASSERT_EQ(few.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(few[i]), std::bit_cast<std::uint64_t>(values[i])) << different << " " << i;
  }
}

TEST(FewValues, GiveBackTheBitsOfFewAndOfManyDifferentNumbers) {
  for (const std::size_t different : {1U, 3U, 256U, 257U, 1000U}) expect_the_same_bits<std::uint8_t>(1000, different);
  for (const std::size_t different : {1U, 3U, 65536U, 65537U}) expect_the_same_bits<std::uint16_t>(70000, different);
  EXPECT_TRUE(FewValues<std::uint8_t>().empty());
  EXPECT_TRUE(FewValues<std::uint8_t>(std::vector<double>()).empty());
}

}  // namespace
}  // namespace abut::simd
