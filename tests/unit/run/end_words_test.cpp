// What a run says at its end, and at its start, of energy and mass that are not of the model.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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

// A brick at rest whose step is to be several times its own: the share of mass that the finding says is that of the balance.
TEST(MassScaling, MuchIsSaidAtTheEnd) {
  const std::string brick = materials + nodes(1, cube) + part(1, 1, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto scaled = [&brick](double minimum) { return run_of(brick, engine(0.1, fmt::format("/DT/NODA/CST\n0.9 {:g}\n", minimum))); };
  const abut::Run heavy = scaled(1e-3);
  const Balance& b = heavy.balance();
  const double share = b.added_mass / (b.mass - b.added_mass);
  EXPECT_GT(share, 1.0);
  ASSERT_EQ(heavy.findings().size(), 1U);
  EXPECT_EQ(heavy.findings()[0].diagnostic.code, "run.added_mass");
  EXPECT_NE(heavy.findings()[0].diagnostic.message.find(fmt::format("/DT/NODA/CST has added {:.3g} % to the mass", 100.0 * share)),
            std::string::npos)
      << heavy.findings()[0].diagnostic.message;
  EXPECT_TRUE(scaled(1e-6).findings().empty());
}

// Two plates at rest within the gap: what they have when they have parted is what contact held, less the share that the finding says.
TEST(FirstStep, TakesWhatItSaysOfTheContactAtTheStart) {
  const auto parted = [](double scale) {
    std::vector<Vec3> x = square;
    for (const Vec3& p : square) x.push_back({p.x, p.y, 0.04});
    const std::string plates =
        materials + nodes(1, x) + part(1, 2, 1) + element("SHELL", 1, 1, {1, 2, 3, 4}) + element("SHELL", 1, 2, {5, 8, 7, 6}) +
        "/SURF/SEG/1\nlower\n" + ints({1, 1, 2, 3, 4}) + "/SURF/SEG/2\nupper\n" + ints({1, 5, 8, 7, 6}) + "/INTER/TYPE3/1\ncontact\n" +
        ints({1, 2, 0, 0, 0, 0, 0, 0}) + reals({0.2, 0, 0.1, 0, 0}) + "       000         0         0\n" + reals({0});
    return run_of(plates, engine(0.01, fmt::format("/DT\n{:g} 0.\n", scale)));
  };
  std::vector<double> taken;
  for (const double scale : {0.9, 0.45}) {
    const abut::Run run = parted(scale);
    const Balance& b = run.balance();
    EXPECT_EQ(b.ce, 0.0);
    const double lost = 1.0 - (b.ie + b.he + b.ke + b.ker - b.cx) / first(run, "GLOBAL/CE");
    ASSERT_FALSE(run.findings().empty());
    const RunFinding& found = run.findings()[0];
    EXPECT_EQ(found.diagnostic.code, "contact.first_step");
    EXPECT_EQ(found.nodes.size(), 8U);
    EXPECT_NEAR(found.measure, lost, 0.002);
    EXPECT_LT(std::fabs(b.err), 0.01);
    taken.push_back(found.measure);
  }
  EXPECT_NEAR(taken[1], 0.25 * taken[0], 0.02 * taken[0]);
}

}  // namespace
}  // namespace abut::small_decks
