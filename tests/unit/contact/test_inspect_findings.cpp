// Every code of the inspection: a scene that provokes it, and a twin, alike but for the fault, that does not (T7 aspect ratio and warp,
// T30 a gap that is large for its segments, among them).
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "inspect_scenes.hpp"

namespace abut::contact {
namespace {

using test::Pair;

/// Two facing plates, meshes of about the same size, 0.01 apart, stiffness alike.
Pair plates(int n = 6, int m = 5, double distance = 0.01) {
  Pair p;
  p.facets[0] = p.plate(n, n, 0.0, 1.0, 0.0, true);
  p.facets[1] = p.plate(m, m, 0.0, 1.0, distance, false);
  for (std::size_t k = 0; k < 2; ++k) p.stiffness[k].assign(p.facets[k].size(), 1e6);
  return p;
}
/// 36 nodes at height z over facets that repel on both sides (TYPE7).
Pair both_sided(double z) {
  Pair p;
  p.facets[1] = p.plate(6, 6, 0.0, 1.0, 0.0, true);
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      p.held.push_back(static_cast<Index>(p.x.size()));
      p.x.push_back({0.1 + 0.16 * i, 0.1 + 0.16 * j, z});
    }
  }
  p.both_sides = true;
  return p;
}
/// A floor of two halves that meet at x = 0.5 under `slope`: a valley for slope > 0, a ridge for slope < 0.
Pair folded(double slope) {
  Pair p;
  p.facets[0] = p.patch(6, 4, [=](double u, double w) { return Vec3{u, w, slope * std::abs(u - 0.5)}; });
  p.facets[1] = p.plate(5, 5, 0.1, 0.9, slope > 0.0 ? 0.6 : 0.05, false);
  return p;
}
Pair stretched(double by) {
  Pair p = plates();
  for (Vec3& x : p.x) x.x *= by;
  return p;
}
Pair moving(double speed, double gap, double step) {
  Pair p = plates(6, 5, 0.03);
  p.gap = gap;
  p.element_step = step;
  p.v.assign(p.x.size(), {});
  for (std::size_t i = 49; i < p.v.size(); ++i) p.v[i] = {0.0, 0.0, -speed};
  return p;
}
Pair with_mass(double mass) {
  Pair p = plates();
  p.mass.assign(p.x.size(), mass);
  p.element_step = 1e-4;
  return p;
}
Pair band(bool twisted) {
  constexpr int n = 24;
  Pair p;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * 3.141592653589793 * i / n, half = twisted ? 0.5 * a : 0.0;
    for (const double w : {-0.2, 0.2}) {
      const double r = 1.0 + w * std::cos(half);
      p.x.push_back({r * std::cos(a), r * std::sin(a), w * std::sin(half)});
    }
  }
  for (Index i = 0; i < n; ++i) {
    const Index a = 2 * i;
    const bool last = i + 1 == n;
    const Index b = last ? (twisted ? 1 : 0) : a + 2, c = last ? (twisted ? 0 : 1) : a + 3;
    p.facets[0].push_back({{a, a + 1, c, b}});
  }
  p.facets[1] = p.plate(8, 8, -1.2, 1.2, 0.5, false);
  return p;
}

