// The state of a run: plain arrays over nodes, times and counters. Element and contact history live with their owners.
#pragma once

#include <cstdint>

#include "abut/results.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "state/archive.hpp"
#include "state/zero_array.hpp"

namespace abut::state {

/// Times of numerics.md 0.2: h_minus ended at t^n, h_plus begins there.
struct StepTimes {
  std::int64_t cycle = 0;
  double t = 0.0;          ///< t^n
  double h_minus = 0.0;    ///< 0 in cycle 0
  double h_plus = 0.0;     ///< known after the step is chosen
  double h_bar = 0.0;      ///< (h_minus + h_plus) / 2
  double h_bar_old = 0.0;  ///< of the previous cycle, 0 in cycle 0

  /// Whether `time` came with the step that ended now.
  [[nodiscard]] bool reached(double time) const { return t >= time && t - h_minus < time; }
};

/// Nodal arrays, all #N (by 3), index = model node index.
struct State {
  StepTimes times;
  ZeroArray<Vec3> x;                                  ///< position t^n
  ZeroArray<Vec3> u;                                  ///< displacement t^n
  ZeroArray<Vec3> v;                                  ///< velocity n - 1/2
  ZeroArray<Vec3> w;                                  ///< angular velocity n - 1/2
  ZeroArray<Vec3> a;                                  ///< acceleration t^n
  ZeroArray<Vec3> alpha;                              ///< angular acceleration t^n
  ZeroArray<Vec3> f;                                  ///< total force of the cycle
  ZeroArray<Vec3> m;                                  ///< total moment of the cycle
  ZeroArray<Vec3> f_internal, m_internal;             ///< sum of element slots (to be subtracted)
  ZeroArray<Vec3> f_external, m_external;             ///< concentrated and pressure loads
  ZeroArray<Vec3> f_contact;                          ///< all interfaces
  ZeroArray<double> mass, inertia;                    ///< current (scaling included)
  ZeroArray<double> stiffness, rotational_stiffness;  ///< nodal sums of the cycle

  /// Zero state of n nodes.
  [[nodiscard]] static State zeros(Index n);
  void persist(Archive& a);
  [[nodiscard]] Index size() const { return static_cast<Index>(mass.size()); }
};

using abut::Balance;

}  // namespace abut::state
