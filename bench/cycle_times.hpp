// Wall times of every cycle, phase by phase, without outputs.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include "cycle/cycle.hpp"

namespace abut::bench {

class Nothing final : public cycle::Sink {
 public:
  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot&) override {}
  void end(const cycle::Outcome&) override {}
};

inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Name 0 is the whole cycle, the others its phases.
struct CycleTimes {
  std::vector<std::string> names;
  std::vector<std::vector<double>> seconds;  ///< per name, per cycle
  double least_cpu = 0.0;                    ///< CPU seconds of the calling thread: does not count what other programs take

  /// Runs to the end of the model, at most `most` cycles.
  CycleTimes(cycle::Cycle& cycle, long most) : names{"cycle"} {
    for (const cycle::PhaseTime& p : cycle.phases()) names.push_back(p.name);
    seconds.resize(names.size());
    std::vector<double> before(names.size(), 0.0);
    Nothing sink;
    for (long i = 0; i < most && !cycle.finished(); ++i) {
      const double cpu = thread_seconds();
      const auto start = std::chrono::steady_clock::now();
      cycle.advance(sink);
      seconds[0].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      const double used = thread_seconds() - cpu;
      least_cpu = i == 0 ? used : std::min(least_cpu, used);
      const std::vector<cycle::PhaseTime> phases = cycle.phases();
      for (std::size_t p = 0; p < phases.size(); ++p) {
        seconds[p + 1].push_back(phases[p].seconds - before[p]);
        before[p] = phases[p].seconds;
      }
    }
  }

  [[nodiscard]] std::size_t cycles() const { return seconds[0].size(); }
  /// Share `q` of the cycles takes less: 0 the least, 1/2 the median.
  [[nodiscard]] double quantile(std::size_t name, double q) const {
    std::vector<double> values = seconds[name];
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  }
};

}  // namespace abut::bench
