// Rebounds from what is not free: clamped plates, rigid bodies (issue 3, section 3: effective inverse masses; docs/theory/contact.md 3).
//
// First and last contact forces and accounts of pairs are made with the pair's effective mass. With plain nodal masses these scenes kept,
// at 0.9 of the stable step: 0.13 % (clamped plate; the last CX over the largest energy), 7.2 % (rigid plate on a clamped one).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

constexpr double young = 210e9, density = 7800.0;

enum class Lower { clamped, sliding, rigid };

/// A plate of 6 by 6 shells falls at 5 m/s on one of 8 by 8 that cannot move, can move in its plane only, or is a free rigid body.
model::Model plates(Lower lower, bool rigid_upper, double scale) {
  Scene s("rebound");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.shell_property(0.002);
  const auto a = s.part(property, material);
  const auto b = s.part(property, material);
  const auto below = s.shells(a, 8, 8, [](double u, double v) { return Vec3{0.08 * u, 0.08 * v, 0}; });
  const auto above = s.shells(
      b, 6, 6,
      [](double u, double v) {
        return Vec3{0.0113 + 0.05 * u, 0.0121 + 0.05 * v, 0.00105};
      },
      true);
  s.velocity(above, {0, 0, -5});
  if (rigid_upper) s.velocity({s.rigid_body(above, {0.0363, 0.0371, 0.00105})}, {0, 0, -5});
  if (lower == Lower::clamped) s.fix(below, {true, true, true}, {true, true, true});
  if (lower == Lower::sliding) s.fix(below, {false, false, true}, {true, true, true});
  if (lower == Lower::rigid) s.rigid_body(below, {0.04, 0.04, 0});
  s.contact(s.shell_surface(a), s.shell_surface(b), 0.2, 0.0, 0.001);
  s.end(6e-4, 0.0, scale);
  return s.model;
}

/// Two rigid plates of 1 mm and 4 by 4 shells, at rest 0.7 gaps apart.
model::Model within_the_gap(double scale) {
  Scene s("within");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.shell_property(0.001);
  const auto a = s.part(property, material), b = s.part(property, material);
  const auto plate = [&s](Index part, double size, double z) {
    s.rigid_body(s.shells(
                     part, 4, 4,
                     [=](double u, double v) {
                       return Vec3{size * (u - 0.5), size * (v - 0.5), z};
                     },
                     z > 0.0),
                 {0, 0, z});
  };
  plate(a, 0.06, 0.0);
  plate(b, 0.04, 0.0007);
  s.contact(s.shell_surface(a), s.shell_surface(b), 0.2, 0.0, 0.001);
  s.end(5e-4, 0.0, scale);
  return s.model;
}

/// A rigid cube, turned somehow, falls corner first on a plate that is clamped or a free rigid body: few nodes meet, at different times.
model::Model cube(Lower lower, unsigned turn, double scale) {
  std::mt19937 numbers(turn);
  const auto any = [&numbers] { return 2.0 * static_cast<double>(numbers()) / 4294967295.0 - 1.0; };
  Scene s("cube");
  const auto material = s.elastic(density, young, 0.3);
  const auto plate = s.part(s.shell_property(0.002), material);
  const auto below = s.shells(plate, 6, 6, [](double u, double v) { return Vec3{0.12 * u - 0.0617, 0.12 * v - 0.06, 0}; });
  if (lower == Lower::clamped) s.fix(below, {true, true, true}, {true, true, true});
  if (lower == Lower::rigid) s.rigid_body(below, {-0.0017, 0, 0});
  const double ex = 0.5 * any(), ey = 0.5 * any(), aside = any();
  const Vec3 e3 = normalized(Vec3{ex, ey, 1.0}), e1 = normalized(cross(Vec3{aside, 1, 0}, e3)), e2 = cross(e3, e1);
  const auto turned = [&](const Vec3& p) { return p.x * e1 + p.y * e2 + p.z * e3; };
  auto block = s.block(s.part(s.solid_property(), material), {0, 0, 0}, {0.03, 0.03, 0.03}, {2, 2, 2}, turned);
  double lowest = 1.0;
  for (const Index n : block.nodes) lowest = std::min(lowest, s.model.node_x[static_cast<std::size_t>(n)].z);
  Vec3 centre{};
  for (const Index n : block.nodes) {
    s.model.node_x[static_cast<std::size_t>(n)].z += 2e-3 - lowest;
    centre += s.model.node_x[static_cast<std::size_t>(n)] / static_cast<double>(block.nodes.size());
  }
  const Vec3 falls{0, 0, -2.0 + any()};
  s.velocity(block.nodes, falls);
  s.velocity({s.rigid_body(block.nodes, centre)}, falls);
  s.contact(s.shell_surface(plate), s.surface(block, 2, false), 0.2, 0.0, 0.001);
  s.end(3e-3, 0.0, scale);
  return s.model;
}

