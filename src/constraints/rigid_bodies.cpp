// Motion of rigid bodies. Euler's equations for the main node; secondary nodes follow.
//
//   J dw/dt = T - w x J w,  T about the main node, J = sum_k J_k e_k e_k turning with the body     (numerics.md 6.2.2)
//
// `conserving`: the gyroscopic term is taken at w + h_bar alpha / 2 (implicit midpoint rule in the body's axes: w.Jw and |Jw|
// are then invariants of a free body to rounding, for a constant step), solved by fixed-point iteration; h_bar is that of the
// previous step, because the new one is not known yet at step 11. Secondary nodes move on the chord of their exact rotation,
// v' = v_M' + (R(h_+ w') r - r) / h_+, so that distances do not drift.
// `reference`: gyroscopic term from w, v' = v_M' + u + h_+/2 w' x u with u = w' x r; a body of at most two secondary nodes:
// u = (R(h_+ w') r - r) / h_+ and h_- in place of h_+, as measured on a rotating two-node body (the radius then shrinks by
// |w h|^2 / 2 per step).
#include "constraints/rigid_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "constraints/boundary_conditions.hpp"
#include "constraints/rotation.hpp"

namespace abut::constraints {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 apply_tensor(const RigidBodies::Inertia& inertia, const Vec3& b) {
  Vec3 sum{};
  for (std::size_t k = 0; k < 3; ++k) sum += inertia.principal[k] * dot(inertia.axes[k], b) * inertia.axes[k];
  return sum;
}

Vec3 apply_inverse(const RigidBodies::Inertia& inertia, const Vec3& b) {
  Vec3 sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (inertia.principal[k] > 0.0) sum += dot(inertia.axes[k], b) / inertia.principal[k] * inertia.axes[k];
  }
  return sum;
}

/// J alpha = rhs for the components of alpha that are not held.
Vec3 solve_free(const RigidBodies::Inertia& inertia, const Vec3& rhs, const BoundaryConditions::Held& held) {
  if (held.count == 0) return apply_inverse(inertia, rhs);
  if (held.count == 3) return {};
  if (held.count == 2) {
    const Vec3 e = cross(held.axis[0], held.axis[1]);
    const double j = dot(e, apply_tensor(inertia, e));
    return j > 0.0 ? dot(e, rhs) / j * e : Vec3{};
  }
  const Vec3 h = held.axis[0];
  const Vec3 e1 = normalized(std::fabs(h.x) < 0.6 ? cross(h, Vec3{1, 0, 0}) : cross(h, Vec3{0, 1, 0}));
  const Vec3 e2 = cross(h, e1);
  const Vec3 j1 = apply_tensor(inertia, e1), j2 = apply_tensor(inertia, e2);
  const double j11 = dot(e1, j1), j12 = dot(e1, j2), j22 = dot(e2, j2);
  const double det = j11 * j22 - j12 * j12;
  if (det <= 0.0) return {};
  const double r1 = dot(e1, rhs), r2 = dot(e2, rhs);
  return (j22 * r1 - j12 * r2) / det * e1 + (j11 * r2 - j12 * r1) / det * e2;
}

}  // namespace

RigidBodies::RigidBodies(const model::Model& model, const Profile& profile)
    : model_(&model),
      conserving_(profile.rigid_body == Profile::RigidBody::conserving),
      bodies_(model.rigid_bodies.size()),
      sums_(model.rigid_bodies.size()),
      body_of_(at(model.node_count()), no_index),
      main_of_(at(model.node_count()), no_index) {
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
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].on) switch_on(i, state, true);
  }
}

