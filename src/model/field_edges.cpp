#include "model/field_edges.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abut::model {

namespace {

constexpr std::size_t smallest_field = 8;  ///< columns, of the old layout

bool may_be_in_a_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-' || c == 'e' || c == 'E' || c == 'd' || c == 'D';
}

/// The characters that a number may have from column `k` on, to the right or to the left of it (which is included).
std::size_t last_of_run(std::string_view card, std::size_t k) {
  while (k < card.size() && may_be_in_a_number(card[k])) ++k;
  return k;
}
std::size_t first_of_run(std::string_view card, std::size_t k) {
  while (k > 1 && may_be_in_a_number(card[k - 2])) --k;
  return k;
}

std::string_view columns(std::string_view card, std::size_t first, std::size_t last) {
  return first > last ? std::string_view{} : card.substr(first - 1, last - first + 1);
}

bool is_number(std::string_view s) { return !s.empty() && deck::parse_real(s).has_value(); }

/// A number beyond the edge that fills a field of its own, which nobody reads.
bool fills_a_field(std::string_view s) { return s.size() >= smallest_field && is_number(s); }

}  // namespace

std::vector<FieldEdges::Finding> FieldEdges::findings(std::string_view card) const {
  std::vector<Finding> out;
  for (const Touching& t : touching_) {
    if (t.at_right) {
      judge_right(card, t, out);
    } else {
      judge_left(card, t, out);
    }
  }
  return out;
}

void FieldEdges::clear() {
  touching_.clear();
  first_.reset();
  number_first_.reset();
  last_.reset();
}

void FieldEdges::judge_right(std::string_view card, const Touching& t, std::vector<Finding>& out) const {
  const auto first = static_cast<std::size_t>(t.columns.first), last = static_cast<std::size_t>(t.columns.last);
  const std::size_t from = std::max(first, first_of_run(card, last)), to = last_of_run(card, last);
  const std::string_view whole = columns(card, from, to), inside = columns(card, from, last), beyond = columns(card, last + 1, to);
  if (!is_number(whole) || to == last) return;
  if (!first_.test(last + 1)) {
    if (fills_a_field(beyond)) return;
    out.push_back(
        {t.columns, t.field,
         fmt::format("'{}' goes on to column {}, beyond its field, where '{}' would be read; end it in column {}", whole, to, inside, last),
         true});
    return;
  }
  std::size_t end = last + 1;
  while (end < last_.size() && !last_.test(end)) ++end;
  if (!number_first_.test(last + 1) || from == first || filled(card, end)) return;
  out.push_back(
      {t.columns, t.field,
       fmt::format("'{}' in columns {} to {} goes over the border to the next field and is read as '{}' and '{}'; end a number in "
                   "the last column of its field, and leave a blank between two",
                   whole, from, to, inside, beyond),
       false});
}

void FieldEdges::judge_left(std::string_view card, const Touching& t, std::vector<Finding>& out) const {
  const auto first = static_cast<std::size_t>(t.columns.first), last = static_cast<std::size_t>(t.columns.last);
  if (last_.test(first - 1)) return;  // a field of its own, judged at its right edge where it is a number
  const std::size_t from = first_of_run(card, first), to = std::min(last, last_of_run(card, first));
  const std::string_view whole = columns(card, from, to), beyond = columns(card, from, first - 1);
  if (!is_number(whole) || from == first || fills_a_field(beyond)) return;
  out.push_back({t.columns, t.field,
                 fmt::format("'{}' begins in column {}, left of its field, where '{}' would be read; begin it in column {} or right of it",
                             whole, from, columns(card, first, to), first),
                 true});
}

}  // namespace abut::model