/// A plate of 3 by 3 shells falls on a clamped one whose nodes are not in contact themselves: IBC may release no node of it.
/// @param type  3, 5 or 7. TYPE3: the clamped plate is one large shell, so none of its nodes is over the other plate.
/// @param met  its nodes lie under those of the other plate; of TYPE5 they are the contact nodes
model::Model with_ibc(int type, double speed, double height, bool met = false) {
  Scene s("ibc");
  const auto material = s.elastic(density, young, 0.3);
  const auto a = s.part(s.shell_property(0.001), material), b = s.part(s.shell_property(0.002), material);
  const bool large = type == 3 && !met;
  const int cells = large ? 1 : 3;
  const double wide = large ? 0.02 : 0.006, shift = large ? 0.0058 : 0.0;
  const auto below = s.shells(a, cells, cells, [wide](double u, double v) { return Vec3{wide * u, wide * v, 0}; });
  const auto above = s.shells(
      b, 3, 3,
      [=](double u, double v) {
        return Vec3{shift + 0.006 * u, shift + 0.006 * v, height};
      },
      true);
  s.velocity(above, {0, 0, -speed});
  s.fix(below, {true, true, true}, {true, true, true});
  const Index lower = s.shell_surface(a), upper = s.shell_surface(b);
  model::Interface& i = s.model.interfaces[static_cast<std::size_t>(s.contact(lower, upper, type == 7 ? 1.0 : 0.2, 0.0, 5e-4))];
  i.ibc = {false, false, true};
  model::InterfaceType5 five;
  model::InterfaceType7 seven;
  five.nodes = seven.nodes = above;
  five.surface = seven.surface = lower;
  seven.istf = 4;
  seven.gap_given = true;
  if (met) {
    five.nodes = below;
    five.surface = upper;
  }
  if (type == 5) i.type = five;
  if (type == 7) i.type = seven;
  s.end(1e-3 / speed, 0.0, 0.9);
  return s.model;
}

/// @return largest and last |CX| over the largest energy
std::pair<double, double> made(const model::Model& m, const char* name, double scale) {
  Recorder r;
  const auto report = abut::cycle::run(m, {}, r);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << name << ": " << report.outcome.message;
  double largest = 0.0, last = 0.0;
  Index touched = 0;
  for (const auto& sample : r.samples) {
    last = std::abs(sample.balance.cx) / sample.balance.largest;
    largest = std::max(largest, last);
    touched = std::max(touched, sample.interfaces[0].in_contact);
  }
  EXPECT_GT(touched, 0) << name;
  EXPECT_EQ(r.samples.back().interfaces[0].in_contact, 0) << name << ": still in contact";
  std::printf("[found] rebound, %s, scale %.1f: |CX| %.3f %% at most, %.3f %% at the end\n", name, scale, 100 * largest, 100 * last);
  return {largest, last};
}

// Issue 3, 2: |CX| after separation at most 0.2 % of the largest energy, during contact at most 1 %, at any step. Rigid plates that land
// flat, where nothing but the contact's own springs holds the step and all of them push one body: 1 % after separation too, 0.2 % at a
// third of the stable step.
TEST(EffectiveMass, ReboundsKeepTheirEnergy) {
  struct Case {
    const char* name;
    Lower lower;
    bool rigid_upper;
  };
  for (const Case& c : {Case{"plate on a clamped one", Lower::clamped, false}, Case{"plate on one that slides", Lower::sliding, false},
                        Case{"rigid plate on a clamped one", Lower::clamped, true}, Case{"plate on a rigid one", Lower::rigid, false},
                        Case{"rigid plate on a rigid one", Lower::rigid, true}}) {
    for (const double scale : {0.9, 0.6, 0.3}) {
      const auto [largest, last] = made(plates(c.lower, c.rigid_upper, scale), c.name, scale);
      EXPECT_LT(largest, 0.01) << c.name;
      EXPECT_LT(last, c.rigid_upper && scale > 0.3 ? 0.01 : 0.002) << c.name;
    }
  }
}

