// NAME_th.csv: one row per history interval.
#pragma once

#include <string>
#include <vector>

#include "cycle/sink.hpp"
#include "output/files.hpp"
#include "output/history_columns.hpp"

namespace abut::output {

/// Writes `time` and the columns of history_columns.hpp whenever `history_due` (numerics.md 2.4: the cycle decides),
/// comma separated, each number in the shortest form that reads back as the same double. A row is in the file when
/// cycle() returns.
class TimeHistory final : public cycle::Sink {
 public:
  explicit TimeHistory(const RunFolder& folder, Opening opening = Opening::fresh) : file_(folder.history(), opening), opening_(opening) {}

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome& outcome) override;
  void persist(state::Archive& a) override { file_.persist(a); }

 private:
  AppendFile file_;
  Opening opening_;
  std::vector<HistoryColumn> columns_;
  std::string row_;
};

}  // namespace abut::output
