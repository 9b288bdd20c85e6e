// A small correct deck as text, and what tests do with it: change a line, build, look at the findings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "model/build.hpp"

namespace abut::model::base_deck {

/// Two bricks one above the other, a plate and a cover plate; every kind of condition, one interface of each type (units kg, mm, ms).
extern const char* const base_starter;
extern const char* const base_engine;

/// `deck` with the line `offset` lines below the keyword line replaced (0: the keyword line itself). Throws when there is no such keyword.
[[nodiscard]] std::string with_line(const std::string& deck, std::string_view keyword, int offset, std::string_view text);

struct Built {
  Model model;
  Diagnostics diagnostics;
  [[nodiscard]] std::vector<std::string> messages() const;  ///< to_string of every finding
  [[nodiscard]] bool has(std::string_view part) const;      ///< some message contains `part`
};
/// Builds from text; the decks are called deck_0000.rad and deck_0001.rad, those of `later` runs deck_0002.rad and so on.
[[nodiscard]] Built build_text(const std::string& starter, const std::string& engine = base_engine,
                               const std::vector<std::string>& later = {});
/// The base deck with one line of the Starter deck replaced.
[[nodiscard]] Built build_changed(std::string_view keyword, int offset, std::string_view text);

/// Fields of 10 and 20 columns, right-aligned.
[[nodiscard]] std::string integers(const std::vector<std::string>& fields);
[[nodiscard]] std::string reals(const std::vector<std::string>& fields);

}  // namespace abut::model::base_deck
