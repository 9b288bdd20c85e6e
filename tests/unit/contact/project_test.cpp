// Projection on triangles and bilinear facets, also nasty ones (issue 3, section 2), and the plain closed form (numerics.md 9.6, 9.7).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/project/closest_point.hpp"
#include "contact/project/plain.hpp"

namespace abut::contact {
namespace {

using Random = std::mt19937;

Vec3 somewhere(Random& random, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  return {u(random), u(random), u(random)};
}

std::vector<std::pair<const char*, Patch>> nasty() {
  std::vector<std::pair<const char*, Patch>> all;
  all.push_back({"square", {{Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, 0}}}});
  all.push_back({"needle", {{Vec3{0, 0, 0}, Vec3{100, 0, 0}, Vec3{100, 0.1, 0}, Vec3{0, 0.1, 0}}}});
  all.push_back({"warped", {{Vec3{-1, -1, 0.3}, Vec3{1, -1, -0.3}, Vec3{1, 1, 0.3}, Vec3{-1, 1, -0.3}}}});
  all.push_back({"very warped", {{Vec3{-1, -1, 1}, Vec3{1, -1, -1}, Vec3{1, 1, 1}, Vec3{-1, 1, -1}}}});
  all.push_back({"dart", {{Vec3{0, 0, 0}, Vec3{1, -1, 0}, Vec3{0.3, 0, 0}, Vec3{1, 1, 0}}}});
  all.push_back({"nearly a triangle", {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1 - 1e-7, 1, 0}}}});
  all.push_back({"collinear corner", {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}, Vec3{1, 1, 0}}}});
  all.push_back({"far from the origin",
                 {{Vec3{1e4, 1e4, 1e4}, Vec3{1e4 + 1, 1e4, 1e4}, Vec3{1e4 + 1, 1e4 + 1, 1e4 + 0.2}, Vec3{1e4, 1e4 + 1, 1e4}}}});
  all.push_back({"tiny", {{Vec3{0, 0, 0}, Vec3{1e-9, 0, 0}, Vec3{1e-9, 1e-9, 2e-10}, Vec3{0, 1e-9, 0}}}});
  all.push_back({"triangle", {{Vec3{0, 0, 0}, Vec3{1, 0, 0.2}, Vec3{0.3, 1, 0}, Vec3{0.3, 1, 0}}, true}});
  all.push_back({"sliver", {{Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{5, 1e-3, 0}, Vec3{5, 1e-3, 0}}, true}});
  return all;
}

double size_of(const Patch& p) { return std::max(norm(p.x[2] - p.x[0]), norm(p.x[3] - p.x[1])); }

// The closest point is not further than any point of a fine sampling, and satisfies its conditions to 1e-12 of the size.
TEST(ClosestPoint, beats_sampling_and_is_stationary) {
  Random random(5);
  for (const auto& [name, base] : nasty()) {
    for (unsigned borders : {0u, 5u, 15u}) {
      Patch patch = base;
      patch.borders = static_cast<std::uint8_t>(patch.triangle ? borders & 7u : borders);
      const double size = size_of(patch);
      const Vec3 centre = 0.25 * (patch.x[0] + patch.x[1] + patch.x[2] + patch.x[3]);
      const int shots = 400;
      for (int shot = 0; shot < shots; ++shot) {
        const Vec3 x = centre + somewhere(random, shot % 2 == 0 ? 0.3 * size : 1.5 * size);
        const ClosestPoint c = closest_point(patch, x);
        const auto open = [&patch](int side) { return (patch.borders >> side & 1) != 0; };
        double best = 1e300;
        const int n = 24;
        for (int i = 0; i <= n; ++i) {
          for (int j = 0; j <= n; ++j) {
            double s = 0, t = 0;
            if (patch.triangle) {
              const double low_s = open(2) ? -border_strip : 0.0, low_t = open(0) ? -border_strip : 0.0;
              const double high = 1.0 + (open(1) ? border_strip : 0.0);
              s = low_s + (high - low_s - low_t) * i / n;
              t = low_t + (high - s - low_t) * j / n;
            } else {
              const double w = 2 * border_strip;
              s = -1 - (open(3) ? w : 0) + (2 + (open(3) ? w : 0) + (open(1) ? w : 0)) * i / n;
              t = -1 - (open(0) ? w : 0) + (2 + (open(0) ? w : 0) + (open(2) ? w : 0)) * j / n;
            }
            best = std::min(best, norm(x - position(patch, s, t)));
          }
        }
        const double distance = std::sqrt(c.squared_distance);
        ASSERT_LE(distance, best + 1e-11 * (size + norm(centre) * 1e-4)) << name << " borders " << borders;
        if (c.feature == Feature::face) {
          const auto tangent = tangents(patch, c.s, c.t);
          const Vec3 r = x - c.point;
          for (const Vec3& a : tangent) {
            const double scale = norm(a);
            if (scale > 1e-6 * size) { ASSERT_LT(std::abs(dot(r, a)) / scale, 1e-12 * (size + distance + norm(centre))) << name; }
          }
        }
        double sum = 0;
        for (const double w : c.weight) sum += w;
        ASSERT_NEAR(sum, 1.0, 1e-14);
      }
    }
  }
}

