// What an interface says of each held node for output: opening, penetration, stick or slip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;

constexpr double gap = 0.1;

/// A 3 x 3 patch at height `z` over a larger plane, normals face to face.
struct Patches {
  Host host;
  std::size_t first_of_upper = 0;
  Interface interface;  // made last: it sets first_of_upper

  static Interface make(Host& host, double z, double friction, std::size_t& first_of_upper) {
    const auto lower = grid(host, 6, 6, 0.0, 6.0, 0.0, 6.0, flat);
    first_of_upper = host.x.size();
    const auto upper = grid(
        host, 2, 2, 1.3, 3.3, 1.4, 3.4, [z](double, double) { return z; }, false);
    Options options;
    options.gap = gap;
    options.friction = friction;
    Interface interface = Interface::two_surfaces(Surface(lower), Surface(upper), options);
    test::set_stiffness(interface, 0, lower.size(), 100.0);
    test::set_stiffness(interface, 1, upper.size(), 100.0);
    return interface;
  }
  explicit Patches(double z, double friction = 0.0) : interface(make(host, z, friction, first_of_upper)) {}

  void move(const Vec3& by) {
    std::vector<Vec3> x = host.x;
    for (std::size_t n = first_of_upper; n < x.size(); ++n) x[n] += by;
    host.place(interface, x);
  }
  std::vector<NodalContact> contacts() {
    std::vector<NodalContact> out(host.x.size());
    interface.add_nodal_contact(out);
    return out;
  }
};

TEST(NodalContact, OpeningIsTheDistanceLessTheGap) {
  Patches p(gap + 0.03);
  p.move({});
  const auto c = p.contacts();
  for (std::size_t n = p.first_of_upper; n < c.size(); ++n) {
    EXPECT_NEAR(c[n].opening, 0.03, 1e-12) << n;
    EXPECT_EQ(c[n].penetration, 0.0);
    EXPECT_EQ(c[n].state, NodalContact::State::apart);
  }
  EXPECT_TRUE(std::isnan(c[0].opening)) << "a node of the plane with nothing before it";
}

TEST(NodalContact, PenetrationIsWhatTheForceIsMadeOf) {
  Patches p(gap + 0.03);
  p.move({});
  p.move({0.0, 0.0, -0.05});
  const auto c = p.contacts();
  for (std::size_t n = p.first_of_upper; n < c.size(); ++n) {
    EXPECT_NEAR(c[n].penetration, 0.02, 1e-12);
    EXPECT_NEAR(c[n].opening, -0.02, 1e-12);
    EXPECT_EQ(c[n].state, NodalContact::State::slip) << "without friction every contact slips";
  }
  EXPECT_NEAR(p.host.last.largest_penetration, 0.02, 1e-12);
}

TEST(NodalContact, AskingChangesNothing) {
  Patches asked(gap + 0.01, 0.3), silent(gap + 0.01, 0.3);
  for (int k = 0; k < 6; ++k) {
    const Vec3 by{0.003 * k, 0.0, k < 3 ? -0.012 : 0.004};
    asked.move(by);
    silent.move(by);
    (void)asked.contacts();
    ASSERT_EQ(asked.interface.history(), silent.interface.history()) << k;
    for (std::size_t n = 0; n < asked.host.f.size(); ++n) ASSERT_EQ(asked.host.f[n], silent.host.f[n]);
  }
}

TEST(NodalContact, SticksBelowTheLimitOfCoulombAndSlipsBeyondIt) {
  Patches p(gap + 0.001, 0.5);
  p.move({});
  p.move({0.0, 0.0, -0.021});
  p.move({1e-6, 0.0, 0.0});
  for (std::size_t n = p.first_of_upper; n < p.host.x.size(); ++n) EXPECT_EQ(p.contacts()[n].state, NodalContact::State::stick);
  p.move({0.5, 0.0, 0.0});
  for (std::size_t n = p.first_of_upper; n < p.host.x.size(); ++n) EXPECT_EQ(p.contacts()[n].state, NodalContact::State::slip);
  p.move({0.0, 0.0, 0.5});
  for (std::size_t n = p.first_of_upper; n < p.host.x.size(); ++n) EXPECT_EQ(p.contacts()[n].state, NodalContact::State::apart);
}

TEST(NodalContact, TwoSidedInterfaceToo) {
  Host host;
  const auto plane = grid(host, 4, 4, 0.0, 4.0, 0.0, 4.0, flat);
  const Index node = host.add({2.2, 1.7, gap + 0.01}, 1.0);
  BothSidesOptions options;
  options.gap = gap;
  Interface interface = Interface::both_sides({node}, Surface(plane), options);
  test::set_stiffness(interface, 1, plane.size(), 100.0);
  const auto at = [&](double z) {
    std::vector<Vec3> x = host.x;
    x[static_cast<std::size_t>(node)].z = z;
    host.place(interface, x);
    std::vector<NodalContact> out(host.x.size());
    interface.add_nodal_contact(out);
    return out[static_cast<std::size_t>(node)];
  };
  EXPECT_NEAR(at(gap + 0.01).opening, 0.01, 1e-12);
  const NodalContact c = at(gap - 0.02);
  EXPECT_NEAR(c.opening, -0.02, 1e-12);
  EXPECT_NEAR(c.penetration, 0.02, 1e-12);
  EXPECT_EQ(c.state, NodalContact::State::slip);
}

