// T4: results stay right on surfaces that are not convex. A groove with flanks at 45 degrees, z = |x|, and what lies in it.
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>
#include <vector>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

constexpr double stiffness = 42.0;
constexpr double pair = 0.2 * (stiffness * stiffness / 4.0) / (1.25 * stiffness);  // node with one quarter facet against a facet
const double root = std::sqrt(0.5);

std::vector<Facet> joined(std::vector<Facet> a, const std::vector<Facet>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A wedge of two strips, 0.5 <= |x| <= 1.5, sunk by `depth` into the groove, which reaches to |x| = 3 and has few nodes.
struct Wedge {
  Host host;
  Interface interface;
  std::size_t wedge_nodes;

  explicit Wedge(double depth, bool swapped)
      : Wedge(depth, swapped, [&] {
          Host h;
          const auto groove = [](double x, double) { return std::abs(x); };
          std::vector<Facet> lower = grid(h, 2, 1, -3, 3, -1, 3, groove);
          const std::size_t below = h.x.size();
          const auto sunk = [depth](double x, double) { return std::abs(x) - depth; };
          std::vector<Facet> upper = joined(grid(h, 1, 2, -1.5, -0.5, 0, 2, sunk, false), grid(h, 1, 2, 0.5, 1.5, 0, 2, sunk, false));
          return std::tuple{std::move(h), std::move(lower), std::move(upper), below};
        }()) {}

 private:
  using Parts = std::tuple<Host, std::vector<Facet>, std::vector<Facet>, std::size_t>;
  Wedge(double, bool swapped, Parts p)
      : host(std::move(std::get<0>(p))),
        interface(swapped ? Interface::two_surfaces(Surface(std::get<2>(p)), Surface(std::get<1>(p)), {})
                          : Interface::two_surfaces(Surface(std::get<1>(p)), Surface(std::get<2>(p)), {})),
        wedge_nodes(host.x.size() - std::get<3>(p)) {
    set_stiffness(interface, swapped ? 1 : 0, std::get<1>(p).size(), stiffness);
    set_stiffness(interface, swapped ? 0 : 1, std::get<2>(p).size(), stiffness);
  }
};

// Sunk by d, every node of a flank is d/sqrt(2) behind the other's and is pushed along that flank: up, and to the middle;
// left and right balance. Nodes of the wedge hold 1/4 or 2/4 of a facet's stiffness.
TEST(Concave, WedgeInAGroove) {
  const double depth = 0.02;
  for (const bool swapped : {false, true}) {
    Wedge w(depth, swapped);
    const StepResult r = w.host.contact(w.interface);
    EXPECT_EQ(r.in_contact, static_cast<Index>(w.wedge_nodes));
    Vec3 total;
    for (std::size_t i = w.host.x.size() - w.wedge_nodes; i < w.host.x.size(); ++i) {
      const Vec3 f = w.host.f[i];
      EXPECT_NEAR(f.x, w.host.x[i].x > 0 ? -f.z : f.z, 1e-15);
      EXPECT_NEAR(f.y, 0.0, 1e-15);
      total += f;
    }
    // Per strip: four corners with K/4, two middle nodes with K/2.
    const double middle = 0.2 * (stiffness * stiffness / 2.0) / (1.5 * stiffness);
    const double normal = 2.0 * (4.0 * pair + 2.0 * middle) * depth * root;
    EXPECT_NEAR(total.z, normal * root, 1e-14);
    EXPECT_NEAR(total.x, 0.0, 1e-15);
  }
}

// A node on the bottom line of the groove is as near to one flank as to the other: it is pushed straight up, and whichever way
// the flanks are listed.
TEST(Concave, TheBottomLineBelongsToBothFlanks) {
  for (const bool turned : {false, true}) {
    Host host;
    std::vector<Facet> groove = grid(host, 2, 1, -1, 1, -1, 1, [](double x, double) { return std::abs(x); });
    if (turned) std::swap(groove[0], groove[1]);
    const Index node = host.add({0.0, 0.1, -0.01});
    Interface interface = Interface::nodes_to_surface({node}, {stiffness}, Surface(std::move(groove)), {});
    set_stiffness(interface, 1, 2, stiffness);
    EXPECT_EQ(host.contact(interface).in_contact, 1);
    const Vec3 f = host.f[static_cast<std::size_t>(node)];
    EXPECT_NEAR(f.x, 0.0, 1e-14 * f.z);
    EXPECT_NEAR(f.y, 0.0, 1e-14 * f.z);
    EXPECT_GT(f.z, 0.0);
  }
}

// A node that falls into the groove without friction, off its middle, goes from flank to flank and keeps its energy; it never
// leaves through the bottom. Gravity 1, mass 1, from height 0.5 at x = 0.3: some ten impacts.
TEST(Concave, ANodeThatBouncesInTheGrooveKeepsItsEnergy) {
  Host host;
  std::vector<Facet> groove = grid(host, 6, 2, -1.5, 1.5, -1, 1, [](double x, double) { return std::abs(x); });
  const std::size_t count = groove.size();
  const Index node = host.add({0.3, 0.1, 0.8}, 1.0);
  Options options;
  options.stiffness_scale = 1.0;
  Interface interface = Interface::nodes_to_surface({node}, {1e5}, Surface(std::move(groove)), options);
  set_stiffness(interface, 1, count, 1e5);
  const auto n = static_cast<std::size_t>(node);
  const double start = host.x[n].z, h = 2e-4;
  double made = 0.0, lowest = 1.0, largest_error = 0.0;
  int impacts = 0;
  bool touching = false;
  for (int step = 0; step < 60000; ++step) {
    const Vec3 before = host.v[n];
    const double z = host.x[n].z;
    const StepResult r = host.step(interface, h, [n](Host& t) { t.f[n] += Vec3{0, 0, -1}; });
    const Vec3 mean = 0.5 * (before + host.v[n]);
    if (r.in_contact > 0 && !touching) ++impacts;
    touching = r.in_contact > 0;
    made = r.made;
    lowest = std::min(lowest, host.x[n].z - std::abs(host.x[n].x));
    if (!touching) largest_error = std::max(largest_error, std::abs(0.5 * squared_norm(mean) + z - start) / start);
  }
  std::printf("[found] node in a groove: %d impacts, largest energy error %.2e, CX %.2e of the energy\n", impacts, largest_error,
              made / start);
  EXPECT_GE(impacts, 8);
  EXPECT_GT(lowest, -0.02);
  EXPECT_LT(largest_error, 0.01);
}

}  // namespace
}  // namespace abut::contact
