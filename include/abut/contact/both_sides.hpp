// Options of an interface that repels nodes on both sides of a surface (TYPE7).
#pragma once

#include <vector>

#include "abut/types.hpp"

namespace abut::contact {

struct BothSidesOptions {
  double gap = 0.0;               ///< length, > 0: distance at which a facet starts to repel
  std::vector<double> node_gap;   ///< #nodes, added to facet_gap where both are given (variable gap); empty: constant gap
  std::vector<double> facet_gap;  ///< #F
  double gap_max = 1e30;          ///< upper limit of node_gap + facet_gap

  double friction = 0.0;  ///< Coulomb coefficient, >= 0
  enum class Friction { viscous, incremental } friction_form = Friction::viscous;
  double damping = 0.05;            ///< VIS_s, fraction of critical
  double friction_viscosity = 1.0;  ///< VIS_F of the viscous form, 0 without friction

  /// What a pair does that penetrates at the start: full force, or the gap begins at what is there (Inacti 5; 6 with a
  /// margin of 5 % of the rest of the gap).
  enum class Initial { keep, offset, offset_with_margin } initial = Initial::keep;
  double largest_penetration = 0.0;  ///< Fpenmax: nodes deeper than this share of the gap at the start leave; 0: off

  double birth = 0.0, death = 1e30;
  double step_minimum = 0.0;  ///< nodes whose contact step falls below leave for good; 0: off
  double step_scale = 0.9;    ///< factor of that test
};

}  // namespace abut::contact