void RigidBodies::compute_inertia(std::size_t index, state::State& state, int icog, bool card_values) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  Body& body = bodies_[index];
  const std::size_t main = at(card.main);
  body.own_mass = state.mass[main];
  body.own_inertia = state.inertia[main];
  const double m0 = body.own_mass + (card_values ? card.mass : 0.0);

  double secondary_mass = 0.0;
  Vec3 moment{};
  for (const Index node : card.nodes) {
    secondary_mass += state.mass[at(node)];
    moment += state.mass[at(node)] * state.x[at(node)];
  }
  const Vec3 old = state.x[main];
  if (icog == 1 && m0 + secondary_mass > 0.0) state.x[main] = (m0 * old + moment) / (m0 + secondary_mass);
  if (icog == 2 && secondary_mass > 0.0) state.x[main] = moment / secondary_mass;
  const Vec3 centre = state.x[main];

  Symmetric j{body.own_inertia, body.own_inertia, body.own_inertia, 0.0, 0.0, 0.0};
  if (card_values) {
    const Symmetric local{card.j_diagonal.x, card.j_diagonal.y, card.j_diagonal.z, card.j_off.x, card.j_off.y, card.j_off.z};
    Frame s{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    if (card.skew != no_index) s = model_->skews[at(card.skew)].axes;
    const auto global = [&](int p, int q) {  // e_p . (S J S^T) e_q
      const auto in_skew = [&](int c) { return Vec3{s[0][c], s[1][c], s[2][c]}; };
      return dot(in_skew(p), times(local, in_skew(q)));
    };
    const Symmetric added{global(0, 0), global(1, 1), global(2, 2), global(0, 1), global(1, 2), global(2, 0)};
    for (std::size_t k = 0; k < 6; ++k) j[k] += added[k];
  }
  if (icog != 2) add_point_mass(j, m0, old - centre);  // ICoG = 2: m0 is taken to sit at the new position
  double mass = m0;
  if (icog != 4) {
    mass += secondary_mass;
    for (const Index node : card.nodes) {
      for (std::size_t k = 0; k < 3; ++k) j[k] += state.inertia[at(node)];
      add_point_mass(j, state.mass[at(node)], state.x[at(node)] - centre);
    }
  }

  diagonalise(j, body.inertia.principal, body.inertia.axes);
  auto& principal = body.inertia.principal;
  if (card.ispher == 1) {
    principal.fill((j[0] + j[1] + j[2]) / 3.0);
  } else if (card.ispher != 3) {
    const double largest = std::max({principal[0], principal[1], principal[2]});
    for (double& value : principal) {
      if (value <= 1e-3 * largest) value += 0.1 * largest;
    }
  }
  body.inertia.mass = mass;
  state.mass[main] = mass;
  state.inertia[main] = std::min({principal[0], principal[1], principal[2]});
}

void RigidBodies::switch_on(std::size_t index, state::State& state, bool at_start) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  Body& body = bodies_[index];
  const std::size_t main = at(card.main);
  if (at_start) {
    compute_inertia(index, state, card.sensor == no_index ? card.icog : 3, card.sensor == no_index);
  } else {
    // Perfectly plastic impact: the body takes over the momentum and the angular momentum of its nodes.
    const double before = free_energy(index, state);
    Vec3 momentum = state.mass[main] * state.v[main];
    Vec3 spin = state.inertia[main] * state.w[main];
    compute_inertia(index, state, 3, false);
    for (const Index node : card.nodes) {
      const Vec3 p = state.mass[at(node)] * state.v[at(node)];
      momentum += p;
      spin += cross(state.x[at(node)] - state.x[main], p) + state.inertia[at(node)] * state.w[at(node)];
    }
    // About the main node, which need not be the centre of gravity: the offset's share is carried by the velocity of the main node.
    if (state.mass[main] > 0.0) state.v[main] = momentum / state.mass[main];
    state.w[main] = apply_inverse(body.inertia, spin);
    claim(index, true);
    body.switch_work += rigid_energy(index, state) - before;
  }
  for (const Index node : card.nodes) {
    state.v[at(node)] = state.v[main] + cross(state.w[main], state.x[at(node)] - state.x[main]);
    state.w[at(node)] = state.w[main];
  }
  body.rotation_before = 0.5 * dot(state.w[main], apply_tensor(body.inertia, state.w[main]));
}

