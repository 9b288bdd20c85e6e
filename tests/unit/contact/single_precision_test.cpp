// What the search keeps in single precision errs to the safe side only.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "contact/search/candidates.hpp"

namespace abut::contact {
namespace {

/// Numbers of both signs and all sizes between 1e-40 and 1e40.
class Numbers {
 public:
  double next() { return (random_() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent_(random_)); }
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> exponent_{-40.0, 40.0};
};

TEST(SinglePrecision, BoxesHoldTheirBoxesAndLittleMore) {
  Numbers numbers;
  for (int n = 0; n < 2000; ++n) {
    Bounds box;
    for (int k = 0; k < 2; ++k) box.include(Vec3{numbers.next(), numbers.next(), numbers.next()});
    const Bounds coarse = CoarseBounds(box).bounds();
    for (int k = 0; k < 3; ++k) {
      if (std::abs(box.low[k]) > 2e38 || std::abs(box.high[k]) > 2e38) continue;  // beyond what a float holds
      EXPECT_LE(coarse.low[k], box.low[k]);
      EXPECT_GE(coarse.high[k], box.high[k]);
      EXPECT_GE(coarse.low[k], box.low[k] - 4e-7 * std::abs(box.low[k]) - 1e-37);
      EXPECT_LE(coarse.high[k], box.high[k] + 4e-7 * std::abs(box.high[k]) + 1e-37);
    }
  }
}

TEST(SinglePrecision, BoxesThatMeetStillMeet) {
  Numbers numbers;
  int met = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto box = [&] {
      const Vec3 x{numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0)};
      Bounds b{x, x};
      b.inflate(numbers.between(0.0, 1.0));
      return b;
    };
    const Bounds a = box(), b = box();
    met += a.meets(b) ? 1 : 0;
    EXPECT_TRUE(!a.meets(b) || CoarseBounds(a).meets(CoarseBounds(b)));
    const Bounds touching{a.high, a.high + Vec3{1.0, 1.0, 1.0}};
    EXPECT_TRUE(CoarseBounds(a).meets(CoarseBounds(touching)));
  }
  EXPECT_GT(met, 500);
}

TEST(SinglePrecision, NothingIsDueLaterThanItWas) {
  Numbers numbers;
  for (int n = 0; n < 2000; ++n) {
    const double given = numbers.next();
    if (given < -2e38) continue;
    EXPECT_LE(Due(given), given);
    if (std::abs(given) < 2e38) { EXPECT_GE(Due(given), given - 4e-7 * std::abs(given) - 1e-37); }
  }
  EXPECT_GT(Due(1e300), 1e38);
  EXPECT_LT(Due(-1e300), -1e38);
}

TEST(SinglePrecision, MotionSincePositionsWereKeptIsBoundedFromAbove) {
  Numbers numbers;
  for (const double away : {0.0, 1.0, 1e4}) {
    std::vector<Vec3> x(200);
    for (Vec3& p : x) p = {away + numbers.between(-1.0, 1.0), away + numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0)};
    Positions kept;
    kept.keep(x);
    const Vec3 common{0.3, -0.2, 0.1};
    double largest = 0.0;
    for (Vec3& p : x) {
      const Vec3 own{numbers.between(-1e-3, 1e-3), numbers.between(-1e-3, 1e-3), numbers.between(-1e-3, 1e-3)};
      p += common + own;
      largest = std::max(largest, norm(own));
    }
    EXPECT_GE(kept.largest_motion(x, common), largest * (1.0 - 1e-9));
    // Coordinates are kept as parts of their extent (2 at most) of 21 bits: half a unit off, and the bound allows for as much again.
    // Where the nodes are does not matter.
    const double unit = 2.0 / ((1 << 21) - 1);
    EXPECT_LE(kept.largest_motion(x, common), largest + std::sqrt(3.0) * unit + 1e-15 * away);
  }
}

}  // namespace
}  // namespace abut::contact
