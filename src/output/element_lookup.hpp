// Where an element of the model's tables lives among the groups of a run.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "elements/group.hpp"
#include "model/model.hpp"

namespace abut::output {

/// Position of an element: group in the run's list, element in the group. Both no_index for an element that no group
/// computes.
struct ElementPlace {
  Index group = no_index;
  Index element = no_index;
  [[nodiscard]] bool exists() const { return group != no_index; }
};

/// Tables from the model's element index to its place; built once, valid as long as the groups keep their order.
class ElementLookup {
 public:
  ElementLookup() = default;
  ElementLookup(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups);
  [[nodiscard]] ElementPlace find(model::ElementKind kind, Index index) const;

 private:
  std::array<std::vector<ElementPlace>, 4> places_;  ///< by kind: shell4, shell3, brick, tetra
};

/// Initial mass of each part, summed over its groups in their order.
[[nodiscard]] std::vector<double> part_masses(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups);

}  // namespace abut::output
