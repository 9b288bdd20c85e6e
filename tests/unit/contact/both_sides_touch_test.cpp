// TYPE7: the cycles in which a pair starts and ends (docs/theory/contact.md, 7a).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::Host;

constexpr double gap = 0.2, stiffness = 2.0;  // K0 = 1

/// A quadrilateral of four nodes of the given mass (0: it does not move) and a node of mass 1 over it.
Host over_a_quad(double height, Vec3 velocity, double mass = 0.0) {
  Host host;
  for (const Vec3 corner : {Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, 0}}) host.add(corner, mass);
  host.add({0.0, 0.0, height}, 1.0, velocity);
  return host;
}

Interface interface_with(const BothSidesOptions& o) {
  Interface i = Interface::both_sides({4}, Surface(std::vector<Facet>{{{0, 1, 2, 3}}}), o);
  const std::vector<double> k{stiffness};
  i.set_surface(1, {k, {}, {}, {}});
  return i;
}

double kinetic_energy(const Host& host) {
  double sum = 0.0;
  for (std::size_t i = 0; i < host.x.size(); ++i) sum += 0.5 * host.m[i] * squared_norm(host.v[i]);
  return sum;
}

Vec3 momentum(const Host& host) {
  Vec3 sum;
  for (std::size_t i = 0; i < host.x.size(); ++i) sum += host.m[i] * host.v[i];
  return sum;
}

struct Flight {
  double energy = 0.0;    ///< |T + DW + FW - T0|/T0 once apart
  double momentum = 0.0;  ///< change over the first one; bodies that move
  double rebound = 0.0;   ///< speed of parting over that of approach
  double first_step = 0.0;
  int cycles = 0;  ///< until it has gone
};

/// Steps as a host takes them: nodal sums at a scale of 0.9, the interface's limit, `free` of the rest of the model, a tenth longer at
/// most.
Flight fly(Host host, const BothSidesOptions& o, double free) {
  Interface i = interface_with(o);
  const double t0 = kinetic_energy(host), approach = host.v[4].z;
  const Vec3 start = momentum(host);
  Flight out;
  bool touched = false;
  for (; out.cycles < 5000; ++out.cycles) {
    host.contact(i);
    touched = touched || host.last.in_contact > 0;
    if (touched && host.last.in_contact == 0) break;
    double h = std::min(free, host.last.kinematic_step);
    if (host.dt > 0.0) h = std::min(h, 1.1 * host.dt);
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      if (host.m[n] > 0.0 && host.k[n] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[n] / host.k[n]));
    }
    for (std::size_t n = 0; n < host.x.size(); ++n) {
      if (host.m[n] > 0.0) host.v[n] += (0.5 * (host.dt + h) / host.m[n]) * host.f[n];
      host.x[n] += h * host.v[n];
    }
    host.time += h;
    host.before = host.dt;
    host.dt = h;
    if (out.cycles == 0) out.first_step = h;
  }
  out.rebound = (host.v[0].z - host.v[4].z) / approach;
  out.momentum = norm(momentum(host) - start) / norm(start);
  out.energy = std::abs(kinetic_energy(host) + host.last.damping_work + host.last.friction_work - t0) / t0;
  return out;
}

// Nothing but the interface limits the step, which is up to 1500 times too long for its spring until the pair is near. From every distance
// (in the first cycle already, or after steps of 0.9 gap) the bodies part with their energy and momentum, as fast as they met, in few
// steps. With pairs foreseen half a gap ahead, and none in the first cycle, energy grew by factors of up to 10^9. With dampers it is T +
// DW: DW does not fall, which leaves it too large where a contact is over in a step.
TEST(BothSidesTouch, NothingElseLimitsTheStep) {
  for (const double damping : {0.0, 0.05}) {
    for (const double mass : {0.0, 0.5}) {
      double energy = 0.0;
      int cycles = 0;
      for (const double speed : {1e-4, 1e-3, 1e-2}) {
        for (const double gaps : {1 + 1e-9, 1.00001, 1.001, 1.05, 1.3, 1.5, 1.89, 1.91, 2.45, 2.6, 2.7, 2.85, 2.9, 3.65}) {
          BothSidesOptions o;
          o.gap = gap;
          o.damping = damping;
          const Flight f = fly(over_a_quad(gaps * gap, {0, 0, -speed}, mass), o, 1e30);
          if (mass > 0.0) { EXPECT_LT(f.momentum, 1e-13) << gaps; }
          // Without VIS_s the law still damps fast bodies: 0.32 m <-v>/(g - p).
          EXPECT_GT(f.rebound, damping > 0.0 ? 0.7 : 0.99 - 4.0 * speed) << gaps << " gaps, speed " << speed;
          EXPECT_LT(f.rebound, 1.01) << gaps << " gaps, speed " << speed;
          energy = std::max(energy, f.energy);
          cycles = std::max(cycles, f.cycles);
        }
      }
      std::printf("[found] nothing else limits the step, damping %.2f, corners of mass %.1f: |T + DW - T0| %.1e of T0, %d cycles\n",
                  damping, mass, energy, cycles);
      EXPECT_LT(energy, damping > 0.0 ? 0.1 : 0.02);
      EXPECT_LT(cycles, 60);
    }
  }
}

