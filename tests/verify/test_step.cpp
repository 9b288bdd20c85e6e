// The step of the assembled system against its exact limit (issue: run a real deck, 4, "effect on the time step"; T12, numerics.md 2.3).
//
// Exact: 2/omega_max of M^-1 K, K the tangent of all forces (elements and both passes of every interface) by central
// differences at the first geometry, contact active; clamped directions left out, rigid bodies reduced to their six degrees.
// Bricks also carry viscous forces (bulk and hourglass) that lag half a step: with their matrix C central differences are stable
// iff lambda_max(h^2 K + 2 h C) <= 4 M, and that is their exact limit; C with bulk viscosity in every element, which nature
// has in those under compression only. Without viscosity it is 2/omega_max, printed as well.
// Elements are hypoelastic: a displacement du is applied as the velocity du/h over a step h so long that viscous terms vanish.
// abut's step is the one that a run takes there with a scale factor of 1.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "constraints/axes.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/rigid_bodies.hpp"
#include "elements/assembly.hpp"
#include "init/contact_setup.hpp"
#include "init/start.hpp"
#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;
namespace model = abut::model;

/// All forces of a model as a function of a small displacement from its first geometry.
class Forces {
 public:
  explicit Forces(const model::Model& m)
      : groups_(abut::init::make_groups(m, {})),
        assembly_(m.node_count(), groups_),
        state(abut::init::make_state(m, groups_)),
        axes_(m),
        bodies(m),
        conditions(m, axes_, bodies),
        sums_(assembly_.sum_count(), 0.0) {
    bodies.initialise(state);
    interfaces_ = abut::init::make_interfaces(m, {}, {}, state);
    for (const auto& g : groups_) {
      std::vector<std::uint8_t> rigid;
      for (Index e = 0; e < g->size(); ++e) {
        const auto nodes = g->nodes(e);
        rigid.push_back(bodies.contains(nodes) ? 1 : 0);
      }
      g->set_rigid(rigid);
    }
    // One step at rest: the first step of a run has no strain and no history.
    zero_ = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(state.mass.size()));
    (void)at(zero_, false);
    for (auto& i : interfaces_) {
      abut::contact::HostState host{state.x, state.v, state.mass, 0.0, tiny_step, tiny_step};
      std::vector<Vec3> f(state.x.size());
      std::vector<double> k(state.x.size());
      i.contact.search(host);
      touching += i.contact.evaluate(host, f, k).in_contact;
      i.contact.commit(tiny_step);
      blobs_.push_back(i.contact.history());
    }
  }

  /// Forces and moments (6 per node) after the displacements and rotations d.
  Eigen::VectorXd at(const Eigen::VectorXd& d, bool with_contact = true) {
    const std::size_t n = state.x.size();
    std::vector<Vec3> x(n), v(n), w(n), f(n), m(n), contact(n);
    std::vector<double> k(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = 6 * static_cast<Eigen::Index>(i);
      const Vec3 u{d[at], d[at + 1], d[at + 2]};
      x[i] = fast_ ? state.x[i] : state.x[i] + u;
      v[i] = u / (fast_ ? 1.0 : slow_step);
      w[i] = Vec3{d[at + 3], d[at + 4], d[at + 5]} / (fast_ ? 1.0 : slow_step);
    }
    std::vector<std::vector<double>> saved;
    for (const auto& g : groups_) {
      for (const auto span : g->history()) saved.emplace_back(span.begin(), span.end());
      const double h = fast_ ? no_step : slow_step;
      (void)g->step({x.data(), v.data(), w.data(), h, h}, {sums_.data(), nullptr}, pool_);
    }
    std::size_t s = 0;
    for (const auto& g : groups_) {
      for (const auto span : g->history()) {
        std::copy(saved[s].begin(), saved[s].end(), span.begin());
        ++s;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const abut::elements::NodalSum sum = assembly_.total(sums_.data(), i);
      f[i] = sum.force;
      m[i] = sum.moment;
      k[i] = sum.stiffness;
    }
    if (with_contact) {
      const std::vector<Vec3> rest(n);
      for (std::size_t i = 0; i < interfaces_.size(); ++i) {
        interfaces_[i].contact.restore(blobs_[i]);
        const abut::contact::HostState host{x, rest, state.mass, tiny_step, tiny_step, tiny_step};
        interfaces_[i].contact.search(host);
        (void)interfaces_[i].contact.evaluate(host, contact, k);
      }
    }
    Eigen::VectorXd out(d.size());
    for (std::size_t i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        out[6 * static_cast<Eigen::Index>(i) + c] = contact[i][c] - f[i][c];
        out[6 * static_cast<Eigen::Index>(i) + 3 + c] = -m[i][c];
      }
    }
    return out;
  }

  /// Forces of the elements alone at velocities v: viscous ones, no strain.
  Eigen::VectorXd at_velocity(const Eigen::VectorXd& v) {
    fast_ = true;
    const Eigen::VectorXd out = at(v, false);
    fast_ = false;
    return out;
  }

  static constexpr double slow_step = 1e6, tiny_step = 1e-12, no_step = 1e-18;

 private:
  bool fast_ = false;
  std::vector<std::unique_ptr<abut::elements::Group>> groups_;
  abut::elements::Assembly assembly_;
  abut::parallel::ThreadPool pool_{1};

 public:
  abut::state::State state;

 private:
  abut::constraints::Axes axes_;

 public:
  abut::constraints::RigidBodies bodies;
  abut::constraints::BoundaryConditions conditions;
  Index touching = 0;

 private:
  std::vector<double> sums_;
  std::vector<abut::init::RunInterface> interfaces_;
  std::vector<std::vector<std::byte>> blobs_;
  Eigen::VectorXd zero_;
};

