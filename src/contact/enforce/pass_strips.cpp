// Strips of free borders that a node may enter in the coming step: the step is ready for them before the node is there.
#include <algorithm>
#include <cmath>

#include "contact/enforce/pass.hpp"

namespace abut::contact {
namespace {

// Least distance across a facet between opposite sides; of triangles the least height. 0: none.
double across(const Patch& patch, double area) {
  const std::size_t corners = patch.triangle ? 3 : 4;
  double longest = 0.0;
  for (std::size_t k = 0; k < corners; ++k) longest = std::max(longest, norm(patch.x[(k + 1) % corners] - patch.x[k]));
  return longest > 0.0 ? (patch.triangle ? 2.0 : 1.0) * area / longest : 0.0;
}

// How far a point of the facet is inside the outer ends of its strips, in lengths of the side.
double inside_strips(const Patch& patch, const ClosestPoint& at) {
  const double s = at.s, t = at.t;
  const std::array<double, 4> over = patch.triangle
                                         ? std::array<double, 4>{-t, s + t - 1.0, -s, 0.0}
                                         : std::array<double, 4>{-0.5 * (1.0 + t), 0.5 * (s - 1.0), 0.5 * (t - 1.0), -0.5 * (1.0 + s)};
  double least = 1e300;
  for (unsigned e = 0; e < 4; ++e) {
    if ((patch.borders >> e & 1U) != 0) least = std::min(least, patch.strip - over[e]);
  }
  return least;
}

}  // namespace

void Pass::foresee_strips(const HostState& host, const Side& held, const Side& surface, SideLoads& held_loads, Index i, GroupSums& sums) {
  const double clock = candidates_.clock();
  if (!closest() || host.dt <= 0.0 || candidates_.strips_due(i) > clock || states_.after(i).ignored != 0) return;
  double largest = 0.0, clear = 1e300;
  for (const Candidates::Entry& entry : candidates_.of(i)) {
    if (!entry.border || !surface.active(entry.facet)) continue;
    // Not further than every list reaches: what is said must not depend on how old the lists are.
    if (const double beyond = entry.due - clock - reach(); beyond > 0.0) {
      clear = std::min(clear, beyond);
      continue;
    }
    const ClosestPoint end = closest_point(surface.patch(entry.facet), held.x()[at(i)]);
    const StripAhead strip = strip_ahead(host, held, surface, i, entry.facet, end);
    clear = std::min(clear, strip.clear);
    if (strip.stiffness <= 0.0) continue;
    largest = std::max(largest, strip.stiffness);
    Reaction& reaction = sums.reactions.emplace_back(entry.facet, strip.stiffness, 0.0, end.weight);
    reaction.normal.fill({});
    reaction.tangential = Vec3{};
  }
  candidates_.set_strips_due(i, clock + clear);
  held_loads.load(i).own_stiffness += largest;
}

Pass::StripAhead Pass::strip_ahead(const HostState& host, const Side& held, const Side& surface, Index i, Index facet,
                                   const ClosestPoint& end) const {
  const Patch patch = surface.patch(facet);
  const double side = across(patch, surface.facet_area(facet));
  if (side <= 0.0) return {};
  // Seen along the facet: what the node is behind the gap, and how far outside the strip's end.
  const Vec3 n = normal_at(patch, end.s, end.t);
  const Vec3 r = held.x()[at(i)] - end.point;
  const double distance = dot(r, n), outside = norm(r - distance * n);
  const double furthest = flight_share * size_;  // nobody looks ahead further
  // The clock counts what moves and what strips extrapolate; where the facet turns, what is over it moves by that much more.
  const double lever = 1.0 + 2.0 * std::abs(distance) / side;
  const double clear = std::max(0.0, end.beyond ? outside - furthest : 0.5 * side * inside_strips(patch, end)) / lever;
  if (!end.beyond || outside > furthest) return {0.0, clear};
  const double gap = full_gap(held, surface, i, facet, end.weight);
  const double penetration = gap - states_.after(i).offset - distance;
  if (patch.narrow < Patch::too_narrow) return {0.0, clear};
  if (penetration <= 0.0 || -distance > depth_[at(facet)] || norm(r) > reach()) return {0.0, clear};
  const std::array<Index, 4> node = surface.surface().facet(facet).node;
  double slowest = 1e300, fastest = -1e300;
  for (const Index corner : node) {
    const double rises = dot(host.v[at(corner)], n);
    slowest = std::min(slowest, rises);
    fastest = std::max(fastest, rises);
  }
  // The node's foot moves along the facet by its own motion and by the facet's turning.
  const Vec3 v = velocity_over(host, held, surface, i, {end.weight, facet});
  const double speed = norm(v - dot(v, n) * n) + (fastest - slowest) / side * std::abs(distance);
  if (outside > 1.5 * step_growth * host.dt * speed) return {0.0, clear};
  const double width = (1.0 - border_flat) * patch.strip * side;
  double spread = 0.0;
  for (const double w : end.weight) spread += std::abs(w);
  // |T''| <= 8 in units of the part in which the strip falls; 16 times that, for a step at a quarter of the limit: a flank that a node
  // enters within a step takes and gives other energies than it holds by up to h^2 K/m, and no first force corrects it as the normal one
  // is.
  const double curvature = 16.0 * 8.0 * law_of(gap).potential(penetration) / (width * width);
  return {0.5 * (1.0 + spread) * plain_stiffness(held, surface, i, facet) * curvature, clear};
}

}  // namespace abut::contact