// The bound is never above the distance; where sides are parallel it is the distance, but beside a few oblique corners.
TEST(ClosestPoint, a_bound_of_its_distance) {
  Random random(11);
  for (const auto& [name, base] : nasty()) {
    for (const unsigned borders : {0u, 5u, 15u}) {
      Patch patch = base;
      patch.borders = static_cast<std::uint8_t>(patch.triangle ? borders & 7u : borders);
      const double size = size_of(patch);
      const Vec3 centre = 0.25 * (patch.x[0] + patch.x[1] + patch.x[2] + patch.x[3]);
      for (int shot = 0; shot < 3000; ++shot) {
        const Vec3 x = centre + somewhere(random, (shot % 3 == 0 ? 0.01 : shot % 3 == 1 ? 0.5 : 3.0) * size);
        ASSERT_LE(distance_at_least(patch, x), std::sqrt(closest_point(patch, x).squared_distance)) << name << " borders " << borders;
      }
    }
  }
  const Patch oblique{{Vec3{0, 0, 0}, Vec3{2, 0, 0.5}, Vec3{2.7, 1, 0.8}, Vec3{0.7, 1, 0.3}}, false, 2};
  int exact = 0;
  for (int shot = 0; shot < 3000; ++shot) {
    const Vec3 x = oblique.x[0] + somewhere(random, 4.0);
    const double distance = std::sqrt(closest_point(oblique, x).squared_distance), bound = distance_at_least(oblique, x);
    ASSERT_GT(bound, 0.95 * distance);
    exact += bound > (1.0 - 1e-12) * distance ? 1 : 0;
  }
  EXPECT_GT(exact, 2900);
}

// The taper's gradient by finite differences.
TEST(Taper, gradient_is_its_derivative) {
  for (const bool triangle : {false, true}) {
    Patch patch{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}, triangle, static_cast<std::uint8_t>(triangle ? 7 : 15)};
    Random random(3);
    std::uniform_real_distribution<double> u(triangle ? -0.12 : -1.25, 1.25);
    for (int i = 0; i < 2000; ++i) {
      const double s = u(random), t = u(random), d = 1e-7;
      const Taper at = taper(patch, s, t);
      EXPECT_NEAR(at.ds, (taper(patch, s + d, t).value - taper(patch, s - d, t).value) / (2 * d), 2e-4);
      EXPECT_NEAR(at.dt, (taper(patch, s, t + d).value - taper(patch, s, t - d).value) / (2 * d), 2e-4);
      EXPECT_GE(at.value, 0.0);
      EXPECT_LE(at.value, 1.0);
    }
  }
}

// numerics.md 9.6: exact for parallelograms; 9.7: triangles.
TEST(PlainProjection, closed_form) {
  const Patch square{{Vec3{-0.5, -0.5, 0}, Vec3{0.5, -0.5, 0}, Vec3{0.5, 0.5, 0}, Vec3{-0.5, 0.5, 0}}};
  const PlainPoint p = project_plain(square, {0.25, -0.3, -0.1}, 0.0, true);
  EXPECT_NEAR(p.s, 0.5, 1e-15);
  EXPECT_NEAR(p.t, -0.6, 1e-15);
  EXPECT_NEAR(p.distance, -0.1, 1e-15);
  const Patch skewed{{Vec3{0, 0, 0}, Vec3{2, 0.5, 0.1}, Vec3{2.7, 1.9, 0.5}, Vec3{0.7, 1.4, 0.4}}};
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    std::uniform_real_distribution<double> u(-0.99, 0.99);
    const double s = u(random), t = u(random);
    const Vec3 x = position(skewed, s, t) + 0.2 * normal_at(skewed, s, t);
    for (const bool ratios : {true, false}) {
      const PlainPoint q = project_plain(skewed, x, 0.0, ratios);
      EXPECT_NEAR(q.s, s, 1e-13);
      EXPECT_NEAR(q.t, t, 1e-13);
      EXPECT_NEAR(q.distance, 0.2, 1e-13);
    }
  }
  const Patch triangle{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.2, 1, 0}, Vec3{0.2, 1, 0}}, true};
  EXPECT_NEAR(project_plain(triangle, {0.2, 1, 0}, 0.0, true).t, 1.0, 1e-14);
  const PlainPoint middle = project_plain(triangle, {0.5, 0, 0}, 0.0, true);
  EXPECT_NEAR(middle.t, -1.0, 1e-14);
  EXPECT_NEAR(middle.s, 0.0, 1e-14);
  EXPECT_EQ(edge_tolerance(0.0, 1.0), 0.05);
  EXPECT_EQ(edge_tolerance(0.05, 1.0), 0.1);
  EXPECT_EQ(edge_tolerance(1.0, 1.0), 0.2);
}

}  // namespace
}  // namespace abut::contact