struct Limits {
  double undamped = 0.0;  ///< 2/omega_max
  double damped = 0.0;    ///< with the viscous forces
};

/// Limits of the model at its first geometry. @param delta  displacement of the differences
Limits exact_limit(const model::Model& m, double delta, Index& touching) {
  Forces forces(m);
  model::Model no_bulk = m;
  for (model::Property& p : no_bulk.properties) {
    if (auto* solid = std::get_if<model::SolidProperty>(&p.data)) solid->qa = solid->qb = 0.0;
  }
  Forces hourglass(no_bulk);
  touching = forces.touching;
  const auto n = static_cast<Eigen::Index>(forces.state.mass.size());
  // Columns of free motions.
  std::vector<Eigen::VectorXd> motions;
  std::vector<Eigen::VectorXd> momenta;  // M times the motion
  for (Index node = 0; node < m.node_count(); ++node) {
    const auto i = static_cast<std::size_t>(node);
    const bool body = forces.bodies.main_of(node) != abut::no_index;
    if (forces.bodies.body_of(node) != abut::no_index) continue;
    for (int c = 0; c < 6; ++c) {
      if (forces.conditions.fixed(node, c)) continue;
      const double mass = c < 3 ? forces.state.mass[i] : forces.state.inertia[i];
      if (mass <= 0.0) continue;
      Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * n);
      u[6 * node + c] = 1.0;
      Eigen::VectorXd p = u * mass;
      if (body) {
        const Index b = forces.bodies.main_of(node);
        Vec3 unit;
        unit[c % 3] = 1.0;
        if (c >= 3) {
          const Vec3 j = forces.bodies.times_inertia(b, unit);
          for (int k = 0; k < 3; ++k) p[6 * node + 3 + k] = j[k];
        }
        for (const Index s : m.rigid_bodies[static_cast<std::size_t>(b)].nodes) {
          const Vec3 arm = forces.state.x[static_cast<std::size_t>(s)] - forces.state.x[i];
          const Vec3 moved = c < 3 ? unit : cross(unit, arm);
          for (int k = 0; k < 3; ++k) u[6 * s + k] = moved[k];
          if (c >= 3) u[6 * s + c] = 1.0;
        }
      }
      motions.push_back(u);
      momenta.push_back(p);
    }
  }
  constexpr double slow = 1e-6;  // velocity of the differences: quadratic viscosity vanishes
  const auto size = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd stiffness(size, size);
  Eigen::MatrixXd damping(size, size);
  Eigen::MatrixXd mass(size, size);
  for (Eigen::Index c = 0; c < size; ++c) {
    const auto column = static_cast<std::size_t>(c);
    const Eigen::VectorXd f = (forces.at(delta * motions[column]) - forces.at(-delta * motions[column])) / (2.0 * delta);
    // f(v) - f(-v): bulk viscosity of every element once, hourglass viscosity twice.
    const Eigen::VectorXd v = slow * motions[column];
    const Eigen::VectorXd viscous =
        (forces.at_velocity(v) - forces.at_velocity(-v)) / slow - (hourglass.at_velocity(v) - hourglass.at_velocity(-v)) / (2.0 * slow);
    for (Eigen::Index r = 0; r < size; ++r) {
      damping(r, c) = -motions[static_cast<std::size_t>(r)].dot(viscous);
      stiffness(r, c) = -motions[static_cast<std::size_t>(r)].dot(f);
      // A body's momentum is written at its main node, where its motions are one at one place.
      mass(r, c) = 0.0;
    }
  }
  for (Eigen::Index c = 0; c < size; ++c) {
    const Eigen::VectorXd& p = momenta[static_cast<std::size_t>(c)];
    for (Eigen::Index r = 0; r < size; ++r) {
      // Only the main node's (or the free node's) own entries of the test motion carry mass.
      double sum = 0.0;
      const Eigen::VectorXd& q = momenta[static_cast<std::size_t>(r)];
      for (Eigen::Index k = 0; k < 6 * n; ++k) {
        if (p[k] != 0.0 && q[k] != 0.0) sum += p[k] * motions[static_cast<std::size_t>(r)][k];
      }
      mass(r, c) = sum;
    }
  }
  const Eigen::MatrixXd per_mass_k = mass.fullPivLu().solve(stiffness);
  const Eigen::MatrixXd per_mass_c = mass.fullPivLu().solve(damping);
  const auto largest = [](const Eigen::MatrixXd& a) { return a.eigenvalues().cwiseAbs().maxCoeff(); };
  Limits out;
  out.undamped = 2.0 / std::sqrt(largest(per_mass_k));
  double low = 0.0;
  double high = out.undamped;
  for (int i = 0; i < 20; ++i) {
    const double h = 0.5 * (low + high);
    (largest(h * h * per_mass_k + 2.0 * h * per_mass_c) <= 4.0 ? low : high) = h;
  }
  out.damped = high;
  return out;
}

