// /BEGIN, /UNIT, /TITLE, /DEF_*, /ANALY and other control keywords (deck-format.md A.8, A.12, A.13).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "deck/text.hpp"
#include "model/reader.hpp"
#include "model/units.hpp"

namespace abut::model {

namespace {

constexpr int newest_version = 2026;

constexpr std::array<deck::Columns, 3> unit_columns{{{1, 20}, {21, 40}, {41, 60}}};
constexpr std::array<char, 3> unit_bases{'g', 'm', 's'};
constexpr std::array<std::string_view, 3> unit_kinds{"mass", "length", "time"};

double& size_of(Units& u, std::size_t k) { return k == 0 ? u.mass : (k == 1 ? u.length : u.time); }
std::string& name_of(Units& u, std::size_t k) { return k == 0 ? u.mass_name : (k == 1 ? u.length_name : u.time_name); }

std::string bad_unit(std::string_view code, std::size_t k) {
  static constexpr std::array<std::string_view, 3> examples{"kg, g, Mg", "m, mm, cm", "s, ms, mus"};
  return fmt::format("'{}' is not a unit of {}: write a code such as {}, or its size in SI as a positive number", deck::printable(code),
                     unit_kinds[k], examples[k]);
}

/// Reads the three units of the current card; returns which of them are given.
std::array<bool, 3> read_units(BlockReader& r, Units& units, std::string_view prefix) {
  std::array<bool, 3> given{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view code = r.text(unit_columns[k], fmt::format("{} {} unit", prefix, unit_kinds[k]));
    if (code.empty()) continue;
    given[k] = true;
    if (const std::optional<double> size = unit_size(code, unit_bases[k])) {
      size_of(units, k) = *size;
      name_of(units, k) = deck::printable(code);
    } else {
      r.error("deck.bad_unit", unit_columns[k], fmt::format("{} {} unit", prefix, unit_kinds[k]), bad_unit(code, k));
    }
  }
  return given;
}

void set_version(Context& c, Id version, const Place& place) {
  if ((version != 0 && version < 41) || version > 9999) {
    c.diagnostics->error("model.bad_version", place,
                         fmt::format("{} is not a format version: 41, 44, 51, 90 ... 140, 2017 ... 2026", version));
    version = newest_version;
  }
  if (version > newest_version) {
    c.diagnostics->warning("model.new_version", place,
                           fmt::format("version {} is newer than {}: read with the layout of {}", version, newest_version, newest_version));
  }
  c.model->version = version == 0 ? newest_version : static_cast<int>(version);
}

void read_begin(Context& c, const deck::Block& block) {
  BlockReader r(c, block, -1, false);
  if (r.next_card()) c.model->name = deck::printable(r.text({1, 80}, "name"));
  r.next_card();
  const Id version = r.integer({1, 10}, "Invers");
  set_version(c, version, r.place({1, 10}, "Invers"));
  Units input;
  Units work;
  r.next_card();
  const std::array<bool, 3> input_given = read_units(r, input, "input");
  r.next_card();
  const std::array<bool, 3> work_given = read_units(r, work, "work");
  for (std::size_t k = 0; k < 3; ++k) {
    if (!input_given[k]) size_of(input, k) = size_of(work, k), name_of(input, k) = name_of(work, k);
    if (!work_given[k]) size_of(work, k) = size_of(input, k), name_of(work, k) = name_of(input, k);
  }
  c.input = input;
  c.model->units = work;
}

/// An included file's own /BEGIN is not read (A.8): a warning where its numbers are then taken for others than it says.
void compare_inner_begin(Context& c, const deck::Block& block) {
  const auto field = [&](std::size_t card, deck::Columns columns) {
    return card < block.cards.size() ? deck::field_text(block.cards[card].text, columns) : std::string_view{};
  };
  std::vector<std::string> own, outer;
  const Id version = deck::parse_integer(field(1, {1, 10})).value_or(0);
  if (version != 0 && version != c.model->version) {
    own.push_back(fmt::format("version {}", version));
    outer.push_back(fmt::format("version {}", c.model->version));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view code = field(2, unit_columns[k]).empty() ? field(3, unit_columns[k]) : field(2, unit_columns[k]);
    const std::optional<double> size = unit_size(code, unit_bases[k]);
    if (code.empty() || (size && std::abs(*size / size_of(c.input, k) - 1.0) < 1e-12)) continue;
    own.push_back(fmt::format("{} in {}", unit_kinds[k], deck::printable(code)));
    outer.push_back(fmt::format("{} in {}", unit_kinds[k], name_of(c.input, k)));
  }
  if (own.empty()) return;
  const bool units_alone = version == 0 || version == c.model->version;
  c.diagnostics->warning(
      "model.inner_begin", c.deck->place(block),
      fmt::format("the /BEGIN of an included file is not read: it says {}, and the file is read with {}, as the deck that "
                  "includes it; convert the file{}",
                  fmt::join(own, ", "), fmt::join(outer, ", "), units_alone ? ", or give its keywords a /UNIT" : ""));
}

/// Header line of decks up to version 44: columns 17-24 version, 25-40 run name.
void read_old_header(Context& c) {
  const std::string& header = c.deck->header;
  Place place;
  if (!c.deck->files.empty()) place.file = c.deck->files.front();
  const std::optional<Id> version = deck::parse_integer(deck::field_text(header, {17, 24}));
  if (version && *version > 0) {
    set_version(c, *version, place);
    c.model->name = std::string(deck::field_text(header, {25, 40}));
    return;
  }
  c.model->version = newest_version;
  c.diagnostics->warning("model.no_begin", place,
                         fmt::format("no /BEGIN block: version {} and units kg, m, s are assumed", newest_version));
}

/// "/UNIT/LENGTH/mm" (versions up to 90) or "/UNIT/id".
void read_unit(Context& c, const deck::Block& block) {
  static constexpr std::array<std::string_view, 3> words{"MASS", "LENGTH", "TIME"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!block.is(1, words[k])) continue;
    const std::string_view code = block.word(2);
    if (const std::optional<double> size = unit_size(code, unit_bases[k])) {
      size_of(c.input, k) = size_of(c.model->units, k) = *size;
      name_of(c.input, k) = name_of(c.model->units, k) = deck::printable(code);
    } else {
      c.diagnostics->error("deck.bad_unit", c.deck->place(block), bad_unit(code, k));
    }
    return;
  }
  BlockReader r(c, block, 1, true);
  Units units;
  r.next_card();
  const std::array<bool, 3> given = read_units(r, units, "local");
  for (std::size_t k = 0; k < 3; ++k) {
    if (!given[k]) r.error("deck.bad_unit", unit_columns[k], fmt::format("local {} unit", unit_kinds[k]), bad_unit("", k));
  }
  if (r.id() > 0 && !c.local.emplace(r.id(), units).second) {
    c.diagnostics->error("model.duplicate_id", r.place(), fmt::format("a second /UNIT with id {}: ids must be unique", r.id()));
  }
}

/// A small integer of a control card: 0 keeps `value`; anything outside `allowed` is an error.
void read_choice(BlockReader& r, deck::Columns columns, std::string_view field, const std::set<Id>& allowed, int& value) {
  const Id given = r.integer(columns, field);
  if (given == 0) return;
  if (allowed.count(given) == 0) {
    std::string list;
    for (const Id a : allowed) list += fmt::format("{}{}", list.empty() ? "" : ", ", a);
    r.error("model.bad_choice", columns, field, fmt::format("{} is not one of {}", given, list));
    return;
  }
  value = static_cast<int>(given);
}

void read_shell_defaults(Context& c, const deck::Block& block) {
  BlockReader r(c, block, -1, false);
  r.next_card();
  ShellDefaults& d = c.shell_defaults;
  read_choice(r, {1, 10}, "Ishell", {1, 2, 3, 4, 12, 24}, d.ishell);
  read_choice(r, {11, 20}, "Ismstr", {-2, -1, 1, 2, 3, 4, 10}, d.ismstr);
  read_choice(r, {21, 30}, "Ithick", {1, 2}, d.ithick);
  read_choice(r, {31, 40}, "Iplas", {1, 2}, d.iplas);
  read_choice(r, {71, 80}, "Ish3n", {1, 2, 30, 31}, d.ish3n);
  int idrill = 2;
  read_choice(r, {81, 90}, "Idrill", {1, 2}, idrill);
  d.idrill = idrill == 1 ? 1 : 0;
}

void read_solid_defaults(Context& c, const deck::Block& block) {
  BlockReader r(c, block, -1, false);
  r.next_card();
  SolidDefaults& d = c.solid_defaults;
  read_choice(r, {1, 10}, "Isolid", {1, 2, 12, 14, 16, 17, 18, 24}, d.isolid);
  read_choice(r, {11, 20}, "Ismstr", {-2, -1, 1, 2, 3, 4, 10, 11, 12}, d.ismstr);
  const int version = c.model->version;
  if (version >= 2021) read_choice(r, {21, 30}, "Icpre", {1, 2, 3}, d.icpre);
  if (version >= 2019) read_choice(r, {41, 50}, "Itetra4", {1, 3, 1000}, d.itetra4);
  if (version >= 120) read_choice(r, {61, 70}, "Imas", {1, 2}, d.imas);
  read_choice(r, {71, 80}, "Iframe", {1, 2}, d.iframe);
}

void read_analysis(Context& c, const deck::Block& block) {
  BlockReader r(c, block, -1, false);
  r.next_card();
  const Id dimension = r.integer({1, 10}, "N2D3D");
  if (dimension != 0) {
    r.error("model.two_dimensional", {1, 10}, "N2D3D",
            fmt::format("{} asks for an axisymmetric or plane analysis: abut is three-dimensional (0)", dimension));
  }
}

void read_random(Context& c, const deck::Block& block) {
  if (!block.is(1, "GRNOD") && block.words.size() > 1) return;
  BlockReader r(c, block, block.is(1, "GRNOD") ? 2 : -1, false);
  r.next_card();
  const double noise = r.real({1, 20}, "Xalea", dim::length);
  if (noise != 0.0) {
    r.warning("model.random_noise", {1, 20}, "Xalea",
              fmt::format("geometric noise of {:g} is not applied: results differ from those of a perturbed mesh", noise));
  }
}

}  // namespace

