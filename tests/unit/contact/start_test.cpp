// The gradual start: overlapping bodies are pushed apart over a time, and the work of it is booked (issue 3, section 3).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

constexpr double pi = 3.14159265358979323846;

/// Two sheets of free nodes that overlap by `overlap`; each node hangs on a spring of its own: a press fit.
struct PressFit {
  Host host;
  std::vector<Facet> lower, upper;
  std::vector<Vec3> home;
  double spring = 1.0;

  explicit PressFit(double overlap, double gap, int facets = 3) {
    lower = grid(host, facets, facets, -1.5, 1.5, -1.5, 1.5, test::flat, true, false, 1.0);
    upper = grid(
        host, facets, facets, -1.5, 1.5, -1.5, 1.5, [=](double, double) { return gap - overlap; }, false, false, 1.0);
    home = host.x;
  }
  Interface make(const Options& o) const {
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
    set_stiffness(i, 0, lower.size(), 10.0);
    set_stiffness(i, 1, upper.size(), 10.0);
    return i;
  }
  /// @return kinetic energy in the product form and spring energy at t^n
  double step(Interface& i, double h) {
    double kinetic = 0.0, stored = 0.0;
    std::vector<Vec3> before = host.v;
    for (std::size_t n = 0; n < home.size(); ++n) stored += 0.5 * spring * squared_norm(host.x[n] - home[n]);
    host.step(i, h, [this](Host& at) {
      for (std::size_t n = 0; n < home.size(); ++n) at.f[n] -= spring * (at.x[n] - home[n]);
    });
    for (std::size_t n = 0; n < home.size(); ++n) kinetic += 0.5 * host.m[n] * dot(before[n], host.v[n]);
    return kinetic + stored;
  }
};

Options options(double gap, double start, Law law = Law::constant) {
  Options o;
  o.gap = gap;
  o.stiffness_scale = 0.2;
  o.start_duration = start;
  o.depth_limit = 1.0;
  o.rules.law = law;
  return o;
}

// Statics: facing nodes of tributary share w (1/4, 1/2, 1 of a facet's K) on springs k settle at P = u D/(u + K), D the overlap, u = k/2
// and K both passes' springs. A start of ten periods gets there without a bounce; one at once swings to twice the way.
TEST(GradualStart, presses_in_without_bounce) {
  for (const double gap : {0.0, 0.3}) {
    const double overlap = 0.1, h = 0.1;
    double largest[2] = {0.0, 0.0}, last[2] = {0.0, 0.0};
    for (const bool gradual : {false, true}) {
      PressFit p(overlap, gap);
      const double start = 10.0 * 2.0 * pi;
      Interface i = p.make(options(gap, gradual ? start : 0.0));
      double balance = 0.0, first = 0.0, scale = 0.0;
      const int steps = static_cast<int>(1.5 * start / h);
      for (int step = 0; step < steps; ++step) {
        const double energy = p.step(i, h);
        const StepResult& r = p.host.last;
        if (step == 0) {
          first = energy + r.elastic;
          if (gradual) {
            EXPECT_EQ(r.elastic, 0.0);
            EXPECT_EQ(norm(r.normal_force), 0.0);
          }
        }
        scale = std::max({scale, r.elastic, energy});
        // Every step: what is there now is what was there at first and what the start has put in, but for what is in CX.
        balance = std::max(balance, std::abs(energy + r.elastic - first - r.start_work - r.made));
        EXPECT_LT(std::abs(r.made), 1e-3 * scale + 1e-15) << step;
        largest[gradual] = std::max(largest[gradual], r.normal_force.z);
        last[gradual] = r.normal_force.z;
      }
      if (!gradual) {  // its first force acts at once: the product form of the kinetic energy does not know that step
        EXPECT_EQ(p.host.last.start_work, 0.0);
        continue;
      }
      EXPECT_LT(balance, 1e-12 * scale);
      // Closed form at rest, node by node.
      double force = 0.0, energy = 0.0;
      for (const double w : {1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 4.0, 4.0, 4.0, 4.0}) {
        const double k2 = 10.0 * w / 4.0, pair = 2.0 * 0.2 * 10.0 * k2 / (10.0 + k2), u = 0.5 * p.spring;
        const double depth = u * overlap / (u + pair);
        force += pair * depth;
        energy += 0.5 * pair * depth * depth + 0.5 * u * (overlap - depth) * (overlap - depth);
      }
      std::printf("  gap %.1f: force %.6f of %.6f, start work %.8f of %.8f, largest |CX| %.1e\n", gap, p.host.last.normal_force.z, force,
                  p.host.last.start_work, energy, p.host.last.made);
      EXPECT_NEAR(p.host.last.normal_force.z, force, 1e-3 * force);
      EXPECT_NEAR(p.host.last.start_work, energy, 1e-3 * energy);
      EXPECT_LT(largest[1], 1.002 * force);
    }
    EXPECT_GT(largest[0], 1.9 * last[1]);
  }
}

