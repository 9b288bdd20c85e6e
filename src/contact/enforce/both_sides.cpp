#include "contact/enforce/both_sides.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "contact/enforce/history.hpp"

namespace abut::contact {

namespace {

/// A node whose gap is used up to this share of the gap leaves for good: its force has no finite value any more.
constexpr double exhausted = 1e-10;
/// Placement of initial penetrations, a hair beyond what is there (numerics.md 7.7.1).
constexpr double hair = 1.0 + 1e-8;

BothSidesOptions checked(BothSidesOptions o) {
  if (!(o.gap > 0.0)) throw std::invalid_argument("a two-sided interface needs a gap > 0");
  if (!(o.friction >= 0.0)) throw std::invalid_argument("friction must be >= 0");
  return o;
}

}  // namespace

BothSides::BothSides(std::vector<Index> nodes, Surface surface, BothSidesOptions options)
    : options_(checked(std::move(options))), held_(nodes, std::vector<double>(nodes.size(), 1.0)), surface_(std::move(surface), true) {
  if (!options_.node_gap.empty() && options_.node_gap.size() != nodes.size())
    throw std::invalid_argument("node_gap: one value per held node");
  if (!options_.facet_gap.empty() && static_cast<Index>(options_.facet_gap.size()) != surface_.facet_count()) {
    throw std::invalid_argument("facet_gap: one value per facet");
  }
  own_.assign(held_.nodes().begin(), held_.nodes().end());
  own_.insert(own_.end(), surface_.nodes().begin(), surface_.nodes().end());
  std::sort(own_.begin(), own_.end());
  own_.erase(std::unique(own_.begin(), own_.end()), own_.end());
  const auto position = [this](Index node) { return static_cast<Index>(std::lower_bound(own_.begin(), own_.end(), node) - own_.begin()); };
  for (const Index n : held_.nodes()) held_own_.push_back(position(n));
  for (const Index n : surface_.nodes()) surface_own_.push_back(position(n));
  for (std::vector<Vec3>* array : {&normal_, &tangential_, &old_force_, &old_x_}) array->resize(own_.size());
  gone_.assign(held_.nodes().size(), 0);
}

void BothSides::set_surface(int side, const SurfaceState& state) {
  if (side != 1) throw std::invalid_argument("a two-sided interface has the surface on side 1 only");
  surface_.set(state, false);
}

double BothSides::pair_gap(Index node, Index facet) const {
  if (options_.node_gap.empty() || options_.facet_gap.empty()) return options_.gap;
  return std::max(options_.gap, std::min(options_.node_gap[at(node)] + options_.facet_gap[at(surface_.listed(facet))], options_.gap_max));
}

double BothSides::reach(Index node) const {
  if (gone_[at(node)] != 0) return -1.0;
  if (options_.node_gap.empty() || options_.facet_gap.empty()) return options_.gap;
  const double widest = *std::max_element(options_.facet_gap.begin(), options_.facet_gap.end());
  return std::max(options_.gap, std::min(options_.node_gap[at(node)] + widest, options_.gap_max));
}

void BothSides::search(const HostState& host) {
  held_.gather(host.x);
  surface_.gather(host.x);
  if (!acts(host)) return;
  candidates_.update(
      held_, surface_, [this](Index node) { return reach(node); }, 0.5 * options_.gap, !started_);
}

double BothSides::offset_of(const Pair& old, double gap, double p) const {
  if (options_.initial == BothSidesOptions::Initial::keep) return 0.0;
  const double margin = options_.initial == BothSidesOptions::Initial::offset_with_margin ? 0.05 * (gap - p) : 0.0;
  if (!started_) return p * hair + margin;
  return std::min(old.offset, 0.95 * old.offset + 0.05 * (p + margin));
}

void BothSides::add_pair(const HostState& host, Index node, Index facet, const Pair& old, std::span<double> stiffness, StepResult& result,
                         Sums& sums) {
  const auto& corner = surface_.surface().local()[at(facet)];
  const bool triangle = surface_.surface().facets()[at(facet)].is_triangle();
  const std::size_t corners = triangle ? 3 : 4;
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = surface_.x()[at(corner[k])];
  double gap = pair_gap(node, facet);
  const BothSidesContact c = both_sides_contact(held_.x()[at(node)], x, triangle, gap);
  if (c.penetration <= 0.0) return;
  if (gap - c.penetration < exhausted * gap ||
      (!started_ && options_.largest_penetration > 0.0 && c.penetration > options_.largest_penetration * gap)) {
    gone_[at(node)] = 1;
    return;
  }
  Pair pair{node, facet, offset_of(old, gap, c.penetration), {}};
  const double p = c.penetration - pair.offset;
  gap -= pair.offset;
  if (p <= 0.0) {
    pairs_.push_back(pair);
    return;
  }
  const auto host_of = [this](Index own) { return at(own_[at(own)]); };
  const std::size_t self = host_of(held_own_[at(node)]);
  Vec3 v = host.v[self];
  for (std::size_t k = 0; k < corners; ++k) v -= c.weight[k] * host.v[host_of(surface_own_[at(corner[k])])];
  const double vn = dot(v, c.normal);
  const Vec3 vt = v - vn * c.normal;

  const double k = surface_.facet_stiffness(facet);
  const BothSidesForce law = both_sides_force(0.5 * k, gap, p, host.mass[self], vn, options_.damping);
  const double pressing = law.elastic - law.damping * vn;
  const double limit = options_.friction * std::abs(pressing);
  if (options_.friction > 0.0) {
    if (options_.friction_form == BothSidesOptions::Friction::viscous) {
      const double speed = norm(vt);
      if (speed > 0.0) pair.friction = (std::min(limit, options_.friction_viscosity * law.critical * speed) / speed) * vt;
    } else {
      Vec3 trial = old.friction + (k * host.dt_bar_old) * v;
      trial -= dot(trial, c.normal) * c.normal;
      const double size = norm(trial);
      pair.friction = size > limit ? (limit / size) * trial : trial;
    }
  }
  const Vec3 normal = pressing * c.normal;
  const std::array<double, 4> share = triangle ? c.weight : without_hourglass(c.weight);
  const Index own = held_own_[at(node)];
  normal_[at(own)] += normal;
  tangential_[at(own)] -= pair.friction;
  const double inverse_h = host.dt > 0.0 ? 1.0 / host.dt : 0.0;
  const double viscous = options_.friction > 0.0 ? options_.friction_viscosity * law.critical * inverse_h : 0.0;
  const double tangent = std::max(law.tangent + law.damping * inverse_h, viscous);
  stiffness[self] += tangent;
  double smallest = 2.0 * host.mass[self] / tangent;
  for (std::size_t i = 0; i < corners; ++i) {
    const Index to = surface_own_[at(corner[i])];
    normal_[at(to)] -= share[i] * normal;
    tangential_[at(to)] += share[i] * pair.friction;
    stiffness[host_of(to)] += share[i] * tangent;
    if (share[i] > 0.0) smallest = std::min(smallest, 2.0 * host.mass[host_of(to)] / (share[i] * tangent));
  }
  if (options_.step_minimum > 0.0 && options_.step_scale * std::sqrt(smallest) <= options_.step_minimum) gone_[at(node)] = 1;
  if (vn < 0.0) {
    const double step = 0.5 * (gap - p) / -vn;
    if (options_.step_minimum > 0.0 && step <= options_.step_minimum) gone_[at(node)] = 1;
    if (step < result.kinematic_step) {
      result.kinematic_step = step;
      result.kinematic_node = held_.nodes()[at(node)];
    }
  }
  result.normal_force -= normal;
  result.tangential_force += pair.friction;
  result.largest_penetration = std::max(result.largest_penetration, p);
  result.largest_approach = std::max(result.largest_approach, -vn * host.dt / options_.gap);
  sums.elastic += law.energy;
  sums.friction_rate += 0.5 * dot(vt, pair.friction + old.friction);
  sums.damping_rate += law.damping * vn * vn;
  pairs_.push_back(pair);
}

StepResult BothSides::evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) {
  StepResult result;
  std::swap(pairs_, previous_);
  pairs_.clear();
  in_contact_.clear();
  std::fill(normal_.begin(), normal_.end(), Vec3{});
  std::fill(tangential_.begin(), tangential_.end(), Vec3{});
  Sums sums;
  if (acts(host)) {
    std::size_t next = 0;
    std::vector<Index>& facets = scratch_;
    for (Index node = 0; node < held_.node_count(); ++node) {
      if (gone_[at(node)] != 0) continue;
      facets.clear();
      const Index self = held_.nodes()[at(node)];
      for (const Candidates::Entry& entry : candidates_.of(node)) {
        const auto& corners = surface_.surface().facets()[at(entry.facet)].node;
        if (surface_.active(entry.facet) && std::find(corners.begin(), corners.end(), self) == corners.end()) facets.push_back(entry.facet);
      }
      std::sort(facets.begin(), facets.end());
      const std::size_t before = pairs_.size();
      for (const Index facet : facets) {
        while (next < previous_.size() && (previous_[next].node < node || (previous_[next].node == node && previous_[next].facet < facet)))
          ++next;
        const bool known = next < previous_.size() && previous_[next].node == node && previous_[next].facet == facet;
        add_pair(host, node, facet, known ? previous_[next] : Pair{node, facet, 0.0, {}}, stiffness, result, sums);
      }
      if (pairs_.size() > before) in_contact_.push_back(self);
    }
    speed_limit(host, result);
    started_ = true;
  }
  friction_work_ += host.dt * sums.friction_rate;
  damping_work_ += host.dt * sums.damping_rate;
  contact_work_ += discrete_work(host);
  for (std::size_t i = 0; i < own_.size(); ++i) force[at(own_[i])] += normal_[i] + tangential_[i];
  result.elastic = sums.elastic;
  result.friction_work = friction_work_;
  result.damping_work = damping_work_;
  result.made = contact_work_ + sums.elastic + friction_work_ + damping_work_;
  result.in_contact = static_cast<Index>(in_contact_.size());
  return result;
}

