#include "cycle/run.hpp"

#include <chrono>
#include <sstream>
#include <utility>

#include "cycle/cycle.hpp"

namespace abut::cycle {

namespace {

std::string_view kind_name(StepController::Kind kind) {
  switch (kind) {
    case StepController::Kind::none:
      return "nothing";
    case StepController::Kind::shell:
      return "shell";
    case StepController::Kind::sh3n:
      return "triangle";
    case StepController::Kind::brick:
      return "brick";
    case StepController::Kind::tetra:
      return "tetrahedron";
    case StepController::Kind::node:
      return "node";
    case StepController::Kind::interface:
      return "contact at node";
    case StepController::Kind::fixed:
      return "the deck's step limit";
  }
  return "?";
}

/// Sees one cycle and forgets it.
class NullSink final : public Sink {
 public:
  void begin(const Snapshot&) override {}
  void cycle(const Snapshot&) override {}
  void end(const Outcome&) override {}
};

}  // namespace

RunReport run(const model::Model& model, const RunOptions& options, Sink& sink) {
  RunReport report;
  Outcome& outcome = report.outcome;
  const auto start = std::chrono::steady_clock::now();
  Cycle cycle(model, options);
  if (options.phases != nullptr) {
    options.phases->push_back({"init", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
  }
  try {
    while (!cycle.finished()) {
      if (options.interrupt != nullptr && options.interrupt->load(std::memory_order_relaxed)) {
        outcome = {Outcome::Kind::interrupted, "interrupted by the user", 0, 0.0};
        break;
      }
      cycle.advance(sink);
    }
    if (outcome.kind == Outcome::Kind::finished) outcome.message = "the final time is reached";
  } catch (const RunError& error) { outcome = {Outcome::Kind::failed, error.what(), 0, 0.0}; }
  outcome.cycles = cycle.state().times.cycle;
  outcome.time = cycle.state().times.t;
  if (options.phases != nullptr) {
    for (PhaseTime& phase : cycle.phases()) options.phases->push_back(std::move(phase));
  }
  report.element_cycles = cycle.element_count() * static_cast<double>(outcome.cycles);
  report.worst_error = cycle.worst_error();
  report.worst_contact_error = cycle.worst_contact_error();
  report.final_hash = cycle.hash();
  sink.end(outcome);
  return report;
}

std::string describe_first_step(const model::Model& model, const RunOptions& options) {
  Cycle cycle(model, options);
  NullSink sink;
  cycle.advance(sink);
  const StepController& who = cycle.controller();
  std::ostringstream text;
  text << "first time step " << cycle.state().times.h_minus << ", controlled by " << kind_name(who.kind);
  if (who.id != 0) text << ' ' << who.id;
  return text.str();
}

}  // namespace abut::cycle
