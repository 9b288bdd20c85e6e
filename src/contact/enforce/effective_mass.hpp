// Effective mass of a pair: what a unit impulse between a node and the point of a facet does to their opening speed.
//
//   1/m = sum w_i^2 (1/m_i, or n.A_i n where the host gives a mobility A_i),   w = 1 for the node, -H_i for the corners.
//
// A node that is held along n counts as infinitely heavy. A_i of a rigid body's nodes as in mobility.hpp: for one pair alone the sum over
// the corners is then 1/M + (r x n).J^-1 (r x n) at the facet's point, for K_i = H_i k.
#pragma once

#include <algorithm>
#include <cstddef>

#include "abut/contact/interface.hpp"
#include "contact/enforce/side_loads.hpp"

namespace abut::contact {

/// 1/m of a node along unit `n`; 0: unknown, or it cannot move.
[[nodiscard]] inline double inverse_mass_of(const HostState& host, Index node, const Vec3& n) {
  if (host.mass.empty()) return 0.0;
  const auto i = static_cast<std::size_t>(node);
  if (host.constrained.empty() || host.constrained[i] == no_index) return host.mass[i] > 0.0 ? 1.0 / host.mass[i] : 0.0;
  // Below zero: the other springs of its body press this node in.
  return std::max(0.0, dot(n, host.mobility[static_cast<std::size_t>(host.constrained[i])] * n));
}

/// Springs that act on the motion of a pair together with its own, and push in proportion to their stiffness: what they do to a node counts
/// as the pair's.
struct Springs {
  static constexpr double no_limit = 1e30;
  double passes = 1.0;     ///< as strong as the pair's, where no more is known
  double stiffness = 0.0;  ///< that the pair has told the host of, beside which a body's springs are seen; 0: one spring alone
  double own = 0.0;        ///< its kappa phi'', beside which those of this interface are seen

  /// Springs on a node in the last step, over the pair's; 0: not known.
  /// @param at_most  of this interface: on the corners of a facet not all switch together with the pair
  [[nodiscard]] double on(const HostState& host, Index node, const SideLoads& loads, Index s, double at_most) const {
    if (stiffness <= 0.0) return 0.0;
    const Index entry = host.constrained.empty() ? no_index : host.constrained[static_cast<std::size_t>(node)];
    const double of_body = entry == no_index ? 0.0 : host.mobility[static_cast<std::size_t>(entry)].stiffness;
    if (of_body > 0.0) return of_body / stiffness;
    return own > 0.0 ? std::min(static_cast<double>(loads.springs_before[static_cast<std::size_t>(s)]) / own, at_most) : 0.0;
  }
  /// w^2 times their number, for a node that the pair moves with weight +-w.
  /// @param known   as on() has it
  /// @param spread  sum of all w of the facet: 1, or more where the node is beside it and some corners are pulled
  [[nodiscard]] double over(double known, double w, double spread) const {
    return known > 0.0 ? w * std::max(w, known) / spread : passes * w * w;
  }
};

/// Mass of a node that is free or cannot move at all (0); below zero: neither, its mobility must be asked.
[[nodiscard]] inline double plain_mass(const HostState& host, Index node) {
  const auto i = static_cast<std::size_t>(node);
  if (host.constrained.empty() || host.constrained[i] == no_index) return host.mass[i];
  return host.mobility[static_cast<std::size_t>(host.constrained[i])].immobile() ? 0.0 : -1.0;
}

}  // namespace abut::contact
