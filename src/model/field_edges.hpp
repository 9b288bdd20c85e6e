// Numbers that go over the edge of their field: the columns cut them in two, and both parts may be numbers.
#pragma once

#include <bitset>
#include <string>
#include <string_view>
#include <vector>

#include "deck/fields.hpp"
#include "deck/text.hpp"

namespace abut::model {

/// The fields of one card that a reader looks at. Numbers are judged when all are known, for neighbours may touch: one that fills its
/// field reaches the number in the field before or behind (deck-format.md A.4).
class FieldEdges {
 public:
  struct Finding {
    deck::Columns columns;  ///< of the field
    std::string field;
    std::string message;
    bool lost = false;  ///< a part of the number is read nowhere; else as another number
  };

  void take(deck::Columns c) {
    first_.set(static_cast<std::size_t>(c.first));
    last_.set(static_cast<std::size_t>(c.last));
  }

  /// That the field just taken is read as a number.
  void take_number(std::string_view card, deck::Columns c, std::string_view field) {
    const auto first = static_cast<std::size_t>(c.first), last = static_cast<std::size_t>(c.last);
    number_first_.set(first);
    if (filled(card, last) && filled(card, last + 1)) touching_.push_back({c, std::string(field), true});
    if (filled(card, first) && filled(card, first - 1)) touching_.push_back({c, std::string(field), false});
  }

  [[nodiscard]] bool has_numbers() const { return number_first_.any(); }

  /// What is wrong on the card.
  [[nodiscard]] std::vector<Finding> findings(std::string_view card) const;

  /// The next card begins.
  void clear();

 private:
  struct Touching {
    deck::Columns columns;
    std::string field;
    bool at_right;
  };

  /// Whether column `k`, counted from 1, holds something.
  [[nodiscard]] static bool filled(std::string_view card, std::size_t k) {
    return k > 0 && k <= card.size() && !deck::is_blank(card[k - 1]);
  }
  void judge_right(std::string_view card, const Touching& t, std::vector<Finding>& out) const;
  void judge_left(std::string_view card, const Touching& t, std::vector<Finding>& out) const;

  using Marks = std::bitset<128>;
  Marks first_, number_first_, last_;  ///< columns where fields begin, where those read as numbers do, and where fields end
  std::vector<Touching> touching_;
};

}  // namespace abut::model
