// What the two sides are to each other at this moment: distances, sizes, stiffness, gap and time step.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/inspect/findings.hpp"
#include "contact/search/nearest.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {
namespace {

/// A node measured against the other side.
struct Seen {
  Index node, facet;
  double distance;  // signed
  double closing;   // speed of approach, > 0 when the distance shrinks
};

/// Everything that pass `k` (nodes of side k against the facets of the other one) sees within reach.
struct PassView {
  std::vector<Seen> seen;
  std::vector<Index> blind;
};

PassView view_of(const InspectionContext& c, std::size_t k, const Side& surface) {
  PassView out;
  const Shape& other = c.shapes[1 - k];
  for (const Index n : c.shapes[k].nodes()) {
    const Vec3 x = c.input.x[at(n)];
    const NearPoint p = other.nearest(x, c.views.reach);
    if (!p.found() || squared_norm(other.normal(p.item)) == 0.0) {
      out.blind.push_back(n);
      continue;
    }
    const ClosestPoint closest = closest_point(surface.patch(p.item), x);
    if (closest.beyond) {
      out.blind.push_back(n);
      continue;
    }
    const Measure m = signed_measure(surface, p.item, closest, x);
    double closing = 0.0;
    if (!c.input.v.empty()) {
      Vec3 there;
      for (std::size_t i = 0; i < 4; ++i) there += closest.weight[i] * c.input.v[at(other.facet(p.item).node[i])];
      closing = dot(there - c.input.v[at(n)], m.normal);
    }
    out.seen.push_back({n, p.item, m.distance, closing});
  }
  return out;
}

std::vector<Bar> histogram(const std::vector<double>& values) {
  constexpr int bars = 8;
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*high == *low) return {{*low, *high, static_cast<Index>(values.size())}};
  const double width = (*high - *low) / bars;
  std::vector<Bar> out;
  for (int b = 0; b < bars; ++b) out.push_back({*low + b * width, b + 1 == bars ? *high : *low + (b + 1) * width, 0});
  for (const double v : values) ++out[static_cast<std::size_t>(std::min(bars - 1, static_cast<int>((v - *low) / width)))].count;
  return out;
}

/// Means over the facets of a side that the other side's nodes see.
struct NearFacets {
  double size = 0.0, smallest = 1e300, stiffness = 0.0;
  int count = 0;
};

NearFacets near_facets(const Shape& s, const PassView& seen_by) {
  std::vector<std::uint8_t> marked(at(s.count()), 0);
  NearFacets out;
  for (const Seen& seen : seen_by.seen) {
    if (std::exchange(marked[at(seen.facet)], std::uint8_t{1}) != 0) continue;
    const double size = std::sqrt(s.area(seen.facet));
    out.size += size;
    out.smallest = std::min(out.smallest, size);
    if (!s.side().stiffness.empty()) out.stiffness += s.side().stiffness[at(seen.facet)];
    ++out.count;
  }
  if (out.count > 0) {
    out.size /= out.count;
    out.stiffness /= out.count;
  }
  return out;
}

/// Own stiffness of the nodes of a side: a quarter (third) of each facet around them, by position in nodes().
std::vector<double> node_stiffness(const Shape& s) {
  std::vector<double> sum(s.nodes().size(), 0.0);
  if (s.side().stiffness.empty()) return {};
  for (Index f = 0; f < s.count(); ++f) {
    const int corners = s.facet(f).corners();
    for (int i = 0; i < corners; ++i) {
      const auto found = std::lower_bound(s.nodes().begin(), s.nodes().end(), s.facet(f).node[at(i)]);
      sum[static_cast<std::size_t>(found - s.nodes().begin())] += s.side().stiffness[at(f)] / corners;
    }
  }
  return sum;
}

