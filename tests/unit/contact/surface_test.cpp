// Who is whose neighbour, and the room that numbers of facets take.
#include "abut/contact/surface.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "contact/surface/values.hpp"

namespace abut::contact {
namespace {

TEST(Surface, FacetsThatShareAnEdgeAreNeighboursButNotAtAJunction) {
  // A quadrilateral and a triangle in a row, three facets at edge 2 3, and one that only shares the diagonal's nodes 0 2 with the first.
  const Surface s({{{0, 1, 2, 3}}, {{1, 4, 2, 2}}, {{2, 3, 5, 6}}, {{3, 2, 7, 7}}, {{0, 8, 2, 2}}});
  EXPECT_EQ(s.neighbour(0, 1), 1);
  EXPECT_EQ(s.neighbour(1, 2), 0);
  for (const auto& [facet, edge] : {std::pair{0, 2}, {2, 0}, {3, 0}}) {
    EXPECT_EQ(s.neighbour(facet, edge), no_index);
    EXPECT_FALSE(s.free_border(facet, edge));
  }
  for (const auto& [facet, edge] : {std::pair{0, 0}, {0, 3}, {1, 0}, {1, 1}, {4, 0}, {4, 2}}) {
    EXPECT_EQ(s.neighbour(facet, edge), no_index);
    EXPECT_TRUE(s.free_border(facet, edge));
  }
}

TEST(Values, GiveBackTheBitsOfFewAndOfManyDifferentNumbers) {
  for (const std::size_t different : {1U, 3U, 256U, 257U, 1000U}) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < 1000; ++i) numbers.push_back(i % different == 0 ? -0.0 : 1.0 / static_cast<double>(i % different));
    const Values values(numbers);
    ASSERT_EQ(values.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(values[i]), std::bit_cast<std::uint64_t>(numbers[i])) << different << " " << i;
    }
  }
  EXPECT_TRUE(Values().empty());
  EXPECT_TRUE(Values(std::vector<double>()).empty());
}

}  // namespace
}  // namespace abut::contact