struct Case {
  const char* code;
  std::function<Pair()> fault, twin;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"contact.shared_nodes",
       [] {
         Pair p = plates();
         p.facets[1][0].node[0] = p.facets[0][0].node[0];
         return p;
       },
       [] { return plates(); }},
      {"contact.degenerate_facets",
       [] {
         Pair p = plates();
         p.facets[0][7].node[1] = p.facets[0][7].node[0];
         return p;
       },
       [] {
         Pair p = plates();
         p.facets[0][7].node[3] = p.facets[0][7].node[2];  // a triangle is none
         return p;
       }},
      {"contact.duplicate_facets",
       [] {
         Pair p = plates();
         p.facets[0].push_back(reversed(p.facets[0][3]));
         p.stiffness[0].push_back(1e6);
         return p;
       },
       [] { return plates(); }},
      {"contact.normals_away",
       [] {
         Pair p = plates();
         p.facets[1] = Pair::turned(p.facets[1]);
         return p;
       },
       [] { return plates(); }},
      {"contact.normals_alike",
       [] {
         Pair p = plates(6, 5, 0.0);
         p.facets[1] = Pair::turned(p.facets[1]);
         return p;
       },
       [] { return plates(6, 5, 0.0); }},
      {"contact.partly_away",  // a third of the floor has been pushed up through the plate
       [] {
         Pair p = plates(6, 6, 0.01);
         for (std::size_t i = 0; i < 49; ++i) p.x[i].z = p.x[i].x < 0.3 ? 0.03 : 0.0;
         return p;
       },
       [] { return plates(6, 6, 0.01); }},
      {"contact.mixed_orientation",
       [] {
         Pair p = plates();
         p.facets[0][14] = reversed(p.facets[0][14]);
         return p;
       },
       [] { return plates(); }},
      {"contact.one_sided", [] { return band(true); }, [] { return band(false); }},
      {"contact.junctions",
       [] {
         Pair p = plates();
         const auto first = static_cast<Index>(p.x.size());
         const Facet& f = p.facets[0][0];
         p.x.push_back(p.x[static_cast<std::size_t>(f.node[1])] - Vec3{0, 0, 0.2});
         p.x.push_back(p.x[static_cast<std::size_t>(f.node[2])] - Vec3{0, 0, 0.2});
         p.facets[0].push_back({{f.node[1], f.node[2], first + 1, first}});
         p.stiffness[0].push_back(1e6);
         return p;
       },
       [] { return plates(); }},
      {"contact.no_stiffness",
       [] {
         Pair p = plates();
         p.stiffness[1][4] = 0.0;
         return p;
       },
       [] { return plates(); }},
      {"contact.overlap",
       [] {
         Pair p;
         p.facets[0] = p.plate(8, 8, -1.0, 2.0, 0.0, true);
         p.facets[1] = p.box({0.03, 0.03, -0.02}, {1.0, 1.0, 0.5}, 4, false);
         return p;
       },
       [] {
         Pair p;
         p.facets[0] = p.plate(8, 8, -1.0, 2.0, 0.0, true);
         p.facets[1] = p.box({0.03, 0.03, 0.02}, {1.0, 1.0, 0.5}, 4, false);
         return p;
       }},
      {"contact.initial_penetration",
       [] {
         Pair p = plates();
         p.gap = 0.015;
         return p;
       },
       [] {
         Pair p = plates();
         p.gap = 0.009;
         return p;
       }},
      {"contact.out_of_reach",
       [] {
         Pair p = plates();
         for (std::size_t i = 49; i < p.x.size(); ++i) p.x[i].x += 3.0;
         return p;
       },
       [] { return plates(); }},
      {"contact.blind_nodes",
       [] {
         Pair p = plates();
         for (std::size_t i = 49; i < p.x.size(); ++i) p.x[i].x += 0.5;
         return p;
       },
       [] { return plates(); }},
      {"contact.clearance", [] { return plates(); },
       [] {
         Pair p = plates();
         p.gap = 0.02;
         return p;
       }},
      {"contact.stiffness_ratio",
       [] {
         Pair p = plates();
         p.stiffness[0].assign(p.stiffness[0].size(), 2e7);
         return p;
       },
       [] {
         Pair p = plates();
         p.stiffness[0].assign(p.stiffness[0].size(), 9e6);
         return p;
       }},
      {"contact.size_ratio", [] { return plates(2, 12); }, [] { return plates(4, 12); }},
      {"contact.gap_large",
       [] {
         Pair p = plates();
         p.gap = 0.12;
         return p;
       },
       [] {
         Pair p = plates();
         p.gap = 0.07;
         return p;
       }},
      {"contact.gap_small", [] { return moving(10.0, 0.01, 1e-3); }, [] { return moving(10.0, 0.01, 1e-4); }},
      {"contact.interface_step", [] { return with_mass(1e-4); }, [] { return with_mass(1.0); }},
      {"contact.aspect_ratio", [] { return stretched(6.0); }, [] { return stretched(3.0); }},
      {"contact.warp",
       [] {
         Pair p = plates(6, 5, 0.3);
         p.x[8].z += 0.1;
         return p;
       },
       [] {
         Pair p = plates(6, 5, 0.3);
         p.x[8].z += 0.01;
         return p;
       }},
      {"contact.concave", [] { return folded(0.5); }, [] { return folded(-0.5); }},
  };
  return all;
}

