#include "contact/enforce/pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>

#include "contact/project/plain.hpp"

namespace abut::contact {
namespace {

constexpr Index group = NodeStates::group;  // nodes handled together (numerics.md 7.3.1)
constexpr auto block = static_cast<Index>(SideLoads::block);
static_assert(group % block == 0);
constexpr double awake_now = -1e300;  // due of a block in which some node is awake

// Share of an offset that a gradual start leaves from `before` to `now`: of the first offset 1 - u^2 (3 - 2u) is left at u = t/T
// after birth, which begins and ends at no speed.
double kept_share(const Options& options, double before, double now) {
  const auto left = [&options](double t) {
    const double u = std::clamp((t - options.birth) / options.start_duration, 0.0, 1.0);
    return (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
  };
  const double was = left(before);
  return was > 0.0 ? left(now) / was : 0.0;
}

}  // namespace

PassTotals& PassTotals::operator+=(const PassTotals& b) {
  normal += b.normal;
  tangential += b.tangential;
  potential += b.potential;
  stick += b.stick;
  dissipated += b.dissipated;
  damped += b.damped;
  started += b.started;
  stepped += b.stepped;
  if (b.largest_penetration > largest_penetration) {
    largest_penetration = b.largest_penetration;
    deepest_node = b.deepest_node;
  }
  largest_approach = std::max(largest_approach, b.largest_approach);
  if (b.kinematic_step < kinematic_step) {
    kinematic_step = b.kinematic_step;
    kinematic_node = b.kinematic_node;
  }
  in_contact += b.in_contact;
  return *this;
}

Pass::Pass(const Options& options, bool one_pass, std::size_t held_nodes)
    : options_(options),
      two_passes_(!one_pass),
      half_of_facet_(one_pass && options.rules.one_pass_half_stiffness),
      states_(held_nodes),
      covered_(held_nodes, 0.0),
      in_front_(held_nodes, 0),
      quiet_(held_nodes, awake),
      slips_(held_nodes, 1),
      seen_gap_(options.automatic_gap ? held_nodes : 0, 0.0) {}

void Pass::start(const Side& held, const Side& surface) {
  started_ = true;
  size_ = surface.mean_size();
  std::vector<double> depths, widenings;
  depths.reserve(at(surface.facet_count()));
  widenings.reserve(at(surface.facet_count()));
  for (Index f = 0; f < surface.facet_count(); ++f) {
    const double length = std::sqrt(surface.facet_area(f));
    widenings.push_back(length > 0.0 ? 1.0 / length : 0.0);
    double depth = options_.depth_limit;
    if (depth <= 0.0) {
      depth = 0.5 * length;
      if (surface.thickness(f) > 0.0) depth = std::min(depth, std::max(surface.thickness(f), options_.gap));
    }
    depths.push_back(depth);
  }
  depth_ = Values(std::move(depths));
  widening_ = Values(std::move(widenings));
  limit_depths();
  if (closest()) return;
  tracked_.assign(at(held.node_count()), {});
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
    NodeState starter;
    starter.anchored = 1;
    starter.anchor = starter.last = {p.weight, t.facet};
    states_.set(i, starter);
  }
}

void Pass::limit_depths() {
  smallest_depth_ = 1e300;
  largest_depth_ = 0.0;
  longest_ = 0.0;
  for (std::size_t f = 0; f < depth_.size(); ++f) {
    smallest_depth_ = std::min(smallest_depth_, depth_[f]);
    largest_depth_ = std::max(largest_depth_, depth_[f]);
    if (widening_[f] > 0.0) longest_ = std::max(longest_, 1.0 / widening_[f]);
  }
}

void Pass::search(const Side& held, const Side& surface, const Motion& motion) {
  if (!closest()) {
    incremental_.update(held, surface, tracked_, options_.gap);
    return;
  }
  if (stale_) {
    largest_gap_ = options_.gap;
    if (options_.automatic_gap) largest_gap_ = std::max(options_.gap, 0.5 * (held.largest_thickness() + surface.largest_thickness()));
    std::fill(in_front_.begin(), in_front_.end(), std::uint8_t{0});
    std::fill(quiet_.begin(), quiet_.end(), std::uint8_t{awake});
  }
  skin_ = 0.25 * size_;
  // Of held nodes also what stores more than the nearest facet (pair.hpp).
  const double further = stronger_within * longest_;
  // A held node's distance changes by at most slack() <= skin until the next build: twice the skin covers both ends.
  const auto reach_of = [&](Index i) {
    if (!held.node_active(i)) return -1.0;
    const NodeState& s = states_.before(i);
    if (s.held == 0 || s.facet == no_index || !surface.active(s.facet)) return reach();
    return std::max(reach(), std::sqrt(closest_point(surface.patch(s.facet), held.x()[at(i)]).squared_distance) + skin_ + further);
  };
  const auto covers = [&](Index i) {
    const double distance = reach_of(i);
    covered_[at(i)] = distance;
    return distance;
  };
  const bool renewed = candidates_.update(held, surface, motion, covers, skin_, stale_ || outgrown_, executor_);
  outgrown_ = false;
  if (renewed) block_due_.assign((at(held.node_count()) + at(block) - 1) / at(block), {awake_now, awake_now});
  stale_ = false;
  mean_step_ = motion.mean;
  surface_step_ = motion.surface;
}

bool Pass::asleep(const Scene& scene, Index i, FacetViews& facets, bool& near_by) {
  near_by = false;
  const std::uint8_t quiet = quiet_[at(i)];
  if (quiet == awake || scene.host.dt <= 0.0) return false;
  // The largest motion of its block is at hand; its own has to be fetched.
  const double motion = scene.held_loads.squared_motion[at(i) / SideLoads::block];
  const double due = candidates_.nearest_due(i);
  if (quiet == beyond_reach) {
    if (stays_beyond(motion, due)) return true;
    return stays_beyond(squared_motion(scene.host, scene.held, scene.held_loads, i), due);
  }
  if (quiet == nothing_listed && !candidates_.of(i).empty()) return false;
  if (clears(motion, due)) return true;
  near_by = !far(scene, i, quiet == seen_in_front, facets);
  return !near_by;
}

bool Pass::block_asleep(const Scene& scene, std::size_t number) const {
  if (!closest() || scene.host.dt <= 0.0) return false;
  const Due& due = block_due_[number];
  const double motion = scene.held_loads.squared_motion[number];
  return clears(motion, due.in_front) && stays_beyond(motion, due.beyond);
}

void Pass::settle_block(std::size_t number) {
  Due due;
  const auto first = static_cast<Index>(number) * block;
  for (Index i = first; i < std::min(first + block, static_cast<Index>(quiet_.size())); ++i) {
    const std::uint8_t quiet = quiet_[at(i)];
    double& one = quiet == beyond_reach ? due.beyond : due.in_front;
    one = std::min(one, quiet == awake ? awake_now : candidates_.nearest_due(i));
  }
  block_due_[number] = due;
}

void Pass::measure(const Scene& scene, Index i, bool near_by, Touch& touch, Work& work, GroupSums& sums) {
  states_.after(i) = states_.before(i);
  if (closest()) {
    measure_closest(scene, i, near_by, touch, work, sums);
  } else {
    measure_plain(scene.held, scene.surface, i, touch);
  }
}

// Nodes in contact as well as others: those that are ordinary by the batch, the rest one by one. All sums run in the order of the nodes.
void Pass::evaluate_group(const Scene& scene, std::size_t number, Work& work, GroupSums& sums) {
  const auto& [host, held, surface, held_loads, surface_loads] = scene;
  const Index first = static_cast<Index>(number) * group;
  const Index last = std::min(first + group, held.node_count());
  sums.totals = {};
  sums.reactions.clear();
  for (std::vector<Index>* list : {&sums.in_contact, &sums.crossed, &sums.lost}) list->clear();
  sums.further.clear();
  sums.outgrown = false;
  const std::size_t first_block = at(first) / SideLoads::block, end_block = (at(last) + SideLoads::block - 1) / SideLoads::block;
  std::array<bool, at(group / block)> sleeps;
  bool all = true;
  for (std::size_t b = first_block; b < end_block; ++b) all = (sleeps[b - first_block] = block_asleep(scene, b)) && all;
  if (all) return;
  NodeStates::Loan loan(states_, number, work.scratch);
  std::array<Touch, at(group)>& touches = work.touches;
  HeldBatch& batch = work.batch;
  constexpr int none = -1;
  const bool batches = in_batches(host);
  std::array<Index, at(group)> nodes;
  std::array<int, at(group)> lane;
  std::array<Touch*, at(group)> touch_of;  // of those that are measured: few, one after the other in memory
  for (Index i = first; i < last;) {
    std::size_t count = 0;
    Touch* next = touches.data();
    bool any = false;
    batch.count = 0;
    for (; i < last && batch.count < HeldBatch::size; ++i) {
      if (i % block == 0 && sleeps[at(i - first) / at(block)]) {
        i += block - 1;
        continue;
      }
      bool near_by;
      if (asleep(scene, i, work.facets, near_by)) continue;
      loan.wake(i);
      lane[count] = none;
      if (batches && may_be_ordinary(scene, i)) {
        lane[count] = batch.count;
        put_in(scene, i, batch);
      } else {
        Touch& touch = *(touch_of[count] = next++);
        work.looks.begin(surface, held.x()[at(i)]);
        measure(scene, i, near_by, touch, work, sums);
        any = any || touch.contact;
      }
      nodes[count++] = i;
    }
    if (batch.count > 0) run_batch(scene, batch);
    for (std::size_t k = 0; k < count && batch.count > 0; ++k) {
      if (lane[k] == none) continue;
      const bool ordinary = batch.ordinary[lane[k]] != 0.0;
      work.looks.begin(surface, held.x()[at(nodes[k])]);
      if (ordinary && alone(scene, batch, lane[k], nodes[k], work.looks, sums)) continue;
      Touch& touch = *(touch_of[k] = next++);
      measure(scene, nodes[k], true, touch, work, sums);  // it is held
      any = any || touch.contact;
      const bool same = ordinary && touch.contact && touch.facet == states_.before(nodes[k]).facet && touch.further == 0;
      if (!same) lane[k] = none;
    }
    for (std::size_t k = 0; k < count; ++k) {
      quiet_[at(nodes[k])] = awake;
      if (lane[k] != none) {
        finish_ordinary(scene, batch, lane[k], nodes[k], sums);
        continue;
      }
      // 7.4.3: anchors are looked at only in groups in which somebody touches.
      Touch& touch = *touch_of[k];
      finish_node(scene, nodes[k], touch, any, sums);
      if (!touch.contact) end_contact(scene, nodes[k], touch, any, sums);
    }
    loan.settle(std::span(nodes).first(count));
  }
  if (!closest()) return;
  for (std::size_t b = first_block; b < end_block; ++b) {
    if (!sleeps[b - first_block]) settle_block(b);
  }
}

void Pass::end_contact(const Scene& scene, Index i, const Touch& touch, bool any, GroupSums& sums) {
  const bool anchors = options_.rules.reference_friction;
  const NodeState& before = states_.before(i);
  NodeState& after = states_.after(i);
  if (touch.lost) sums.lost.push_back(scene.held.nodes()[at(i)]);
  after.held = 0;
  // The last damping force acts over half of the step that ends the contact.
  if (before.damping != 0.0) sums.totals.damped += std::max(0.0, -0.5 * before.damping * before.rate * scene.host.dt);
  after.damping = 0.0;
  sums.totals.started += 0.5 * before.force * growth(before);
  after.force = 0.0;
  after.push = {};
  after.reckoned = 0;
  after.light = 0;
  after.stored = 0.0;
  after.made = 0.0;
  after.rate = 0.0;
  after.acceleration = 0.0;
  if (!anchors || any) {
    // The limit falls to zero: what was stored slips away.
    if (before.tangential_stiffness > 0.0) { sums.totals.dissipated += 0.5 * squared_norm(before.friction) / before.tangential_stiffness; }
    after.anchored = 0;
    after.slip = {};
    if (!anchors) after.filtered = {};
    after.friction = {};
    after.tangential_stiffness = 0.0;
  }
  if (!closest()) return;
  const bool nothing = candidates_.of(i).empty();
  if ((touch.far || nothing || touch.away) && after.ignored == 0 && std::memcmp(&before, &after, sizeof(NodeState)) == 0) {
    quiet_[at(i)] = nothing ? nothing_listed : !touch.far ? beyond_reach : after.in_front != 0 ? seen_in_front : in_front;
  }
}

void Pass::add_reactions(const GroupSums& sums, const Side& surface, SideLoads& surface_loads) const {
  for (const Reaction& r : sums.reactions) {
    const std::array<Index, 4>& corner = surface.surface().local()[at(r.facet)];
    for (std::size_t k = 0; k < 4; ++k) {
      SideLoads::Node& node = surface_loads.load(corner[k]);
      node.reaction_normal += r.normal[k];
      node.reaction_tangential += r.weight[k] * r.tangential;
      node.reaction_stiffness += r.stiffness[k];
      node.reaction_springs += std::abs(r.weight[k]) * r.springs;
    }
  }
}

PassTotals Pass::evaluate(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, SideLoads& surface_loads) {
  const Scene scene{host, held, surface, held_loads, surface_loads};
  keep_ = options_.start_duration > 0.0 ? kept_share(options_, host.time - host.dt, host.time) : 1.0;
  groups_.resize((at(held.node_count()) + at(group) - 1) / at(group));
  std::size_t added = 0;
  const auto evaluate_groups = [this, &scene, &added](std::size_t begin, std::size_t end) {
    if (begin == end) return;  // an executor may hand out empty ranges: they are nobody's first
    // Large, and nothing in it is kept: made once per thread.
    thread_local const auto work = std::make_unique<Work>();
    work->facets.forget();
    for (std::size_t g = begin; g < end; ++g) {
      GroupSums& sums = groups_[g];
      // What nobody asks for when the group is done is the thread's, as large as its largest group needs it.
      sums.further.swap(work->further);
      if (begin == 0) sums.reactions.swap(work->reactions);
      evaluate_group(scene, g, *work, sums);
      sums.further.swap(work->further);
      if (begin != 0) continue;
      // Reactions are added in the order of the groups: whoever has the first of them adds while they are in its cache.
      add_reactions(sums, scene.surface, scene.surface_loads);
      sums.reactions.swap(work->reactions);
    }
    if (begin == 0) added = end;
  };
  if (executor_) {
    executor_(groups_.size(), std::ref(evaluate_groups));
  } else {
    evaluate_groups(0, groups_.size());
  }

  committed_ = false;
  PassTotals totals;
  for (std::vector<Index>* list : {&in_contact_, &crossed_, &lost_}) list->clear();
  for (std::size_t g = added; g < groups_.size(); ++g) add_reactions(groups_[g], surface, surface_loads);
  for (const GroupSums& sums : groups_) {
    totals += sums.totals;
    outgrown_ = outgrown_ || sums.outgrown;
    in_contact_.insert(in_contact_.end(), sums.in_contact.begin(), sums.in_contact.end());
    crossed_.insert(crossed_.end(), sums.crossed.begin(), sums.crossed.end());
    lost_.insert(lost_.end(), sums.lost.begin(), sums.lost.end());
  }
  settled_ = true;
  return totals;
}

PassTotals Pass::rest(const HostState& host, const Side& held, const Side& surface) {
  committed_ = false;
  PassTotals totals;
  stale_ = true;
  for (std::vector<Index>* list : {&in_contact_, &crossed_, &lost_}) list->clear();
  NodeStates::Scratch scratch;
  std::vector<Index> nodes;
  for (std::size_t g = 0; g * at(group) < states_.size(); ++g) {
    NodeStates::Loan loan(states_, g, scratch);
    nodes.clear();
    for (auto i = static_cast<Index>(g) * group; i < std::min((static_cast<Index>(g) + 1) * group, held.node_count()); ++i) {
      loan.wake(i);
      nodes.push_back(i);
      const NodeState& before = states_.before(i);
      NodeState& after = states_.after(i);
      after = before;
      totals.stepped += stepped_without_facet(host, held, surface, i);
      if (before.tangential_stiffness > 0.0) totals.dissipated += 0.5 * squared_norm(before.friction) / before.tangential_stiffness;
      if (options_.rules.reference_friction) continue;  // frozen outside the window (7.3.1)
      after = {};
      after.ignored = before.ignored;
    }
    loan.settle(nodes);
  }
  return totals;
}

void Pass::commit() {
  states_.commit();
  committed_ = true;
}

}  // namespace abut::contact
