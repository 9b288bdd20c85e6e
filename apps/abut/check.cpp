#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "findings.hpp"
#include "output/json.hpp"
#include "output/summary.hpp"
#include "run/loaded_model.hpp"

namespace abut::app {
namespace {

void print_json(bool good, const std::vector<Diagnostic>& findings, const std::vector<std::string>& decks, const Model* model,
                const Inspection& inspection) {
  output::Json j{{"ok", good}, {"decks", decks}, {"findings", output::findings_json(findings)}};
  if (model != nullptr) {
    j["contact"] = output::contact_json(inspection.contact);
    j["model"] = output::model_json(model->impl().model, inspection.part_mass);
    if (inspection.first_step > 0.0) j["step"] = output::first_step_text(inspection);
  }
  fmt::print("{}", output::json_text(j));
}

}  // namespace

int check_command(const CheckArguments& arguments) {
  std::vector<Diagnostic> findings;
  try {
    const Model model = Model::read(arguments.deck, {.orient = arguments.orient, .write_deck = arguments.write_deck});
    const Inspection inspection = model.inspect(choices_of(arguments.profile, arguments.interfaces), true);
    findings.assign(model.findings().begin(), model.findings().end());
    bool good = true;
    for (const ContactFinding& c : inspection.contact) {
      findings.push_back(to_diagnostic(c));
      good = good && findings.back().severity != Severity::error;
    }
    if (arguments.json) {
      print_json(good, findings, {model.files().begin(), model.files().end()}, &model, inspection);
      return good ? 0 : 1;
    }
    print_findings(findings);
    fmt::print("{}", output::model_summary(model.impl().model, inspection.part_mass));
    if (inspection.first_step > 0.0) fmt::print("Time step   {}\n", output::first_step_text(inspection));
    return good ? 0 : 1;
  } catch (const InputError& error) {
    if (arguments.json) {
      print_json(false, error.diagnostics().all(), {arguments.deck.string()}, nullptr, {});
    } else {
      print_findings(error.diagnostics().all());
    }
    return 1;
  }
}

}  // namespace abut::app
