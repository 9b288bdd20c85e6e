// Names of time-history variables by kind of object (deck-format.md F.1).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"

namespace abut::model {

/// Deck word of a kind ("NODE", "SHEL" or "SHELL", ...); nullopt: a kind that abut has not.
[[nodiscard]] std::optional<ThKind> th_kind(std::string_view word);

/// Word under which results of a kind are written: NODE, PART, SHEL, SH3N, BRIC, INTER, RWALL, RBODY, SECTIO, ACCEL.
[[nodiscard]] std::string_view th_word(ThKind kind);

/// All variables of a kind, in the order in which they are written.
[[nodiscard]] const std::vector<std::string>& th_variables(ThKind kind);

/// Variables behind a deck name: a group (DEF, STRESS, ...) or the variable itself; empty: unknown.
[[nodiscard]] std::vector<std::string> th_expand(ThKind kind, std::string_view name);

}  // namespace abut::model
