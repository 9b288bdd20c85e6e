// The watch over the contacts while a run goes on: T32 (a deformation) and T33 (rotation) make normals point the same way; the
// user is told when and where. The motion is prescribed, so that nothing but the watch is tested.
#include "output/contact_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "cycle/contact_facing.hpp"
#include "support/scene.hpp"

namespace abut::output {
namespace {

/// A plate of shells over another one, normals facing, 0.1 apart; the upper one is moved by the test. 800 cycles to a unit of time.
class Watched : public testing::Test {
 protected:
  static constexpr int cells = 4;
  static constexpr double distance = 0.1, end = 30.0;

  Watched() : scene_("watch") {
    const Index material = scene_.elastic(1.0, 1.0, 0.0), property = scene_.shell_property(0.01);
    const Index lower = scene_.part(property, material), upper = scene_.part(property, material);
    scene_.shells(lower, cells, cells, [](double u, double v) { return Vec3{2.0 * u - 1.0, 2.0 * v - 1.0, 0.0}; });
    for (int strip = 0; strip < cells; ++strip) {  // four strips side by side that share no nodes
      const double width = 2.0 / cells, left = strip * width - 1.0;
      const auto nodes = scene_.shells(
          upper, 1, cells,
          [&](double u, double v) {
            return Vec3{left + width * u, 2.0 * v - 1.0, distance};
          },
          true);
      upper_.insert(upper_.end(), nodes.begin(), nodes.end());
      middle_.insert(middle_.end(), nodes.size(), left + 0.5 * width);
    }
    scene_.contact(scene_.shell_surface(lower), scene_.shell_surface(upper), 0.2, 0.0, 0.2);
    scene_.end(end);
    state_.x = scene_.model.node_x;
    interfaces_.resize(1);
  }

  /// Moves the upper plate's nodes to place(X, x of the middle of the node's strip, tau), tau from 0 to 1 over the run.
  const RunFindings& run(const std::function<Vec3(Vec3, double, double)>& place) {
    constexpr int cycles = 24000;
    ContactWatch watch(log_);
    cycle::ContactFacing facing(scene_.model, {});
    facing.look(state_, interfaces_);
    cycle::Snapshot now;
    now.model = &scene_.model;
    now.state = &state_;
    now.balance = &balance_;
    now.interfaces = interfaces_;
    watch.begin(now);
    for (int n = 0; n <= cycles; ++n) {
      const double tau = static_cast<double>(n) / cycles;
      for (std::size_t k = 0; k < upper_.size(); ++k) {
        const auto i = static_cast<std::size_t>(upper_[k]);
        state_.x[i] = place(scene_.model.node_x[i], middle_[k], tau);
      }
      state_.times.t = tau * end;
      state_.times.cycle = n;
      facing.look(state_, interfaces_);
      watch.cycle(now);
    }
    return *log_;
  }

  scenes::Scene scene_;
  std::vector<Index> upper_;
  std::vector<double> middle_;
  state::State state_;
  state::Balance balance_;
  std::vector<cycle::InterfaceResult> interfaces_;
  std::shared_ptr<RunFindings> log_ = std::make_shared<RunFindings>();
};

Vec3 turned(const Vec3& x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), z = x.z - 0.1;
  return {c * x.x + s * z, x.y, 0.1 - s * x.x + c * z};
}

void expect_turned_away(const RunFindings& found, Id interface, double from, double to) {
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].diagnostic.code, "contact.turned_away");
  EXPECT_EQ(found[0].diagnostic.severity, Severity::warning);
  EXPECT_EQ(found[0].interface_id, interface);
  EXPECT_GT(found[0].time, from);
  EXPECT_LT(found[0].time, to);
  EXPECT_LT(found[0].measure, 0.5);
}

