// Which nodes of a pass need no measuring: they cannot touch, and coming near leaves no trace in them.
#include <algorithm>
#include <cmath>

#include "contact/enforce/pass.hpp"

namespace abut::contact {

double Pass::squared_motion(const HostState& host, const Side& held, const SideLoads& held_loads, Index i) const {
  const Vec3 coming = host.dt * host.v[at(held.nodes()[at(i)])] - mean_step_;
  const Vec3 last = held.x()[at(i)] - held_loads.x_before[at(i)] - mean_step_;
  return std::max(squared_norm(last), squared_norm(coming));
}

bool Pass::near(const HostState& host, const Side& held, const SideLoads& held_loads, Index i, double distance) const {
  return distance <= reach() && !clears(squared_motion(host, held, held_loads, i), rounding * distance + candidates_.clock());
}

void Pass::look_at_borders(const Side& surface, Index i, const Vec3& x, FacetViews& facets) {
  double lowest = 1e300;
  for (const Candidates::Entry& entry : candidates_.of(i)) {
    if (entry.border) lowest = std::min(lowest, facets.plane(surface, entry.facet).height(x));
  }
  candidates_.set_border_due(i, lowest + candidates_.clock());
}

bool Pass::far(const Scene& scene, Index i, bool seen, FacetViews& facets) {
  const HostState& host = scene.host;
  const Side& surface = scene.surface;
  const double motion = squared_motion(host, scene.held, scene.held_loads, i);
  if (clears(motion, candidates_.nearest_due(i))) return true;
  if (!clears(motion, 1e300) || stale_) return false;
  // The clock counts the largest motion of all nodes: look how far the planes of the facets are, and where that does not tell, how those
  // facets move that are near. On their own they move less.
  const double clock = candidates_.clock();
  const Vec3 x = scene.held.x()[at(i)];
  const Vec3 last = x - scene.held_loads.x_before[at(i)], coming = host.dt * host.v[at(scene.held.nodes()[at(i)])];
  const auto moving = [&](Index f) -> const FacetView& { return facets.moving(surface, scene.surface_loads.x_before, host.v, host.dt, f); };
  const auto passes = [&](Index f, double distance, double beyond) {
    return moving(f).moves_less(last, coming, beyond, passed_over * (distance - largest_gap_));
  };
  const double clears_from = (clock + largest_gap_ + (std::sqrt(motion) + surface_step_) / passed_over) * rounding;
  bool serves = true;  // for some steps
  const auto clear_of_face = [&](Candidates::Entry& entry) {
    if (entry.due > clears_from) return true;
    const double height = facets.plane(surface, entry.facet).height(x);
    entry.due = std::max<double>(entry.due, height + clock);
    if (entry.due > clears_from) return true;
    serves = false;
    return seen && (passes(entry.facet, entry.due - clock, 1.0) ||
                    moving(entry.facet).comes_less(x, height, coming, passed_over * (height - largest_gap_)));
  };
  // At a free border: not around it, for it stays in front of the plane, be it within the gap; and not near the strip, or else not at its
  // end, where nothing is in front.
  bool over_borders = candidates_.border_due(i) + largest_gap_ > clears_from;
  if (!over_borders) {
    look_at_borders(surface, i, x, facets);
    over_borders = candidates_.border_due(i) + largest_gap_ > clears_from;
  }
  const auto clear_of_border = [&](Candidates::Entry& entry) {
    constexpr double beyond_strips = 2.0, around = 3.0;
    if (!over_borders) {
      const double above = facets.plane(surface, entry.facet).height(x) + largest_gap_;
      if (!(above + clock > clears_from)) {
        serves = false;
        if (!passes(entry.facet, above, around)) return false;
      }
    }
    if (entry.due > clears_from) return true;
    const Patch patch = surface.patch(entry.facet);
    entry.due = distance_at_least(patch, x) + clock;
    entry.wide = false;
    if (entry.due > clears_from) return true;
    serves = false;
    if (!seen) return false;
    const ClosestPoint end = closest_point(patch, x);
    return !end.beyond && passes(entry.facet, std::sqrt(end.squared_distance), beyond_strips);
  };
  for (Candidates::Entry& entry : candidates_.of(i)) {
    if (!(entry.border ? clear_of_border(entry) : clear_of_face(entry))) return false;
  }
  if (!serves) return true;
  // What limits is looked at again: in front of facets, then over the planes at borders.
  const std::span<Candidates::Entry> listed = candidates_.of(i);
  double due = 1e300;
  for (bool raised = !listed.empty(); raised;) {
    Candidates::Entry& first = *std::min_element(listed.begin(), listed.end(), [](const auto& a, const auto& b) { return a.due < b.due; });
    due = first.due;
    if (!first.border) first.due = std::max<double>(due, facets.plane(surface, first.facet).height(x) + clock);
    raised = first.due > due;
  }
  if (candidates_.border_due(i) + largest_gap_ < due) {
    look_at_borders(surface, i, x, facets);
    due = std::min(due, candidates_.border_due(i) + largest_gap_);
  }
  candidates_.set_nearest_due(i, due);
  return true;
}

}  // namespace abut::contact
