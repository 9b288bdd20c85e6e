// Contact keeps its energy while the host's step changes: the usual h = 0.9 sqrt(2 m/K), the kinematic limit, growth by 1.1 per cycle.
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cstdio>
#include <random>

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
    bool touched = false;
    for (int step = 0; step < 4000; ++step) {
      advance(host, i, longest);
      touched = touched || host.last.in_contact > 0;
      if (touched && host.last.in_contact == 0) break;
    }
    result.add(before, kinetic(host), host.last.made);
  }
  return result;
}

TEST(ChangingStep, bounce_keeps_its_energy) {
  for (const Law law : {Law::constant, Law::stiffening}) {
    for (const double deep : {0.3, 0.6, 0.85, 0.97}) {
      for (const double flight : {0.02, 0.2, 0.6, 2.0}) {
        for (const double mass : {0.0, 0.5}) {
          const Change c = node_bounces(deep, flight, mass, law);
          std::printf("  %s, P/Gap %.2f, %.2f gaps per step, facet mass %.1f: kinetic energy mean %.3f %% worst %.3f %%, CX worst %.3f %%\n",
                      law == Law::constant ? "constant" : "stiffening", deep, flight, mass, 100 * c.mean, 100 * c.worst, 100 * c.made);
        }
      }
    }
  }
}

}  // namespace
}  // namespace abut::contact
