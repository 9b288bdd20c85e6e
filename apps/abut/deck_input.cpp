#include "deck_input.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "deck/deck.hpp"
#include "init/contact_inspection.hpp"
#include "init/contact_setup.hpp"
#include "model/build.hpp"
#include "oriented_deck.hpp"

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

void orient(DeckInput& input, const std::filesystem::path& deck, const std::filesystem::path& write_deck) {
  const std::vector<init::TurnedSurface> turned = init::orient_contacts(input.model);
  for (const init::TurnedSurface& t : turned) input.findings.add(init::to_diagnostic(input.model, t));
  if (!write_deck.empty()) write_oriented_deck(deck, write_deck, input.model, turned);
}

void print_findings(const Diagnostics& findings, Severity from) {
  for (const Diagnostic& finding : findings.all()) {
    if (finding.severity >= from) fmt::print(stderr, "{}\n", to_string(finding));
  }
  if (findings.has_errors()) fmt::print(stderr, "{} error(s), {} warning(s)\n", findings.error_count(), findings.warning_count());
}

}  // namespace abut::app
