#include "contact/enforce/pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "contact/enforce/coefficient.hpp"
#include "contact/enforce/switching.hpp"
#include "contact/project/plain.hpp"
#include "contact/search/swept.hpp"

namespace abut::contact {
namespace {

constexpr Index group = 128;         // nodes handled together (numerics.md 7.3.1)
constexpr double never = 1e300;      // offset of a node that is ignored
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
  loaded.resize(nodes);
}

void SideLoads::clear() {
  for (std::size_t s = 0; s < loaded.size(); ++s) {
    if ((loaded[s] & now) == 0) continue;
    own_normal[s] = own_tangential[s] = reaction_normal[s] = reaction_tangential[s] = {};
    own_stiffness[s] = reaction_stiffness[s] = 0.0;
    loaded[s] &= before;
  }
}

PassTotals& PassTotals::operator+=(const PassTotals& b) {
  normal += b.normal;
  tangential += b.tangential;
  potential += b.potential;
  stick += b.stick;
  dissipated += b.dissipated;
  damped += b.damped;
  largest_penetration = std::max(largest_penetration, b.largest_penetration);
  largest_approach = std::max(largest_approach, b.largest_approach);
  if (b.kinematic_step < kinematic_step) {
    kinematic_step = b.kinematic_step;
    kinematic_node = b.kinematic_node;
  }
  in_contact += b.in_contact;
  crossed += b.crossed;
  return *this;
}

Pass::Pass(const Options& options, bool one_pass, std::size_t held_nodes)
    : options_(options),
      law_{options.rules.law == Law::stiffening ? options.gap : 0.0},
      two_passes_(!one_pass),
      half_of_facet_(one_pass && options.rules.one_pass_half_stiffness),
      state_(held_nodes),
      next_(held_nodes),
      quiet_(held_nodes, awake),
      slips_(held_nodes, 1) {}

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
  limit_depths();
  tracked_.assign(at(held.node_count()), {});
  if (closest()) return;
  incremental_.start(held, surface, tracked_);
  if (!options_.rules.reference_friction || !options_.rubs()) return;
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

void Pass::limit_depths() {
  smallest_depth_ = 1e300;
  largest_depth_ = 0.0;
  for (const double d : depth_) {
    smallest_depth_ = std::min(smallest_depth_, d);
    largest_depth_ = std::max(largest_depth_, d);
  }
}

void Pass::search(const Side& held, const Side& surface, const SideLoads& surface_loads) {
  if (!closest()) {
    incremental_.update(held, surface, tracked_, options_.gap);
    return;
  }
  if (stale_) std::fill(quiet_.begin(), quiet_.end(), std::uint8_t{awake});
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

bool Pass::far(const HostState& host, const Side& held, const SideLoads& held_loads, Index i) const {
  // Neither the motion of the last step nor that of the coming one may come near a quarter of the way.
  const double clear = 0.25 * std::min(smallest_depth_, candidates_.nearest_due(i) - candidates_.clock() - options_.gap) - surface_step_;
  if (clear <= 0.0) return false;
  const Vec3 coming = host.dt * host.v[at(held.nodes()[at(i)])] - mean_step_;
  const Vec3 last = held.x()[at(i)] - held_loads.x_before[at(i)] - mean_step_;
  return std::max(squared_norm(last), squared_norm(coming)) < clear * clear;
}

bool Pass::asleep(const Scene& scene, Index i) const {
  const std::uint8_t quiet = quiet_[at(i)];
  if (quiet == awake || scene.host.dt <= 0.0) return false;
  if (quiet == nothing_listed && !candidates_.of(i).empty()) return false;
  return far(scene.host, scene.held, scene.held_loads, i);
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

double Pass::gap_of(double distance, NodeState& after) const {
  const double full = options_.gap - distance;
  if (!settled_) {
    if (full > 0.0 && options_.initial == Initial::offset) after.offset = full;
    if (full > 0.0 && options_.initial == Initial::ignore) after.offset = never;
  } else if (full <= 0.0) {
    after.offset = 0.0;
  } else if (after.offset < never) {
    after.offset = std::min(after.offset, full);  // what the node has moved away is gap again
  }
  return options_.gap - after.offset;
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
  held_loads.loaded[at(i)] |= SideLoads::now;
}

void Pass::finish_node(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i, Touch& touch, bool rub,
                       GroupSums& sums) {
  PassTotals& totals = sums.totals;
  const NodeState& before = state_[at(i)];
  NodeState& after = next_[at(i)];
  const Rules& rules = options_.rules;
  if (!touch.known) {
    if (!closest() || touch.far || !rules.limits_step || host.dt <= 0.0) return;
    look_ahead(host, held, surface, held_loads, i);
    return;
  }
  const double penetration = touch.penetration;
  const Kinematics motion = kinematics(host, held, surface, i, touch);
  const double closing = -motion.rate;
  if (options_.gap > 0.0) totals.largest_approach = std::max(totals.largest_approach, closing * host.dt / options_.gap);
  Reaction reaction;
  reaction.facet = touch.facet;
  reaction.weight = touch.weight;

  // Stiffness for the coming step, also where contact may begin in it.
  if (rules.limits_step) {
    const double ahead = 1.5 * step_growth * host.dt * std::max(closing, 0.0);
    const bool may_touch = host.dt > 0.0 ? penetration + ahead > 0.0 : penetration > -0.25 * size_;
    if (touch.contact || (may_touch && touch.pair.stiffness > 0.0)) {
      const double reached = std::max(penetration + step_growth * host.dt * std::max(closing, 0.0), 1e-12 * size_);
      double tangent = touch.pair.stiffness * law_.tangent(reached) + touch.pair.extra_tangent;
      if (options_.rubs()) {
        const double pressure = touch.pair.magnitude / surface.facet_area(touch.facet);
        const double mu = friction_coefficient(options_.friction_law, options_.friction, pressure, norm(motion.tangential_velocity));
        tangent *= std::sqrt(1.0 + mu * mu);
      }
      if (options_.damping > 0.0) {
        // With viscous forces from the step before, h^2 K/4 + h C/2 <= 1: in the terms of one spring (sqrt(1 + z^2) + z)^2, or 2 C/h.
        const double z = options_.damping;
        const double root = std::sqrt(1.0 + z * z) + z;
        const double c = motion.inverse_mass > 0.0 ? 2.0 * z * std::sqrt(tangent / motion.inverse_mass) : 0.0;
        tangent = std::max(tangent * root * root, host.dt > 0.0 ? tangent + 2.0 * c / host.dt : 0.0);
      }
      double spread = 0.0;
      for (const double w : touch.weight) spread += std::abs(w);
      tangent *= 0.5 * (1.0 + spread);
      held_loads.own_stiffness[at(i)] += tangent;
      held_loads.loaded[at(i)] |= SideLoads::now;
      reaction.stiffness = tangent;
    }
    if (law_.stiffens() && closing > 0.0) {
      const double room = std::max(options_.gap - penetration, (1.0 - NormalLaw::bend) * options_.gap);
      if (0.5 * room / closing < totals.kinematic_step) {
        totals.kinematic_step = 0.5 * room / closing;
        totals.kinematic_node = held.nodes()[at(i)];
      }
    }
  }

  if (!touch.contact) {  // history of a contact that ends: closed by the caller
    if (reaction.stiffness > 0.0) sums.reactions.push_back(reaction);
    return;
  }
  totals.in_contact += 1;
  totals.crossed += touch.fresh_hit ? 1 : 0;
  totals.largest_penetration = std::max(totals.largest_penetration, penetration);
  sums.in_contact.push_back(held.nodes()[at(i)]);

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
    const Switched switched = switched_force(s, fresh);
    factor = switched.force / touch.pair.magnitude;
    totals.potential += switched.stored;
  } else {
    totals.potential += touch.pair.potential;
  }
  double normal_force = factor * touch.pair.magnitude;
  Vec3 on_node = factor * touch.pair.on_node;
  for (std::size_t k = 0; k < 4; ++k) reaction.normal[k] = factor * touch.pair.on_facet[k];
  after.damping = 0.0;
  if (options_.damping > 0.0 && motion.inverse_mass > 0.0) {
    const double c = 2.0 * options_.damping * std::sqrt(touch.pair.stiffness * law_.tangent(penetration) / motion.inverse_mass);
    after.damping = std::max(-c * motion.rate, -normal_force);
    totals.damped += std::max(0.0, -0.5 * (before.damping + after.damping) * motion.rate * host.dt);
    on_node += after.damping * touch.normal;
    for (std::size_t k = 0; k < 4; ++k) reaction.normal[k] -= touch.weight[k] * after.damping * touch.normal;
  }
  held_loads.own_normal[at(i)] = on_node;
  held_loads.loaded[at(i)] |= SideLoads::now;
  totals.normal += on_node;

  after.held = 1;
  after.facet = touch.facet;
  after.normal = touch.normal;
  after.rate = motion.rate;
  after.acceleration = (normal_force + after.damping) * inverse_mass;
  normal_force += after.damping;

  if (options_.rubs() && rub) {
    const double mu = friction_coefficient(options_.friction_law, options_.friction, normal_force / surface.facet_area(touch.facet),
                                           norm(motion.tangential_velocity));
    double limit = mu * normal_force;
    if (options_.shear_limit < 1e29 && !rules.reference_friction) {
      const double own_area = held.facet_count() > 0 ? held.tributary_area(i) : surface.facet_area(touch.facet);
      // Two passes act on the same area: each may carry half of the stress.
      limit = std::min(limit, (two_passes_ ? 0.5 : 1.0) * options_.shear_limit * own_area);
    }
    const Vec3 on_surface = rules.reference_friction
                                ? rub_by_anchor(host, surface, touch, limit, before, after, totals)
                                : rub_by_return_mapping(host, surface, touch, motion, limit, fraction, before, after, totals);
    slips_[at(i)] = norm(on_surface) >= (1.0 - 1e-9) * limit ? 1 : 0;
    held_loads.own_tangential[at(i)] = -on_surface;
    reaction.tangential = on_surface;
    totals.tangential -= on_surface;
  }
  sums.reactions.push_back(reaction);
}

void Pass::evaluate_group(const Scene& scene, Index first, std::span<Touch> touches, GroupSums& sums) {
  const auto& [host, held, surface, held_loads, surface_loads] = scene;
  const bool anchors = options_.rules.reference_friction;
  sums.totals = {};
  sums.reactions.clear();
  sums.in_contact.clear();
  std::array<Index, at(group)> nodes;
  std::size_t count = 0;
  bool any = false;
  const Index last = std::min(first + group, held.node_count());
  for (Index i = first; i < last; ++i) {
    if (asleep(scene, i)) continue;
    Touch& touch = touches[count];
    nodes[count++] = i;
    next_[at(i)] = state_[at(i)];
    if (closest()) {
      measure_closest(host, held, surface, held_loads, surface_loads, i, touch);
    } else {
      measure_plain(held, surface, i, touch);
    }
    any = any || touch.contact;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Index i = nodes[k];
    Touch& touch = touches[k];
    // 7.4.3: anchors are looked at only in groups in which somebody touches.
    finish_node(host, held, surface, held_loads, i, touch, any, sums);
    NodeState& after = next_[at(i)];
    quiet_[at(i)] = awake;
    if (touch.contact) continue;
    const NodeState& before = state_[at(i)];
    after.held = 0;
    // The last damping force acts over half of the step that ends the contact.
    if (before.damping != 0.0) sums.totals.damped += std::max(0.0, -0.5 * before.damping * before.rate * host.dt);
    after.damping = 0.0;
    after.rate = 0.0;
    after.acceleration = 0.0;
    if (!anchors || any) {
      // The limit falls to zero: what was stored slips away.
      if (before.tangential_stiffness > 0.0) {
        sums.totals.dissipated += 0.5 * squared_norm(before.friction) / before.tangential_stiffness;
      }
      after.anchored = 0;
      after.slip = {};
      if (!anchors) after.filtered = {};
      after.friction = {};
      after.tangential_stiffness = 0.0;
    }
    if (!closest()) continue;
    const bool nothing = candidates_.of(i).empty();
    if ((touch.far || nothing) && after.ignored == 0 && std::memcmp(&before, &after, sizeof(NodeState)) == 0) {
      quiet_[at(i)] = nothing ? nothing_listed : in_front;
    }
  }
}

PassTotals Pass::evaluate(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, SideLoads& surface_loads) {
  const Scene scene{host, held, surface, held_loads, surface_loads};
  groups_.resize((at(held.node_count()) + at(group) - 1) / at(group));
  const auto evaluate_groups = [this, &scene](std::size_t begin, std::size_t end) {
    std::array<Touch, at(group)> touches;
    for (std::size_t g = begin; g < end; ++g) evaluate_group(scene, static_cast<Index>(g) * group, touches, groups_[g]);
  };
  if (executor_) {
    executor_(groups_.size(), evaluate_groups);
  } else {
    evaluate_groups(0, groups_.size());
  }

  committed_ = false;
  PassTotals totals;
  in_contact_.clear();
  for (const GroupSums& sums : groups_) {
    totals += sums.totals;
    in_contact_.insert(in_contact_.end(), sums.in_contact.begin(), sums.in_contact.end());
    for (const Reaction& r : sums.reactions) {
      const std::array<Index, 4>& corner = surface.surface().local()[at(r.facet)];
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t s = at(corner[k]);
        surface_loads.reaction_normal[s] += r.normal[k];
        surface_loads.reaction_tangential[s] += r.weight[k] * r.tangential;
        surface_loads.reaction_stiffness[s] += std::abs(r.weight[k]) * r.stiffness;
        surface_loads.loaded[s] |= SideLoads::now;
      }
    }
  }
  settled_ = true;
  return totals;
}

double Pass::distance_to(const Side& held, const Side& surface, Index i) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!held.node_active(i)) return none;
  const Vec3 x = held.x()[at(i)];
  if (!closest()) {
    const Index facet = tracked_[at(i)].facet;
    if (facet == no_index || !surface.active(facet)) return none;
    const PlainPoint p = project_plain(surface.patch(facet), x, options_.gap, options_.rules.area_ratio_projection);
    return p.inside ? p.distance : none;
  }
  const NodeState& node = now(i);
  if (node.held != 0 && node.facet != no_index && surface.active(node.facet)) return descend_to_nearest(surface, node.facet, x).distance;
  if (!candidates_.made()) return none;
  ClosestPoint nearest;
  Index facet = no_index;
  for (const Candidates::Entry& entry : candidates_.of(i)) {
    if (!surface.active(entry.facet)) continue;
    const ClosestPoint other = closest_point(surface.patch(entry.facet), x);
    if (facet != no_index && !(other.squared_distance < nearest.squared_distance)) continue;
    nearest = other;
    facet = entry.facet;
  }
  return facet == no_index || nearest.beyond ? none : signed_measure(surface, facet, nearest, x).distance;
}

