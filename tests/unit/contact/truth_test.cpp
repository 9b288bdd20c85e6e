// An interface against the whole definition of docs/theory/contact.md, 1: what touches, how deep, what the swept test catches, what is
// ignored (T9, T29; issue: the contact heart, 1). The suite named ...Full does it in a million node-steps.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "unit/contact/truth_scenes.hpp"

namespace abut::contact {
namespace {

test::TruthCount compare(int nodes, int steps, bool automatic = false) {
  const test::TruthCount all = test::all_truths(nodes, steps, automatic, [](const test::TruthCase& c, const test::TruthCount& one) {
    EXPECT_EQ(one.wrong, 0) << c.shape.name << (c.triangles ? ", triangles" : "") << ", gap " << c.gap << ", depth limit " << c.depth_limit
                            << ", offset " << (c.initial == Initial::offset) << ", seed " << c.seed;
  });
  std::printf("  %ld node-steps, %ld in contact, %ld ignored, %ld caught by the swept test, %ld differ\n", all.node_steps, all.touching,
              all.behind, all.crossed, all.wrong);
  EXPECT_GT(all.touching, all.node_steps / 20);
  EXPECT_GT(all.behind, all.node_steps / 100);
  EXPECT_GT(all.crossed, all.node_steps / 1000);
  return all;
}

TEST(Truth, is_what_an_interface_says) { (void)compare(16, 20); }

// Each facet with a gap of its own, from its thickness.
TEST(Truth, is_what_an_interface_with_automatic_gap_says) { (void)compare(12, 16, true); }

// Who may not be the nearest of a held node, for it pushes the other way, may not store more for it either. On a torus whose facets turn
// by 40 degrees in some steps 47 node-steps differed, and a facet that came nearer stopped to hold its node at once.
TEST(Truth, only_those_store_more_that_may_be_the_nearest) {
  for (const test::Shape& shape : test::shapes()) {
    if (std::string(shape.name) != "torus") continue;
    const test::TruthCount count = test::interface_against_truth({shape, 9, 8, false, 0.05, 0.0, Initial::offset, 90, 100, 554});
    EXPECT_EQ(count.node_steps, 9000);
    EXPECT_EQ(count.wrong, 0);
  }
}

TEST(TruthFull, is_what_an_interface_says_in_a_million_node_steps) { EXPECT_GE(compare(90, 100).node_steps, 1000000); }

TEST(TruthFull, is_what_an_interface_with_automatic_gap_says) { EXPECT_GE(compare(60, 80, true).node_steps, 500000); }

}  // namespace
}  // namespace abut::contact
