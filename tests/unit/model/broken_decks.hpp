// Broken decks: the base deck of deck_text.hpp with one line changed, and every finding that this must give, word for word.
#pragma once

#include <string>
#include <vector>

namespace abut::model::base_deck {

enum class Changed { starter, engine };

struct BrokenDeck {
  const char* name;
  Changed deck;
  const char* keyword;  ///< keyword line below which ...
  int offset;           ///< ... this many lines the line stands that ...
  const char* text;     ///< ... becomes this text (one line or several)
  std::vector<std::string> findings;
};

[[nodiscard]] std::vector<BrokenDeck> broken_meshes_and_sets();
[[nodiscard]] std::vector<BrokenDeck> broken_conditions();
[[nodiscard]] std::vector<BrokenDeck> broken_interfaces();
[[nodiscard]] std::vector<BrokenDeck> broken_outputs_and_engines();

}  // namespace abut::model::base_deck
