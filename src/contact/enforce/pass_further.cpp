// Facets that hold a node beside the nearest one: those as near, and those that store more (docs/theory/contact.md, 3).
#include <algorithm>
#include <cmath>

#include "contact/enforce/pass.hpp"

namespace abut::contact {

double Pass::strongest(const Side& held, const Side& surface, Index i) const {
  const double k1 = surface.largest_corner_stiffness();
  const double k2 = held.node_stiffness(i);
  if (half_of_facet_) return 0.5 * options_.stiffness_scale * k1;
  return k1 > 0.0 && k2 > 0.0 ? options_.stiffness_scale * k1 * k2 / (k1 + k2) : 0.0;
}

double Pass::reach_of_stronger(double stiffness, double strongest, double p) const {
  // phi(P*)/phi(P) <= (P*/P)^2 for both laws.
  const double share = strongest > 0.0 ? stiffness * (1.0 + equally_strong) / strongest : 1.0;
  if (share >= 1.0) return 0.0;
  const double length = stronger_within * longest_;
  return (1.0 - std::sqrt(share)) * p * length / (p + length);
}

template <class Use>
void Pass::each_beside(const Side& surface, Index i, const Vec3& x, const Measure& m, const HeldBy& by, double strip, bool was_held,
                       double beyond, Looks& looks, const Use& use) const {
  const double distance = std::sqrt(m.closest.squared_distance);
  const double reach = was_held ? 1e300 : std::max(largest_gap_, largest_depth_);  // what every list holds
  const double equal = equally_near * distance;
  // Who may not be the nearest of a held node (nearest()) may not store more either: else it would stop to where it comes nearer.
  const auto may_be_nearest = [&](const Measure& its) {
    if (by.facet == no_index || pushes_alike(its, by.normal)) return true;
    return its.distance >= 0.0 && looks.measure(by.facet, strip).distance >= 0.0;
  };
  const double within = (1.0 + equally_near) * distance + beyond;
  for (const Candidates::Entry& entry : candidates_.of(i)) {
    const Index f = entry.facet;
    if (entry.due - candidates_.clock() > within || f == m.facet || !surface.active(f)) continue;
    if (!looks.has(f, strip) && distance_at_least(extended(surface, f, strip), x) > within) continue;
    const ClosestPoint& other = looks.closest(f, strip);
    const double away = std::sqrt(other.squared_distance);
    const bool as_near = std::abs(away - distance) <= equal;
    if (!as_near && !(away > distance && away - distance < beyond && away <= reach)) continue;
    if (other.beyond) continue;
    const Measure its = looks.measure(f, strip);
    if (its.distance * m.distance < 0.0 || dot(its.normal, m.normal) < -0.5) continue;
    if (may_be_nearest(its)) use(its, as_near);
  }
}

Pass::OuterGap Pass::outer_gap(const Side& held, const Side& surface, Index i, const Measure& m, const HeldBy& by, double strip,
                               bool was_held, Looks& looks) const {
  const double own = full_gap(held, surface, i, m.facet, m.closest.weight);
  OuterGap outer{own, own};
  const double more = largest_gap_ - own;
  if (!uneven_gap(surface) || more <= 0.0) return outer;
  const double length = stronger_within * longest_;
  each_beside(surface, i, held.x()[at(i)], m, by, strip, was_held, more * length / (more + length), looks, [&](const Measure& its, bool) {
    const double within = widening_[at(its.facet)] > 0.0 ? stronger_within / widening_[at(its.facet)] : 0.0;
    const double less = std::max(0.0, std::abs(its.distance) - std::abs(m.distance));
    if (less >= within) return;
    const double of_facet = full_gap(held, surface, i, its.facet, its.closest.weight);
    const double gap = of_facet - less * within / (within - less);
    if (gap > outer.gap) outer = {gap, of_facet};
  });
  return outer;
}

void Pass::look_further(const Side& held, const Side& surface, const Measure& m, Index i, const HeldBy& by, double strip, bool was_held,
                        Looks& looks, Touch& touch, GroupSums& sums) {
  const Vec3 x = held.x()[at(i)];
  const double distance = std::sqrt(m.closest.squared_distance);
  const double size = surface.facet_area(m.facet);
  const double gap = touch.penetration + m.distance;
  const double beyond = uneven_gap(surface) ? reach_of_stronger(0.0, 1.0, touch.penetration + (largest_gap_ - touch.full_gap))
                                            : reach_of_stronger(touch.pair.stiffness, strongest(held, surface, i), touch.penetration);
  if (outgrows(i, distance + beyond)) sums.outgrown = true;
  touch.first_further = sums.further.size();
  const auto gap_with = [&](double full) { return gap + (full - touch.full_gap); };
  each_beside(surface, i, x, m, by, strip, was_held, beyond, looks, [&](const Measure& its, bool as_near) {
    // The same point, seen from the facet across, is the same contact unless its strip fades elsewhere.
    const bool same = squared_norm(its.closest.point - m.closest.point) < same_point * size;
    if (same && beyond <= 0.0) return;
    const double full = full_gap(held, surface, i, its.facet, its.closest.weight);
    const double its_gap = gap_with(full);
    const PairForce own = force_of(held, surface, its, i, Depth{its_gap - its.distance, m.distance}, touch.widens);
    if (same && own.stiffness <= (1.0 + equally_strong) * touch.pair.stiffness) return;
    if (sums.further.size() == touch.first_further) {
      const double of_nearest = full_gap(held, surface, i, m.facet, m.closest.weight);
      sums.further.push_back({m, gap_with(of_nearest), law_of(of_nearest), touch.pair, true, false, {}});
    }
    sums.further.push_back({its, its_gap, law_of(full), own, as_near && !same, false, {}});
  });
  if (sums.further.size() == touch.first_further) return;
  const std::span<Further> all = std::span(sums.further).subspan(touch.first_further);
  touch.equals = static_cast<int>(std::count_if(all.begin(), all.end(), [](const Further& one) { return one.equal; }));
  PairForce sum;
  Vec3 normal{};
  for (Further& one : all) {
    if (!one.equal) continue;
    normal += one.measure.normal;
    add_strongest(held, surface, i, touch.widens, one, all, 1.0 / touch.equals, sum);
  }
  sum.on_facet = all[0].on_facet;
  all[0].acts = false;  // it has the node's own reaction
  if (touch.equals > 1 || std::any_of(all.begin(), all.end(), [](const Further& one) { return one.acts; })) {
    touch.pair = sum;
    touch.further = all.size();
    if (touch.equals > 1) touch.normal = normalized(normal);
  } else {
    sums.further.resize(touch.first_further);
  }
}

void Pass::add_strongest(const Side& held, const Side& surface, Index i, bool widens, Further& nearest, std::span<Further> all,
                         double share, PairForce& sum) const {
  const double sign = nearest.measure.distance < 0.0 ? -1.0 : 1.0;
  struct Other {
    double length, less, p, depth;  // p: were it as near as the nearest
  };
  const auto seen = [&](const Further& one) {
    const double length = stronger_within / widening_[at(one.measure.facet)];
    const double less = std::max(0.0, sign * (one.measure.distance - nearest.measure.distance));
    const double p = one.gap - nearest.measure.distance;
    return Other{length, less, p, p - less * (1.0 + p / length)};
  };
  const auto stores = [&](const Further& one) {
    if (&one == &nearest || widening_[at(one.measure.facet)] <= 0.0) return 0.0;
    return one.own.stiffness * one.law.potential(seen(one).depth);
  };
  double most = 0.0;
  for (const Further& one : all) most = std::max(most, stores(one));
  const auto add = [&](const PairForce& part, double of_it) {
    sum.on_node += of_it * part.on_node;
    sum.magnitude += of_it * part.magnitude;
    sum.potential += of_it * part.potential;
    sum.stiffness = std::max(sum.stiffness, part.stiffness);
    sum.whole = std::max(sum.whole, part.whole);
    sum.extra_tangent = std::max(sum.extra_tangent, part.extra_tangent);
  };
  if (most <= (1.0 + equally_strong) * nearest.own.potential) {
    add(nearest.own, share);
    for (std::size_t c = 0; c < 4; ++c) nearest.on_facet[c] += share * nearest.own.on_facet[c];
    nearest.acts = true;
    return;
  }
  const auto strong = [&](const Further& one) { return stores(one) >= (1.0 - equally_strong) * most; };
  share /= static_cast<double>(std::count_if(all.begin(), all.end(), strong));
  for (Further& one : all) {
    if (!strong(one)) continue;
    const Other o = seen(one);
    const double slope = sign * (1.0 + o.p / o.length);
    const double of_nearest = 1.0 - o.less / o.length - slope;
    PairForce part =
        force_of(held, surface, one.measure, i, Depth{o.depth, nearest.measure.distance, slope, false, 1.0 - o.less / o.length}, widens);
    part.magnitude = part.stiffness * one.law.force(o.depth);
    const Vec3 push = (of_nearest * part.magnitude + part.of_wider) * nearest.measure.normal;
    part.on_node += push;
    const double turn =
        slope * slope + of_nearest * of_nearest + 2.0 * slope * of_nearest * dot(one.measure.normal, nearest.measure.normal);
    part.extra_tangent += std::max(turn - 1.0, 0.0) * part.stiffness * one.law.tangent(o.p) + 2.0 * part.magnitude / o.length;
    add(part, share);
    for (std::size_t c = 0; c < 4; ++c) {
      one.on_facet[c] += share * part.on_facet[c];
      nearest.on_facet[c] -= (share * nearest.measure.closest.weight[c]) * push;
    }
    one.acts = nearest.acts = true;
  }
}

}  // namespace abut::contact
