#include "contact/inspect/near_parts.hpp"

#include <algorithm>
#include <cmath>

#include "contact/search/nearest.hpp"

namespace abut::contact {
namespace {

/// Positions of a shape's nodes() in the list that the host gave for a set of nodes.
std::vector<std::size_t> listed_places(const Shape& s) {
  std::vector<std::size_t> out(s.nodes().size(), 0);
  for (std::size_t i = 0; i < s.side().nodes.size(); ++i) {
    const auto found = std::lower_bound(s.nodes().begin(), s.nodes().end(), s.side().nodes[i]);
    out[static_cast<std::size_t>(found - s.nodes().begin())] = i;
  }
  return out;
}

struct SignedPoint {
  ClosestPoint closest;
  Vec3 normal;  // from the facet's point to the node, or the facet's
  double distance = 0.0;
};

SignedPoint measure(const InspectionContext& c, const Side& surface, Index facet, const Vec3& x) {
  if (!c.input.both_sides) {
    const ClosestPoint closest = closest_point(surface.patch(facet), x);
    const Measure m = signed_measure(surface, facet, closest, x);
    return {closest, m.normal, m.distance};
  }
  Patch patch = surface.patch(facet);
  patch.borders = 0;  // such a facet ends where it ends: its gap is round about its rim
  const ClosestPoint closest = closest_point(patch, x);
  const double distance = std::sqrt(closest.squared_distance);
  return {closest, distance > 0.0 ? (x - closest.point) / distance : normal_at(patch, closest.s, closest.t), distance};
}

double shortest_side(const Shape& s, Index f) {
  const int corners = s.facet(f).corners();
  double shortest = 1e300;
  for (int e = 0; e < corners; ++e) shortest = std::min(shortest, norm(s.corner(f, (e + 1) % corners) - s.corner(f, e)));
  return shortest;
}

}  // namespace

PassView view_of(const InspectionContext& c, std::size_t k, const Side& surface) {
  PassView out;
  const Shape& own = c.shapes[k];
  const Shape& other = c.shapes[1 - k];
  const bool of_pairs = c.input.both_sides && c.input.pairs != nullptr && own.is_nodes();
  const std::vector<std::size_t> listed = of_pairs ? listed_places(own) : std::vector<std::size_t>();
  for (std::size_t i = 0; i < own.nodes().size(); ++i) {
    const Index n = own.nodes()[i];
    const Vec3 x = c.input.x[at(n)];
    const NearPoint p = other.nearest(x, c.views.reach, c.input.both_sides ? n : no_index);
    if (!p.found() || squared_norm(other.normal(p.item)) == 0.0) {
      out.blind.push_back(n);
      continue;
    }
    const SignedPoint m = measure(c, surface, p.item, x);
    if (m.closest.beyond) {
      out.blind.push_back(n);
      continue;
    }
    double closing = 0.0;
    if (!c.input.v.empty()) {
      Vec3 there;
      for (std::size_t j = 0; j < 4; ++j) there += m.closest.weight[j] * c.input.v[at(other.facet(p.item).node[j])];
      closing = dot(there - c.input.v[at(n)], m.normal);
    }
    const double gap = of_pairs ? c.input.pairs->pair_gap(listed[i], at(p.item)) : c.input.gap;
    out.seen.push_back({n, p.item, m.distance, closing, gap, i});
  }
  return out;
}

std::vector<double> node_stiffness(const Shape& s) {
  if (s.side().stiffness.empty()) return {};
  std::vector<double> sum(s.nodes().size(), 0.0);
  if (s.is_nodes()) {
    const std::vector<std::size_t> listed = listed_places(s);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = s.side().stiffness[listed[i]];
    return sum;
  }
  for (Index f = 0; f < s.count(); ++f) {
    const int corners = s.facet(f).corners();
    for (int i = 0; i < corners; ++i) {
      const auto found = std::lower_bound(s.nodes().begin(), s.nodes().end(), s.facet(f).node[at(i)]);
      sum[static_cast<std::size_t>(found - s.nodes().begin())] += s.side().stiffness[at(f)] / corners;
    }
  }
  return sum;
}

NearPart near_facets(const Shape& s, bool both_sides, const std::optional<PassView>& own, const std::optional<PassView>& seen_by) {
  std::vector<std::uint8_t> near(at(s.count()), 0);
  if (seen_by) {
    for (const Seen& seen : seen_by->seen) near[at(seen.facet)] = 1;
  }
  if (own) {
    std::vector<std::uint8_t> sees(s.nodes().size(), 0);
    for (const Seen& seen : own->seen) sees[seen.place] = 1;
    for (Index f = 0; f < s.count(); ++f) {
      for (const Index n : s.facet(f).node) {
        const auto found = std::lower_bound(s.nodes().begin(), s.nodes().end(), n);
        if (sees[static_cast<std::size_t>(found - s.nodes().begin())] != 0) near[at(f)] = 1;
      }
    }
  }
  NearPart out;
  int count = 0;
  for (Index f = 0; f < s.count(); ++f) {
    if (near[at(f)] == 0) continue;
    const double size = std::sqrt(s.area(f));
    out.size += size;
    out.smallest = std::min(out.smallest, both_sides ? shortest_side(s, f) : size);
    if (!s.side().stiffness.empty()) out.stiffness += s.side().stiffness[at(f)];
    ++count;
  }
  if (count > 0) {
    out.size /= count;
    out.stiffness /= count;
  }
  return out;
}

NearPart near_nodes(const Shape& s, const PassView& own) {
  const std::vector<std::size_t> listed = listed_places(s);
  NearPart out;
  int sized = 0, stiff = 0;
  for (const Seen& seen : own.seen) {
    const std::size_t i = listed[seen.place];
    if (!s.side().size.empty() && s.side().size[i] > 0.0) {
      out.size += s.side().size[i];
      ++sized;
    }
    if (!s.side().stiffness.empty() && s.side().stiffness[i] > 0.0) {
      out.stiffness += s.side().stiffness[i];
      ++stiff;
    }
  }
  if (sized > 0) out.size /= sized;
  if (stiff > 0) out.stiffness /= stiff;
  return out;
}

}  // namespace abut::contact
