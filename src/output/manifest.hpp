// run.json: what ran, with what, how it ended.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cycle/sink.hpp"
#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/run_record.hpp"

namespace abut::output {

/// In what a folder's run.json says that its results are of another run than this: "another model", "another rule set", "other settings of
/// interfaces"; empty where they are alike, so that the results have the same bits, and when there is no run.json that says it.
[[nodiscard]] std::string manifest_difference(const RunFolder& folder, const RunInfo& info);

/// A folder's run.json says that its run has not ended: it goes on, or was killed.
[[nodiscard]] bool manifest_says_running(const RunFolder& folder);

/// Written before the first cycle (outcome "running": that is what a killed run leaves) and at the end, each time as a
/// whole. Keys: abut, decks, settings, model, findings, contact (findings of the contact inspection with all ids), started, resumed, files;
/// at the end also outcome, timings, energies, worst, hashes (16 hexadecimal digits). Numbers that are not finite become null.
class Manifest final : public cycle::Sink {
 public:
  /// @param timings  of this session; asked for at the end and when a checkpoint is written; may be empty
  Manifest(RunFolder folder, RunInfo info, std::function<std::vector<PhaseTime>()> timings);

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override { record_.cycle(now); }
  void end(const cycle::Outcome& outcome) override;
  void persist(state::Archive& a) override;

 private:
  RunFolder folder_;
  RunInfo info_;
  std::function<std::vector<PhaseTime>()> timings_;
  std::vector<PhaseTime> earlier_;  ///< of the sessions before
  RunRecord record_;
  std::string head_;     ///< what begin() wrote, as JSON text
  std::string started_;  ///< when the first session began
  struct Resumed {
    std::int64_t cycle = 0;
    double time = 0.0;
    std::string at;  ///< when
  };
  std::vector<Resumed> resumed_;

  /// Of all sessions of the run.
  [[nodiscard]] std::vector<PhaseTime> all_timings() const;
};

}  // namespace abut::output
