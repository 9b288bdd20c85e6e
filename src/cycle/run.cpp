#include "cycle/run.hpp"

#include <chrono>
#include <utility>

#include "cycle/cycle.hpp"

namespace abut::cycle {

namespace {

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
    while (!cycle.finished()) cycle.advance(sink);
    outcome.message = "the final time is reached";
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

FirstStep first_step(const model::Model& model, const RunOptions& options) {
  Cycle cycle(model, options);
  NullSink sink;
  cycle.advance(sink);
  return {cycle.state().times.h_minus, cycle.controller()};
}

}  // namespace abut::cycle
