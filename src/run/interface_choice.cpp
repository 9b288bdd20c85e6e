// Settings of single interfaces as text: one form for the command line, Python, checkpoints and the run's record.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "abut/diagnostic.hpp"
#include "abut/model.hpp"

namespace abut {
namespace {

template <class T>
using Word = std::pair<std::string_view, T>;
constexpr std::array<Word<contact::Law>, 2> laws{{{"stiffening", contact::Law::stiffening}, {"constant", contact::Law::constant}}};
constexpr std::array<Word<bool>, 2> gaps{{{"auto", true}, {"card", false}}};
constexpr std::array<Word<contact::Initial>, 4> treatments{{{"keep", contact::Initial::keep},
                                                            {"offset", contact::Initial::offset},
                                                            {"project", contact::Initial::project},
                                                            {"ignore", contact::Initial::ignore}}};

[[noreturn]] void refuse(std::string_view text, const std::string& why) { throw RunError(fmt::format("interface {}: {}", text, why)); }

template <class T, std::size_t N>
T named(std::string_view text, std::string_view key, std::string_view word, const std::array<Word<T>, N>& words) {
  std::string all;
  for (const auto& [name, value] : words) {
    if (name == word) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  refuse(text, fmt::format("{} is '{}', expected one of {}", key, word, all));
}

template <class T, std::size_t N>
std::string_view name_of(T value, const std::array<Word<T>, N>& words) {
  for (const auto& [name, its] : words) {
    if (its == value) return name;
  }
  return {};
}

double number(std::string_view text, std::string_view key, std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value >= 0.0) || !std::isfinite(value)) {
    refuse(text, fmt::format("{} is '{}', not a number >= 0", key, word));
  }
  return value;
}

}  // namespace

InterfaceChoice interface_choice(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view id = text.substr(0, colon);
  InterfaceChoice choice;
  if (id != "all") {
    const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), choice.interface_id);
    if (error != std::errc() || end != id.data() + id.size() || choice.interface_id <= 0) {
      refuse(text, fmt::format("'{}' is neither an interface id nor 'all'", id));
    }
  }
  if (colon == std::string_view::npos || colon + 1 == text.size()) refuse(text, "expected KEY=VALUE after the id and a colon");
  std::string_view rest = text.substr(colon + 1);
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) refuse(text, fmt::format("'{}' is not KEY=VALUE", part));
    const std::string_view key = part.substr(0, equals), value = part.substr(equals + 1);
    const auto once = [&](const auto& setting) {
      if (setting) refuse(text, fmt::format("{} is set twice", key));
    };
    if (key == "law") {
      once(choice.law);
      choice.law = named(text, key, value, laws);
    } else if (key == "gap") {
      once(choice.automatic_gap);
      choice.automatic_gap = named(text, key, value, gaps);
    } else if (key == "initial") {
      once(choice.initial);
      choice.initial = named(text, key, value, treatments);
    } else if (key == "damping") {
      once(choice.damping);
      choice.damping = number(text, key, value);
    } else if (key == "depth") {
      once(choice.depth_limit);
      choice.depth_limit = number(text, key, value);
    } else if (key == "start") {
      once(choice.start_duration);
      choice.start_duration = number(text, key, value);
    } else {
      refuse(text, fmt::format("there is no setting '{}'; there are law, gap, initial, damping, depth and start", key));
    }
    if (comma == std::string_view::npos) return choice;
    rest.remove_prefix(comma + 1);
  }
}

std::string to_string(const InterfaceChoice& choice) {
  std::string settings;
  const auto add = [&settings](std::string_view key, const auto& value) {
    settings += fmt::format("{}{}={}", settings.empty() ? "" : ",", key, value);
  };
  if (choice.law) add("law", name_of(*choice.law, laws));
  if (choice.automatic_gap) add("gap", name_of(*choice.automatic_gap, gaps));
  if (choice.initial) add("initial", name_of(*choice.initial, treatments));
  if (choice.damping) add("damping", *choice.damping);
  if (choice.depth_limit) add("depth", *choice.depth_limit);
  if (choice.start_duration) add("start", *choice.start_duration);
  return (choice.interface_id == 0 ? std::string("all") : std::to_string(choice.interface_id)) + ":" + settings;
}

}  // namespace abut
