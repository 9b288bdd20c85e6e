// Friction step by step: it never gives energy, and it knows no direction (T19 to T23; issue 3, section 3).
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cstdio>
#include <random>

#include "contact/enforce/friction.hpp"
#include "contact/project/closest_point.hpp"
#include "contact/surface/side.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

// T22: two rough surfaces are rubbed against each other at random, bent and turned meanwhile; the limits change from step to step. FW never
// falls, and what a force that reverses within a step leaves (slip() counts it as zero) is all that is missing from the balance.
TEST(FrictionSteps, dissipate_in_every_random_step) {
  double worst = 0.0;
  long steps = 0, slips = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Host host;
    const auto lower = grid(host, 6, 6, -3, 3, -3, 3, [](double x, double y) { return 0.01 * x * x - 0.004 * x * y; });
    const std::size_t first = host.x.size();
    const auto upper = grid(
        host, 3, 3, -0.8, 0.8, -0.8, 0.8, [](double x, double y) { return 0.01 * x * x - 0.004 * x * y + 0.02; }, false, seed % 2 == 0);
    for (double& m : host.m) m = 1.0;
    Options o;
    o.gap = 0.05;
    o.friction = seed % 3 == 0 ? 0.3 : 0.05;
    o.stiffness_scale = 1.0;
    o.rules.switch_correction = false;  // imposed motion
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
    set_stiffness(i, 0, lower.size(), 1.0);
    set_stiffness(i, 1, upper.size(), 2.0);
    host.contact(i);
    const std::vector<Vec3> at_rest = host.x;
    Vec3 shift{}, drift{};
    double before = 0.0, largest = 0.0;
    for (int step = 0; step < 1500; ++step) {
      if (step % 50 == 0) drift = 0.004 * Vec3{u(random), u(random), 0.0};
      if (norm(shift + drift) > 0.6) drift = -1.0 * drift;
      shift += drift + 0.001 * Vec3{u(random), u(random), 0.0};
      std::vector<Vec3> x = at_rest;
      for (std::size_t n = 0; n < x.size(); ++n) {
        if (n >= first) x[n] += shift + Vec3{0, 0, 0.004 * std::sin(0.05 * step)};
        x[n].z += 0.003 * std::sin(0.02 * step + x[n].x);
      }
      host.place(i, x);
      ASSERT_GE(host.last.friction_work, before) << seed << " " << step;
      if (host.last.friction_work > before) ++slips;
      before = host.last.friction_work;
      largest = std::max(largest, host.last.elastic);
      ++steps;
    }
    worst = std::max(worst, std::abs(host.last.made) / before);
    EXPECT_GT(before, largest) << seed;
  }
  std::printf("  %ld steps, energy was dissipated in %ld, taken back in none; worst |CX|/FW %.1e\n", steps, slips, worst);
  EXPECT_GT(slips, steps / 2);
  EXPECT_LT(worst, 0.001);
}

// T20, T21: on a warped facet the stick force is K/10 times the way of the contact point, C0C1, and the sliding force mu |Fn| against it,
// the same for every direction.
TEST(FrictionSteps, every_direction_is_alike_on_a_warped_facet) {
  const auto warped = [](double x, double y) { return 0.3 * x * y; };
  double stick = 0.0, slide = 0.0, across = 0.0;
  for (int direction = 0; direction < 64; ++direction) {
    for (const bool slides : {false, true}) {
      Host host;
      const auto facets = grid(host, 1, 1, -1, 1, -1, 1, warped);
      const Vec3 start{0.13, 0.21, warped(0.13, 0.21) - 0.01};
      const auto n = static_cast<std::size_t>(host.add(start, 1e6));
      Options o;
      o.friction = slides ? 0.05 : 50.0;
      o.stiffness_scale = 2.0;
      Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
      set_stiffness(i, 1, facets.size(), 1.0);
      Side surface(Surface(facets), true);
      surface.set({}, false);
      surface.gather(host.x);
      host.contact(i);
      const Vec3 c0 = closest_point(surface.patch(0), host.x[n]).point;
      const double a = 2.0 * std::acos(-1.0) * direction / 64;
      const double d = slides ? 0.1 : 1e-3;
      const double px = 0.13 + d * std::cos(a), py = 0.21 + d * std::sin(a);
      std::vector<Vec3> x = host.x;
      x[n] = {px, py, warped(px, py) - 0.01};
      host.place(i, x);
      std::vector<Vec3> normal(x.size()), tangential(x.size());
      i.add_nodal_forces(normal, tangential);
      const Vec3 way = closest_point(surface.patch(0), x[n]).point - c0;
      const Vec3 direction_n = normalized(normal[n]);
      const Vec3 along = way - dot(way, direction_n) * direction_n;
      const double expected = slides ? o.friction * norm(normal[n]) : 0.1 * norm(along);
      double& worst = slides ? slide : stick;
      worst = std::max(worst, std::abs(norm(tangential[n]) / expected - 1.0));
      across = std::max(across, norm(normalized(tangential[n]) + normalized(along)));
    }
  }
  std::printf("  64 directions: stick force off by %.1e, sliding force by %.1e, direction by %.1e\n", stick, slide, across);
  EXPECT_LT(stick, 1e-10);
  EXPECT_LT(slide, 1e-10);
  EXPECT_LT(across, 1e-10);
}

// A node rubs over a change of stiffness of 4:1, with a filter and without: all that its friction takes is in FW. (One way: where the way
// turns, a filtered force still points where it did, and what it gives then is in CX.)
TEST(FrictionSteps, filter_books_its_work_where_the_stiffness_changes) {
  for (const bool filtered : {false, true}) {
    Host host;
    const auto facets = grid(host, 4, 1, -2, 2, -1, 1, test::flat);
    const auto n = static_cast<std::size_t>(host.add({-1.5, 0.1, -0.05}, 1.0));
    Options o;
    o.friction = 0.2;
    o.stiffness_scale = 1.0;
    o.rules.switch_correction = false;  // imposed motion
    if (filtered) o.filter.share = 0.3;
    Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
    const std::vector<double> k{1.0, 1.0, 4.0, 4.0};
    i.set_surface(1, {k, {}, {}});
    host.contact(i);
    for (int step = 1; step <= 1000; ++step) {
      std::vector<Vec3> x = host.x;
      x[n].x = -1.5 + 3.0 * step / 1000;
      host.place(i, x);
    }
    const double made = host.last.made / host.last.friction_work;
    std::printf("  filter %d: FW %.4g, CX %.2e of it\n", filtered ? 1 : 0, host.last.friction_work, made);
    EXPECT_GT(host.last.friction_work, 0.0);
    EXPECT_LT(std::abs(made), 0.002);
  }
}

}  // namespace
}  // namespace abut::contact
