// Held nodes in the ordinary case, some at a time: what Pass::measure_closest, pair_force, finish_node and rub_by_return_mapping do for a
// node that stays over the quadrilateral that held it in the last step, in one go over a number type.
//
//   projection   Newton on |x - X(s,t)|^2 from (0, 0), A ds = -grad, A_ab = X_a.X_b - r.X_ab; from outside, along the sides
//                (closest_point.hpp)
//   normal       n that of the facet, in front of an edge or a corner r/|r|; d = n.r, P = gap - d
//                kappa = s K1(xi) K2/(K1 + K2), phi of law.hpp                                        (pair.hpp)
//                f = kappa phi' n - c^a X_a,  f_i = -H_i f - c^a H_i,a r,  c^a = phi A^-1_ab dkappa/dxi_b
//   friction     trial e + dg, e' = min(1, L/(k_t |e + dg|)) (e + dg), e in the facet's frame       (friction.hpp)
//   its couple   -c^a H_i,a r,  c^a = g^-1_ab F.X_b                                                  (friction_couple())
//
// On a facet, and over the flat part of the strips at its free borders, the taper is 1 and its gradient 0, so strips do not appear. A lane
// is `ordinary` when all that the formulas above leave out is absent: one minimum only, not further out, not behind an edge, 0 < P, P below
// the bend of the law, no first or last force (switching.hpp). That is a matter of positions, speeds and history alone: which nodes share a
// register, and how old search lists are, never shows in a result. All other nodes go the general way.
#pragma once

#include <cstddef>
#include <cstdint>

namespace abut::contact {

/// h^2 K/m of a pair, once in its contact, from which on its account is settled.
inline constexpr double light_pair = 0.1;
/// Cosine of the angle (1.8 degrees) from which on a normal that turns in a step counts as one that passes over a fold.
inline constexpr double turns = 0.9995;
/// The coming step may be longer than the last one.
inline constexpr double step_growth = 1.2;

/// What is the same for all nodes of a pass.
struct HeldRules {
  double gap = 0.0;               ///< of the law and of the search
  double stiffness_scale = 0.0;   ///< s
  double tangential_ratio = 0.0;  ///< K_t/K_n
  double friction = 0.0;          ///< mu
  double step_factor = 1.0;       ///< sqrt(1 + mu^2): share of friction in the stiffness for the step
  double step = 0.0;              ///< h of the last step, > 0
  double mean_step = 0.0;         ///< the one between the last two forces; 0: unknown
  double step_before = 0.0;       ///< the step before that
  double smallest = 0.0;          ///< length: least penetration that the stiffness for the step is taken at
  double pairs = 1.0;             ///< passes: springs that act on the same motion
  bool stiffens = false, rubs = false, corrects_switching = false;
};

/// Nodes that are computed together; each array has one value per node. Offsets are three times an index.
struct HeldBatch {
  static constexpr int size = 32;
  int count = 0;  ///< rounded up to a multiple of the register's width before the kernel runs

  const double *held_x = nullptr, *surface_x = nullptr;  ///< #held, #surface by 3
  const double* v = nullptr;                             ///< #N by 3, the host's

  // In.
  std::int32_t node[size], node_v[size], corner[4][size], corner_v[4][size];
  double mass[5][size];              ///< of the corners, of the node; 0: infinite
  double springs[5][size];           ///< on the corners, on the node, in the last step, over the pair's own; 0: not known
  double corner_stiffness[4][size];  ///< K1 at the corners
  double node_stiffness[size];       ///< K2
  double reach[size];                ///< the facet with its strips extends to |s|, |t| = sqrt(reach)
  double end[4][size];               ///< |t|, |s| at sides 0 to 3, up to where taper is 1: 1 at an edge, the end of a strip's flat part
  double rate_before[size], acceleration_before[size], normal_before[3][size];
  double anchor[4][size];  ///< weights of the last contact point
  // Account (account.hpp): the push of the last step, the contact point it acted at, what it held, what was made; 1 where it counts.
  double push_before[3][size], last[4][size], force_before[size], stored_before[size], made_before[size], reckoned[size];
  double slip_before[3][size], slip_normal_before[3][size], tangential_stiffness_before[size];

  // Out.
  double ordinary[size];  ///< 1, or 0: nothing else is valid
  double squared_distance[size], distance[size], penetration[size];
  double normal[3][size], weight[4][size];
  double force[size];  ///< |normal force|
  double on_node[3][size], on_corner[4][3][size];
  double potential[size], stiffness[size], step_stiffness[size], spring[size];
  double rate[size], acceleration[size];
  double approach[size], kinematic_step[size];
  double slip[3][size], slip_normal[3][size], tangential_stiffness[size];
  double on_surface[3][size];        ///< friction
  double couple_stiffness[5][size];  ///< that its couple asks for, at the corners and the node (friction_couple())
  double stick[size], dissipated[size], slips[size];
  double made[size], stepped[size], light[size];
};

using HeldKernel = void (*)(const HeldRules&, HeldBatch&);

/// That of the active instruction set.
[[nodiscard]] HeldKernel held_kernel();

}  // namespace abut::contact
