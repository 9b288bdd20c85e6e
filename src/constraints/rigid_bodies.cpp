// Motion of rigid bodies. Euler's equations for the main node; secondary nodes follow.
//
//   J dw/dt = T - w x J w,  T about the main node, J = sum_k J_k e_k e_k turning with the body     (numerics.md 6.2.2)
//
// `conserving`: the gyroscopic term is taken at w + h_bar alpha / 2 (implicit midpoint rule in the body's axes: w.Jw and |Jw|
// are then invariants of a free body to rounding, for any sequence of steps), solved by fixed-point iteration once h_bar is
// known. Secondary nodes move on the chord of their exact rotation, v' = v_M' + (R(h_+ w') r - r) / h_+, so that distances do not
// drift. The stiffnesses of the nodes meet at the main node as one frequency (body_frequency.hpp).
// `reference`: gyroscopic term from w, v' = v_M' + u + h_+/2 w' x u with u = w' x r; a body of at most two secondary nodes:
// u = (R(h_+ w') r - r) / h_+ and h_- in place of h_+, as measured on a rotating two-node body (the radius then shrinks by
// |w h|^2 / 2 per step).
#include "constraints/rigid_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "constraints/body_frequency.hpp"
#include "constraints/body_tensor.hpp"
#include "constraints/boundary_conditions.hpp"
#include "constraints/rotation.hpp"

namespace abut::constraints {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

RigidBodies::RigidBodies(const model::Model& model, const Profile& profile)
    : model_(&model),
      conserving_(profile.rigid_body == Profile::RigidBody::conserving),
      bodies_(model.rigid_bodies.size()),
      sums_(model.rigid_bodies.size()),
      body_of_(model.rigid_bodies.empty() ? 0 : at(model.node_count()), no_index),
      main_of_(model.rigid_bodies.empty() ? 0 : at(model.node_count()), no_index),
      bound_(model.rigid_bodies.size(), false) {
  std::vector<bool> bound(at(model.node_count()), false);
  for (const model::RigidWall& card : model.rigid_walls) {
    if (card.node != no_index) bound[at(card.node)] = true;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) bound_[i] = bound[at(model.rigid_bodies[i].main)];
  // Known before initialise(): constraints that are built next, and init, ask which nodes are secondary.
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const model::RigidBody& card = model.rigid_bodies[i];
    if (card.active && (card.sensor == no_index || model.sensors[at(card.sensor)].t_on <= 0.0)) claim(i, true);
  }
}

void RigidBodies::claim(std::size_t index, bool on) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  const auto body = static_cast<Index>(index);
  const auto mark = [&](Index& owner) {
    if (on && owner == no_index) owner = body;
    if (!on && owner == body) owner = no_index;
  };
  for (const Index node : card.nodes) mark(body_of_[at(node)]);
  mark(main_of_[at(card.main)]);
  bodies_[index].on = on;
  ++revision_;
}

void RigidBodies::initialise(state::State& state) {
  take_axis_spins();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].on) switch_on(i, state, true);
  }
}

bool RigidBodies::contains(std::span<const Index> nodes) const {
  Index body = no_index;
  for (const Index node : nodes) {
    const Index mine = body_of(node) != no_index ? body_of(node) : main_of(node);
    if (mine == no_index || (body != no_index && mine != body)) return false;
    body = mine;
  }
  return body != no_index;
}

void RigidBodies::follow_sensors(state::State& state) {
  const double t = state.times.t;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const model::RigidBody& card = model_->rigid_bodies[i];
    bool wanted = card.active;
    if (card.sensor != no_index) {
      const model::Sensor& sensor = model_->sensors[at(card.sensor)];
      wanted = wanted && t >= sensor.t_on && t < sensor.t_off;
    }
    if (wanted && !bodies_[i].on) switch_on(i, state, false);
    if (!wanted && bodies_[i].on) switch_off(i, state);
  }
}

