// What interface.hpp promises to hosts: steps that are constant, nodes without mass, lists that stay, numbers that are refused.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <type_traits>

#include "contact/enforce/pair.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// A node that slides on a heavy facet under a load of 1, as TYPE5 or TYPE7.
struct Slider {
  Host host;
  Interface interface;
  explicit Slider(const Options& o, double mass = 1.0)
      : interface(Interface::nodes_to_surface({4}, {1000.0}, Surface(grid(host, 1, 1, 0, 10, 0, 10, flat)), o)) {
    start(mass, 0.09);
  }
  explicit Slider(const BothSidesOptions& o, double mass = 1.0)
      : interface(Interface::both_sides({4}, Surface(grid(host, 1, 1, 0, 10, 0, 10, flat)), o)) {
    start(mass, 0.0909);
  }
  void start(double mass, double height) {
    host.add({2, 2, height}, mass, {1, 0, 0});
    test::set_stiffness(interface, 1, 1, 1000.0);
  }
  /// Speed after 500 steps of 0.002. @param says  the host gives the mean of its steps, or leaves it 0
  double slide(bool says) {
    const double h = 0.002;
    for (int i = 0; i < 500; ++i) {
      host.dt = i > 0 ? h : 0.0;
      HostState state = host.state();
      state.dt_bar_old = says ? host.dt : 0.0;
      host.f.assign(5, {});
      host.k.assign(5, 0.0);
      interface.search(state);
      host.last = interface.evaluate(state, host.f, host.k);
      host.v[4] += h * (host.f[4] + Vec3{0, 0, -1});
      host.x[4] += h * host.v[4];
      interface.commit(h);
      host.time += h;
    }
    return host.v[4].x;
  }
};

// A host with a constant step may leave dt_bar_old 0: the same bits, and friction acts.
TEST(HostPromises, AConstantStepNeedsNoMean) {
  const auto same = [](const auto& options) {
    Slider with(options), without(options);
    const double v = with.slide(true);
    EXPECT_NEAR(v, 1.0 - 0.3, 0.05);  // it bounces a little; without friction 1
    EXPECT_EQ(without.slide(false), v);
  };
  Options o;
  o.gap = 0.1;
  o.friction = 0.3;
  same(o);
  o.filter.frequency = 10.0;
  same(o);
  BothSidesOptions b;
  b.gap = 0.1;
  b.friction = 0.3;
  same(b);
  b.filter.frequency = 10.0;
  same(b);
  b.filter = {};
  b.friction_form = BothSidesOptions::Friction::incremental;
  same(b);
}

/// A node that falls on a facet, in steps that grow and shrink; a one-sided one goes through the gap in one of them and is caught.
/// @param says  the host gives its steps, or leaves them 0  @param restored  step at which it goes on with an interface made anew
std::vector<Vec3> fall(const auto& options, bool says, int restored = -1) {
  constexpr bool one_sided = std::is_same_v<std::decay_t<decltype(options)>, Options>;
  Slider s(options);
  s.host.x[4] = {2, 2, 0.3};
  s.host.v[4] = {1, 0, -4};
  for (int i = 0; i < 60; ++i) {
    const double h = one_sided && i == 5 ? 0.08 : 0.004 * (1.0 + 0.5 * (i % 3));
    HostState state = s.host.state();
    if (i == restored) {
      Slider next(options);
      next.interface.restore(s.interface.history());
      std::swap(s.interface, next.interface);
      HostState silent = state;
      silent.dt = 0.0;
      EXPECT_THROW(s.interface.search(silent), std::logic_error);
    }
    if (!says && i != restored) state.dt = state.dt_bar_old = 0.0;
    s.host.f.assign(5, {});
    s.host.k.assign(5, 0.0);
    s.interface.search(state);
    s.host.last = s.interface.evaluate(state, s.host.f, s.host.k);
    s.host.v[4] += 0.5 * (s.host.dt + h) * s.host.f[4];
    s.host.x[4] += h * s.host.v[4];
    for (const double bad : {-1.0, nan, infinite}) EXPECT_THROW(s.interface.commit(bad), std::invalid_argument);
    s.interface.commit(h);
    s.host.before = s.host.dt;
    s.host.dt = h;
    s.host.time += h;
  }
  return {s.host.x[4], s.host.v[4]};
}

