// Sum of element slots per node in the order of element ids: deterministic without atomics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "elements/group.hpp"

namespace abut::elements {

/// Sums of one node.
struct NodalSum {
  Vec3 force, moment;  ///< internal
  double stiffness = 0.0, rotational_stiffness = 0.0;
};

/// For every node the list of slots that belong to it, shells (4-node, then 3-node) before solids (bricks, then
/// tetrahedra), each by element id: the order of every sum, whatever the deck's listing order or the threads.
class Assembly {
 public:
  /// Sets the slot offset of every group. `groups` must outlive the assembly's use.
  Assembly(Index node_count, const model::Model& model, std::span<const std::unique_ptr<Group>> groups);

  /// Doubles that all groups' slots take together.
  [[nodiscard]] std::size_t slot_count() const { return slot_count_; }

  /// Sums of components fx fy fz K (and mx my mz Kr of shells) at node i. @param slots as long as slot_count()
  [[nodiscard]] NodalSum sum(const double* slots, std::size_t i) const {
    NodalSum n;
    for (std::uint32_t j = shells_.first[i]; j < shells_.first[i + 1]; ++j) {
      const double* p = slots + shells_.slot[j];
      n.force += Vec3{p[0], p[lanes], p[2 * lanes]};
      n.stiffness += p[3 * lanes];
      n.moment += Vec3{p[4 * lanes], p[5 * lanes], p[6 * lanes]};
      n.rotational_stiffness += p[7 * lanes];
    }
    for (std::uint32_t j = solids_.first[i]; j < solids_.first[i + 1]; ++j) {
      const double* p = slots + solids_.slot[j];
      n.force += Vec3{p[0], p[lanes], p[2 * lanes]};
      n.stiffness += p[3 * lanes];
    }
    return n;
  }

  /// Sums of component 0 (mass) and 1 (inertia) after Group::initial_masses.
  void sum_masses(std::span<const double> slots, std::span<double> mass, std::span<double> inertia) const;

 private:
  struct Entries {
    std::vector<std::uint32_t> first;  ///< #N + 1
    std::vector<std::uint32_t> slot;   ///< component 0 of the entry
  };
  std::size_t slot_count_ = 0;
  Entries shells_, solids_;
};

}  // namespace abut::elements