// A node wanders over a plane, in small steps and in large ones: what is said of it is its height less the gap, up to the size of a facet,
// whatever the search lists of the step hold. Above the border it is the distance from there.
TEST(NodalContact, TwoSidedOpeningIsThatOfTheNearestFacet) {
  Host host;
  const auto plane = grid(host, 8, 8, 0.0, 8.0, 0.0, 8.0, flat);
  const Index node = host.add({4.0, 4.0, 1.0}, 1.0);
  BothSidesOptions options;
  options.gap = gap;
  Interface interface = Interface::both_sides({node}, Surface(plane), options);
  test::set_stiffness(interface, 1, plane.size(), 100.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int said = 0, silent = 0;
  for (int step = 0; step < 3000; ++step) {
    std::vector<Vec3> x = host.x;
    Vec3& now = x.back();
    now += (step % 10 == 0 ? 0.5 : 0.02) * Vec3{u(random), u(random), u(random)};
    now = {std::clamp(now.x, -1.0, 9.0), std::clamp(now.y, -1.0, 9.0), std::clamp(now.z, 0.001, 1.5)};
    host.place(interface, x);
    std::vector<NodalContact> out(host.x.size());
    interface.add_nodal_contact(out);
    const double opening = norm(now - Vec3{std::clamp(now.x, 0.0, 8.0), std::clamp(now.y, 0.0, 8.0), 0.0}) - gap;
    (opening <= 1.0 ? said : silent) += 1;
    if (opening <= 1.0) {
      ASSERT_NEAR(out.back().opening, opening, 1e-12) << step;
    } else {
      ASSERT_TRUE(std::isnan(out.back().opening)) << step;
    }
  }
  EXPECT_GT(said, 500);
  EXPECT_GT(silent, 500);
}

/// What is said of a node that lies 0.02 deep in the gap of a plane, before, in and after the interface's time window, and when it goes on
/// from what it remembered.
void expect_silence_outside_of_the_window(const std::function<Interface(const std::vector<Facet>&, Index)>& make) {
  Host host;
  const auto plane = grid(host, 4, 4, 0.0, 4.0, 0.0, 4.0, flat);
  const Index node = host.add({2.2, 1.7, gap - 0.02}, 1.0);
  Interface interface = make(plane, node);
  const auto said = [&host](const Interface& i) {
    std::vector<NodalContact> out(host.x.size());
    i.add_nodal_contact(out);
    return out.back();
  };
  for (int step = 1; step <= 9; ++step) {
    const bool acts = step >= 3 && step <= 6;
    host.place(interface, host.x);
    if (acts) {
      EXPECT_NEAR(said(interface).opening, -0.02, 1e-12) << step;
      EXPECT_NEAR(said(interface).penetration, 0.02, 1e-12) << step;
      EXPECT_NE(said(interface).state, NodalContact::State::apart) << step;
    }
    Interface again = make(plane, node);
    again.restore(interface.history());
    for (const Interface* i : {&again, &interface}) {
      if (i == &interface && acts) continue;
      EXPECT_TRUE(std::isnan(said(*i).opening)) << step;
      EXPECT_EQ(said(*i).penetration, 0.0) << step;
      EXPECT_EQ(said(*i).state, NodalContact::State::apart) << step;
    }
  }
}

TEST(NodalContact, OutsideOfTheTimeWindowNothingIsSaid) {
  for (const Rules& rules : {Rules::standard(), Rules::reference()}) {
    expect_silence_outside_of_the_window([&rules](const std::vector<Facet>& plane, Index node) {
      Options options;
      options.rules = rules;
      options.gap = gap;
      options.birth = 2.5;
      options.death = 6.5;
      Interface interface = Interface::nodes_to_surface({node}, {100.0}, Surface(plane), options);
      test::set_stiffness(interface, 1, plane.size(), 100.0);
      return interface;
    });
  }
  expect_silence_outside_of_the_window([](const std::vector<Facet>& plane, Index node) {
    BothSidesOptions options;
    options.gap = gap;
    options.birth = 2.5;
    options.death = 6.5;
    options.initial = BothSidesOptions::Initial::keep;
    Interface interface = Interface::both_sides({node}, Surface(plane), options);
    test::set_stiffness(interface, 1, plane.size(), 100.0);
    return interface;
  });
}

}  // namespace
}  // namespace abut::contact
