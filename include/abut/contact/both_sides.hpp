// Options of an interface that repels nodes on both sides of a surface (TYPE7; numerics.md 7.7).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "abut/contact/friction_law.hpp"
#include "abut/types.hpp"

namespace abut::contact {

/// Gap of a pair: max(gap, min(node_gap + facet_gap, gap_max, node_size + facet_size)); `gap` alone where the arrays are empty.
/// Ranges and lengths are checked when the interface is made: std::invalid_argument.
/// Stiffness of a pair: from the facet's K_m (SurfaceState of side 1) and the node's K_s (side 0), see Stiffness.
struct BothSidesOptions {
  double gap = 0.0;                ///< length, > 0: distance at which a facet starts to repel, at least
  std::vector<double> node_gap;    ///< #nodes, lengths (Igap 1 to 3); given together with facet_gap
  std::vector<double> facet_gap;   ///< #F
  double gap_max = 1e30;           ///< upper limit of node_gap + facet_gap (Igap 2, 3)
  std::vector<double> node_size;   ///< #nodes, lengths (Igap 3), 1e30: no limit; given together with facet_size; empty: none
  std::vector<double> facet_size;  ///< #F

  /// K: of the facet, mean, larger, smaller of both, or in series (Istf 0 and 1, 2, 3, 4, 5). All but the first are clipped.
  enum class Stiffness { facet, mean, larger, smaller, series } stiffness = Stiffness::facet;
  double stiffness_min = 0.0, stiffness_max = 1e30;  ///< force/length

  double friction = 0.0;     ///< Coulomb coefficient, >= 0
  FrictionLaw friction_law;  ///< how it depends on pressure and speed
  FrictionFilter filter;     ///< of the friction force (viscous) or of its increment (incremental)
  enum class Friction { viscous, incremental } friction_form = Friction::viscous;
  double damping = 0.05;            ///< VIS_s, fraction of critical; >= 0
  double friction_viscosity = 1.0;  ///< VIS_F of the viscous form, 0 without friction; >= 0

  /// What a pair does that penetrates at the start: full force; the gap begins at what is there (Inacti 5; 6 with a
  /// margin of 5 % of the rest of the gap); the node leaves (1); the facet has no stiffness (2).
  /// Inacti 3 and 4 are Interface::projections() before the start, then keep.
  enum class Initial { keep, offset, offset_with_margin, drop_nodes, drop_facets } initial = Initial::keep;
  double largest_penetration = 0.0;  ///< Fpenmax: nodes deeper than this share of the gap at the start leave; 0: off

  double birth = 0.0, death = 1e30;  ///< times from which and until which it acts, death > birth
  double step_minimum = 0.0;         ///< time: nodes whose contact step falls below leave for good; 0: off
  double step_scale = 0.9;           ///< factor of that test, > 0
  /// What dampers hand to the nodal sum: c/h as the reference program, or 2 c/h and the friction spring too, which keeps two free
  /// bodies stable (forces at t^n are made of speeds at n - 1/2: h <= 2/lambda(C)).
  bool reference_step = false;
  /// In the cycles in which a pair starts and ends: a force that makes no energy by switching, and a step that is short already when
  /// it touches (docs/theory/contact.md, 7a); false: the law's own force in every cycle.
  bool switch_correction = true;

  /// Geometry of quadrilaterals: false, the nearest of their four triangles (the force is the gradient of the stored energy); true, the
  /// reference program's weighted mean over the triangles within reach, with its hourglass-free distribution.
  bool all_pieces = false;

  /// Gap of the pair of a node (position in the list of nodes) and a facet (position as listed by the host).
  [[nodiscard]] double pair_gap(std::size_t node, std::size_t facet) const {
    if (node_gap.empty()) return gap;
    double sum = std::min(node_gap[node] + facet_gap[facet], gap_max);
    if (!node_size.empty()) sum = std::min(sum, node_size[node] + facet_size[facet]);
    return std::max(gap, sum);
  }
  /// Of any pair, as far as nodes and facets taken apart can tell.
  [[nodiscard]] double largest_gap() const {
    if (node_gap.empty() || facet_gap.empty()) return gap;
    const auto largest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
    double sum = std::min(largest(node_gap) + largest(facet_gap), gap_max);
    if (!node_size.empty() && !facet_size.empty()) sum = std::min(sum, largest(node_size) + largest(facet_size));
    return std::max(gap, sum);
  }
  /// K of a pair of K_m and K_s.
  [[nodiscard]] double pair_stiffness(double facet, double node) const {
    if (stiffness == Stiffness::facet) return facet;
    double k = facet + node > 0.0 ? facet * node / (facet + node) : 0.0;
    if (stiffness == Stiffness::mean) k = 0.5 * (facet + node);
    if (stiffness == Stiffness::larger) k = std::max(facet, node);
    if (stiffness == Stiffness::smaller) k = std::min(facet, node);
    return std::clamp(k, stiffness_min, stiffness_max);
  }

  /// Some coefficient is not zero.
  [[nodiscard]] bool rubs() const { return friction > 0.0 || friction_law.model != FrictionLaw::Model::coulomb; }
};

}  // namespace abut::contact
