// From the model's property and law to the constants of a shell group.
#pragma once

#include <optional>

#include "elements/group.hpp"
#include "elements/shell_common/section.hpp"

namespace abut::elements {

/// Thickness points: positions, weights and moment weights (numerics.md 3.4). 1 <= points <= 10.
void set_thickness_points(ShellSection& section, int points);

/// The section of a group with LAW1 or LAW2 and a shell property; `mean_yield`: the hourglass rule needs the yield stress.
/// @return nothing for a void material or property: mass only
/// @throws std::invalid_argument for a law or property that shells do not have
[[nodiscard]] std::optional<ShellSection> make_section(const GroupInput& in, bool mean_yield);

[[nodiscard]] const model::Property& property_of(const GroupInput& in);
[[nodiscard]] const model::Material& material_of(const GroupInput& in);

}  // namespace abut::elements
