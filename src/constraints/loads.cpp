#include "constraints/loads.hpp"

#include <algorithm>
#include <cstddef>

#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

namespace {

std::vector<Index> loaded_nodes(const model::Model& model) {
  std::vector<Index> nodes;
  for (const model::Gravity& g : model.gravities) nodes.insert(nodes.end(), g.nodes.begin(), g.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

Loads::Loads(const model::Model& model, const Curves& curves, const Axes& axes) : model_(&model), curves_(&curves), axes_(&axes) {
  if (!model.pressure_loads.empty()) pressure_.resize(static_cast<std::size_t>(model.node_count()));
}

void Loads::erode(const std::function<std::vector<model::ElementRef>(const std::array<Index, 4>&)>& owners,
                  const std::function<bool(const model::ElementRef&)>& alive) {
  gone_.resize(model_->pressure_loads.size());
  for (std::size_t i = 0; i < gone_.size(); ++i) {
    const auto& segments = model_->pressure_loads[i].segments;
    gone_[i].assign(segments.size(), 0);
    for (std::size_t j = 0; j < segments.size(); ++j) {
      const std::vector<model::ElementRef> elements = owners(segments[j]);
      gone_[i][j] = !elements.empty() && std::none_of(elements.begin(), elements.end(), alive) ? 1 : 0;
    }
  }
}

void Loads::apply(state::State& state) {
  const double t = state.times.t;
  std::fill(state.f_external.begin(), state.f_external.end(), Vec3{});
  std::fill(state.m_external.begin(), state.m_external.end(), Vec3{});
  for (const model::ConcentratedLoad& load : model_->concentrated_loads) {
    if (!curves_->on(load.sensor, t)) continue;
    const Vec3 axis = axes_->axis(load.skew, load.direction % 3);
    const Vec3 force = curves_->scaled(load.function, load.sensor, load.scale_x, load.scale_y, t) * axis;
    state::ZeroArray<Vec3>& target = load.direction < 3 ? state.f_external : state.m_external;
    for (const Index node : load.nodes) target[static_cast<std::size_t>(node)] += force;
  }
  if (!pressure_.empty()) add_pressure(state);
}

void Loads::add_pressure(state::State& state) {
  const double t = state.times.t;
  std::fill(pressure_.begin(), pressure_.end(), Vec3{});
  for (std::size_t i = 0; i < model_->pressure_loads.size(); ++i) {
    const model::PressureLoad& load = model_->pressure_loads[i];
    if (!curves_->on(load.sensor, t)) continue;
    const double p = curves_->scaled(load.function, load.sensor, load.scale_x, load.scale_y, t);
    for (std::size_t j = 0; j < load.segments.size(); ++j) {
      if (!gone_.empty() && gone_[i][j] != 0) continue;
      const std::array<Index, 4>& segment = load.segments[j];
      const auto at = [&](std::size_t k) { return state.x[static_cast<std::size_t>(segment[k])]; };
      const bool triangle = segment[3] == segment[2] || segment[3] == no_index;
      const Vec3 force = triangle ? p / 6.0 * cross(at(2) - at(0), at(2) - at(1)) : p / 8.0 * cross(at(2) - at(0), at(3) - at(1));
      for (std::size_t k = 0; k < (triangle ? 3U : 4U); ++k) pressure_[static_cast<std::size_t>(segment[k])] += force;
    }
  }
  for (std::size_t i = 0; i < pressure_.size(); ++i) state.f_external[i] += pressure_[i];
}

double Loads::book_work(const state::State& state) {
  const state::StepTimes& times = state.times;
  double work = 0.0;
  for (const model::ConcentratedLoad& load : model_->concentrated_loads) {
    if (!curves_->on(load.sensor, times.t)) continue;
    const Vec3 axis = axes_->axis(load.skew, load.direction % 3);
    const double now = curves_->scaled(load.function, load.sensor, load.scale_x, load.scale_y, times.t);
    const double old = curves_->scaled(load.function, load.sensor, load.scale_x, load.scale_y, times.t - times.h_minus);
    const state::ZeroArray<Vec3>& velocity = load.direction < 3 ? state.v : state.w;
    double rate = 0.0;
    for (const Index node : load.nodes) rate += dot(velocity[static_cast<std::size_t>(node)], axis);
    work += 0.5 * (old + now) * rate * times.h_plus;
  }
  double power = 0.0;
  for (std::size_t i = 0; i < pressure_.size(); ++i) power += dot(pressure_[i], state.v[i]);
  return work + power * times.h_minus;
}

Gravities::Gravities(const model::Model& model, const Curves& curves, const Axes& axes, const RigidBodies& bodies)
    : model_(&model), curves_(&curves), axes_(&axes), bodies_(&bodies), meter_(loaded_nodes(model), &bodies) {}

void Gravities::apply(state::State& state) {
  const double t = state.times.t;
  meter_.before(state);
  for (const model::Gravity& g : model_->gravities) {
    if (!curves_->on(g.sensor, t)) continue;
    const Vec3 a = curves_->scaled(g.function, g.sensor, g.scale_x, g.scale_y, t) * axes_->axis(g.skew, g.direction);
    for (const Index node : g.nodes) {
      if (bodies_->body_of(node) == no_index) state.a[static_cast<std::size_t>(node)] += a;
    }
  }
  meter_.after(state);
}

double Gravities::book_work(const state::State& state) {
  const state::StepTimes& times = state.times;
  double work = 0.0;
  for (const model::Gravity& g : model_->gravities) {
    if (!curves_->on(g.sensor, times.t)) continue;
    const Vec3 axis = axes_->axis(g.skew, g.direction);
    const double now = curves_->scaled(g.function, g.sensor, g.scale_x, g.scale_y, times.t);
    const double old = curves_->scaled(g.function, g.sensor, g.scale_x, g.scale_y, times.t - times.h_minus);
    double momentum = 0.0;
    for (const Index node : g.nodes) {
      if (bodies_->body_of(node) != no_index) continue;
      const auto i = static_cast<std::size_t>(node);
      momentum += state.mass[i] * dot(state.v[i], axis);
    }
    work += 0.5 * (old + now) * momentum * times.h_minus;
  }
  return work;
}

}  // namespace abut::constraints
