// Numbers that are no lengths, stiffnesses, scales or times are refused where they come in.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

// Bad geometry is found, bad numbers are refused.
TEST(Refused, numbers_of_the_inspection) {
  Host host;
  const auto first = grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat), second = grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat);
  InspectionInput good;
  good.side[0].facets = first;
  good.side[1].facets = second;
  good.x = host.x;
  for (double InspectionInput::*number : {&InspectionInput::gap, &InspectionInput::stiffness_scale, &InspectionInput::element_step}) {
    for (const double bad : {nan, infinite, -1.0}) {
      InspectionInput input = good;
      input.*number = bad;
      EXPECT_THROW((void)inspect(input), std::invalid_argument) << bad;
      EXPECT_THROW((void)facing(input), std::invalid_argument) << bad;
      EXPECT_THROW((void)orient(input), std::invalid_argument) << bad;
    }
  }
  EXPECT_NO_THROW((void)inspect(good));
  InspectionLimits limits;
  limits.size_ratio = nan;
  EXPECT_THROW((void)inspect(good, limits), std::invalid_argument);
  const Interface made = Interface::two_surfaces(Surface(first), Surface(second), {});
  EXPECT_THROW((void)made.inspect(host.state(), nan), std::invalid_argument);
}

TEST(Refused, times_and_steps) {
  Host host;
  Interface i =
      Interface::two_surfaces(Surface(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat)), Surface(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat)), {});
  for (const int side : {0, 1}) test::set_stiffness(i, side, 1, 1.0);
  const auto refused = [&](double HostState::*number, double value) {
    HostState bad = host.state();
    bad.*number = value;
    EXPECT_THROW(i.search(bad), std::invalid_argument) << value;
    i.search(host.state());
    std::vector<Vec3> force(host.x.size());
    std::vector<double> stiffness(host.x.size());
    EXPECT_THROW((void)i.evaluate(bad, force, stiffness), std::invalid_argument) << value;
  };
  for (const double bad : {nan, infinite}) refused(&HostState::time, bad);
  for (const double bad : {nan, infinite, -1.0}) {
    refused(&HostState::dt, bad);
    refused(&HostState::dt_bar_old, bad);
  }
}

// Forces are those of the positions that were searched: other ones are not taken for them, and leave everything as it was.
TEST(Refused, positions_that_were_not_searched) {
  const auto refused = [](Host host, Interface i, bool two_sides) {
    for (int side = two_sides ? 0 : 1; side < 2; ++side) test::set_stiffness(i, side, 1, 1e4);
    std::vector<Vec3> force(host.x.size());
    std::vector<double> stiffness(host.x.size());
    i.search(host.state());
    for (std::size_t node = 4; node < 8; ++node) {
      Host moved = host;
      moved.x[node].z -= 0.03;
      EXPECT_THROW((void)i.evaluate(moved.state(), force, stiffness), std::logic_error) << node;
      EXPECT_EQ(force, std::vector<Vec3>(host.x.size()));
    }
    const StepResult here = i.evaluate(host.state(), force, stiffness);
    EXPECT_GT(here.in_contact, 0);
    for (Vec3& x : host.x) x.z *= 0.5;
    EXPECT_THROW((void)i.evaluate(host.state(), force, stiffness), std::logic_error);  // no search in this step
    i.search(host.state());
    EXPECT_GT(i.evaluate(host.state(), force, stiffness).elastic, here.elastic);
  };
  Host host;
  const Surface lower(grid(host, 1, 1, -0.5, 1.5, -0.5, 1.5, flat));
  const Surface upper(grid(
      host, 1, 1, 0.0, 1.0, 0.0, 1.0, [](double, double) { return 0.05; }, false, false, 1.0));
  Options o;
  o.gap = 0.1;
  refused(host, Interface::two_surfaces(lower, upper, o), true);
  refused(host, Interface::nodes_to_surface({4, 5, 6, 7}, {}, lower, o), false);
}

/// What the first search says of an interface whose sides have been given stiffness or not; nothing: it is made.
std::string said(Interface i, const Host& host, bool first, bool second) {
  if (first) test::set_stiffness(i, 0, 1, 1.0);
  if (second) test::set_stiffness(i, 1, 1, 1.0);
  try {
    i.search(host.state());
  } catch (const std::logic_error& error) { return error.what(); }
  return {};
}

