#include "output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "output/summary.hpp"

namespace abut::output {
namespace {

/// "1:02:03" or "2:03".
std::string duration(double seconds) {
  constexpr double longest = 1e9;
  if (!(seconds >= 0.0) || seconds > longest) return "-";
  const auto s = static_cast<long long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60) : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

Progress::Progress(ProgressOptions options, Writer write, Clock clock)
    : options_(options), write_(std::move(write)), clock_(std::move(clock)) {}

void Progress::begin(const cycle::Snapshot& first) {
  elements_ = element_count(*first.model);
  start_ = clock_();
  last_ = start_ - options_.min_interval;
  first_time_ = first.state->times.t;
  first_cycle_ = first.state->times.cycle;
}

void Progress::cycle(const cycle::Snapshot& now) {
  if (!options_.terminal && !now.listing_due) return;
  const double wall = clock_();
  if (wall - last_ < options_.min_interval) return;
  last_ = wall;
  const state::StepTimes& times = now.state->times;
  const double elapsed = wall - start_;
  const double cycles = static_cast<double>(times.cycle - first_cycle_);
  const double done = times.t - first_time_;
  const double left = done > 0.0 ? elapsed * std::max(0.0, now.model->controls.t_end - times.t) / done : -1.0;
  const double rate = elapsed > 0.0 ? cycles * static_cast<double>(elements_) / elapsed : 0.0;
  const std::string line = fmt::format(
      "cycle {:>8}  time {:<11.5g} dt {:<10.4g} by {} {}  error {:.2f} %  {:.3g} element-cycles/s  {} left", times.cycle, times.t,
      times.h_plus, controller_name(now.controller.kind), now.controller.id, 100.0 * now.balance->err, rate, duration(left));
  write_(options_.terminal ? "\r" + line + "\x1b[K" : line + "\n");
  printed_ = true;
}

void Progress::end(const cycle::Outcome&) {
  if (options_.terminal && printed_) write_("\n");
}

Progress console_progress() {
  ProgressOptions options;
  options.terminal = ::isatty(STDERR_FILENO) == 1;
  if (!options.terminal) options.min_interval = 1.0;  // /PRINT/-1 in a deck would drown a log
  return Progress(
      options,
      [](std::string_view text) {
        std::fwrite(text.data(), 1, text.size(), stderr);
        std::fflush(stderr);
      },
      [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); });
}

}  // namespace abut::output