void RigidBodies::turn_axes(Inertia& inertia, const Vec3& angle) const {
  const Vec3 e0 = normalized(rotated(inertia.axes[0], angle));
  Vec3 e1 = rotated(inertia.axes[1], angle);
  e1 = normalized(e1 - dot(e1, e0) * e0);
  inertia.axes = {e0, e1, cross(e0, e1)};
}

Vec3 RigidBodies::angular_acceleration(const Body& body, const Vec3& torque, const Vec3& w, double h_bar,
                                       const BoundaryConditions::Held& held, const Vec3& given) const {
  const Inertia& inertia = body.inertia;
  const Vec3 rest = torque - times(inertia, given);
  Vec3 alpha = given + solve_free(inertia, rest - cross(w, times(inertia, w)), held);
  if (!conserving_) return alpha;
  // Contraction with factor of order h |w|: a handful of passes; the cap guards steps that scatter() will refuse anyway.
  for (int pass = 0; pass < 40; ++pass) {
    const Vec3 middle = w + 0.5 * h_bar * alpha;
    const Vec3 next = given + solve_free(inertia, rest - cross(middle, times(inertia, middle)), held);
    const double change = squared_norm(next - alpha);
    alpha = next;
    if (change <= 1e-34 * squared_norm(alpha)) break;
  }
  return alpha;
}

void RigidBodies::gather(state::State& state, const BoundaryConditions& conditions) {
  const double h_minus = state.times.h_minus;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].on) turn_axes(bodies_[i].inertia, h_minus * state.w[at(model_->rigid_bodies[i].main)]);
  }
  follow_sensors(state);  // those of a body that is switched on now are of x(n)
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    sums_[i].force = sums_[i].moment = Vec3{};
    if (!body.on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    const std::size_t main = at(card.main);
    body.own_moment = state.m[main];
    body.entry_w = state.w[main];

    BodySums& sums = sums_[i];
    double k = 0.0, kr = 0.0;
    BodySprings springs;
    const Vec3 centre = centre_of(static_cast<Index>(i), state);
    if (conserving_) springs.add(state.x[main] - centre, state.stiffness[main], state.rotational_stiffness[main]);
    for (const Index node : card.nodes) {
      const std::size_t s = at(node);
      const Vec3 r = state.x[s] - state.x[main];
      sums.force += state.f[s];
      sums.moment += state.m[s] + cross(r, state.f[s]);
      k += state.stiffness[s];
      kr += state.rotational_stiffness[s] + squared_norm(r) * state.stiffness[s];
      if (conserving_) springs.add(state.x[s] - centre, state.stiffness[s], state.rotational_stiffness[s]);
      state.stiffness[s] = state.rotational_stiffness[s] = conserving_ ? 0.0 : 1e-20;
    }
    sums.rotation += h_minus * state.w[main];
    state.f[main] += sums.force;
    state.stiffness[main] += k;
    state.rotational_stiffness[main] += kr;

    if (conserving_) {
      // |r|^2 about every axis, over the least inertia: shorter steps than stability asks for, because the first and last forces of rigid
      // plates that land flat need them (EffectiveMass.*: with the frequency alone 2.7 % of the energy instead of 0.9 %).
      const double margin = state.inertia[main] > 0.0 ? state.rotational_stiffness[main] / state.inertia[main] : 0.0;
      const double rate = std::max(largest_rate(springs, state.mass[main], body.inertia), margin);
      state.stiffness[main] = rate * state.mass[main];
      state.rotational_stiffness[main] = rate * state.inertia[main];
      continue;
    }
    body.euler_alpha = angular_acceleration(body, torque(i, state), state.w[main], 0.0, conditions.held(card.main, true));
    state.m[main] = state.inertia[main] * body.euler_alpha;
  }
}

void RigidBodies::book_impulses(double h) {
  for (BodySums& sums : sums_) {
    sums.force_impulse += h * sums.force;
    sums.moment_impulse += h * sums.moment;
  }
}

