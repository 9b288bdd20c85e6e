// An interface against the whole definition of docs/theory/contact.md, 1: what touches, how deep, what the swept test catches, what is
// ignored (T9, T29; issue: the contact heart, 1). The suite named ...Full does it in a million node-steps.
#include <gtest/gtest.h>

#include <cstdio>

#include "unit/contact/truth_scenes.hpp"

namespace abut::contact {
namespace {

test::TruthCount compare(int nodes, int steps, long known) {
  const test::TruthCount all = test::all_truths(nodes, steps, [known](const test::TruthCase& c, const test::TruthCount& one) {
    EXPECT_LE(one.wrong, known) << c.shape.name << (c.triangles ? ", triangles" : "") << ", gap " << c.gap << ", depth limit "
                                << c.depth_limit << ", offset " << (c.initial == Initial::offset) << ", seed " << c.seed;
  });
  std::printf("  %ld node-steps, %ld in contact, %ld ignored, %ld caught by the swept test, %ld differ\n", all.node_steps, all.touching,
              all.behind, all.crossed, all.wrong);
  EXPECT_LE(all.wrong, known);
  EXPECT_GT(all.touching, all.node_steps / 20);
  EXPECT_GT(all.behind, all.node_steps / 100);
  EXPECT_GT(all.crossed, all.node_steps / 1000);
  return all;
}

TEST(Truth, is_what_an_interface_says) { (void)compare(16, 20, 0); }

// A known limit: two node-steps differ (torus, seeds 553 and 558). The strip of the nearest facet has faded there, and another facet holds
// the node by the definition, not by the interface; the cause is not known. Section 7 of the theory page and the CHANGELOG say so.
TEST(TruthFull, is_what_an_interface_says_in_a_million_node_steps) { EXPECT_GE(compare(90, 100, 2).node_steps, 1000000); }

}  // namespace
}  // namespace abut::contact