// T33: the plate turns over as a whole, about a line in its plane; its normals look up from half a turn of 180 degrees on.
TEST_F(Watched, APlateThatTurnsOverIsToldOnce) {
  const RunFindings& found = run([](Vec3 x, double, double tau) { return turned(x, std::numbers::pi * tau); });
  expect_turned_away(found, scene_.model.interfaces[0].id, 0.5 * end, 0.75 * end);
}

// T32: the strips turn each about its own line, as the slats of a blind do: the surface deforms, nothing moves as a whole.
TEST_F(Watched, ADeformationThatTurnsTheNormalsIsTold) {
  const RunFindings& found = run([](Vec3 x, double middle, double tau) {
    return Vec3{middle, 0, 0} + turned({x.x - middle, x.y, x.z}, std::numbers::pi * tau);
  });
  expect_turned_away(found, scene_.model.interfaces[0].id, 0.5 * end, 0.75 * end);
}

// T31, T33: at Tstart the plate is behind the other one and 240 cycles later far away; when it is looked at again there is nothing to see.
TEST_F(Watched, SurfacesThatHavePassedEachOtherAtTstartAreToldThen) {
  const auto through = [](Vec3 x, double, double tau) {
    return Vec3{x.x, x.y, x.z - 0.01 * 24000.0 * std::max(0.0, tau - (0.5 - 40.0 / 24000.0))};
  };
  scene_.model.interfaces[0].t_start = 0.5 * end;
  state_.times.h_minus = end / 24000.0;
  const RunFindings& found = run(through);
  ASSERT_EQ(found.size(), 2u);  // both surfaces
  for (const RunFinding& f : found) expect_turned_away({f}, scene_.model.interfaces[0].id, 0.499 * end, 0.501 * end);
}

// Twins: a plate that turns in its own plane, or tilts and comes back, goes on facing the other; a plate in contact is felt.
TEST_F(Watched, MotionsThatLeaveTheNormalsFacingAreNotReported) {
  EXPECT_TRUE(run([](Vec3 x, double, double tau) {
                const double a = 2.0 * std::numbers::pi * tau;
                return Vec3{std::cos(a) * x.x - std::sin(a) * x.y, std::sin(a) * x.x + std::cos(a) * x.y, x.z};
              }).empty());
  EXPECT_TRUE(run([](Vec3 x, double, double tau) { return turned(x, 0.05 * std::sin(2.0 * std::numbers::pi * tau)); }).empty());
  interfaces_[0].in_contact = 1;
  EXPECT_TRUE(run([](Vec3 x, double, double tau) { return turned(x, std::numbers::pi * tau); }).empty());
}

// The inspection before the run has looked already: what it found stands for the first look, and no later one differs.
TEST_F(Watched, WhatTheInspectionFoundStandsForTheFirstLook) {
  init::FacingShares found;
  (void)init::inspect_contacts(scene_.model, {}, {}, &found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], (std::array{1.0, 1.0}));
  cycle::ContactFacing own(scene_.model, {}), told(scene_.model, found);
  std::vector<cycle::InterfaceResult> by_own(1), by_told(1);
  int turned_away = 0;
  for (int n = 0; n <= 3000; ++n) {
    const double tau = n / 3000.0;
    for (const Index node : upper_) {
      const auto i = static_cast<std::size_t>(node);
      state_.x[i] = turned(scene_.model.node_x[i], std::numbers::pi * tau);
    }
    state_.times.t = tau * end;
    state_.times.cycle = n;
    own.look(state_, by_own);
    told.look(state_, by_told);
    ASSERT_EQ(by_own[0].facing, by_told[0].facing) << n;
    turned_away += by_own[0].facing[1] < 0.5 ? 1 : 0;
  }
  EXPECT_GT(turned_away, 100);
}

