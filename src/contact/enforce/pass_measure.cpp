// What a node of a pass sees: distance, facet, penetration and the pair's force, by the closest point or by the plain rule.
#include <algorithm>
#include <cmath>
#include <limits>

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
    for (const std::array<Index, 4> corners = surface.surface().facet(f).node; const Index n : corners) {
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

void Pass::measure_closest(const Scene& scene, Index i, bool near_by, Touch& touch, Work& work, GroupSums& sums) {
  const HostState& host = scene.host;
  const Side &held = scene.held, &surface = scene.surface;
  const SideLoads &held_loads = scene.held_loads, &surface_loads = scene.surface_loads;
  const NodeState& before = states_.before(i);
  NodeState& after = states_.after(i);
  touch = {};
  if (!held.node_active(i)) return;
  const Vec3 x = held.x()[at(i)];
  const bool was_held = before.held != 0 && before.facet != no_index && surface.active(before.facet);
  if (!near_by && in_front_[at(i)] != 0 && !was_held && before.ignored == 0 && host.dt > 0.0 && !candidates_.of(i).empty()) {
    if (far(scene, i, before.in_front != 0 && before.offset == 0.0, work.facets)) {
      touch.far = true;
      after.offset = 0.0;
      return;
    }
  }
  touch.widens = was_held && before.held == 2;
  const double strip = touch.widens ? border_strip + border_widening : border_strip;
  HeldBy by = was_held ? HeldBy{before.facet, before.normal, strip} : HeldBy{};
  Looks& looks = work.looks;
  Measure m;
  if (was_held || !candidates_.of(i).empty()) m = nearest(surface, candidates_, i, x, by, looks);
  const bool in_front = m.found() && !m.closest.beyond && m.distance >= 0.0;
  in_front_[at(i)] = in_front && !touch.widens ? 1 : 0;  // as a free node sees it: without the wider strips of held ones
  if (in_front && !was_held) {
    const double gap = largest_gap_;
    if (candidates_.border_due(i) + gap < candidates_.nearest_due(i)) look_at_borders(surface, i, x, work.facets);
    candidates_.limit_nearest_due(i, candidates_.border_due(i) + gap);
  }
  // Beyond their reach lists need not hold the nearest facet: what is said and remembered must not depend on how old they are.
  const double away = m.found() ? std::sqrt(m.closest.squared_distance) : 1e300;
  if (was_held || near(host, held, held_loads, i, away)) after.in_front = in_front ? 1 : 0;
  if (!was_held && away > reach()) {
    const bool asks = before.ignored != 0 || before.offset > 0.0;
    m = asks ? nearest_of_all(held, surface, i) : Measure{};
    touch.away = !asks;
  }
  double own_gap = 0.0;  // of the nearest facet alone
  const auto take = [&](const Measure& measure) {
    touch.facet = measure.facet;
    touch.known = true;
    touch.weight = measure.closest.weight;
    touch.point = measure.closest.point;
    touch.normal = measure.normal;
    touch.distance = measure.distance;
    own_gap = full_gap(held, surface, i, measure.facet, measure.closest.weight);
    const OuterGap outer = outer_gap(held, surface, i, measure, by, strip, was_held, looks);
    touch.full_gap = outer.gap;
    touch.law = law_of(outer.of_facet);
  };
  bool meets = false;
  double gap = 0.0;
  if (m.found()) {
    take(m);
    gap = gap_of(touch.full_gap, m.distance, depth_[at(m.facet)], after);
    if (!m.closest.beyond && m.distance >= 0.0 && after.ignored != 0) {
      // It came through from behind: the gap it finds itself in was never closed, and begins at what is there.
      after.ignored = 0;
      after.offset = std::max(after.offset, std::max(touch.full_gap - m.distance, 0.0));
      gap = touch.full_gap - after.offset;
    }
    const bool all_offset = after.offset > 0.0 && after.offset >= touch.full_gap - m.distance;  // P is zero, whatever its rounding
    meets = !m.closest.beyond && gap - m.distance > 0.0 && !all_offset;
    if (meets && !was_held && m.distance < 0.0 && !options_.rules.unlimited_depth) {
      const double depth = depth_[at(m.facet)];
      const double came_from = m.distance - host.dt * kinematics(host, held, surface, i, touch).rate;
      if (-m.distance <= depth && host.dt > 0.0 && came_from < -depth) after.ignored = 1;
      if (-m.distance > depth || after.ignored != 0) meets = false;
    }
  } else {
    after.ignored = 0;
    after.offset = 0.0;
  }
  if (!meets && !was_held && before.ignored == 0 && after.offset == 0.0 && host.dt > 0.0) {
    const Index hit = swept_facet(held, surface, held_loads, surface_loads, i);
    if (hit != no_index) {
      const Measure caught = nearest_pushing_alike(held, surface, i, hit);
      if (!caught.closest.beyond && caught.distance < 0.0) {
        m = caught;
        by = {hit, signed_measure(surface, hit, closest_point(surface.patch(hit), x), x).normal};
        take(m);
        gap = touch.full_gap;
        meets = true;
        touch.fresh_hit = true;
        after.ignored = 0;
      } else {
        touch.lost = caught.closest.beyond;  // through the surface and over its border in one step
      }
    }
  }
  if (!touch.known) return;
  touch.penetration = gap - m.distance;
  // A node that was in front a step ago, that the swept test caught, or that touches at the start comes through the front.
  if (!was_held && (meets || touch.penetration > 0.0)) {
    const double came_from = m.distance - host.dt * kinematics(host, held, surface, i, touch).rate;
    touch.widens = touch.fresh_hit || !settled_ || came_from >= -1e-10 * size_;  // bodies that touch begin at zero, but for rounding
  } else if (!was_held) {
    touch.widens = true;
  }
  touch.pair_open = !meets && !was_held;
  touch.measure = m;
  touch.gap = gap + (own_gap - touch.full_gap);
  // Beyond the end of the nearest strip another facet may still hold the node.
  const bool beside = m.closest.beyond && touch.penetration > 0.0 && after.ignored == 0 && after.offset == 0.0 && !touch.lost &&
                      (was_held || -m.distance <= depth_[at(m.facet)]);
  if (touch.pair_open && !beside) return;
  touch.pair = force_of(held, surface, m, i, touch.gap, touch.widens);
  if (meets || beside) look_further(held, surface, m, i, by, strip, was_held, looks, touch, sums);
  touch.contact = (meets || beside) && touch.pair.magnitude > 0.0;
  touch.pair_open = touch.pair_open && !touch.contact;
  if (touch.pair_open) return;
  // Still behind the gap, but where the strip of a free border has faded to nothing.
  touch.lost = touch.lost || (was_held && touch.penetration > 0.0 && after.ignored == 0 && touch.pair.stiffness <= 0.0);
}

Measure Pass::nearest_pushing_alike(const Side& held, const Side& surface, Index i, Index facet) const {
  const Vec3 x = held.x()[at(i)];
  const Measure first = signed_measure(surface, facet, closest_point(surface.patch(facet), x), x);
  Measure best = first;
  candidates_.near({x, x}, std::sqrt(first.closest.squared_distance), [&](Index f) {
    const std::array<Index, 4> corners = surface.surface().facet(f).node;
    if (!surface.active(f) || f == facet || std::find(corners.begin(), corners.end(), held.nodes()[at(i)]) != corners.end()) return;
    const ClosestPoint c = closest_point(surface.patch(f), x);
    const double nearer = best.closest.squared_distance;
    if (c.squared_distance > nearer || (c.squared_distance == nearer && (best.facet == facet || f > best.facet))) return;
    const Measure m = signed_measure(surface, f, c, x);
    if (pushes_alike(m, first.normal)) best = m;
  });
  return best;
}

Measure Pass::nearest_of_all(const Side& held, const Side& surface, Index i) const {
  const Vec3 x = held.x()[at(i)];
  Measure best;
  ClosestPoint closest;
  for (double within = size_; best.facet == no_index && within < 1e9 * size_; within *= 4.0) {
    double least = within;
    candidates_.near({x, x}, within, [&](Index f) {
      const std::array<Index, 4> corners = surface.surface().facet(f).node;
      if (!surface.active(f) || std::find(corners.begin(), corners.end(), held.nodes()[at(i)]) != corners.end()) return;
      const ClosestPoint c = closest_point(surface.patch(f), x);
      const double distance = std::sqrt(c.squared_distance);
      if (distance > least || (distance == least && f > best.facet)) return;
      least = distance;
      closest = c;
      best.facet = f;
    });
  }
  return best.found() ? signed_measure(surface, best.facet, closest, x) : best;
}

PairForce Pass::force_of(const Side& held, const Side& surface, const Measure& m, Index i, Depth p, bool widens) const {
  const double full = full_gap(held, surface, i, m.facet, m.closest.weight);
  return pair_force(surface, m, held.x()[at(i)], law_of(full), p, options_.stiffness_scale, held.node_stiffness(i), half_of_facet_,
                    widens ? widening_[at(m.facet)] : 0.0, options_.automatic_gap && full > options_.gap);
}

double Pass::full_gap(const Side& held, const Side& surface, Index i, Index facet, const std::array<double, 4>& weight) const {
  if (!options_.automatic_gap) return options_.gap;
  return std::max(options_.gap, 0.5 * (held.node_thickness(i) + surface.thickness_at(facet, weight)));
}

double Pass::growth(const NodeState& before) const { return before.offset < never ? (1.0 - keep_) * before.offset : 0.0; }

double Pass::gap_of(double full_gap, double distance, double depth, NodeState& after) const {
  const double full = full_gap - distance;
  if (!settled_) {
    if (distance < -depth) return full_gap;  // it is not met
    if (full > 0.0 && (options_.initial == Initial::offset || options_.start_duration > 0.0)) after.offset = full;
    if (full > 0.0 && options_.initial == Initial::ignore) after.offset = never;
  } else if (full <= 0.0) {
    after.offset = 0.0;
  } else if (after.offset < never) {
    after.offset = std::min(keep_ * after.offset, full);  // what the node has moved away is gap again
  }
  return full_gap - after.offset;
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
  touch.measure.facet = t.facet;
  touch.measure.closest.weight = p.weight;
  touch.point = p.point;
  touch.normal = p.normal;
  touch.distance = p.distance;
  touch.full_gap = options_.gap;
  touch.law = law_of(options_.gap);
  const double penetration = gap_of(options_.gap, p.distance, 1e300, states_.after(i)) - p.distance;
  touch.penetration = penetration;
  PairForce& pair = touch.pair;
  pair.stiffness = plain_stiffness(held, surface, i, t.facet);
  if (penetration <= 0.0) return;
  const bool too_deep = !options_.rules.unlimited_depth && states_.before(i).held == 0 && -p.distance > depth_[at(t.facet)];
  if (too_deep) return;
  pair.magnitude = pair.stiffness * touch.law.force(penetration);
  pair.potential = pair.stiffness * touch.law.potential(penetration);
  pair.on_node = pair.magnitude * p.normal;
  for (std::size_t k = 0; k < 4; ++k) pair.on_facet[k] = -p.weight[k] * pair.on_node;
  // A node without stiffness (its elements are gone) still counts as projected, with no force.
  touch.contact = true;
}

double Pass::opening_of(const Side& held, const Side& surface, Index i) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!held.node_active(i)) return none;
  const Vec3 x = held.x()[at(i)];
  if (!closest()) {
    const Index facet = tracked_[at(i)].facet;
    if (facet == no_index || !surface.active(facet)) return none;
    const PlainPoint p = project_plain(surface.patch(facet), x, options_.gap, options_.rules.area_ratio_projection);
    return p.inside ? p.distance - options_.gap : none;
  }
  const NodeState& node = now(i);
  if (node.held != 0 && node.facet != no_index && surface.active(node.facet)) {
    const double strip = border_strip + (node.held == 2 ? border_widening : 0.0);
    const Measure m = signed_measure(surface, node.facet, closest_point(extended(surface, node.facet, strip), x), x);
    return m.distance - (seen_gap_.empty() ? options_.gap : seen_gap_[at(i)]);
  }
  if (!candidates_.made()) return none;
  // The likely answer first; what the lists know of the others leaves most of them out.
  const std::span<const Candidates::Entry> entries = candidates_.of(i);
  const Candidates::Entry* first = nullptr;
  for (const Candidates::Entry& entry : entries) {
    if (surface.active(entry.facet) && (first == nullptr || entry.due < first->due)) first = &entry;
  }
  if (first == nullptr) return none;
  const Candidates::Entry* best = first;
  ClosestPoint nearest = closest_point(surface.patch(first->facet), x);
  for (const Candidates::Entry& entry : entries) {
    if (&entry == first || !surface.active(entry.facet)) continue;
    if (entry.due - candidates_.clock() > rounding * std::sqrt(nearest.squared_distance)) continue;
    const ClosestPoint other = closest_point(surface.patch(entry.facet), x);
    const bool nearer = other.squared_distance < nearest.squared_distance;
    if (!nearer && !(other.squared_distance == nearest.squared_distance && &entry < best)) continue;
    nearest = other;
    best = &entry;
  }
  // Beyond their reach lists need not hold the nearest facet: what is said must not depend on how old they are.
  if (nearest.beyond || nearest.squared_distance > reach() * reach()) return none;
  const Measure m = signed_measure(surface, best->facet, nearest, x);
  Looks looks(surface, x);
  return m.distance - outer_gap(held, surface, i, m, {}, border_strip, false, looks).gap;
}

void Pass::add_nodal_contact(const Side& held, const Side& surface, std::span<NodalContact> nodes) const {
  for (Index i = 0; i < held.node_count(); ++i) {
    const NodeState& node = now(i);
    NodalContact c;
    c.opening = opening_of(held, surface, i);
    if (node.held != 0) {
      c.state = slips_[at(i)] != 0 ? NodalContact::State::slip : NodalContact::State::stick;
      c.penetration = std::max(0.0, (node.offset < never ? -node.offset : 0.0) - c.opening);
    }
    merge(nodes[at(held.nodes()[at(i)])], c);
  }
}

}  // namespace abut::contact
