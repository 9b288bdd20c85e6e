#include <fmt/core.h>

#include <fstream>

#include "abut/contact/call_log.hpp"
#include "commands.hpp"
#include "core/diagnostic.hpp"

namespace abut::app {

int replay_command(const ReplayArguments& arguments) {
  std::ifstream log(arguments.log, std::ios::binary);
  if (!log) throw RunError("cannot read '" + arguments.log.string() + "'");
  if (arguments.steps) {
    fmt::print("{:>8} {:>14} {:>14} {:>8} {:>14} {:>14} {:>14} {:>14}  {}\n", "step", "time", "dt", "contacts", "penetration", "CE", "FW",
               "CX", "bits");
  }
  const contact::Replay result = contact::replay(log, [&](const contact::ReplayedStep& s) {
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