Vec3 RigidBodies::torque(std::size_t index, const state::State& state) const {
  const Body& body = bodies_[index];
  const std::size_t main = at(model_->rigid_bodies[index].main);
  const Vec3 about_main = body.own_moment + sums_[index].moment;
  return body.beside ? about_main + cross(state.x[main] - body.centre, state.f[main]) : about_main;
}

void RigidBodies::accelerate(state::State& state, const BoundaryConditions& conditions) {
  if (!conserving_) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.on) continue;
    const Index node = model_->rigid_bodies[i].main;
    const std::size_t main = at(node);
    const BoundaryConditions::Held held = body.beside ? BoundaryConditions::Held{} : conditions.held(node, true);
    body.euler_alpha = angular_acceleration(body, torque(i, state), state.w[main], state.times.h_bar, held);
    if (body.beside) state.v[main] -= body.relative;
    body.held_force = body.held_moment = Vec3{};
    body.held.count = 0;
    state.alpha[main] = body.euler_alpha;
    state.m[main] = state.inertia[main] * body.euler_alpha;
  }
}

Vec3 RigidBodies::turn(Index node, state::State& state, const BoundaryConditions::Held& held, const Vec3& given) {
  const auto index = at(main_of(node));
  Body& body = bodies_[index];
  const Vec3 w = state.w[at(node)], free_torque = torque(index, state);
  const Vec3 alpha = angular_acceleration(body, free_torque, w, state.times.h_bar, held, given);
  const Vec3 middle = w + 0.5 * state.times.h_bar * alpha;
  const Vec3 without = free_torque - cross(middle, times(body.inertia, middle));
  state.alpha[at(node)] = body.euler_alpha = times_inverse(body.inertia, without);
  return times(body.inertia, alpha) - without;
}

Vec3 RigidBodies::response(const state::State& state, const Carrier& carrier, const Vec3& impulse) const {
  if (carrier.body == no_index) {
    const double mass = state.mass[at(carrier.node)];
    return mass > 0.0 ? carrier.translation.free_part(impulse) / mass : Vec3{};
  }
  const Vec3& x = state.x[at(carrier.point)];
  return answer(state, carrier.body, carrier.translation, carrier.rotation).velocity(x, x, impulse);
}

Vec3 RigidBodies::next_velocity(const state::State& state, const Carrier& carrier) const {
  const std::size_t node = at(carrier.node);
  const double h = state.times.h_plus, hb = state.times.h_bar;
  const Vec3 v = state.v[node] + hb * state.a[node];
  if (carrier.body == no_index) return v;
  const Vec3 arm = state.x[at(carrier.point)] - centre_of(carrier.body, state);
  return arm == Vec3{} ? v : v + chord(arm, h * (state.w[node] + hb * state.alpha[node])) / h;
}

void RigidBodies::push(state::State& state, const Carrier& carrier, const Vec3& impulse) const {
  const std::size_t node = at(carrier.node);
  const double hb = state.times.h_bar;
  if (carrier.body != no_index && bodies_[at(carrier.body)].beside) {
    const Answer::Motion m = answer(state, carrier.body, carrier.translation, carrier.rotation).motion(state.x[at(carrier.point)], impulse);
    state.a[node] += m.v / hb;
    state.alpha[node] += m.w / hb;
    return;
  }
  if (state.mass[node] > 0.0) state.a[node] += carrier.translation.free_part(impulse) / (state.mass[node] * hb);
  if (carrier.body == no_index) return;
  const Vec3 arm = state.x[at(carrier.point)] - centre_of(carrier.body, state);
  if (arm == Vec3{}) return;
  state.alpha[node] += solve_free(bodies_[at(carrier.body)].inertia, cross(arm, impulse), carrier.rotation) / hb;
}