void RigidBodies::switch_off(std::size_t index, state::State& state) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  Body& body = bodies_[index];
  const double before = rigid_energy(index, state);
  state.mass[at(card.main)] = body.own_mass;
  state.inertia[at(card.main)] = body.own_inertia;
  claim(index, false);
  // The second halves of the last cycle are booked here: rigid_energy() is the rotational energy that T* has grown to.
  body.switch_work += free_energy(index, state) - before;
  body.switch_work += 0.5 * dot(state.w[at(card.main)], apply_tensor(body.inertia, state.w[at(card.main)])) - body.rotation_before;
}

double RigidBodies::free_energy(std::size_t index, const state::State& state) const {
  const model::RigidBody& card = model_->rigid_bodies[index];
  const auto energy = [&](std::size_t i) {
    return 0.5 * (state.mass[i] * squared_norm(state.v[i]) + state.inertia[i] * squared_norm(state.w[i]));
  };
  double sum = energy(at(card.main));
  for (const Index node : card.nodes) sum += energy(at(node));
  return sum;
}

double RigidBodies::rigid_energy(std::size_t index, const state::State& state) const {
  const std::size_t main = at(model_->rigid_bodies[index].main);
  return 0.5 * state.mass[main] * squared_norm(state.v[main]) +
         0.5 * dot(state.w[main], apply_tensor(bodies_[index].inertia, state.w[main]));
}

bool RigidBodies::contains(std::span<const Index> nodes) const {
  Index body = no_index;
  for (const Index node : nodes) {
    const Index mine = body_of_[at(node)] != no_index ? body_of_[at(node)] : main_of_[at(node)];
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

Vec3 RigidBodies::angular_acceleration(const Inertia& inertia, const Vec3& torque, const Vec3& w, double h_bar,
                                       const BoundaryConditions& conditions, Index main) const {
  const BoundaryConditions::Held held = conditions.held(main, true);
  Vec3 alpha = solve_free(inertia, torque - cross(w, apply_tensor(inertia, w)), held);
  if (!conserving_ || h_bar == 0.0) return alpha;
  // Contraction with factor of order h |w|: a handful of passes; the cap guards steps that scatter() will refuse anyway.
  for (int pass = 0; pass < 40; ++pass) {
    const Vec3 middle = w + 0.5 * h_bar * alpha;
    const Vec3 next = solve_free(inertia, torque - cross(middle, apply_tensor(inertia, middle)), held);
    const double change = squared_norm(next - alpha);
    alpha = next;
    if (change <= 1e-34 * squared_norm(alpha)) break;
  }
  return alpha;
}

void RigidBodies::gather(state::State& state, const BoundaryConditions& conditions) {
  follow_sensors(state);
  const double h_minus = state.times.h_minus;
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
    for (const Index node : card.nodes) {
      const std::size_t s = at(node);
      const Vec3 r = state.x[s] - state.x[main];
      sums.force += state.f[s];
      sums.moment += state.m[s] + cross(r, state.f[s]);
      k += state.stiffness[s];
      kr += state.rotational_stiffness[s] + squared_norm(r) * state.stiffness[s];
      state.stiffness[s] = state.rotational_stiffness[s] = 1e-20;
    }
    sums.force_impulse += h_minus * sums.force;
    sums.moment_impulse += h_minus * sums.moment;
    sums.rotation += h_minus * state.w[main];
    state.f[main] += sums.force;
    state.stiffness[main] += k;
    state.rotational_stiffness[main] += kr;

    turn_axes(body.inertia, h_minus * state.w[main]);
    body.euler_alpha = angular_acceleration(body.inertia, body.own_moment + sums.moment, state.w[main], h_minus, conditions, card.main);
    state.m[main] = state.inertia[main] * body.euler_alpha;
  }
}

void RigidBodies::scatter(state::State& state) {
  const double h = state.times.h_plus, hb = state.times.h_bar, h_minus = state.times.h_minus;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    const std::size_t main = at(card.main);
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
      const Vec3 r = state.x[s] - state.x[main];
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
  }
}

