// Tells which elements a run has deleted (docs/findings/index.md, "During the run").
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cycle/sink.hpp"
#include "output/run_info.hpp"

namespace abut::output {

/// Adds to RunInfo::during one finding per part whose elements go, kept up to date, and one when the last of them is gone.
class ErosionWatch final : public cycle::Sink {
 public:
  static constexpr const char* deleted = "run.elements_deleted";

  explicit ErosionWatch(std::shared_ptr<RunFindings> log) : log_(std::move(log)) {}
  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome&) override {}
  void persist(state::Archive& a) override;

 private:
  struct Part {
    Index elements = 0, gone = 0;
    Index finding = no_index;  ///< in the log
    Id first = 0;              ///< lowest id of those that went first
  };
  std::shared_ptr<RunFindings> log_;
  std::vector<Part> parts_;

  void say(const cycle::Snapshot& now, std::size_t part);
  [[nodiscard]] static Id first_deleted(const cycle::Snapshot& now, std::size_t part);
};

}  // namespace abut::output
