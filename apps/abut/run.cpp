#include "abut/run.hpp"

#include <fmt/core.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <utility>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "commands.hpp"
#include "contact_choices.hpp"
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

struct Manner {
  bool quiet = false, timing = false;
};

/// Wall time per phase; of the phases of a cycle also the share of the whole run. "elements shells" and the like are parts of "elements".
/// @param cycles  that the run has advanced
void print_timings(const Run& run, std::int64_t cycles) {
  const std::vector<PhaseTime> timings = run.timings();
  double whole = 0.0;
  for (const PhaseTime& phase : timings) whole = phase.name == "run" ? phase.seconds : whole;
  for (const PhaseTime& phase : timings) {
    const bool before = phase.name == "read" || phase.name == "inspect" || phase.name == "init";
    const std::string share = before || whole <= 0.0 ? "" : fmt::format(" {:>6.1f} %", 100.0 * phase.seconds / whole);
    fmt::print("{:<24} {:>10.3f} s{}\n", phase.name, phase.seconds, share);
  }
  if (whole <= 0.0) return;
  fmt::print("{:<24} {:>10.4g} element-cycles/s\n", "speed",
             static_cast<double>(run.model().element_count()) * static_cast<double>(cycles) / whole);
}

/// To its end, with what happens on the console. @return whether it got there
bool carry_out(Run& run, const Manner& manner) {
  const Model& model = run.model();
  if (!manner.quiet) {
    fmt::print("{}: {} nodes, {} elements, {} interfaces, ", model.name(), model.coordinates().size(), model.element_count(),
               model.interfaces().size());
    if (run.cycle() > 0) fmt::print("from cycle {}, time {:.6g} ", run.cycle(), run.time());
    fmt::print("until {:.6g} {}; results in {}\n", model.end_time(), model.units().time_name, run.output().string());
    std::fflush(stdout);
  }
  const std::size_t known = run.findings().size();
  const std::int64_t first_cycle = run.cycle();
  for (const RunFinding& f : run.findings()) {
    if (f.cycle == run.cycle() && run.cycle() > 0) fmt::print(stderr, "{}\n", to_string(f.diagnostic));
  }
  try {
    run.advance_to_end();
  } catch (const RunError&) {  // outcome() has it
  }
  for (const RunFinding& f : run.findings().subspan(known)) fmt::print(stderr, "{}\n", to_string(f.diagnostic));
  const Outcome& outcome = run.outcome();
  const bool good = outcome.kind == Outcome::Kind::finished;
  if (!manner.quiet || !good) { fmt::print(good ? stdout : stderr, "{} {}\n", model.name(), to_string(outcome)); }
  if (manner.timing) print_timings(run, run.cycle() - first_cycle);
  return good;
}

/// The run, then those of the later Engine decks.
int carry_out_all(Run run, const Manner& manner, ResumeSettings settings) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  while (carry_out(run, manner)) {
    if (run.model().run_number() >= run.model().last_run_number()) return 0;
    settings.deck = run.model().path();
    run = Run::resume(run.output(), settings);
  }
  return 1;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const Severity least = arguments.quiet ? Severity::warning : Severity::note;
  const ReadOptions options{.orient = arguments.orient, .write_deck = arguments.write_deck, .run = 1};
  const Model model = Model::read(arguments.deck, options);
  for (int n = 2; n <= model.last_run_number(); ++n) {
    (void)Model::read(arguments.deck,
                      {.orient = options.orient, .write_deck = {}, .run = n});  // faults of later decks before anything runs
  }
  if (model.end_time() <= 0.0) {
    fmt::print(stderr,
               "{}: not run: there is no Engine deck {}_0001.rad beside the Starter deck (it gives the final time and the outputs)\n",
               model.name(), model.name());
    return 1;
  }
  RunSettings settings;
  settings.threads = arguments.threads;
  settings.choices = choices_of(arguments.profile, arguments.interfaces);
  settings.recordings = contact_recordings(arguments.contact_records);
  settings.output = arguments.output.empty() ? std::filesystem::path(model.name()) : arguments.output;
  settings.checkpoint_every = arguments.checkpoint_every;
  settings.hash_every = arguments.hash_every;
  settings.record_history = false;
  settings.progress = !arguments.quiet;
  settings.allow_findings = arguments.allow_findings;
  settings.interrupt = &interrupted;
  ResumeSettings later;
  later.threads = arguments.threads;
  later.record_history = false;
  later.progress = !arguments.quiet;
  later.interrupt = &interrupted;
  try {
    Run run(model, settings);
    print_findings(run.initial_findings(), least);
#ifdef __GLIBC__
    malloc_trim(0);  // small pieces of what initialisation used
#endif
    return carry_out_all(std::move(run), {arguments.quiet, arguments.timing}, later);
  } catch (const InputError& error) {
    print_findings(error.diagnostics().all(), least);
    fmt::print(stderr, "{}: not run; correct the contact (see docs/findings), or run with --allow-findings\n", model.name());
    return 1;
  }
}

int resume_command(const ResumeArguments& arguments) {
  ResumeSettings settings;
  settings.deck = arguments.deck;
  settings.threads = arguments.threads;
  settings.checkpoint_every = arguments.checkpoint_every;
  settings.record_history = false;
  settings.progress = !arguments.quiet;
  settings.interrupt = &interrupted;
  return carry_out_all(Run::resume(arguments.folder, settings), {arguments.quiet, arguments.timing}, settings);
}

}  // namespace abut::app
