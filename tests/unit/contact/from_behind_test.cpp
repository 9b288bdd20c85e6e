// What never touched the contact side gets no energy from it (docs/theory/contact.md, 1).
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace abut::contact
