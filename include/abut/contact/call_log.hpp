// The call log: what a host gave an interface, and the same calls made again without the host. A log is a bug report.
//
//   interface.record(file, "my solver 3.1, job 42, interface 7");   // at any time: the log begins with the history so far
//   ... the run goes on ...
//   interface.stop_recording();
//
//   const Replay r = replay(file);   // or: abut replay FILE
//
// A log holds the options, the surfaces, their state and the history at its beginning, then for each step the positions, velocities and
// masses of the interface's nodes (no others), what their force and stiffness spans held before, a digest of what they held after, and
// the results. Node numbers are those of the interface, in the host's order. 48 bytes per node and step, plus 24 where masses change.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "abut/contact/options.hpp"

namespace abut::contact {

/// One step of a log, made again.
struct ReplayedStep {
  std::int64_t number = 0;  ///< from 0, in the log
  double time = 0.0;        ///< t^n
  double dt = 0.0;          ///< h_-
  StepResult recorded, replayed;
  bool same = false;  ///< forces, stiffness and results agree in every bit
};

struct Replay {
  std::string label;  ///< what the host called it
  std::string kind;   ///< "two surfaces", "nodes to surface", "both sides"
  std::int64_t nodes = 0, facets = 0;
  std::int64_t steps = 0;
  std::int64_t different = 0;         ///< steps that do not agree in every bit
  std::int64_t first_different = -1;  ///< number of the first of them
};

/// Makes the calls of a log again, on an interface of its own.
/// @param log   opened in binary mode, at its beginning
/// @param each  called after every step; what it throws ends the replay and comes through
/// @return counts; a step that differs is no error, see Replay::different
/// @throws std::invalid_argument when the file is no log, of another version or byte order, damaged, or ends inside a record;
///         the message names the record and its place in the file
Replay replay(std::istream& log, const std::function<void(const ReplayedStep&)>& each = {});

}  // namespace abut::contact
