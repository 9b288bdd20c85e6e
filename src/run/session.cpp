#include "run/session.hpp"

#include <fmt/format.h>

#include <abut_commit.hpp>  // written by cmake/AbutCommit.cmake
#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "output/progress.hpp"
#include "output/run_outputs.hpp"
#include "output/run_record.hpp"
#include "simd/isa.hpp"

#ifndef ABUT_VERSION
#define ABUT_VERSION "unknown"
#endif

namespace abut {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

output::RunInfo run::program_info() {
  output::RunInfo info;
  info.version = ABUT_VERSION;
  info.commit = ABUT_COMMIT;
  info.compiler = compiler_name();
  info.instruction_set = std::string(simd::name(simd::active_isa()));
  return info;
}

namespace {

void check_settings(const Model& model, const RunSettings& settings) {
  run::check_choices(model.impl().model, settings.choices);
  std::set<Id> recorded;
  for (const ContactRecording& r : settings.recordings) {
    (void)run::interface_of(model.impl().model, r.interface_id, "recording");
    if (!recorded.insert(r.interface_id).second)
      throw RunError(fmt::format("recording of interface {}: it is asked for twice", r.interface_id));
    if (!(r.from >= 0.0 && r.from <= r.to && std::isfinite(r.from)))
      throw RunError(fmt::format(
          "recording of interface {} from {} to {}: no time is between these; write two times, 0 or more, the earlier one first",
          r.interface_id, r.from, r.to));
  }
  if (!settings.recordings.empty() && settings.output.empty()) throw RunError("recordings of interfaces need a run folder");
}

}  // namespace

Run::Impl::Impl(const Model& model_, const RunSettings& settings_, run::Checkpoint* from, bool resume)
    : model(model_), settings(settings_) {
  if (settings.threads <= 0) settings.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  check_settings(model, settings);
  model = run::projected(model, settings.choices);
  before.push_back({"read", model.impl().read_seconds});
  auto phase = Clock::now();
  init::FacingShares facing;
  Inspection inspection = run::inspect(model.impl().model, settings.choices, false, &facing);
  before.push_back({"inspect", seconds_since(phase)});

  Diagnostics findings;
  for (const Diagnostic& d : model.findings()) findings.add(d);
  for (const ContactFinding& c : inspection.contact) findings.add(to_diagnostic(c));
  if (findings.has_errors() && !settings.allow_findings) throw InputError(std::move(findings));

  info = run::program_info();
  info.threads = settings.threads;
  info.profile = settings.choices.rules == Rules::reference ? "reference" : "standard";
  for (const InterfaceChoice& choice : settings.choices.interfaces) info.interfaces.push_back(to_string(choice));
  info.hash_every = settings.hash_every;
  info.model_fingerprint = model.fingerprint();
  info.decks.assign(model.files().begin(), model.files().end());
  info.findings = findings.all();
  info.contact = std::make_shared<const std::vector<ContactFinding>>(std::move(inspection.contact));

  phase = Clock::now();
  cycle::RunOptions options = run::options_of(settings.choices, settings.threads);
  options.hash_every = settings.hash_every;
  options.facing = std::move(facing);
  call_logs_.resize(settings.recordings.size());
  for (std::size_t k = 0; k < settings.recordings.size(); ++k) {
    const ContactRecording& r = settings.recordings[k];
    options.recordings.push_back({r.interface_id, r.from, r.to, &call_logs_[k],
                                  fmt::format("{}, deck {}, interface {}", version_text(), model.name(), r.interface_id)});
  }
  cycle = std::make_unique<cycle::Cycle>(model.impl().model, options);
  if (resume) info.resumed = {from->info.cycle, from->info.time, model.run_number()};
  if (from != nullptr) {
    // The state before any file: a checkpoint that does not fit leaves the files as they are.
    cycle->persist(from->archive);
    if (cycle->hash() != from->info.hash) throw state::ArchiveError("the state in it is not the one that was saved");
  }
  open_outputs();
  if (from != nullptr) restore_outputs(*from, resume);
  before.push_back({"init", seconds_since(phase)});
  start = Clock::now();
}

void Run::Impl::open_outputs() {
  watches_ = output::add_watches(sinks, info);
  if (!settings.output.empty()) {
    if (!info.resumed) lock.emplace(settings.output);
    files_ = output::add_run_outputs(sinks, {settings.output, model.name()}, info, [this] { return timings(); });
  }
  for (std::size_t k = 0; k < call_logs_.size(); ++k) {
    const std::filesystem::path path = output::RunFolder{settings.output, model.name()}.contact_calls(settings.recordings[k].interface_id);
    call_logs_[k].open(path, std::ios::binary);
    if (!call_logs_[k]) throw RunError("cannot write '" + path.string() + "'");
  }
  if (settings.record_history) {
    auto memory = std::make_unique<run::MemoryHistory>(history, model.impl().model);
    memory_ = memory.get();
    sinks.add(std::move(memory));
  }
  if (settings.progress) sinks.add(std::make_unique<output::Progress>(output::console_progress()));
}

void Run::Impl::tell(std::string code, std::string text, const std::filesystem::path& file) {
  Diagnostic d{Severity::warning, std::move(code), {file.string(), 0, {}, {}, 0, 0}, std::move(text)};
  info.during->push_back({std::move(d), 0, cycle->state().times.t, cycle->state().times.cycle, 0.0, {}, {}});
}

int Run::Impl::checkpoint_every() const {
  return settings.checkpoint_every > 0 ? settings.checkpoint_every : model.impl().model.controls.restart_every;
}

std::vector<PhaseTime> Run::Impl::timings() const {
  std::vector<PhaseTime> all = before;
  for (PhaseTime& phase : cycle->phases()) all.push_back(std::move(phase));
  all.push_back({"run", seconds_since(start)});
  return all;
}

bool Run::Impl::advance() {
  if (over) return false;
  if (cycle->finished()) {
    finish(Outcome::Kind::finished, "the final time is reached");
    return false;
  }
  if (settings.interrupt != nullptr && settings.interrupt->load(std::memory_order_relaxed)) {
    finish(Outcome::Kind::interrupted, "interrupted by the user");
    return false;
  }
  try {
    cycle->advance(sinks);
  } catch (const std::exception& error) {
    const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    fail(memory ? "there is not enough memory" : error.what());
  }
  if (cycle->finished()) {
    finish(Outcome::Kind::finished, "the final time is reached");
  } else if (checkpoint_every() > 0 && cycle->state().times.cycle % checkpoint_every() == 0) {
    keep_checkpoint();
  }
  return true;
}

const Outcome& Run::Impl::finish(Outcome::Kind kind, std::string_view message) {
  if (over) return outcome;
  try {
    cycle->begin(sinks);  // files of a run without a cycle are complete, too
  } catch (const std::exception& error) {
    if (kind != Outcome::Kind::failed) fail(error.what());  // which comes back here and ends what was begun
  }
  if (kind != Outcome::Kind::failed) keep_checkpoint();
  over = true;
  outcome = {kind, std::string(message), cycle->state().times.cycle, cycle->state().times.t};
  constexpr double worth_a_word = 0.05;
  if (const double error = cycle->balance().err; kind != Outcome::Kind::failed && std::abs(error) > worth_a_word) {
    tell("run.energy_error",
         fmt::format(
             "at the end {:.3g} % of the largest energy has been {} by no term of the balance: a smaller time step (/DT scale) shows "
             "whether the result depends on it",
             100.0 * std::abs(error), error > 0.0 ? "made" : "lost"));
  }
  constexpr double much_hourglass = 0.1;
  if (const Balance& b = cycle->balance(); kind != Outcome::Kind::failed && b.he > much_hourglass * b.largest) {
    tell("run.hourglass_energy",
         fmt::format("at the end {:.3g} % of the largest energy has gone into hourglass modes (HE), more than {:g} %: motions of the mesh, "
                     "not of the body; a finer or more regular mesh or another formulation shows whether the result depends on them",
                     100.0 * b.he / b.largest, 100.0 * much_hourglass));
  }
  constexpr double much_mass = 0.05;
  if (const double share = output::mass_error(cycle->balance()); kind != Outcome::Kind::failed && share > much_mass) {
    tell("run.added_mass",
         fmt::format("/DT/NODA/CST has added {:.3g} % to the mass, more than {:g} %: much for a run in which inertia matters; a smaller "
                     "minimum step adds less",
                     100.0 * share, 100.0 * much_mass));
  }
  for (std::size_t k = 0; k < call_logs_.size(); ++k) {
    if (call_logs_[k].tellp() != 0) continue;
    const ContactRecording& r = settings.recordings[k];
    tell("run.nothing_recorded",
         fmt::format("the call log of interface {} is empty: the run has no call of it between times {:.6g} and {:.6g}", r.interface_id,
                     r.from, r.to));
  }
  const std::optional<output::FolderLock> until_the_files_end = std::exchange(lock, {});
  try {
    sinks.end(outcome);
  } catch (const std::exception& error) {
    if (kind == Outcome::Kind::failed) return outcome;  // the first failure is the one that counts
    outcome.kind = Outcome::Kind::failed;
    outcome.message = error.what();
    throw RunError(outcome.message);
  }
  return outcome;
}

void Run::Impl::fail(std::string_view message) {
  finish(Outcome::Kind::failed, message);
  throw RunError(outcome.message);
}

std::string version_text() {
  const output::RunInfo info = run::program_info();
  return fmt::format("abut {}{}, {}, {}", info.version, info.commit.empty() ? "" : " (" + info.commit + ")", info.compiler,
                     info.instruction_set);
}

}  // namespace abut
