#include "constraints/imposed_motions.hpp"

#include <algorithm>
#include <cstddef>

#include "constraints/rigid_bodies.hpp"

namespace abut::constraints {

namespace {

std::vector<Index> moved_nodes(const model::Model& model) {
  std::vector<Index> nodes;
  for (const model::ImposedMotion& m : model.imposed_motions) nodes.insert(nodes.end(), m.nodes.begin(), m.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

ImposedMotions::ImposedMotions(const model::Model& model, const Curves& curves, const Axes& axes, RigidBodies& bodies)
    : model_(&model),
      curves_(&curves),
      axes_(&axes),
      bodies_(&bodies),
      reaction_(model.imposed_motions.size(), 0.0),
      meter_(moved_nodes(model), &bodies) {
  for (std::size_t i = 0; i < model.imposed_motions.size(); ++i) {
    for (const Index node : model.imposed_motions[i].nodes) dofs_.push_back({static_cast<Index>(i), node});
  }
}

bool ImposedMotions::acts(const Dof& dof, const model::ImposedMotion& motion, double t) const {
  return t >= motion.t_start && t <= motion.t_stop && curves_->on(motion.sensor, t) && bodies_->body_of(dof.node) == no_index;
}

double ImposedMotions::wanted_acceleration(const model::ImposedMotion& motion, const state::StepTimes& times, double v,
                                           double reached) const {
  using Kind = model::ImposedMotion::Kind;
  const double t = times.t, h = times.h_plus, hb = times.h_bar;
  const auto curve = [&](double at) { return curves_->scaled(motion.function, motion.sensor, motion.scale_x, motion.scale_y, at); };
  if (motion.kind == Kind::acceleration) return curve(t + h);
  if (motion.kind == Kind::velocity) return (curve(t + 0.5 * h) - v) / hb;
  const double way = motion.sensor != no_index ? curve(t + h) - curve(t) : curve(t + h) - reached;
  return (way / h - v) / hb;
}

void ImposedMotions::turn_bodies(state::State& state, const BoundaryConditions& conditions) {
  turns_.clear();
  for (const Dof& dof : dofs_) {
    const model::ImposedMotion& motion = model_->imposed_motions[static_cast<std::size_t>(dof.motion)];
    if (motion.direction < 3 || !bodies_->turns(dof.node) || !acts(dof, motion, state.times.t)) continue;
    auto turn = std::find_if(turns_.begin(), turns_.end(), [&](const Turn& t) { return t.node == dof.node; });
    if (turn == turns_.end()) turn = turns_.insert(turn, {dof.node, conditions.held(dof.node, true), {}, {}});
    const Vec3 axis = axes_->axis(motion.skew, motion.direction % 3);
    const double v = dot(state.w[static_cast<std::size_t>(dof.node)], axis);
    const double missing = wanted_acceleration(motion, state.times, v, dof.angle) - dot(turn->given, axis);
    const int before = turn->held.count;
    turn->held.add(axis);
    if (turn->held.count == before) continue;  // held, or turned by another motion
    const Vec3& added = turn->held.axis[static_cast<std::size_t>(before)];
    turn->given += missing / dot(added, axis) * added;
  }
  for (Turn& turn : turns_) turn.moment = bodies_->turn(turn.node, state, turn.held, turn.given);
}

void ImposedMotions::apply(state::State& state, const BoundaryConditions& conditions) {
  const state::StepTimes& times = state.times;
  const double t = times.t, h = times.h_plus, hb = times.h_bar;
  turn_bodies(state, conditions);
  meter_.before(state);
  for (const Turn& turn : turns_) {
    state.alpha[static_cast<std::size_t>(turn.node)] += bodies_->times_inverse_inertia(bodies_->main_of(turn.node), turn.moment);
  }
  std::fill(reaction_.begin(), reaction_.end(), 0.0);
  for (Dof& dof : dofs_) {
    const auto m = static_cast<std::size_t>(dof.motion);
    const auto i = static_cast<std::size_t>(dof.node);
    const model::ImposedMotion& motion = model_->imposed_motions[m];
    dof.old_power = dof.power;
    dof.power = 0.0;
    dof.active = acts(dof, motion, t);
    const bool rotation = motion.direction >= 3;
    const Vec3 axis = axes_->axis(motion.skew, motion.direction % 3);
    Vec3& acceleration = rotation ? state.alpha[i] : state.a[i];
    const bool held = bodies_->holds(dof.node);  // its entries of v and a are those of the centre
    const Vec3 point_v = held ? state.v[i] + bodies_->relative_velocity(bodies_->main_of(dof.node)) : state.v[i];
    const double v = dot(rotation ? state.w[i] : point_v, axis);
    const double free = dot(acceleration, axis);
    if (held && rotation) dof.angle += times.h_minus * v;
    if (dof.active) {
      const double imposed = wanted_acceleration(motion, times, v, rotation ? dof.angle : dot(state.u[i], axis));
      if (held) {
        dof.wanted = v + hb * imposed;
        continue;
      }
      double force = 0.0;
      if (rotation && bodies_->turns(dof.node)) {
        for (const Turn& turn : turns_) force += turn.node == dof.node ? dot(axis, turn.moment) : 0.0;
      } else {
        const double change = imposed - free;
        acceleration += change * axis;
        const Index body = rotation ? bodies_->main_of(dof.node) : no_index;
        const double resistance = !rotation          ? state.mass[i]
                                  : body == no_index ? state.inertia[i]
                                                     : dot(axis, bodies_->times_inertia(body, axis));
        force = resistance * change;
      }
      dof.power = 0.5 * force * (v + 0.5 * hb * imposed);
      reaction_[m] += force;
    }
    // Rotation is not a nodal state: it is summed here, with the velocity that this step will have.
    if (rotation && !held) dof.angle += h * (v + hb * dot(acceleration, axis));
  }
  meter_.after(state);
}

double ImposedMotions::half_step_energy(const state::State& state) const {
  double twice = 0.0;
  for (const Index node : meter_.nodes()) {
    const auto i = static_cast<std::size_t>(node);
    twice += state.mass[i] * squared_norm(state.v[i]) + state.inertia[i] * squared_norm(state.w[i]);
  }
  return 0.5 * twice;
}

void ImposedMotions::persist(state::Archive& a) {
  a.each(dofs_, [&a](Dof& dof) {
    a(dof.angle);
    a(dof.power);
    a(dof.old_power);
    a(dof.active);
  });
  a.fixed(reaction_);
  meter_.persist(a);
}

void ImposedMotions::add_imposed(Index node, bool rotation, BoundaryConditions::Held& held) const {
  for (const Dof& dof : dofs_) {
    const model::ImposedMotion& motion = model_->imposed_motions[static_cast<std::size_t>(dof.motion)];
    const bool same_kind = (motion.direction >= 3) == rotation;
    if (dof.node == node && dof.active && same_kind) held.add(axes_->axis(motion.skew, motion.direction % 3));
  }
}

double ImposedMotions::book_work(const state::State& state) {
  double work = 0.0;
  for (const Dof& dof : dofs_) {
    if (dof.active) work += (dof.old_power + dof.power) * state.times.h_minus;
  }
  return work;
}

}  // namespace abut::constraints
