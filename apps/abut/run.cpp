#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "contact_choices.hpp"
#include "deck_input.hpp"
#include "driver.hpp"
#include "output/progress.hpp"
#include "output/run_outputs.hpp"
#include "output/summary.hpp"
#include "simd/isa.hpp"

#ifndef ABUT_VERSION
#define ABUT_VERSION "unknown"
#endif
#ifndef ABUT_COMMIT
#define ABUT_COMMIT ""
#endif

namespace abut::app {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // it is set in a signal handler

/// The first signal asks the run to end after its cycle; a second one ends the process.
extern "C" void on_signal(int signal) {
  interrupted.store(true);
  std::signal(signal, SIG_DFL);
}

std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

output::RunInfo run_info(const RunArguments& arguments, const RunSettings& settings, const DeckInput& input,
                         const std::vector<init::ContactFinding>& contact) {
  output::RunInfo info;
  info.version = ABUT_VERSION;
  info.commit = ABUT_COMMIT;
  info.compiler = compiler_name();
  info.instruction_set = std::string(simd::name(simd::active_isa()));
  info.threads = settings.threads;
  info.profile = arguments.profile;
  info.interface_law = arguments.interface_law;
  info.contact_ramps = settings.contacts.starts;
  info.hash_every = arguments.hash_every;
  info.decks = input.files;
  info.findings = input.findings.all();
  info.contact = contact;
  return info;
}

}  // namespace

std::string version_text() {
  const std::string commit = ABUT_COMMIT;
  return fmt::format("abut {}{}, {}, {}", ABUT_VERSION, commit.empty() ? "" : " (" + commit + ")", compiler_name(),
                     simd::name(simd::active_isa()));
}

int run_command(const RunArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  DeckInput input = read_deck(arguments.deck);
  if (input.findings.has_errors()) {
    print_findings(input.findings);
    return 1;
  }
  if (arguments.orient) orient(input, arguments.deck, arguments.write_deck);
  const double reading = seconds_since(start);

  RunSettings settings;
  settings.threads = arguments.threads > 0 ? arguments.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  settings.profile = profile_of(arguments.profile);
  settings.contacts = {law_of(arguments.interface_law), gradual_starts(input.model, arguments.contact_ramps)};
  ContactLogs logs = contact_logs(input.model, arguments.contact_records, version_text());
  settings.hash_every = arguments.hash_every;
  const auto inspection_start = std::chrono::steady_clock::now();
  const std::vector<init::ContactFinding> contact = describe_model(input.model, settings, false).contact;
  const double inspecting = seconds_since(inspection_start);
  for (const init::ContactFinding& c : contact) input.findings.add(init::to_diagnostic(c));
  print_findings(input.findings, arguments.quiet ? Severity::warning : Severity::note);
  if (input.findings.has_errors() && !arguments.allow_findings) {
    fmt::print(stderr, "{}: not run; correct the contact (see docs/findings), or run with --allow-findings\n", input.model.name);
    return 1;
  }
  settings.interrupt = &interrupted;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);

  const model::Model& model = input.model;
  const output::RunFolder folder{arguments.output.empty() ? std::filesystem::path(model.name) : arguments.output, model.name};
  std::vector<output::PhaseTime> phases{{"read", reading}, {"inspect", inspecting}};
  const auto run_start = std::chrono::steady_clock::now();
  const output::RunInfo info = run_info(arguments, settings, input, contact);
  const auto sinks = output::open_run_outputs(folder, info, [&phases, run_start] {
    std::vector<output::PhaseTime> all = phases;
    all.push_back({"run", seconds_since(run_start)});
    return all;
  });
  open_contact_logs(logs, folder);
  settings.recordings = logs.recordings;
  if (!arguments.quiet) {
    fmt::print("{}: {} nodes, {} elements, {} interfaces, until {:.6g} {}; results in {}\n", model.name, model.node_count(),
               output::element_count(model), model.interfaces.size(), model.controls.t_end, model.units.time_name,
               folder.directory.string());
    std::fflush(stdout);
    sinks->add(std::make_unique<output::Progress>(output::console_progress()));
  }

  const cycle::Outcome outcome = run_model(model, settings, *sinks, phases);
  for (const output::RunFinding& f : *info.during) fmt::print(stderr, "{}\n", to_string(f.diagnostic));
  const bool good = outcome.kind == cycle::Outcome::Kind::finished;
  if (!arguments.quiet || !good) { fmt::print(good ? stdout : stderr, "{} {}\n", model.name, output::outcome_text(outcome)); }
  if (arguments.timing) {
    phases.push_back({"run", seconds_since(run_start)});
    for (const output::PhaseTime& phase : phases) fmt::print("{:<24} {:>10.3f} s\n", phase.name, phase.seconds);
  }
  return good ? 0 : 1;
}

}  // namespace abut::app
