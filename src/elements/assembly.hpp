// Sum of the chunks' forces per node, in a fixed order: deterministic without atomics.
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

/// For every node the list of chunk sums that belong to it: shells before solids, each by group, then by chunk.
class Assembly {
 public:
  /// Sets the offsets of every group. `groups` must outlive the assembly's use.
  Assembly(Index node_count, std::span<const std::unique_ptr<Group>> groups);

  /// Doubles that all groups' chunk sums take together.
  [[nodiscard]] std::size_t sum_count() const { return sum_count_; }
  /// Doubles that all groups' slots take together.
  [[nodiscard]] std::size_t slot_count() const { return slot_count_; }

  /// For every node where its sums begin: those of shells (8 components) or of solids (4).
  struct Entries {
    static constexpr std::uint32_t padding = 24;
    std::vector<std::uint32_t> first;  ///< #N + 1; empty: there are none
    std::vector<std::uint32_t> at;     ///< component 0 of the entry; `padding` more at the end
    [[nodiscard]] std::uint32_t begin(std::size_t i) const { return first.empty() ? 0 : first[i]; }
  };
  [[nodiscard]] const Entries& shells() const { return shells_; }
  [[nodiscard]] const Entries& solids() const { return solids_; }

  /// Totals at node i. @param sums as long as sum_count()
  [[nodiscard]] NodalSum total(const double* sums, std::size_t i) const {
    NodalSum n;
    for (std::uint32_t j = shells_.begin(i); j < shells_.begin(i + 1); ++j) {
      const double* p = sums + shells_.at[j];
      n.force += Vec3{p[0], p[1], p[2]};
      n.stiffness += p[3];
      n.moment += Vec3{p[4], p[5], p[6]};
      n.rotational_stiffness += p[7];
    }
    for (std::uint32_t j = solids_.begin(i); j < solids_.begin(i + 1); ++j) {
      const double* p = sums + solids_.at[j];
      n.force += Vec3{p[0], p[1], p[2]};
      n.stiffness += p[3];
    }
    return n;
  }

 private:
  std::size_t sum_count_ = 0, slot_count_ = 0;
  Entries shells_, solids_;
};

}  // namespace abut::elements
