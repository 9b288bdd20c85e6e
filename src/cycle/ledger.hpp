// Sums over the nodes of one cycle: the kinetic terms of the balance and the ledger of discrete works.
//
// LEDGER is a test of the code: in leap-frog the kinetic energy T* = m v(n-1/2).v(n+1/2)/2 changes by the discrete works of
// all forces and constraints exactly (constraints/work_meter.hpp derives the bookings), so what is left over is rounding.
// ERR is a test of the physics: every energy is computed on its own from what it is a potential or a dissipation of.
#pragma once

#include <vector>

#include "cycle/node_kernels.hpp"
#include "parallel/thread_pool.hpp"
#include "state/state.hpp"

namespace abut::cycle {

/// Kinetic sums of one cycle at t^n.
struct KineticSums {
  double translation = 0.0, rotation = 0.0, mass = 0.0;
  Vec3 momentum;
  double leapfrog = 0.0;  ///< T* of work_meter.hpp, translation and rotation
};

class Ledger {
 public:
  /// @param rotations  false: no node has inertia or feels a moment, rotational terms are left out
  explicit Ledger(bool rotations = true) : rotations_(rotations) {}

  /// One pass over all nodes, in a fixed order, for the kinetic sums and the works of internal and contact forces. Momentum and energies
  /// of v(n) = v(n-1/2) + h-/2 a(n) (numerics.md 1.6.2), or energies in the product form v(n-1/2).v(n+1/2).
  KineticSums sum(const state::State& s, bool product_form, parallel::ThreadPool& pool);

  /// Before the first cycle: T* of the start.
  void open(double kinetic) { start_ = kinetic; }
  /// The start has this much more: velocities that were changed before the first cycle.
  void raise_start(double kinetic) { start_ += kinetic; }

  /// Energy that this cycle brought with new mass.
  void add(double work) { works_ += work; }

  /// Closes the cycle after sum(). @param kinetic T* of the structure. @param constraint_work bookings of loads and
  /// constraints. @return T* minus its start minus all works so far: zero to rounding
  double close(double kinetic, double constraint_work);

  void persist(state::Archive& a) {
    a(second_half_);
    a(works_);
    a(start_);
  }

 private:
  struct Leaf : KineticLeaf {
    Leaf& operator+=(const Leaf& b);
  };
  std::vector<Leaf> leaves_;
  bool rotations_;
  double booked_ = 0.0;       // work of this cycle, by sum()
  double second_half_ = 0.0;  // of the kick of the cycle before
  double works_ = 0.0;
  double start_ = 0.0;
};

}  // namespace abut::cycle
