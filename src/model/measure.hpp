// Sizes and masses of elements in their initial position (numerics.md 1.4, 4.1): for shares of added mass, checks and the summary.
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"

namespace abut::model {

/// Area vector of a face, A n = (x3 - x1) x (x4 - x2) / 2; a triangle repeats its third node.
[[nodiscard]] Vec3 face_area(const Model& model, const std::array<Index, 4>& nodes);

/// Thickness of a shell: the element's own, else the property's. 0 when it has neither.
[[nodiscard]] double shell_thickness(const Model& model, Index part, double element_thickness);
/// Thickness that the property of a part gives; 0 for solids.
[[nodiscard]] double property_thickness(const Model& model, Index part);

[[nodiscard]] double part_density(const Model& model, Index part);
[[nodiscard]] double part_young(const Model& model, Index part);

[[nodiscard]] double shell_mass(const Model& model, Index shell);
[[nodiscard]] double sh3n_mass(const Model& model, Index sh3n);
[[nodiscard]] double brick_volume(const Model& model, Index brick);  ///< one-point volume, its sign kept
[[nodiscard]] double brick_mass(const Model& model, Index brick);
[[nodiscard]] double tetra_volume(const Model& model, Index tetra);  ///< positive when n1 n2 n3 turns away from n4
[[nodiscard]] double tetra_mass(const Model& model, Index tetra);

[[nodiscard]] std::vector<double> part_masses(const Model& model);

/// #N: masses from the elements, shared equally by an element's nodes, plus added masses.
[[nodiscard]] std::vector<double> nodal_masses(const Model& model);

/// Calls f(nodes, part, mass) for every element; `nodes` is a span of node indices.
template <class F>
void for_each_element(const Model& m, F&& f) {
  for (Index i = 0; i < m.shells.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    f(std::span<const Index>(m.shells.nodes[k]), m.shells.part[k], shell_mass(m, i));
  }
  for (Index i = 0; i < m.sh3ns.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    f(std::span<const Index>(m.sh3ns.nodes[k]), m.sh3ns.part[k], sh3n_mass(m, i));
  }
  for (Index i = 0; i < m.bricks.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    f(std::span<const Index>(m.bricks.nodes[k]), m.bricks.part[k], brick_mass(m, i));
  }
  for (Index i = 0; i < m.tetras.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    f(std::span<const Index>(m.tetras.nodes[k]), m.tetras.part[k], tetra_mass(m, i));
  }
}

}  // namespace abut::model