TEST(Inspection, every_code_has_a_scene_and_a_twin) {
  std::set<std::string> named;
  for (const Case& c : cases()) named.insert(c.code);
  for (const std::string_view code : inspection_codes()) EXPECT_TRUE(named.count(std::string(code)) == 1) << code;
  EXPECT_EQ(named.size(), inspection_codes().size());
}

TEST(Inspection, each_scene_provokes_its_finding_and_its_twin_does_not) {
  for (const Case& c : cases()) {
    const Pair fault = c.fault(), twin = c.twin();
    const auto found = inspect(fault.input());
    EXPECT_TRUE(test::has(found, c.code)) << c.code;
    EXPECT_FALSE(test::has(inspect(twin.input()), c.code)) << "twin of " << c.code;
    for (const Finding& f : found) {
      EXPECT_TRUE(std::is_sorted(f.facets.begin(), f.facets.end())) << f.code;
      EXPECT_TRUE(std::is_sorted(f.nodes.begin(), f.nodes.end())) << f.code;
      EXPECT_FALSE(f.what.empty() || f.advice.empty() || f.measure_name.empty()) << f.code;
      EXPECT_TRUE(std::isfinite(f.measure)) << f.code;
    }
  }
}

TEST(Inspection, the_worst_comes_first) {
  Pair p = plates();
  p.facets[0][14] = reversed(p.facets[0][14]);
  const auto found = inspect(p.input());
  ASSERT_GT(found.size(), 2u);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i - 1].severity, found[i].severity);
}

/// T15: K1 = 20 K2, s = 0.2: the suggested Stfac is min(1, s (1 + 20)/2) = 1.
TEST(Inspection, T15_measures_the_stiffness_ratio) {
  Pair p = plates();
  p.stiffness[0].assign(p.stiffness[0].size(), 2e7);
  const auto found = inspect(p.input());
  const Finding* f = test::find(found, "contact.stiffness_ratio", 0);
  ASSERT_NE(f, nullptr);
  EXPECT_NEAR(f->measure, 20.0, 1e-9);
  EXPECT_NE(f->advice.find("about 1;"), std::string::npos) << f->advice;
}

