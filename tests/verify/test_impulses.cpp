// The time integrals of forces of interfaces, rigid bodies and sections (IF of the history) are the momentum that the forces gave, to
// rounding and in every cycle, also where steps vary. docs/guide/outputs.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "cycle/run.hpp"
#include "cycle/sink.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Scene;
namespace cycle = abut::cycle;

/// Momentum that groups of nodes gained since the first cycle, after the kick of each cycle, against the impulses of that cycle.
class Momentum final : public cycle::Sink {
 public:
  Momentum(std::vector<Index> body, std::vector<Index> beyond) : body_(std::move(body)), beyond_(std::move(beyond)) {}

  void begin(const cycle::Snapshot& first) override {
    body_at_start_ = of(body_, first, 0.0);
    beyond_at_start_ = of(beyond_, first, 0.0);
  }
  void cycle(const cycle::Snapshot& now) override {
    const double h = now.state->times.h_bar;
    const Vec3 body = of(body_, now, h) - body_at_start_, beyond = of(beyond_, now, h) - beyond_at_start_;
    const auto& rigid = now.bodies[0];
    const auto& cut = now.sections[0];
    const auto& contact = now.interfaces[0];
    const Vec3 pressed = contact.normal_impulse + contact.tangential_impulse;
    largest = std::max(largest, norm(body));
    worst_body = std::max(worst_body, norm(rigid.force_impulse - body));
    worst_section = std::max(worst_section, norm(cut.normal_impulse + cut.tangential_impulse - beyond));
    worst_interface = std::max(worst_interface, norm(pressed - body));
    const double step = now.state->times.h_plus;
    shortest = std::min(shortest, step);
    if (now.state->times.cycle > 0) longest = std::max(longest, step);
  }
  void end(const cycle::Outcome& outcome) override { this->outcome = outcome; }

  double largest = 0.0, worst_body = 0.0, worst_section = 0.0, worst_interface = 0.0, shortest = 1.0, longest = 0.0;
  cycle::Outcome outcome;

 private:
  static Vec3 of(const std::vector<Index>& nodes, const cycle::Snapshot& now, double h) {
    Vec3 sum{};
    for (const Index node : nodes) {
      const auto i = static_cast<std::size_t>(node);
      sum += now.state->mass[i] * (now.state->v[i] + h * now.state->a[i]);
    }
    return sum;
  }

  std::vector<Index> body_, beyond_;
  Vec3 body_at_start_, beyond_at_start_;
};

// A rigid block strikes a free elastic one beside its middle and slides along it. What lies beyond the section in the struck block gets its
// momentum through the section alone.
TEST(Impulses, AreTheMomentumThatForcesGave) {
  Scene scene("impulses");
  const auto property = scene.solid_property();
  const auto hammer = scene.block(scene.part(property, scene.elastic(7800.0, 210e6, 0.3)), {0.004, 0, 0}, {0.01, 0.01, 0.01}, {2, 2, 2});
  const auto anvil = scene.block(scene.part(property, scene.elastic(2700.0, 70e6, 0.3)), {0, 0, -0.0201}, {0.02, 0.01, 0.02}, {4, 2, 4});
  const Index main = scene.rigid_body(hammer.nodes, {0.009, 0.005, 0.005});
  std::vector<Index> moving = hammer.nodes;
  moving.push_back(main);
  scene.velocity(moving, {3.0, 0, -20.0});
  (void)scene.contact(scene.surface(anvil, 2, true), scene.surface(hammer, 2, false), 0.2, 0.2);

  abut::model::Section section;
  section.id = 1;
  section.iframe = 10;
  std::vector<Index> beyond;
  for (Index k = 0; k <= 2; ++k) {
    for (Index j = 0; j <= 2; ++j) {
      for (Index i = 0; i <= 4; ++i) {
        beyond.push_back(anvil.at(i, j, k));
        if (k == 2) section.nodes.push_back(anvil.at(i, j, k));
      }
    }
  }
  const Index before_anvil = 2 * 2 * 2;
  for (Index e = 0; e < 4 * 2 * 2; ++e) section.bricks.push_back(before_anvil + 4 * 2 * 2 + e);  // the upper half
  section.frame_nodes = {anvil.at(0, 0, 2), anvil.at(4, 0, 2), anvil.at(0, 2, 2)};
  scene.model.sections.push_back(section);
  scene.end(1e-4);

  Momentum found({main}, beyond);
  (void)cycle::run(scene.model, {}, found);
  ASSERT_EQ(found.outcome.kind, cycle::Outcome::Kind::finished) << found.outcome.message;
  std::printf(
      "[found] impulses less momentum, of the largest: rigid body %.0e, section %.0e, interface %.0e; longest step %.2f times the "
      "shortest\n",
      found.worst_body / found.largest, found.worst_section / found.largest, found.worst_interface / found.largest,
      found.longest / found.shortest);
  EXPECT_GT(found.longest, 1.05 * found.shortest);
  EXPECT_LT(found.worst_body, 1e-12 * found.largest);
  EXPECT_LT(found.worst_section, 1e-12 * found.largest);
  EXPECT_LT(found.worst_interface, 1e-12 * found.largest);
}

}  // namespace
