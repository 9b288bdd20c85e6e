// A run from a model to its end.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/profile.hpp"
#include "cycle/sink.hpp"
#include "init/contact_inspection.hpp"
#include "init/contact_options.hpp"
#include "model/model.hpp"

namespace abut::cycle {

using abut::PhaseTime;

/// A call log (abut/contact/call_log.hpp) of one interface, over part of the run.
struct ContactRecording {
  Id interface_id = 0;
  double from = 0.0, to = 1e30;  ///< times
  std::ostream* log = nullptr;   ///< binary; must outlive the run
  std::string label;
};

struct RunOptions {
  int threads = 1;
  Profile profile;
  init::InterfaceChoices contacts;           ///< beyond the cards: normal law, gradual starts
  std::vector<ContactRecording> recordings;  ///< call logs to be written
  bool interfaces = true;                    ///< false: as if the model had none (inspection before a run)
  int hash_every = 0;                        ///< cycles between state hashes, 0 = none
  init::FacingShares facing;                 ///< as the inspection found them where the model has its nodes; empty: not known
  std::vector<PhaseTime>* phases = nullptr;  ///< run() appends the phases here before the sink's end()
};

struct RunReport {
  Outcome outcome;
  double element_cycles = 0.0;       ///< elements times cycles
  double worst_error = 0.0;          ///< largest |ERR|
  double worst_contact_error = 0.0;  ///< largest |CX| over the largest energy term
  std::uint64_t final_hash = 0;
};

/// Runs to the end of the deck, an interrupt or a failure; `sink` sees every cycle and is always ended.
/// @throws nothing for a run that fails (Outcome::failed says why); RunError from a sink passes through after end()
[[nodiscard]] RunReport run(const model::Model& model, const RunOptions& options, Sink& sink);

/// First step of the model and what controls it.
struct FirstStep {
  double step = 0.0;
  StepController controller;
};
[[nodiscard]] FirstStep first_step(const model::Model& model, const RunOptions& options);

}  // namespace abut::cycle
