// How messages name many things: "1, 2, 3 (and 5 more)", "1 node", "4 nodes".
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace abut::model {

inline constexpr std::size_t listed = 20;  ///< how many ids a message names

/// "1, 2, 3 (and 5 more)"
template <class T>
std::string list(const std::vector<T>& items) {
  const std::size_t n = std::min(items.size(), listed);
  std::string s = fmt::format("{}", fmt::join(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(n), ", "));
  if (items.size() > n) s += fmt::format(" (and {} more)", items.size() - n);
  return s;
}

inline std::string plural(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace abut::model
