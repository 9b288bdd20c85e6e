// Contact keeps its energy while the host's step changes: the usual h = 0.9 sqrt(2 m/K), the kinematic limit, growth by 1.1 per cycle.
#include <gtest/gtest.h>

#include <abut/contact/call_log.hpp>
#include <abut/contact/interface.hpp>
#include <array>
#include <cstdio>
#include <random>
#include <sstream>
#include <stdexcept>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;
using test::set_stiffness;

constexpr double gap = 0.1;

/// The coming step of a host whose only other limit is `longest`.
double coming_step(const Host& host, double longest) {
  double h = std::min(longest, host.last.kinematic_step);
  for (std::size_t i = 0; i < host.x.size(); ++i) {
    if (host.k[i] > 0.0 && host.m[i] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[i] / host.k[i]));
  }
  return host.dt > 0.0 ? std::min(h, 1.1 * host.dt) : h;
}

void advance(Host& host, Interface& i, double longest, const std::function<void(Host&)>& loads = {}) {
  host.contact(i);
  if (loads) loads(host);
  const double h = coming_step(host, longest);
  const double bar = 0.5 * (host.dt + h);
  for (std::size_t n = 0; n < host.x.size(); ++n) {
    if (host.m[n] > 0.0) host.v[n] += (bar / host.m[n]) * host.f[n];
    host.x[n] += h * host.v[n];
  }
  host.before = host.dt;
  host.dt = h;
  host.time += h;
}

double kinetic(const Host& host) {
  double sum = 0.0;
  for (std::size_t n = 0; n < host.x.size(); ++n) sum += 0.5 * host.m[n] * squared_norm(host.v[n]);
  return sum;
}

struct Change {
  double mean = 0.0, worst = 0.0, made = 0.0;
  int shots = 0;
  void add(double before, double after, double by_contact) {
    const double change = std::abs(after / before - 1.0);
    mean = (mean * shots + change) / (shots + 1);
    ++shots;
    worst = std::max(worst, change);
    made = std::max(made, std::abs(by_contact) / before);
  }
};

/// Until the contact that comes has ended.
void bounce(Host& host, Interface& i, double longest) {
  bool touched = false;
  for (int step = 0; step < 4000; ++step) {
    advance(host, i, longest);
    touched = touched || host.last.in_contact > 0;
    if (touched && host.last.in_contact == 0) break;
  }
}

/// @param deep    P / Gap that the node would reach
/// @param flight  gaps that it flies in a step before the contact is seen
Change node_bounces(double deep, double flight, double facet_mass, Law law) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Change result;
  for (int shot = 0; shot < 200; ++shot) {
    Host host;
    const auto facets = grid(host, 1, 1, -1, 1, -1, 1, flat, true, false, facet_mass);
    const double shape = law == Law::stiffening ? -deep - std::log1p(-deep) : 0.5 * deep * deep;
    const double speed = gap * std::sqrt(2.0 * shape);
    const double longest = flight * gap / speed;
    const Index n = host.add({0.1, 0.2, gap * (1.0 + flight * (2.0 + u(random)))}, 1.0, {0, 0, -speed});
    Options o;
    o.gap = gap;
    o.rules.law = law;
    o.stiffness_scale = 1.0;
    Interface i = Interface::nodes_to_surface({n}, {2.0}, Surface(facets), o);
    set_stiffness(i, 1, 1, 2.0);
    host.dt = host.before = longest;
    const double before = kinetic(host);
    bounce(host, i, longest);
    result.add(before, kinetic(host), host.last.made);
  }
  return result;
}

