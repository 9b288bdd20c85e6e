// The time history of a run (NAME_th.csv), read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace abut::report {

struct History {
  std::vector<std::string> names;            ///< the first is "time"
  std::vector<std::vector<double>> columns;  ///< #names, each #rows
  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
};

/// A last row that is not complete (a run that was killed) is left out; empty when there is no such file.
[[nodiscard]] History read_history(const std::filesystem::path& file);

}  // namespace abut::report
