// What the last cycle said, kept for the end of a run: views of a snapshot are gone by then.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cycle/sink.hpp"
#include "output/summary.hpp"

namespace abut::output {

class RunRecord {
 public:
  struct Hash {
    std::int64_t cycle = 0;
    std::uint64_t value = 0;
  };
  struct Worst {
    double value = 0.0;  ///< signed, of largest magnitude
    double time = 0.0;
  };

  void begin(const cycle::Snapshot& first) {
    elements_ = element_count(*first.model);
    start_ = Clock::now();
    balance_ = *first.balance;
  }
  void cycle(const cycle::Snapshot& now) {
    balance_ = *now.balance;
    any_ = true;
    const double t = now.state->times.t;
    keep_worst(error_, balance_.err, t);
    keep_worst(made_, balance_.cx, t);
    if (now.hash_due) hashes_.push_back({now.state->times.cycle, now.state_hash});
  }

  /// Whether a cycle was recorded: before that there are no energies.
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] const state::Balance& balance() const { return balance_; }
  [[nodiscard]] Worst worst_error() const { return error_; }
  [[nodiscard]] Worst worst_made() const { return made_; }
  [[nodiscard]] const std::vector<Hash>& hashes() const { return hashes_; }
  /// Of all sessions of the run.
  [[nodiscard]] double wall_seconds() const { return earlier_seconds_ + std::chrono::duration<double>(Clock::now() - start_).count(); }
  void persist(state::Archive& a) {
    double seconds = wall_seconds();
    a(seconds);
    if (a.loading()) earlier_seconds_ = seconds;
    if (a.loading()) any_ = true;
    Balance& b = balance_;
    for (double* term : {&b.ie, &b.he, &b.ke, &b.ker, &b.ce, &b.fw, &b.dw, &b.cx, &b.extw, &b.xe, &b.initial, &b.largest, &b.err, &b.ledger,
                         &b.mass, &b.added_mass})
      a(*term);
    a(b.momentum);
    for (Worst* worst : {&error_, &made_}) {
      a(worst->value);
      a(worst->time);
    }
    a.each_growing(hashes_, [&a](Hash& hash) {
      a(hash.cycle);
      a(hash.value);
    });
  }
  /// Elements times cycles per second of wall time.
  [[nodiscard]] double rate(std::int64_t cycles) const {
    const double seconds = wall_seconds();
    return seconds > 0.0 ? static_cast<double>(elements_) * static_cast<double>(cycles) / seconds : 0.0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// A value that is not a number is the worst of all and stays.
  static void keep_worst(Worst& worst, double value, double time) {
    if (std::abs(value) > std::abs(worst.value) || (std::isnan(value) && !std::isnan(worst.value))) worst = {value, time};
  }
  Index elements_ = 0;
  bool any_ = false;
  Clock::time_point start_ = Clock::now();
  double earlier_seconds_ = 0.0;
  state::Balance balance_;
  Worst error_, made_;
  std::vector<Hash> hashes_;
};

/// Added mass over the mass before scaling.
[[nodiscard]] inline double mass_error(const state::Balance& b) {
  const double initial = b.mass - b.added_mass;
  return initial > 0.0 ? b.added_mass / initial : 0.0;
}

}  // namespace abut::output