void RigidBodies::persist(state::Archive& a) {
  a.each(bodies_, [&a](Body& b) {
    a(b.on);
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

EnergyCorrection RigidBodies::energy_correction(const state::State& state) const {
  const double half = 0.5 * state.times.h_minus;
  EnergyCorrection sum;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    for (const Index node : card.nodes) {
      const std::size_t s = at(node);
      const Vec3 v = state.v[s] + half * state.a[s];
      sum.translation -= 0.5 * state.mass[s] * squared_norm(v);
      sum.rotation -= 0.5 * state.inertia[s] * squared_norm(state.w[s] + half * state.alpha[s]);
      sum.mass -= state.mass[s];
      sum.momentum -= state.mass[s] * v;
    }
    const std::size_t main = at(card.main);
    const Vec3 w = state.w[main] + half * state.alpha[main];
    sum.rotation += 0.5 * dot(w, apply_tensor(bodies_[i].inertia, w)) - 0.5 * state.inertia[main] * squared_norm(w);
  }
  return sum;
}

double RigidBodies::ledger_correction(const state::State& state) const {
  const double hb = state.times.h_bar;
  double sum = 0.0;
  const auto w_star = [&](std::size_t s) { return state.w[s] + hb * state.alpha[s]; };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    for (const Index node : card.nodes) {
      const std::size_t s = at(node);
      sum -= 0.5 * state.mass[s] * dot(state.v[s], state.v[s] + hb * state.a[s]);
      sum -= 0.5 * state.inertia[s] * dot(state.w[s], w_star(s));
    }
    const std::size_t main = at(card.main);
    sum += 0.5 * dot(apply_tensor(bodies_[i].inertia, state.w[main]) - state.inertia[main] * state.w[main], w_star(main));
  }
  return sum;
}

double RigidBodies::ledger_work(const state::State& state) {
  // Translation of the main node is booked in full by others, with F replaced by the forces on each node; what is left to book:
  //   (F - f_M).dx_M - sum f_I.dx_I - sum m_I.dtheta_I                 [forces counted where they act]
  //   + T*_rot,n - T*_rot,n-1 - m_M.dtheta_M - J (alpha - alpha_Euler).dtheta_M - jump of 1/2 w.Jw     [rotation]
  const double hb = state.times.h_bar;
  double work = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    work += body.switch_work;
    body.switch_work = 0.0;
    if (!body.on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    const std::size_t main = at(card.main);
    const Vec3 moment = body.own_moment + apply_tensor(body.inertia, state.alpha[main] - body.euler_alpha);
    const auto power = [&](double step) {  // of everything that others book, at v + step a
      double p = dot(moment, state.w[main] + step * state.alpha[main]) - dot(sums_[i].force, state.v[main] + step * state.a[main]);
      for (const Index node : card.nodes) {
        const std::size_t s = at(node);
        p += dot(state.f[s], state.v[s] + step * state.a[s]) + dot(state.m[s], state.w[s] + step * state.alpha[s]);
      }
      return p;
    };
    const Vec3 spin = apply_tensor(body.inertia, state.w[main]);
    const double jump = 0.5 * dot(apply_tensor(body.inertia, state.w[main] - body.entry_w), state.w[main] + body.entry_w);
    const double rotation = 0.5 * dot(spin, state.w[main] + hb * state.alpha[main]);
    work += rotation - body.rotation_before - jump - 0.5 * hb * power(0.0);
    body.rotation_before = rotation + 0.5 * hb * power(hb);
  }
  return work;
}

Vec3 RigidBodies::times_inertia(Index body, const Vec3& b) const { return apply_tensor(bodies_[at(body)].inertia, b); }

RigidBodies::Response RigidBodies::response(const state::State& state, Index body, const BoundaryConditions::Held& translation,
                                            const BoundaryConditions::Held& rotation) const {
  const std::size_t main = at(model_->rigid_bodies[at(body)].main);
  Response r{translation.mobility(state.mass[main]), {}, state.x[main]};
  for (int k = 0; k < 3; ++k) {
    Vec3 unit{};
    unit[k] = 1.0;
    r.rotation[static_cast<std::size_t>(k)] = solve_free(bodies_[at(body)].inertia, unit, rotation);
  }
  return r;
}

}  // namespace abut::constraints
