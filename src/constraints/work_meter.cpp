#include "constraints/work_meter.hpp"

#include <cstddef>

#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

double ledger_kinetic_energy(const state::State& state) {
  const double hb = state.times.h_bar;
  double sum = 0.0;
  for (std::size_t i = 0; i < state.mass.size(); ++i) {
    sum += 0.5 * state.mass[i] * dot(state.v[i], state.v[i] + hb * state.a[i]);
    sum += 0.5 * state.inertia[i] * dot(state.w[i], state.w[i] + hb * state.alpha[i]);
  }
  return sum;
}

double ForceWork::settle(const state::State& state, std::span<const Vec3> force, std::span<const Vec3> moment) {
  const double hb = state.times.h_bar;
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    first += dot(force[i], state.v[i]);
    second += dot(force[i], state.v[i] + hb * state.a[i]);
  }
  for (std::size_t i = 0; i < moment.size(); ++i) {
    first += dot(moment[i], state.w[i]);
    second += dot(moment[i], state.w[i] + hb * state.alpha[i]);
  }
  const double booked = 0.5 * hb * first + second_half_;
  second_half_ = 0.5 * hb * second;
  return booked;
}

void StopWork::before(const state::State& state) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    entry_[k] = {state.v[i], state.w[i]};
  }
}

void StopWork::after(const state::State& state) {
  left_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    left_[k] = {state.v[i], state.w[i]};
  }
}

double StopWork::settle(const state::State& state) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    const Entry now = left_.empty() ? Entry{state.v[i], state.w[i]} : left_[k];
    sum += dot(state.f_contact[i] - state.f_internal[i], now.v - entry_[k].v);
    sum -= dot(state.m_internal[i], now.w - entry_[k].w);
  }
  return 0.5 * state.times.h_bar * sum;
}

Vec3 StopWork::gained(const state::State& state, const RigidBodies& bodies) const {
  Vec3 sum;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    if (bodies.body_of(nodes_[k]) == no_index) sum += state.mass[i] * (state.v[i] - entry_[k].v);
  }
  return sum;
}

WorkMeter::WorkMeter(std::vector<Index> nodes, const RigidBodies* bodies)
    : nodes_(std::move(nodes)), bodies_(bodies), entry_(nodes_.size()), da_(nodes_.size()), dalpha_(nodes_.size()) {}

void WorkMeter::before(const state::State& state) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    entry_[k] = {state.v[i], state.w[i], state.a[i], state.alpha[i]};
  }
}

void WorkMeter::after(const state::State& state) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (bodies_ != nullptr && bodies_->body_of(nodes_[k]) != no_index) continue;
    const auto i = static_cast<std::size_t>(nodes_[k]);
    const Kick& e = entry_[k];
    da_[k] += state.a[i] - e.a;
    dalpha_[k] += state.alpha[i] - e.alpha;
    jump_ += 0.5 * state.mass[i] * dot(state.v[i] - e.v, state.v[i] + e.v);
    const Index body = bodies_ == nullptr ? no_index : bodies_->main_of(nodes_[k]);
    const Vec3 dw = state.w[i] - e.w;
    const Vec3 momentum = body == no_index ? state.inertia[i] * dw : bodies_->times_inertia(body, dw);
    jump_ += 0.5 * dot(momentum, state.w[i] + e.w);
  }
}

void WorkMeter::add_force(Index node, const Vec3& force) { forces_.emplace_back(node, force); }

double WorkMeter::settle(const state::State& state) {
  const double hb = state.times.h_bar;
  double first = 0.0, second = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes_[k]);
    const Index body = bodies_ == nullptr ? no_index : bodies_->main_of(nodes_[k]);
    const Vec3 force = state.mass[i] * da_[k];
    const Vec3 moment = body == no_index ? state.inertia[i] * dalpha_[k] : bodies_->times_inertia(body, dalpha_[k]);
    const RigidBodies::Motion moved =
        body == no_index ? RigidBodies::Motion{state.v[i], state.a[i]} : bodies_->carried_motion(nodes_[k], state);
    first += dot(force, moved.v) + dot(moment, state.w[i]);
    second += dot(force, moved.v + hb * moved.a) + dot(moment, state.w[i] + hb * state.alpha[i]);
    da_[k] = dalpha_[k] = Vec3{};
  }
  for (const auto& [node, force] : forces_) {
    const auto i = static_cast<std::size_t>(node);
    first += dot(force, state.v[i]);
    second += dot(force, state.v[i] + hb * state.a[i]);
  }
  forces_.clear();
  const double booked = jump_ + 0.5 * hb * first + second_half_;
  jump_ = 0.0;
  second_half_ = 0.5 * hb * second;
  return booked;
}

}  // namespace abut::constraints
