// The elementary functions of the state path: accurate, and the same bits for every width.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "simd/math.hpp"

namespace {

using abut::simd::Pack;

// 80-bit arithmetic of the C library: 11 bits more than what is tested.
long double relative_error(double value, long double exact) { return std::fabs((static_cast<long double>(value) - exact) / exact); }

std::vector<double> positive_samples(int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0), near_one(0.5, 2.0), strain(-9.0, 1.0);
  std::vector<double> x;
  for (int i = 0; i < count; ++i) {
    x.push_back(std::pow(10.0, exponent(random)));
    x.push_back(near_one(random));
    x.push_back(std::pow(10.0, strain(random)));
    x.push_back(1.0 + std::pow(10.0, strain(random) - 5.0));
  }
  x.insert(x.end(), {1.0, 2.0, 0.5, std::sqrt(0.5), std::nextafter(std::sqrt(0.5), 0.0), 0x1p-1022, 0x1p1023});
  return x;
}

TEST(Math, LogIsAccurateTo1e15Relative) {
  long double worst = 0.0L;
  for (const double x : positive_samples(50000)) {
    if (x == 1.0) {
      EXPECT_EQ(abut::simd::log(x), 0.0);
      continue;
    }
    worst = std::max(worst, relative_error(abut::simd::log(x), std::log(static_cast<long double>(x))));
  }
  RecordProperty("worst_relative_error", std::to_string(static_cast<double>(worst)));
  EXPECT_LT(worst, 1e-15L);
}

TEST(Math, ExpIsAccurateTo1e15Relative) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> wide(-707.0, 709.0), small(-1.0, 1.0);
  long double worst = 0.0L;
  for (int i = 0; i < 100000; ++i) {
    for (const double x : {wide(random), small(random), 1e-6 * small(random)}) {
      worst = std::max(worst, relative_error(abut::simd::exp(x), std::exp(static_cast<long double>(x))));
    }
  }
  EXPECT_LT(worst, 1e-15L);
  EXPECT_EQ(abut::simd::exp(0.0), 1.0);
}

// Exponents of hardening laws, and some that no law has.
TEST(Math, PowIsAccurateTo4e16TimesOnePlusTheExponent) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> exponent(-24.0, 24.0), strain(-12.0, 1.0), hardening(0.01, 1.0);
  const auto error = [](double x, double y) {
    return relative_error(abut::simd::pow(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y)));
  };
  long double worst = 0.0L, of_laws = 0.0L;
  for (int i = 0; i < 200000; ++i) {
    const double x = std::pow(10.0, strain(random)), n = hardening(random), y = exponent(random);  // x^y between 1e-288 and 1e288
    of_laws = std::max({of_laws, error(x, n), error(x, n - 1.0)});
    worst = std::max(worst, error(x, y) / (1.0L + std::fabs(static_cast<long double>(y))));
  }
  RecordProperty("worst_of_laws", std::to_string(1e16 * static_cast<double>(of_laws)));
  EXPECT_LT(of_laws, 5e-16L);
  EXPECT_LT(worst, 4e-16L);
}

TEST(Math, InverseCubeRootIsAccurateTo4e16Relative) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-307.0, 307.0);
  std::vector<double> x{1.0, 0.5, 2.0, 4.0, 8.0, 0.125, 0x1p-1022, 0x1.fffffffffffffp1023};
  for (int i = 0; i < 100000; ++i) x.push_back(std::pow(10.0, exponent(random)));
  long double worst = 0.0L;
  for (const double v : x)
    worst = std::max(worst, relative_error(abut::simd::inverse_cube_root(v), 1.0L / std::cbrt(static_cast<long double>(v))));
  RecordProperty("worst_relative_error", std::to_string(1e16 * static_cast<double>(worst)));
  EXPECT_LT(worst, 4e-16L);
}

// Up to the ends of the range: no step where the scale is put together, nothing where numbers would be subnormal.
TEST(Math, PowReachesTheEndsOfTheRange) {
  for (const double x : {1e-300, 0.3, 1.7, 1e300}) {
    const double ends = 1022.0 / std::abs(std::log2(x));
    for (const double share : {-1.0005, -0.998, 0.998, 1.0005}) {
      const double y = share * ends;
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
      const double value = abut::simd::pow(x, y);
      if (exact < 0x1p-1021L) {
        EXPECT_EQ(value, 0.0) << x << ' ' << y;
      } else {
        EXPECT_LT(relative_error(value, exact), 4e-16L * (1.0L + std::abs(y))) << x << ' ' << y;
      }
    }
    EXPECT_EQ(abut::simd::pow(x, (x > 1.0 ? 2.0 : -2.0) * ends), std::numeric_limits<double>::infinity());
    EXPECT_EQ(abut::simd::pow(x, (x > 1.0 ? -2.0 : 2.0) * ends), 0.0);
  }
}

