#include "abut/run.hpp"

#include <fmt/core.h>

#include <atomic>
#include <csignal>
#include <cstdio>

#include "commands.hpp"
#include "findings.hpp"

namespace abut::app {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // it is set in a signal handler

/// The first signal asks the run to end after its cycle; a second one ends the process.
extern "C" void on_signal(int signal) {
  interrupted.store(true);
  std::signal(signal, SIG_DFL);
}

/// To its end, with what happens on the console. @return whether it got there
bool carry_out(Run& run, const RunArguments& arguments) {
  const Model& model = run.model();
  if (!arguments.quiet) {
    fmt::print("{}: {} nodes, {} elements, {} interfaces, until {:.6g} {}; results in {}\n", model.name(), model.node_ids().size(),
               model.element_count(), model.interfaces().size(), model.end_time(), model.units().time_name, run.output().string());
    std::fflush(stdout);
  }
  try {
    run.advance_to_end();
  } catch (const RunError&) {  // outcome() has it
  }
  for (const RunFinding& f : run.findings()) fmt::print(stderr, "{}\n", to_string(f.diagnostic));
  const Outcome& outcome = run.outcome();
  const bool good = outcome.kind == Outcome::Kind::finished;
  if (!arguments.quiet || !good) { fmt::print(good ? stdout : stderr, "{} {}\n", model.name(), to_string(outcome)); }
  if (arguments.timing) {
    for (const PhaseTime& phase : run.timings()) fmt::print("{:<24} {:>10.3f} s\n", phase.name, phase.seconds);
  }
  return good;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const Severity least = arguments.quiet ? Severity::warning : Severity::note;
  const Model model = Model::read(arguments.deck, {.orient = arguments.orient, .write_deck = arguments.write_deck});
  RunSettings settings;
  settings.threads = arguments.threads;
  settings.choices = choices_of(arguments.profile, arguments.interface_law);
  settings.output = arguments.output.empty() ? std::filesystem::path(model.name()) : arguments.output;
  settings.hash_every = arguments.hash_every;
  settings.record_history = false;
  settings.progress = !arguments.quiet;
  settings.allow_findings = arguments.allow_findings;
  settings.interrupt = &interrupted;
  try {
    Run run(model, settings);
    print_findings(run.initial_findings(), least);
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    return carry_out(run, arguments) ? 0 : 1;
  } catch (const InputError& error) {
    print_findings(error.diagnostics().all(), least);
    fmt::print(stderr, "{}: not run; correct the contact (see docs/findings), or run with --allow-findings\n", model.name());
    return 1;
  }
}

}  // namespace abut::app
