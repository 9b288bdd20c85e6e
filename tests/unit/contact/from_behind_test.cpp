// What never touched the contact side gets no energy from it (docs/theory/contact.md, 1).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <span>
#include <utility>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

// T31: a node that comes up through a surface from behind, however it is listed and however slow it is, flies on as before; when it
// comes back from the front it is held with all of its gap.
TEST(FromBehind, node_passes_and_gets_nothing) {
  for (const double speed : {0.003, 0.05, 0.4}) {
    test::Host host;
    const auto facets = test::grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, test::flat);
    const auto n = static_cast<std::size_t>(host.add({0.2, 0.1, -0.9}, 1.0, {0, 0, speed}));
    Options o;
    o.gap = 0.1;
    o.stiffness_scale = 1.0;
    Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {0.2}, Surface(facets), o);
    test::set_stiffness(i, 1, facets.size(), 0.2);
    const int there = static_cast<int>(1.5 / speed);
    for (int step = 0; step < there; ++step) {
      host.step(i, 1.0);
      ASSERT_EQ(host.last.in_contact, 0) << speed << " at " << host.x[n].z;
    }
    EXPECT_GT(host.x[n].z, o.gap);
    EXPECT_EQ(host.v[n].z, speed);
    host.v[n].z = -0.05;
    bool touched = false;
    for (int step = 0; step < 200 && !(touched && host.last.in_contact == 0); ++step) {
      host.step(i, 1.0);
      touched = touched || host.last.in_contact > 0;
    }
    EXPECT_TRUE(touched);
    EXPECT_NEAR(host.v[n].z, 0.05, 1e-4 * 0.05);
  }
}

// A node that comes over a free border at a depth of several gaps climbs the flank of the strip: it is a potential, and the step is ready
// for it before the node is there. (Unforeseen it made up to 1700
// times the node's energy.)
TEST(FromBehind, flank_of_a_strip_is_foreseen) {
  double worst = 0.0;
  for (const double gap : {0.0, 0.1, 0.3}) {
    for (const double depth : {0.05, 0.2}) {
      for (const double speed : {0.02, 0.1, 0.4}) {
        test::Host host;
        const auto facets = test::grid(host, 2, 2, -1, 1, -1, 1, test::flat);
        const auto n = static_cast<std::size_t>(host.add({2.0, 0.1, -depth}, 1.0, {-speed, 0, 0}));
        Options o;
        o.gap = gap;
        if (gap == 0.0) o.rules.law = Law::constant;
        o.stiffness_scale = 1.0;
        Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
        test::set_stiffness(i, 1, facets.size(), 1.0);
        const double before = squared_norm(host.v[n]);
        double highest = before;
        for (int step = 0; step < 4000 && host.time < 4.0 / speed; ++step) {
          host.contact(i);
          double h = std::min({0.3, host.last.kinematic_step, host.dt > 0.0 ? 1.1 * host.dt : 0.3});
          if (host.k[n] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[n] / host.k[n]));
          host.v[n] += 0.5 * (host.dt + h) * host.f[n];
          host.x[n] += h * host.v[n];
          host.before = host.dt;
          host.dt = h;
          host.time += h;
          if (host.last.in_contact == 0) highest = std::max(highest, squared_norm(host.v[n]));
        }
        EXPECT_LT(highest, 1.06 * before) << gap << " " << depth << " " << speed;
        worst = std::max(worst, highest / before);
      }
    }
  }
  std::printf("  kinetic energy after over before, worst %.4f\n", worst);
}

// Two plates of free points that face the wrong way, overlap or overhang each other and tear: nodes meet strips of torn facets from the
// side, deeper than they came, and facets turn under nodes by half a turn in a step. Pairs that hold more than they were given give no more
// than that. (Without, up to 50 times all the energy there was.)
struct Overlap {
  bool flip_lower = false, flip_upper = false, lower_fixed = false;
  double shift = 0.0, height = 0.0, speed = 0.0, gap = 0.0;
};
double largest_growth(const Overlap& c) {
  test::Host host;
  const auto lower = test::grid(host, 4, 4, -2, 2, -2, 2, test::flat, !c.flip_lower, false, c.lower_fixed ? 0.0 : 1.0);
  const std::size_t first = host.x.size();
  const auto upper = test::grid(
      host, 4, 4, c.shift - 1.7, c.shift + 1.6, -1.6, 1.7, [&](double, double) { return c.height; }, c.flip_upper, false, 1.0);
  for (std::size_t n = first; n < host.x.size(); ++n) host.v[n].z = -c.speed;
  Options o;
  o.gap = c.gap;
  if (c.gap == 0.0) o.rules.law = Law::constant;
  o.stiffness_scale = 1.0;
  Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
  test::set_stiffness(i, 0, lower.size(), 1.0);
  test::set_stiffness(i, 1, upper.size(), 1.0);
  double before = 0.5 * static_cast<double>(host.x.size() - first) * c.speed * c.speed, highest = 0.0;
  for (int step = 0; step < 300; ++step) {
    host.contact(i);
    if (step == 0) before += host.last.elastic;
    double h = std::min({0.2, host.last.kinematic_step, host.dt > 0.0 ? 1.1 * host.dt : 0.2});
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      if (host.k[n] > 0.0 && host.m[n] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[n] / host.k[n]));
    }
    double kinetic = 0.0;
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      const Vec3 v = host.v[n];
      if (host.m[n] > 0.0) host.v[n] += 0.5 * (host.dt + h) / host.m[n] * host.f[n];
      kinetic += 0.5 * host.m[n] * dot(v, host.v[n]);
      host.x[n] += h * host.v[n];
    }
    host.before = host.dt;
    host.dt = h;
    host.time += h;
    highest = std::max(highest, kinetic);
  }
  return before > 0.0 ? highest / before : 0.0;
}
void overlaps_are_bounded(std::span<const double> heights, std::span<const double> speeds, std::span<const double> gaps,
                          std::span<const double> shifts) {
  double worst = 0.0;
  int plates = 0;
  for (const auto& [lower, upper] : {std::pair{false, true}, {true, false}, {true, true}}) {
    for (const bool fixed : {false, true}) {
      for (const double shift : shifts) {
        for (const double height : heights) {
          for (const double speed : speeds) {
            for (const double gap : gaps) {
              const double growth = largest_growth({lower, upper, fixed, shift, height, speed, gap});
              EXPECT_LT(growth, 1.2) << lower << upper << fixed << " shift " << shift << " height " << height << " speed " << speed
                                     << " gap " << gap;
              worst = std::max(worst, growth);
              ++plates;
            }
          }
        }
      }
    }
  }
  std::printf("  %d pairs of plates: largest kinetic energy over all there was, worst %.3f\n", plates, worst);
}