// A bounce keeps its energy to 0.2 %, however the step falls before the contact and rises after it.
TEST(ChangingStep, bounce_keeps_its_energy) {
  for (const Law law : {Law::constant, Law::stiffening}) {
    Change all;
    for (const double deep : {0.3, 0.6, 0.85, 0.97}) {
      for (const double flight : {0.02, 0.2, 0.6, 2.0}) {
        for (const double mass : {0.0, 0.5}) {
          const Change c = node_bounces(deep, flight, mass, law);
          EXPECT_LT(c.worst, 0.002) << deep << " " << flight << " " << mass;
          EXPECT_LT(c.made, 0.002) << deep << " " << flight << " " << mass;
          all.mean = std::max(all.mean, c.mean);
          all.worst = std::max(all.worst, c.worst);
        }
      }
    }
    std::printf("  %s: kinetic energy after a bounce, largest mean %.4f %% worst %.4f %%\n",
                law == Law::constant ? "constant" : "stiffening", 100 * all.mean, 100 * all.worst);
  }
}

// Two free plates meet, both passes act on every node, nothing but the contact holds the step.
TEST(ChangingStep, plates_keep_their_energy) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (const double flight : {0.02, 0.2, 0.6}) {
    for (const double deep : {0.3, 0.8}) {
      Change c;
      for (int shot = 0; shot < 30; ++shot) {
        Host host;
        const double speed = gap * std::sqrt(2.0 * (-deep - std::log1p(-deep)));
        const double start = gap * (1.0 + flight * (2.0 + u(random)));
        const auto lower = grid(host, 4, 4, -2, 2, -2, 2, flat, true, false, 2.0);
        const std::size_t first = host.x.size();
        const auto upper = grid(
            host, 4, 4, -2, 2, -2, 2, [start](double, double) { return start; }, false, false, 2.0);
        for (std::size_t n = 0; n < host.x.size(); ++n) host.v[n].z = n < first ? 0.5 * speed : -0.5 * speed;
        Options o;
        o.gap = gap;
        o.stiffness_scale = 0.5;
        Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
        set_stiffness(i, 0, lower.size(), 1.0);
        set_stiffness(i, 1, upper.size(), 1.0);
        const double longest = flight * gap / speed;
        host.dt = host.before = longest;
        const double before = kinetic(host);
        bounce(host, i, longest);
        c.add(before, kinetic(host), host.last.made);
      }
      std::printf("  %.2f gaps per step, P/Gap %.2f: kinetic energy mean %.4f %% worst %.4f %%, CX worst %.4f %%\n", flight, deep,
                  100 * c.mean, 100 * c.worst, 100 * c.made);
      EXPECT_LT(c.mean, 0.002) << flight << " " << deep;
    }
  }
}

// A light node is pressed on a stiffening contact without damping for 10^5 cycles: it goes on bouncing, no higher than it fell.
TEST(ChangingStep, pressed_node_gains_no_speed) {
  for (const double press : {0.05, 0.5, 3.0}) {
    Host host;
    const auto facets = grid(host, 1, 1, -1, 1, -1, 1, flat);
    const double fall = 0.5 * gap;
    const Index n = host.add({0.1, 0.2, gap + fall}, 1.0);
    const auto at = static_cast<std::size_t>(n);
    Options o;
    o.gap = gap;
    o.stiffness_scale = 1.0;
    Interface i = Interface::nodes_to_surface({n}, {2.0}, Surface(facets), o);
    set_stiffness(i, 1, 1, 2.0);
    const double longest = 0.2 * std::sqrt(2.0 * fall / press);
    double highest = 0.0, last = 0.0;
    for (int step = 0; step < 100000; ++step) {
      advance(host, i, longest, [at, press](Host& h) { h.f[at].z -= press; });
      if (step > 1000) highest = std::max(highest, host.x[at].z - gap);
      if (step > 99000) last = std::max(last, host.x[at].z - gap);
    }
    EXPECT_LE(highest, fall) << press;
    std::printf("  press %.2f: fell from %.4f, highest later %.4f, in the last 1000 cycles %.4f\n", press, fall, highest, last);
  }
}