// It is of the start, where nothing touches: anywhere else the run looks itself.
TEST_F(Watched, WhatTheInspectionFoundIsOfTheStartOnly) {
  const init::FacingShares wrong{{0.25, 0.125}};
  const auto first_look = [&] {
    cycle::ContactFacing facing(scene_.model, wrong);
    facing.look(state_, interfaces_);
    return interfaces_[0].facing;
  };
  EXPECT_EQ(first_look(), wrong[0]);
  interfaces_[0].in_contact = 1;
  EXPECT_EQ(first_look(), (std::array{1.0, 1.0}));
  interfaces_[0].in_contact = 0;
  state_.x[static_cast<std::size_t>(upper_[0])].z += 1e-3;
  EXPECT_EQ(first_look(), (std::array{1.0, 1.0}));
}

// A run that was loaded, and saved again before it went on, says of the start what the run said that was saved. One that was saved before
// its first cycle looks at it in its first cycle.
TEST_F(Watched, TheStartIsThatOfTheRunHoweverOftenItIsSaved) {
  cycle::Snapshot now;
  now.model = &scene_.model;
  now.state = &state_;
  now.balance = &balance_;
  now.interfaces = interfaces_;
  state::Archive before, first, second;
  ContactWatch unbegun(log_);
  unbegun.persist(before);
  ContactWatch whole(log_);
  state::Archive from_before(before.bytes());
  whole.persist(from_before);
  interfaces_[0].facing = {1.0, 1.0};
  whole.begin(now);
  whole.persist(first);
  const auto loaded_log = std::make_shared<RunFindings>();
  ContactWatch loaded(loaded_log);
  state::Archive from_first(first.bytes());
  loaded.persist(from_first);
  loaded.persist(second);
  interfaces_[0].facing = {0.75, 0.75};
  loaded.begin(now);
  ContactWatch again(log_);
  state::Archive from_second(second.bytes());
  again.persist(from_second);
  again.begin(now);
  interfaces_[0].facing = {0.0, 0.0};
  for (const Index n : upper_) {
    state_.x[static_cast<std::size_t>(n)] = turned(scene_.model.node_x[static_cast<std::size_t>(n)], std::numbers::pi);
  }
  loaded.cycle(now);
  again.cycle(now);
  for (const auto& found : {loaded_log, log_}) {
    ASSERT_EQ(found->size(), 1u);
    EXPECT_NE((*found)[0].diagnostic.message.find("(at the start 100 %)"), std::string::npos) << (*found)[0].diagnostic.message;
  }
}

/// Nodes that cross or get lost in different cycles are one finding: distinct nodes, from the first time on.
TEST_F(Watched, NodesLostAndCrossedAreCountedOverTheRun) {
  ContactWatch watch(log_);
  cycle::Snapshot now;
  now.model = &scene_.model;
  now.state = &state_;
  now.balance = &balance_;
  now.interfaces = interfaces_;
  watch.begin(now);
  const std::vector<std::vector<Index>> crossed{{}, {3}, {1, 3}, {}, {2}, {1}};
  for (std::size_t n = 0; n < crossed.size(); ++n) {
    interfaces_[0].crossed = crossed[n];
    if (n == 4) interfaces_[0].lost = crossed[2];
    now.interfaces = interfaces_;
    state_.times.t = 0.1 * static_cast<double>(n);
    state_.times.cycle = static_cast<std::int64_t>(n);
    watch.cycle(now);
  }
  ASSERT_EQ(log_->size(), 2u);
  const RunFinding& all = (*log_)[0];
  EXPECT_EQ(all.diagnostic.code, "contact.crossed");
  EXPECT_EQ(all.cycle, 1);
  EXPECT_EQ(all.measure, 3.0);
  std::vector<Id> expected;
  for (const Index node : {1, 2, 3}) expected.push_back(scene_.model.node_id[static_cast<std::size_t>(node)]);
  EXPECT_EQ(all.nodes, expected);
  EXPECT_EQ(all.diagnostic.message.find("from time 0.1 (cycle 1) on: 3 nodes"), 0u) << all.diagnostic.message;
  EXPECT_EQ((*log_)[1].diagnostic.code, "contact.lost_over_border");
  EXPECT_EQ((*log_)[1].measure, 2.0);
}

}  // namespace
}  // namespace abut::output
