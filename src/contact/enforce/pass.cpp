#include "contact/enforce/pass.hpp"

#include <algorithm>
#include <cmath>

#include "contact/enforce/switching.hpp"
#include "contact/project/plain.hpp"
#include "contact/search/swept.hpp"

namespace abut::contact {
namespace {

constexpr Index group = 128;         // nodes handled together (numerics.md 7.3.1)
constexpr double step_growth = 1.2;  // the coming step may be longer than the last one

Patch patch_at(const Side& side, std::span<const Vec3> x, Index f) {
  Patch patch = side.patch(f);
  const std::array<Index, 4>& local = side.surface().local()[at(f)];
  for (std::size_t i = 0; i < 4; ++i) patch.x[i] = x[at(local[i])];
  return patch;
}

}  // namespace

void SideLoads::resize(std::size_t nodes) {
  for (std::vector<Vec3>* v : {&own_normal, &own_tangential, &reaction_normal, &reaction_tangential, &force_before, &x_before})
    v->resize(nodes);
  own_stiffness.resize(nodes);
  reaction_stiffness.resize(nodes);
}

void SideLoads::clear() {
  for (std::vector<Vec3>* v : {&own_normal, &own_tangential, &reaction_normal, &reaction_tangential})
    std::fill(v->begin(), v->end(), Vec3{});
  std::fill(own_stiffness.begin(), own_stiffness.end(), 0.0);
  std::fill(reaction_stiffness.begin(), reaction_stiffness.end(), 0.0);
}

Pass::Pass(const Options& options, bool one_pass, std::size_t held_nodes)
    : options_(options),
      law_{options.rules.law == Law::stiffening ? options.gap : 0.0},
      two_passes_(!one_pass),
      half_of_facet_(one_pass && options.rules.one_pass_half_stiffness),
      state_(held_nodes),
      next_(held_nodes),
      touches_(at(group)) {}

void Pass::start(const Side& held, const Side& surface) {
  started_ = true;
  size_ = surface.mean_size();
  depth_.resize(at(surface.facet_count()));
  for (Index f = 0; f < surface.facet_count(); ++f) {
    double depth = options_.depth_limit;
    if (depth <= 0.0) {
      depth = 0.5 * std::sqrt(surface.facet_area(f));
      if (surface.thickness(f) > 0.0) depth = std::min(depth, std::max(surface.thickness(f), options_.gap));
    }
    depth_[at(f)] = depth;
  }
  tracked_.assign(at(held.node_count()), {});
  if (closest()) return;
  incremental_.start(held, surface, tracked_);
  if (!options_.rules.reference_friction || options_.friction <= 0.0) return;
  // 7.2.5: nodes that touch at the start rub from the first cycle.
  constexpr double starter_tolerance = 0.02;
  for (Index i = 0; i < held.node_count(); ++i) {
    const Tracked& t = tracked_[at(i)];
    if (t.facet == no_index) continue;
    const Vec3 x = held.x()[at(i)];
    const Patch patch = surface.patch(t.facet);
    const PlainPoint p = project_plain(patch, x, options_.gap, options_.rules.area_ratio_projection);
    const double limit = 1.0 + starter_tolerance;
    if (std::abs(p.raw_s) > limit || std::abs(p.raw_t) > limit || p.distance - options_.gap > 0.0) continue;
    state_[at(i)].anchored = 1;
    state_[at(i)].anchor = {p.weight, t.facet};
    state_[at(i)].last = state_[at(i)].anchor;
  }
}

void Pass::search(const Side& held, const Side& surface, const SideLoads& surface_loads) {
  if (!closest()) {
    incremental_.update(held, surface, tracked_, options_.gap);
    return;
  }
  smallest_depth_ = 1e300;
  largest_depth_ = 0.0;
  for (const double d : depth_) {
    smallest_depth_ = std::min(smallest_depth_, d);
    largest_depth_ = std::max(largest_depth_, d);
  }
  skin_ = 0.25 * size_;
  const double reach = std::max(options_.gap, largest_depth_);
  // A held node's distance changes by at most slack() <= skin until the next build: twice the skin covers both ends.
  const auto reach_of = [&](Index i) {
    if (!held.node_active(i)) return -1.0;
    const NodeState& s = state_[at(i)];
    if (s.held == 0 || s.facet == no_index || !surface.active(s.facet)) return reach;
    return std::max(reach, std::sqrt(closest_point(surface.patch(s.facet), held.x()[at(i)]).squared_distance) + skin_);
  };
  candidates_.update(held, surface, reach_of, skin_, stale_);
  stale_ = false;
  surface_step_ = 0.0;
  mean_step_ = {};
  if (surface.node_count() == 0) return;
  for (std::size_t s = 0; s < surface.x().size(); ++s) mean_step_ += surface.x()[s] - surface_loads.x_before[s];
  mean_step_ = mean_step_ / static_cast<double>(surface.x().size());
  for (std::size_t s = 0; s < surface.x().size(); ++s) {
    surface_step_ = std::max(surface_step_, squared_norm(surface.x()[s] - surface_loads.x_before[s] - mean_step_));
  }
  surface_step_ = std::sqrt(surface_step_);
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
    const Vec3 coming = host.dt * host.v[at(held.nodes()[at(i)])] - mean_step_;
    const double moved = std::max(norm(x - held_loads.x_before[at(i)] - mean_step_), norm(coming)) + surface_step_;
    const double reached = options_.gap + 4.0 * moved;
    if (moved < 0.25 * smallest_depth_ && candidates_.nearest_then(i) - candidates_.slack() > reached) {
      touch.far = true;
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
  after.in_front = m.found() && !m.closest.beyond && m.distance >= 0.0 ? 1 : 0;
  if (m.found()) {
    take(m);
    meets = !m.closest.beyond && options_.gap - m.distance > 0.0;
    if (!m.closest.beyond && m.distance >= 0.0) after.ignored = 0;
    if (meets && !was_held && m.distance < 0.0 && !options_.rules.unlimited_depth) {
      const double depth = depth_[at(m.facet)];
      const double came_from = m.distance - host.dt * kinematics(host, held, surface, i, touch).rate;
      if (-m.distance > depth || (host.dt > 0.0 && came_from < -depth)) after.ignored = 1;
      if (after.ignored != 0) meets = false;
    }
  } else {
    after.ignored = 0;
  }
  if (!meets && !was_held && before.ignored == 0 && host.dt > 0.0) {
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
  touch.area = 0.0;
  touch.pair = pair_force(surface, m, x, law_, options_.gap, options_.stiffness_scale, held.node_stiffness(i), half_of_facet_);
  touch.contact = meets && touch.pair.magnitude > 0.0;
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
  touch.area = p.area;
  const double penetration = options_.gap - p.distance;
  const double k1 = surface.facet_stiffness(t.facet);
  const double k2 = held.node_stiffness(i);
  PairForce& pair = touch.pair;
  pair.stiffness = half_of_facet_  ? 0.5 * options_.stiffness_scale * k1
                   : k1 + k2 > 0.0 ? options_.stiffness_scale * k1 * k2 / (k1 + k2)
                                   : 0.0;
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

Pass::Kinematics Pass::kinematics(const HostState& host, const Side& held, const Side& surface, Index i, const Touch& touch) const {
  Kinematics k;
  const std::array<Index, 4>& corner = surface.surface().local()[at(touch.facet)];
  const Index node = held.nodes()[at(i)];
  Vec3 v = host.v[at(node)];
  for (std::size_t c = 0; c < 4; ++c) {
    if (touch.weight[c] != 0.0) v -= touch.weight[c] * host.v[at(surface.nodes()[at(corner[c])])];
  }
  k.rate = dot(v, touch.normal);
  k.tangential_velocity = v - k.rate * touch.normal;
  if (!host.mass.empty()) {
    const auto inverse = [&host](Index n) { return host.mass[at(n)] > 0.0 ? 1.0 / host.mass[at(n)] : 0.0; };
    k.inverse_mass = inverse(node);
    for (std::size_t c = 0; c < 4; ++c) {
      if (touch.weight[c] != 0.0) k.inverse_mass += touch.weight[c] * touch.weight[c] * inverse(surface.nodes()[at(corner[c])]);
    }
  }
  return k;
}

void Pass::look_ahead(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i) const {
  // No facet known within reach: only a node that flies further than the lists see can touch in the coming step.
  const Index node = held.nodes()[at(i)];
  const Vec3 v = host.v[at(node)] - (host.dt > 0.0 ? mean_step_ / host.dt : Vec3{});
  const Vec3 flight = (1.5 * step_growth * host.dt) * v;
  if (norm(flight) + 2.0 * surface_step_ <= std::max(options_.gap, smallest_depth_)) return;
  Bounds path;
  path.include(held.x()[at(i)]);
  path.include(held.x()[at(i)] + flight);
  double largest = 0.0;
  candidates_.near(path, options_.gap + 2.0 * surface_step_, [&](Index f) {
    const double k1 = surface.facet_stiffness(f);
    const double k2 = held.node_stiffness(i);
    const double pair = half_of_facet_  ? 0.5 * options_.stiffness_scale * k1
                        : k1 + k2 > 0.0 ? options_.stiffness_scale * k1 * k2 / (k1 + k2)
                                        : 0.0;
    largest = std::max(largest, pair);
  });
  held_loads.own_stiffness[at(i)] += largest * law_.tangent(1e30);
}

void Pass::finish_node(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, SideLoads& surface_loads,
                       Index i, Touch& touch, bool rub, PassTotals& totals) {
  const NodeState& before = state_[at(i)];
  NodeState& after = next_[at(i)];
  const Rules& rules = options_.rules;
  if (!touch.known) {
    if (!closest() || touch.far || !rules.limits_step || host.dt <= 0.0) return;
    look_ahead(host, held, surface, held_loads, i);
    return;
  }
  const double penetration = options_.gap - touch.distance;
  const Kinematics motion = kinematics(host, held, surface, i, touch);
  const double closing = -motion.rate;
  if (options_.gap > 0.0) totals.largest_approach = std::max(totals.largest_approach, closing * host.dt / options_.gap);
  const std::array<Index, 4>& corner = surface.surface().local()[at(touch.facet)];

  // Stiffness for the coming step, also where contact may begin in it.
  if (rules.limits_step) {
    const double ahead = 1.5 * step_growth * host.dt * std::max(closing, 0.0);
    const bool may_touch = host.dt > 0.0 ? penetration + ahead > 0.0 : penetration > -0.25 * size_;
    if (touch.contact || (may_touch && touch.pair.stiffness > 0.0)) {
      const double reached = std::max(penetration + step_growth * host.dt * std::max(closing, 0.0), 1e-12 * size_);
      double tangent = touch.pair.stiffness * law_.tangent(reached) + touch.pair.extra_tangent;
      if (options_.friction > 0.0) tangent *= std::sqrt(1.0 + options_.friction * options_.friction);
      double spread = 0.0;
      for (const double w : touch.weight) spread += std::abs(w);
      tangent *= 0.5 * (1.0 + spread);
      held_loads.own_stiffness[at(i)] += tangent;
      for (std::size_t k = 0; k < 4; ++k) surface_loads.reaction_stiffness[at(corner[k])] += std::abs(touch.weight[k]) * tangent;
    }
    if (law_.stiffens() && closing > 0.0) {
      const double room = std::max(options_.gap - penetration, (1.0 - NormalLaw::bend) * options_.gap);
      if (0.5 * room / closing < totals.kinematic_step) {
        totals.kinematic_step = 0.5 * room / closing;
        totals.kinematic_node = held.nodes()[at(i)];
      }
    }
  }

  if (!touch.contact) return;  // history of a contact that ends: closed by the caller
  totals.in_contact += 1;
  totals.crossed += touch.fresh_hit ? 1 : 0;
  totals.largest_penetration = std::max(totals.largest_penetration, penetration);
  totals.potential += touch.pair.potential;
  in_contact_.push_back(held.nodes()[at(i)]);

  const bool fresh = before.held == 0;
  double fraction = 1.0;  // of the last step in contact
  double factor = 1.0;
  const double moved_in = closing * host.dt;
  // With two passes the facing surface's own springs act on this pair too, as strongly as this one where the meshes face.
  const double inverse_mass = (two_passes_ ? 2.0 : 1.0) * motion.inverse_mass;
  if (fresh && moved_in > penetration) fraction = penetration / moved_in;
  if (rules.switch_correction && host.dt > 0.0 && touch.pair.magnitude > 0.0) {
    const double others = !fresh && host.dt_bar_old > 0.0 ? (motion.rate - before.rate) / host.dt_bar_old - before.acceleration : 0.0;
    const Switching s{law_, touch.pair.stiffness, penetration, host.dt, motion.rate, inverse_mass, others};
    factor = switched_force(s, fresh) / touch.pair.magnitude;
  }
  const double normal_force = factor * touch.pair.magnitude;
  const Vec3 on_node = factor * touch.pair.on_node;
  held_loads.own_normal[at(i)] = on_node;
  for (std::size_t k = 0; k < 4; ++k) { surface_loads.reaction_normal[at(corner[k])] += factor * touch.pair.on_facet[k]; }
  totals.normal += on_node;

  after.held = 1;
  after.facet = touch.facet;
  after.normal = touch.normal;
  after.rate = motion.rate;
  after.acceleration = normal_force * inverse_mass;

  if (options_.friction > 0.0 && rub) {
    double limit = options_.friction * normal_force;
    if (options_.shear_limit < 1e29 && !rules.reference_friction) {
      const double own_area = held.facet_count() > 0 ? held.tributary_area(i) : surface.facet_area(touch.facet);
      // Two passes act on the same area: each may carry half of the stress.
      limit = std::min(limit, (two_passes_ ? 0.5 : 1.0) * options_.shear_limit * own_area);
    }
    const Vec3 on_surface = rules.reference_friction
                                ? rub_by_anchor(surface, touch, limit, before, after, totals)
                                : rub_by_return_mapping(host, surface, touch, motion, limit, fraction, before, after, totals);
    held_loads.own_tangential[at(i)] = -on_surface;
    for (std::size_t k = 0; k < 4; ++k) surface_loads.reaction_tangential[at(corner[k])] += touch.weight[k] * on_surface;
    totals.tangential -= on_surface;
  }
}

PassTotals Pass::evaluate(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, SideLoads& surface_loads) {
  PassTotals totals;
  in_contact_.clear();
  const bool anchors = options_.rules.reference_friction;
  for (Index first = 0; first < held.node_count(); first += group) {
    const Index last = std::min(first + group, held.node_count());
    bool any = false;
    for (Index i = first; i < last; ++i) {
      Touch& touch = touches_[at(i - first)];
      next_[at(i)] = state_[at(i)];
      if (closest()) {
        measure_closest(host, held, surface, held_loads, surface_loads, i, touch);
      } else {
        measure_plain(held, surface, i, touch);
      }
      any = any || touch.contact;
    }
    for (Index i = first; i < last; ++i) {
      Touch& touch = touches_[at(i - first)];
      // 7.4.3: anchors are looked at only in groups in which somebody touches.
      finish_node(host, held, surface, held_loads, surface_loads, i, touch, any, totals);
      NodeState& after = next_[at(i)];
      if (touch.contact) continue;
      const NodeState& before = state_[at(i)];
      after.held = 0;
      after.rate = 0.0;
      after.acceleration = 0.0;
      if (!anchors || any) {
        // The limit falls to zero: what was stored slips away.
        if (before.tangential_stiffness > 0.0) { totals.dissipated += 0.5 * squared_norm(before.friction) / before.tangential_stiffness; }
        after.anchored = 0;
        after.slip = {};
        after.friction = {};
        after.tangential_stiffness = 0.0;
      }
    }
  }
  return totals;
}

PassTotals Pass::rest() {
  PassTotals totals;
  in_contact_.clear();
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const NodeState& before = state_[i];
    next_[i] = before;
    if (before.tangential_stiffness > 0.0) totals.dissipated += 0.5 * squared_norm(before.friction) / before.tangential_stiffness;
    if (options_.rules.reference_friction) continue;  // frozen outside the window (7.3.1)
    next_[i] = {};
    next_[i].ignored = before.ignored;
  }
  return totals;
}

void Pass::commit() { state_.swap(next_); }

void Pass::save(HistoryWriter& out) const {
  out.put_all(state_);
  out.put(static_cast<std::uint64_t>(started_ ? depth_.size() : 0));
  for (const double d : depth_) out.put(d);
  out.put(size_);
  for (const Tracked& t : tracked_) out.put(t);
}

void Pass::load(HistoryReader& in) {
  in.get_all(state_);
  next_ = state_;
  std::uint64_t facets = 0;
  in.get(facets);
  started_ = facets > 0;
  depth_.resize(facets);
  for (double& d : depth_) in.get(d);
  in.get(size_);
  tracked_.resize(started_ ? state_.size() : 0);
  for (Tracked& t : tracked_) in.get(t);
  stale_ = true;
}

}  // namespace abut::contact