// A host that leaves its steps 0 has those that it committed: the same bits. A history does not say them: then the host must.
TEST(HostPromises, TheStepThatEndedIsTheOneCommitted) {
  const auto same = [](const auto& options) {
    const std::vector<Vec3> given = fall(options, true);
    EXPECT_GT(given[1].z, 1.0);  // it came back
    EXPECT_EQ(fall(options, false), given);
    EXPECT_EQ(fall(options, false, 30), given);
  };
  Options o;
  o.gap = 0.1;
  o.friction = 0.3;
  same(o);
  BothSidesOptions b;
  b.gap = 0.1;
  b.friction = 0.3;
  same(b);
}

// Until commit() a step may be searched and evaluated again from elsewhere, the first one too: nothing of the trial stays.
TEST(HostPromises, ATrialOfTheFirstStepLeavesNothing) {
  const auto same = [](const Options& options) {
    Slider tried(options), plain(options);
    for (Slider* s : {&tried, &plain}) s->host.v[4].z = -0.5;
    Host elsewhere = tried.host;
    for (const Vec3& at : {Vec3{7, 8, 0.02}, Vec3{4, 4, 0.5}}) {
      elsewhere.x[4] = at;
      elsewhere.f.assign(5, {});
      elsewhere.k.assign(5, 0.0);
      tried.interface.search(elsewhere.state());
      (void)tried.interface.evaluate(elsewhere.state(), elsewhere.f, elsewhere.k);
    }
    for (int i = 0; i < 60; ++i) {
      const StepResult a = tried.host.step(tried.interface, 0.003), b = plain.host.step(plain.interface, 0.003);
      ASSERT_EQ(a.made, b.made) << i;
      ASSERT_EQ(a.elastic, b.elastic) << i;
      ASSERT_EQ(a.friction_work, b.friction_work) << i;
      ASSERT_EQ(tried.host.x, plain.host.x) << i;
      ASSERT_EQ(tried.interface.history(), plain.interface.history()) << i;
    }
    EXPECT_GT(std::abs(plain.host.v[4].x - 1.0), 1e-3);  // it rubbed
  };
  Options o;
  o.gap = 0.1;
  o.friction = 0.3;
  same(o);
  o.start_duration = 0.05;
  same(o);
  o.start_duration = 0.0;
  o.initial = Initial::offset;
  same(o);
  o.rules = Rules::reference();
  o.initial = Initial::keep;
  same(o);
}

// Dampers and viscous friction of TYPE7 on a node that cannot move (mass 0) are those of the pair; without any masses they are refused.
TEST(HostPromises, NodesWithoutMassRub) {
  BothSidesOptions o;
  o.gap = 0.1;
  o.friction = 0.3;
  Slider s(o, 0.0);
  for (std::size_t i = 0; i < 4; ++i) s.host.m[i] = 1.0;
  s.host.dt = s.host.before = 0.002;
  s.host.contact(s.interface);
  const Vec3 f = s.host.f[4];
  EXPECT_GT(f.z, 0.1);
  EXPECT_NEAR(-f.x, 0.3 * f.z, 1e-9 * f.z);
  HostState without = s.host.state();
  without.mass = {};
  s.interface.search(without);
  EXPECT_THROW((void)s.interface.evaluate(without, s.host.f, s.host.k), std::invalid_argument);
}

