// NAME.out: what a Radioss user opens first.
#pragma once

#include <string>

#include "cycle/sink.hpp"
#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/run_record.hpp"

namespace abut::output {

/// Header (program, decks, settings, model, findings, outputs that were asked for and are not written), a line per
/// `listing_due`, and a summary that says why the run ended. Every line is in the file when the call returns.
class Listing final : public cycle::Sink {
 public:
  Listing(const RunFolder& folder, RunInfo info);

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome& outcome) override;
  void persist(state::Archive& a) override;

 private:
  void say_findings();

  AppendFile file_;
  RunInfo info_;
  std::size_t said_ = 0;  ///< findings of the run that are in the file
  RunRecord record_;
  int lines_ = 0;  ///< of the cycle listing, for repeating its header
};

}  // namespace abut::output
