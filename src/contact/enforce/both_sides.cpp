#include "contact/enforce/both_sides.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "contact/enforce/check_options.hpp"
#include "contact/enforce/history.hpp"

namespace abut::contact {

namespace {

/// Placement of initial penetrations, a hair beyond what is there (numerics.md 7.7.1).
constexpr double hair = 1.0 + 1e-8;

/// First in the history: rises with every change of what is written here, as history_version does for all interfaces. 2: accounts of pairs.
constexpr std::uint64_t layout = 0x3244495345444953ULL;

/// Largest distance between a bilinear facet and its four triangles: a quarter of the height of its hourglass.
double warp(const Side& surface) {
  double largest = 0.0;
  for (Index f = 0; f < surface.facet_count(); ++f) {
    const Patch p = surface.patch(f);
    if (!p.triangle) largest = std::max(largest, squared_norm((p.x[0] - p.x[1]) + (p.x[2] - p.x[3])));
  }
  return std::sqrt(largest) / 16.0;
}

}  // namespace

BothSides::BothSides(std::vector<Index> nodes, Surface surface, BothSidesOptions options)
    : options_(std::move(options)), held_(nodes, std::vector<double>(nodes.size(), 0.0)), surface_(std::move(surface), true) {
  check(options_);
  check_held_nodes(held_.nodes());
  if (!options_.node_gap.empty() && options_.node_gap.size() != nodes.size())
    throw std::invalid_argument("node_gap: one value per held node");
  if (!options_.facet_gap.empty() && static_cast<Index>(options_.facet_gap.size()) != surface_.facet_count()) {
    throw std::invalid_argument("facet_gap: one value per facet");
  }
  if (!options_.node_size.empty() &&
      (options_.node_size.size() != nodes.size() || static_cast<Index>(options_.facet_size.size()) != surface_.facet_count())) {
    throw std::invalid_argument("node_size, facet_size: one value per node, one per facet");
  }
  bound_gaps();
  own_.assign(held_.nodes().begin(), held_.nodes().end());
  own_.insert(own_.end(), surface_.nodes().begin(), surface_.nodes().end());
  std::sort(own_.begin(), own_.end());
  own_.erase(std::unique(own_.begin(), own_.end()), own_.end());
  const auto position = [this](Index node) { return static_cast<Index>(std::lower_bound(own_.begin(), own_.end(), node) - own_.begin()); };
  for (const Index n : held_.nodes()) held_own_.push_back(position(n));
  for (const Index n : surface_.nodes()) surface_own_.push_back(position(n));
  for (std::vector<Vec3>* array : {&normal_, &tangential_, &old_force_, &old_x_}) array->resize(own_.size());
  gone_.assign(held_.nodes().size(), 0);
  off_.assign(at(surface_.facet_count()), 0);
}

void BothSides::bound_gaps() {
  narrowest_ = options_.gap;
  if (!variable_gap() || held_.node_count() == 0 || surface_.facet_count() == 0) return;
  widest_ = *std::max_element(options_.facet_gap.begin(), options_.facet_gap.end());
  narrowest_ = std::max(options_.gap, *std::min_element(options_.node_gap.begin(), options_.node_gap.end()) +
                                          *std::min_element(options_.facet_gap.begin(), options_.facet_gap.end()));
}

void BothSides::set_surface(int side, const SurfaceState& state) {
  if (side < 0 || side > 1) throw std::invalid_argument("contact: side " + std::to_string(side) + " is neither 0 nor 1");
  (side == 1 ? surface_ : held_).set(state, false);
  stale_ = true;
  if (!variable_gap()) return;
  std::vector<double>& gaps = side == 1 ? options_.facet_gap : options_.node_gap;
  for (std::size_t k = 0; k < state.thickness.size(); ++k) gaps[k] = 0.5 * state.thickness[k];
  bound_gaps();
}

double BothSides::pair_gap(Index node, Index facet) const { return options_.pair_gap(at(node), at(surface_.listed(facet))); }

double BothSides::reach(Index node) const {
  if (gone_[at(node)] != 0 || !held_.node_active(node)) return -1.0;
  if (!variable_gap()) return options_.gap;
  return std::max(options_.gap, std::min(options_.node_gap[at(node)] + widest_, options_.gap_max));
}

double BothSides::pair_stiffness(Index node, Index facet) const {
  if (off_[at(facet)] != 0) return 0.0;
  return options_.pair_stiffness(surface_.facet_stiffness(facet), held_.node_stiffness(node));
}

BothSides::Met BothSides::meet(const Side& held, const Side& surface, Index node, Index facet, double gap) const {
  const auto& corner = surface.surface().local()[at(facet)];
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = surface.x()[at(corner[k])];
  return {both_sides_contact(held.x()[at(node)], x, surface.surface().is_triangle(facet), gap, options_.all_pieces), gap};
}

std::span<const Index> BothSides::facets_of(const Candidates& candidates, Index node, std::vector<Index>& scratch) const {
  scratch.clear();
  const Index self = held_.nodes()[at(node)];
  for (const Candidates::Entry& entry : candidates.of(node)) {
    const std::array<Index, 4> corners = surface_.surface().facet(entry.facet).node;
    if (surface_.active(entry.facet) && std::find(corners.begin(), corners.end(), self) == corners.end()) scratch.push_back(entry.facet);
  }
  std::sort(scratch.begin(), scratch.end());
  return scratch;
}

void BothSides::settle(bool awake) {
  using Initial = BothSidesOptions::Initial;
  std::vector<Index> scratch;
  for (Index node = 0; node < held_.node_count(); ++node) {
    if (gone_[at(node)] != 0 || !held_.node_active(node)) continue;
    for (const Index facet : facets_of(candidates_, node, scratch)) {
      const Met met = meet(held_, surface_, node, facet, pair_gap(node, facet));
      if (met.contact.penetration <= 0.0) continue;
      if (!awake) pairs_.push_back({node, facet, offset_of({}, met.gap, met.contact.penetration), {}});
      if (options_.initial == Initial::drop_nodes) gone_[at(node)] = 1;
      if (options_.initial == Initial::drop_facets) off_[at(facet)] = 1;
      if (options_.largest_penetration > 0.0 && met.contact.penetration > options_.largest_penetration * met.gap) gone_[at(node)] = 1;
    }
  }
}

std::vector<Projection> BothSides::projections(std::span<const Vec3> x, bool move_surface) const {
  Side held = held_, surface = surface_;
  held.gather(x);
  surface.gather(x);
  Candidates candidates;
  candidates.update(
      held, surface, {}, [this](Index node) { return reach(node); }, warp(surface), true);
  std::vector<Vec3> move(x.size());
  std::vector<Index> scratch;
  for (Index node = 0; node < held.node_count(); ++node) {
    for (const Index facet : facets_of(candidates, node, scratch)) {
      const Met met = meet(held, surface, node, facet, pair_gap(node, facet));
      if (met.contact.penetration <= 0.0) continue;
      const Vec3 by = (hair * met.contact.penetration) * met.contact.away;
      const auto largest = [&move](Index n, const Vec3& candidate) {
        if (squared_norm(candidate) > squared_norm(move[at(n)])) move[at(n)] = candidate;
      };
      if (!move_surface) {
        largest(held.nodes()[at(node)], by);
      } else {
        for (const std::array<Index, 4> corners = surface.surface().facet(facet).node; const Index n : corners) largest(n, -by);
      }
    }
  }
  std::vector<Projection> out;
  for (std::size_t i = 0; i < move.size(); ++i) {
    if (squared_norm(move[i]) > 0.0) out.push_back({static_cast<Index>(i), move[i]});
  }
  return out;
}

void BothSides::search(const HostState& host) {
  if (evaluated_) throw std::logic_error("contact: a two-sided interface cannot repeat a step: commit() it before the next search()");
  held_.gather(host.x);
  surface_.gather(host.x);
  if (started_ && !acts(host)) return;
  // Lists are made with distances to the bilinear facet, pairs are measured to its four triangles: warp apart at most.
  double between = -1.0;
  const auto reach_of = [&](Index node) {
    if (between < 0.0) between = warp(surface_);
    const double distance = reach(node);
    return distance < 0.0 ? distance : distance + between + (options_.switch_correction ? foresight * narrowest_ : 0.0);
  };
  const bool first = stale_ || held_last_.size() != held_.x().size() || surface_last_.size() != surface_.x().size();
  const Motion motion = first ? Motion{} : motion_between(held_.x(), held_last_, surface_.x(), surface_last_);
  candidates_.update(held_, surface_, motion, reach_of, 0.5 * options_.gap, stale_ || first);
  held_last_.assign(held_.x().begin(), held_.x().end());
  surface_last_.assign(surface_.x().begin(), surface_.x().end());
  stale_ = false;
  if (!started_) settle(acts(host));
}

double BothSides::offset_of(const Pair& old, double gap, double p) const {
  if (options_.initial == BothSidesOptions::Initial::keep) return 0.0;
  const double margin = options_.initial == BothSidesOptions::Initial::offset_with_margin ? 0.05 * (gap - p) : 0.0;
  if (!started_) return p * hair + margin;
  return std::min(old.offset, 0.95 * old.offset + 0.05 * (p + margin));
}

void BothSides::gather_pressed() {
  pressed_.assign(own_.size(), {});
  for (Index node = 0; node < held_.node_count(); ++node) {
    if (gone_[at(node)] != 0 || !held_.node_active(node)) continue;
    for (const Index facet : facets_of(candidates_, node, scratch_)) {
      const double k = pair_stiffness(node, facet);
      if (k <= 0.0) continue;
      const Met met = meet(held_, surface_, node, facet, pair_gap(node, facet));
      if (met.contact.penetration <= 0.0) continue;
      pressed_[at(held_own_[at(node)])].add(k, met.contact.normal);
      const auto& corner = surface_.surface().local()[at(facet)];
      for (std::size_t i = 0; i < 4; ++i) {
        if (met.contact.weight[i] != 0.0) { pressed_[at(surface_own_[at(corner[i])])].add(met.contact.weight[i] * k, met.contact.normal); }
      }
    }
  }
}

StepResult BothSides::evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) {
  if (host.mass.empty() && options_.rubs() && options_.friction_form == BothSidesOptions::Friction::viscous) {
    throw std::invalid_argument("contact: viscous friction needs masses");
  }
  evaluated_ = true;
  StepResult result;
  in_contact_.clear();
  slips_.assign(at(held_.node_count()), 0);
  std::fill(normal_.begin(), normal_.end(), Vec3{});
  std::fill(tangential_.begin(), tangential_.end(), Vec3{});
  Sums sums;
  acted_ = acts(host);
  if (acted_) {
    std::swap(pairs_, previous_);
    pairs_.clear();
    fastest_ = fastest(host);
    if (options_.switch_correction) gather_pressed();
    longest_step_ = std::max(longest_step_, host.dt);
    std::size_t next = 0;
    for (Index node = 0; node < held_.node_count(); ++node) {
      if (gone_[at(node)] != 0 || !held_.node_active(node)) continue;
      bool touches = false;
      for (const Index facet : facets_of(candidates_, node, scratch_)) {
        while (next < previous_.size() && (previous_[next].node < node || (previous_[next].node == node && previous_[next].facet < facet)))
          end(host, previous_[next++], sums);
        const bool known = next < previous_.size() && previous_[next].node == node && previous_[next].facet == facet;
        const bool acts = add_pair(host, node, facet, known ? previous_[next] : Pair{node, facet, 0.0, {}}, stiffness, result, sums);
        touches = acts || touches;
        if (known && !acts) end(host, previous_[next], sums);
        if (known) ++next;
      }
      if (touches) in_contact_.push_back(held_.nodes()[at(node)]);
    }
    while (next < previous_.size()) end(host, previous_[next++], sums);
    // No node may cross the gap in one step, near or far (numerics.md 2.5, third term), nor go further than was looked ahead.
    if (fastest_ > 0.0) result.kinematic_step = std::min(result.kinematic_step, kinematic * narrowest_ / fastest_);
    if (fastest_ > 0.0 && options_.switch_correction) result.kinematic_step = std::min(result.kinematic_step, looked_ahead());
  } else {
    // Outside of the time window nothing acts; what initial penetrations take from the gap stays for a later birth.
    for (Pair& pair : pairs_) {
      end(host, pair, sums);
      Pair asleep{pair.node, pair.facet};
      asleep.offset = pair.offset;
      pair = asleep;
    }
  }
  if (!started_) initial_elastic_ = sums.elastic;
  friction_work_ += sums.friction_work;
  // A damper whose force turns its pair round gives back a part of what it takes next: DW does not fall.
  const double damped = damping_owed_ + sums.damping_work, damped_now = std::max(0.0, damped);
  damping_work_ += damped_now;
  damping_owed_ = std::min(0.0, damped);
  stepped_work_ += sums.stepped;
  const double work = discrete_work(host);
  contact_work_ += work;
  // As one-sided interfaces have it: whoever opens the time window over nodes in the gap puts the energy there that the springs then hold.
  if (waiting_ && acts(host)) start_work_ += work + sums.elastic + sums.friction_work + damped_now + sums.stepped;
  waiting_ = host.time < options_.birth;
  started_ = true;
  for (std::size_t i = 0; i < own_.size(); ++i) force[at(own_[i])] += normal_[i] + tangential_[i];
  result.elastic = sums.elastic;
  result.friction_work = friction_work_;
  result.damping_work = damping_work_;
  result.made = contact_work_ + (sums.elastic - initial_elastic_) + friction_work_ + damping_work_ + stepped_work_ - start_work_;
  result.start_work = start_work_;
  result.in_contact = static_cast<Index>(in_contact_.size());
  return result;
}

