// One line on the console that says how far a run is.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "cycle/sink.hpp"

namespace abut::output {

struct ProgressOptions {
  bool terminal = false;      ///< rewrite one line in place; else a line per `listing_due`
  double min_interval = 0.2;  ///< seconds between two lines
};

/// Cycle, time, dt, what controls it, energy error, rate and time left. On a terminal one line is rewritten in place; into
/// a file or a pipe a line goes at each listing interval. Never more often than `min_interval`.
class Progress final : public cycle::Sink {
 public:
  using Clock = std::function<double()>;  ///< seconds, monotonic
  using Writer = std::function<void(std::string_view)>;

  Progress(ProgressOptions options, Writer write, Clock clock);

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome& outcome) override;

 private:
  ProgressOptions options_;
  Writer write_;
  Clock clock_;
  Index elements_ = 0;
  double start_ = 0.0, last_ = 0.0, first_time_ = 0.0;
  std::int64_t first_cycle_ = 0;
  bool printed_ = false;
};

/// Progress on standard error, in place when that is a terminal.
[[nodiscard]] Progress console_progress();

}  // namespace abut::output
