// Full counts of the search and of the swept test (issue 3, section 1): minutes, ctest label "full".
#include <gtest/gtest.h>

#include <cstdio>

#include "unit/contact/search_scenes.hpp"

namespace abut::contact {
namespace {

using test::search_against_brute_force;
using test::SearchCase;
using test::SearchCount;

// T9: the same as brute force in a million node-steps, 10 to 10^5 segments, sizes differing up to 100:1.
TEST(SearchFull, equals_brute_force_in_a_million_node_steps) {
  SearchCount all;
  unsigned seed = 100;
  const auto run = [&](const SearchCase& c) {
    const SearchCount one = search_against_brute_force(c);
    EXPECT_EQ(one.wrong, 0) << c.shape.name << " " << c.nu << " x " << c.nv << " seed " << c.seed;
    all.node_steps += one.node_steps;
    all.compared += one.compared;
    all.wrong += one.wrong;
  };
  for (const test::Shape& shape : test::shapes()) {
    for (const bool triangles : {false, true}) {
      for (const double stretch : {1.0, 10.0, 100.0}) {
        for (const int n : {3, 8, 16}) {
          for (const double strip : {border_strip, border_strip + border_widening}) {
            run({shape, n, n - 1, triangles, stretch, 60, 36, ++seed, strip});
          }
        }
      }
    }
    run({shape, 100, 100, false, 1.0, 20, 20, ++seed});
    run({shape, 320, 313, false, 1.0, 4, 8, ++seed});  // 10^5 segments
  }
  std::printf("  %ld node-steps, %ld within reach, %ld differ\n", all.node_steps, all.compared, all.wrong);
  EXPECT_GE(all.node_steps, 1000000);
}

TEST(SweptFull, hundred_thousand_shots_end_in_front) {
  int count = 0;
  double worst_flat = 0.0, worst_curved = 0.0;
  for (const double curvature : {0.0, 0.01, -0.01}) {
    const test::Shots shots = test::shoot(curvature, 17000, 77);
    std::printf("  curvature %g: %d shots, %d caught, %d behind, worst change of kinetic energy %.3f %% \n", curvature, shots.count,
                shots.caught, shots.behind, 100 * shots.worst);
    EXPECT_EQ(shots.behind, 0);
    count += shots.count;
    double& worst = curvature == 0.0 ? worst_flat : worst_curved;
    worst = std::max(worst, shots.worst);
  }
  EXPECT_GE(count, 100000);
  EXPECT_LE(worst_flat, 0.01);
  EXPECT_LE(worst_curved, 0.01);
}

TEST(SweptFull, hundred_thousand_shots_at_folds_keep_their_energy) {
  int count = 0, beyond = 0;
  double worst = 0.0;
  for (const test::Target& t : test::folds()) {
    const test::Shots shots = test::shoot(t.height, t.slack, 6500, 78);
    std::printf("  %-16s %d shots, %d behind, %d beyond 1 %%, worst change of kinetic energy %.4f %%\n", t.name, shots.count, shots.behind,
                shots.beyond, 100 * shots.worst);
    EXPECT_EQ(shots.behind, 0) << t.name;
    count += shots.count;
    beyond += shots.beyond;
    worst = std::max(worst, shots.worst);
  }
  EXPECT_GE(count, 100000);
  EXPECT_EQ(beyond, 0);
  EXPECT_LE(worst, 0.01);
}

}  // namespace
}  // namespace abut::contact
