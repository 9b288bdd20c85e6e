// Reading a deck for a command: the model, the files it came from, and every finding.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "model/model.hpp"

namespace abut::app {

struct DeckInput {
  model::Model model;
  std::vector<std::string> files;
  Diagnostics findings;
};

/// Reads and interprets; the model is usable only when the findings have no error.
[[nodiscard]] DeckInput read_deck(const std::filesystem::path& deck);

/// Findings on standard error, one per line.
void print_findings(const Diagnostics& findings);

}  // namespace abut::app
