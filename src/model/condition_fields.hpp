// What the readers of conditions, interfaces and outputs share: fields that mean the same on every card.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "model/reader.hpp"

namespace abut::model {

/// Case-insensitive comparison of words.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

/// True when the block's keyword starts with these words.
[[nodiscard]] bool is_keyword(const deck::Block& block, std::string_view first, std::string_view second = {});

/// The word is an id ("7"): "/IMPVEL/7" has it where "/IMPVEL/FGEO/7" has an option.
[[nodiscard]] bool is_id(std::string_view word);

/// Deck of the layout with 8-column fields.
[[nodiscard]] inline bool old_layout(const Context& c) { return c.model->version != 0 && c.model->version <= 44; }

/// One error for the whole block: the keyword is known, changes the mechanics and is not supported.
void refuse(Context& c, const deck::Block& block, std::string message);

/// A real whose blank or 0 stands for `fallback`, a value in the unit of the keyword ("a scale of 0 is 1", A.6).
[[nodiscard]] double real_or(BlockReader& r, deck::Columns c, std::string_view field, Dimension d, double fallback);

/// A time limit: blank or 0 is never, and whatever is at or beyond 1e30 in the deck's unit is never in any unit.
[[nodiscard]] double stop_time(BlockReader& r, deck::Columns c, std::string_view field);

/// A group of nodes that must be given. Reports and returns an empty list when it is not or does not exist.
[[nodiscard]] std::vector<Index> required_group(BlockReader& r, deck::Columns c, std::string_view field);

/// Nodes of a group, or nothing for id 0.
[[nodiscard]] std::vector<Index> optional_group(BlockReader& r, deck::Columns c, std::string_view field);

[[nodiscard]] Index read_function(BlockReader& r, deck::Columns c, std::string_view field, bool required);
[[nodiscard]] Index read_skew(BlockReader& r, deck::Columns c, std::string_view field);
/// A sensor of a kind that abut has not is named in the message.
[[nodiscard]] Index read_sensor(BlockReader& r, deck::Columns c, std::string_view field);

/// X, Y, Z, XX, YY, ZZ -> 0..5; reports anything else and returns 0.
[[nodiscard]] int read_direction(BlockReader& r, deck::Columns c, std::string_view field);

/// Integer that must lie in [low, high]; `what_is_right` completes "<value> is not ...".
[[nodiscard]] int integer_in(BlockReader& r, deck::Columns c, std::string_view field, int low, int high, std::string_view what_is_right);

/// Factor of a friction filter of kind 0 (none), 1 (share of the new force), 2 (period in cycles) or 3 (frequency); one that would
/// amplify is reported. @param kind_field  where the kind is
[[nodiscard]] double filter_factor(BlockReader& r, deck::Columns c, std::string_view field, int kind, std::string_view kind_field);

/// Where the deck defines keyword `word` ("INTER") with this id for the `nth` time (0: first); without a line if it does not.
[[nodiscard]] Place place_of(const Context& c, std::string_view word, Id id, int nth = 0);

/// A second item with one id: an error, or, where both can act at once, a warning.
void report_second(Context& c, std::string_view word, Id id, bool both_act);

/// Sorts by id and reports ids that are used twice.
template <class T>
void order_by_id(Context& c, std::vector<T>& items, std::string_view word, bool both_act) {
  std::stable_sort(items.begin(), items.end(), [](const T& a, const T& b) { return a.id < b.id; });
  for (std::size_t i = 1; i < items.size(); ++i) {
    const bool second = items[i].id == items[i - 1].id && (i == 1 || items[i - 2].id != items[i].id);
    if (second && items[i].id != 0) report_second(c, word, items[i].id, both_act);
  }
}

/// Id -> index of a list sorted by id.
template <class T>
void fill_table(Tables::Map& table, const std::vector<T>& items) {
  table.clear();
  for (std::size_t i = 0; i < items.size(); ++i) table.emplace(items[i].id, static_cast<Index>(i));
}

}  // namespace abut::model
