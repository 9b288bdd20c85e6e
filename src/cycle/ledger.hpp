// Two balances of energy (docs/theory/cycle.md).
//
// LEDGER, a test of the code: in leap-frog, with h~ = (h- + h+)/2 and every force f that acts on node I,
//   m v(n-1/2).v(n+1/2)/2  -  m v(n-3/2).v(n-1/2)/2  =  v(n-1/2) . (h~(n) f(n) + h~(n-1) f(n-1)) / 2
// exactly, for any sequence of steps. Discrete works are accumulated in that form per family of forces (elements,
// interfaces, loads, constraints); with that kinetic energy they add up to rounding.
//
// ERR, a test of the physics: every energy is computed on its own from what it is a potential or a dissipation of.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/thread_pool.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Kinetic sums of one cycle (numerics.md 1.6.2): v(n) = v(n-1/2) + h-/2 a(n).
struct KineticSums {
  double translation = 0.0, rotation = 0.0, mass = 0.0;
  Vec3 momentum;
  KineticSums& operator+=(const KineticSums& b);
};

/// Discrete works of one cycle by family of forces.
struct Works {
  double kinetic = 0.0;      ///< product form of the kinetic energy (not a work)
  double elements = 0.0, contact = 0.0, loads = 0.0, constraints = 0.0;
  Works& operator+=(const Works& b);
};

class Ledger {
 public:
  /// @param counted #N: 0 for the main nodes of rigid bodies, whose mass is already in their secondary nodes
  explicit Ledger(std::vector<std::uint8_t> counted);

  /// Kinetic sums over all nodes, in a fixed order.
  [[nodiscard]] KineticSums kinetic(const state::State& s, parallel::ThreadPool& pool);

  /// Before anything changes velocities in this cycle: remembers them.
  void enter(const state::State& s);

  /// After all constraints of cycle n and before the integration: adds this cycle's works.
  /// @return kinetic energy (product form) minus all works and minus its first value: zero to rounding
  double close(const state::State& s, parallel::ThreadPool& pool);

  /// Works since the start.
  [[nodiscard]] const Works& works() const { return works_; }

 private:
  /// Impulses h~ f of the previous cycle at one node.
  struct Impulses {
    Vec3 elements, contact, loads, rest;
    Vec3 angular_elements, angular_loads, angular_rest;
  };
  std::vector<std::uint8_t> counted_;
  std::vector<Vec3> v_entry_, w_entry_;
  std::vector<Impulses> previous_;
  std::vector<KineticSums> kinetic_leaves_;
  std::vector<Works> work_leaves_;
  Works works_;
  double start_ = 0.0;
};

}  // namespace abut::cycle
