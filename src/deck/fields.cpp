#include "deck/fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "deck/text.hpp"

namespace abut::deck {

namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number in the one spelling that std::from_chars reads, e.g. "+1.5D-5" and "1.5-5" become "1.5e-5". Empty: not a number.
std::string canonical(std::string_view s) {
  std::string out;
  std::size_t i = 0;
  if (i < s.size() && (s[i] == '+' || s[i] == '-')) {
    if (s[i] == '-') out += '-';
    ++i;
  }
  bool digits = false;
  const auto take_digits = [&] {
    for (; i < s.size() && is_digit(s[i]); ++i) {
      out += s[i];
      digits = true;
    }
  };
  take_digits();
  if (i < s.size() && s[i] == '.') {
    out += s[i++];
    take_digits();
  }
  if (!digits) return {};
  if (i == s.size()) return out;
  const char c = upper(s[i]);
  const bool letter = c == 'E' || c == 'D';
  if (!letter && c != '+' && c != '-') return {};
  if (letter) ++i;
  out += 'e';
  if (i < s.size() && (s[i] == '+' || s[i] == '-')) out += s[i++];
  digits = false;
  take_digits();
  return digits && i == s.size() ? out : std::string{};
}

}  // namespace

std::string_view field_text(std::string_view card, Columns c) {
  const auto first = static_cast<std::size_t>(std::max(c.first, 1)) - 1;
  const auto last = static_cast<std::size_t>(std::clamp(c.last, 0, static_cast<int>(card_width)));
  if (first >= card.size() || first >= last) return {};
  return trimmed(card.substr(first, last - first));
}

std::optional<double> parse_real(std::string_view field) {
  if (field.empty()) return 0.0;
  double value = 0.0;
  const char* end = field.data() + field.size();
  const char lead = field.front() == '-' && field.size() > 1 ? field[1] : field.front();
  if (is_digit(lead) || lead == '.') {  // also keeps "inf" and "nan" away from from_chars
    const auto [stop, error] = std::from_chars(field.data(), end, value);
    if (error == std::errc{} && stop == end) return value;
  }
  const std::string number = canonical(field);
  if (number.empty()) return std::nullopt;
  end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value);
  if (error == std::errc{} && stop == end) return value;
  // Too small for a double is zero; too large is a fault.
  const bool underflow = error == std::errc::result_out_of_range && number.find("e-") != std::string::npos;
  return underflow ? std::optional<double>(0.0) : std::nullopt;
}

std::optional<Id> parse_integer(std::string_view field) {
  if (field.empty()) return 0;
  const std::string_view digits = field.front() == '+' ? field.substr(1) : field;
  const char* end = digits.data() + digits.size();
  Id value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc{} && stop == end && (field.front() != '+' || is_digit(digits.front()))) return value;
  const std::optional<double> real = parse_real(field);
  constexpr double exact = 9007199254740992.0;  // 2^53: every integer below it is a double
  if (real && std::floor(*real) == *real && std::abs(*real) < exact) return static_cast<Id>(*real);
  return std::nullopt;
}

}  // namespace abut::deck
