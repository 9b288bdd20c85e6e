// Friction: objective, dissipative, carried from facet to facet (T19..T23; issue 3, section 3).
#include "contact/enforce/friction.hpp"

#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cstdio>
#include <random>

#include "unit/contact/energy_scenes.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

Vec3 rotate(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (dot(axis, v) * (1 - c)) * axis;
}

// T22: never above the limit; every step dissipates; stored energy plus dissipation is the work done.
TEST(ReturnMapping, limits_dissipates_balances) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Vec3 e{}, before{};
  const double k = 2.0;
  double work = 0.0, dissipated = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 d = 0.1 * Vec3{u(random), u(random), 0.0};
    const double limit = 0.5 + 0.2 * u(random);
    const SlipResult r = slip(e, before, d, k, limit);
    ASSERT_LE(k * norm(r.elastic), limit * (1 + 1e-15));
    ASSERT_GE(r.dissipated, 0.0);
    work += 0.5 * dot(before + k * r.elastic, d);
    dissipated += r.dissipated;
    e = r.elastic;
    before = k * e;
  }
  EXPECT_NEAR(work, dissipated + 0.5 * k * squared_norm(e), 1e-3 * work);
}

struct Slider {
  Host host;
  Interface interface;
  std::size_t node;
};

Slider slider(const std::function<double(double, double)>& height, Options o, int cells = 8) {
  Host host;
  auto facets = grid(host, cells, cells, -4, 4, -4, 4, height);
  const Index n = host.add({0.13, 0.21, height(0.13, 0.21) - 0.01}, 1e6);
  const std::size_t count = facets.size();
  Interface i = Interface::nodes_to_surface({n}, {1.0}, Surface(std::move(facets)), o);
  set_stiffness(i, 1, count, 1.0);
  return {std::move(host), std::move(i), static_cast<std::size_t>(n)};
}

Options rubbing(double mu) {
  Options o;
  o.friction = mu;
  o.stiffness_scale = 2.0;
  return o;
}

// History passes over edges without loss: a sliding force, and a stick force, do not notice facet borders.
TEST(Friction, is_carried_from_facet_to_facet) {
  const double mu = 0.2, p = 0.01;
  Slider s = slider(flat, rubbing(mu));
  s.host.contact(s.interface);
  std::vector<Vec3> x = s.host.x;
  for (int i = 0; i < 400; ++i) {
    x[s.node] += Vec3{0.007, 0.005, 0.0};
    s.host.place(s.interface, x);
    const double path = norm(Vec3{0.007, 0.005, 0.0}) * (i + 1);
    EXPECT_NEAR(norm(Vec3{s.host.f[s.node].x, s.host.f[s.node].y, 0.0}), std::min(0.1 * path, mu * p), 1e-15);
  }
  // To the trapezoidal share of the one step in which sticking turns into sliding.
  const double one = norm(Vec3{0.007, 0.005, 0.0});
  EXPECT_NEAR(s.host.last.friction_work, mu * p * (one * 400 - 10 * mu * p), 0.5 * 0.1 * one * one);
  EXPECT_NEAR(s.host.last.made, 0.0, 1e-14);
}

// Work by friction on a closed path is lost exactly: CX stays zero while the direction turns.
TEST(Friction, closed_path_loses_what_it_dissipates) {
  Slider s = slider(flat, rubbing(0.2));
  s.host.contact(s.interface);
  std::vector<Vec3> x = s.host.x;
  double before = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double a = 2 * std::acos(-1.0) * i / 2000;
    x[s.node] = {0.13 + 1.5 * std::sin(a), 0.21 + 1.5 * (1 - std::cos(a)), -0.01 * (1.0 + 0.3 * std::sin(3 * a))};
    s.host.place(s.interface, x);
    ASSERT_GE(s.host.last.friction_work, before);
    before = s.host.last.friction_work;
  }
  std::printf("  CX / FW = %.2e\n", s.host.last.made / before);
  EXPECT_LT(std::abs(s.host.last.made), 1e-3 * before);
}

// Objectivity: a pair that sticks or slides while all of it tumbles feels the same force, turned with it.
TEST(Friction, is_objective) {
  const auto bumpy = [](double x, double y) { return 0.05 * x * x + 0.03 * x * y; };
  for (const double mu : {0.05, 5.0}) {
    Slider still = slider(bumpy, rubbing(mu));
    Slider turning = slider(bumpy, rubbing(mu));
    const Vec3 axis = normalized({0.2, -0.7, 0.5});
    std::vector<Vec3> x = still.host.x;
    still.host.contact(still.interface);
    turning.host.contact(turning.interface);
    for (int i = 1; i <= 200; ++i) {
      x[still.node] += Vec3{0.004, 0.003 * std::sin(0.1 * i), 0.0};
      std::vector<Vec3> y = x;
      for (Vec3& v : y) v = rotate(v, axis, 0.03 * i) + Vec3{0.1 * i, -0.2 * i, 0.05 * i};
      still.host.place(still.interface, x);
      turning.host.place(turning.interface, y);
      const Vec3 expected = rotate(still.host.f[still.node], axis, 0.03 * i);
      EXPECT_LT(norm(turning.host.f[turning.node] - expected), 1e-12 + 1e-11 * norm(expected)) << mu << " " << i;
    }
    EXPECT_NEAR(still.host.last.friction_work, turning.host.last.friction_work, 1e-12);
  }
}

// Isotropic on warped facets: the stick stiffness is the same in every direction.
TEST(Friction, is_isotropic_on_warped_facets) {
  const auto warped = [](double x, double y) { return 0.1 * x * y; };
  double low = 1e300, high = 0.0;
  for (int i = 0; i < 16; ++i) {
    Slider s = slider(warped, rubbing(50.0), 1);
    s.host.contact(s.interface);
    const double a = 2 * std::acos(-1.0) * i / 16;
    std::vector<Vec3> x = s.host.x;
    const double d = 1e-4;
    // Along the surface, at constant depth.
    const double px = 0.13 + d * std::cos(a), py = 0.21 + d * std::sin(a);
    x[s.node] = {px, py, warped(px, py) - 0.01};
    s.host.place(s.interface, x);
    std::vector<Vec3> normal(s.host.x.size()), tangential(s.host.x.size());
    s.interface.add_nodal_forces(normal, tangential);
    const double ratio = norm(tangential[s.node]) / norm(x[s.node] - Vec3{0.13, 0.21, warped(0.13, 0.21) - 0.01});
    low = std::min(low, ratio);
    high = std::max(high, ratio);
  }
  EXPECT_LT(high / low, 1.0021);  // depth over radius of curvature: 0.001 both ways
}

// T19: a block thrown on a rubbing surface: all its kinetic energy becomes friction work; the balance closes.
TEST(Friction, block_slides_to_rest) {
  const test::SlideToRest s = test::slide_to_rest(Rules::standard());
  std::printf("  kinetic %.4f -> %.2e, FW %.4f, CX %.2e, CE %.2e\n", s.kinetic, s.left, s.last.friction_work, s.last.made, s.last.elastic);
  EXPECT_NEAR(s.last.friction_work, s.kinetic, 0.02 * s.kinetic);
  EXPECT_LT(std::abs(s.last.made), 0.002 * s.kinetic);
}

}  // namespace
}  // namespace abut::contact