// Stiffness that nobody gave would be a contact without force.
TEST(Refused, contacts_whose_stiffness_was_never_given) {
  Host host;
  const Surface lower(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat)), upper(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat));
  const auto lacks = [](const std::string& what, const char* call) { return what.find(call) != std::string::npos; };
  const auto two = [&](bool first, bool second) { return said(Interface::two_surfaces(lower, upper, {}), host, first, second); };
  EXPECT_TRUE(lacks(two(false, true), "set_surface(0, ...)")) << two(false, true);
  EXPECT_TRUE(lacks(two(true, false), "set_surface(1, ...)"));
  EXPECT_EQ(two(true, true), "");
  for (const bool own : {false, true}) {
    const auto one = [&](bool second) {
      return said(Interface::nodes_to_surface({4}, std::vector<double>(own ? 1 : 0, 1.0), lower, {}), host, false, second);
    };
    EXPECT_TRUE(lacks(one(false), "set_surface(1, ...)"));
    EXPECT_EQ(one(true), "");
  }
  using Rule = BothSidesOptions::Stiffness;
  const auto both = [&](Rule rule, double least, bool first, bool second) {
    BothSidesOptions o;
    o.gap = 0.1;
    o.stiffness = rule;
    o.stiffness_min = least;
    return said(Interface::both_sides({4}, lower, o), host, first, second);
  };
  EXPECT_TRUE(lacks(both(Rule::facet, 1.0, true, false), "set_surface(1, ...)"));
  EXPECT_EQ(both(Rule::facet, 0.0, false, true), "");
  for (const Rule rule : {Rule::smaller, Rule::series}) {
    EXPECT_TRUE(lacks(both(rule, 0.0, false, true), "set_surface(0, ...)"));
    EXPECT_EQ(both(rule, 0.0, true, true), "");
    EXPECT_EQ(both(rule, 1.0, false, true), "");  // stiffness_min is one
  }
  for (const Rule rule : {Rule::mean, Rule::larger}) {
    EXPECT_TRUE(lacks(both(rule, 0.0, false, false), "set_surface(0, ...)"));
    EXPECT_EQ(both(rule, 0.0, true, false), "");
  }
}

// A window without time would be no contact; a choice that does not exist would be some other one.
TEST(Refused, options_that_mean_nothing) {
  Host host;
  const Surface surface(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat));
  const auto one = [&](const auto& change) {
    Options o;
    change(o);
    EXPECT_THROW((void)Interface::nodes_to_surface({4}, {}, surface, o), std::invalid_argument);
  };
  one([](Options& o) { o.birth = 1.0, o.death = 0.5; });
  one([](Options& o) { o.birth = o.death = 1.0; });
  one([](Options& o) { o.initial = static_cast<Initial>(4); });
  one([](Options& o) { o.rules.law = static_cast<Law>(2); });
  one([](Options& o) { o.rules.edges = static_cast<Edges>(-1); });
  one([](Options& o) { o.friction_law.model = static_cast<FrictionLaw::Model>(5); });
  const auto both = [&](const auto& change) {
    BothSidesOptions o;
    o.gap = 0.1;
    change(o);
    EXPECT_THROW((void)Interface::both_sides({4}, surface, o), std::invalid_argument);
  };
  using Both = BothSidesOptions;
  both([](Both& o) { o.birth = 1.0, o.death = 0.5; });
  both([](Both& o) { o.initial = static_cast<Both::Initial>(5); });
  both([](Both& o) { o.stiffness = static_cast<Both::Stiffness>(5); });
  both([](Both& o) { o.friction_form = static_cast<Both::Friction>(2); });
  both([](Both& o) { o.step_scale = 0.0; });
  both([](Both& o) { o.node_size = {1.0}, o.facet_size = {1.0}; });
}

TEST(Refused, stiffness_of_held_nodes) {
  Host host;
  const Surface surface(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat));
  const Index node = host.add({0.5, 0.5, 0.1}, 1.0);
  for (const double bad : {-1.0, nan, infinite}) {
    EXPECT_THROW((void)Interface::nodes_to_surface({node}, {bad}, surface, {}), std::invalid_argument) << bad;
  }
  EXPECT_NO_THROW((void)Interface::nodes_to_surface({node}, {0.0}, surface, {}));
}

TEST(Refused, gaps_and_sizes_of_both_sides) {
  Host host;
  const Surface surface(grid(host, 1, 1, 0.0, 1.0, 0.0, 1.0, flat));
  const Index node = host.add({0.5, 0.5, 0.1}, 1.0);
  for (const double bad : {-0.1, nan, infinite}) {
    BothSidesOptions o;
    o.gap = bad;
    EXPECT_THROW((void)Interface::both_sides({node}, surface, o), std::invalid_argument) << bad;
    for (auto list :
         {&BothSidesOptions::node_gap, &BothSidesOptions::facet_gap, &BothSidesOptions::node_size, &BothSidesOptions::facet_size}) {
      o = {};
      o.gap = 0.1;
      o.node_gap = o.facet_gap = o.node_size = o.facet_size = {0.1};
      EXPECT_NO_THROW((void)Interface::both_sides({node}, surface, o));
      (o.*list)[0] = bad;
      EXPECT_THROW((void)Interface::both_sides({node}, surface, o), std::invalid_argument) << bad;
    }
  }
}

}  // namespace
}  // namespace abut::contact
