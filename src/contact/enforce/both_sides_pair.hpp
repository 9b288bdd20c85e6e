// One node against one facet that repels on both sides (TYPE7): geometry and force law as pure functions.
//
// Equation contract: numerics.md 7.7.2 to 7.7.4 (Radioss Theory Manual, interface TYPE7).
//   The facet is cut into the triangles (c, x_i, x_i+1), c the mean of its corners (a triangle is one piece). With d_i the
//   distance to the closest point of piece i and p_i = max(0, g - d_i):
//     p = max p_i,   n ~ sum p_i (x_s - c_i)/d_i,   H_k ~ p_k l^k_k + p_(k-1) l^(k-1)_k + 1/4 sum p_i l^i_0,  sum H = 1.
// Where we differ: with `all_pieces` false (abut's own rule) n and H are those of the nearest piece alone, so that the force is minus the
// gradient of E; the sums above tilt n wherever two pieces are within reach, also on a flat facet, and sliding then makes energy.
//   Normal force   f_n = K0 g/(g - p) p,   stored energy  E = K0 g^2 [-p/g - ln(1 - p/g)].
//   Damping        C^2 = 2 K0 g/(g - p) m_s, closing: times g/(g - p);  c_d = VIS_s C + 0.32 m_s <-v_n>/(g - p).
// Symbols: g gap, p penetration, K0 stiffness, m_s mass of the node, v_n normal velocity of the node relative to the facet.
#pragma once

#include <array>

#include "abut/vec3.hpp"

namespace abut::contact {

/// Where and how deep a node is in the gap of a facet.
struct BothSidesContact {
  double distance = 1e300;         ///< of the node from the facet's nearest point
  double penetration = 0.0;        ///< p; 0: out of reach
  Vec3 normal;                     ///< unit, from the facet to the node
  Vec3 away;                       ///< unit, from the facet's nearest point to the node
  std::array<double, 4> weight{};  ///< H_k of the corners (0 for the fourth of a triangle)
};

/// @param corners  4 positions; the fourth is unused for a triangle
[[nodiscard]] BothSidesContact both_sides_contact(const Vec3& node, const std::array<Vec3, 4>& corners, bool triangle, double gap,
                                                  bool all_pieces);

/// Weights of a quadrilateral freed of its hourglass mode (7.7.2, last paragraph but one); unchanged for triangles.
[[nodiscard]] std::array<double, 4> without_hourglass(std::array<double, 4> weight);

/// Normal force and what goes with it.
struct BothSidesForce {
  double elastic = 0.0;   ///< f_n
  double energy = 0.0;    ///< E
  double damping = 0.0;   ///< c_d
  double critical = 0.0;  ///< C, for the viscous friction limit
  double tangent = 0.0;   ///< K0 (g/(g - p))^2
};

/// @pre 0 < p < g
[[nodiscard]] BothSidesForce both_sides_force(double k0, double gap, double penetration, double mass, double normal_velocity, double vis_s);

}  // namespace abut::contact
