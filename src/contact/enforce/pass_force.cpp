// What a pass does with a measured node: stiffness for the step, first and last force, damping, friction.
#include <algorithm>
#include <cmath>

#include "contact/enforce/account.hpp"
#include "contact/enforce/coefficient.hpp"
#include "contact/enforce/effective_mass.hpp"
#include "contact/enforce/pass.hpp"
#include "contact/enforce/switching.hpp"

namespace abut::contact {

Vec3 Pass::velocity_over(const HostState& host, const Side& held, const Side& surface, Index i, const SurfacePoint& point) {
  const std::array<Index, 4>& corner = surface.surface().local()[static_cast<std::size_t>(point.facet)];
  Vec3 v = host.v[at(held.nodes()[at(i)])];
  for (std::size_t c = 0; c < 4; ++c) {
    if (point.weight[c] != 0.0) v -= point.weight[c] * host.v[at(surface.nodes()[at(corner[c])])];
  }
  return v;
}

Pass::Kinematics Pass::kinematics(const HostState& host, const Side& held, const Side& surface, Index i, const Touch& touch) const {
  Kinematics k;
  const Vec3 v = velocity_over(host, held, surface, i, {touch.weight, touch.facet});
  k.rate = dot(v, touch.normal);
  k.tangential_velocity = v - k.rate * touch.normal;
  return k;
}

double Pass::inverse_mass(const Scene& scene, Index i, const Touch& touch, const Vec3& along, const Springs& springs) const {
  const auto& [host, held, surface, held_loads, surface_loads] = scene;
  const std::array<Index, 4>& corner = surface.surface().local()[at(touch.facet)];
  double spread = 0.0;
  for (const double w : touch.weight) spread += std::abs(w);
  const Index node = held.nodes()[at(i)];
  double sum = springs.over(springs.on(host, node, held_loads, i, Springs::no_limit), 1.0, 1.0) * inverse_mass_of(host, node, along);
  for (std::size_t c = 0; c < 4; ++c) {
    const double w = std::abs(touch.weight[c]);
    if (w == 0.0) continue;
    const Index n = surface.nodes()[at(corner[c])];
    sum += springs.over(springs.on(host, n, surface_loads, corner[c], springs.passes * std::sqrt(w)), w, spread) *
           inverse_mass_of(host, n, along);
  }
  return sum;
}

void Pass::look_ahead(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i) const {
  // No facet known within reach: only a node that flies further than the lists see can touch in the coming step.
  const Index node = held.nodes()[at(i)];
  const Vec3 v = host.v[at(node)] - (host.dt > 0.0 ? mean_step_ / host.dt : Vec3{});
  const Vec3 flight = (1.5 * step_growth * host.dt) * v;
  if (norm(flight) + 2.0 * surface_step_ <= reach() - largest_gap_) return;
  Bounds path;
  path.include(held.x()[at(i)]);
  path.include(held.x()[at(i)] + flight);
  double largest = 0.0;
  candidates_.near(path, largest_gap_ + 2.0 * surface_step_, [&](Index f) {
    // The boxes of the lists are as old as the lists: only those of now may count.
    Bounds box = facet_bounds(surface.patch(f));
    box.inflate(largest_gap_ + 2.0 * surface_step_);
    if (box.meets(path)) largest = std::max(largest, plain_stiffness(held, surface, i, f));
  });
  held_loads.load(i).own_stiffness += largest * law_of(largest_gap_).tangent(1e30);
}

double Pass::stepped_without_facet(const HostState& host, const Side& held, const Side& surface, Index i) const {
  const NodeState& before = states_.before(i);
  if (before.held == 0 || before.reckoned == 0 || host.dt <= 0.0) return 0.0;
  const double rate = dot(velocity_over(host, held, surface, i, before.last), before.normal);
  return made_by_changing_step(before.force + before.damping, step_before(host.dt, host.dt_bar_old), host.dt, before.rate, rate);
}

bool Pass::keeps_its_account(const Touch& touch, const NodeState& before, double moved_in, double made) const {
  constexpr double unpaid = 0.2, at_once = 0.3;  // of what it holds by the law
  if (!closest() || !settled_ || (before.held != 0 && before.reckoned == 0)) return false;
  if (before.light == NodeState::passive) return true;
  if (made <= unpaid * touch.pair.potential) return false;
  if (before.held == 0) return moved_in < touch.penetration;  // else its first force sees to it
  const bool in_strip = touch.pair.stiffness < touch.pair.whole;
  // A last force left it nearly nothing: what the law holds where it turns round is not its own.
  return in_strip || before.light == NodeState::settled ||
         ((dot(before.normal, touch.normal) < turns || before.facet != touch.facet) && made - before.made > at_once * touch.pair.potential);
}

void Pass::finish_node(const Scene& scene, Index i, Touch& touch, bool rub, GroupSums& sums) {
  const auto& [host, held, surface, held_loads, surface_loads] = scene;
  PassTotals& totals = sums.totals;
  const NodeState& before = states_.before(i);
  NodeState& after = states_.after(i);
  const Rules& rules = options_.rules;
  if (!touch.known) {
    totals.stepped += stepped_without_facet(host, held, surface, i);
    if (!closest() || touch.far || !rules.limits_step || host.dt <= 0.0) return;
    look_ahead(host, held, surface, held_loads, i);
    return;
  }
  const double penetration = touch.penetration;
  const Kinematics motion = kinematics(host, held, surface, i, touch);
  const double pair_inverse_mass = options_.damping > 0.0 ? inverse_mass(scene, i, touch, touch.normal, {}) : 0.0;
  if (touch.full_gap > 0.0 && -motion.rate * host.dt >= -passed_over * penetration) {
    totals.largest_approach = std::max(totals.largest_approach, -motion.rate * host.dt / touch.full_gap);
  }
  // Speed at which P grows: by motion, and by a gap that grows in a gradual start.
  const double grown = growth(before);
  const double closing = -motion.rate + (grown > 0.0 && host.dt > 0.0 ? grown / host.dt : 0.0);
  double step_stiffness = 0.0, spring = 0.0;

  // Stiffness for the coming step, also where contact may begin in it.
  if (rules.limits_step) {
    const double ahead = 1.5 * step_growth * host.dt * std::max(closing, 0.0);
    const bool may_touch = host.dt > 0.0 ? penetration + ahead > 0.0 : penetration > -0.25 * size_;
    if (may_touch && touch.pair_open) { touch.pair = force_of(held, surface, touch.measure, i, touch.gap, touch.widens); }
    if (touch.contact || (may_touch && touch.pair.stiffness > 0.0)) {
      const double reached = std::max(penetration + step_growth * host.dt * std::max(closing, 0.0), 1e-12 * size_);
      spring = touch.pair.stiffness * touch.law.tangent(reached);
      double tangent = spring + touch.pair.extra_tangent;
      if (options_.rubs()) {
        const double pressure = surface.pressure(touch.facet, touch.pair.magnitude);
        const double mu = friction_coefficient(options_.friction_law, options_.friction, pressure, norm(motion.tangential_velocity));
        tangent *= std::max(std::sqrt(1.0 + mu * mu), options_.tangential_ratio);
      }
      if (options_.damping > 0.0) {
        // With viscous forces from the step before, h^2 K/4 + h C/2 <= 1: in the terms of one spring (sqrt(1 + z^2) + z)^2, or 2 C/h.
        const double z = options_.damping;
        const double root = std::sqrt(1.0 + z * z) + z;
        const double c = pair_inverse_mass > 0.0 ? 2.0 * z * std::sqrt(tangent / pair_inverse_mass) : 0.0;
        tangent = std::max(tangent * root * root, host.dt > 0.0 ? tangent + 2.0 * c / host.dt : 0.0);
      }
      double spread = 0.0;
      for (const double w : touch.weight) spread += std::abs(w);
      tangent *= 0.5 * (1.0 + spread);
      SideLoads::Node& load = held_loads.load(i);
      load.own_stiffness += tangent;
      load.own_springs += spring;
      step_stiffness = tangent;
    }
    foresee_strips(host, held, surface, held_loads, i, sums);
    if (touch.law.stiffens() && closing > 0.0) {
      const double room = std::max(touch.full_gap - penetration, (1.0 - NormalLaw::bend) * touch.full_gap);
      const double horizon = touch.contact ? 2.0 : 0.5 / passed_over;
      const bool soon = host.dt <= 0.0 || 0.5 * room < horizon * host.dt * closing;
      if (soon && 0.5 * room / closing < totals.kinematic_step) {
        totals.kinematic_step = 0.5 * room / closing;
        totals.kinematic_node = held.nodes()[at(i)];
      }
    }
  }

  const double h_before = step_before(host.dt, host.dt_bar_old);
  double made = 0.0;  // energy that the pair has made, before this cycle's force
  // Along the normal that it was taken along before: where the normal turns, that is no acceleration.
  const double rate_along_last =
      before.held != 0 && closest() ? dot(motion.rate * touch.normal + motion.tangential_velocity, before.normal) : motion.rate;
  if (before.held != 0) {
    const double by_step = made_by_changing_step(before.force, h_before, host.dt, before.rate, rate_along_last);
    totals.stepped += by_step + made_by_changing_step(before.damping, h_before, host.dt, before.rate, rate_along_last);
    if (before.reckoned != 0) {
      made = before.made - before.stored + 0.5 * host.dt * dot(before.push, velocity_over(host, held, surface, i, before.last)) + by_step;
    }
  }

  if (!touch.contact) {  // history of a contact that ends: closed by the caller
    if (step_stiffness > 0.0) {
      Reaction& reaction = sums.reactions.emplace_back(touch.facet, step_stiffness, spring, touch.weight);
      reaction.normal.fill({});
      reaction.tangential = Vec3{};
    }
    return;
  }
  totals.in_contact += 1;
  if (penetration > totals.largest_penetration) {
    totals.largest_penetration = penetration;
    totals.deepest_node = held.nodes()[at(i)];
  }
  sums.in_contact.push_back(held.nodes()[at(i)]);
  if (touch.fresh_hit) sums.crossed.push_back(held.nodes()[at(i)]);

  const double share = 1.0 / static_cast<double>(touch.equals);
  const bool fresh = before.held == 0;
  double fraction = 1.0;  // of the last step in contact
  double factor = 1.0;
  const double moved_in = closing * host.dt;
  // What is known of other springs is a cycle old. Where nothing is, with two passes the facing surface's own springs act on this pair too,
  // as strongly as this one where the meshes face.
  const double as_known = before.held != 0 && before.step_stiffness > 0.0F ? static_cast<double>(before.step_stiffness) : step_stiffness;
  const auto own_before = static_cast<double>(held_loads.own_before[at(i)]);
  const Springs springs{two_passes_ ? 2.0 : 1.0, as_known, own_before > 0.0 ? own_before : spring};
  const double inverse_mass = this->inverse_mass(scene, i, touch, touch.normal, springs);
  if (fresh && moved_in > penetration) fraction = penetration / moved_in;
  double stored = touch.pair.potential;
  const Vec3 velocity = motion.rate * touch.normal + motion.tangential_velocity;
  // On bodies an account costs little, and pairs that leave one after the other let the step grow under those that stay.
  const double alone = host.mobility.empty() ? 0.0 : springs.passes * this->inverse_mass(scene, i, touch, touch.normal, {});
  const double at_most = std::max(inverse_mass, alone);
  const double lightness = at_most * touch.pair.stiffness * touch.law.tangent(penetration) * host.dt * host.dt;
  // Over a fold the law's trapezoidal work misses its potential at any stiffness: where the normal turns within a step, or where a node
  // comes from in front deeper than its motion along the normal.
  const bool over_fold = closest() && rules.switch_correction && grown == 0.0 &&
                         (fresh ? moved_in <= penetration && before.in_front != 0 : dot(before.normal, touch.normal) < turns);
  bool passive = false;
  bool settled = before.light == NodeState::settled && motion.rate > 0.0;  // until it turns round
  const bool light = lightness > light_pair || before.light != 0 || over_fold;
  if (rules.switch_correction && host.dt > 0.0 && touch.pair.magnitude > 0.0) {
    // Before the first step no springs were known, which on bodies count: what the first force did is by those that are known now.
    const bool after_start = is_first_step(host.dt, host.dt_bar_old) && !host.mobility.empty();
    const double given = after_start ? (before.force + before.damping) * inverse_mass : before.acceleration;
    const double others = !fresh && host.dt_bar_old > 0.0 ? (rate_along_last - before.rate) / host.dt_bar_old - given : 0.0;
    const double coming = foreseen_step(h_before, host.dt);
    const Switching s{touch.law, touch.pair.stiffness, penetration, host.dt, -closing, inverse_mass, others, coming};
    const Switched switched = switched_force(s, fresh);
    // Where the force has other parts than the law's at this depth (strips that widen, facets that store more), they go with it.
    const double lawful = touch.pair.stiffness * touch.law.force(penetration);
    const double held_by_law = touch.pair.stiffness * touch.law.potential(penetration);
    double force = switched.force * (lawful > 0.0 ? touch.pair.magnitude / lawful : 1.0);
    stored = switched.stored * (held_by_law > 0.0 ? touch.pair.potential / held_by_law : 1.0);
    // A light pair settles its account when it opens within the coming step, which may grow where this contact is what holds it.
    const double longest = step_growth * host.dt;
    const double leaves = motion.rate + 0.5 * (host.dt + longest) * (inverse_mass * touch.pair.magnitude + others);
    if (light && leaves * longest > penetration && grown == 0.0 && (fresh ? moved_in > penetration : before.reckoned != 0)) {
      settled = closest();
      force = last_force({motion.rate, host.dt, coming, inverse_mass, others, -made});
      const double bound = touch.pair.stiffness * touch.law.force(4.0 * coming * leaves);
      force = std::clamp(force, switched.force - bound, switched.force + bound);
      const double rate = motion.rate + 0.5 * (host.dt + coming) * (inverse_mass * force + others);
      stored = 0.5 * force * rate * coming + made_by_changing_step(force, host.dt, coming, motion.rate, rate);
      // Where the account asks for a force of its own, the step must be the one it was made for.
      if (rules.limits_step && std::abs(force - switched.force) > 1e-3 * touch.pair.magnitude && coming < totals.kinematic_step) {
        totals.kinematic_step = coming;
        totals.kinematic_node = held.nodes()[at(i)];
      }
    } else if (settled && motion.rate > 0.0) {
      // It has not left but met another facet: what that would give back and was not taken before is not there.
      const double left = std::clamp(-made / touch.pair.potential, 0.0, 1.0);
      force = left * touch.pair.magnitude;
      stored = left * touch.pair.potential;
    }
    factor = force / touch.pair.magnitude;
    const bool is_last = settled && before.light < NodeState::settled;  // it settles the account itself
    const double along_push = dot(touch.pair.on_node, velocity);
    passive = grown == 0.0 && !is_last && keeps_its_account(touch, before, moved_in, made + 0.5 * factor * host.dt * along_push + stored);
    if (passive && factor > 0.0) {
      // Not more than what is left gives the bodies in the coming step; what it then holds is what it has taken.
      const double size = norm(touch.pair.on_node);
      const Vec3 along = touch.pair.on_node / size;
      const double mobile = this->inverse_mass(scene, i, touch, along, springs);
      const double rate = along_push / size;
      if (mobile > 0.0 || rate > 0.0)
        factor = std::min(factor, last_force({rate, host.dt, coming, mobile, others, std::max(0.0, -made)}) / size);
      stored = std::max(0.0, -made - 0.5 * factor * size * rate * host.dt);
    }
  }
  totals.potential += stored;
  double normal_force = factor * touch.pair.magnitude;
  Vec3 on_node = factor * touch.pair.on_node;
  totals.started += 0.5 * (before.force + normal_force) * grown;
  after.force = normal_force;
  after.push = on_node;
  after.stored = stored;
  // Of facets that are equally near the first stands for all.
  after.reckoned = rules.switch_correction && (fresh || before.reckoned != 0) ? 1 : 0;
  after.step_stiffness = static_cast<float>(step_stiffness);
  after.light = passive ? NodeState::passive : settled ? NodeState::settled : light ? 1 : 0;
  after.made = 0.0;
  if (after.reckoned != 0) {
    after.last = {touch.weight, touch.facet};
    const Vec3 step = host.dt * velocity;
    // A first force of the law is made for what it stores; over a fold it is not, and the difference is in the account.
    if (!fresh || over_fold || passive) after.made = made + 0.5 * dot(on_node, step) + stored - 0.5 * (before.force + normal_force) * grown;
  }
  after.damping = 0.0;
  if (options_.damping > 0.0 && pair_inverse_mass > 0.0) {
    const double c = 2.0 * options_.damping * std::sqrt(touch.pair.stiffness * touch.law.tangent(penetration) / pair_inverse_mass);
    after.damping = std::max(-c * motion.rate, -normal_force);
    totals.damped += std::max(0.0, -0.5 * (before.damping + after.damping) * motion.rate * host.dt);
    on_node += after.damping * touch.normal;
  }
  held_loads.load(i).own_normal = on_node;
  totals.normal += on_node;

  if (!seen_gap_.empty()) seen_gap_[at(i)] = touch.full_gap;
  after.held = touch.widens ? 2 : 1;
  after.facet = touch.facet;
  after.normal = touch.normal;
  after.rate = motion.rate;
  after.acceleration = (normal_force + after.damping) * inverse_mass;
  normal_force += after.damping;

  Vec3 tangential;  // on the surface
  if (options_.rubs() && rub) {
    // The force that settles an account may pull a little: nothing rubs then.
    const double pressing = std::max(normal_force, 0.0);
    const double mu = friction_coefficient(options_.friction_law, options_.friction, surface.pressure(touch.facet, pressing),
                                           norm(motion.tangential_velocity));
    double limit = mu * pressing;
    if (options_.shear_limit < 1e29 && !rules.reference_friction) {
      const double own_area = held.facet_count() > 0 ? held.tributary_area(i) : surface.facet_area(touch.facet);
      // Two passes act on the same area: each may carry half of the stress.
      limit = std::min(limit, (two_passes_ ? 0.5 : 1.0) * options_.shear_limit * own_area);
    }
    const Vec3 on_surface = rules.reference_friction
                                ? rub_by_anchor(host, surface, touch, limit, before, after, totals)
                                : rub_by_return_mapping(host, surface, touch, motion, limit, fraction, before, after, totals);
    slips_[at(i)] = norm(on_surface) >= (1.0 - 1e-9) * limit ? 1 : 0;
    held_loads.load(i).own_tangential = -on_surface;
    tangential = share * on_surface;
    totals.tangential -= on_surface;
  }
  const double push = norm(touch.pair.on_node);
  const double tangential_stiffness = options_.rubs() && rub && closest() ? after.tangential_stiffness : 0.0;
  double node_share = 0.0;
  const auto add = [&](const Measure& m, const std::array<Vec3, 4>& force, bool equal) {
    const std::array<double, 4>& weight = m.closest.weight;
    // Of several facets each has what it carries.
    const double carried = touch.further > 0 && push > 0.0 ? norm((force[0] + force[1]) + (force[2] + force[3])) / push : 1.0;
    Reaction& reaction = sums.reactions.emplace_back(m.facet, step_stiffness, std::min(carried, 1.0) * spring, weight);
    for (std::size_t c = 0; c < 4; ++c) {
      reaction.normal[c] = equal ? factor * force[c] - (share * weight[c] * after.damping) * touch.normal : factor * force[c];
    }
    reaction.tangential = equal ? tangential : Vec3{};
    if (!equal || tangential_stiffness <= 0.0) return;
    const FrictionCouple couple = friction_couple(scene.surface.patch(m.facet), m.closest, scene.held.x()[at(i)], tangential);
    for (std::size_t c = 0; c < 4; ++c) {
      reaction.normal[c] = Vec3(reaction.normal[c]) + couple.on_facet[c];
      reaction.stiffness[c] += tangential_stiffness * couple.corner_share[c];
    }
    node_share = std::max(node_share, couple.node_share);
  };
  add(touch.measure, touch.pair.on_facet, true);
  for (std::size_t k = touch.first_further; k < touch.first_further + touch.further; ++k) {
    const Further& one = sums.further[k];
    if (one.acts) add(one.measure, one.on_facet, one.equal);
  }
  held_loads.load(i).own_stiffness += tangential_stiffness * node_share;
}

}  // namespace abut::contact
