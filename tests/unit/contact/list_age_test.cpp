// Search lists live until something has moved by a skin: nothing that an interface says or remembers may depend on how old they are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "unit/contact/bench_host.hpp"

namespace abut::contact::test {
namespace {

// Nodes wander in front of, beside and behind a wavy plate, most of them out of its reach, some in and out of contact.
struct Wanderers {
  Host host;
  std::vector<Facet> plate;
  std::vector<Index> nodes;
  std::vector<std::vector<Vec3>> path;  // per step, of all nodes

  Wanderers(int count, int steps, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    plate = grid(host, 6, 6, -3, 3, -3, 3, [](double x, double y) { return 0.05 * std::sin(2 * x) * std::cos(3 * y); });
    const std::size_t first = host.x.size();
    for (int i = 0; i < count; ++i) nodes.push_back(host.add({3.3 * u(random), 3.3 * u(random), 0.9 * u(random)}, 1.0));
    std::vector<Vec3> now = host.x, velocity(host.x.size());
    for (std::size_t i = first; i < now.size(); ++i) velocity[i] = 0.01 * Vec3{u(random), u(random), u(random)};
    for (int step = 0; step < steps; ++step) {
      for (std::size_t i = 0; i < now.size(); ++i) {
        if (i >= first) velocity[i] += 0.002 * Vec3{u(random), u(random), u(random)};
        now[i] += i < first ? Vec3{0, 0, 0.002 * std::sin(0.3 * step + now[i].x)} : velocity[i];
      }
      path.push_back(now);
    }
  }
  [[nodiscard]] Interface make_two_sided() const {
    BothSidesOptions o;
    o.gap = 0.3;  // lists are made anew after half of it
    o.friction = 0.2;
    Interface i = Interface::both_sides(nodes, Surface(plate), o);
    const std::vector<double> held(nodes.size(), 1.0), facets(plate.size(), 1.0);
    i.set_surface(0, {.stiffness = held});
    i.set_surface(1, {.stiffness = facets});
    return i;
  }
  [[nodiscard]] Interface make(const Rules& rules) const {
    Options o;
    o.rules = rules;
    o.gap = 0.05;
    o.friction = 0.2;
    Interface i = Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 1.0), Surface(plate), o);
    const std::vector<double> stiffness(plate.size(), 1.0);
    i.set_surface(1, {.stiffness = stiffness});
    return i;
  }
};

/// What an interface shows of its nodes.
std::vector<double> openings(const Interface& interface, const Host& host) {
  std::vector<NodalContact> nodes(host.x.size());
  interface.add_nodal_contact(nodes);
  std::vector<double> all;
  for (const NodalContact& node : nodes) {
    all.push_back(std::isnan(node.opening) ? 1e300 : node.opening);
    all.push_back(node.penetration);
    all.push_back(static_cast<double>(node.state));
  }
  return all;
}

/// Interfaces that go on from what one of them remembered every 20 steps say and remember what it does, in every step.
/// @return nodes in contact, summed over the steps
int go_on_along(const Wanderers& w, const std::function<Interface()>& make) {
  Host whole = w.host;
  Interface a = make();
  std::vector<std::pair<Host, Interface>> resumed;
  int touched = 0;
  for (std::size_t step = 0; step < w.path.size(); ++step) {
    if (step % 20 == 10) {
      resumed.emplace_back(whole, make());
      resumed.back().second.restore(a.history());
    }
    whole.place(a, w.path[step]);
    touched += whole.last.in_contact;
    const std::vector<std::byte> history = a.history();
    const std::vector<double> shown = openings(a, whole);
    for (auto& [host, b] : resumed) {
      host.place(b, w.path[step]);
      EXPECT_EQ(host.f, whole.f) << "step " << step;
      EXPECT_EQ(host.k, whole.k) << "step " << step;
      EXPECT_EQ(host.last.largest_approach, whole.last.largest_approach) << "step " << step;
      EXPECT_EQ(host.last.kinematic_step, whole.last.kinematic_step) << "step " << step;
      EXPECT_EQ(openings(b, host), shown) << "step " << step;
      EXPECT_TRUE(b.history() == history) << "step " << step;
      if (testing::Test::HasFailure()) return touched;
    }
  }
  return touched;
}

// T1, docs/determinism.md: an interface that goes on from a history makes new lists, and must say and remember what the other does.
TEST(History, does_not_depend_on_the_age_of_the_lists) {
  constexpr int steps = 120;
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Wanderers w(400, steps, seed);
    const std::vector<std::function<Interface()>> kinds{[&w] { return w.make(Rules::standard()); },
                                                        [&w] { return w.make(Rules::reference()); }, [&w] { return w.make_two_sided(); }};
    for (const auto& make : kinds) {
      const int touched = go_on_along(w, make);
      EXPECT_GT(touched, 10 * steps);  // per step some of 400 nodes touch
      EXPECT_LT(touched, 200 * steps);
    }
  }
}

}  // namespace
}  // namespace abut::contact::test
