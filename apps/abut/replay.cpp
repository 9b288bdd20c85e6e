#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>

#include "abut/contact/call_log.hpp"
#include "commands.hpp"
#include "core/diagnostic.hpp"

namespace abut::app {

namespace {

contact::Replay replay_file(const std::filesystem::path& path, const std::function<void(const contact::ReplayedStep&)>& each) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) throw RunError(fmt::format("cannot read '{}': it is a folder", path.string()));
  std::ifstream log(path, std::ios::binary);
  if (!log) throw RunError(fmt::format("cannot read '{}'", path.string()));
  if (log.peek() == std::ifstream::traits_type::eof()) {
    throw RunError(fmt::format("'{}' is empty: its run had no call of the interface in the time that was to be recorded", path.string()));
  }
  try {
    return contact::replay(log, each);
  } catch (const std::invalid_argument& error) { throw RunError(fmt::format("'{}': {}", path.string(), error.what())); }
}

}  // namespace

int replay_command(const ReplayArguments& arguments) {
  if (arguments.steps) {
    fmt::print("{:>8} {:>14} {:>14} {:>8} {:>14} {:>14} {:>14} {:>14}  {}\n", "step", "time", "dt", "contacts", "penetration", "CE", "FW",
               "CX", "bits");
  }
  const contact::Replay result = replay_file(arguments.log, [&](const contact::ReplayedStep& s) {
    if (!arguments.steps) return;
    const contact::StepResult& r = s.replayed;
    fmt::print("{:>8} {:>14.7e} {:>14.7e} {:>8} {:>14.7e} {:>14.7e} {:>14.7e} {:>14.7e}  {}\n", s.number, s.time, s.dt, r.in_contact,
               r.largest_penetration, r.elastic, r.friction_work, r.made, s.same ? "same" : "DIFFERENT");
  });
  fmt::print("{}\n{}, {} nodes, {} facets, {} steps: ", result.label.empty() ? "(no label)" : result.label, result.kind, result.nodes,
             result.facets, result.steps);
  if (result.different == 0) {
    fmt::print("every bit as recorded\n");
    return 0;
  }
  fmt::print("{} differ from the record, step {} is the first\n", result.different, result.first_different);
  return 1;
}

}  // namespace abut::app
