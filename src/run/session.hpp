// What is behind abut::Run: the cycle, its outputs and the rules of going on and ending.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "abut/run.hpp"
#include "cycle/cycle.hpp"
#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/sink_set.hpp"
#include "run/loaded_model.hpp"
#include "run/memory_history.hpp"

namespace abut {

namespace run {

/// Who wrote a checkpoint, of what, and where it was: the first part of its content.
struct CheckpointInfo {
  std::string version, commit;
  std::string name;  ///< of the model
  std::string deck;  ///< absolute path of the Starter deck; empty: from text
  std::uint64_t fingerprint = 0, engine_fingerprint = 0;
  std::int32_t run = 1;
  bool reference = false, orient = false, allow_findings = false;
  std::vector<std::string> interfaces;  ///< choices, to_string(InterfaceChoice)
  std::int32_t hash_every = 0;
  std::int32_t checkpoint_every = 0;  ///< as the caller wants it: 0, as the Engine deck of the moment says
  std::int64_t cycle = 0;
  double time = 0.0;
  std::uint64_t hash = 0;  ///< Cycle::hash() of the state that follows

  void persist(state::Archive& a);
};

/// A checkpoint in memory: whole by its checksum, its first part read.
struct Checkpoint {
  std::vector<std::byte> file;
  state::Archive archive;  ///< behind the first part
  CheckpointInfo info;

  /// @throws state::ArchiveError when it is damaged; RunError when it is of another version of abut
  explicit Checkpoint(const std::filesystem::path& path);
};

}  // namespace run

struct Run::Impl {
  /// @param from  the state to begin with; null: the model's
  /// @param resume  the files of the checkpoint's run go on; the caller has the lock of the folder
  Impl(const Model& model, const RunSettings& settings, run::Checkpoint* from = nullptr, bool resume = false);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool advance();
  const Outcome& finish(Outcome::Kind kind, std::string_view message);
  /// @param previous  keeps what was at `path`; empty: that goes
  void save(const std::filesystem::path& path, const std::filesystem::path& previous);
  /// A warning of the run itself, now. @param file  that it is about; may be empty
  void tell(std::string code, std::string text, const std::filesystem::path& file = {});
  [[nodiscard]] std::vector<PhaseTime> timings() const;

  Model model;
  RunSettings settings;
  std::vector<PhaseTime> before;  ///< phases before the first cycle
  std::unique_ptr<cycle::Cycle> cycle;
  output::RunInfo info;
  std::optional<output::FolderLock> lock;  ///< of the run folder, until the run is over
  output::SinkSet sinks;
  History history;
  Outcome outcome;
  bool over = false;
  bool told_checkpoint = false;                 ///< a checkpoint could not be written, and that was said
  std::chrono::steady_clock::time_point start;  ///< of the cycles

 private:
  void open_outputs();
  void restore_outputs(run::Checkpoint& from, bool resume);
  void keep_checkpoint();
  [[noreturn]] void fail(std::string_view message);  ///< ends the run and throws
  [[nodiscard]] int checkpoint_every() const;        ///< cycles; 0: never
  [[nodiscard]] run::CheckpointInfo checkpoint_info();

  std::vector<cycle::Sink*> watches_;
  run::MemoryHistory* memory_ = nullptr;  ///< null: not asked for
  std::vector<cycle::Sink*> files_;
  std::vector<std::ofstream> call_logs_;  ///< per RunSettings::recordings
};

namespace run {

/// Facts about this program: version, commit, compiler, instruction set.
[[nodiscard]] output::RunInfo program_info();

}  // namespace run
}  // namespace abut