TEST(HostPromises, TwoSidedStepsAreNotRepeated) {
  BothSidesOptions o;
  o.gap = 0.1;
  Slider s(o);
  s.host.f.assign(5, {});
  s.host.k.assign(5, 0.0);
  s.interface.search(s.host.state());
  (void)s.interface.evaluate(s.host.state(), s.host.f, s.host.k);
  EXPECT_THROW(s.interface.search(s.host.state()), std::logic_error);
  s.interface.commit(0.0);
  EXPECT_NO_THROW(s.interface.search(s.host.state()));
}

// Nodes that were let go stay so when something else about the surface is set.
TEST(HostPromises, ActivityStaysUntilItIsGivenAgain) {
  Host host;
  const auto lower = grid(host, 2, 2, 0, 1, 0, 1, flat);
  const auto upper = grid(
      host, 1, 1, 0.1, 0.9, 0.1, 0.9, [](double, double) { return 0.05; }, false);
  Options o;
  o.gap = 0.1;
  Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
  test::set_stiffness(i, 0, 4, 1000.0);
  test::set_stiffness(i, 1, 1, 1000.0);
  const Index all = host.contact(i).in_contact;
  const std::vector<std::uint8_t> some{0, 1, 1, 1};
  i.set_surface(1, {.node_active = some});
  EXPECT_EQ(host.contact(i).in_contact, all - 1);
  test::set_stiffness(i, 1, 1, 2000.0);
  EXPECT_EQ(host.contact(i).in_contact, all - 1);
}

// Areas are those of the positions that are given, before a search too, and are added.
TEST(HostPromises, AreasOfTwoSidedInterfacesAreAddedAtThePositionsGiven) {
  BothSidesOptions o;
  o.gap = 0.1;
  Slider s(o);
  std::vector<Vec3> twice = s.host.x;
  for (Vec3& x : twice) x = 2.0 * x;
  std::vector<double> area(5, 1.0);
  s.interface.add_nodal_area(twice, area);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(area[i], 101.0);
  EXPECT_EQ(area[4], 1.0);
}

// A finding looks at the gaps of now, not at those that the interface was made with.
TEST(HostPromises, InspectionKnowsGapsThatWereSet) {
  Host host;
  const auto facets = grid(host, 1, 1, 0, 1, 0, 1, flat);
  host.add({0.5, 0.5, 0.1}, 1.0);
  BothSidesOptions o;
  o.gap = 0.01;
  o.node_gap = {0.005};
  o.facet_gap = {0.005};
  Interface i = Interface::both_sides({4}, Surface(facets), o);
  const auto penetrates = [&] {
    for (const Finding& f : i.inspect(host.state())) {
      if (f.code == "contact.initial_penetration") return true;
    }
    return false;
  };
  EXPECT_FALSE(penetrates());
  const std::vector<double> thickness{0.2};
  i.set_surface(0, {.thickness = thickness});
  i.set_surface(1, {.thickness = thickness});
  EXPECT_TRUE(penetrates());
}

// What is handed to the step in the strip of a border does not depend on the corner that a facet is listed from, and follows from the way
// across the strip: of a quadrilateral of 3 by 1 and one of 1 by 1 the same.
TEST(HostPromises, StiffnessInAStripDoesNotKnowWhereAFacetBegins) {
  const auto handed = [](double length, bool triangle, std::size_t first) {
    Host host;
    host.x = {{0, 0, 0}, {length, 0, 0}, {triangle ? 0.5 * length : length, 1, 0}, {0, 1, 0}, {0.47 * length, -0.18, 0.05}};
    host.v.assign(5, {});
    host.m.assign(5, 1.0);
    const std::size_t corners = triangle ? 3 : 4;
    Facet facet;
    for (std::size_t k = 0; k < corners; ++k) facet.node[k] = static_cast<Index>((k + first) % corners);
    if (triangle) facet.node[3] = facet.node[2];
    Options o;
    o.gap = 0.2;
    Interface i = Interface::nodes_to_surface({4}, {1000.0}, Surface({facet}), o);
    test::set_stiffness(i, 1, 1, 1000.0);
    host.contact(i);
    EXPECT_EQ(host.last.in_contact, 1);
    return host.k[4];
  };
  for (const bool triangle : {false, true}) {
    const double from_first = handed(3.0, triangle, 0);
    for (std::size_t first = 1; first < (triangle ? 3 : 4); ++first) {
      EXPECT_NEAR(handed(3.0, triangle, first), from_first, 1e-9 * from_first) << triangle << first;
    }
  }
  EXPECT_NEAR(handed(3.0, false, 0), handed(1.0, false, 0), 0.02 * handed(1.0, false, 0));
}

