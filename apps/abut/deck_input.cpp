#include "deck_input.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "deck/deck.hpp"
#include "init/contact_setup.hpp"
#include "model/build.hpp"

namespace abut::app {

DeckInput read_deck(const std::filesystem::path& deck) {
  DeckInput input;
  const deck::DeckPair pair = deck::read(deck, input.findings);
  input.files = pair.starter.files;
  input.files.insert(input.files.end(), pair.engine.files.begin(), pair.engine.files.end());
  input.model = model::build(pair, input.findings);
  if (!input.findings.has_errors()) init::settle_initial_penetrations(input.model, input.findings);
  return input;
}

void print_findings(const Diagnostics& findings) {
  for (const Diagnostic& finding : findings.all()) fmt::print(stderr, "{}\n", to_string(finding));
  if (findings.has_errors()) fmt::print(stderr, "{} error(s), {} warning(s)\n", findings.error_count(), findings.warning_count());
}

}  // namespace abut::app
