// Fixed-column fields of one card: numbers with the format's rules (blank is zero, D exponents, run-together fields).
#pragma once

#include <optional>
#include <string_view>

#include "abut/types.hpp"

namespace abut::deck {

/// Columns of a field, 1-based and inclusive, as deck-format.md states them.
struct Columns {
  int first = 0;
  int last = 0;
};

/// Text of a field without surrounding blanks (a tab counts as a blank); empty beyond the end of the card.
[[nodiscard]] std::string_view field_text(std::string_view card, Columns c);

/// Strict parsers of a trimmed field. Blank gives 0. nullopt: not a number of that kind, or out of range.
/// Reals accept D/d exponents, a missing exponent letter ("1.5-5") and integers; never inf or nan.
/// Integers accept an integral real ("3.0").
[[nodiscard]] std::optional<double> parse_real(std::string_view field);
[[nodiscard]] std::optional<Id> parse_integer(std::string_view field);

}  // namespace abut::deck