TEST(Math, SpecialArguments) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(abut::simd::log(0.0), -inf);
  EXPECT_TRUE(std::isnan(abut::simd::log(-1.0)));
  EXPECT_EQ(abut::simd::log(inf), inf);
  EXPECT_TRUE(std::isnan(abut::simd::log(std::nan(""))));
  EXPECT_EQ(abut::simd::exp(-1000.0), 0.0);
  EXPECT_EQ(abut::simd::exp(-inf), 0.0);
  EXPECT_EQ(abut::simd::exp(710.0), inf);
  EXPECT_EQ(abut::simd::exp(inf), inf);
  EXPECT_TRUE(std::isnan(abut::simd::exp(std::nan(""))));
  EXPECT_EQ(abut::simd::pow(0.0, 0.3), 0.0);
  EXPECT_EQ(abut::simd::pow(0.0, 0.0), 1.0);
  EXPECT_EQ(abut::simd::pow(0.0, -0.5), inf);
  EXPECT_EQ(abut::simd::pow(5.0, 0.0), 1.0);
  EXPECT_EQ(abut::simd::pow(1.0, 0.37), 1.0);
  EXPECT_TRUE(std::isnan(abut::simd::pow(-2.0, 0.5)));
  EXPECT_TRUE(std::isnan(abut::simd::pow(std::nan(""), 0.5)));
  EXPECT_EQ(abut::simd::pow(inf, 0.5), inf);
}

template <int W>
void expect_same_bits() {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0.01, 1.5);
  std::vector<double> x = positive_samples(2000);
  x.insert(x.end(), {0.0, -1.0, 1e-320, std::numeric_limits<double>::infinity()});
  while (x.size() % 8 != 0) x.push_back(1.0);
  for (std::size_t i = 0; i + W <= x.size(); i += W) {
    double y[W], z[W], logs[W], exps[W], pows[W];
    for (int l = 0; l < W; ++l) {
      y[l] = unit(random);
      z[l] = 100.0 * (unit(random) - 0.7);
    }
    abut::simd::store(logs, abut::simd::log(abut::simd::load<W>(&x[i])));
    abut::simd::store(exps, abut::simd::exp(abut::simd::load<W>(z)));
    abut::simd::store(pows, abut::simd::pow(abut::simd::load<W>(&x[i]), abut::simd::load<W>(y)));
    for (int l = 0; l < W; ++l) {
      const double xs = x[i + static_cast<std::size_t>(l)];
      const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
      };
      EXPECT_TRUE(same(logs[l], abut::simd::log(xs))) << "log " << xs;
      EXPECT_TRUE(same(exps[l], abut::simd::exp(z[l]))) << "exp " << z[l];
      EXPECT_TRUE(same(pows[l], abut::simd::pow(xs, y[l]))) << "pow " << xs << ' ' << y[l];
    }
  }
}

TEST(Math, EveryWidthGivesTheBitsOfTheScalar) {
  expect_same_bits<2>();
  expect_same_bits<4>();
  expect_same_bits<8>();
}

TEST(Math, AngleIsAccurateTo1e15RelativeInAllOctants) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> side(-1.0, 1.0), exponent(-12.0, 12.0);
  long double worst = 0.0L;
  for (int i = 0; i < 200000; ++i) {
    const double x = side(random) * std::pow(10.0, exponent(random)), y = std::abs(side(random)) * std::pow(10.0, exponent(random));
    worst =
        std::max(worst, relative_error(abut::simd::angle_of(x, y), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 1e-15L);
  EXPECT_EQ(abut::simd::angle_of(1.0, 0.0), 0.0);
  EXPECT_EQ(abut::simd::angle_of(0.0, 0.0), 0.0);
  EXPECT_EQ(abut::simd::angle_of(0.0, 1.0), 0x1.921fb54442d18p+0);
  EXPECT_EQ(abut::simd::angle_of(-1.0, 0.0), 0x1.921fb54442d18p+1);
}

TEST(Math, AngleHasTheSameBitsInEveryWidth) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    Pack<4> x, y;
    for (int l = 0; l < 4; ++l) {
      x.r[l] = side(random);
      y.r[l] = std::abs(side(random));
    }
    const Pack<4> a = abut::simd::angle_of(x, y);
    for (int l = 0; l < 4; ++l) EXPECT_EQ(a.r[l], abut::simd::angle_of(x.r[l], y.r[l]));
  }
}

}  // namespace
