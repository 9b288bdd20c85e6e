// StepResult::largest_approach: how much of the gap a step takes.
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <utility>
#include <vector>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

// T29: a node that comes with speed v takes v h / Gap of the gap in a step, in contact and near it, in every kind of interface; none
// with Gap = 0, and none when it goes away.
TEST(Approach, is_the_share_of_the_gap_taken_in_a_step) {
  constexpr double gap = 0.2, h = 0.01, speed = 3.0;
  struct Scene {
    double z, speed, gap, expected;
  };
  const double share = speed * h / gap;
  for (const Scene s : {Scene{0.15, speed, gap, share}, Scene{0.205, speed, gap, share}, Scene{0.15, -speed, gap, 0.0},
                        Scene{-0.001, speed, 0.0, 0.0}, Scene{2.0, speed, gap, 0.0}}) {
    for (const bool plain : {false, true}) {
      Options options;
      options.gap = s.gap;
      if (plain) options.rules.edges = Edges::plain;
      Host host;
      auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
      const std::size_t count = facets.size();
      const Index node = host.add({0.1, -0.2, s.z}, 1.0);
      Interface i = Interface::nodes_to_surface({node}, {42.0}, Surface(std::move(facets)), options);
      set_stiffness(i, 1, count, 42.0);
      EXPECT_EQ(host.contact(i).largest_approach, 0.0);  // nothing has moved yet
      host.dt = host.before = h;
      host.v[static_cast<std::size_t>(node)] = {5.0, 0.0, -s.speed};
      EXPECT_NEAR(host.contact(i).largest_approach, s.expected, 1e-15) << s.z << " " << s.speed << " " << s.gap << " " << plain;
    }
  }
}

// The larger of two approaches, of a surface that moves towards the nodes as of nodes that move towards it.
TEST(Approach, is_relative_and_the_largest) {
  constexpr double gap = 0.2, h = 0.01;
  Host host;
  auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
  for (Vec3& v : host.v) v = {0.0, 0.0, 2.0};
  const Index slow = host.add({-0.7, 0.1, 0.18}, 1.0, {0.0, 0.0, -1.0}), fast = host.add({0.7, 0.1, 0.19}, 1.0, {0.0, 0.0, -4.0});
  host.dt = host.before = h;
  Options options;
  options.gap = gap;
  Interface one = Interface::nodes_to_surface({slow, fast}, {42.0, 42.0}, Surface(facets), options);
  set_stiffness(one, 1, facets.size(), 42.0);
  EXPECT_NEAR(host.contact(one).largest_approach, 6.0 * h / gap, 1e-15);
  BothSidesOptions both;
  both.gap = gap;
  Interface two = Interface::both_sides({slow, fast}, Surface(facets), both);
  two.set_surface(0, {std::vector<double>(2, 42.0), {}, {}});
  set_stiffness(two, 1, facets.size(), 42.0);
  EXPECT_NEAR(host.contact(two).largest_approach, 6.0 * h / gap, 1e-15);
}

// TYPE7 with a gap of its own for each pair: its share, not that of the least gap.
TEST(Approach, is_in_units_of_the_gap_of_the_pair) {
  constexpr double h = 0.01;
  Host host;
  auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, flat);
  const Index thin = host.add({-0.7, 0.1, 0.09}, 1.0, {0.0, 0.0, -3.0}), thick = host.add({0.7, 0.1, 0.38}, 1.0, {0.0, 0.0, -4.0});
  host.dt = host.before = h;
  BothSidesOptions options;
  options.gap = 0.05;
  options.node_gap = {0.04, 0.34};
  options.facet_gap.assign(facets.size(), 0.06);
  Interface i = Interface::both_sides({thin, thick}, Surface(facets), options);
  i.set_surface(0, {std::vector<double>(2, 42.0), {}, {}});
  set_stiffness(i, 1, facets.size(), 42.0);
  EXPECT_NEAR(host.contact(i).largest_approach, 3.0 * h / 0.1, 1e-15);  // 4 h of 0.4 is less
  EXPECT_EQ(host.last.in_contact, 2);
}

}  // namespace
}  // namespace abut::contact