/// No node may cross the gap in one step, near or far (numerics.md 2.5, third term).
void BothSides::speed_limit(const HostState& host, StepResult& result) const {
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
  if (!(size > 0.0) || size > big) return;
  const double step = 0.9 * options_.gap / size;
  if (step < result.kinematic_step) result.kinematic_step = step;
}

double BothSides::discrete_work(const HostState& host) {
  double work = 0.0;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const Vec3& x = host.x[at(own_[i])];
    const Vec3 f = normal_[i] + tangential_[i];
    if (host.dt > 0.0) work += 0.5 * dot(f + old_force_[i], x - old_x_[i]);
    old_force_[i] = f;
    old_x_[i] = x;
  }
  return work;
}

void BothSides::add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const {
  for (std::size_t i = 0; i < own_.size(); ++i) {
    normal[at(own_[i])] += normal_[i];
    tangential[at(own_[i])] += tangential_[i];
  }
}

void BothSides::add_nodal_area(std::span<const Vec3>, std::span<double> area) const {
  for (Index s = 0; s < surface_.node_count(); ++s) {
    double& a = area[at(surface_.nodes()[at(s)])];
    a = std::max(a, surface_.tributary_area(s));
  }
}

std::vector<std::byte> BothSides::history() const {
  HistoryWriter out;
  out.put(static_cast<std::uint64_t>(pairs_.size()));
  out.put_all(pairs_);
  out.put_all(old_force_);
  out.put_all(old_x_);
  out.put_all(gone_);
  out.put(started_);
  out.put(friction_work_);
  out.put(damping_work_);
  out.put(contact_work_);
  return out.finish();
}

void BothSides::restore(std::span<const std::byte> history) {
  HistoryReader in(history);
  std::uint64_t count = 0;
  in.get(count);
  if (count > history.size()) throw std::invalid_argument("contact history: damaged");
  pairs_.resize(count);
  in.get_all(pairs_);
  in.get_all(old_force_);
  in.get_all(old_x_);
  in.get_all(gone_);
  in.get(started_);
  in.get(friction_work_);
  in.get(damping_work_);
  in.get(contact_work_);
  in.finish();
}

}  // namespace abut::contact
