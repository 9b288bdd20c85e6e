#include "report/history.hpp"

#include <charconv>
#include <fstream>
#include <string_view>

namespace abut::report {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t comma = line.find(',');
    out.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

bool parse(std::string_view text, double& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

History read_history(const std::filesystem::path& file) {
  History history;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) return history;
  for (const std::string_view name : split(line)) history.names.emplace_back(name);
  history.columns.resize(history.names.size());
  std::vector<double> row(history.names.size());
  while (std::getline(in, line)) {
    const std::vector<std::string_view> cells = split(line);
    bool complete = cells.size() == row.size() && !in.eof();
    for (std::size_t k = 0; complete && k < row.size(); ++k) complete = parse(cells[k], row[k]);
    if (!complete) continue;
    for (std::size_t k = 0; k < row.size(); ++k) history.columns[k].push_back(row[k]);
  }
  return history;
}

}  // namespace abut::report
