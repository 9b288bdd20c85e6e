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

/// Turns contact surfaces where that is asked for, writes the changed deck, and adds what was done to the findings.
void orient(DeckInput& input, const std::filesystem::path& deck, const std::filesystem::path& write_deck);

/// Findings of this severity and worse on standard error, one per line.
void print_findings(const Diagnostics& findings, Severity from = Severity::note);

}  // namespace abut::app