// With the stiffening law the work is not quadratic: the booking is good to second order in the step.
TEST(GradualStart, books_the_work_of_the_stiffening_law) {
  double error[2] = {};
  for (const int k : {0, 1}) {
    const double h = k == 0 ? 0.1 : 0.05;
    PressFit p(0.25, 0.3);
    Interface i = p.make(options(0.3, 40.0, Law::stiffening));
    for (int step = 0; step * h < 50.0; ++step) p.step(i, h);
    error[k] = std::abs(p.host.last.made) / p.host.last.start_work;
  }
  std::printf("  |CX|/SW %.2e, with half the step %.2e\n", error[0], error[1]);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_LT(error[1], 0.3 * error[0]);
}

// A birth shifts the start; a history taken on the way carries it.
TEST(GradualStart, begins_at_birth_and_can_be_resumed) {
  Options o = options(0.3, 20.0);
  o.birth = 5.0;
  PressFit p(0.1, 0.3);
  Interface i = p.make(o);
  for (int step = 0; step < 100; ++step) {
    p.step(i, 0.1);
    if (p.host.time < 5.05) { EXPECT_EQ(p.host.last.elastic, 0.0); }
  }
  EXPECT_GT(p.host.last.start_work, 0.0);
  PressFit q = p;
  Interface j = q.make(o);
  j.restore(i.history());
  for (int step = 0; step < 200; ++step) {
    p.step(i, 0.1);
    q.step(j, 0.1);
    ASSERT_EQ(p.host.last.start_work, q.host.last.start_work);
    ASSERT_EQ(p.host.x, q.host.x);
  }
}

// A window that opens over nodes in the gap brings the energy that the springs then hold: it is work from outside, not made by contact.
TEST(GradualStart, a_birth_over_nodes_in_the_gap_is_booked) {
  for (const double damping : {0.0, 0.1}) {
    Options o = options(0.3, 0.0);
    o.birth = 5.0;
    o.damping = damping;
    PressFit p(0.1, 0.3);
    Interface i = p.make(o);
    double before = 0.0, largest = 0.0;
    while (p.host.time < 40.0) {
      const double energy = p.step(i, 0.02);
      const StepResult& r = p.host.last;
      if (r.start_work == 0.0) continue;
      if (largest == 0.0) {
        EXPECT_GT(r.elastic, 0.0);
        EXPECT_NEAR(r.start_work, r.elastic, 1e-12 * r.elastic);  // nothing moves yet
        EXPECT_NEAR(r.made, 0.0, 1e-12 * r.elastic);
      } else {
        EXPECT_EQ(r.start_work, before);  // once
        EXPECT_LT(std::abs(energy + r.elastic + r.damping_work + r.friction_work - r.start_work), 1e-2 * r.start_work);
      }
      before = r.start_work;
      largest = std::max(largest, r.elastic);
    }
    EXPECT_GT(before, 0.0);
    EXPECT_LT(std::abs(p.host.last.made), 1e-2 * before);
  }
}

// Leap-frog gives T* = m v.v'/2 what the forces work and what steps make that change under them, dampers' forces among them.
TEST(ContactEnergy, is_whole_with_dampers_and_changing_steps) {
  for (const double damping : {0.0, 0.3}) {
    Options o = options(0.3, 0.0);
    o.damping = damping;
    PressFit p(-0.05, 0.3, 1);
    p.spring = 0.0;
    for (std::size_t n = p.home.size() / 2; n < p.home.size(); ++n) p.host.v[n] = {0.0, 0.0, -0.2};
    Interface i = p.make(o);
    double start = 0.0, dampers = 0.0;
    for (int s = 0; s < 400; ++s) {
      const double kinetic = p.step(i, s % 3 == 0 ? 0.01 : 0.014);
      const StepResult& r = p.host.last;
      const double all = kinetic + r.elastic + r.damping_work + r.friction_work - r.made;
      if (s % 3 != 2) continue;  // between two steps that are not alike half of what their change makes is still to come
      if (s == 2) start = all;
      ASSERT_NEAR(all, start, 1e-12) << damping << ", step " << s;
      dampers = r.damping_work;
    }
    EXPECT_EQ(dampers > 0.0, damping > 0.0);
    EXPECT_GT(p.host.v.back().z, -0.1);  // it has bounced: faster than the centre of mass
  }
}

TEST(GradualStart, does_not_go_with_other_treatments) {
  PressFit p(0.1, 0.3);
  for (const Initial initial : {Initial::project, Initial::ignore}) {
    Options o = options(0.3, 1.0);
    o.initial = initial;
    EXPECT_THROW((void)p.make(o), std::invalid_argument);
  }
  EXPECT_THROW((void)p.make(options(0.3, -1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace abut::contact
