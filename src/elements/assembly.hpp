// Sum of element slots per node in the order of element ids: deterministic without atomics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "elements/group.hpp"
#include "parallel/thread_pool.hpp"

namespace abut::elements {

/// Nodal sums of one assembly, #N (by 3).
struct NodalSums {
  std::span<Vec3> force;  ///< internal force
  std::span<Vec3> moment;
  std::span<double> stiffness;
  std::span<double> rotational_stiffness;
};

/// For every node the list of slots that belong to it, shells (4-node, then 3-node) before solids (bricks, then
/// tetrahedra), each by element id: the order of every sum, whatever the deck's listing order or the threads.
class Assembly {
 public:
  /// Sets the slot offset of every group. `groups` must outlive the assembly's use.
  Assembly(Index node_count, const model::Model& model, std::span<const std::unique_ptr<Group>> groups);

  /// Doubles that all groups' slots take together.
  [[nodiscard]] std::size_t slot_count() const { return slot_count_; }

  /// Overwrites `sums` with the sums of components fx fy fz K (and mx my mz Kr of shells).
  void sum(std::span<const double> slots, const NodalSums& sums, parallel::ThreadPool& pool) const;

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
