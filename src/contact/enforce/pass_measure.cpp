// What a node of a pass sees: distance, facet, penetration and the pair's force, by the closest point or by the plain rule.
#include <algorithm>
#include <cmath>

#include "contact/enforce/pass.hpp"
#include "contact/project/plain.hpp"
#include "contact/search/swept.hpp"

namespace abut::contact {
namespace {

constexpr double never = 1e300;  // offset of a node that is ignored

Patch patch_at(const Side& side, std::span<const Vec3> x, Index f) {
  Patch patch = side.patch(f);
  const std::array<Index, 4>& local = side.surface().local()[at(f)];
  for (std::size_t i = 0; i < 4; ++i) patch.x[i] = x[at(local[i])];
  return patch;
}

}  // namespace

bool Pass::far(const HostState& host, const Side& held, const SideLoads& held_loads, Index i) const {
  // Neither the motion of the last step nor that of the coming one may come near a quarter of the way.
  const double clear = 0.25 * std::min(smallest_depth_, candidates_.nearest_due(i) - candidates_.clock() - options_.gap) - surface_step_;
  if (clear <= 0.0) return false;
  const Vec3 coming = host.dt * host.v[at(held.nodes()[at(i)])] - mean_step_;
  const Vec3 last = held.x()[at(i)] - held_loads.x_before[at(i)] - mean_step_;
  return std::max(squared_norm(last), squared_norm(coming)) < clear * clear;
}

Index Pass::swept_facet(const Side& held, const Side& surface, const SideLoads& held_loads, const SideLoads& surface_loads, Index i) const {
  const Vec3 x = held.x()[at(i)];
  const Vec3 before = held_loads.x_before[at(i)];
  if (norm(x - before - mean_step_) + surface_step_ <= smallest_depth_) return no_index;
  Bounds path;
  path.include(x);
  path.include(before + mean_step_);
  Index hit = no_index;
  double earliest = 2.0;
  candidates_.near(path, surface_step_, [&](Index f) {
    if (!surface.active(f)) return;
    for (const Index n : surface.surface().facets()[at(f)].node) {
      if (n == held.nodes()[at(i)]) return;
    }
    const Crossing c = crosses(patch_at(surface, surface_loads.x_before, f), before, surface.patch(f), x);
    if (c.crossed && (c.fraction < earliest || (c.fraction == earliest && f < hit))) {
      earliest = c.fraction;
      hit = f;
    }
  });
  return hit;
}

void Pass::measure_closest(const HostState& host, const Side& held, const Side& surface, const SideLoads& held_loads,
                           const SideLoads& surface_loads, Index i, Touch& touch) {
  const NodeState& before = state_[at(i)];
  NodeState& after = next_[at(i)];
  touch = {};
  if (!held.node_active(i)) return;
  const Vec3 x = held.x()[at(i)];
  const bool was_held = before.held != 0 && before.facet != no_index && surface.active(before.facet);
  if (before.in_front != 0 && !was_held && before.ignored == 0 && host.dt > 0.0 && !candidates_.of(i).empty()) {
    if (far(host, held, held_loads, i)) {
      touch.far = true;
      after.offset = 0.0;
      return;
    }
  }
  Measure m;
  if (was_held || !candidates_.of(i).empty())
    m = nearest(surface, candidates_, i, x, was_held ? HeldBy{before.facet, before.normal} : HeldBy{});
  const auto take = [&](const Measure& measure) {
    touch.facet = measure.facet;
    touch.known = true;
    touch.weight = measure.closest.weight;
    touch.point = measure.closest.point;
    touch.normal = measure.normal;
    touch.distance = measure.distance;
  };
  bool meets = false;
  double gap = options_.gap;
  after.in_front = m.found() && !m.closest.beyond && m.distance >= 0.0 ? 1 : 0;
  if (m.found()) {
    take(m);
    gap = gap_of(m.distance, after);
    meets = !m.closest.beyond && gap - m.distance > 0.0;
    touch.lost = was_held && m.closest.beyond && gap - m.distance > 0.0;
    if (!m.closest.beyond && m.distance >= 0.0) after.ignored = 0;
    if (meets && !was_held && m.distance < 0.0 && !options_.rules.unlimited_depth) {
      const double depth = depth_[at(m.facet)];
      const double came_from = m.distance - host.dt * kinematics(host, held, surface, i, touch).rate;
      if (-m.distance > depth || (host.dt > 0.0 && came_from < -depth)) after.ignored = 1;
      if (after.ignored != 0) meets = false;
    }
  } else {
    after.ignored = 0;
    after.offset = 0.0;
  }
  if (!meets && !was_held && before.ignored == 0 && after.offset == 0.0 && host.dt > 0.0) {
    const Index hit = swept_facet(held, surface, held_loads, surface_loads, i);
    if (hit != no_index) {
      const Measure caught = descend_to_nearest(surface, hit, x);
      if (!caught.closest.beyond && caught.distance < 0.0) {
        m = caught;
        take(m);
        meets = true;
        touch.fresh_hit = true;
        after.ignored = 0;
      }
    }
  }
  if (!touch.known) return;
  touch.penetration = gap - m.distance;
  touch.pair = pair_force(surface, m, x, law_, gap, options_.stiffness_scale, held.node_stiffness(i), half_of_facet_);
  touch.contact = meets && touch.pair.magnitude > 0.0;
}

double Pass::growth(const NodeState& before) const { return before.offset < never ? (1.0 - keep_) * before.offset : 0.0; }

double Pass::gap_of(double distance, NodeState& after) const {
  const double full = options_.gap - distance;
  if (!settled_) {
    if (full > 0.0 && (options_.initial == Initial::offset || options_.start_duration > 0.0)) after.offset = full;
    if (full > 0.0 && options_.initial == Initial::ignore) after.offset = never;
  } else if (full <= 0.0) {
    after.offset = 0.0;
  } else if (after.offset < never) {
    after.offset = std::min(keep_ * after.offset, full);  // what the node has moved away is gap again
  }
  return options_.gap - after.offset;
}

double Pass::plain_stiffness(const Side& held, const Side& surface, Index i, Index facet) const {
  const double k1 = surface.facet_stiffness(facet);
  const double k2 = held.node_stiffness(i);
  if (half_of_facet_) return 0.5 * options_.stiffness_scale * k1;
  return k1 + k2 > 0.0 ? options_.stiffness_scale * k1 * k2 / (k1 + k2) : 0.0;
}

void Pass::measure_plain(const Side& held, const Side& surface, Index i, Touch& touch) {
  touch = {};
  const Tracked& t = tracked_[at(i)];
  if (t.facet == no_index || !surface.active(t.facet) || !held.node_active(i)) return;
  const Vec3 x = held.x()[at(i)];
  const PlainPoint p = project_plain(surface.patch(t.facet), x, options_.gap, options_.rules.area_ratio_projection);
  if (!p.inside) return;
  touch.known = true;
  touch.facet = t.facet;
  touch.weight = p.weight;
  touch.point = p.point;
  touch.normal = p.normal;
  touch.distance = p.distance;
  const double penetration = gap_of(p.distance, next_[at(i)]) - p.distance;
  touch.penetration = penetration;
  PairForce& pair = touch.pair;
  pair.stiffness = plain_stiffness(held, surface, i, t.facet);
  if (penetration <= 0.0) return;
  const bool too_deep = !options_.rules.unlimited_depth && state_[at(i)].held == 0 && -p.distance > depth_[at(t.facet)];
  if (too_deep) return;
  pair.magnitude = pair.stiffness * law_.force(penetration);
  pair.potential = pair.stiffness * law_.potential(penetration);
  pair.on_node = pair.magnitude * p.normal;
  for (std::size_t k = 0; k < 4; ++k) pair.on_facet[k] = -p.weight[k] * pair.on_node;
  // A node without stiffness (its elements are gone) still counts as projected, with no force.
  touch.contact = true;
}

}  // namespace abut::contact
