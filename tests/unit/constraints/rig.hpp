// A small run for tests of constraints: the order of numerics.md 1.2 over free nodes and a force law given by the test.
#pragma once

#include <functional>
#include <vector>

#include "constraints/axes.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/curves.hpp"
#include "constraints/imposed_motions.hpp"
#include "constraints/loads.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rigid_walls.hpp"
#include "constraints/work_meter.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints::test {

/// Model with nodes at the given places.
inline model::Model nodes_at(const std::vector<Vec3>& x) {
  model::Model model;
  model.node_x = x;
  for (std::size_t i = 0; i < x.size(); ++i) model.node_id.push_back(static_cast<Id>(i) + 1);
  return model;
}

inline Index add_function(model::Model& model, std::vector<double> x, std::vector<double> y) {
  model.functions.push_back({static_cast<Id>(model.functions.size()) + 1, std::move(x), std::move(y)});
  return static_cast<Index>(model.functions.size()) - 1;
}

inline state::State state_of(const model::Model& model, double mass = 1.0, double inertia = 0.0) {
  state::State s;
  const std::size_t n = model.node_x.size();
  s.x = model.node_x;
  for (auto* field :
       {&s.u, &s.v, &s.w, &s.a, &s.alpha, &s.f, &s.m, &s.f_internal, &s.m_internal, &s.f_external, &s.m_external, &s.f_contact}) {
    field->assign(n, Vec3{});
  }
  s.mass.assign(n, mass);
  s.inertia.assign(n, inertia);
  s.stiffness.assign(n, 1e-20);
  s.rotational_stiffness.assign(n, 1e-20);
  return s;
}

/// One run. Set masses and velocities in `s`, then start(), then step(h) per cycle: afterwards `s` holds x^(n+1), v^(n+1/2).
struct Rig {
  model::Model model;
  Profile profile;
  state::State s;
  Curves curves{model};
  Axes axes{model};
  RigidBodies bodies{model, profile};
  BoundaryConditions conditions{model, axes, bodies, profile};
  Loads loads{model, curves, axes};
  Gravities gravities{model, curves, axes, bodies};
  ImposedMotions motions{model, curves, axes, bodies};
  RigidWalls walls{model, bodies, conditions, motions, profile};
  std::function<void(state::State&)> forces = [](state::State&) {};              ///< sets f_contact (and m_internal, subtracted)
  std::function<void(const state::State&)> output = [](const state::State&) {};  ///< step 26
  std::function<void(state::State&)> scaling = [](state::State&) {};             ///< step 13
  ForceWork force_work;

  double external = 0.0;  ///< reference bookings of loads, gravity, imposed motion and walls
  double baseline = 0.0;  ///< kinetic energy at the start
  double kinetic = 0.0;   ///< T*_n of the last cycle
  double work_loads = 0.0, work_gravity = 0.0, work_conditions = 0.0, work_motions = 0.0, work_hold = 0.0, work_walls = 0.0,
         work_stops = 0.0, work_bodies = 0.0, work_forces = 0.0;

  explicit Rig(model::Model m, double mass = 1.0, double inertia = 0.0, Profile p = {})
      : model(std::move(m)), profile(p), s(state_of(model, mass, inertia)) {}
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  void start() {
    walls.initialise(s);
    bodies.initialise(s);
    baseline = ledger_kinetic_energy(s) + bodies.ledger_correction(s);
  }

  void step(double h) {
    auto& t = s.times;
    axes.update(s);
    const std::size_t n = s.x.size();
    for (std::size_t i = 0; i < n; ++i) {
      s.f_contact[i] = s.m_internal[i] = Vec3{};
      s.stiffness[i] = s.rotational_stiffness[i] = 1e-20;
    }
    loads.apply(s);
    forces(s);
    std::vector<Vec3> moment(n);
    for (std::size_t i = 0; i < n; ++i) {
      s.f[i] = s.f_external[i] + s.f_contact[i];
      moment[i] = -s.m_internal[i];
      s.m[i] = s.m_external[i] + moment[i];
    }
    bodies.gather(s, conditions);
    walls.add_reaction(s);
    scaling(s);
    t.h_plus = h;
    t.h_bar_old = t.h_bar;
    t.h_bar = 0.5 * (t.h_minus + t.h_plus);
    external += loads.book_work(s);
    for (std::size_t i = 0; i < n; ++i) {
      s.a[i] = s.mass[i] > 0.0 ? s.f[i] / s.mass[i] : Vec3{};
      s.alpha[i] = s.inertia[i] > 0.0 ? s.m[i] / s.inertia[i] : Vec3{};
    }
    bodies.accelerate(s, conditions);
    gravities.apply(s);
    external += gravities.book_work(s);
    conditions.apply(s);
    motions.apply(s, conditions);
    bodies.hold(s, conditions, motions);
    external += motions.book_work(s);
    walls.apply(s);
    external += walls.work();
    conditions.apply(s);
    bodies.scatter(s);
    kinetic = ledger_kinetic_energy(s) + bodies.ledger_correction(s);
    work_loads += loads.ledger_work(s);
    work_gravity += gravities.ledger_work(s);
    work_conditions += conditions.ledger_work(s);
    work_motions += motions.ledger_work(s);
    work_hold += bodies.hold_work(s);
    work_walls += walls.ledger_work(s);
    work_stops += walls.stop_work(s);
    work_bodies += bodies.ledger_work(s);
    work_forces += force_work.settle(s, s.f_contact, moment);
    output(s);
    for (std::size_t i = 0; i < n; ++i) {
      s.v[i] += t.h_bar * s.a[i];
      s.w[i] += t.h_bar * s.alpha[i];
      s.x[i] += h * s.v[i];
      s.u[i] += h * s.v[i];
    }
    t.t += h;
    t.h_minus = h;
    ++t.cycle;
  }

  /// T*_n - T*_0 - all discrete works: zero to rounding.
  [[nodiscard]] double ledger() const {
    return kinetic - baseline - work_loads - work_gravity - work_conditions - work_motions - work_hold - work_walls - work_bodies -
           work_forces;
  }
};

}  // namespace abut::constraints::test
