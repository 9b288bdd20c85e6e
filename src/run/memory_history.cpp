#include "run/memory_history.hpp"

namespace abut::run {

MemoryHistory::MemoryHistory(History& history, const model::Model& model) : history_(history) {
  history_.names = {"time"};
  for (const output::HistoryColumn& column : output::make_history_columns(model, {}).columns) history_.names.push_back(column.name);
}

void MemoryHistory::begin(const cycle::Snapshot& first) {
  columns_ = output::make_history_columns(*first.model, output::ElementLookup(*first.model, first.groups)).columns;
}

void MemoryHistory::cycle(const cycle::Snapshot& now) {
  if (!now.history_due) return;
  history_.values.push_back(now.state->times.t);
  for (const output::HistoryColumn& column : columns_) history_.values.push_back(column.value(now));
}

void MemoryHistory::persist(state::Archive& a) {
  a.each_growing(history_.names, [&a](std::string& name) { a(name); });
  a.growing(history_.values);
}

}  // namespace abut::run
