#include <fmt/core.h>

#include <algorithm>
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

/// A deck with what was found in it, in all of its runs.
struct Checked {
  Model model;                        ///< as run 1 begins
  std::vector<std::string> decks;     ///< files of all runs
  std::vector<model::Controls> runs;  ///< of run 1 and the later ones
  std::vector<Diagnostic> findings;
};

/// @throws InputError with the errors of all Engine decks at once
Checked read_all_runs(const CheckArguments& arguments) {
  Model model = Model::read(arguments.deck, {.orient = arguments.orient, .write_deck = arguments.write_deck, .run = 0});
  Checked c{model, {model.files().begin(), model.files().end()}, {model.impl().model.controls}, {}};
  c.findings.assign(model.findings().begin(), model.findings().end());
  // What a later deck changes is judged as it was before, too.
  for (int run = model.last_run_number() - 1; run > 0; --run) {
    c.model = Model::read(arguments.deck, {.orient = arguments.orient, .write_deck = {}, .run = run});
    c.runs.insert(c.runs.begin(), c.model.impl().model.controls);
    for (const Diagnostic& d : c.model.findings()) {
      const auto same = [text = to_string(d)](const Diagnostic& other) { return to_string(other) == text; };
      if (std::none_of(c.findings.begin(), c.findings.end(), same)) c.findings.push_back(d);
    }
  }
  return c;
}

void print_json(bool good, const std::vector<Diagnostic>& findings, const std::vector<std::string>& decks, const Checked* checked,
                const Inspection& inspection) {
  output::Json j{{"ok", good}, {"decks", decks}, {"findings", output::findings_json(findings)}};
  if (checked != nullptr) {
    j["contact"] = output::contact_json(inspection.contact);
    j["model"] = output::model_json(checked->model.impl().model, inspection.part_mass);
    j["runs"] = output::Json::array();
    for (const model::Controls& run : checked->runs) j["runs"].push_back({{"run", run.run_number}, {"t_end", run.t_end}});
    if (inspection.first_step > 0.0) j["step"] = output::first_step_text(inspection);
  }
  fmt::print("{}", output::json_text(j));
}

}  // namespace

int check_command(const CheckArguments& arguments) {
  std::vector<Diagnostic> findings;
  try {
    const Checked checked = read_all_runs(arguments);
    const Inspection inspection = checked.model.inspect(choices_of(arguments.profile, arguments.interfaces), true);
    findings = checked.findings;
    bool good = true;
    for (const ContactFinding& c : inspection.contact) {
      findings.push_back(to_diagnostic(c));
      good = good && findings.back().severity != Severity::error;
    }
    if (arguments.json) {
      print_json(good, findings, checked.decks, &checked, inspection);
      return good ? 0 : 1;
    }
    print_findings(findings);
    fmt::print("{}", output::model_summary(checked.model.impl().model, inspection.part_mass));
    for (std::size_t run = 1; run < checked.runs.size(); ++run) fmt::print("{}", output::run_summary(checked.runs[run]));
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
