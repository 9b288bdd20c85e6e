// Who is whose neighbour.
#include "abut/contact/surface.hpp"

#include <gtest/gtest.h>

#include <utility>

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

}  // namespace
}  // namespace abut::contact
