#include "run/oriented_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>

#include "core/diagnostic.hpp"
#include "output/files.hpp"

namespace abut::run {

namespace {

/// Puts an integer right-aligned into columns first..first + 9 (1-based) of a card.
void put(std::string& card, std::size_t first, Id value) {
  std::string ending;
  if (!card.empty() && card.back() == '\r') {
    ending = "\r";
    card.pop_back();
  }
  if (card.size() < first + 9) card.resize(first + 9, ' ');
  card.replace(first - 1, 10, fmt::format("{:>10}", value));
  card += ending;
}

/// Line number of the n-th card (1-based) after the keyword line.
std::size_t card_line(const std::vector<std::string>& lines, std::size_t keyword, int n) {
  std::size_t line = keyword;
  while (n > 0 && ++line < lines.size()) {
    if (lines[line].empty() || (lines[line][0] != '#' && lines[line][0] != '$')) --n;
  }
  if (line >= lines.size()) throw RunError("the deck ends inside an interface");
  return line;
}

}  // namespace

void write_oriented_deck(const std::filesystem::path& starter, const std::vector<std::string>& decks, const std::filesystem::path& target,
                         const model::Model& model, const std::vector<init::TurnedSurface>& turned) {
  for (const std::string& deck : decks) {
    std::error_code unequal;
    if (std::filesystem::equivalent(deck, target, unequal)) {
      throw RunError(fmt::format("--write-deck would overwrite the deck it reads, {}: name another file", deck));
    }
  }
  std::ifstream in(starter, std::ios::binary);
  std::vector<std::string> lines;
  bool last_line_ends = true;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
    last_line_ends = !in.eof();
  }
  if (lines.empty()) throw RunError("cannot read " + starter.string());
  const std::string_view line_end = lines.front().ends_with('\r') ? "\r\n" : "\n";

  Id next = 1;
  for (const model::Surface& s : model.surfaces) next = std::max(next, s.id + 1);
  std::string added;
  for (const init::TurnedSurface& t : turned) {
    if (t.segments.empty()) continue;
    const model::Interface& card = model.interfaces[static_cast<std::size_t>(t.interface)];
    if (model.version < 50) throw RunError("--write-deck needs a deck of version 50 or later");
    std::error_code ignored;
    if (!std::filesystem::equivalent(card.place.file, starter, ignored))
      throw RunError(fmt::format("interface {} is defined in {}, not in the Starter deck itself: --write-deck cannot change it", card.id,
                                 card.place.file));
    const auto keyword = static_cast<std::size_t>(card.place.line) - 1;
    const Index surface = model::surfaces_of(card)[t.side == 0 ? 0 : 1];
    put(lines[card_line(lines, keyword, 2)], t.side == 0 ? 1 : 11, next);
    put(lines[card_line(lines, keyword, 4)], t.side == 0 ? 11 : 21, 2);
    fmt::format_to(std::back_inserter(added), "/SURF/SEG/{}{}surface {} turned to face the other side of interface {}{}", next, line_end,
                   t.surface_id, card.id, line_end);
    Id number = 0;
    for (const model::Segment& s : model.surfaces[static_cast<std::size_t>(surface)].segments) {
      fmt::format_to(std::back_inserter(added), "{:>10}", ++number);
      for (const Index n : s.nodes) fmt::format_to(std::back_inserter(added), "{:>10}", model.node_id[static_cast<std::size_t>(n)]);
      added += line_end;
    }
    ++next;
  }

  const auto end = std::find_if(lines.begin(), lines.end(), [](const std::string& line) { return line.starts_with("/END"); });
  std::string text;
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    if (line == end) text += added;
    text += *line;
    if (line + 1 != lines.end() || last_line_ends) text += '\n';
  }
  if (end == lines.end()) {
    if (!last_line_ends) text += line_end;
    text += added;
  }
  output::write_atomically(target, text);
}

}  // namespace abut::run
