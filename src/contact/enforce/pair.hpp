// The forces of one pair as the exact gradient of its potential.
//
//   Psi = kappa phi(P),  P = gap - d,  kappa = T(xi, P) Kp(xi),  Kp = s K1 K2/(K1 + K2)   (T13)
// xi: parameters of the closest point, K1(xi) = sum H_i K_i the facet stiffness interpolated from its corners, K2 the node's own, T
// the taper of free borders. With r = x - X(xi), A_ab = X_a.X_b - r.X_ab and c^a = phi A^-1_ab dkappa/dxi_b:
//   node:           f   =  (kappa phi' + Kp phi dT/dP) n - c^a X_a
//   facet node i:   f_i = -H_i f - c^a H_i,a r
// sum f_i = -f because sum H_i,a = 0. The terms with c exist only where kappa varies; they are what makes dragging a node
// over a change of stiffness, or off a border, give back its work. On an edge xi has one free direction, at a corner none.
// A facet j that is less near than the nearest one, m, holds the node where it stores more (docs/theory/contact.md, 3): the law then acts
// at
//   P* = P - D (1 + P/delta),   D = |d_j| - |d_m|,  delta a quarter of j's length,
// so that the energy, a maximum of continuous functions, does not jump where kappa differs between two points that are equally near. Here:
// the part of j (Depth); what P* takes from d_m is added by Pass::add_strongest.
// Where A is not positive (past a centre of curvature) the closest point is not unique and c is left out.
#pragma once

#include <array>

#include "contact/enforce/law.hpp"
#include "contact/search/nearest.hpp"

namespace abut::contact {

/// Facets within this share of their length of the nearest one's distance may hold a node in its stead.
inline constexpr double stronger_within = 0.25;
/// Relative difference of energies that count as the same.
inline constexpr double equally_strong = 1e-8;

/// Points of two facets that are nearer to each other than this share of a facet's area (squares) are the same point.
inline constexpr double same_point = 1e-12;

struct PairForce {
  Vec3 on_node;
  std::array<Vec3, 4> on_facet;  ///< by corner; a triangle's fourth is zero
  double magnitude = 0.0;        ///< kappa phi'(P) = |normal force|
  double potential = 0.0;        ///< Psi
  double stiffness = 0.0;        ///< kappa
  double whole = 0.0;            ///< Kp
  double of_wider = 0.0;         ///< Kp phi dT/dP, a part of the normal force of the nearest facet
  double extra_tangent = 0.0;    ///< bound of the tangent terms beyond kappa phi''
};

/// What the energy of a pair depends on besides its contact point.
struct Depth {
  double depth = 0.0;     ///< where the law acts
  double distance = 0.0;  ///< signed, of the node to the surface: strips widen with it
  double slope = 1.0;     ///< `depth` changes by minus this per length of the pair's own distance
  bool nearest = true;    ///< `distance` is the pair's own
  double grows = 1.0;     ///< `depth` changes by this per length of gap
};

/// @param scale, node_stiffness  s and K2
/// @param widening               strips widen by this fraction of a side per unit of depth behind the facet (0: they do not)
/// @param gap_follows            the gap is half of the surface's thickness plus a constant: where thickness changes along the surface the
///                               force turns with the outer face. Else the gap is the same everywhere
/// @param half_of_facet          K = s K1 / 2 instead of the series (nodes without a stiffness of their own)
[[nodiscard]] PairForce pair_force(const Side& surface, const Measure& m, const Vec3& x, const NormalLaw& law, Depth p, double scale,
                                   double node_stiffness, bool half_of_facet, double widening, bool gap_follows = false);

/// What friction adds at the corners of its facet. Slip is the way of the closest point over the facet (friction.hpp), g = X_a.X_b; with
/// the friction force F on the surface, -F on the node and r = x - X(xi), forces that work on slip alone are
///   f_i = H_i F - c^a H_i,a r,   c^a = g^-1_ab F.X_b
/// The second term, here, is the couple that balances the moment of -F and F, which are |r| apart: half of it per pass is what friction on
/// the faces of two plates does to their middle surfaces. Along an edge one direction is free, at a corner none, and what the force has
/// beside it has no couple.
struct FrictionCouple {
  std::array<Vec3, 4> on_facet{};
  /// Share of K_t that corners and node need in the sums of stiffness beyond |H_i| (1 + sum |H|)/2, (1 + sum |H|)/2:
  /// |a_i| (1 + sum |a|)/2, |a_i|^2 = H_i^2 + r^2 g^-1_ab H_i,a H_i,b, less that.
  std::array<double, 4> corner_share{};
  double node_share = 0.0;
};
/// @param x  the node  @param on_surface  F
[[nodiscard]] FrictionCouple friction_couple(const Patch& patch, const ClosestPoint& c, const Vec3& x, const Vec3& on_surface);

}  // namespace abut::contact
