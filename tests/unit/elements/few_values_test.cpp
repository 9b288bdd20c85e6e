// Few or many different numbers: the same bits come back.
#include "elements/few_values.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace abut::elements {
namespace {

TEST(FewValues, GiveBackTheBitsOfFewAndOfManyDifferentNumbers) {
  for (const std::size_t different : {std::size_t{1}, std::size_t{3}, std::size_t{65536}, std::size_t{65537}}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < 70000; ++i) values.push_back(i % different == 0 ? -0.0 : 1.0 / static_cast<double>(i % different));
    const FewValues few(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(few[i]), std::bit_cast<std::uint64_t>(values[i])) << different << " " << i;
    }
  }
  EXPECT_TRUE(FewValues().empty());
  EXPECT_TRUE(FewValues(std::vector<double>()).empty());
}

}  // namespace
}  // namespace abut::elements
