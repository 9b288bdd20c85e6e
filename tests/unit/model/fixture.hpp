// A deck in a string -> Context with the parts of the model that this folder's tests need.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "model/reader.hpp"

namespace abut::model::testing {

using Strings = std::vector<std::string>;

/// Owns everything a Context points to.
struct Reading {
  Diagnostics diagnostics;
  deck::Deck deck;
  Model model;
  Context context;

  Reading() = default;
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  void attach() {
    context.deck = &deck;
    context.model = &model;
    context.diagnostics = &diagnostics;
  }
  /// Control cards, mesh and sets of `text`, which needs no /END.
  void read(const std::string& text, const std::string& file = "t_0000.rad") {
    deck = deck::read_starter_text(text + "\n/END\n", file, diagnostics);
    attach();
    read_control(context);
    read_mesh(context);
    read_sets(context);
  }
  /// Messages of errors (or of warnings), each without the severity word.
  [[nodiscard]] std::vector<std::string> messages(Severity severity) const {
    std::vector<std::string> out;
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.severity == severity) out.push_back(to_string(d));
    }
    return out;
  }
  [[nodiscard]] std::vector<std::string> errors() const { return messages(Severity::error); }
};

/// A field of `width` columns, right-justified.
inline std::string field(const std::string& s, std::size_t width) { return s.size() >= width ? s : std::string(width - s.size(), ' ') + s; }
/// A card of 10-column fields.
inline std::string ints(const std::vector<long>& values) {
  std::string s;
  for (const long v : values) s += field(std::to_string(v), 10);
  return s + "\n";
}
/// A card of 20-column fields.
inline std::string reals(const std::vector<std::string>& values) {
  std::string s;
  for (const std::string& v : values) s += field(v, 20);
  return s + "\n";
}
inline std::string node(long id, const std::string& x, const std::string& y, const std::string& z) {
  return field(std::to_string(id), 10) + reals({x, y, z});
}

inline const char* begin_2022 =
    "/BEGIN\nt\n      2022         0\n                  kg                   m                   s\n                  kg                   "
    "m                   s\n";
inline const char* steel = "/MAT/ELAST/1\nsteel\n                7800\n        210000000000                  .3\n";
inline const char* shell_property = "/PROP/SHELL/1\nshell\n         0\n                   0\n         0         0                 .01\n";
inline const char* solid_property = "/PROP/SOLID/2\nsolid\n         0\n                   0\n";
inline const char* shell_part = "/PART/1\nplate\n         1         1\n";
inline const char* solid_part = "/PART/2\nblock\n         2         1\n";

/// Folder of the shared decks; empty when there is none.
inline std::filesystem::path decks_folder() {
  const char* variable = std::getenv("ABUT_DECKS");
  const std::filesystem::path folder =
      variable != nullptr ? std::filesystem::path(variable) : std::filesystem::path(ABUT_SOURCE_DIR) / ".." / "shared" / "decks";
  std::error_code error;
  return std::filesystem::is_directory(folder, error) ? folder : std::filesystem::path();
}

}  // namespace abut::model::testing
