// Keeps what verification tests ask of a run: a few signals of every cycle.
#pragma once

#include <vector>

#include "cycle/run.hpp"
#include "cycle/sink.hpp"

namespace abut::scenes {

/// One cycle's signals, work units.
struct Sample {
  double time = 0.0, dt = 0.0;
  state::Balance balance;
  std::vector<cycle::InterfaceResult> interfaces;
  std::vector<cycle::WallResult> walls;
  std::vector<double> part_internal;  ///< per part
  std::vector<Vec3> u, v;             ///< of the watched nodes: displacement t^n, velocity n - 1/2
};

class Recorder final : public cycle::Sink {
 public:
  /// @param watched node indices whose motion is kept
  explicit Recorder(std::vector<Index> watched = {}) : watched_(std::move(watched)) {}

  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot& now) override {
    Sample s;
    s.time = now.state->times.t;
    s.dt = now.state->times.h_plus;
    s.balance = *now.balance;
    s.interfaces.assign(now.interfaces.begin(), now.interfaces.end());
    s.walls.assign(now.walls.begin(), now.walls.end());
    for (const cycle::PartResult& p : now.parts) s.part_internal.push_back(p.ie);
    for (const Index n : watched_) {
      s.u.push_back(now.state->u[static_cast<std::size_t>(n)]);
      s.v.push_back(now.state->v[static_cast<std::size_t>(n)]);
    }
    samples.push_back(std::move(s));
    last_state = *now.state;
  }
  void end(const cycle::Outcome& outcome) override { this->outcome = outcome; }

  std::vector<Sample> samples;
  state::State last_state;
  cycle::Outcome outcome;

 private:
  std::vector<Index> watched_;
};

}  // namespace abut::scenes
