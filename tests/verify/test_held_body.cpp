// A rigid pendulum, held at a main node beside its centre of gravity, strikes an elastic block through TYPE3 (T17, T25): the step, the
// contact and the ledger know what is held. docs/theory/constraints.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;

// It comes back; what it has lost is in the block, no force of the support does work, and the pivot stays where it is. Held in three
// directions, and as a hinge.
TEST(HeldBody, StrikesABlockAndKeepsTheBalance) {
  for (const bool hinge : {false, true}) {
    Scene scene("pendulum");
    const auto material = scene.elastic(7800.0, 210e6, 0.3);
    const auto property = scene.solid_property();
    const auto hammer = scene.block(scene.part(property, material), {0.021, 0, -0.1}, {0.02, 0.02, 0.1}, {2, 2, 5});
    const auto anvil = scene.block(scene.part(property, material), {0, -0.01, -0.12}, {0.02, 0.04, 0.04}, {2, 4, 4});
    abut::model::RigidBody body;
    body.id = 1;
    body.icog = 3;
    body.ispher = 3;
    body.main = scene.node({0.031, 0.01, 0.02});
    body.nodes = hammer.nodes;
    scene.model.rigid_bodies.push_back(body);
    scene.fix({body.main}, {true, true, true}, {hinge, false, hinge});
    scene.fix(anvil.plane(0, false), {true, true, true});
    scene.model.initial_velocities.push_back({1, true, {0, 20.0, 0}, {body.main}});
    scene.contact(scene.surface(anvil, 0, true), scene.surface(hammer, 0, false));
    scene.end(0.004);
    Recorder recorder({body.main, hammer.at(0, 0, 0)});
    const auto report = abut::cycle::run(scene.model, {}, recorder);
    ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
    double error = 0.0, ledger = 0.0;
    abut::Index touching = 0;
    for (const auto& sample : recorder.samples) {
      error = std::max(error, std::fabs(sample.balance.err));
      ledger = std::max(ledger, std::fabs(sample.balance.ledger));
      touching = std::max(touching, sample.interfaces[0].in_contact);
    }
    const auto& first = recorder.samples.front();
    const auto& last = recorder.samples.back();
    const double start = first.balance.ke + first.balance.ker;
    std::printf("[found] rigid pendulum, %s: ERR %.1e, LEDGER %.0e, kinetic energy %.4f to %.4f, work of the support %.0e\n",
                hinge ? "hinge" : "ball joint", error, ledger, start, last.balance.ke + last.balance.ker, last.balance.extw);
    EXPECT_GT(touching, 0);
    EXPECT_EQ(last.interfaces[0].in_contact, 0);
    EXPECT_GT(last.v[1].x, 0.0);
    EXPECT_LT(error, 0.005);
    EXPECT_LT(ledger, 1e-12);
    EXPECT_LT(std::fabs(last.balance.extw), 1e-12 * start);
    EXPECT_LT(norm(last.u[0]), 1e-14);
  }
}

}  // namespace
