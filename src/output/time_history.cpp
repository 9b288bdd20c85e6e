#include "output/time_history.hpp"

#include <fmt/format.h>

#include <iterator>

namespace abut::output {

void TimeHistory::begin(const cycle::Snapshot& first) {
  columns_ = make_history_columns(*first.model, ElementLookup(*first.model, first.groups)).columns;
  if (opening_ == Opening::resumed && !file_.empty()) return;  // it has its header
  row_ = "time";
  for (const HistoryColumn& column : columns_) row_ += "," + column.name;
  row_ += '\n';
  file_.append(row_);
}

void TimeHistory::cycle(const cycle::Snapshot& now) {
  if (!now.history_due) return;
  row_.clear();
  fmt::format_to(std::back_inserter(row_), "{}", now.state->times.t);
  for (const HistoryColumn& column : columns_) fmt::format_to(std::back_inserter(row_), ",{}", column.value(now));
  row_ += '\n';
  file_.append(row_);
}

void TimeHistory::end(const cycle::Outcome&) { file_.close(); }

}  // namespace abut::output