// A pair that touches in the first step of a run has it as short as it needs: 2.2 is what the rest of the model allows, 0.9 sqrt(2) what
// its spring does. A gap that begins where the node is (Inacti 5) is touched at once.
TEST(BothSidesTouch, FirstCycleLooksAhead) {
  double worst = 0.0;
  for (const double beyond : {1e-12, 1e-6, 1e-3, 5e-3, 1e-2, 2e-2}) {
    BothSidesOptions o;
    o.gap = gap;
    o.damping = 0.0;
    const Flight f = fly(over_a_quad(gap + beyond, {0, 0, -0.01}), o, 2.2);
    EXPECT_LE(f.first_step, 0.9 * std::sqrt(2.0)) << beyond;
    EXPECT_GT(f.rebound, 0.95) << beyond;
    EXPECT_LT(f.rebound, 1.01) << beyond;
    worst = std::max(worst, f.energy);
  }
  std::printf("[found] touch in the first cycle: worst change of energy %.4f\n", worst);
  EXPECT_LT(worst, 0.02);
  BothSidesOptions o;
  o.gap = gap;
  o.initial = BothSidesOptions::Initial::offset;
  const Flight f = fly(over_a_quad(0.7 * gap, {0, 0, -0.01}), o, 2.2);
  EXPECT_LE(f.first_step, 0.9 * std::sqrt(2.0));
  EXPECT_GT(f.rebound, 0.7);
  EXPECT_LT(f.rebound, 1.0);
}

// Springs and dampers of friction are foreseen like those along the normal: the step does not fall while the pair presses.
TEST(BothSidesTouch, FrictionIsForeseen) {
  for (const auto form : {BothSidesOptions::Friction::viscous, BothSidesOptions::Friction::incremental}) {
    double worst = 0.0;
    for (int phase = 0; phase < 40; ++phase) {
      BothSidesOptions o;
      o.gap = gap;
      o.friction = 0.3;
      o.friction_form = form;
      const Flight f = fly(over_a_quad(gap + 0.01 + 0.0005 * phase, {0.004, 0.003, -0.01}), o, 2.2);
      EXPECT_GT(f.rebound, 0.7) << phase;
      worst = std::max(worst, f.energy);
    }
    std::printf("[found] friction, %s: worst change of energy %.4f\n",
                form == BothSidesOptions::Friction::viscous ? "viscous" : "incremental", worst);
    EXPECT_LT(worst, 0.01);
  }
}

// Work of the contact forces in leap-frog is f (h + h')/2 (v + v')/2, exactly. With CE, DW and FW that is CX, also where the node is thrown
// out by others further than anything is looked ahead, or where its contact dies under force.
TEST(BothSidesTouch, WhatEndsIsBookedWhereverTheNodeIs) {
  for (const double thrown : {0.0, 0.2, 5.0, 500.0}) {
    for (const bool dies : {false, true}) {
      BothSidesOptions o;
      o.gap = gap;
      if (dies) o.death = 2.5;  // while it presses
      Host host = over_a_quad(1.05 * gap, {0, 0, -0.05});
      Interface i = interface_with(o);
      double work = 0.0;
      int touched = 0;
      for (const double h : {1.0, 0.6, 0.8, 0.4, 0.3, 1.1, 0.9}) {
        host.contact(i);
        touched += host.last.in_contact;
        const Vec3 before = host.v[4], kick = (0.5 * (host.dt + h)) * host.f[4];
        host.v[4] += kick;
        if (host.time > 2.3 && host.time < 2.5) host.v[4].z += thrown;  // at 2.4, while it presses: it opens in the next step
        work += 0.5 * dot(kick, before + host.v[4]);
        host.x[4] += h * host.v[4];
        host.before = host.dt;
        host.dt = h;
        host.time += h;
      }
      host.contact(i);
      EXPECT_GE(touched, 3) << thrown;
      EXPECT_EQ(host.last.in_contact, 0) << thrown;
      const double booked = host.last.elastic + host.last.friction_work + host.last.damping_work;
      EXPECT_NEAR(host.last.made, work + booked, 1e-13 * (1.0 + std::abs(work))) << thrown << (dies ? " dies" : "");
    }
  }
}

// A window that opens over a node in the gap brings the energy that its spring then holds: work from outside, not made by contact.
TEST(BothSidesTouch, a_birth_over_nodes_in_the_gap_is_booked) {
  Host host = over_a_quad(0.6 * gap, {});
  BothSidesOptions o;
  o.gap = gap;
  o.damping = 0.0;
  o.birth = 0.05;
  Interface i = interface_with(o);
  double put_in = 0.0;
  while (host.time < 20.0) {
    const StepResult r = host.step(i, 0.01);
    if (put_in == 0.0 && r.start_work > 0.0) {
      put_in = r.start_work;
      EXPECT_NEAR(put_in, r.elastic, 1e-12 * r.elastic);  // nothing moves yet
    }
    EXPECT_EQ(r.start_work, put_in);
    EXPECT_LT(std::abs(kinetic_energy(host) + r.elastic - put_in), 0.02 * put_in + 1e-15);
    EXPECT_LT(std::abs(r.made), 0.02 * put_in + 1e-15);
  }
  EXPECT_GT(put_in, 0.0);
  EXPECT_GT(host.v[4].z, 0.0);
}

}  // namespace
}  // namespace abut::contact
