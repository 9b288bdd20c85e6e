// Ordinary held nodes of a pass: into batches for held_kernel(), and out of them.
#include <algorithm>
#include <cmath>

#include "contact/enforce/account.hpp"
#include "contact/enforce/effective_mass.hpp"
#include "contact/enforce/pass.hpp"

namespace abut::contact {

bool Pass::in_batches(const HostState& host) const {
  const Rules& rules = options_.rules;
  return closest() && !options_.automatic_gap && settled_ && host.dt > 0.0 && !host.mass.empty() && rules.limits_step && !half_of_facet_ &&
         options_.damping == 0.0 && options_.start_duration == 0.0 && !rules.reference_friction &&
         (!options_.rubs() || (options_.friction_law.model == FrictionLaw::Model::coulomb && !options_.filter.acts() &&
                               options_.shear_limit >= 1e29 && options_.friction >= 0.0));
}

HeldRules Pass::held_rules(const HostState& host) const {
  HeldRules r;
  r.gap = options_.gap;
  r.stiffness_scale = options_.stiffness_scale;
  r.tangential_ratio = options_.tangential_ratio;
  r.friction = options_.friction;
  r.rubs = options_.rubs();
  r.step_factor = r.rubs ? std::max(std::sqrt(1.0 + r.friction * r.friction), r.tangential_ratio) : 1.0;
  r.step = host.dt;
  r.mean_step = host.dt_bar_old;
  r.step_before = step_before(host.dt, host.dt_bar_old);
  r.smallest = 1e-12 * size_;
  r.pairs = two_passes_ ? 2.0 : 1.0;
  r.stiffens = law_of(options_.gap).stiffens();
  r.corrects_switching = options_.rules.switch_correction;
  return r;
}

bool Pass::may_be_ordinary(const Scene& scene, Index i) const {
  const NodeState& before = states_.before(i);
  if (before.held == 0 || before.facet == no_index || before.ignored != 0 || before.offset != 0.0 || before.light >= NodeState::settled)
    return false;
  if (!scene.surface.active(before.facet) || !scene.held.node_active(i)) return false;
  const std::array<Index, 4>& corner = scene.surface.surface().local()[at(before.facet)];
  if (corner[2] == corner[3]) return false;
  if (!scene.host.constrained.empty()) {
    const auto asks = [&scene](Index n) { return plain_mass(scene.host, n) < 0.0; };
    const std::array<Index, 4> host_corner = scene.surface.surface().facet(before.facet).node;
    if (asks(scene.held.nodes()[at(i)]) || std::any_of(host_corner.begin(), host_corner.end(), asks)) return false;
  }
  return !options_.rubs() || (before.anchored != 0 && before.anchor.facet == before.facet);
}

void Pass::put_in(const Scene& scene, Index i, HeldBatch& batch) const {
  const NodeState& before = states_.before(i);
  const auto k = static_cast<std::size_t>(batch.count++);
  const Side& surface = scene.surface;
  const std::array<Index, 4>& corner = surface.surface().local()[at(before.facet)];
  const std::array<Index, 4> host_corner = surface.surface().facet(before.facet).node;
  const Index host_node = scene.held.nodes()[at(i)];
  batch.node[k] = 3 * i;
  batch.node_v[k] = 3 * host_node;
  batch.mass[4][k] = plain_mass(scene.host, host_node);
  batch.node_stiffness[k] = scene.held.node_stiffness(i);
  const double own = static_cast<double>(scene.held_loads.own_before[at(i)]), over_own = own > 0.0 ? 1.0 / own : 0.0;
  batch.springs[4][k] = over_own * static_cast<double>(scene.held_loads.springs_before[at(i)]);
  for (std::size_t c = 0; c < 4; ++c) {
    batch.corner[c][k] = 3 * corner[c];
    batch.corner_v[c][k] = 3 * host_corner[c];
    batch.mass[c][k] = plain_mass(scene.host, host_corner[c]);
    batch.springs[c][k] = over_own * static_cast<double>(scene.surface_loads.springs_before[at(corner[c])]);
    batch.corner_stiffness[c][k] = surface.corner_stiffness(corner[c]);
    batch.anchor[c][k] = before.anchor.weight[c];
    batch.last[c][k] = before.last.weight[c];
  }
  const double strip = before.held == 2 ? border_strip + border_widening : border_strip;
  const unsigned borders = surface.borders(before.facet);
  const double reach = borders != 0 ? 1.0 + 2.0 * strip : 1.0;
  const double narrow = borders != 0 ? surface.patch(before.facet).narrow : 1.0;
  const double flat = narrow < 1.0 ? 1.0 : 1.0 + 2.0 * border_flat * border_strip;  // s and t run over two per side
  for (unsigned side = 0; side < 4; ++side) batch.end[side][k] = (borders >> side & 1U) != 0 ? flat : 1.0;
  batch.reach[k] = reach * reach;
  batch.rate_before[k] = before.rate;
  batch.acceleration_before[k] = before.acceleration;
  batch.tangential_stiffness_before[k] = before.tangential_stiffness;
  const auto put = [k](double(&to)[3][HeldBatch::size], const Vec3& v) {
    to[0][k] = v.x;
    to[1][k] = v.y;
    to[2][k] = v.z;
  };
  batch.force_before[k] = before.force;
  batch.stored_before[k] = before.stored;
  batch.made_before[k] = before.made;
  batch.reckoned[k] = before.reckoned;
  put(batch.push_before, before.push);
  put(batch.normal_before, before.normal);
  put(batch.slip_before, before.slip);
  put(batch.slip_normal_before, before.slip_normal);
}

void Pass::run_batch(const Scene& scene, HeldBatch& batch) const {
  batch.held_x = &scene.held.x().data()->x;
  batch.surface_x = &scene.surface.x().data()->x;
  batch.v = &scene.host.v.data()->x;
  // Lanes beyond the last node repeat it.
  const int nodes = batch.count;
  const std::size_t last = static_cast<std::size_t>(nodes - 1);
  constexpr int widest = 8;
  batch.count = (nodes + widest - 1) / widest * widest;
  const auto repeat = [&](auto& values) {
    for (std::size_t k = last + 1; k < static_cast<std::size_t>(batch.count); ++k) values[k] = values[last];
  };
  repeat(batch.node);
  repeat(batch.node_v);
  for (auto* four : {&batch.corner, &batch.corner_v}) {
    for (auto& one : *four) repeat(one);
  }
  for (auto* five : {&batch.mass, &batch.springs}) {
    for (auto& one : *five) repeat(one);
  }
  for (auto* four : {&batch.corner_stiffness, &batch.anchor, &batch.last, &batch.end}) {
    for (auto& one : *four) repeat(one);
  }
  for (auto* one : {&batch.node_stiffness, &batch.reach, &batch.rate_before, &batch.acceleration_before, &batch.tangential_stiffness_before,
                    &batch.force_before, &batch.stored_before, &batch.made_before, &batch.reckoned})
    repeat(*one);
  for (auto* three : {&batch.push_before, &batch.normal_before, &batch.slip_before, &batch.slip_normal_before}) {
    for (auto& one : *three) repeat(one);
  }
  held_kernel()(held_rules(scene.host), batch);
}

bool Pass::alone(const Scene& scene, const HeldBatch& batch, int lane, Index i, Looks& looks, GroupSums& sums) {
  const Candidates::Others others = candidates_.others(i);
  const NodeState& before = states_.before(i);
  // Beyond what counts as equally near or can store more, with room for the rounding of the clock.
  const double further = scene.surface.evenly_stiff()
                             ? 0.0
                             : reach_of_stronger(batch.stiffness[lane], strongest(scene.held, scene.surface, i), batch.penetration[lane]);
  const double distance = std::sqrt(batch.squared_distance[lane]);
  const double within = (1.0 + 3.0 * equally_near) * (distance + (1.0 + 1e-6) * further);
  if (outgrows(i, distance + further)) sums.outgrown = true;
  const bool wide = before.held == 2;
  if (others.facet == before.facet && (others.wide || !wide) && others.due - candidates_.clock() > within) return true;
  const HeldBy by{before.facet, before.normal, wide ? border_strip + border_widening : border_strip};
  const Vec3& x = scene.held.x()[at(i)];
  const auto k = static_cast<std::size_t>(lane);
  HeldAt here{x - batch.distance[k] * Vec3{batch.normal[0][k], batch.normal[1][k], batch.normal[2][k]}, batch.squared_distance[k]};
  // As look_further() has it: the same point, seen from the facet across, is the same contact.
  if (further <= 0.0) here.same = same_point * scene.surface.facet_area(before.facet);
  return none_within(scene.surface, candidates_, i, x, by, within, here, looks);
}

void Pass::finish_ordinary(const Scene& scene, const HeldBatch& batch, int lane, Index i, GroupSums& sums) {
  const auto k = static_cast<std::size_t>(lane);
  const auto get = [k](const double(&from)[3][HeldBatch::size]) { return Vec3{from[0][k], from[1][k], from[2][k]}; };
  const NodeState& before = states_.before(i);
  NodeState& after = states_.after(i);
  PassTotals& totals = sums.totals;
  SideLoads& loads = scene.held_loads;
  const Index node = scene.held.nodes()[at(i)];

  totals.largest_approach = std::max(totals.largest_approach, batch.approach[k]);
  if (batch.kinematic_step[k] < totals.kinematic_step) {
    totals.kinematic_step = batch.kinematic_step[k];
    totals.kinematic_node = node;
  }
  totals.in_contact += 1;
  if (batch.penetration[k] > totals.largest_penetration) {
    totals.largest_penetration = batch.penetration[k];
    totals.deepest_node = node;
  }
  sums.in_contact.push_back(node);
  totals.potential += batch.potential[k];
  totals.stepped += batch.stepped[k];

  const std::array<double, 4> weight{batch.weight[0][k], batch.weight[1][k], batch.weight[2][k], batch.weight[3][k]};
  Reaction& reaction = sums.reactions.emplace_back(before.facet, batch.step_stiffness[k], batch.spring[k], weight);
  for (std::size_t c = 0; c < 4; ++c) reaction.normal[c] = get(batch.on_corner[c]);
  const Vec3 on_node = get(batch.on_node);
  SideLoads::Node& load = loads.load(i);
  load.own_normal = on_node;
  load.own_stiffness += batch.step_stiffness[k];
  load.own_springs += batch.spring[k];
  totals.normal += on_node;

  if (options_.rubs()) {
    totals.dissipated += batch.dissipated[k];
    totals.stick += batch.stick[k];
    slips_[at(i)] = batch.slips[k] != 0.0 ? 1 : 0;
    const Vec3 on_surface = get(batch.on_surface);
    reaction.tangential = on_surface;
    for (std::size_t c = 0; c < 4; ++c) reaction.stiffness[c] += batch.couple_stiffness[c][k];
    load.own_stiffness += batch.couple_stiffness[4][k];
    load.own_tangential = -on_surface;
    totals.tangential -= on_surface;
    after.friction = on_surface;
    after.anchored = 1;
    after.anchor = {weight, before.facet};
    after.slip = get(batch.slip);
    after.slip_normal = get(batch.slip_normal);
    after.tangential_stiffness = batch.tangential_stiffness[k];
  } else {
    after = before;
    reaction.tangential = Vec3{};
  }
  after.normal = get(batch.normal);
  after.rate = batch.rate[k];
  after.acceleration = batch.acceleration[k];
  after.offset = 0.0;
  after.damping = 0.0;
  after.force = batch.force[k];
  after.push = on_node;
  after.stored = batch.potential[k];
  after.step_stiffness = static_cast<float>(batch.step_stiffness[k]);
  after.made = batch.made[k];
  after.reckoned = before.reckoned;
  after.light = std::max(before.light, static_cast<std::uint8_t>(batch.light[k] != 0.0 ? 1 : 0));
  after.last = before.reckoned != 0 ? SurfacePoint{weight, before.facet} : before.last;
  after.facet = before.facet;
  after.held = before.held;
  after.ignored = 0;
  after.in_front = batch.distance[k] >= 0.0 ? 1 : 0;
  foresee_strips(scene.host, scene.held, scene.surface, loads, i, sums);
}

}  // namespace abut::contact
