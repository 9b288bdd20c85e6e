// The two friction rules of a pass.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/enforce/friction.hpp"
#include "contact/enforce/pass.hpp"

namespace abut::contact {
namespace {

// Right-handed unit frame that moves with a facet: along its first diagonal (first side of a triangle), normal last.
struct Frame {
  Vec3 a, b, n;
  [[nodiscard]] Vec3 to_world(const Vec3& v) const { return v.x * a + v.y * b + v.z * n; }
  [[nodiscard]] Vec3 to_local(const Vec3& v) const { return {dot(v, a), dot(v, b), dot(v, n)}; }
};

Frame frame_of(const Side& surface, Index f) {
  const Patch p = surface.patch(f);
  const Vec3 along = p.triangle ? p.x[1] - p.x[0] : p.x[2] - p.x[0];
  const Vec3 across = p.triangle ? p.x[2] - p.x[0] : p.x[3] - p.x[1];
  const Vec3 a = normalized(along);
  const Vec3 n = normalized(cross(along, across));
  return {a, cross(n, a), n};
}

Vec3 point_of(const Side& surface, const SurfacePoint& p) {
  const std::array<Index, 4>& corner = surface.surface().local()[static_cast<std::size_t>(p.facet)];
  Vec3 x{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (p.weight[i] != 0.0) x += p.weight[i] * surface.x()[at(corner[i])];
  }
  return x;
}

}  // namespace

Vec3 Pass::rub_by_return_mapping(const HostState& host, const Side& surface, const Touch& touch, const Kinematics& motion, double limit,
                                 double fraction, const NodeState& before, NodeState& after, PassTotals& totals) const {
  const double stiffness = options_.tangential_ratio * touch.pair.stiffness;
  if (stiffness <= 0.0) return {};
  Vec3 elastic{};
  Vec3 force_before{};
  Vec3 increment{};
  Vec3 filtered{};
  const Frame frame = frame_of(surface, touch.facet);
  if (before.anchored != 0) {
    const Frame was = before.anchor.facet == touch.facet ? frame : frame_of(surface, static_cast<Index>(before.anchor.facet));
    elastic = turned(was.to_world(before.slip), was.to_world(before.slip_normal), touch.normal);
    elastic -= dot(elastic, touch.normal) * touch.normal;
    if (options_.filter.acts()) filtered = turned(was.to_world(before.filtered), was.to_world(before.slip_normal), touch.normal);
    force_before = before.tangential_stiffness * elastic;
    increment = touch.point - point_of(surface, before.anchor);
  } else {
    // C0 is where the node came through the gap: friction acts from the first step on.
    increment = (fraction * host.dt) * motion.tangential_velocity;
  }
  increment -= dot(increment, touch.normal) * touch.normal;
  if (before.anchored != 0 && before.anchor.facet != touch.facet) {
    // Over the bisector of an inward fold the closest point jumps from leg to leg while nothing moves so far: that way is no slip.
    constexpr double jump = 2.0;
    const Vec3 moved = host.dt * motion.tangential_velocity;
    if (squared_norm(increment) > jump * jump * squared_norm(moved)) increment = moved - dot(moved, touch.normal) * touch.normal;
  }
  // Where the stiffness has changed: a stiffer spring takes over the force, a softer one the slip; either stores less than before.
  const double stiffness_before = before.anchored != 0 ? before.tangential_stiffness : stiffness;
  const double stored_before = 0.5 * stiffness_before * squared_norm(elastic);
  if (stiffness > stiffness_before) elastic = (stiffness_before / stiffness) * elastic;
  // Work of the mean force over the way, less what is stored more than before.
  const auto lost = [&](const Vec3& now) {
    const double work = 0.5 * dot(force_before + stiffness * now, increment);
    return std::max(0.0, work - (0.5 * stiffness * squared_norm(now) - stored_before));
  };
  SlipResult result = slip(elastic, force_before, increment, stiffness, limit);
  if (stiffness != stiffness_before) result.dissipated = lost(result.elastic);
  if (options_.filter.acts()) {
    // The filter holds part of the trial slip back: that part slides.
    const double a = options_.filter.weight(host.dt);
    filtered = a * (elastic + increment) + (1.0 - a) * filtered;
    filtered -= dot(filtered, touch.normal) * touch.normal;
    const double size = stiffness * norm(filtered);
    result.elastic = size > limit ? (limit / size) * filtered : filtered;
    result.dissipated = lost(result.elastic);
  }
  assert(result.dissipated >= 0.0);
  totals.dissipated += result.dissipated;
  totals.stick += 0.5 * stiffness * squared_norm(result.elastic);

  after.anchored = 1;
  after.anchor = {touch.weight, touch.facet};
  after.slip = frame.to_local(result.elastic);
  if (options_.filter.acts()) after.filtered = frame.to_local(filtered);
  after.slip_normal = frame.to_local(touch.normal);
  after.tangential_stiffness = stiffness;
  after.friction = stiffness * result.elastic;
  return after.friction;
}

// numerics.md 7.4.3, to the letter; only its energy is ours (7.4.4 says why).
Vec3 Pass::rub_by_anchor(const HostState& host, const Side& surface, const Touch& touch, double limit, const NodeState& before,
                         NodeState& after, PassTotals& totals) const {
  const double stiffness = options_.tangential_ratio * touch.pair.stiffness;
  const SurfacePoint here{touch.weight, touch.facet};
  after.last = here;
  after.tangential_stiffness = stiffness;
  if (before.anchored == 0) {
    after.anchored = 1;
    after.anchor = here;
    after.slip = {};
    after.friction = {};
    return {};
  }
  Vec3 trial = before.slip + stiffness * (touch.point - point_of(surface, before.anchor));
  if (options_.filter.acts()) {
    // 7.4.5: before the slip test; the filtered value stays when the contact opens.
    const double a = options_.filter.weight(host.dt_bar_old);
    trial = a * trial + (1.0 - a) * before.filtered;
    after.filtered = trial;
  }
  const Vec3& n = touch.normal;
  Vec3 direction = trial - dot(trial, n) * n;
  const double tangential = norm(direction);
  if (tangential > 0.0) {
    direction = direction / tangential;
  } else {
    const double flat = std::sqrt(n.x * n.x + n.y * n.y);
    direction = flat > 0.0 ? Vec3{n.y / flat, -n.x / flat, 0.0} : Vec3{1.0, 0.0, 0.0};
  }
  const double size = norm(trial);
  const bool slips = size > limit;
  const Vec3 force = (slips ? limit : size) * direction;
  if (slips) {
    after.slip = force;
    after.anchor = here;
  }
  const double stored = stiffness > 0.0 ? 0.5 * squared_norm(force) / stiffness : 0.0;
  const double stored_before = before.tangential_stiffness > 0.0 ? 0.5 * squared_norm(before.friction) / before.tangential_stiffness : 0.0;
  if (slips) {
    const Vec3 moved = touch.point - point_of(surface, before.last);
    const double lost = 0.5 * dot(before.friction + force, moved) - (stored - stored_before);
    if (lost > 0.0) totals.dissipated += lost;
  }
  totals.stick += stored;
  after.friction = force;
  return force;
}

}  // namespace abut::contact
