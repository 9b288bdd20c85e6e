// Text -> blocks of cards with file and line; no meaning yet.
//
// A Deck owns the text of all its files; blocks and cards are views into it. What a keyword means, which columns a field
// takes and in which unit is decided in model/.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "abut/types.hpp"
#include "core/diagnostic.hpp"

namespace abut::deck {

/// One data line of a block, as typed (trailing CR removed; not trimmed).
struct Card {
  std::string_view text;
  std::int32_t file = 0;  ///< index into Deck::files
  std::int32_t line = 0;  ///< 1-based
};

/// One keyword line and the data lines below it.
struct Block {
  std::string_view keyword_line;        ///< as typed
  std::vector<std::string_view> words;  ///< "/INTER/TYPE3/1/7" -> {"INTER", "TYPE3", "1", "7"}, blanks stripped
  std::int32_t file = 0;
  std::int32_t line = 0;
  /// Data lines including title cards and blank lines inside the block; comments and blank lines at the end removed.
  std::vector<Card> cards;

  /// words[i], or an empty view.
  [[nodiscard]] std::string_view word(std::size_t i) const { return i < words.size() ? words[i] : std::string_view{}; }
  /// Whether word i is `upper_case`, in any case.
  [[nodiscard]] bool is(std::size_t i, std::string_view upper_case) const;
  /// The keyword without surplus blanks and slashes: "/INTER/TYPE3/1".
  [[nodiscard]] std::string name() const;
};

/// A Starter or an Engine deck.
struct Deck {
  std::vector<std::string> files;  ///< names as they are shown in messages
  std::deque<std::string> texts;   ///< text of each file (kept alive for the views)
  std::string header;              ///< the "#RADIOSS STARTER ..." line, if any
  std::vector<Block> blocks;
  std::vector<Block> inner_begins;  ///< /BEGIN of included files: not among the blocks, the one of the deck rules (A.8)

  [[nodiscard]] Place place(const Block& block) const;
  [[nodiscard]] Place place(const Block& block, const Card& card) const;
};

/// Starter deck and Engine decks; the first Engine deck is found beside the Starter deck or inside a one-file deck.
struct DeckPair {
  Deck starter;
  Deck engine;
  bool has_engine = false;
  std::deque<Deck> restarts;  ///< of runs 2, 3, ...: each continues the one before (a deque: decks are not copied, views stay valid)
};

/// Reads NAME_0000.rad with its includes and NAME_0001.rad, NAME_0002.rad, ... beside it (deck-format.md A).
/// Findings (missing include, unreadable file, ...) are added to `diagnostics`; nothing is thrown for bad input.
[[nodiscard]] DeckPair read(const std::filesystem::path& starter, Diagnostics& diagnostics);

/// Same, from text in memory (fuzzing, Python). `#include` is an error here.
[[nodiscard]] Deck read_starter_text(std::string text, std::string name, Diagnostics& diagnostics);
[[nodiscard]] Deck read_engine_text(std::string text, std::string name, Diagnostics& diagnostics);

}  // namespace abut::deck
