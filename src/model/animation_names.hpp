// Names of the animation's fields behind /ANIM cards (deck-format.md G.3).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/deck.hpp"

namespace abut::model {

/// What an /ANIM block asks for, in one of its spellings (deck-format.md A.3), upper case: "SHELL/TENS/STRESS/UPPER".
[[nodiscard]] std::string animation_selection(const deck::Block& block);

/// A selection without its type of element: "SHELL/EPSP" and "BRICK/EPSP" ask for the same field as "ELEM/EPSP"; "BRICK/TENS/STRESS" as
/// "TENS/STRESS".
[[nodiscard]] std::string plain_animation_name(std::string_view selection);

/// Plain names for what every state has.
[[nodiscard]] const std::vector<std::string>& animation_names_of_every_state();
/// Plain names for what is written on request. "TENS/STRESS/1", "2", ... (integration points of shells) are some too.
[[nodiscard]] const std::vector<std::string>& animation_names_on_request();
/// Both.
[[nodiscard]] std::vector<std::string> animation_names();

/// The integration point n >= 1 of "TENS/STRESS/n"; 0: it is not one.
[[nodiscard]] int animation_layer(std::string_view plain_name);

/// Whether abut computes what a selection asks for.
[[nodiscard]] bool has_animation_field(std::string_view selection);

}  // namespace abut::model
