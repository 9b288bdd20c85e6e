// What is said of facets without measuring them is never more than what measuring finds.
#include "contact/enforce/facet_views.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/project/closest_point.hpp"

namespace abut::contact {
namespace {

constexpr double dt = 1e-3;

struct Scene {
  std::vector<Vec3> x, before, v;
  Side side{Surface({Facet{{0, 1, 2, 3}}}), false};
};

// Oblique facets, from flat to much warped, that move and deform.
Scene some_facet(std::mt19937& random, double warp) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto any = [&](double size) { return Vec3{size * u(random), size * u(random), size * u(random)}; };
  Scene scene;
  const Vec3 common = any(0.02);
  for (const auto& [s, t] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    scene.x.push_back(Vec3{s + 0.8 * t, t, 0.0} + any(warp));
    scene.before.push_back(scene.x.back() - common - any(0.01));
    scene.v.push_back((1.0 / dt) * (common + any(0.01)));
  }
  scene.side.gather(scene.x);
  return scene;
}

struct Found {
  double distance = 0.0, nearing = 0.0, last = 0.0, coming = 0.0;
};
// The node measured: how far from the facet without strips, how fast it nears the closest point, its motions relative to that.
Found measured(const Scene& scene, const Vec3& x, const Vec3& last, const Vec3& coming) {
  Patch patch = scene.side.patch(0);
  patch.borders = 0;
  const ClosestPoint c = closest_point(patch, x);
  Vec3 of_last = last, of_coming = coming;
  for (std::size_t k = 0; k < 4; ++k) {
    of_last -= c.weight[k] * (scene.x[k] - scene.before[k]);
    of_coming -= c.weight[k] * (dt * scene.v[k]);
  }
  const double distance = std::sqrt(c.squared_distance);
  return {distance, -dot(of_coming, x - c.point) / distance, norm(of_last), norm(of_coming)};
}

TEST(FacetViews, bound_what_measuring_finds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int told = 0, slow = 0, shots = 0;
  for (const double warp : {0.0, 0.005, 0.05, 0.5}) {
    for (int facet = 0; facet < 200; ++facet) {
      const Scene scene = some_facet(random, warp);
      FacetViews views;
      views.forget();
      const FacetView& view = views.moving(scene.side, scene.before, scene.v, dt, 0);
      for (int shot = 0; shot < 50; ++shot) {
        const Vec3 x{1.8 * u(random), 1.2 * u(random), 0.6 * (1.0 + u(random))};
        const Vec3 last{0.05 * u(random), 0.05 * u(random), 0.05 * u(random)}, coming{0.05 * u(random), 0.05 * u(random), 0.05 * u(random)};
        const Found found = measured(scene, x, last, coming);
        const double height = view.height(x);
        ASSERT_LE(height, found.distance * (1.0 + 1e-12));
        const double way = 0.06 * (1.0 + u(random));
        if (view.moves_less(last, coming, 1.0, way)) {
          ++slow;
          ASSERT_LT(std::max(found.last, found.coming), way);
        }
        if (height <= 0.0 || !view.comes_less(x, height, coming, way)) continue;
        ++told;
        ASSERT_LT(found.nearing, way) << "warp " << warp;
      }
      shots += 50;
    }
  }
  EXPECT_GT(told, shots / 20);
  EXPECT_GT(slow, shots / 20);
}

// A view belongs to the step that it was taken in.
TEST(FacetViews, are_taken_anew_in_every_step) {
  std::mt19937 random(6);
  Scene scene = some_facet(random, 0.0);
  FacetViews views;
  views.forget();
  const Vec3 x{0.0, 0.0, 1.0};
  const double height = views.plane(scene.side, 0).height(x);
  for (Vec3& corner : scene.x) corner.z += 0.25;
  scene.side.gather(scene.x);
  EXPECT_EQ(views.plane(scene.side, 0).height(x), height);
  views.forget();
  EXPECT_NEAR(views.plane(scene.side, 0).height(x), height - 0.25, 1e-14);
}

}  // namespace
}  // namespace abut::contact
