// Unit codes of the deck format (deck-format.md A.8).
#pragma once

#include <optional>
#include <string_view>

namespace abut::model {

/// Size in SI (kg, m, s) of a unit given as a number ("0.001") or as a prefix and `base` ('g', 'm', 's': "Mg", "mm", "mus").
/// nullopt: neither, or not positive.
[[nodiscard]] std::optional<double> unit_size(std::string_view code, char base);

}  // namespace abut::model
