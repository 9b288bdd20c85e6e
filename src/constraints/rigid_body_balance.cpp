// Energy, momentum and ledger of rigid bodies.
#include <cstddef>

#include "constraints/body_tensor.hpp"
#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

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
    if (bodies_[i].beside) {
      const Vec3 v = state.v[main] + half * state.a[main], centre = bodies_[i].centre_v + half * bodies_[i].centre_a;
      sum.translation += 0.5 * state.mass[main] * (squared_norm(centre) - squared_norm(v));
      sum.momentum += state.mass[main] * (centre - v);
    }
    const Vec3 w = state.w[main] + half * state.alpha[main];
    sum.rotation += 0.5 * dot(w, times(bodies_[i].inertia, w)) - 0.5 * state.inertia[main] * squared_norm(w);
  }
  return sum;
}

RigidBodies::Motion RigidBodies::carried_motion(Index node, const state::State& state) const {
  const Index body = main_of(node);
  if (body != no_index && bodies_[at(body)].beside) return {bodies_[at(body)].centre_v, bodies_[at(body)].centre_a};
  return {state.v[at(node)], state.a[at(node)]};
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
    if (bodies_[i].beside) {
      const Vec3 &v = state.v[main], &centre = bodies_[i].centre_v;
      sum += 0.5 * state.mass[main] * (dot(centre, centre + hb * bodies_[i].centre_a) - dot(v, v + hb * state.a[main]));
    }
    sum += 0.5 * dot(times(bodies_[i].inertia, state.w[main]) - state.inertia[main] * state.w[main], w_star(main));
  }
  return sum;
}

double RigidBodies::switch_work(const state::State& state) const {
  double work = 0.0;
  for (const Body& body : bodies_) work += body.switch_work + 0.5 * state.times.h_bar * body.switch_power;
  return work;
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
    body.switch_work = body.switch_power = 0.0;
    if (!body.on) continue;
    const model::RigidBody& card = model_->rigid_bodies[i];
    const std::size_t main = at(card.main);
    const Vec3 moment = body.own_moment + times(body.inertia, state.alpha[main] - body.euler_alpha);
    const auto power = [&](double step) {  // of everything that others book, at v + step a
      double p = dot(moment, state.w[main] + step * state.alpha[main]);
      const Vec3 v = state.v[main] + step * state.a[main];
      p -= dot(sums_[i].force, v);
      if (body.beside) {  // hold_work() books where hold() acts
        p += dot(body.held_force, v - body.centre_v - step * body.centre_a);
        p += dot(body.held_moment, state.w[main] + step * state.alpha[main]);
      }
      if (body.beside) p -= dot(state.f[main], body.centre_v + step * body.centre_a - v);  // the body's force acts on its centre
      for (const Index node : card.nodes) {
        const std::size_t s = at(node);
        p += dot(state.f[s], state.v[s] + step * state.a[s]) + dot(state.m[s], state.w[s] + step * state.alpha[s]);
      }
      return p;
    };
    const Vec3 spin = times(body.inertia, state.w[main]);
    const double jump = 0.5 * dot(times(body.inertia, state.w[main] - body.entry_w), state.w[main] + body.entry_w);
    const double rotation = 0.5 * dot(spin, state.w[main] + hb * state.alpha[main]);
    work += rotation - body.rotation_before - jump - 0.5 * hb * power(0.0);
    body.rotation_before = rotation + 0.5 * hb * power(hb);
  }
  return work;
}

}  // namespace abut::constraints
