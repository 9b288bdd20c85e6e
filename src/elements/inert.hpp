// Elements of void material (LAW0): they carry mass and surfaces for contact, but no stress, no step and no energy.
#pragma once

#include <memory>
#include <vector>

#include "elements/group.hpp"

namespace abut::elements {

/// The elements of an inert group.
struct InertElements {
  model::ElementKind kind = model::ElementKind::none;
  int nodes_per_element = 0;
  std::vector<Index> nodes;  ///< #E by nodes_per_element
  std::vector<double> mass;  ///< #E by nodes_per_element, mass of each node slot
};

/// True when the part's material is LAW0.
[[nodiscard]] bool is_void(const GroupInput& in);
[[nodiscard]] std::unique_ptr<Group> make_inert(const GroupInput& in, InertElements elements);

}  // namespace abut::elements
