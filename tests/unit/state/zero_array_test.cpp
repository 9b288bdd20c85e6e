#include "state/zero_array.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "abut/vec3.hpp"

namespace abut::state {
namespace {

TEST(ZeroArray, BeginsWithZerosOnALineOfTheCaches) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{3}, std::size_t{1000}, std::size_t{100000}}) {
    ZeroArray<Vec3> a(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % simd::cache_line, 0U);
    EXPECT_TRUE(std::all_of(a.begin(), a.end(), [](const Vec3& v) { return squared_norm(v) == 0.0; }));
    a[n - 1] = {1.0, 2.0, 3.0};
    const ZeroArray<Vec3> b = a;  // a copy has what was written, on memory of its own
    a[n - 1] = {};
    EXPECT_EQ(b[n - 1].y, 2.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b.data()) % simd::cache_line, 0U);
  }
}

}  // namespace
}  // namespace abut::state
