#include "model/free_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "deck/fields.hpp"
#include "deck/text.hpp"

namespace abut::model {

namespace {

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  constexpr std::string_view separators = " \t,\r";
  for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return words;
}

}  // namespace

FreeFormat::FreeFormat(const deck::Deck& deck, const deck::Block& block, Diagnostics& diagnostics)
    : deck_(deck), block_(block), diagnostics_(diagnostics), errors_before_(diagnostics.error_count()) {
  for (std::size_t i = 0; i < block.cards.size(); ++i) {
    std::vector<std::string_view> words = split(block.cards[i].text);
    if (!words.empty()) lines_.emplace_back(i, std::move(words));
  }
}

FreeFormat::~FreeFormat() {
  if (diagnostics_.error_count() > errors_before_) return;
  if (lines_read_ > 0 && !lines_.empty()) {
    const std::vector<std::string_view>& words = lines_.front().second;
    for (std::size_t k = words_read_; k < words.size(); ++k) {
      if (deck::parse_real(words[k])) continue;  // real decks have more numbers than are used
      diagnostics_.warning(
          "engine.surplus", place(0),
          fmt::format("'{}' is not read: only the first {} of this line {}", deck::printable(words[k]),
                      words_read_ == 1 ? "number" : fmt::format("{} numbers", words_read_), words_read_ == 1 ? "counts" : "count"));
      break;
    }
  }
  if (lines_.size() > lines_read_) {
    const std::size_t more = lines_.size() - lines_read_ - 1;
    diagnostics_.warning(
        "engine.surplus", place(lines_read_),
        fmt::format("{} not read: this keyword has {}", more == 0 ? "this line is" : fmt::format("this line and {} more are", more),
                    lines_read_ == 0 ? "no data" : "one line of data"));
  }
}

double FreeFormat::real(std::size_t k, std::string_view field) {
  words_read_ = std::max(words_read_, k + 1);
  lines_read_ = std::max<std::size_t>(lines_read_, 1);
  if (lines_.empty() || k >= lines_.front().second.size()) return 0.0;
  const std::string_view text = lines_.front().second[k];
  const auto value = deck::parse_real(text);
  if (!value) bad(0, field, fmt::format("'{}' is not a real number", text));
  return value.value_or(0.0);
}

double FreeFormat::positive(std::size_t k, std::string_view field) {
  const double value = real(k, field);
  if (value < 0.0) bad(0, field, fmt::format("{} is negative; write 0 or more", value));
  return std::max(value, 0.0);
}

std::vector<Id> FreeFormat::integers(std::size_t first, std::string_view field) {
  std::vector<Id> ids;
  for (std::size_t i = first; i < lines_.size(); ++i) {
    for (const std::string_view text : lines_[i].second) {
      const auto value = deck::parse_integer(text);
      if (!value) {
        bad(i, field, fmt::format("'{}' is not an integer", text));
      } else if (*value != 0) {
        ids.push_back(*value);
      }
    }
  }
  if (first == 0) words_read_ = std::numeric_limits<std::size_t>::max();
  lines_read_ = std::max(lines_read_, lines_.size());
  return ids;
}

void FreeFormat::bad(std::size_t line, std::string_view field, std::string message, Severity severity) {
  Place at = place(line);
  at.field = std::string(field);
  diagnostics_.add({severity, "engine.bad_value", std::move(at), std::move(message)});
}

Place FreeFormat::place(std::size_t line) const {
  return line < lines_.size() ? deck_.place(block_, block_.cards[lines_[line].first]) : deck_.place(block_);
}

}  // namespace abut::model
