#include "cycle/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "abut/diagnostic.hpp"
#include "constraints/rigid_bodies.hpp"
#include "model/step_scale.hpp"
#include "parallel/ordered_sum.hpp"

namespace abut::cycle {

namespace {
/// Numerics.md 2.3: added mass brings the node a hair above the wanted step, so that rounding does not ask for more in the next cycle.
/// The cycle that adds mass takes the wanted step itself.
constexpr double scaling_margin = 1.00001;
}  // namespace

TimeStep::Smallest& TimeStep::Smallest::operator+=(const Smallest& b) {
  if (b.square < square) *this = b;
  return *this;
}

TimeStep::TimeStep(const model::Model& model, const Profile& profile, bool has_two_sided_interface,
                   std::vector<std::uint8_t> free_translation, std::vector<std::uint8_t> free_rotation)
    : model_(model),
      profile_(profile),
      two_sided_(has_two_sided_interface),
      free_flight_(model),
      free_translation_(std::move(free_translation)),
      free_rotation_(std::move(free_rotation)),
      nodal_scale_(model::system_step_scale(model)) {
  const model::Controls& c = model.controls;
  if (c.mass_scaling) {
    scaled_.assign(static_cast<std::size_t>(model.node_count()), c.mass_scaling_nodes ? 0 : 1);
    if (c.mass_scaling_nodes) {
      for (const Index n : *c.mass_scaling_nodes) scaled_[static_cast<std::size_t>(n)] = 1;
    }
  }
}

TimeStep::Smallest TimeStep::nodal(const state::State& s, bool rotations, parallel::ThreadPool& pool) {
  LimitArgs args;
  args.mass = s.mass.data();
  args.stiffness = s.stiffness.data();
  args.inertia = rotations ? s.inertia.data() : nullptr;
  args.rotational_stiffness = s.rotational_stiffness.data();
  // All nodes are free for the reference; only those that can move give a true limit.
  const bool all = profile_.system_step == Profile::SystemStep::reference;
  args.free_translation = all ? nullptr : free_translation_.data();
  args.free_rotation = all ? nullptr : free_rotation_.data();
  const NodeKernels& kernels = node_kernels();
  return parallel::ordered_sum(s.mass.size(), leaves_, pool, [&](std::size_t begin, std::size_t end) {
    Smallest smallest;
    kernels.limit(args, begin, end, smallest);
    return smallest;
  });
}

double TimeStep::scale_masses(state::State& s, constraints::RigidBodies& bodies) {
  scaled_node_ = no_index;
  if (scaled_.empty() || model_.controls.nodal_minimum <= 0.0) return 0.0;
  if (added_.empty()) added_.assign(s.mass.size(), 0.0);
  const double wanted = model_.controls.nodal_minimum / nodal_scale_;
  const double half_square = 0.5 * wanted * wanted;
  const bool all = profile_.system_step == Profile::SystemStep::reference;
  double energy = 0.0;
  for (std::size_t i = 0; i < s.mass.size(); ++i) {
    if (scaled_[i] == 0) continue;
    const auto node = static_cast<Index>(i);
    const Index body = bodies.main_of(node);
    if ((all || free_translation_[i] != 0) && s.mass[i] > 0.0 && s.stiffness[i] * half_square > s.mass[i]) {
      const double more = scaling_margin * s.stiffness[i] * half_square - s.mass[i];
      s.mass[i] += more;
      if (body != no_index) bodies.add_mass(body, more);
      added_[i] += more;
      added_mass_ += more;
      energy += 0.5 * more * squared_norm(body == no_index ? s.v[i] : bodies.centre_velocity(body, s));
      if (scaled_node_ == no_index) scaled_node_ = node;
    }
    if ((all || free_rotation_[i] != 0) && s.inertia[i] > 0.0 && s.rotational_stiffness[i] * half_square > s.inertia[i]) {
      const double wanted_inertia = scaling_margin * s.rotational_stiffness[i] * half_square;
      if (body != no_index) {
        energy += bodies.scale_inertia(body, wanted_inertia / s.inertia[i], s);
      } else {
        energy += 0.5 * (wanted_inertia - s.inertia[i]) * squared_norm(s.w[i]);
        s.inertia[i] = wanted_inertia;
      }
      if (scaled_node_ == no_index) scaled_node_ = node;
    }
  }
  return energy;
}

Index TimeStep::first_beyond(double ratio, const state::State& s) const {
  if (ratio <= 0.0) return no_index;
  for (std::size_t i = 0; i < added_.size(); ++i) {
    const double first = s.mass[i] - added_[i];
    if (first > 0.0 && added_[i] > ratio * first) return static_cast<Index>(i);
  }
  return no_index;
}

void TimeStep::refuse_endless(const state::State& s, double step, const StepController& who) {
  constexpr double most_cycles = 1e13;
  const model::Controls& control = model_.controls;
  const bool stands_still = !(s.times.t + step > s.times.t);
  // A first step of the deck grows, but not beyond the largest.
  const bool chosen = step >= control.dt_initial && control.dt_initial > 0.0 && control.t_end <= most_cycles * control.dt_max;
  const bool endless = s.times.cycle == 0 && !chosen && control.t_end < 1e29 && control.t_end > most_cycles * step;
  const double collapsed = mean_of_collapse(s, step);
  if (!stands_still && !endless && collapsed <= 0.0) return;
  using Kind = StepController::Kind;
  const bool node = who.kind == Kind::node || who.kind == Kind::contact_node;
  const bool element = who.kind == Kind::shell || who.kind == Kind::sh3n || who.kind == Kind::brick || who.kind == Kind::tetra;
  const std::string by = node                          ? fmt::format(" of node {}", who.id)
                         : element                     ? fmt::format(" of element {}", who.id)
                         : who.kind == Kind::interface ? fmt::format(" of interface {}", who.id)
                                                       : "";
  const std::string where =
      fmt::format("(cycle {}, time {:.6g}): look at the mass, stiffness and gap there, and at the limits of /DT", s.times.cycle, s.times.t);
  if (collapsed > 0.0) {
    throw RunError(fmt::format("the time step{} has collapsed from {:.4g} to {:.4g}: the end time {:.6g} is {:.0e} cycles away {}", by,
                               largest_step_, step, control.t_end, (control.t_end - s.times.t) / collapsed, where));
  }
  throw RunError(fmt::format("the time step {:.4g}{} does not get to the end time {:.6g} in {} {}", step, by, control.t_end,
                             stands_still ? "any number of cycles" : fmt::format("{:.0e} cycles", most_cycles), where));
}

double TimeStep::mean_of_collapse(const state::State& s, double step) {
  constexpr std::int64_t window = 10000;  // cycles: a step that contact or a deck shortens for a while grows back within some hundred
  constexpr double fallen = 1e-6, most_cycles = 1e9;
  largest_step_ = std::max(largest_step_, step);
  if (s.times.cycle == 0 || s.times.cycle % window != 0) return 0.0;
  const double mean = (s.times.t - window_time_) / static_cast<double>(window);
  window_time_ = s.times.t;
  const double left = model_.controls.t_end - s.times.t;
  return mean < fallen * largest_step_ && left < 1e29 && left > most_cycles * mean ? mean : 0.0;
}

StepController TimeStep::choose(state::State& s, const StepLimits& limits, std::span<const double> contact_stiffness,
                                parallel::ThreadPool& pool) {
  const model::Controls& control = model_.controls;
  StepController who;
  double step = 1e30;
  const auto take = [&](double candidate, const StepController& controller) {
    if (candidate < step) {
      step = candidate;
      who = controller;
    }
  };
  const bool reference = profile_.system_step == Profile::SystemStep::reference;
  const bool nodal_only = control.nodal_step || !reference;
  if (!nodal_only) take(limits.element, limits.element_controller);
  if (nodal_only || two_sided_) {
    const Smallest smallest = nodal(s, nodal_only, pool);
    if (smallest.node >= 0) {
      const auto i = static_cast<std::size_t>(smallest.node);
      const bool contact = !smallest.rotation && contact_stiffness[i] > 0.5 * s.stiffness[i];
      take(nodal_scale_ * std::sqrt(smallest.square),
           {contact ? StepController::Kind::contact_node : StepController::Kind::node, model_.node_id[i]});
    }
  }
  if (scaled_node_ != no_index) {
    take(control.nodal_minimum, {StepController::Kind::node, model_.node_id[static_cast<std::size_t>(scaled_node_)]});
  }
  if (!reference || two_sided_) take(limits.interface_step, limits.interface_controller);
  if (control.dt_max < step) take(control.dt_max, {StepController::Kind::fixed, 0});
  if (s.times.cycle == 0 && control.dt_initial > 0.0 && control.dt_initial < step)
    take(control.dt_initial, {StepController::Kind::fixed, 0});
  const bool any = step > 1e29;  // nothing deforms: any step is stable
  if (1.1 * previous_step_ < step) step = 1.1 * previous_step_;
  if (any) step = std::min(step, free_flight_.step(s));
  refuse_endless(s, step, who);
  previous_step_ = step;
  s.times.h_plus = step;
  s.times.h_bar = 0.5 * (s.times.h_minus + step);
  return who;
}

}  // namespace abut::cycle