void RigidBodies::scatter(state::State& state) {
  const double h = state.times.h_plus, hb = state.times.h_bar, h_minus = state.times.h_minus;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    const std::size_t main = at(card.main);
    const Vec3 centre = centre_of(static_cast<Index>(i), state);
    satisfy(i, state);
    const Vec3 w = state.w[main] + hb * state.alpha[main];
    const Vec3 v = state.v[main] + hb * state.a[main];
    const Vec3 angle = h * w;
    if (squared_norm(angle) > 1.0) {
      throw RunError("rigid body " + std::to_string(card.id) +
                     " turns by more than one radian in one step: its inertia or the time step is wrong");
    }
    const bool small_body = card.nodes.size() <= 2;
    for (const Index node : card.nodes) {
      const std::size_t s = at(node);
      const Vec3 r = state.x[s] - centre;
      Vec3 relative{};
      if (conserving_ || small_body) {
        relative = chord(r, angle) / h;
        if (!conserving_) relative += 0.5 * h_minus * cross(w, relative);
      } else {
        const Vec3 u = cross(w, r);
        relative = u + 0.5 * h * cross(w, u);
      }
      state.a[s] = (v + relative - state.v[s]) / hb;
      state.alpha[s] = (w - state.w[s]) / hb;
    }
    if (!body.beside) continue;
    body.centre_v = state.v[main];
    body.centre_a = state.a[main];
    body.centre += h * v;
    state.v[main] += body.relative;
    body.relative = chord(state.x[main] - centre, angle) / h;
    state.a[main] = (v + body.relative - state.v[main]) / hb;
  }
}

void RigidBodies::persist(state::Archive& a) {
  a.each(bodies_, [&a](Body& b) {
    a(b.on);
    a(b.beside);
    for (Vec3* v : {&b.centre, &b.relative, &b.centre_v, &b.centre_a}) a(*v);
    a(b.inertia.mass);
    a(b.inertia.principal);
    a(b.inertia.axes);
    a(b.own_mass);
    a(b.own_inertia);
    a(b.own_moment);
    a(b.entry_w);
    a(b.euler_alpha);
    a(b.rotation_before);
    a(b.switch_work);
  });
  a.each(sums_, [&a](BodySums& s) {
    for (Vec3* v : {&s.force_impulse, &s.moment_impulse, &s.force, &s.moment, &s.rotation}) a(*v);
  });
  a(hold_second_half_);
  a.fixed(body_of_);
  a.fixed(main_of_);
  if (!a.loading()) return;
  const auto known = static_cast<Index>(bodies_.size());
  for (const std::vector<Index>* owner : {&body_of_, &main_of_}) {
    for (const Index body : *owner) {
      if (body < no_index || body >= known) throw state::ArchiveError("the checkpoint is damaged (rigid bodies)");
    }
  }
  ++revision_;
}

RigidBodies::Answer RigidBodies::answer(const state::State& state, Index body, const BoundaryConditions::Held& translation,
                                        const BoundaryConditions::Held& rotation) const {
  const std::size_t main = at(model_->rigid_bodies[at(body)].main);
  const Body& b = bodies_[at(body)];
  using Held = BoundaryConditions::Held;
  Answer r{(b.beside ? Held{} : translation).mobility(state.mass[main]), {}, centre_of(body, state), {}};
  for (int k = 0; k < 3; ++k) {
    Vec3 unit{};
    unit[k] = 1.0;
    r.rotation[static_cast<std::size_t>(k)] = solve_free(b.inertia, unit, b.beside ? Held{} : rotation);
  }
  if (!b.beside) return r;
  r.held.arm = state.x[main] - r.centre;
  for (int k = 0; k < translation.count; ++k) add_row(r.held, b, translation.axis[static_cast<std::size_t>(k)], {}, 0.0);
  for (int k = 0; k < rotation.count; ++k) add_row(r.held, b, {}, rotation.axis[static_cast<std::size_t>(k)], 0.0);
  return r;
}

}  // namespace abut::constraints
