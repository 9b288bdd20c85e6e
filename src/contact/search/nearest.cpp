#include "contact/search/nearest.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

bool admissible(const Measure& m, const HeldBy& held, bool held_in_front) {
  return pushes_alike(m, held.normal) || (held_in_front && m.distance >= 0.0);
}

}  // namespace

Measure signed_measure(const Side& surface, Index f, const ClosestPoint& closest, const Vec3& x) {
  Measure m{f, closest, {}, 0.0};
  const Vec3 r = x - closest.point;
  const Vec3 outward = surface.pseudonormal(f, closest);
  m.normal = outward;
  m.distance = dot(outward, r);
  if (closest.feature == Feature::face) return m;
  const double length = std::sqrt(closest.squared_distance);
  const Patch patch = surface.patch(f);
  const double size = std::sqrt(squared_norm(patch.x[2] - patch.x[0]));
  if (length > 1e-10 * size) {
    const bool front = m.distance >= 0.0;
    m.normal = front ? r / length : -r / length;
    m.distance = front ? length : -length;
  }
  return m;
}

Measure nearest(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held, Looks& looks) {
  constexpr double rounding = 1.0 + 1e-12;  // of the clock's sums
  const Candidates::Others last = candidates.others(node);
  if (last.facet != no_index && (held.facet == no_index || held.facet == last.facet) && surface.active(last.facet) &&
      (last.wide || held.strip <= border_strip)) {
    // The facet that was the nearest, as long as no other can be: what the search below would say, without looking at the list.
    const double distance = std::sqrt(looks.closest(last.facet, held.strip).squared_distance);
    if (last.due - candidates.clock() > rounding * distance) {
      candidates.set_nearest_due(node, distance + candidates.clock());
      return looks.measure(last.facet, held.strip);
    }
  }
  Measure best;
  bool held_in_front = false;
  double best_distance = 1e300;
  if (held.facet != no_index && surface.active(held.facet)) {
    best = looks.measure(held.facet, held.strip);
    held_in_front = best.distance >= 0.0;
    best_distance = std::sqrt(best.closest.squared_distance);
  }
  Index facet = no_index;
  const double clock = candidates.clock();
  const bool wide = held.strip > border_strip;  // the lists' distances are those of the usual strips
  const auto known = [&](const Candidates::Entry& entry) { return !wide || entry.wide || surface.borders(entry.facet) == 0; };
  double least = best_distance;
  const auto try_entry = [&](Candidates::Entry& entry) {
    const double distance = std::sqrt(looks.closest(entry.facet, held.strip).squared_distance);
    entry.due = distance + clock;
    entry.wide = wide;
    least = std::min(least, distance);
    const bool nearer = distance < best_distance || (distance == best_distance && facet != no_index && entry.facet < facet);
    if (!nearer) return;
    if (held.facet != no_index && !admissible(looks.measure(entry.facet, held.strip), held, held_in_front)) return;
    best_distance = distance;
    facet = entry.facet;
  };
  const std::span<Candidates::Entry> entries = candidates.of(node);
  Candidates::Entry* first = nullptr;
  if (held.facet == no_index) {
    // The likely answer first: most others are then left out unmeasured.
    for (Candidates::Entry& entry : entries) {
      if (surface.active(entry.facet) && (first == nullptr || entry.due < first->due)) first = &entry;
    }
    if (first != nullptr) try_entry(*first);
  }
  for (Candidates::Entry& entry : entries) {
    if ((known(entry) && entry.due - clock > rounding * best_distance) || entry.facet == held.facet || &entry == first ||
        !surface.active(entry.facet))
      continue;
    const double bound = distance_at_least(extended(surface, entry.facet, held.strip), x);
    if (bound > rounding * best_distance) {
      entry.due = bound + clock;
      entry.wide = wide;
      continue;
    }
    try_entry(entry);
  }
  candidates.set_nearest_due(node, least + clock);
  Candidates::Others others{facet == no_index ? best.facet : facet, true, 1e300};
  bool listed = false;
  for (const Candidates::Entry& entry : entries) {
    listed = listed || entry.facet == others.facet;
    if (entry.facet == others.facet || !surface.active(entry.facet)) continue;
    others.due = std::min(others.due, known(entry) ? static_cast<double>(entry.due) : -1e300);
    others.wide = others.wide && (entry.wide || surface.borders(entry.facet) == 0);
  }
  if (!listed) others.facet = no_index;
  candidates.set_others(node, others);
  return facet == no_index ? best : looks.measure(facet, held.strip);
}

bool none_within(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held, double distance,
                 const HeldAt& at, Looks& looks) {
  constexpr double rounding = 1e-10;  // of squared distances to one point of two facets
  const double clock = candidates.clock();
  const bool wide = held.strip > border_strip;
  Candidates::Others others{held.facet, true, 1e300};
  bool listed = false;
  for (Candidates::Entry& entry : candidates.of(node)) {
    if (entry.facet == held.facet) listed = true;
    if (entry.facet == held.facet || !surface.active(entry.facet)) continue;
    const bool borders = surface.borders(entry.facet) != 0;
    if ((wide && borders && !entry.wide) || !(entry.due - clock > distance)) {
      double bound = distance_at_least(extended(surface, entry.facet, held.strip), x);
      if (!(bound > distance)) {
        const ClosestPoint& closest = looks.closest(entry.facet, held.strip);
        bound = std::sqrt(closest.squared_distance);
        const bool shared = squared_norm(closest.point - at.point) < at.same && !closest.beyond &&
                            closest.squared_distance >= (1.0 - rounding) * at.squared_distance;
        if (!(bound > distance) && !shared) return false;
      }
      entry.due = bound + clock;
      entry.wide = wide;
    }
    others.due = std::min<double>(others.due, entry.due);
    others.wide = others.wide && (entry.wide || !borders);
  }
  if (listed) candidates.set_others(node, others);
  return listed;
}

}  // namespace abut::contact
