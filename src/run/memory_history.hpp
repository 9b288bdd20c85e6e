// The time history of a run in memory.
#pragma once

#include <filesystem>
#include <vector>

#include "abut/run.hpp"
#include "cycle/sink.hpp"
#include "output/history_columns.hpp"

namespace abut::run {

/// Appends a row to the host's History whenever `history_due`: the columns of NAME_th.csv.
class MemoryHistory final : public cycle::Sink {
 public:
  /// The columns have their names from the start.
  MemoryHistory(History& history, const model::Model& model);
  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome&) override {}
  void persist(state::Archive& a) override;
  /// The rows of NAME_th.csv before a time: of a run that kept none in memory. @throws state::ArchiveError when its columns are others
  void read(const std::filesystem::path& file, double before);

 private:
  History& history_;
  std::vector<output::HistoryColumn> columns_;
};

}  // namespace abut::run