void check(const char* name, Scene& scene, double delta, bool contact = true, double least = 0.7) {
  scene.end(1.0, 0.0, 1.0);
  Recorder recorder;
  // A few cycles are enough: the geometry is still the first one.
  scene.model.controls.t_end = 1e-12;
  const auto report = abut::cycle::run(scene.model, {}, recorder);
  ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  const double first = recorder.samples.front().dt;
  scene.model.controls.t_end = 1.5 * first;
  Recorder longer;
  (void)abut::cycle::run(scene.model, {}, longer);
  ASSERT_GE(longer.samples.size(), 2U);
  Index touching = 0;
  const Limits limits = exact_limit(scene.model, delta, touching);
  const double exact = limits.damped;
  const double step = longer.samples[1].dt;
  std::printf(
      "[found] step, %s: %d nodes in contact, step %.4e (first cycle %.4e), exact limit %.4e, ratio %.3f (first %.3f; to 2/omega_max "
      "%.3f)\n",
      name, static_cast<int>(touching), step, first, exact, step / exact, first / exact, step / limits.undamped);
  EXPECT_EQ(touching > 0, contact);
  EXPECT_LE(step, exact);
  EXPECT_LE(first, exact);
  EXPECT_GE(step, least * exact);
}

constexpr double young = 210e9, density = 7800.0;

/// A little disorder, the same for every run.
Vec3 disturbed(const Vec3& p, double size) {
  return p + size * Vec3{std::sin(31.0 * p.x + 57.0 * p.y / (1 + p.z * p.z)), std::sin(43.0 * p.y + 71.0 * p.x), 0.0};
}

