#include "deck/deck.hpp"

#include <fmt/format.h>

#include <utility>

#include "deck/scanner.hpp"
#include "deck/text.hpp"

namespace abut::deck {

namespace fs = std::filesystem;

namespace {

/// NAME_0001.rad beside NAME_0000.rad, NAMED01 beside NAMED00; empty when the name follows neither rule.
fs::path engine_path(const fs::path& starter, char run) {
  std::string stem = starter.stem().string();
  const bool four_digits = stem.size() > 5 && stem.compare(stem.size() - 5, 5, "_0000") == 0;
  const bool two_digits = stem.size() > 3 && stem.compare(stem.size() - 3, 3, "D00") == 0;
  if (!four_digits && !two_digits) return {};
  stem.back() = run;
  return starter.parent_path() / fs::path(stem += starter.extension().string());
}

}  // namespace

bool Block::is(std::size_t i, std::string_view upper_case) const { return same_word(word(i), upper_case); }

std::string Block::name() const {
  std::string out;
  for (const std::string_view w : words) {
    out += '/';
    out += w;
  }
  return printable(std::string_view(out).substr(0, card_width));
}

Place Deck::place(const Block& block) const {
  Place p;
  p.file = files[static_cast<std::size_t>(block.file)];
  p.line = block.line;
  p.keyword = block.name();
  return p;
}

Place Deck::place(const Block& block, const Card& card) const {
  Place p = place(block);
  p.file = files[static_cast<std::size_t>(card.file)];
  p.line = card.line;
  return p;
}

DeckPair read(const fs::path& starter, Diagnostics& diagnostics) {
  DeckPair pair;
  std::string text;
  Place place;
  place.file = printable(starter.string());
  if (!read_file(starter, text)) {
    diagnostics.error("deck.file", place, "cannot be read: the path of a Starter deck NAME_0000.rad is needed");
    return pair;
  }
  const std::size_t start = starter_offset(text);
  if (start > 0) {
    scan_engine(pair.engine, diagnostics, text.substr(0, start), place.file);
    pair.has_engine = true;
  }
  StarterScanner scanner(pair.starter, diagnostics, starter);
  scanner.scan_main(std::move(text), place.file, start);
  if (pair.has_engine) return pair;

  std::error_code error;
  const fs::path engine = engine_path(starter, '1');
  if (engine.empty() || !fs::exists(engine, error)) return pair;
  Place engine_place;
  engine_place.file = printable(engine.string());
  if (!read_file(engine, text)) {
    diagnostics.error("deck.file", engine_place, "the Engine deck cannot be read");
    return pair;
  }
  scan_engine(pair.engine, diagnostics, std::move(text), engine_place.file);
  pair.has_engine = true;
  const fs::path second = engine_path(starter, '2');
  if (fs::exists(second, error)) {
    Place p;
    p.file = printable(second.string());
    diagnostics.warning("deck.restart", std::move(p), "restart decks are not run: abut runs the first Engine deck only");
  }
  return pair;
}

Deck read_starter_text(std::string text, std::string name, Diagnostics& diagnostics) {
  Deck deck;
  const std::size_t start = starter_offset(text);
  StarterScanner scanner(deck, diagnostics, {});
  scanner.scan_main(std::move(text), std::move(name), start);
  return deck;
}

Deck read_engine_text(std::string text, std::string name, Diagnostics& diagnostics) {
  Deck deck;
  scan_engine(deck, diagnostics, std::move(text), std::move(name));
  return deck;
}

}  // namespace abut::deck