// IBC releases nodes that are in contact themselves, not those of the facets they press on. When these counted as free, too, a clamped
// plate of TYPE7 made up to 5.7 % of the largest energy, one of TYPE5 0.30 %.
TEST(EffectiveMass, ClampedCornersStayClampedUnderIbc) {
  for (const int type : {3, 5, 7}) {
    double worst = 0.0;
    for (const double speed : {1.0, 3.0, 10.0}) {
      for (const double height : {6e-4, 6.1e-4, 6.3e-4}) {
        Recorder r;
        const auto report = abut::cycle::run(with_ibc(type, speed, height), {}, r);
        ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
        Index touched = 0;
        for (const auto& sample : r.samples) {
          worst = std::max(worst, std::abs(sample.balance.cx) / sample.balance.largest);
          touched = std::max(touched, sample.interfaces[0].in_contact);
        }
        EXPECT_GT(touched, 0);
      }
    }
    std::printf("[found] IBC over a clamped plate, TYPE%d: |CX| %.4f %% at most\n", type, 100 * worst);
    EXPECT_LT(worst, type == 7 ? 0.0025 : 0.0005) << type;
  }
}

// A held node that contact has released moves, and stops at once when its condition comes back: the work of that jump is external.
TEST(EffectiveMass, ConditionsThatComeBackAreExternalWork) {
  for (const int type : {3, 5}) {
    double worst = 0.0, work = 0.0;
    for (const double height : {6e-4, 6.1e-4, 6.3e-4}) {
      Recorder r;
      const auto report = abut::cycle::run(with_ibc(type, 3.0, height, true), {}, r);
      ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
      for (const auto& sample : r.samples) {
        worst = std::max(worst, std::abs(sample.balance.err));
        work = std::max(work, std::abs(sample.balance.extw) / sample.balance.largest);
      }
    }
    std::printf("[found] conditions that come back, TYPE%d: |ERR| %.3f %% at most, EXTW up to %.2g of the energy\n", type, 100 * worst,
                work);
    EXPECT_GT(work, 0.01);
    EXPECT_LT(worst, 0.01) << type;
  }
}

// The first forces are made before any spring of a body is known. What they did is by the springs that are known a step later; by those of
// their own time the bodies lost a fifth of the energy.
TEST(EffectiveMass, RigidPlatesThatStartWithinTheGap) {
  for (const double scale : {0.9, 0.6, 0.3}) {
    const auto [largest, last] = made(within_the_gap(scale), "rigid plates within the gap", scale);
    EXPECT_LT(last, scale > 0.6 ? 0.05 : 0.002) << scale;
  }
}

// Few nodes of a body meet a face, one after the other, each in a few steps: the contact alone holds the step. With the springs of two
// passes counted twice the median was 5.6 % on the clamped plate and 2.6 % on the rigid one, at 0.3 of the step 0.2 %.
TEST(EffectiveMass, CubesOnTheirCorners) {
  for (const Lower lower : {Lower::clamped, Lower::rigid}) {
    for (const double scale : {0.9, 0.6, 0.3}) {
      std::vector<double> all;
      for (unsigned turn = 1; turn <= 40; ++turn) {
        Recorder r;
        const auto report = abut::cycle::run(cube(lower, turn, scale), {}, r);
        ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
        Index touched = 0;
        for (const auto& sample : r.samples) touched = std::max(touched, sample.interfaces[0].in_contact);
        EXPECT_GT(touched, 0) << turn;
        all.push_back(r.samples.back().balance.cx / r.samples.back().balance.largest);
      }
      std::sort(all.begin(), all.end());
      std::printf("[found] rigid cubes on their corners, %s plate, scale %.1f: CX %.3f %% to %.3f %%, median %.3f %%\n",
                  lower == Lower::clamped ? "clamped" : "rigid", scale, 100 * all.front(), 100 * all.back(), 100 * all[all.size() / 2]);
      EXPECT_LT(std::abs(all[all.size() / 2]), 0.001);
      // The worst are nodes beside a facet that pull at some of its corners: what the body has of them is not known with its sign.
      EXPECT_LT(std::max(all[35], -all[4]), scale > 0.6 ? 0.02 : scale > 0.3 ? 0.006 : 0.005) << "nine of ten";
      EXPECT_LT(all.back(), scale > 0.6 ? 0.12 : scale > 0.3 ? 0.035 : 0.007) << "made";
      EXPECT_GT(all.front(), scale > 0.6 ? -0.02 : -0.006) << "lost";
    }
  }
}

}  // namespace
