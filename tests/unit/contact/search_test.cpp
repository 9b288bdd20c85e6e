// The search against brute force, and the swept test (T9; issue 3, section 1).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "contact/search/incremental.hpp"
#include "contact/search/nearest.hpp"
#include "unit/contact/search_scenes.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

TEST(Search, equals_brute_force) {
  test::SearchCount all;
  unsigned seed = 9;
  for (const test::Shape& shape : test::shapes()) {
    for (const bool triangles : {false, true}) {
      for (const double stretch : {1.0, 100.0}) {
        for (const double strip : {border_strip, border_strip + border_widening}) {
          const test::SearchCount one = test::search_against_brute_force({shape, 9, 8, triangles, stretch, 30, 30, ++seed, strip});
          EXPECT_EQ(one.wrong, 0) << shape.name << " triangles " << triangles << " stretch " << stretch << " strip " << strip;
          all.node_steps += one.node_steps;
          all.compared += one.compared;
          all.wrong += one.wrong;
        }
      }
    }
  }
  std::printf("  %ld node-steps, %ld within reach, %ld differ\n", all.node_steps, all.compared, all.wrong);
}

// The plain rule's search: never further from the truth than the exact nearest node.
TEST(Search, incremental_finds_the_nearest_node) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Host host;
  const auto main = grid(host, 15, 13, -1, 1, -1, 1, [](double x, double y) { return 0.2 * std::sin(6 * x) * std::cos(5 * y); });
  const std::size_t first = host.x.size();
  std::vector<Index> nodes;
  for (int i = 0; i < 50; ++i) nodes.push_back(host.add({u(random) * 2 - 1, u(random) * 2 - 1, 0.1}, 1.0));
  Side surface(Surface(main), false);
  surface.set({}, false);
  Side held(nodes, std::vector<double>(nodes.size(), 1.0));
  surface.gather(host.x);
  held.gather(host.x);
  IncrementalSearch search;
  std::vector<Tracked> tracked;
  search.start(held, surface, tracked);
  for (int step = 0; step < 40; ++step) {
    for (std::size_t i = first; i < host.x.size(); ++i) host.x[i] = {u(random) * 2 - 1, u(random) * 2 - 1, 0.2 * (u(random) - 0.5)};
    held.gather(host.x);
    search.update(held, surface, tracked, 0.0);
    for (Index i = 0; i < held.node_count(); ++i) {
      double best = 1e300;
      for (const Vec3& s : surface.x()) best = std::min(best, squared_norm(s - held.x()[at(i)]));
      EXPECT_EQ(squared_norm(surface.x()[at(tracked[at(i)].node)] - held.x()[at(i)]), best);
    }
  }
}

// Nodes come to a bumpy sheet from several diagonals of its facets away, sideways and down. Another search that begins at any cycle with
// what the first has tracked (a tree of another age: a resumed run) tracks the same from there on.
TEST(Search, incremental_does_not_depend_on_the_age_of_its_tree) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Host host;
  const auto bumps = [](double x, double y) { return 0.12 * std::sin(9 * x) * std::sin(8 * y); };
  const auto main = grid(host, 16, 16, -1, 1, -1, 1, bumps);
  const auto first = host.x.size();
  std::vector<Index> nodes;
  for (int i = 0; i < 60; ++i) nodes.push_back(host.add({u(random), u(random), 0.8 + 0.2 * u(random)}, 1.0));
  Side surface(Surface(main), false), held(nodes, std::vector<double>(nodes.size(), 1.0));
  surface.set({}, false);
  const std::vector<Vec3> at_start = host.x;
  const auto place = [&](int step) {
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      const Vec3 by = n < first ? Vec3{0.002 * std::sin(5.0 * at_start[n].y), 0.0, 0.001} : Vec3{0.02, -0.013, -0.008};
      host.x[n] = at_start[n] + static_cast<double>(step) * by;
    }
    surface.gather(host.x);
    held.gather(host.x);
  };
  constexpr int steps = 80;
  place(0);
  IncrementalSearch search;
  std::vector<std::vector<Tracked>> tracked(1);
  search.start(held, surface, tracked[0]);
  for (int step = 1; step <= steps; ++step) {
    place(step);
    tracked.push_back(tracked.back());
    search.update(held, surface, tracked.back(), 0.01);
  }
  int differing = 0, far = 0;
  for (int begin = 0; begin < steps; ++begin) {
    IncrementalSearch again;
    std::vector<Tracked> now = tracked[at(begin)];
    for (int step = begin + 1; step <= steps; ++step) {
      place(step);
      again.update(held, surface, now, 0.01);
      for (Index i = 0; i < held.node_count(); ++i) {
        const Tracked& then = tracked[at(step)][at(i)];
        if (now[at(i)].node != then.node || now[at(i)].facet != then.facet) ++differing;
        if (norm(held.x()[at(i)] - surface.x()[at(then.node)]) > 0.5) ++far;
      }
    }
  }
  EXPECT_EQ(differing, 0);
  EXPECT_GT(far, 10000) << "of 194400, beyond the largest diagonal (0.26 to 0.3)";
}

// T29: a node that would jump through in one step is caught, pushed back, ends in front, and keeps its energy.
TEST(Swept, fast_projectiles_end_in_front) {
  const test::Shots flat = test::shoot(0.0, 200, 21);
  const test::Shots curved = test::shoot(0.01, 200, 22);
  std::printf("  flat: %d shots, %d caught by the swept test, %d behind, worst |CX| %.3f %% of the kinetic energy\n", flat.count,
              flat.caught, flat.behind, 100 * flat.worst);
  std::printf("  curved: %d shots, %d caught, %d behind, worst |CX| %.3f %%\n", curved.count, curved.caught, curved.behind,
              100 * curved.worst);
  EXPECT_EQ(flat.behind, 0);
  EXPECT_EQ(curved.behind, 0);
  EXPECT_GT(flat.caught, 0);
  EXPECT_GT(curved.caught, 0);
  EXPECT_LT(flat.worst, 0.01);
  EXPECT_LT(curved.worst, 0.01);
}

// The same at folds and on a rough surface, where a node passes from facet to facet while it is held, with springs that are long for the
// step (accounts of light pairs) and not.
TEST(Swept, shots_at_folds_keep_their_energy) {
  for (const double hhk : {0.2, 0.08, 0.02}) {
    for (const test::Target& t : test::folds()) {
      const test::Shots shots = test::shoot(t.height, t.slack, 250, 23, Rules::standard(), hhk);
      std::printf("  h2K/m %.2f %-16s %d shots, %d behind, %d beyond 1 %%, worst %.4f %%\n", hhk, t.name, shots.count, shots.behind,
                  shots.beyond, 100 * shots.worst);
      EXPECT_EQ(shots.behind, 0) << t.name;
      EXPECT_EQ(shots.beyond, 0) << t.name;
    }
  }
}

}  // namespace
}  // namespace abut::contact
