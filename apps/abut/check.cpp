#include <fmt/core.h>

#include <cstdio>

#include "commands.hpp"
#include "deck_input.hpp"
#include "driver.hpp"
#include "output/json.hpp"
#include "output/summary.hpp"

namespace abut::app {

int check_command(const CheckArguments& arguments) {
  DeckInput input = read_deck(arguments.deck);
  const bool readable = !input.findings.has_errors();
  RunSettings settings;
  settings.profile = profile_of(arguments.profile);
  Description description;
  if (readable) {
    if (arguments.orient) orient(input, arguments.deck, arguments.write_deck);
    description = describe_model(input.model, settings, true);
    for (const init::ContactFinding& c : description.contact) input.findings.add(init::to_diagnostic(c));
  }
  const bool good = !input.findings.has_errors();

  if (arguments.json) {
    output::Json j{{"ok", good}, {"decks", input.files}, {"findings", output::findings_json(input.findings.all())}};
    if (readable) {
      j["contact"] = output::contact_json(description.contact);
      j["model"] = output::model_json(input.model, description.part_mass);
      if (!description.step.empty()) j["step"] = description.step;
    }
    fmt::print("{}", output::json_text(j));
    return good ? 0 : 1;
  }
  print_findings(input.findings);
  if (!readable) return 1;
  fmt::print("{}", output::model_summary(input.model, description.part_mass));
  if (!description.step.empty()) fmt::print("Time step   {}\n", description.step);
  return good ? 0 : 1;
}

}  // namespace abut::app
