// Forces of a pair that repels on both sides (TYPE7), and what it hands to the nodal sums of stiffness.
//
// Equation contract: both_sides_pair.hpp for the law and the damper, switching.hpp for the cycles in which a pair starts and ends.
#include <algorithm>
#include <cmath>

#include "contact/enforce/account.hpp"
#include "contact/enforce/both_sides.hpp"
#include "contact/enforce/both_sides_pair.hpp"
#include "contact/enforce/coefficient.hpp"
#include "contact/enforce/effective_mass.hpp"
#include "contact/enforce/held_kernel.hpp"
#include "contact/enforce/switching.hpp"

namespace abut::contact {

namespace {

/// A node whose gap is used up to this share of the gap leaves for good: its force has no finite value any more.
constexpr double exhausted = 1e-10;
/// Steps, as long as its spring alone allows them, from which on a pair that will touch counts.
constexpr double settling = 4.0;

}  // namespace

/// How the node moves relative to the facet's point under it, with the pair's inverse mass: springs that press on one node share its mass
/// in proportion to their stiffness along the normal (a node over the corner of four facets has four), so
///   1/m = (n.P_s n/k)/m_s + sum H_k (n.P_k n/k)/m_k,   P = sum k' H' n' n'^T over all pairs of the node that act; pairs yet to touch:
///   alone.
BothSides::Opening BothSides::opening(const HostState& host, Index node, Index facet, const BothSidesContact& c) const {
  const auto& corner = surface_.surface().local()[at(facet)];
  const auto host_of = [this](Index own) { return at(own_[at(own)]); };
  const double k = pair_stiffness(node, facet);
  const auto share = [&](Index own, double weight) {
    const double all = pressed_.empty() || k <= 0.0 ? 0.0 : dot(c.normal, pressed_[at(own)] * c.normal);
    return weight * std::max(weight, all / k);
  };
  const auto inverse = [&](std::size_t n) { return inverse_mass_of(host, static_cast<Index>(n), c.normal); };
  Opening m;
  const std::size_t self = host_of(held_own_[at(node)]);
  m.velocity = host.v[self];
  m.inverse_mass = share(held_own_[at(node)], 1.0) * inverse(self);
  for (std::size_t i = 0; i < 4; ++i) {
    if (c.weight[i] == 0.0) continue;
    const std::size_t to = host_of(surface_own_[at(corner[i])]);
    m.velocity -= c.weight[i] * host.v[to];
    m.inverse_mass += share(surface_own_[at(corner[i])], c.weight[i]) * inverse(to);
  }
  m.rate = dot(m.velocity, c.normal);
  return m;
}

/// What leap-frog made by a step that changed under the pair's last normal force (account.hpp).
double BothSides::stepped(const HostState& host, const Pair& old, double rate) const {
  if (old.acts == State::apart || host.dt <= 0.0) return 0.0;
  return made_by_changing_step(old.force, step_before(host.dt, host.dt_bar_old), host.dt, old.rate, rate);
}

/// Depth at which the spring alone stops the pair (at most half the gap beyond p's own). Energy keeps it the same from the first touch to
/// the last, and with it the tangent there and the step.
double BothSides::stop_depth(double k0, double gap, double p, const Opening& m) const {
  if (m.inverse_mass <= 0.0) return p;
  return std::max(p, std::min(std::sqrt(p * p + m.rate * m.rate / (k0 * m.inverse_mass)), 0.5 * gap));
}

/// Elastic force and stored energy of a cycle: the law's own, but for the cycles in which the pair starts or ends (switching.hpp). A light
/// pair ends with what is left in its account (account.hpp).
BothSides::Spring BothSides::spring(const HostState& host, const Pair& old, Pair& pair, const PairLaw& l, const Opening& m,
                                    StepResult& result) const {
  const double h = host.dt, h_before = step_before(h, host.dt_bar_old);
  const bool fresh = old.acts == State::apart;
  double made = 0.0;  // by this spring, before this cycle's force
  if (!fresh) made = old.made - old.held + 0.5 * h * old.push * m.rate + made_by_changing_step(old.push, h_before, h, old.rate, m.rate);
  Spring s{l.force.elastic, l.force.energy};
  pair.acts = State::acts;
  if (options_.switch_correction && h > 0.0) {
    // The damper of this cycle is one of the others.
    const double before = !fresh && host.dt_bar_old > 0.0 ? (m.rate - old.rate) / host.dt_bar_old - old.acceleration : 0.0;
    const double others = before - l.force.damping * m.rate * m.inverse_mass;
    const double moved_in = -m.rate * h;
    if (l.p + std::abs(moved_in) <= NormalLaw::bend * l.gap) {
      const Switched switched = switched_spring({NormalLaw{l.gap, true}, l.k0, l.p, h, m.rate, m.inverse_mass, others}, fresh);
      s = {switched.force, switched.stored};
    }
    const bool light = old.acts >= State::light || l.force.tangent * m.inverse_mass * h * h > light_pair;
    if (light) pair.acts = State::light;
    const double coming = foreseen_step(h_before, h);
    const double longest = step_growth * h;
    const double leaves = m.rate + 0.5 * (h + longest) * (m.inverse_mass * l.force.elastic + others);
    if (light && pair.offset == 0.0 && leaves * longest > l.p && (!fresh || moved_in > l.p)) {
      pair.acts = State::settled;
      const double bound = 4.0 * l.k0 * coming * leaves;
      const double force = std::clamp(last_force({m.rate, h, coming, m.inverse_mass, others, -made}), s.force - bound, s.force + bound);
      const double rate = m.rate + 0.5 * (h + coming) * (m.inverse_mass * force + others);
      // The step must be the one that the force was made for.
      if (std::abs(force - s.force) > 1e-3 * l.force.elastic && coming < result.kinematic_step) {
        result.kinematic_step = coming;
        result.kinematic_node = held_.nodes()[at(pair.node)];
      }
      s = {force, 0.5 * force * rate * coming + made_by_changing_step(force, h, coming, m.rate, rate)};
    } else if (old.acts == State::settled && m.rate > 0.0) {
      // It has not left: what it would give back and was not taken before is not there.
      const double left = std::clamp(-made / l.force.energy, 0.0, 1.0);
      pair.acts = State::settled;
      s = {left * l.force.elastic, left * l.force.energy};
    }
  }
  pair.push = s.force;
  pair.held = s.stored;
  pair.made = fresh ? 0.0 : made + 0.5 * h * s.force * m.rate + s.stored;
  return s;
}

/// Tangential stiffness of the incremental form.
double BothSides::friction_spring(const HostState& host, Index node, Index facet) const {
  if (!options_.rubs() || options_.friction_form == BothSidesOptions::Friction::viscous) return 0.0;
  return options_.filter.weight(host.dt_bar_old) * pair_stiffness(node, facet);
}

/// What a pair hands to the nodal sums: dampers count with the shorter of the last step and the one that the spring alone allows, which
/// says what comes where the last step was much longer, or was none.
double BothSides::handed(const HostState& host, double elastic, const BothSidesForce& law, double spring, const Opening& m) const {
  const double last = host.dt > 0.0 ? 1.0 / host.dt : 0.0;
  const double inverse_h = options_.reference_step ? last : std::max(2.0 * last, std::sqrt(elastic * m.inverse_mass));
  const double viscous = options_.rubs() ? options_.friction_viscosity * law.critical * inverse_h : 0.0;
  const double tangent = std::max(elastic + law.damping * inverse_h, viscous);
  return options_.reference_step ? tangent : std::max(tangent, spring);
}

Vec3 BothSides::friction_of(const HostState& host, const Pair& old, Pair& pair, const Vec3& normal, const Vec3& v, double vn,
                            double pressing, double critical, Sums& sums, bool& slips) const {
  const Vec3 vt = v - vn * normal;
  const double speed = norm(vt);
  const double pressure = surface_.pressure(pair.facet, std::abs(pressing));
  const double limit = friction_coefficient(options_.friction_law, options_.friction, pressure, speed) * std::abs(pressing);
  const double a = options_.filter.weight(host.dt_bar_old);
  if (options_.friction_form == BothSidesOptions::Friction::viscous) {
    Vec3 force{};
    slips = options_.friction_viscosity * critical * speed > limit;
    if (speed > 0.0) force = (std::min(limit, options_.friction_viscosity * critical * speed) / speed) * vt;
    if (options_.filter.acts()) force = a * force + (1.0 - a) * old.friction;
    sums.friction_work += std::max(0.0, 0.5 * host.dt * dot(vt, force + old.friction));
    return force;
  }
  pair.spring = friction_spring(host, pair.node, pair.facet);
  Vec3 force = old.friction + (pair.spring * host.dt_bar_old) * v;
  force -= dot(force, normal) * normal;
  const double size = norm(force);
  slips = size > limit;
  if (slips) force = (limit / size) * force;
  if (pair.spring > 0.0) {
    const double stored = 0.5 * squared_norm(force) / pair.spring;
    const double stored_before = old.spring > 0.0 ? 0.5 * squared_norm(old.friction) / old.spring : 0.0;
    sums.elastic += stored;
    if (slips) sums.friction_work += std::max(0.0, 0.5 * host.dt * dot(vt, force + old.friction) - (stored - stored_before));
  }
  return force;
}

bool BothSides::add_pair(const HostState& host, Index node, Index facet, const Pair& old, std::span<double> stiffness, StepResult& result,
                         Sums& sums) {
  const auto& corner = surface_.surface().local()[at(facet)];
  const bool triangle = surface_.surface().is_triangle(facet);
  const std::size_t corners = triangle ? 3 : 4;
  const Met met = meet(held_, surface_, node, facet, pair_gap(node, facet));
  const BothSidesContact& c = met.contact;
  const double k = pair_stiffness(node, facet);
  if (c.penetration <= 0.0) {
    if (k > 0.0 && c.distance < met.gap + foreseen_way()) foresee(host, {node, facet}, stiffness, result);
    return false;
  }
  if (met.gap - c.penetration < exhausted * met.gap) {
    gone_[at(node)] = 1;
    return false;
  }
  Pair pair{node, facet, offset_of(old, met.gap, c.penetration), {}};
  const double p = c.penetration - pair.offset;
  const double gap = met.gap - pair.offset;
  if (p <= 0.0 || k <= 0.0) {
    if (k > 0.0) foresee(host, pair, stiffness, result);
    pairs_.push_back(pair);
    return false;
  }
  const auto host_of = [this](Index own) { return at(own_[at(own)]); };
  const std::size_t self = host_of(held_own_[at(node)]);
  const Opening m = opening(host, node, facet, c);
  const double vn = m.rate;
  if (vn < 0.0) {
    const double step = 0.5 * (gap - p) / -vn;
    if (options_.step_minimum > 0.0 && step <= options_.step_minimum) {
      gone_[at(node)] = 1;
      return false;
    }
    if (step < result.kinematic_step) {
      result.kinematic_step = step;
      result.kinematic_node = held_.nodes()[at(node)];
    }
  }

  // Dampers of a node that cannot move are those of what it meets.
  const double own_mass = mass_of(host, self);
  const double mass = own_mass > 0.0 || m.inverse_mass <= 0.0 ? own_mass : 1.0 / m.inverse_mass;
  const BothSidesForce law = both_sides_force(0.5 * k, gap, p, mass, vn, options_.damping);
  const Spring elastic = spring(host, old, pair, {0.5 * k, gap, p, law}, m, result);
  pair.damping = -law.damping * vn;
  const double pressing = elastic.force + pair.damping;
  sums.stepped += stepped(host, old, vn);
  pair.rate = vn;
  pair.force = pressing;
  pair.acceleration = pressing * m.inverse_mass;
  bool slips = true;
  if (options_.rubs()) pair.friction = friction_of(host, old, pair, c.normal, m.velocity, vn, pressing, law.critical, sums, slips);
  if (slips) slips_[at(node)] = 1;

  const Vec3 normal = pressing * c.normal;
  const std::array<double, 4> share = triangle || !options_.all_pieces ? c.weight : without_hourglass(c.weight);
  const Index own = held_own_[at(node)];
  normal_[at(own)] += normal;
  tangential_[at(own)] -= pair.friction;
  const double ratio = gap / (gap - stop_depth(0.5 * k, gap, p, m));
  const double lasting = options_.switch_correction ? 0.5 * k * ratio * ratio : law.tangent;
  const double tangent = handed(host, lasting, law, pair.spring, m);
  stiffness[self] += tangent;
  double smallest = mass > 0.0 ? 2.0 * mass / tangent : 1e30;
  for (std::size_t i = 0; i < corners; ++i) {
    const Index to = surface_own_[at(corner[i])];
    normal_[at(to)] -= share[i] * normal;
    tangential_[at(to)] += share[i] * pair.friction;
    stiffness[host_of(to)] += share[i] * tangent;
    const double corner_mass = mass_of(host, host_of(to));
    if (share[i] > 0.0 && corner_mass > 0.0) smallest = std::min(smallest, 2.0 * corner_mass / (share[i] * tangent));
  }
  if (options_.step_minimum > 0.0 && options_.step_scale * std::sqrt(smallest) <= options_.step_minimum) gone_[at(node)] = 1;
  result.normal_force -= normal;
  result.tangential_force += pair.friction;
  if (p > result.largest_penetration) {
    result.largest_penetration = p;
    result.deepest_node = held_.nodes()[at(node)];
  }
  result.largest_approach = std::max(result.largest_approach, -vn * host.dt / met.gap);
  sums.elastic += elastic.stored;
  sums.damping_work -= 0.5 * host.dt * vn * (pair.damping + old.damping);
  pairs_.push_back(pair);
  return true;
}

/// What a pair that has opened or ended still did in the first half of the last step, and what its friction spring lets go of.
void BothSides::end(const HostState& host, const Pair& old, Sums& sums) const {
  if (old.spring > 0.0) sums.friction_work += 0.5 * squared_norm(old.friction) / old.spring;
  if (old.acts == State::apart) return;
  const double gap = pair_gap(old.node, old.facet);
  const Met near = meet(held_, surface_, old.node, old.facet, gap);
  const BothSidesContact c =
      near.contact.penetration > 0.0 ? near.contact : meet(held_, surface_, old.node, old.facet, 1.5 * near.contact.distance).contact;
  const Opening m = opening(host, old.node, old.facet, c);
  sums.damping_work -= 0.5 * host.dt * m.rate * old.damping;
  sums.stepped += stepped(host, old, m.rate);
  if (options_.friction_form == BothSidesOptions::Friction::viscous) {
    sums.friction_work += std::max(0.0, 0.5 * host.dt * dot(m.velocity - m.rate * c.normal, old.friction));
  }
}

/// Time that is looked ahead, two of the longest steps so far: the coming step is not longer (kinematic_step). Before the first step: as
/// long as any can be.
double BothSides::looked_ahead() const { return longest_step_ > 0.0 ? 2.0 * longest_step_ : foresight * narrowest_ / fastest_; }

/// How far any pair can come in that time; no step goes further than a part of the least gap.
double BothSides::foreseen_way() const {
  if (!options_.switch_correction || fastest_ <= 0.0) return 0.0;
  return std::min(looked_ahead() * fastest_, foresight * narrowest_);
}

/// A pair that will touch within a few of the steps that its spring allows already counts in the nodal sums of stiffness. The step is then
/// short when it touches: leap-frog makes f (h - h')(v' - v)/4 where the step changes from h to h' under a force f (docs/theory/contact.md,
/// 3 and 7a). Longer steps come nearer by half of the way.
void BothSides::foresee(const HostState& host, const Pair& pair, std::span<double> stiffness, StepResult& result) const {
  const double ahead = foreseen_way();
  if (ahead <= 0.0) return;
  const Met met = meet(held_, surface_, pair.node, pair.facet, pair_gap(pair.node, pair.facet) + ahead);
  const BothSidesContact& c = met.contact;
  if (c.penetration <= pair.offset) return;
  const Opening m = opening(host, pair.node, pair.facet, c);
  const double left = ahead + pair.offset - c.penetration;
  if (left >= -looked_ahead() * m.rate) return;
  const double gap = met.gap - ahead - pair.offset;
  const double k0 = 0.5 * pair_stiffness(pair.node, pair.facet);
  const double stop = stop_depth(k0, gap, 0.0, m);
  const double ratio = gap / (gap - stop);
  const double elastic = k0 * ratio * ratio;
  const double time = left / -m.rate;
  if (time * std::sqrt(elastic * m.inverse_mass) > 2.0 * settling) {
    if (0.5 * time < result.kinematic_step) {
      result.kinematic_step = 0.5 * time;
      result.kinematic_node = held_.nodes()[at(pair.node)];
    }
    return;
  }
  const auto& corner = surface_.surface().local()[at(pair.facet)];
  const auto host_of = [this](Index own) { return at(own_[at(own)]); };
  const std::size_t self = host_of(held_own_[at(pair.node)]);
  const BothSidesForce law = both_sides_force(k0, gap, stop, mass_of(host, self), m.rate, options_.damping);
  const double tangent = handed(host, elastic, law, friction_spring(host, pair.node, pair.facet), m);
  stiffness[self] += tangent;
  for (std::size_t i = 0; i < 4; ++i) {
    if (c.weight[i] > 0.0) stiffness[host_of(surface_own_[at(corner[i])])] += c.weight[i] * tangent;
  }
}

/// Bound of the speed of any node relative to any facet; 0 where it is not finite.
double BothSides::fastest(const HostState& host) const {
  constexpr double big = 1e300;
  Vec3 held_low{big, big, big}, held_high{-big, -big, -big}, low = held_low, high = held_high;
  for (Index i = 0; i < held_.node_count(); ++i) {
    if (gone_[at(i)] != 0) continue;
    const Vec3& v = host.v[at(held_.nodes()[at(i)])];
    for (int k = 0; k < 3; ++k) {
      held_low[k] = std::min(held_low[k], v[k]);
      held_high[k] = std::max(held_high[k], v[k]);
    }
  }
  for (const Index n : surface_.nodes()) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], host.v[at(n)][k]);
      high[k] = std::max(high[k], host.v[at(n)][k]);
    }
  }
  Vec3 speed;
  for (int k = 0; k < 3; ++k) speed[k] = std::max({held_high[k] - low[k], high[k] - held_low[k], 0.0});
  const double size = norm(speed);
  return size > 0.0 && size <= big ? size : 0.0;
}

}  // namespace abut::contact
