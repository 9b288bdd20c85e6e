// Imposed motion that is faster than the balance can show.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

// A displacement that jumps brings and takes energy within two cycles; what is left is rounding and no error.
TEST(ImposedJump, IsNoErrorOfTheBalance) {
  const std::string deck = materials + nodes(1, cube) + part(1, 1, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) +
                           group("GRNOD/NODE", 1, {1, 2, 3, 4, 5, 6, 7, 8}) + "/FUNCT/1\nat once\n" + reals({0, 0.5}) + reals({10, 0.5}) +
                           "/IMPDISP/1\njump\n         1         X         0         0         1         0         0\n" +
                           reals({0, 0, 0, 0});
  const abut::Run run = run_of(deck, engine(0.05));
  EXPECT_NEAR(run.displacements()[0].x, 0.5, 1e-12);
  EXPECT_GT(run.balance().largest, 0.0);
  EXPECT_LT(std::fabs(run.balance().err), 0.01);
  EXPECT_LT(std::fabs(run.balance().ledger), 0.01);
}

}  // namespace
}  // namespace abut::small_decks
