#include "deck/deck.hpp"

#include <fmt/format.h>

#include <utility>

#include "deck/scanner.hpp"
#include "deck/text.hpp"

namespace abut::deck {

namespace fs = std::filesystem;

namespace {

/// NAME_0001.rad beside NAME_0000.rad, NAMED01 beside NAMED00; empty when the name follows neither rule.
fs::path engine_path(const fs::path& starter, int run) {
  const std::string stem = starter.stem().string();
  const std::string extension = starter.extension().string();
  if (stem.size() > 5 && stem.ends_with("_0000")) {
    return starter.parent_path() / fmt::format("{}{:04}{}", stem.substr(0, stem.size() - 4), run, extension);
  }
  if (stem.size() > 3 && stem.ends_with("D00") && run <= 99) {
    return starter.parent_path() / fmt::format("{}{:02}{}", stem.substr(0, stem.size() - 2), run, extension);
  }
  return {};
}

/// The Starter deck that a user means who names something else: the one beside an Engine deck, or a name without _0000.rad; empty: none.
fs::path meant_starter(const fs::path& named) {
  std::error_code error;
  const std::string stem = named.stem().string();
  const std::size_t mark = stem.size() < 5 ? std::string::npos : stem.size() - 5;
  if (mark != std::string::npos && stem[mark] == '_' && stem.find_first_not_of("0123456789", mark + 1) == std::string::npos) {
    const fs::path starter = named.parent_path() / (stem.substr(0, mark) + "_0000" + named.extension().string());
    if (starter != named && fs::exists(starter, error)) return starter;
  }
  const fs::path longer = named.string() + "_0000.rad";
  return fs::exists(longer, error) ? longer : fs::path{};
}

/// Reads the Engine deck of a run into `deck`; false when there is none.
bool read_engine(const fs::path& starter, int run, Deck& deck, Diagnostics& diagnostics) {
  std::error_code error;
  const fs::path path = engine_path(starter, run);
  if (path.empty() || !fs::exists(path, error)) return false;
  Place place;
  place.file = printable(path.string());
  std::string text;
  if (!read_file(path, text)) {
    diagnostics.error("deck.file", place, "the Engine deck cannot be read");
    return false;
  }
  scan_engine(deck, diagnostics, std::move(text), place.file);
  return true;
}

/// Warns of Engine decks that no run reaches, because the one after run `last` is missing.
void check_later_runs(const fs::path& starter, int last, Diagnostics& diagnostics) {
  constexpr int looked_at = 100;
  std::error_code error;
  for (int run = last + 2; run <= last + looked_at; ++run) {
    const fs::path later = engine_path(starter, run);
    if (later.empty() || !fs::exists(later, error)) continue;
    Place place;
    place.file = printable(later.string());
    diagnostics.warning("deck.missing_run", std::move(place),
                        fmt::format("this Engine deck is not read: that of run {} before it, '{}', is missing", last + 1,
                                    printable(engine_path(starter, last + 1).filename().string())));
    return;
  }
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
  const fs::path meant = meant_starter(starter);
  const std::string hint = meant.empty() ? "" : fmt::format("; there is '{}'", printable(meant.string()));
  if (!read_file(starter, text)) {
    diagnostics.error("deck.file", place, "cannot be read: the path of a Starter deck NAME_0000.rad is needed" + hint);
    return pair;
  }
  if (!meant.empty()) {
    diagnostics.error("deck.file", place, "this is an Engine deck: name the Starter deck, the Engine deck is taken along" + hint);
    return pair;
  }
  const std::size_t start = starter_offset(text);
  if (start > 0) {
    scan_engine(pair.engine, diagnostics, text.substr(0, start), place.file);
    pair.has_engine = true;
  }
  StarterScanner scanner(pair.starter, diagnostics, starter);
  scanner.scan_main(std::move(text), place.file, start);
  if (pair.has_engine) {
    std::error_code error;
    const fs::path beside = engine_path(starter, 1);
    if (!beside.empty() && fs::exists(beside, error)) {
      diagnostics.warning("deck.two_engines", place,
                          fmt::format("the Engine part at the head of this file counts; '{}' beside it is not read, take one of them away",
                                      printable(beside.filename().string())));
    }
  } else {
    pair.has_engine = read_engine(starter, 1, pair.engine, diagnostics);
  }
  for (int run = 2; pair.has_engine; ++run) {
    Deck next;
    if (!read_engine(starter, run, next, diagnostics)) break;
    pair.restarts.push_back(std::move(next));
  }
  check_later_runs(starter, static_cast<int>(pair.restarts.size()) + (pair.has_engine ? 1 : 0), diagnostics);
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