void BothSides::clear(std::span<Vec3> force, std::span<double> stiffness) const {
  for (const Index node : own_) {
    force[at(node)] = {};
    stiffness[at(node)] = 0.0;
  }
}

double BothSides::discrete_work(const HostState& host) {
  double work = 0.0;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const Vec3& x = host.x[at(own_[i])];
    const Vec3 f = normal_[i] + tangential_[i];
    if (started_) work += 0.5 * dot(f + old_force_[i], x - old_x_[i]);
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

void BothSides::add_nodal_area(std::span<const Vec3> x, std::span<double> area) const {
  Side now = surface_;
  now.gather(x);
  for (Index s = 0; s < now.node_count(); ++s) area[at(now.nodes()[at(s)])] += now.tributary_area(s);
}

void BothSides::add_nodal_contact(std::span<NodalContact> nodes) const {
  if (!acted_) return;
  // Lists of its own: those of the search reach only as far as forces do, and what else they hold depends on their age.
  const double shown = surface_.mean_size(), flat = warp(surface_);
  const auto reach_of = [&](Index node) { return reach(node) < 0.0 ? -1.0 : reach(node) + shown; };
  Candidates near;
  near.update(held_, surface_, {}, reach_of, flat, true);
  for (Index node = 0; node < held_.node_count(); ++node) {
    double smallest = std::nextafter(shown, 1e300);  // beyond that the lists need not have the nearest one
    NodalContact c;
    for (const Candidates::Entry& entry : near.of(node)) {
      const double gap = pair_gap(node, entry.facet);
      if (entry.due - flat - gap >= smallest) continue;
      const double opening = meet(held_, surface_, node, entry.facet, gap).contact.distance - gap;
      if (opening < smallest) c.opening = smallest = opening;
    }
    merge(nodes[at(held_.nodes()[at(node)])], c);
  }
  for (const Pair& pair : pairs_) {
    const Met met = meet(held_, surface_, pair.node, pair.facet, pair_gap(pair.node, pair.facet));
    NodalContact c;
    c.penetration = std::max(0.0, met.contact.penetration - pair.offset);
    if (c.penetration > 0.0) c.state = slips_[at(pair.node)] != 0 ? NodalContact::State::slip : NodalContact::State::stick;
    merge(nodes[at(held_.nodes()[at(pair.node)])], c);
  }
}

void BothSides::save(HistoryWriter& out) const {
  out.put(layout);
  out.put_all(pairs_);
  out.put_all(old_force_);
  out.put_all(old_x_);
  out.put_all(gone_);
  out.put_all(off_);
  out.put(started_);
  out.put(initial_elastic_);
  out.put(friction_work_);
  out.put(damping_work_);
  out.put(damping_owed_);
  out.put(longest_step_);
  out.put(contact_work_);
  out.put(start_work_);
  out.put(waiting_);
  out.put(stepped_work_);
}

void BothSides::load(HistoryReader& in) {
  stale_ = true;
  evaluated_ = acted_ = false;
  if (in.next<std::uint64_t>() != layout) in.refuse("was written by a version whose two-sided interfaces remember something else");
  in.get_any(pairs_);
  in.get_all(old_force_);
  in.get_all(old_x_);
  in.get_all(gone_);
  in.get_all(off_);
  in.get(started_);
  in.get(initial_elastic_);
  in.get(friction_work_);
  in.get(damping_work_);
  in.get(damping_owed_);
  in.get(longest_step_);
  in.get(contact_work_);
  in.get(start_work_);
  in.get(waiting_);
  in.get(stepped_work_);
}

}  // namespace abut::contact