// A held node whose facet erodes, or whose contact dies, in the step in which the step falls to a tenth: CX is what the contact made, all
// of it.
TEST(ChangingStep, made_is_booked_when_a_facet_goes) {
  for (const bool dies : {false, true}) {
    Host host;
    const auto facets = grid(host, 1, 1, -1, 1, -1, 1, flat);
    const auto n = static_cast<std::size_t>(host.add({0.1, 0.2, gap + 1e-3}, 1.0, {0, 0, -0.05}));
    Options o;
    o.gap = gap;
    o.rules.law = Law::constant;
    o.stiffness_scale = 1.0;
    constexpr double h = 0.2;
    constexpr int last = 6;
    if (dies) o.death = (last - 0.95) * h;
    Interface i = Interface::nodes_to_surface({static_cast<Index>(n)}, {2.0}, Surface(facets), o);
    set_stiffness(i, 1, 1, 2.0);
    double kinetic_sum = 0.0, first = 0.0;  // leap-frog's own, v.v'/2
    for (int step = 0; step < last + 3; ++step) {
      const Vec3 v = host.v[n];
      if (step == last && !dies) {
        const std::vector<std::uint8_t> gone{0};
        i.set_surface(1, {.active = gone});
      }
      host.step(i, step >= last - 1 ? 0.1 * h : h);
      kinetic_sum = 0.5 * dot(v, host.v[n]);
      if (step == 0) first = kinetic_sum;
    }
    EXPECT_EQ(host.last.in_contact, 0);
    EXPECT_GT(std::abs(kinetic_sum - first), 0.1 * first);
    EXPECT_NEAR(host.last.made, kinetic_sum - first, 1e-12 * first) << dies;
  }
}

// A host says that a facet cannot move by masses of zero or by mobilities: the same bits. One that moves along z has the mass of a mobility
// along z, but for the square of its tilt. A replay of the calls knows them.
TEST(ChangingStep, mobility_stands_for_mass) {
  for (const bool slides : {false, true}) {
    std::array<std::vector<Vec3>, 2> motion;
    for (const bool by_mobility : {false, true}) {
      Host host;
      const auto facets = grid(host, 1, 1, -1, 1, -1, 1, flat, true, false, slides || by_mobility ? 2.0 : 0.0);
      const Index n = host.add({0.1, 0.2, 1.5 * gap}, 1.0, {0, 0, -0.05});
      Options o;
      o.gap = gap;
      o.stiffness_scale = 1.0;
      Interface i = Interface::nodes_to_surface({n}, {2.0}, Surface(facets), o);
      set_stiffness(i, 1, 1, 2.0);
      std::ostringstream log;
      i.record(log);
      const std::vector<Index> constrained{0, 0, 0, 0, no_index};
      std::vector<Mobility> mobility(1);
      if (slides) mobility[0].add(0.5, {0, 0, 1});
      std::vector<Index> wrong = constrained;
      wrong[1] = 1;
      for (int step = 0; step < 60; ++step) {
        host.f.assign(host.x.size(), {});
        host.k.assign(host.x.size(), 0.0);
        HostState state = host.state();
        if (by_mobility) {
          state.mobility = mobility;
          state.constrained = wrong;
          EXPECT_THROW(i.search(state), std::invalid_argument);
          state.constrained = constrained;
        }
        i.search(state);
        i.evaluate(state, host.f, host.k);
        i.commit(0.1);
        for (std::size_t k = 0; k < host.x.size(); ++k) {
          if (host.m[k] > 0.0 && (slides || k == static_cast<std::size_t>(n))) host.v[k] += (0.1 / host.m[k]) * host.f[k];
          host.x[k] += 0.1 * host.v[k];
        }
        host.before = host.dt;
        host.dt = 0.1;
        host.time += 0.1;
      }
      motion[by_mobility ? 1 : 0] = host.x;
      std::istringstream in(log.str());
      EXPECT_EQ(replay(in).different, 0);
    }
    EXPECT_TRUE(slides || motion[0] == motion[1]);
    for (std::size_t k = 0; k < motion[0].size(); ++k) EXPECT_LT(norm(motion[0][k] - motion[1][k]), 1e-8) << k;
  }
}

}  // namespace
}  // namespace abut::contact
