#include "model/units.hpp"

#include <array>
#include <utility>

#include "deck/fields.hpp"

namespace abut::model {

std::optional<double> unit_size(std::string_view code, char base) {
  if (const std::optional<double> number = deck::parse_real(code)) { return !code.empty() && *number > 0.0 ? number : std::nullopt; }
  static constexpr std::array<std::pair<std::string_view, double>, 23> prefixes{{
      {"y", 1e-24},   {"z", 1e-21}, {"a", 1e-18}, {"f", 1e-15}, {"p", 1e-12}, {"n", 1e-9}, {"mu", 1e-6}, {"\xc2\xb5", 1e-6},
      {"\xb5", 1e-6}, {"m", 1e-3},  {"c", 1e-2},  {"d", 1e-1},  {"", 1.0},    {"da", 1e1}, {"h", 1e2},   {"k", 1e3},
      {"M", 1e6},     {"G", 1e9},   {"T", 1e12},  {"P", 1e15},  {"E", 1e18},  {"Z", 1e21}, {"Y", 1e24},
  }};
  if (code.empty() || code.back() != base) return std::nullopt;
  const std::string_view prefix = code.substr(0, code.size() - 1);
  for (const auto& [name, size] : prefixes) {
    // The SI base of mass is the kilogram: "g" is a thousandth of it. Division keeps decimal sizes exact.
    if (prefix == name) return base == 'g' ? size / 1e3 : size;
  }
  return std::nullopt;
}

}  // namespace abut::model