// A friction spring that is stiffer than the normal one is what the step hears of.
TEST(HostPromises, StiffFrictionSpringsCountForTheStep) {
  const auto handed = [](double ratio) {
    Options o;
    o.gap = 0.1;
    o.friction = 0.3;
    o.tangential_ratio = ratio;
    o.rules.law = Law::constant;
    Slider s(o);
    s.host.contact(s.interface);
    const double at_first = s.host.k[4];
    s.host.contact(s.interface);
    EXPECT_DOUBLE_EQ(s.host.k[4], at_first);
    return at_first;
  };
  const Patch patch{{Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{10, 10, 0}, Vec3{0, 10, 0}}};
  const Vec3 node{2, 2, 0.09};
  const double more = friction_couple(patch, closest_point(patch, node), node, {}).node_share;
  EXPECT_GT(more, 1e-4);
  EXPECT_NEAR(handed(5.0) / handed(1.0), (5.0 + 5.0 * more) / (std::sqrt(1.09) + more), 1e-9);
}

TEST(HostPromises, NodesAndNumbersThatMeanNothingAreRefused) {
  Host host;
  const Surface surface(grid(host, 1, 1, 0, 1, 0, 1, flat));
  BothSidesOptions good;
  good.gap = 0.1;
  EXPECT_THROW((void)Interface::nodes_to_surface({-1}, {}, surface, {}), std::invalid_argument);
  EXPECT_THROW((void)Interface::both_sides({-1}, surface, good), std::invalid_argument);
  EXPECT_THROW((void)Interface::both_sides({4, 4}, surface, good), std::invalid_argument);
  EXPECT_NO_THROW((void)Interface::both_sides({4}, surface, good));
  const auto refused = [&](const auto& change) {
    BothSidesOptions bad = good;
    change(bad);
    EXPECT_THROW((void)Interface::both_sides({4}, surface, bad), std::invalid_argument);
  };
  refused([](BothSidesOptions& o) { o.stiffness_max = -1.0; });
  refused([](BothSidesOptions& o) { o.stiffness_min = 2.0, o.stiffness_max = 1.0; });
  refused([](BothSidesOptions& o) { o.damping = infinite; });
  refused([](BothSidesOptions& o) { o.filter.frequency = -5.0; });
  refused([](BothSidesOptions& o) { o.gap_max = nan; });
  refused([](BothSidesOptions& o) { o.step_minimum = nan; });
  refused([](BothSidesOptions& o) { o.largest_penetration = -1.0; });
  refused([](BothSidesOptions& o) { o.birth = nan; });
  refused([](BothSidesOptions& o) { o.friction_law.c[2] = nan; });
  const auto one_sided = [&](const auto& change) {
    Options bad;
    change(bad);
    EXPECT_THROW((void)Interface::nodes_to_surface({4}, {}, surface, bad), std::invalid_argument);
  };
  one_sided([](Options& o) { o.friction = infinite; });
  one_sided([](Options& o) { o.tangential_ratio = infinite; });
  one_sided([](Options& o) { o.death = nan; });
  one_sided([](Options& o) { o.friction_law.c[0] = infinite; });
}

}  // namespace
}  // namespace abut::contact
