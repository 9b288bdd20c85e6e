#include "deck/text.hpp"

#include <algorithm>

namespace abut::deck {

namespace {

/// Length of the UTF-8 sequence at s[i] if it is well formed (RFC 3629, table 3-7 of Unicode), else 0.
std::size_t utf8_length(std::string_view s, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0U; };
  const auto trail = [&](std::size_t k, unsigned low = 0x80U, unsigned high = 0xBFU) { return byte(k) >= low && byte(k) <= high; };
  const unsigned b = byte(i);
  if (b < 0x80U) return 1;
  if (b >= 0xC2U && b <= 0xDFU) return trail(i + 1) ? 2 : 0;
  if (b >= 0xE0U && b <= 0xEFU) {
    const unsigned low = b == 0xE0U ? 0xA0U : 0x80U;
    const unsigned high = b == 0xEDU ? 0x9FU : 0xBFU;
    return trail(i + 1, low, high) && trail(i + 2) ? 3 : 0;
  }
  if (b >= 0xF0U && b <= 0xF4U) {
    const unsigned low = b == 0xF0U ? 0x90U : 0x80U;
    const unsigned high = b == 0xF4U ? 0x8FU : 0xBFU;
    return trail(i + 1, low, high) && trail(i + 2) && trail(i + 3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
  return s;
}

bool is_blank_card(std::string_view s) {
  const std::string_view counted = s.substr(0, card_width);
  return std::all_of(counted.begin(), counted.end(), is_blank);
}

bool same_word(std::string_view word, std::string_view upper_case) {
  return std::equal(word.begin(), word.end(), upper_case.begin(), upper_case.end(), [](char a, char b) { return upper(a) == b; });
}

std::string to_upper(std::string_view s) {
  std::string out(s);
  std::transform(out.begin(), out.end(), out.begin(), upper);
  return out;
}

std::string printable(std::string_view s) {
  bool utf8 = true;
  for (std::size_t i = 0; i < s.size() && utf8;) {
    const std::size_t n = utf8_length(s, i);
    utf8 = n > 0;
    i += n;
  }
  std::string out;
  out.reserve(s.size());
  for (const char c : s) {
    const auto b = static_cast<unsigned char>(c);
    if (b < 0x20U || b == 0x7FU) {
      out += ' ';
    } else if (b < 0x80U || utf8) {
      out += c;
    } else {
      out += static_cast<char>(0xC0U | (b >> 6U));
      out += static_cast<char>(0x80U | (b & 0x3FU));
    }
  }
  return out;
}

}  // namespace abut::deck