/// The penetrations are exact: P = gap - distance, every node in the histogram.
TEST(Inspection, T25_initial_penetrations_are_those_of_the_contact) {
  Pair p = plates();
  p.gap = 0.015;
  const auto found = inspect(p.input());
  const Finding* f = test::find(found, "contact.initial_penetration", 1);
  ASSERT_NE(f, nullptr);
  EXPECT_NEAR(f->measure, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(f->nodes.size(), 36u);
  Index counted = 0;
  for (const Bar& bar : f->histogram) counted += bar.count;
  EXPECT_EQ(counted, 36);
}

/// The scene of T25 with facets that repel on both sides: the same third, whatever the normals and whichever side the nodes are on.
TEST(Inspection, both_sided_facets_find_initial_penetrations_from_either_side) {
  for (const double z : {0.01, -0.01}) {
    Pair p = both_sided(z);
    p.gap = 0.015;
    const auto found = inspect(p.input());
    const Finding* f = test::find(found, "contact.initial_penetration", 0);
    ASSERT_NE(f, nullptr) << z;
    EXPECT_NEAR(f->measure, 1.0 / 3.0, 1e-12);
    EXPECT_EQ(f->nodes.size(), 36u);
    EXPECT_FALSE(test::has(found, "contact.overlap") || test::has(found, "contact.normals_away"));
    p.gap = 0.009;
    EXPECT_FALSE(test::has(inspect(p.input()), "contact.initial_penetration"));
    EXPECT_NEAR(test::find(inspect(p.input()), "contact.clearance", 0)->measure, 0.001, 1e-12);
  }
}

/// Gap of a pair: node 0.004 + facet 0.011 = 0.015 over a distance of 0.01; only one node's own share of 0.002 keeps it out.
TEST(Inspection, both_sided_gaps_are_those_of_the_pairs) {
  Pair p = both_sided(0.01);
  BothSidesOptions pairs;
  pairs.gap = 0.001;
  pairs.node_gap.assign(36, 0.004);
  pairs.node_gap[7] = -0.002;
  pairs.facet_gap.assign(p.facets[1].size(), 0.011);
  InspectionInput in = p.input();
  in.gap = 0.015;
  in.pairs = &pairs;
  const auto found = inspect(in);
  const Finding* f = test::find(found, "contact.initial_penetration", 0);
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(f->nodes.size(), 35u);
  EXPECT_FALSE(std::binary_search(f->nodes.begin(), f->nodes.end(), p.held[7]));
}

/// A surface against its own nodes: what a node is a corner of does not count, the neighbours are out of the gap.
TEST(Inspection, a_both_sided_surface_against_itself_is_quiet) {
  Pair p;
  p.facets[1] = p.plate(6, 6, 0.0, 1.0, 0.0, true);
  for (Index n = 0; n < 49; ++n) p.held.push_back(n);
  p.both_sides = true;
  p.gap = 0.05;
  EXPECT_TRUE(inspect(p.input()).empty());
  p.gap = 0.2;  // more than a segment of 1/6: nodes are in the gap of segments beside them
  EXPECT_TRUE(test::has(inspect(p.input()), "contact.initial_penetration", 0));
  EXPECT_TRUE(test::has(inspect(p.input()), "contact.gap_large"));
}

/// Sets of nodes: sizes and stiffnesses come from the host, for TYPE5 and TYPE7 alike.
TEST(Inspection, held_nodes_have_sizes_and_stiffnesses) {
  for (const bool both : {false, true}) {
    Pair p = both_sided(0.01);
    p.both_sides = both;
    const std::vector<double> size(36, 0.04), stiffness(36, 2e7);
    p.stiffness[1].assign(p.facets[1].size(), 1e6);
    p.mass.assign(p.x.size(), 1e-3);
    p.element_step = 1e-4;
    InspectionInput in = p.input();
    in.side[0].size = size;
    in.side[0].stiffness = stiffness;
    const auto found = inspect(in);
    const Finding* ratio = test::find(found, "contact.size_ratio", 1);
    ASSERT_NE(ratio, nullptr);
    EXPECT_NEAR(ratio->measure, 1.0 / 6.0 / 0.04, 1e-9);
    const Finding* stiff = test::find(found, "contact.stiffness_ratio", 0);
    ASSERT_NE(stiff, nullptr);
    EXPECT_NEAR(stiff->measure, 20.0, 1e-9);
    // One pass: K = s K1 K2/(K1 + K2); both sides, out of the gap: K0 = s K_m/2.
    const double k = both ? 0.5 * 0.2 * 1e6 : 0.2 * 1e6 * 2e7 / 2.1e7;
    const Finding* step = test::find(found, "contact.interface_step", -1);
    ASSERT_EQ(step != nullptr, std::sqrt(2e-3 / k) < 1e-4);
    in.mass = p.mass;
    in.element_step = 1.0;
    const auto late = inspect(in);
    EXPECT_NEAR(test::find(late, "contact.interface_step", -1)->measure, std::sqrt(2e-3 / k), 1e-9 * std::sqrt(2e-3 / k));
  }
}

/// A fine patch inside one coarse segment: no coarse node sees the patch, and the ratios are told all the same.
TEST(Inspection, a_coarse_side_whose_nodes_lie_outside_is_compared_too) {
  Pair p;
  p.facets[0] = p.plate(1, 1, -3.0, 4.0, 0.0, true);
  p.facets[1] = p.plate(7, 7, 0.0, 1.0, 0.01, false);
  p.stiffness[0].assign(1, 4e7);
  p.stiffness[1].assign(49, 1e6);
  const auto found = inspect(p.input());
  ASSERT_TRUE(test::has(found, "contact.blind_nodes", 0));
  ASSERT_TRUE(test::has(found, "contact.size_ratio", 0));
  EXPECT_NEAR(test::find(found, "contact.size_ratio", 0)->measure, 49.0, 1e-9);
  ASSERT_TRUE(test::has(found, "contact.stiffness_ratio", 0));
  EXPECT_NEAR(test::find(found, "contact.stiffness_ratio", 0)->measure, 40.0, 1e-9);
}

/// T29: 10 m/s, steps of 1 ms, gap 10 mm: one step through the gap.
TEST(Inspection, T29_counts_the_steps_through_the_gap) {
  const Pair p = moving(10.0, 0.01, 1e-3);
  const auto found = inspect(p.input());
  const Finding* f = test::find(found, "contact.gap_small", -1);
  ASSERT_NE(f, nullptr);
  EXPECT_NEAR(f->measure, 1.0, 1e-9);
}

void expect_same(const std::vector<Finding>& a, const std::vector<Finding>& b, const char* where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].code, b[i].code) << where;
    EXPECT_EQ(a[i].severity, b[i].severity) << where;
    EXPECT_EQ(a[i].side, b[i].side) << where;
    EXPECT_EQ(a[i].facets, b[i].facets) << where;
    EXPECT_EQ(a[i].nodes, b[i].nodes) << where;
    EXPECT_EQ(a[i].measure, b[i].measure) << where;
    EXPECT_EQ(a[i].what, b[i].what) << where;
    EXPECT_EQ(a[i].advice, b[i].advice) << where;
    EXPECT_EQ(a[i].histogram.size(), b[i].histogram.size()) << where;
  }
}

