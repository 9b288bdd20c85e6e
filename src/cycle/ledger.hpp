// Sums over the nodes of one cycle: the kinetic terms of the balance and the ledger of discrete works.
//
// LEDGER is a test of the code: in leap-frog the kinetic energy T* = m v(n-1/2).v(n+1/2)/2 changes by the discrete works of
// all forces and constraints exactly (constraints/work_meter.hpp derives the bookings), so what is left over is rounding.
// ERR is a test of the physics: every energy is computed on its own from what it is a potential or a dissipation of.
#pragma once

#include <vector>

#include "constraints/work_meter.hpp"
#include "parallel/thread_pool.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Kinetic sums of one cycle at t^n.
struct KineticSums {
  double translation = 0.0, rotation = 0.0, mass = 0.0;
  Vec3 momentum;
  KineticSums& operator+=(const KineticSums& b);
};

class Ledger {
 public:
  /// Sums over all nodes in a fixed order: momentum and energies of v(n) = v(n-1/2) + h-/2 a(n) (numerics.md 1.6.2), or
  /// energies in the product form v(n-1/2).v(n+1/2).
  [[nodiscard]] KineticSums kinetic(const state::State& s, bool product_form, parallel::ThreadPool& pool);

  /// Before the first cycle: T* of the start.
  void open(double kinetic) { start_ = kinetic; }

  /// Closes the cycle, everything final. @param kinetic T* of the structure. @param constraint_work bookings of loads and
  /// constraints. @return T* minus its start minus all works so far: zero to rounding
  double close(const state::State& s, double kinetic, double constraint_work);

 private:
  std::vector<KineticSums> leaves_;
  constraints::ForceWork elements_, contact_;
  double works_ = 0.0;
  double start_ = 0.0;
};

}  // namespace abut::cycle