class Nearness {
 public:
  explicit Nearness(const InspectionContext& c) : c_(c) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Shape& surface = c.shapes[1 - k];
      if (surface.is_nodes()) continue;
      std::vector<Facet> facets(surface.side().facets.begin(), surface.side().facets.end());
      Side side(Surface(std::move(facets)), false);
      side.set({}, false);
      side.gather(c.input.x);
      pass_[k] = view_of(c, k, side);
    }
  }

  void run() {
    std::size_t seen = 0;
    for (const auto& pass : pass_) seen += pass ? pass->seen.size() : 0;
    if (seen == 0) {
      out_of_reach();
      return;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      if (pass_[k]) distances(k);
    }
    sizes_and_stiffness();
    approach();
    step();
  }

 private:
  const InspectionContext& c_;
  std::array<std::optional<PassView>, 2> pass_;

  void out_of_reach() const {
    Finding& f = c_.add(Severity::warning, "contact.out_of_reach", -1);
    f.measure_name = "smallest distance";
    f.measure = c_.views.smallest;
    f.what = "no node of either side has a segment of the other one in front of or behind it (smallest distance " +
             short_number(c_.views.smallest) + ")";
    f.advice = "Check that the interface names the right surfaces; if the bodies meet later by sliding, nothing is wrong.";
  }

  void distances(std::size_t k) const {
    const PassView& pass = *pass_[k];
    const Facing& facing = c_.views.side[1 - k].facing;
    const double size = c_.shapes[1 - k].mean_size();
    std::vector<double> depths, clearances;
    std::vector<Index> behind, within;
    double deepest = 0.0, most = 0.0;
    for (const Seen& seen : pass.seen) {
      if (facing.facet[at(seen.facet)] < 0) continue;  // the wrong way round: its distances mean nothing
      if (seen.distance < -1e-6 * size) {
        if (-seen.distance > 0.5 * size) continue;
        behind.push_back(seen.node);
        deepest = std::max(deepest, -seen.distance);
        depths.push_back(-seen.distance);
      } else if (seen.distance < c_.input.gap) {
        within.push_back(seen.node);
        most = std::max(most, c_.input.gap - seen.distance);
      } else {
        clearances.push_back(seen.distance - c_.input.gap);
      }
    }
    const int side = static_cast<int>(k);
    if (!behind.empty()) {
      Finding& f = c_.add(Severity::warning, "contact.overlap", side);
      f.measure_name = "largest depth";
      f.measure = deepest;
      f.what = counted(behind.size(), "node of this side lies", "nodes of this side lie") + " behind the other surface, up to " +
               short_number(deepest) + " deep";
      f.advice = "They start with a force that was never loaded: separate the meshes, unless a press fit is meant.";
      f.histogram = histogram(depths);
      f.nodes = std::move(behind);
    }
    if (!within.empty()) {
      const double share = most / c_.input.gap;
      std::vector<double> penetrations;
      for (const Seen& seen : pass.seen) {
        if (seen.distance >= 0.0 && seen.distance < c_.input.gap) penetrations.push_back(c_.input.gap - seen.distance);
      }
      Finding& f = c_.add(share > 0.5 ? Severity::warning : Severity::note, "contact.initial_penetration", side);
      f.measure_name = "largest penetration over gap";
      f.measure = share;
      f.what = counted(within.size(), "node of this side starts", "nodes of this side start") + " within the gap, the deepest " +
               short_number(100.0 * share) + " % of it";
      f.advice = "They start with a force: make the gap smaller than the distance of the meshes, or accept the stored energy CE at time 0.";
      f.histogram = histogram(penetrations);
      f.nodes = std::move(within);
    }
    if (!clearances.empty()) {
      Finding& f = c_.add(Severity::note, "contact.clearance", side);
      f.measure_name = "smallest clearance";
      f.measure = *std::min_element(clearances.begin(), clearances.end());
      f.what = counted(clearances.size(), "node of this side starts", "nodes of this side start") + " out of contact, " +
               short_number(f.measure) + " or more from the gap";
      f.advice = "Nothing to do if the bodies are to meet later.";
      f.histogram = histogram(clearances);
    }
    if (!pass.blind.empty()) {
      Finding& f = c_.add(Severity::note, "contact.blind_nodes", side);
      f.measure_name = "share of nodes";
      f.measure = static_cast<double>(pass.blind.size()) / static_cast<double>(c_.shapes[k].nodes().size());
      f.what = counted(pass.blind.size(), "node of this side has", "nodes of this side have") + " no segment of the other side before them";
      f.advice = "They feel no contact until they slide there; take facets out of the surface that can never touch.";
      f.nodes = pass.blind;
    }
  }

  void sizes_and_stiffness() const {
    if (c_.shapes[0].is_nodes() || c_.shapes[1].is_nodes()) {
      gap_against(1e300, c_.shapes[0].is_nodes() ? near_facets(c_.shapes[1], *pass_[0]) : near_facets(c_.shapes[0], *pass_[1]));
      return;
    }
    const std::array<NearFacets, 2> near{near_facets(c_.shapes[0], *pass_[1]), near_facets(c_.shapes[1], *pass_[0])};
    gap_against(near[0].smallest, near[1]);
    if (near[0].count == 0 || near[1].count == 0) return;
    const std::size_t coarse = near[0].size >= near[1].size ? 0 : 1;
    const double ratio = near[coarse].size / near[1 - coarse].size;
    if (ratio > c_.limits.size_ratio) {
      Finding& f = c_.add(Severity::warning, "contact.size_ratio", static_cast<int>(coarse));
      f.measure_name = "mean segment size over the other side's";
      f.measure = ratio;
      f.what = "its segments near the other side are " + short_number(ratio) + " times as large as those they meet";
      f.advice = "Refine the coarse side: one of its segments takes the force of many nodes and bends over its whole length.";
    }
    if (!(near[0].stiffness > 0.0 && near[1].stiffness > 0.0)) return;
    const std::size_t stiff = near[0].stiffness >= near[1].stiffness ? 0 : 1;
    const double stiffness_ratio = near[stiff].stiffness / near[1 - stiff].stiffness;
    if (stiffness_ratio <= c_.limits.stiffness_ratio) return;
    // T15: K = s r/(1 + r) K_soft. With s (1 + r)/2 the stiff side again sees s/2 of its own stiffness, as between equals;
    // at s = 1 the spring is as stiff as the soft side.
    const double suggested = std::min(1.0, 0.5 * c_.input.stiffness_scale * (1.0 + stiffness_ratio));
    Finding& f = c_.add(Severity::warning, "contact.stiffness_ratio", static_cast<int>(stiff));
    f.measure_name = "stiffness over the other side's";
    f.measure = stiffness_ratio;
    f.what = "it is " + short_number(stiffness_ratio) + " times as stiff as the other side, so the spring between them has " +
             short_number(100.0 * c_.input.stiffness_scale * stiffness_ratio / (1.0 + stiffness_ratio)) + " % of the soft side's stiffness";
    f.advice = suggested > 1.01 * c_.input.stiffness_scale
                   ? "If nodes sink in too far, raise Stfac to about " + short_number(suggested) + "; the time step may fall."
                   : "Stfac is as high as the theory suggests; watch the largest penetration.";
  }

  void gap_against(double smallest, const NearFacets& other) const {
    smallest = std::min(smallest, other.smallest);
    if (!(smallest < 1e300) || c_.input.gap <= c_.limits.gap_of_size * smallest) return;
    Finding& f = c_.add(Severity::warning, "contact.gap_large", -1);
    f.measure_name = "gap over smallest segment size";
    f.measure = c_.input.gap / smallest;
    f.what = "the gap is " + short_number(f.measure) + " times the size of the smallest segment near the other side";
    f.advice = "Nodes beside the contact get involved: make the gap smaller than half of a segment.";
  }

  void approach() const {
    double fastest = 0.0;
    Index node = no_index;
    for (const auto& pass : pass_) {
      if (!pass) continue;
      for (const Seen& seen : pass->seen) {
        if (seen.closing > fastest) {
          fastest = seen.closing;
          node = seen.node;
        }
      }
    }
    const double h = c_.input.element_step;
    if (node == no_index || !(h > 0.0) || !(c_.input.gap > 0.0)) return;
    const double steps = c_.input.gap / (fastest * h);
    if (steps >= c_.limits.steps_through_gap) return;
    Finding& f = c_.add(Severity::warning, "contact.gap_small", -1);
    f.measure_name = "steps through the gap";
    f.measure = steps;
    f.nodes = {node};
    f.what = "at the initial speed the fastest node crosses the gap in " + short_number(steps) + " steps";
    f.advice = "Make the gap larger, or expect the contact to lower the time step.";
  }

  void step() const {
    const double h = c_.input.element_step;
    if (!(h > 0.0) || c_.input.mass.empty()) return;
    double smallest = 1e300;
    Index node = no_index;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!pass_[k] || c_.shapes[k].is_nodes() || c_.shapes[1 - k].side().stiffness.empty()) continue;
      const std::vector<double> own = node_stiffness(c_.shapes[k]);
      if (own.empty()) continue;
      for (const Seen& seen : pass_[k]->seen) {
        const auto place = std::lower_bound(c_.shapes[k].nodes().begin(), c_.shapes[k].nodes().end(), seen.node);
        const double k1 = own[static_cast<std::size_t>(place - c_.shapes[k].nodes().begin())];
        const double k2 = c_.shapes[1 - k].side().stiffness[at(seen.facet)];
        const double m = c_.input.mass[at(seen.node)];
        if (!(k1 + k2 > 0.0) || !(m > 0.0)) continue;
        // The node's own spring and, from the other pass, about as much again (numerics.md 2.3: h <= sqrt(2 m/K)).
        const double step = std::sqrt(2.0 * m / (2.0 * c_.input.stiffness_scale * k1 * k2 / (k1 + k2)));
        if (step < smallest) {
          smallest = step;
          node = seen.node;
        }
      }
    }
    if (node == no_index || smallest >= h) return;
    Finding& f = c_.add(Severity::warning, "contact.interface_step", -1);
    f.measure_name = "interface step over element step";
    f.measure = smallest / h;
    f.nodes = {node};
    f.what = "the contact spring alone allows a step of " + short_number(smallest) + ", the elements one of " + short_number(h);
    f.advice = "The contact will lower the time step: reduce Stfac, or add mass to the light side (Stfac " +
               short_number(c_.input.stiffness_scale * (smallest / h) * (smallest / h)) + " would bring both to the same).";
  }
};

}  // namespace

void find_nearness(const InspectionContext& c) {
  if (c.shapes[0].count() == 0 || c.shapes[1].count() == 0) return;
  for (const Shape& s : c.shapes) {
    if (!s.is_nodes() && !(s.degenerate().empty() && s.duplicates().empty())) return;  // a surface that cannot be used
  }
  Nearness(c).run();
}

}  // namespace abut::contact