void Pass::add_nodal_contact(const Side& held, const Side& surface, std::span<NodalContact> nodes) const {
  for (Index i = 0; i < held.node_count(); ++i) {
    const NodeState& node = now(i);
    NodalContact c;
    c.opening = distance_to(held, surface, i) - options_.gap;
    if (node.held != 0) {
      c.state = slips_[at(i)] != 0 ? NodalContact::State::slip : NodalContact::State::stick;
      c.penetration = std::max(0.0, (node.offset < never ? -node.offset : 0.0) - c.opening);
    }
    merge(nodes[at(held.nodes()[at(i)])], c);
  }
}

PassTotals Pass::rest() {
  committed_ = false;
  PassTotals totals;
  stale_ = true;
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

void Pass::commit() {
  state_.swap(next_);
  committed_ = true;
}

void Pass::save(HistoryWriter& out) const {
  out.put_all(state_);
  out.put(static_cast<std::uint64_t>(started_ ? depth_.size() : 0));
  for (const double d : depth_) out.put(d);
  out.put(size_);
  out.put(settled_);
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
  limit_depths();
  in.get(size_);
  in.get(settled_);
  tracked_.resize(started_ ? state_.size() : 0);
  for (Tracked& t : tracked_) in.get(t);
  stale_ = true;
}

}  // namespace abut::contact
