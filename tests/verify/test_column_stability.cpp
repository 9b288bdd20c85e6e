// Two bars of 2 x 2 elements across that are pressed together without friction, one shifted sideways by a little: are they stable?
//
// Nodal springs of 0.4 : 0.67 : 1 under a uniform stress make the two faces bulge towards each other (test_bars.cpp): two roofs of
// four facets, of height b over the half width 1/2. Their tops stand on each other, and without friction that is no stable place: a top
// shifted by e, however small, meets the facet behind the ridge, whose normal leans by 2 b (a smooth bulge would lean by an
// angle that grows with e). It is pushed by 2 b F sideways, so
//   e ~ b F t^2 / m:  the same for every small e(0), of its sign, and of second order in the speed, as b and F are of first;
// friction holds it while mu exceeds the angle between the two facets that meet, about 4 b. So nothing is wrong with the energy or the
// search: it is the equilibrium of the bulges that is unstable, and it is as small as the penetration.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;

struct Column {
  double v = 0.1, s = 0.2, shift = 1e-6, friction = 0.0;
  bool linear = true;
};

struct Found {
  double at_12 = 0.0;    ///< e(12) - e(0)
  double bulge = 0.0;    ///< middle node before the corners, mean of both faces, at 12
  double impulse = 0.0;  ///< over the ideal 2 Z v T / 2
  double last = 0.0;     ///< last contact
};

Found press(const Column& c) {
  Scene scene("columns");
  const auto material = scene.elastic(1.0, 1.0, 0.0);
  const auto property = c.linear ? scene.linear_solid_property() : scene.solid_property();
  const auto p1 = scene.part(property, material);
  const auto p2 = scene.part(property, material);
  const auto first = scene.block(p1, {0, 0, 0}, {1, 1, 10}, {2, 2, 40});
  const auto second = scene.block(p2, {c.shift, 0, 10}, {1, 1, 10}, {2, 2, 40});
  scene.velocity(first.nodes, {0, 0, c.v});
  scene.velocity(second.nodes, {0, 0, -c.v});
  scene.contact(scene.surface(first, 2, true), scene.surface(second, 2, false), c.s, c.friction);
  scene.end(30.0);
  auto watched = first.plane(2, true);
  const auto other = second.plane(2, false);
  watched.insert(watched.end(), other.begin(), other.end());
  Recorder recorder(watched);
  const auto report = abut::cycle::run(scene.model, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;

  Found out;
  double before[3] = {};  // time, e, bulge of the last sample
  for (const auto& sample : recorder.samples) {
    Vec3 mean[2];
    double bulge = 0.0;
    for (std::size_t i = 0; i < 18; ++i) mean[i / 9] += sample.u[i] / 9.0;
    for (const std::size_t corner : {0u, 2u, 6u, 8u})
      bulge += 0.125 * (sample.u[4].z - sample.u[corner].z + sample.u[9 + corner].z - sample.u[13].z);
    const double e = mean[1].x - mean[0].x;
    if (before[0] < 12.0 && sample.time >= 12.0) {  // read between two steps: in one of them the slide grows by 2 %
      const double share = (12.0 - before[0]) / (sample.time - before[0]);
      out.at_12 = before[1] + share * (e - before[1]);
      out.bulge = before[2] + share * (bulge - before[2]);
    }
    before[0] = sample.time;
    before[1] = e;
    before[2] = bulge;
    if (sample.interfaces[0].in_contact > 0) out.last = sample.time;
    out.impulse = std::fabs(sample.interfaces[0].normal_impulse.z) / (20.0 * c.v);
  }
  std::printf(
      "[found] columns, v %.2f, s %.1f, shift %.0e, mu %.2f: bulge at t = 12 %.1e, slid by %.2e, impulse ratio %.3f, last contact %.2f\n",
      c.v, c.s, c.shift, c.friction, out.bulge, out.at_12, out.impulse, out.last);
  return out;
}

TEST(Columns, SlideByTheirBulgesHoweverSmallTheShift) {
  const Found tiny = press({0.1, 0.2, 1e-6}), small = press({0.1, 0.2, 1e-4}), mirrored = press({0.1, 0.2, -1e-6});
  EXPECT_NEAR(small.at_12 / tiny.at_12, 1.0, 0.02);  // 0.377 and 0.375: a hundredfold shift
  EXPECT_NEAR(mirrored.at_12 / tiny.at_12, -1.0, 0.01);
  EXPECT_LT(tiny.impulse, 0.6);  // a third of the face: they pass each other
}

TEST(Columns, SlideWithTheSquareOfTheSpeed) {
  for (const double s : {0.2, 1.0}) {
    const Found fast = press({0.03, s}), slow = press({0.01, s});
    EXPECT_NEAR(fast.bulge / slow.bulge, 3.0, 0.5) << s;
    EXPECT_NEAR(fast.at_12 / slow.at_12, 9.0, 3.0) << s;
    EXPECT_GT(slow.impulse, 0.99);  // the closed form holds to 1 %
  }
}

TEST(Columns, FrictionAboveTheAngleOfTheRoofsHolds) {
  const Found free = press({0.01, 1.0}), held = press({0.01, 1.0, 1e-6, 0.01}), too_little = press({0.1, 0.2, 1e-6, 0.01});
  EXPECT_LT(4.0 * held.bulge, 0.01);
  EXPECT_LT(std::fabs(held.at_12), 0.05 * std::fabs(free.at_12));
  EXPECT_GT(4.0 * too_little.bulge, 1.0);
  EXPECT_LT(too_little.impulse, 0.65);
}

}  // namespace
