// What the two sides are to each other at this moment: distances, sizes, stiffness, gap and time step.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/inspect/near_parts.hpp"

namespace abut::contact {
namespace {

std::vector<Bar> histogram(const std::vector<double>& values) {
  constexpr int bars = 8;
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*high == *low) return {{*low, *high, static_cast<Index>(values.size())}};
  const double width = (*high - *low) / bars;
  std::vector<Bar> out;
  for (int b = 0; b < bars; ++b) out.push_back({*low + b * width, b + 1 == bars ? *high : *low + (b + 1) * width, 0});
  for (const double v : values) {
    const double bar = (v - *low) / width;  // not a number where the width has no size that a double can hold
    ++out[bar < bars ? static_cast<std::size_t>(bar) : bars - 1].count;
  }
  return out;
}

class Nearness {
 public:
  explicit Nearness(const InspectionContext& c) : c_(c) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Shape& surface = c.shapes[1 - k];
      if (surface.is_nodes() || (k == 1 && one_pass())) continue;
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

  [[nodiscard]] bool one_pass() const {
    return c_.input.both_sides || c_.input.one_pass || c_.shapes[0].is_nodes() || c_.shapes[1].is_nodes();
  }
  [[nodiscard]] bool is_corner(Index node, const Shape& s) const { return std::binary_search(s.nodes().begin(), s.nodes().end(), node); }

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
    std::vector<double> depths, penetrations, clearances;
    std::vector<Index> behind, within;
    double deepest = 0.0, share = 0.0;
    for (const Seen& seen : pass.seen) {
      if (facing.facet[at(seen.facet)] < 0) continue;  // the wrong way round: its distances mean nothing
      if (seen.distance < -1e-6 * size) {
        if (-seen.distance > 0.5 * size) continue;
        behind.push_back(seen.node);
        deepest = std::max(deepest, -seen.distance);
        depths.push_back(-seen.distance);
      } else if (seen.distance < seen.gap) {
        within.push_back(seen.node);
        penetrations.push_back(seen.gap - seen.distance);
        share = std::max(share, penetrations.back() / seen.gap);
      } else if (!c_.input.both_sides || !is_corner(seen.node, c_.shapes[1 - k])) {  // a surface is not out of contact with itself
        clearances.push_back(seen.distance - seen.gap);
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
      Finding& f = c_.add(share > 0.5 ? Severity::warning : Severity::note, "contact.initial_penetration", side);
      f.measure_name = "largest penetration over gap";
      f.measure = share;
      f.what = counted(within.size(), "node of this side starts", "nodes of this side start") + " within the gap, the deepest " +
               short_number(100.0 * share) + " % of it";
      f.advice = c_.input.both_sides
                     ? "They start with a force unless Inacti says otherwise: make the gap smaller than the distance of the "
                       "meshes, or let it begin at what is there (Inacti 5 or 6)."
                     : "They start with a force: make the gap smaller than the distance of the meshes, or accept the stored "
                       "energy CE at time 0.";
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
    if (!pass.blind.empty() && !c_.input.both_sides) {  // sets of nodes are ample there by custom
      Finding& f = c_.add(Severity::note, "contact.blind_nodes", side);
      f.measure_name = "share of nodes";
      f.measure = static_cast<double>(pass.blind.size()) / static_cast<double>(c_.shapes[k].nodes().size());
      f.what = counted(pass.blind.size(), "node of this side has", "nodes of this side have") + " no segment of the other side before them";
      f.advice = "They feel no contact until they slide there; take facets out of the surface that can never touch.";
      f.nodes = pass.blind;
    }
  }

  void sizes_and_stiffness() const {
    const auto part = [this](std::size_t k) {
      const Shape& s = c_.shapes[k];
      if (s.is_nodes()) return pass_[k] ? near_nodes(s, *pass_[k]) : NearPart{};
      return near_facets(s, c_.input.both_sides, pass_[k], pass_[1 - k]);
    };
    const std::array<NearPart, 2> near{part(0), part(1)};
    gap_against(std::min(near[0].smallest, near[1].smallest));
    if (near[0].size > 0.0 && near[1].size > 0.0) compare_sizes(near);
    if (near[0].stiffness > 0.0 && near[1].stiffness > 0.0) compare_stiffness(near);
  }

  void compare_sizes(const std::array<NearPart, 2>& near) const {
    const std::size_t coarse = near[0].size >= near[1].size ? 0 : 1;
    const double ratio = near[coarse].size / near[1 - coarse].size;
    if (ratio <= c_.limits.size_ratio) return;
    Finding& f = c_.add(Severity::warning, "contact.size_ratio", static_cast<int>(coarse));
    f.measure_name = "mean segment size over the other side's";
    f.measure = ratio;
    f.what = "its segments near the other side are " + short_number(ratio) + " times as large as those they meet";
    f.advice = one_pass() && coarse == 0
                   ? "Refine the held side: between its nodes the segments of the other one pass through without a force."
                   : "Refine the coarse side: one of its segments takes the force of many nodes and bends over its whole length.";
  }

  void compare_stiffness(const std::array<NearPart, 2>& near) const {
    const std::size_t stiff = near[0].stiffness >= near[1].stiffness ? 0 : 1;
    const double stiffness_ratio = near[stiff].stiffness / near[1 - stiff].stiffness;
    if (stiffness_ratio <= c_.limits.stiffness_ratio) return;
    Finding& f = c_.add(Severity::warning, "contact.stiffness_ratio", static_cast<int>(stiff));
    f.measure_name = "stiffness over the other side's";
    f.measure = stiffness_ratio;
    f.what = "it is " + short_number(stiffness_ratio) + " times as stiff as the other side, so the spring between them has ";
    if (c_.input.both_sides) {
      f.what +=
          short_number(pair_spring(near[1].stiffness, near[0].stiffness) / near[1 - stiff].stiffness) + " times the soft side's stiffness";
      f.advice = "Choose Istf for the pair: 4 takes the softer side, 5 both in series; 0 and 1 look at the main surface alone.";
      return;
    }
    // T15: K = s r/(1 + r) K_soft. With s (1 + r)/2 the stiff side again sees s/2 of its own stiffness, as between equals;
    // at s = 1 the spring is as stiff as the soft side.
    const double suggested = std::min(1.0, 0.5 * c_.input.stiffness_scale * (1.0 + stiffness_ratio));
    f.what +=
        short_number(100.0 * c_.input.stiffness_scale * stiffness_ratio / (1.0 + stiffness_ratio)) + " % of the soft side's stiffness";
    f.advice = suggested > 1.01 * c_.input.stiffness_scale
                   ? "If nodes sink in too far, raise Stfac to about " + short_number(suggested) + "; the time step may fall."
                   : "Stfac is as high as the theory suggests; watch the largest penetration.";
  }

  void gap_against(double smallest) const {
    // The default gap of shells may be just half of the shortest side.
    if (!(smallest < 1e300) || c_.input.gap <= c_.limits.gap_of_size * (1.0 + 1e-9) * smallest) return;
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

  /// K0 of a pair where facets repel on both sides.
  [[nodiscard]] double pair_spring(double facet, double node) const {
    const double main = c_.input.stiffness_scale * facet;
    return 0.5 * (c_.input.pairs != nullptr ? c_.input.pairs->pair_stiffness(main, node) : main);
  }

  /// What the node of a pair feels (numerics.md 2.3: h <= sqrt(2 m/K)): its own spring and, from the other pass, about as much again.
  [[nodiscard]] double spring_of(std::size_t k, const Seen& seen, double own) const {
    const std::span<const double> stiffness = c_.shapes[1 - k].side().stiffness;
    const double facet = stiffness.empty() ? 0.0 : stiffness[at(seen.facet)];
    if (c_.input.both_sides) {
      const double stretch = seen.distance < seen.gap ? seen.gap / std::max(seen.distance, 1e-3 * seen.gap) : 1.0;
      return pair_spring(facet, own) * stretch * stretch;  // numerics.md 7.7.3: K0 (g/(g - p))^2
    }
    return facet + own > 0.0 ? (one_pass() ? 1.0 : 2.0) * c_.input.stiffness_scale * facet * own / (facet + own) : 0.0;
  }

  void step() const {
    const double h = c_.input.element_step;
    if (!(h > 0.0) || c_.input.mass.empty()) return;
    double smallest = 1e300;
    Index node = no_index;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!pass_[k]) continue;
      const std::vector<double> own = node_stiffness(c_.shapes[k]);
      for (const Seen& seen : pass_[k]->seen) {
        const double spring = spring_of(k, seen, own.empty() ? 0.0 : own[seen.place]);
        const double m = c_.input.mass[at(seen.node)];
        if (!(spring > 0.0) || !(m > 0.0)) continue;
        const double step = std::sqrt(2.0 * m / spring);
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
