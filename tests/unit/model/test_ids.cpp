// Ids in ranges are the ids that were given.
#include <gtest/gtest.h>

#include "model/ids.hpp"

namespace abut::model {
namespace {

TEST(Ids, GiveBackRangesSingleIdsAndLargeOnes) {
  EXPECT_TRUE(Ids().empty());
  for (const std::vector<Id>& given : {std::vector<Id>{7}, {1, 2, 3}, {1, 2, 3, 10, 12, 13, 14}, {5, 9999999998, 9999999999}, {3, 1, 2}}) {
    Ids ids;
    for (const Id id : given) ids.push_back(id);
    EXPECT_EQ(ids.all(), given);
    ASSERT_EQ(ids.size(), given.size());
    for (std::size_t i = 0; i < given.size(); ++i) EXPECT_EQ(ids[i], given[i]);
    EXPECT_EQ(ids.front(), given.front());
    EXPECT_EQ(ids.back(), given.back());
  }
  EXPECT_EQ((Ids{1, 2, 4}).all(), (std::vector<Id>{1, 2, 4}));
}

}  // namespace
}  // namespace abut::model
