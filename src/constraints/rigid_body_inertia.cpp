// Masses and inertia of rigid bodies, and how they are switched on and off.
#include <algorithm>
#include <cstddef>

#include "constraints/body_tensor.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rotation.hpp"

namespace abut::constraints {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

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
  body.beside = conserving_ && icog == 3 && !bound_[index] && m0 + secondary_mass > 0.0;
  const Vec3 centre = body.beside ? (m0 * old + moment) / (m0 + secondary_mass) : state.x[main];
  body.centre = centre;
  body.beside = body.beside && !(centre == old);
  body.relative = body.centre_v = body.centre_a = Vec3{};

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

void RigidBodies::take_axis_spins() {
  if (bodies_.empty()) return;
  std::vector<Vec3> spin(at(model_->node_count()));
  for (const model::InitialVelocity& v : model_->initial_velocities) {
    if (v.rotational) continue;
    for (const Index n : v.nodes) spin[at(n)] = v.spin;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].axis_spin = spin[at(model_->rigid_bodies[i].main)];
}

void RigidBodies::switch_on(std::size_t index, state::State& state, bool at_start) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  Body& body = bodies_[index];
  const std::size_t main = at(card.main);
  const auto follow_centre = [&] {
    if (!body.beside) return;
    body.relative = cross(state.w[main], state.x[main] - body.centre);
    body.centre_v = state.v[main] - body.relative;
  };
  const double power_before = structure_power(index, state);
  if (at_start) {
    const Vec3 typed = state.x[main];
    compute_inertia(index, state, card.sensor == no_index ? card.icog : 3, card.sensor == no_index);
    // A velocity typed for the main node is the body's; of a rotation about an axis, the one where the node has moved to.
    state.v[main] += cross(body.axis_spin, state.x[main] - typed);
    follow_centre();
  } else {
    // Perfectly plastic impact: the body takes over the momentum and the angular momentum of its nodes.
    const double before = free_energy(index, state);
    const Vec3 own_momentum = state.mass[main] * state.v[main];
    Vec3 momentum = own_momentum;
    Vec3 spin = state.inertia[main] * state.w[main];
    compute_inertia(index, state, 3, false);
    for (const Index node : card.nodes) {
      const Vec3 p = state.mass[at(node)] * state.v[at(node)];
      momentum += p;
      spin += cross(state.x[at(node)] - centre_of(static_cast<Index>(index), state), p) + state.inertia[at(node)] * state.w[at(node)];
    }
    spin += cross(state.x[main] - centre_of(static_cast<Index>(index), state), own_momentum);
    state.w[main] = times_inverse(body.inertia, spin);
    if (state.mass[main] > 0.0) state.v[main] = momentum / state.mass[main];
    if (body.beside) state.v[main] += cross(state.w[main], state.x[main] - body.centre);
    follow_centre();
    claim(index, true);
    body.switch_work += rigid_energy(index, state) - before;
  }
  for (const Index node : card.nodes) {
    state.v[at(node)] = state.v[main] + cross(state.w[main], state.x[at(node)] - state.x[main]);
    state.w[at(node)] = state.w[main];
  }
  if (!at_start) body.switch_power = structure_power(index, state) - power_before;
  body.rotation_before = 0.5 * dot(state.w[main], times(body.inertia, state.w[main]));
}

void RigidBodies::switch_off(std::size_t index, state::State& state) {
  const model::RigidBody& card = model_->rigid_bodies[index];
  Body& body = bodies_[index];
  const double before = rigid_energy(index, state);
  state.mass[at(card.main)] = body.own_mass;
  state.inertia[at(card.main)] = body.own_inertia;
  claim(index, false);
  body.beside = false;
  // The second halves of the last cycle are booked here: rigid_energy() is the rotational energy that T* has grown to.
  body.switch_work += free_energy(index, state) - before;
  body.switch_work += 0.5 * dot(state.w[at(card.main)], times(body.inertia, state.w[at(card.main)])) - body.rotation_before;
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

double RigidBodies::structure_power(std::size_t index, const state::State& state) const {
  const model::RigidBody& card = model_->rigid_bodies[index];
  const auto power = [&](std::size_t i) {
    return dot(state.f_contact[i] - state.f_internal[i], state.v[i]) - dot(state.m_internal[i], state.w[i]);
  };
  double sum = power(at(card.main));
  for (const Index node : card.nodes) sum += power(at(node));
  return sum;
}

double RigidBodies::rigid_energy(std::size_t index, const state::State& state) const {
  const std::size_t main = at(model_->rigid_bodies[index].main);
  return 0.5 * state.mass[main] * squared_norm(centre_velocity(static_cast<Index>(index), state)) +
         0.5 * dot(state.w[main], times(bodies_[index].inertia, state.w[main]));
}

Vec3 RigidBodies::centre_velocity(Index body, const state::State& state) const {
  const Vec3& v = state.v[at(model_->rigid_bodies[at(body)].main)];
  return bodies_[at(body)].beside ? v - bodies_[at(body)].relative : v;
}

double RigidBodies::scale_inertia(Index index, double factor, state::State& state) {
  Body& body = bodies_[at(index)];
  const std::size_t main = at(model_->rigid_bodies[at(index)].main);
  const double energy = 0.5 * (factor - 1.0) * dot(state.w[main], times(body.inertia, state.w[main]));
  for (double& principal : body.inertia.principal) principal *= factor;
  state.inertia[main] *= factor;
  body.rotation_before += energy;  // brought from outside, not made by the rotation's numerics
  return energy;
}

Vec3 RigidBodies::times_inertia(Index body, const Vec3& b) const { return times(bodies_[at(body)].inertia, b); }

Vec3 RigidBodies::times_inverse_inertia(Index body, const Vec3& b) const { return times_inverse(bodies_[at(body)].inertia, b); }

}  // namespace abut::constraints
