// /SECT: resultants of the internal forces that a set of elements puts on a set of nodes (deck-format.md F.2).
//
//   F = sum over listed elements, over their nodes I that are nodes of the section, of the element's force on I
//   M = sum of (x_I - c) x f_I + m_I, c = node 1 (Iframe 0, 10), geometric centre of the section's nodes (1, 11), their
//       centre of gravity (2, 12), global origin (3, 13)
// An element's slot holds what is subtracted from the nodal force, so f_I = -slot: a bar in tension pulls its section's nodes.
// Axes: x' = node 1 -> node 2, z' = x' x (node 1 -> node 3), y' = z' x x'. The section's plane is (x', y'): F_n = (F . z') z',
// F_t = F - F_n. Iframe >= 10: moments along global axes instead.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "constraints/axes.hpp"
#include "elements/group.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

/// normal and tangential force: global axes. moment: components along the section's axes (Iframe 0 to 3) or global (10 to 13).
struct SectionSums {
  Vec3 normal_force, tangential_force, moment;
  Vec3 normal_impulse, tangential_impulse, moment_impulse;
};

class Sections {
 public:
  /// @param groups the run's element groups, with their slot offsets set
  Sections(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups);

  /// Step 11: resultants of this cycle from element slots.
  void gather(const state::State& state, std::span<const double> slots);
  void book_impulses(double h);  ///< of this cycle's resultants, once its step is known

  void persist(state::Archive& a);

  [[nodiscard]] std::span<const SectionSums> results() const { return sums_; }  ///< per model section
  [[nodiscard]] Vec3 global_moment(Index section) const;                        ///< along global axes, whatever Iframe
  [[nodiscard]] const Frame& frame(Index section) const { return sections_[static_cast<std::size_t>(section)].frame; }

 private:
  struct Entry {
    Index node;
    std::size_t slot;
    bool moment;
  };  ///< one node of one element; component c at slot + 8 c
  struct Section {
    std::vector<Entry> entries;
    Frame frame;
  };
  const model::Model* model_;
  std::vector<Section> sections_;
  std::vector<SectionSums> sums_;
};

}  // namespace abut::constraints