/// NAME of NAME_0000.rad, after which the results are called, whatever the header says: two decks of one folder then never share a run
/// folder. Another file gives its name only where the header has none.
void take_name_of_file(Context& c) {
  if (c.deck->files.empty()) return;
  const std::string stem = std::filesystem::path(c.deck->files.front()).stem().string();
  constexpr std::string_view starter = "_0000";
  if (stem.size() > starter.size() && stem.ends_with(starter)) {
    c.model->name = stem.substr(0, stem.size() - starter.size());
  } else if (c.model->name.empty()) {
    c.model->name = stem;
  }
}

void read_control(Context& c) {
  const auto& blocks = c.deck->blocks;
  const auto begin = std::find_if(blocks.begin(), blocks.end(), [](const deck::Block& b) { return b.is(0, "BEGIN"); });
  if (begin != blocks.end()) {
    read_begin(c, *begin);
    for (auto b = begin + 1; b != blocks.end(); ++b) {
      if (b->is(0, "BEGIN")) c.diagnostics->warning("model.second_begin", c.deck->place(*b), "a second /BEGIN is ignored");
    }
  } else {
    read_old_header(c);
  }
  for (const deck::Block& b : blocks) {
    if (b.is(0, "UNIT")) read_unit(c, b);
  }
  for (const deck::Block& b : c.deck->inner_begins) compare_inner_begin(c, b);
  take_name_of_file(c);
  bool shell_defaults = false;
  bool solid_defaults = false;
  bool title = false;
  for (const deck::Block& b : blocks) {
    if (b.is(0, "TITLE") && !std::exchange(title, true) && !b.cards.empty()) {
      BlockReader r(c, b, -1, false);
      r.next_card();
      c.model->title = deck::printable(deck::trimmed(r.text({1, 100}, "title")));
    }
    // Only the first block of each kind counts (A.12).
    if (b.is(0, "DEF_SHELL") && !std::exchange(shell_defaults, true)) read_shell_defaults(c, b);
    if (b.is(0, "DEF_SOLID") && !std::exchange(solid_defaults, true)) read_solid_defaults(c, b);
    if (b.is(0, "ANALY")) read_analysis(c, b);
    if (b.is(0, "RANDOM")) read_random(c, b);
    if (b.is(0, "SHFRA") && b.is(1, "V4")) c.model->shell_frame_v4 = true;
  }
}

}  // namespace abut::model