TEST(Step, ShellOnShell) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.shell_property(0.001);
  const auto a = s.part(property, material);
  const auto b = s.part(property, material);
  s.shells(a, 4, 4, [](double u, double v) { return disturbed({0.04 * u, 0.04 * v, 0}, 5e-4); });
  s.shells(
      b, 3, 3,
      [](double u, double v) {
        return disturbed({0.004 + 0.03 * u, 0.005 + 0.03 * v, 0.0004}, 5e-4);
      },
      true);
  s.contact(s.shell_surface(a), s.shell_surface(b), 0.2, 0.0, 0.0005);
  check("shell on shell, gap 0.5 mm, s 0.2", s, 1e-9);
}

TEST(Step, ShellOnShellStiff) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.shell_property(0.001);
  const auto a = s.part(property, material);
  const auto b = s.part(property, material);
  s.shells(a, 4, 4, [](double u, double v) { return disturbed({0.04 * u, 0.04 * v, 0}, 5e-4); });
  s.shells(
      b, 3, 3,
      [](double u, double v) {
        return disturbed({0.004 + 0.03 * u, 0.005 + 0.03 * v, 0.0002}, 5e-4);
      },
      true);
  s.contact(s.shell_surface(a), s.shell_surface(b), 1.0, 0.2, 0.0005);
  check("shell on shell, gap 0.5 mm, s 1, deep, friction", s, 1e-9);
}

TEST(Step, BrickOnBrick) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.solid_property();
  const auto lower =
      s.block(s.part(property, material), {0, 0, -0.02}, {0.03, 0.03, 0.02}, {3, 3, 2}, [](const Vec3& p) { return disturbed(p, 3e-4); });
  const auto upper = s.block(s.part(property, material), {0.004, 0.005, -1e-5}, {0.02, 0.02, 0.02}, {2, 2, 2},
                             [](const Vec3& p) { return disturbed(p, 3e-4); });
  s.contact(s.surface(lower, 2, true), s.surface(upper, 2, false));
  check("brick on brick, gap 0, s 0.2", s, 1e-9);
}

TEST(Step, BrickOnShell) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto shell = s.part(s.shell_property(0.002), material);
  s.shells(shell, 4, 4, [](double u, double v) { return disturbed({0.04 * u, 0.04 * v, 0}, 5e-4); });
  const auto block = s.block(s.part(s.solid_property(), material), {0.008, 0.009, -1e-5}, {0.02, 0.02, 0.02}, {2, 2, 2},
                             [](const Vec3& p) { return disturbed(p, 3e-4); });
  s.contact(s.shell_surface(shell), s.surface(block, 2, false));
  check("brick on shell, gap 0, s 0.2", s, 1e-9);
}

TEST(Step, TwoInterfacesShareNodes) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto shell = s.part(s.shell_property(0.002), material);
  s.shells(shell, 3, 3, [](double u, double v) { return disturbed({0.03 * u, 0.03 * v, 0}, 5e-4); });
  const auto up = s.shell_surface(shell);
  const auto down = s.shell_surface(shell);
  for (auto& segment : s.model.surfaces[static_cast<std::size_t>(down)].segments) std::swap(segment.nodes[1], segment.nodes[3]);
  const auto solid = s.solid_property();
  const auto above = s.block(s.part(solid, material), {0.004, 0.005, -1e-5}, {0.02, 0.02, 0.01}, {2, 2, 1});
  const auto below = s.block(s.part(solid, material), {0.006, 0.003, 1e-5 - 0.01}, {0.02, 0.02, 0.01}, {2, 2, 1});
  s.contact(up, s.surface(above, 2, false));
  s.contact(down, s.surface(below, 2, true));
  check("shell between bricks, two interfaces on its nodes, s 0.2", s, 1e-9);
}

TEST(Step, OnAClampedBlock) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto property = s.solid_property();
  const auto lower = s.block(s.part(property, material), {0, 0, -0.01}, {0.03, 0.03, 0.01}, {3, 3, 1});
  const auto upper = s.block(s.part(property, material), {0.004, 0.005, -1e-5}, {0.02, 0.02, 0.02}, {2, 2, 2},
                             [](const Vec3& p) { return disturbed(p, 3e-4); });
  s.fix(lower.nodes, {true, true, true});
  s.contact(s.surface(lower, 2, true), s.surface(upper, 2, false));
  check("brick on a clamped block, gap 0, s 0.2", s, 1e-9);
}

