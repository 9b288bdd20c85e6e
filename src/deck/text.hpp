// Small text helpers of the deck format: lines, case, and text that is safe to print.
#pragma once

#include <string>
#include <string_view>

namespace abut::deck {

inline constexpr std::size_t card_width = 100;  ///< columns that count (A.2)

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }
[[nodiscard]] constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Without blanks and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view s);
/// Whether the columns that count hold nothing.
[[nodiscard]] bool is_blank_card(std::string_view s);
/// Equality without regard to ASCII case; `upper_case` must be upper case.
[[nodiscard]] bool same_word(std::string_view word, std::string_view upper_case);
[[nodiscard]] std::string to_upper(std::string_view s);
/// Valid UTF-8 without control characters: text that is not UTF-8 is taken for Latin-1. For messages and titles.
[[nodiscard]] std::string printable(std::string_view s);

}  // namespace abut::deck
