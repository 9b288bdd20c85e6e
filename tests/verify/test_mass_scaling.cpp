// /DT/NODA/CST (numerics.md 2.3): m <- 1.00001 K/2 (dt_min/s)^2 where a node's step is shorter than dt_min.
//
// Momentum: mass comes with the velocity of its node, so momentum changes by sum dm v and by nothing else; T* of the ledger by
// 1/2 dm v.v. The cycle that adds mass takes dt_min itself; at the same stiffness the next steps are sqrt(1.00001) dt_min: the factor
// keeps rounding from asking for mass in every cycle.
#include <gtest/gtest.h>

#include <cmath>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

/// A free shell plate; a light rigid body on its last corner when `with_body`.
Scene plate(bool with_body) {
  Scene s("scaling");
  const auto shell = s.part(s.shell_property(0.002), s.elastic(7800.0, 210e9, 0.3));
  const auto nodes = s.shells(shell, 4, 4, [](double u, double v) { return Vec3{0.03 * u, 0.03 * v + 0.002 * std::sin(9 * u), 0}; });
  s.velocity(nodes, {3.0, -2.0, 5.0});
  s.velocity({nodes[0], nodes[7], nodes[13]}, {3.5, -2.0, 4.0});
  if (!with_body) return s;
  model::RigidBody body;
  body.id = 1;
  body.main = s.node({0.04, 0.035, 0.006});
  body.nodes = {nodes.back()};
  body.mass = 1e-4;
  body.j_diagonal = {3e-8, 5e-8, 4e-8};
  s.model.rigid_bodies.push_back(body);
  s.velocity({body.main}, {3.0, -2.0, 9.0});
  return s;
}

double step_without_scaling(bool with_body) {
  Scene s = plate(with_body);
  s.end(1e-12);
  s.model.controls.nodal_step = true;
  s.model.controls.nodal_scale = 0.9;
  Recorder recorder;
  (void)abut::cycle::run(s.model, {}, recorder);
  return recorder.samples.front().dt;
}

TEST(MassScaling, KeepsTheStepTheMomentumAndTheLedger) {
  for (const bool with_body : {false, true}) {
    const double wanted = 1.5 * step_without_scaling(with_body);
    Scene s = plate(with_body);
    s.end(400.0 * wanted);
    s.model.controls.nodal_step = s.model.controls.mass_scaling = true;
    s.model.controls.nodal_scale = 0.9;
    s.model.controls.nodal_minimum = wanted;
    Recorder recorder;
    const auto report = abut::cycle::run(s.model, {}, recorder);
    ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
    EXPECT_EQ(recorder.samples.front().dt, wanted);
    EXPECT_NEAR(recorder.samples[1].dt, std::sqrt(1.00001) * wanted, 1e-6 * wanted);
    double added = 0.0;
    Vec3 momentum{};
    int still = 0;
    for (const auto& sample : recorder.samples) {
      const auto& b = sample.balance;
      ASSERT_LT(std::fabs(b.ledger), 1e-11) << sample.time;
      ASSERT_LT(std::fabs(b.err), 2e-3) << sample.time;
      ASSERT_GE(sample.dt, wanted);
      ASSERT_LE(sample.dt, 1.001 * wanted);  // stiffness changes a little with the shape
      if (sample.time > 0.0 && b.added_mass == added) {
        ++still;
        ASSERT_LT(norm(b.momentum - momentum), 1e-12 * b.mass * 10.0) << sample.time;
      }
      added = b.added_mass;
      momentum = b.momentum;
    }
    EXPECT_GT(still, 100);
    EXPECT_GT(added, 0.0);
    std::printf("[found] mass scaling, %s body: added mass %.4g of %.4g, %d of %d cycles without more, ERR %.2e\n",
                with_body ? "with" : "no", added, recorder.samples.back().balance.mass, still, static_cast<int>(recorder.samples.size()),
                recorder.samples.back().balance.err);
  }
}

// A clamped node cannot control a step: it gets no mass.
TEST(MassScaling, LeavesClampedNodesAlone) {
  Scene s = plate(false);
  std::vector<abut::Index> all(static_cast<std::size_t>(s.model.node_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<abut::Index>(i);
  s.model.initial_velocities.clear();
  s.fix(all, {true, true, true}, {true, true, true});
  s.end(1e-6);
  s.model.controls.nodal_step = s.model.controls.mass_scaling = true;
  s.model.controls.nodal_scale = 0.9;
  s.model.controls.nodal_minimum = 1e-5;
  Recorder recorder;
  (void)abut::cycle::run(s.model, {}, recorder);
  EXPECT_EQ(recorder.samples.back().balance.added_mass, 0.0);
}

}  // namespace
