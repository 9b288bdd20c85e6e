// cards -> Model. The only door from the deck's text to the mechanics.
#pragma once

#include "core/diagnostic.hpp"
#include "deck/deck.hpp"
#include "model/model.hpp"

namespace abut::model {

/// Interprets and validates a deck. All faults are added to `diagnostics`; the model is usable only if it has no errors.
/// @param run  Engine decks 1 to `run` are read in this order: each changes what its cards say (deck-format.md A)
[[nodiscard]] Model build(const deck::DeckPair& deck, Diagnostics& diagnostics, int run = 1);

}  // namespace abut::model
