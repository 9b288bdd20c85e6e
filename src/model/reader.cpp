#include "model/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "deck/text.hpp"

namespace abut::model {

namespace {

constexpr int old_layout_version = 50;  ///< decks up to version 44 have fields of 8 columns and the title on the keyword line

double power(double base, int exponent) {
  double p = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) p *= base;
  return exponent < 0 ? 1.0 / p : p;
}

bool old_layout(const Context& c) { return c.model->version > 0 && c.model->version < old_layout_version; }

/// Columns of the 10-column layout -> 8-column layout: field by field, kept at the same distance from the right end of a field.
deck::Columns to_old_layout(deck::Columns c) {
  const auto map = [](int column, bool first) {
    const int field = (column - 1) / 10;
    const int from_right = std::min(9 - (column - 1) % 10, first ? 7 : 8);
    return 8 * field + 8 - from_right;
  };
  return {map(c.first, true), map(c.last, false)};
}

std::string quoted(std::string_view text) { return "'" + deck::printable(text) + "'"; }

/// Two numbers or more and nothing else.
bool is_row_of_numbers(std::string_view text) {
  int numbers = 0;
  while (!(text = deck::trimmed(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    if (!deck::parse_real(text.substr(0, end))) return false;
    text.remove_prefix(end);
    ++numbers;
  }
  return numbers > 1;
}

/// The title after the id on a keyword line of the old layout: "/PART/3/lower block".
std::string_view title_of_keyword_line(const deck::Block& block, std::size_t id_word) {
  if (block.words.size() <= id_word + 1) return {};
  const std::string_view id = block.words[id_word];
  const auto id_end = static_cast<std::size_t>(id.data() + id.size() - block.keyword_line.data());
  const std::size_t slash = block.keyword_line.find('/', id_end);
  return slash == std::string_view::npos ? std::string_view{} : deck::trimmed(block.keyword_line.substr(slash + 1));
}

}  // namespace

double Context::factor(Dimension d, Id unit_id) const {
  const Units* value_units = &input;
  if (unit_id != 0) {
    const auto found = local.find(unit_id);
    if (found != local.end()) value_units = &found->second;
  }
  const Units& work = model->units;
  return power(value_units->mass / work.mass, d.mass) * power(value_units->length / work.length, d.length) *
         power(value_units->time / work.time, d.time);
}

BlockReader::BlockReader(Context& context, const deck::Block& block, int id_word, bool has_title)
    : context_(&context), block_(&block), errors_before_(context.diagnostics->error_count()) {
  const bool old = old_layout(context);
  const auto error = [this](std::string_view code, std::string message) {
    context_->diagnostics->error(std::string(code), place(), std::move(message));
  };
  if (id_word >= 0) {
    const std::string_view word = block.word(static_cast<std::size_t>(id_word));
    const std::optional<Id> id = deck::parse_integer(word);
    if (!id || *id <= 0) {
      error("deck.bad_id", word.empty() ? std::string("the keyword line needs an id: a positive integer")
                                        : fmt::format("{} is not an id: a positive integer is needed", quoted(word)));
    } else {
      id_ = *id;
    }
  }
  if (old) {
    if (id_word >= 0) title_ = deck::printable(title_of_keyword_line(block, static_cast<std::size_t>(id_word)));
    return;
  }
  const std::string_view unit_word = block.word(id_word >= 0 ? static_cast<std::size_t>(id_word) + 1 : 1);
  if (!unit_word.empty()) {
    const std::optional<Id> unit = deck::parse_integer(unit_word);
    if (!unit) {
      error("deck.bad_unit_id", fmt::format("{} is not the id of a /UNIT block", quoted(unit_word)));
    } else if (*unit != 0 && context.local.find(*unit) == context.local.end()) {
      error("model.unknown_unit", fmt::format("no /UNIT with id {}", *unit));
    } else {
      unit_id_ = *unit;
    }
  }
  if (has_title && !block.cards.empty()) {
    title_ = deck::printable(deck::trimmed(block.cards.front().text.substr(0, deck::card_width)));
    titled_ = true;
    next_ = 1;
    if (is_row_of_numbers(title_)) {
      context.diagnostics->warning(
          "deck.title_of_numbers", context.deck->place(block, block.cards.front()),
          fmt::format("{} is taken for the title, which is always the line below the keyword line; where it is data, "
                      "put a title line before it",
                      quoted(std::string_view(title_))));
    }
  }
}

BlockReader::~BlockReader() {
  leave_card();
  if (context_->field_log != nullptr || context_->diagnostics->error_count() > errors_before_) return;
  const deck::Card* first = nullptr;
  int lines = 0;
  for (; more(); ++next_) {
    const deck::Card& card = block_->cards[next_];
    if (card.file != block_->file || deck::is_blank_card(card.text)) continue;  // text of an included file may follow a block (H.2, item 3)
    if (first == nullptr) first = &card;
    ++lines;
  }
  if (first == nullptr) return;
  context_->diagnostics->warning(
      "deck.surplus_lines", context_->deck->place(*block_, *first),
      fmt::format("{} not read: the block has all its cards before; a further item needs a keyword line of its own",
                  lines == 1 ? "this line is" : fmt::format("this line and {} more are", lines - 1)));
}

std::string BlockReader::keyword() const { return block_->name(); }

void BlockReader::leave_rest() {
  next_ = block_->cards.size();
  edges_.clear();
}

bool BlockReader::more() const { return next_ < block_->cards.size(); }

bool BlockReader::next_card() {
  leave_card();
  card_ = more() ? &block_->cards[next_++] : nullptr;
  return card_ != nullptr;
}

void BlockReader::leave_card() {
  if (card_ != nullptr && edges_.has_numbers()) {
    for (FieldEdges::Finding& f : edges_.findings(card_->text)) {
      Place p = context_->deck->place(*block_, *card_);
      p.field = std::move(f.field);
      p.first_column = f.columns.first;
      p.last_column = f.columns.last;
      context_->diagnostics->add({f.lost ? Severity::error : Severity::warning, "deck.cut_number", std::move(p), std::move(f.message)});
    }
    number_right_of_fields();
  }
  edges_.clear();
}

void BlockReader::number_right_of_fields() {
  const auto end = static_cast<std::size_t>(in_layout({last_column_, last_column_}).last);
  if (told_surplus_ || card_->text.size() <= end || card_->file != block_->file) return;
  if (!deck::is_blank(card_->text[end]) && !deck::is_blank(card_->text[end - 1])) return;  // of the field before, if it is a number
  const std::string_view rest = deck::trimmed(card_->text.substr(end));
  const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
  if (word.empty() || deck::parse_real(word).value_or(0.0) == 0.0) return;  // no number, or one that says what a blank says
  told_surplus_ = true;
  Place p = context_->deck->place(*block_, *card_);
  p.first_column = static_cast<int>(word.data() - card_->text.data()) + 1;
  p.last_column = p.first_column + static_cast<int>(word.size()) - 1;
  context_->diagnostics->warning(
      "deck.surplus_text", std::move(p),
      fmt::format("{} stands right of the last field, which ends in column {}, and is not read", quoted(word), end));
}

deck::Columns BlockReader::in_layout(deck::Columns c) const { return old_layout(*context_) ? to_old_layout(c) : c; }

std::string_view BlockReader::text(deck::Columns c) const {
  return card_ == nullptr ? std::string_view{} : deck::field_text(card_->text, in_layout(c));
}

std::string_view BlockReader::text(deck::Columns c, std::string_view field) {
  if (context_->field_log != nullptr) context_->field_log->push_back({next_ - (titled_ ? 1 : 0), c, std::string(field)});
  edges_.take(in_layout(c));
  return text(c);
}

std::string_view BlockReader::number(deck::Columns c, std::string_view field) {
  const std::string_view s = text(c, field);
  if (!s.empty()) edges_.take_number(card_->text, in_layout(c), field);
  return s;
}

std::string BlockReader::not_a(std::string_view what, std::string_view text) const {
  const bool tab = card_ != nullptr && card_->text.find('\t') != std::string_view::npos;
  return fmt::format("{} is not {}{}", quoted(text), what,
                     tab ? "; the line has tabs, and a tab counts as one column: fields need blanks up to their columns" : "");
}

double BlockReader::real(deck::Columns c, std::string_view field, Dimension d) {
  const std::string_view s = number(c, field);
  if (s.empty()) return 0.0;
  const std::optional<double> value = deck::parse_real(s);
  if (!value) {
    error("deck.bad_real", c, field,
          s.front() == '&' ? fmt::format("{} refers to a /PARAMETER, which is not supported: write the number", quoted(s))
                           : not_a("a real number", s));
    return 0.0;
  }
  const double converted = *value * context_->factor(d, unit_id_);
  if (!std::isfinite(converted)) {
    error("deck.bad_real", c, field, fmt::format("{} is too large in work units", quoted(s)));
    return 0.0;
  }
  return converted;
}

Id BlockReader::integer(deck::Columns c, std::string_view field) {
  const std::string_view s = number(c, field);
  const std::optional<Id> value = deck::parse_integer(s);
  if (!value) error("deck.bad_integer", c, field, not_a("an integer", s));
  return value.value_or(0);
}

bool BlockReader::flag(int column, std::string_view field) {
  const std::string_view s = text({column, column}, field);
  if (s.empty() || s == "0") return false;
  if (s != "1") error("deck.bad_flag", {column, column}, field, fmt::format("{} is not 0 or 1", quoted(s)));
  return true;
}

void BlockReader::only_flags(deck::Columns c, std::initializer_list<int> flags, std::string_view field, std::string_view what_is_right) {
  for (int column = c.first; column <= c.last; ++column) {
    if (std::find(flags.begin(), flags.end(), column) != flags.end()) continue;
    const std::string_view s = text({column, column});
    if (s.empty()) continue;
    error("deck.bad_flag", {column, column}, field, fmt::format("{} stands between the flags: {}", quoted(s), what_is_right));
    return;
  }
}

std::vector<Id> BlockReader::id_list(std::string_view field) {
  std::vector<Id> ids;
  bool told = false;
  while (next_card()) {
    const bool foreign = card_->file != block_->file;
    for (int i = 0; i < 10; ++i) {
      const deck::Columns c{10 * i + 1, 10 * i + 10};
      const std::string_view s = number(c, field);
      const std::optional<Id> id = deck::parse_integer(s);
      if (!id && foreign) {  // text of an included file after the list (H.2, item 3)
        warning("deck.surplus_lines", c, field, fmt::format("the list ends here: {} is not an id", quoted(s)));
        leave_rest();
        return ids;
      }
      if (!id) error("deck.bad_integer", c, field, not_a("an integer", s));
      if (id && *id != 0) ids.push_back(*id);
    }
    if (!told && !foreign) told = surplus_text(field);
  }
  return ids;
}

bool BlockReader::surplus_text(std::string_view field) {
  if (card_ == nullptr) return false;
  constexpr deck::Columns beyond{101, 110};
  const auto first = static_cast<std::size_t>(in_layout(beyond).first) - 1;
  const std::string_view text = first < card_->text.size() ? deck::trimmed(card_->text.substr(first)) : std::string_view{};
  if (text.empty()) return false;
  told_surplus_ = true;
  constexpr std::size_t shown = 40;
  warning(
      "deck.surplus_text", beyond, field,
      fmt::format("{} stands right of the ten fields of a line and is not read: go on in the next line", quoted(text.substr(0, shown))));
  return true;
}

Index BlockReader::resolve(const Tables::Map& table, Id id, std::string_view what, deck::Columns c, std::string_view field) {
  if (id == 0) return no_index;
  const auto found = table.find(id);
  if (found != table.end()) return found->second;
  error("model.unknown_reference", c, field, fmt::format("no {} with id {}", what, id));
  return no_index;
}

void BlockReader::error(std::string_view code, deck::Columns c, std::string_view field, std::string message) {
  context_->diagnostics->error(std::string(code), place(c, field), std::move(message));
}

void BlockReader::warning(std::string_view code, deck::Columns c, std::string_view field, std::string message) {
  context_->diagnostics->warning(std::string(code), place(c, field), std::move(message));
}

Place BlockReader::place() const { return context_->deck->place(*block_); }

Place BlockReader::place(deck::Columns c, std::string_view field) const {
  Place p = card_ != nullptr ? context_->deck->place(*block_, *card_) : place();
  if (c.first > 0) c = in_layout(c);
  p.field = std::string(field);
  p.first_column = c.first;
  p.last_column = c.last;
  return p;
}

}  // namespace abut::model
