// Choices are words in Python: one table per enumeration.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace abut::python {

template <class Enum, std::size_t N>
using Names = std::array<std::pair<std::string_view, Enum>, N>;

template <class Enum, std::size_t N>
std::string name_of(Enum value, const Names<Enum, N>& names) {
  for (const auto& [name, known] : names) {
    if (known == value) return std::string(name);
  }
  return "?";
}

/// @throws ValueError that lists the words
template <class Enum, std::size_t N>
Enum named(std::string_view word, const char* argument, const Names<Enum, N>& names) {
  std::string all;
  for (const auto& [name, value] : names) {
    if (name == word) return value;
    all += (all.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  throw pybind11::value_error(std::string(argument) + " is '" + std::string(word) + "', expected one of " + all);
}

}  // namespace abut::python