TEST(FromBehind, plates_that_overlap_are_bounded) {
  overlaps_are_bounded(std::array{0.0, 0.05}, std::array{0.0, 0.2}, std::array{0.1, 0.3}, std::array{0.0});
}
TEST(FromBehindFull, plates_that_overlap_are_bounded) {
  overlaps_are_bounded(std::array{0.8, 0.3, 0.05, 0.0, -0.05, -0.15}, std::array{0.0, 0.02, 0.2}, std::array{0.0, 0.1, 0.3},
                       std::array{0.0, 0.4, 1.0});
}

// A tear: two facets that face the same way, one above the strip of the other, and a node that slides between them, held by one while it
// enters the strip of the other or comes out beside it. The step is ready for the strip, and where the node holds more by the law of the
// second facet than it was given on the way there, it gives no more than that.
struct Tear {
  double gap = 0.0, height = 0.0, open = 0.0, tilt = 0.0, stiffness = 1.0;
  Vec3 at, velocity;
  Law law = Law::constant;
};
double growth_at(const Tear& c) {
  test::Host host;
  const auto facet = [&](double from, double to, double low, double high) {
    return Facet{{host.add({from, -1, low}), host.add({to, -1, high}), host.add({to, 1, high}), host.add({from, 1, low})}};
  };
  const std::vector<Facet> facets{facet(-2, 0, 0, 0), facet(c.open, c.open + 2, c.height, c.height + 2 * c.tilt)};
  const auto n = static_cast<std::size_t>(host.add(c.at, 1.0, c.velocity));
  Options o;
  o.gap = c.gap;
  o.rules.law = c.law;
  o.stiffness_scale = 1.0;
  Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {1.0}, Surface(facets), o);
  const std::vector<double> stiffness{1.0, c.stiffness};
  i.set_surface(1, {stiffness, {}, {}});
  double before = 0.5 * squared_norm(c.velocity), highest = 0.0;
  for (int step = 0; step < 3000 && host.time < 4.0 / norm(c.velocity); ++step) {
    host.contact(i);
    if (step == 0) before += host.last.elastic;
    double h = std::min({0.3, host.last.kinematic_step, host.dt > 0.0 ? 1.1 * host.dt : 0.01});
    if (host.k[n] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[n] / host.k[n]));
    const Vec3 v = host.v[n];
    host.v[n] += 0.5 * (host.dt + h) * host.f[n];
    if (host.last.in_contact == 0) highest = std::max(highest, 0.5 * dot(v, host.v[n]));
    host.x[n] += h * host.v[n];
    host.before = host.dt;
    host.dt = h;
    host.time += h;
  }
  return highest / before;
}

TEST(FromBehind, tears_are_bounded) {
  std::mt19937 random(7);
  const auto uniform = [&random] { return static_cast<double>(random() >> 5) / (1U << 27); };
  const auto one_of = [&](const auto& values) { return values[static_cast<std::size_t>(uniform() * static_cast<double>(values.size()))]; };
  constexpr int shots = 6000;
  int tenth = 0;
  double worst = 0.0;
  for (int shot = 0; shot < shots; ++shot) {
    Tear c;
    c.gap = one_of(std::array{0.05, 0.1, 0.3});
    c.height = c.gap * (2.4 * uniform() - 1.2);
    c.open = one_of(std::array{-0.05, 0.0, 0.02, 0.06, 0.1});
    c.tilt = one_of(std::array{0.0, 0.0, 0.2, -0.2, 0.5});
    c.stiffness = one_of(std::array{1.0, 1.0, 10.0});
    const double speed = one_of(std::array{0.02, 0.1, 0.4});
    c.velocity = {speed, 0.0, -speed * uniform()};
    c.at = {-0.6 * uniform() - 0.1, 0.13, c.gap * (0.2 + uniform())};
    c.law = one_of(std::array{Law::constant, Law::stiffening});
    const double growth = growth_at(c);
    if (growth > 1.1) ++tenth;
    worst = std::max(worst, growth);
  }
  std::printf("  %d shots into tears: energy after over before, worst %.2f; %d of them over 1.1\n", shots, worst, tenth);
  EXPECT_LT(worst, 1.3);
  EXPECT_LT(tenth, shots / 500);
}

}  // namespace
}  // namespace abut::contact