/// Interface::inspect() says what the free function says of the same input: for every scene that an interface can be made of (two
/// surfaces may share no node, have no facet twice and none without three nodes), in all its kinds.
TEST(Inspection, an_interface_inspects_itself) {
  std::set<std::string> seen;
  int refused = 0;
  for (const Case& c : cases()) {
    const Pair p = c.fault();
    Options options;
    options.gap = p.gap;
    options.stiffness_scale = p.stiffness_scale;
    try {
      Interface made = p.facets[0].empty() ? Interface::nodes_to_surface(p.held, {}, Surface(p.facets[1]), options)
                                           : Interface::two_surfaces(Surface(p.facets[0]), Surface(p.facets[1]), options);
      for (std::size_t k = 0; k < 2; ++k) {
        if (!p.facets[k].empty()) made.set_surface(static_cast<int>(k), {p.stiffness[k], {}, {}});
      }
      HostState host;
      host.x = p.x;
      host.v = p.v;
      host.mass = p.mass;
      const auto own = made.inspect(host, p.element_step, {p.outward[0], p.outward[1]});
      const auto free = inspect(p.input());
      expect_same(own, free, c.code);
      for (const Finding& f : own) seen.insert(f.code);
      InspectionLimits strict;
      strict.aspect_ratio = strict.size_ratio = strict.stiffness_ratio = 1.0;
      expect_same(made.inspect(host, p.element_step, {p.outward[0], p.outward[1]}, strict), inspect(p.input(), strict), c.code);
    } catch (const std::invalid_argument&) { ++refused; }
  }
  EXPECT_EQ(refused, 3);        // shared nodes, a degenerate facet, a facet twice
  EXPECT_GE(seen.size(), 20u);  // all other codes
}

TEST(Inspection, an_interface_of_both_sides_inspects_itself) {
  Pair p = stretched(8.0);
  p.gap = 0.2;
  for (Index n = 0; n < 49; ++n) p.held.push_back(n);
  p.facets[0].clear();
  p.stiffness[0].clear();
  BothSidesOptions options;
  options.gap = p.gap;
  Interface made = Interface::both_sides(p.held, Surface(p.facets[1]), options);
  made.set_surface(1, {p.stiffness[1], {}, {}});
  InspectionInput input = p.input();
  input.both_sides = true;
  HostState host;
  host.x = p.x;
  EXPECT_FALSE(inspect(input).empty());
  expect_same(made.inspect(host), inspect(input), "both sides");
}

TEST(Inspection, an_interface_refuses_spans_that_do_not_fit) {
  const Pair p = plates();
  const Interface made = Interface::two_surfaces(Surface(p.facets[0]), Surface(p.facets[1]), {});
  HostState host;
  host.x = std::span(p.x).first(p.x.size() - 1);
  EXPECT_THROW((void)made.inspect(host), std::invalid_argument);
  host.x = p.x;
  EXPECT_NO_THROW((void)made.inspect(host));
  const std::vector<Vec3> v(3);
  host.v = v;
  EXPECT_THROW((void)made.inspect(host), std::invalid_argument);
  host.v = {};
  const std::vector<std::int8_t> outward(35, 1);
  EXPECT_THROW((void)made.inspect(host, 0.0, {outward, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace abut::contact
