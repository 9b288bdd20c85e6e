#include "run/memory_history.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <string>

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

void MemoryHistory::read(const std::filesystem::path& file, double before) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  if (line != fmt::format("{}", fmt::join(history_.names, ","))) {
    throw state::ArchiveError(fmt::format("'{}' has other columns than the run", file.string()));
  }
  while (std::getline(in, line)) {
    const std::size_t row = history_.values.size();
    const char* const end = line.data() + line.size();
    for (const char* at = line.data(); at < end; ++at) {  // behind each number stands a comma, or the end
      double value = 0.0;
      at = std::from_chars(at, end, value).ptr;
      history_.values.push_back(value);
    }
    if (history_.values.size() - row == history_.names.size() && history_.values[row] < before) continue;
    history_.values.resize(row);  // of cycles that are to come again
    return;
  }
}

}  // namespace abut::run
