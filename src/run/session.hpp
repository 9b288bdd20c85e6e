// What is behind abut::Run: the cycle, its outputs and the rules of going on and ending.
#pragma once

#include <chrono>
#include <memory>
#include <string_view>
#include <vector>

#include "abut/run.hpp"
#include "cycle/cycle.hpp"
#include "output/run_info.hpp"
#include "output/sink_set.hpp"
#include "run/loaded_model.hpp"

namespace abut {

struct Run::Impl {
  Impl(const Model& model, const RunSettings& settings);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool advance();
  const Outcome& finish(Outcome::Kind kind, std::string_view message);
  [[nodiscard]] std::vector<PhaseTime> timings() const;

  Model model;
  RunSettings settings;
  Inspection inspection;
  std::vector<PhaseTime> before;  ///< phases before the first cycle
  std::unique_ptr<cycle::Cycle> cycle;
  output::RunInfo info;
  output::SinkSet sinks;
  History history;
  Outcome outcome;
  bool over = false;
  std::chrono::steady_clock::time_point start;  ///< of the cycles

 private:
  void open_outputs();
};

namespace run {

/// Facts about this program: version, commit, compiler, instruction set.
[[nodiscard]] output::RunInfo program_info();

}  // namespace run
}  // namespace abut