TEST(Step, RigidBodyOnAShell) {
  Scene s("step");
  const auto material = s.elastic(density, young, 0.3);
  const auto shell = s.part(s.shell_property(0.002), material);
  s.shells(shell, 4, 4, [](double u, double v) { return disturbed({0.04 * u, 0.04 * v, 0}, 5e-4); });
  const auto block = s.block(s.part(s.solid_property(), material), {0.008, 0.009, -1e-5}, {0.02, 0.02, 0.01}, {2, 2, 1});
  model::RigidBody body;
  body.id = 1;
  body.main = block.nodes.front();
  body.nodes.assign(block.nodes.begin() + 1, block.nodes.end());
  s.model.node_id.push_back(static_cast<abut::Id>(s.model.node_id.size()) + 1);
  s.model.node_x.push_back({0.018, 0.019, 0.005});
  body.main = static_cast<Index>(s.model.node_id.size()) - 1;
  body.nodes = block.nodes;
  s.model.rigid_bodies.push_back(body);
  s.contact(s.shell_surface(shell), s.surface(block, 2, false));
  check("rigid body on a shell, gap 0, s 0.2", s, 1e-9);
}

// One brick between two bodies whose centres lie beside it: it opens by motions in which both move and turn. A brick's nodes are
// taken as stiff in all directions, so this model's step is not within 0.7 of its limit.
TEST(Step, TwoRigidBodiesBesideTheirCentres) {
  Scene s("step");
  const auto part = s.part(s.solid_property(), s.elastic(density, young, 0.3));
  const auto block = s.block(part, {0, 0, 0}, {0.01, 0.01, 0.01}, {1, 1, 1});
  for (const bool top : {false, true}) {
    model::RigidBody body;
    body.id = top ? 2 : 1;
    body.main = s.node({0.03, 0.005, top ? 0.01 : 0.0});
    body.nodes = block.plane(2, top);
    body.icog = 4;  // mass and inertia of the card alone, the centre where it is
    body.mass = 4e-3;
    body.j_diagonal = {2.4e-6, 2.4e-6, 2.4e-6};
    body.ispher = 3;
    s.model.rigid_bodies.push_back(body);
  }
  check("a brick between two rigid bodies beside their centres", s, 1e-9, false, 0.6);
}

// h = s h_0 for every scale of the default and below, also where viscosity has a share of the step.
TEST(Step, GoesWithTheScaleOfDt) {
  const auto settled = [](Scene& scene, double scale) {
    scene.end(1e-12, 0.0, scale);
    Recorder first;
    (void)abut::cycle::run(scene.model, {}, first);
    scene.end(100.0 * first.samples.front().dt, 0.0, scale);
    Recorder recorder;
    (void)abut::cycle::run(scene.model, {}, recorder);
    return recorder.samples[recorder.samples.size() - 2].dt;  // the last one may be cut short by the end
  };
  Scene bricks("bricks");
  const auto steel = bricks.elastic(density, young, 0.3);
  (void)bricks.block(bricks.part(bricks.solid_property(), steel), {0, 0, 0}, {0.02, 0.02, 0.02}, {2, 2, 2});
  Scene shells("shells");
  const Index damped = shells.shell_property(0.001);
  std::get<model::ShellProperty>(shells.model.properties[static_cast<std::size_t>(damped)].data).dm = 0.3;
  shells.shells(shells.part(damped, shells.elastic(density, young, 0.3)), 3, 3, [](double u, double v) {
    return Vec3{0.03 * u, 0.03 * v, 0.0};
  });
  for (Scene* scene : {&bricks, &shells}) {
    const double usual = settled(*scene, 0.9) / 0.9;
    for (const double scale : {0.67, 0.3, 0.05}) {
      const double h = settled(*scene, scale) / scale;
      std::printf("[found] step, %s: h/s %.5e at %.2f, %.5e at 0.90\n", scene == &bricks ? "bricks" : "damped shells", h, scale, usual);
      EXPECT_NEAR(h, usual, 1e-6 * usual) << scale;
    }
  }
}

}  // namespace
