// What a run says of energy that went into hourglass modes.
#include <gtest/gtest.h>

#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

// A brick of which every other edge moves along itself: half of its energy is translation, the other half an hourglass mode, which is
// damped.
TEST(Hourglass, ALargeShareIsSaidAtTheEnd) {
  const std::string brick = materials + nodes(1, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}) +
                            part(1, 1, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto moving = [&brick](const std::vector<int>& which) {
    return run_of(
        brick + group("GRNOD/NODE", 1, which) + "/INIVEL/TRA/1\nstart\n" + fmt::format("{:>20g}{:>20g}{:>20g}{:>10}\n", 0.0, 0.0, 1e-3, 1),
        engine(0.5));
  };
  const abut::Run damped = moving({1, 3, 5, 7});
  EXPECT_GT(damped.balance().he, 0.4 * damped.balance().largest);
  ASSERT_EQ(damped.findings().size(), 1U);
  EXPECT_EQ(damped.findings()[0].diagnostic.code, "run.hourglass_energy");
  EXPECT_NE(damped.findings()[0].diagnostic.message.find("% of the largest energy has gone into hourglass modes (HE), more than 10 %"),
            std::string::npos);
  EXPECT_TRUE(moving({1, 2, 3, 4, 5, 6, 7, 8}).findings().empty());
}

}  // namespace
}  // namespace abut::small_decks
