// Animation fields of real runs against what they stand for: rates of strain of known motions, forces that add up to those of the time
// history, steps of which the smallest is the run's, and added mass that adds up to what scaling added.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cycle/run.hpp"
#include "output/animation_fields.hpp"
#include "support/scene.hpp"

namespace abut::output {
namespace {

using scenes::Scene;

/// Calls back with every state that has an animation, after the last one too.
class Watch final : public cycle::Sink {
 public:
  explicit Watch(std::function<void(const cycle::Snapshot&)> look) : look_(std::move(look)) {}
  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot& now) override {
    if (now.animation_due) look_(now);
  }
  void end(const cycle::Outcome& outcome) override { EXPECT_EQ(outcome.kind, cycle::Outcome::Kind::finished) << outcome.message; }

 private:
  std::function<void(const cycle::Snapshot&)> look_;
};

void run_watched(Scene& scene, double end, double interval, const std::function<void(const cycle::Snapshot&)>& look) {
  scene.end(end);
  scene.model.controls.animation_start = 0.0;
  scene.model.controls.animation_interval = interval;
  Watch watch(look);
  (void)cycle::run(scene.model, {}, watch);
}

NodeField node_field(const std::string& selection, const std::string& name) {
  const AnimationFields fields = select_animation_fields({selection});
  EXPECT_TRUE(fields.left_out.empty()) << selection;
  for (const NodeField& f : fields.nodes) {
    if (f.name == name) return f;
  }
  ADD_FAILURE() << name;
  return {};
}

std::vector<Vec3> vectors(const NodeField& field, const cycle::Snapshot& now) {
  std::vector<Vec3> out(now.state->x.size());
  for (std::size_t n = 0; n < out.size(); ++n) {
    double v[3];
    field.write(now, n, v);
    out[n] = {v[0], v[1], v[2]};
  }
  return out;
}

double scalar(const NodeField& field, const cycle::Snapshot& now, std::size_t n) {
  double value = 0.0;
  field.write(now, n, &value);
  return value;
}

double strain_rate(const cycle::Snapshot& now, std::size_t group, Index element) {
  const AnimationFields fields = select_animation_fields({"ELEM/EPSD"});
  EXPECT_EQ(fields.cells.back().name, "strain_rate");
  const elements::Group& g = *now.groups[group];
  double value = 0.0;
  fields.cells.back().write({g.output(element), g.element_mass(element), &g, element, now.state}, &value);
  return value;
}

// v = L x in a distorted brick, a tetrahedron, a quadrilateral and a triangle in the plane z = 0: e' of isochoric stretching is its rate,
// of simple shear gamma / sqrt(3), of a rotation 0. Shells that bend at a rate k without stretching: t k / 3 with k about one axis.
TEST(AnimationValues, StrainRateOfKnownMotions) {
  struct Case {
    std::function<Vec3(const Vec3&)> v;
    double expected;
  };
  const std::vector<Case> cases{{[](const Vec3& x) {
                                   return Vec3{3.0 * x.x, -1.5 * x.y, -1.5 * x.z};
                                 },
                                 3.0},
                                {[](const Vec3& x) {
                                   return Vec3{2.0 * x.y, 0, 0};
                                 },
                                 2.0 / std::sqrt(3.0)},
                                {[](const Vec3& x) {
                                   return cross(Vec3{0.4, -0.7, 1.1}, x);
                                 },
                                 0.0}};
  for (const Case& c : cases) {
    Scene s("rates");
    const Index material = s.elastic(1.0, 100.0, 0.3);
    const Index solid = s.part(s.solid_property(), material);
    const Index shell = s.part(s.shell_property(0.1), material);
    s.block(solid, {0.3, 0.2, -0.1}, {1, 1, 1}, {1, 1, 1}, [](const Vec3& p) { return p + Vec3{0.1 * p.y * p.z, 0.05 * p.x, 0.07 * p.y}; });
    s.model.tetras.id.push_back(9);
    s.model.tetras.part.push_back(solid);
    s.model.tetras.nodes.push_back({s.node({2, 0, 0}), s.node({3, 0, 0.1}), s.node({2, 1, 0}), s.node({2.2, 0.1, 1})});
    s.shells(shell, 1, 1, [](double u, double v) { return Vec3{u + 0.1 * v, v + 0.2 * u * v, 0}; });
    s.model.sh3ns.id.push_back(8);
    s.model.sh3ns.part.push_back(shell);
    s.model.sh3ns.thickness.push_back(0.0);
    s.model.sh3ns.nodes.push_back({s.node({4, 0, 0}), s.node({5, 0.1, 0}), s.node({4.2, 1, 0})});
    for (Index n = 0; n < s.model.node_count(); ++n) s.velocity({n}, c.v(s.model.node_x[static_cast<std::size_t>(n)]));
    std::size_t seen = 0;
    run_watched(s, 1e-9, 1.0, [&](const cycle::Snapshot& now) {
      for (std::size_t g = 0; g < now.groups.size(); ++g) {
        if (now.groups[g]->size() == 0) continue;
        EXPECT_NEAR(strain_rate(now, g, 0), c.expected, 1e-13) << g;
        ++seen;
      }
    });
    EXPECT_EQ(seen, 4u);
  }
  Scene s("bending");
  const Index shell = s.part(s.shell_property(0.3), s.elastic(1.0, 100.0, 0.3));
  const auto nodes = s.shells(shell, 1, 1, [](double u, double v) { return Vec3{2 * u, v, 0}; });
  s.velocity(nodes, {0, 0, 1});
  run_watched(s, 1e-9, 1.0, [&](const cycle::Snapshot& now) {
    state::State turned = *now.state;
    for (std::size_t n = 0; n < turned.w.size(); ++n) turned.w[n] = {0, 0.7 * turned.x[n].x, 0};
    cycle::Snapshot bent = now;
    bent.state = &turned;
    EXPECT_NEAR(strain_rate(bent, 0, 0), 0.3 * 0.7 / 3.0, 1e-14);
  });
}

// A rigid block with a wall under it, on a bar with a section: at every state the field's sums are the options' own results.
TEST(AnimationValues, ForcesOfBodiesWallsAndSections) {
  Scene s("options");
  const Index part = s.part(s.solid_property(), s.elastic(1.0, 1000.0, 0.0));
  const auto bar = s.block(part, {0, 0, 0}, {1, 1, 4}, {1, 1, 4});
  s.velocity(bar.nodes, {0, 0, -1.0});
  model::RigidBody body;
  body.id = 1;
  body.main = s.node({0.5, 0.5, 4.5});
  body.nodes = bar.plane(2, true);
  s.model.rigid_bodies.push_back(body);
  s.velocity({body.main}, {0, 0, -1.0});
  model::RigidWall wall;
  wall.id = 1;
  wall.normal = {0, 0, 1};
  wall.nodes = bar.plane(2, false);
  s.model.rigid_walls.push_back(wall);
  model::Section section;
  section.id = 1;
  section.frame_nodes = {bar.at(0, 0, 2), bar.at(1, 0, 2), bar.at(0, 1, 2)};
  section.nodes = {bar.at(0, 0, 2), bar.at(1, 0, 2), bar.at(0, 1, 2), bar.at(1, 1, 2)};
  section.bricks = {2, 3};
  s.model.sections.push_back(section);
  const NodeField force = node_field("VECT/FOPT", "option_force"), moment = node_field("VECT/FOPT", "option_moment");
  int states = 0;
  double largest = 0.0;
  run_watched(s, 0.2, 0.01, [&](const cycle::Snapshot& now) {
    const auto f = vectors(force, now), m = vectors(moment, now);
    const auto at = [](Index n) { return static_cast<std::size_t>(n); };
    EXPECT_EQ(f[at(body.main)], now.bodies[0].force);
    EXPECT_EQ(m[at(body.main)], now.bodies[0].moment);
    Vec3 on_wall{};
    for (const Index n : wall.nodes) on_wall += f[at(n)];
    EXPECT_LT(norm(on_wall - now.walls[0].normal_force), 1e-12 * (1.0 + norm(on_wall)));
    const auto& q = now.sections[0];
    EXPECT_EQ(f[at(section.frame_nodes[0])], q.normal_force + q.tangential_force);
    // The section's moment is about its first node, along its axes: x', z' = global ones here, so is y'.
    EXPECT_LT(norm(m[at(section.frame_nodes[0])] - q.moment), 1e-12 * (1.0 + norm(q.moment)));
    Vec3 all{};
    for (const Vec3& each : f) all += each;
    EXPECT_LT(norm(all - on_wall - now.bodies[0].force - q.normal_force - q.tangential_force), 1e-12 * (1.0 + norm(all)));
    largest = std::max(largest, norm(now.bodies[0].force));
    ++states;
  });
  EXPECT_GT(states, 10);
  EXPECT_GT(largest, 1.0);  // sqrt(E rho) v A = 32
}

// Where nodes give the step, the smallest value of the field is the step that the run takes.
TEST(AnimationValues, TheSmallestNodalStepIsTheRuns) {
  Scene s("step");
  const Index material = s.elastic(1.0, 1000.0, 0.3);
  s.block(s.part(s.solid_property(), material), {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, [](const Vec3& p) { return p + Vec3{0.1 * p.y, 0, 0}; });
  s.shells(s.part(s.shell_property(0.05), material), 2, 2, [](double u, double v) { return Vec3{3 + u, v, 0}; });
  s.node({9, 9, 9});
  const NodeField step = node_field("NODA/DT", "nodal_step");
  int states = 0;
  run_watched(s, 0.1, 0.01, [&](const cycle::Snapshot& now) {
    double smallest = 1e30;
    for (std::size_t n = 0; n + 1 < now.state->x.size(); ++n) smallest = std::min(smallest, scalar(step, now, n));
    EXPECT_NEAR(smallest, now.state->times.h_plus, 1e-14 * smallest);
    EXPECT_TRUE(std::isnan(scalar(step, now, now.state->x.size() - 1)));  // a node without stiffness limits nothing
    ++states;
  });
  EXPECT_GT(states, 5);
}

// Mass that scaling adds, over the mass without it: sums to what was added, and brings the nodes to the wanted step.
TEST(AnimationValues, AddedMassAddsUp) {
  Scene s("scaled");
  const Index part = s.part(s.solid_property(), s.elastic(1.0, 1000.0, 0.3));
  s.block(part, {0, 0, 0}, {3, 1, 1}, {3, 1, 1}, [](const Vec3& p) { return p.x > 2.5 ? Vec3{2.3, p.y, p.z} : p; });
  s.model.controls.nodal_step = s.model.controls.mass_scaling = true;
  s.model.controls.nodal_scale = 0.9;
  s.model.controls.nodal_minimum = 0.012;
  const NodeField ratio = node_field("NODA/DMAS", "added_mass_ratio"), step = node_field("NODA/DT", "nodal_step");
  run_watched(s, 0.1, 0.02, [&](const cycle::Snapshot& now) {
    double added = 0.0;
    int heavier = 0;
    for (std::size_t n = 0; n < now.state->x.size(); ++n) {
      const double r = scalar(ratio, now, n);
      added += now.state->mass[n] * r / (1.0 + r);
      heavier += r > 0.0 ? 1 : 0;
      EXPECT_GE(scalar(step, now, n), 0.012 * (1.0 - 1e-12));
    }
    EXPECT_GT(added, 0.0);
    EXPECT_GT(heavier, 0);
    EXPECT_LT(heavier, static_cast<int>(now.state->x.size()));
    EXPECT_NEAR(added, now.balance->added_mass, 1e-13);
  });
}

}  // namespace
}  // namespace abut::output
