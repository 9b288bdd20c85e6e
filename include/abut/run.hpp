// A run: a model that moves. Cycle by cycle, to a time or to its end; state can be read, and velocities changed, in between.
//
//   abut::Model model = abut::Model::read("plate_drop_0000.rad");
//   abut::Run run(model, {.output = "plate_drop"});
//   run.advance_to_end([](abut::Run& r) { return r.balance().err < 0.05; });   // false stops after this cycle
//
// Leap-frog: after a cycle, positions and displacements are those of time(); velocities those of time() - step() / 2; forces,
// energies, interface results and element values those of the start of the last cycle, force_time().
// Results do not depend on the number of threads. A Run is used by one thread at a time; different Runs are independent.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/diagnostic.hpp"
#include "abut/model.hpp"
#include "abut/results.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut {

/// A call log of one interface (abut/contact/call_log.hpp): NAME_contact_ID.calls in the run folder, for `abut replay`.
struct ContactRecording {
  Id interface_id = 0;
  double from = 0.0, to = 1e30;  ///< times, 0 <= from <= to
};

struct RunSettings {
  int threads = 0;                               ///< 0: all that the machine has; more than 4096 are std::invalid_argument
  Choices choices;                               ///< rule set and settings of interfaces
  std::filesystem::path output;                  ///< run folder (docs/guide/outputs.md); empty: no files are written
  int checkpoint_every = 0;                      ///< cycles between checkpoints in the run folder; 0: as /RFILE of the deck says
  std::vector<ContactRecording> recordings;      ///< each interface at most once; not gone on with by a resumed run, which warns of it
  int hash_every = 0;                            ///< cycles between state hashes in run.json, 0: none
  bool record_history = true;                    ///< keep the time history in memory: history()
  bool progress = false;                         ///< a line about the progress on standard error
  bool allow_findings = false;                   ///< run although the contact inspection found errors
  const std::atomic<bool>* interrupt = nullptr;  ///< when it becomes true the run ends after its cycle, with complete files
};

/// Settings of a run that goes on; the mechanics are those of the run that wrote the checkpoint.
struct ResumeSettings {
  std::filesystem::path deck;  ///< Starter deck; empty: where it was when the checkpoint was written
  int threads = 0;             ///< as in RunSettings
  int checkpoint_every = -1;   ///< -1: as before; 0: as /RFILE of the deck says
  bool record_history = true;
  bool progress = false;
  const std::atomic<bool>* interrupt = nullptr;
};

/// Time history in memory: the columns of NAME_th.csv.
struct History {
  std::vector<std::string> names;  ///< #columns, the first is "time"
  std::vector<double> values;      ///< #rows by #columns, row-major
  [[nodiscard]] std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
};

/// What was found while the run went on: contacts, deleted elements.
struct RunFinding {
  Diagnostic diagnostic;
  Id interface_id = 0;  ///< 0: it is not about one
  double time = 0.0;
  std::int64_t cycle = 0;
  double measure = 0.0;                     ///< how bad it is; docs/findings/index.md says of what
  std::vector<Id> nodes;                    ///< all of them; the text names twenty
  std::vector<std::array<Id, 4>> segments;  ///< node ids
};

class Run {
 public:
  /// Called after each cycle; false stops the run there (it can be continued).
  using Callback = std::function<bool(Run&)>;

  /// Inspects the contacts, makes the first state, opens the files.
  /// What an earlier run of the same name has left in the run folder goes: checkpoints, manifest, report, call logs.
  /// @throws InputError when the inspection finds errors (unless they are allowed); RunError when a file cannot be written, when another
  ///         run that is not over writes in the folder, the system does not give so many threads, or a recording or choice is of an
  ///         interface that is not there or cannot have it, or a recording asked for twice or without a run folder
  explicit Run(const Model& model, const RunSettings& settings = {});
  /// Goes on from the newest whole checkpoint of a run folder, with its files (docs/guide/restart.md): the same bits as if it had never
  /// stopped. When the run is finished, the next Engine deck takes over.
  /// @param folder  run folder, or a checkpoint file in it
  /// @throws RunError when there is no usable checkpoint, or it is of another model, version or deck, when the files beside it are not
  ///         what they were, or another run writes there: nothing is changed then; InputError of the deck
  [[nodiscard]] static Run resume(const std::filesystem::path& folder, const ResumeSettings& settings = {});
  /// A run of `model` that begins in the state of a checkpoint; its files, if any, begin there too.
  /// @throws RunError when the checkpoint is not one of this model and these choices, or lies where the run's own will be
  [[nodiscard]] static Run load(const Model& model, const std::filesystem::path& checkpoint, const RunSettings& settings = {});
  /// Writes a checkpoint: the whole state, in a file that is complete or not there. It takes the place of a file of that name.
  /// @throws RunError when it cannot be written, something else than a file is there, or the run has failed; what was there stays
  void save(const std::filesystem::path& checkpoint);

  ~Run();  ///< ends the run if finish() was not called; never throws
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;  ///< ends the run that was here, as ~Run

  // ---- going on ----
  /// One cycle. When the final time is passed the run is finished and its files are complete.
  /// @return false when there was nothing left to do
  /// @throws RunError when the run fails (not finite, an error limit, a full disk, no memory); it is over and its files are complete then
  bool advance();
  /// Cycles until time() > `time`, the end, an interrupt, or a callback that says false.
  /// @param time  of the model; a time that has passed does nothing
  /// @return false when the run is over
  /// @throws RunError as advance(); what a callback throws comes through, the run stays where it is
  bool advance_to(double time, const Callback& after_each = {});
  bool advance_to_end(const Callback& after_each = {});  ///< as advance_to()
  /// Ends the run where it is: summary, manifest, files closed. Nothing when it is over. @throws RunError when a file cannot be written
  const Outcome& finish(Outcome::Kind kind = Outcome::Kind::stopped, std::string_view message = "stopped by the caller");
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] const Outcome& outcome() const;  ///< valid when is_over()

  // ---- where it is ----
  [[nodiscard]] const Model& model() const;
  [[nodiscard]] double time() const;                       ///< t of positions()
  [[nodiscard]] std::int64_t cycle() const;                ///< cycles done
  [[nodiscard]] double step() const;                       ///< the last one; 0 before the first cycle
  [[nodiscard]] double force_time() const;                 ///< t of forces and energies
  [[nodiscard]] const StepController& controller() const;  ///< who gave step()
  /// Over time, last step, and positions, velocities and masses of nodes, histories of elements and of contacts: what differs in two runs
  /// and is not of these (docs/determinism.md names it) shows here once it has acted on them.
  [[nodiscard]] std::uint64_t hash() const;

  // ---- nodes: #N (by 3), order of Model::node_ids(); views of the present state that live as long as the run ----
  /// Lengths at time(). Positions cannot be changed: stresses and the anchors of friction are sums over the way that nodes have gone,
  /// and a jump has no work that the balance could book. A position is reached by a velocity.
  [[nodiscard]] std::span<const Vec3> positions() const;
  /// Since the start of the run: positions() less Model::coordinates(), but for nodes that the start itself moves (main nodes of rigid
  /// bodies, `initial=project`).
  [[nodiscard]] std::span<const Vec3> displacements() const;
  [[nodiscard]] std::span<const Vec3> velocities() const;          ///< at time() - step()/2, or as edited
  [[nodiscard]] std::span<const Vec3> angular_velocities() const;  ///< radians/time; empty in models without rotations
  [[nodiscard]] std::span<const Vec3> accelerations() const;       ///< at force_time()
  [[nodiscard]] std::span<const Vec3> contact_forces() const;      ///< at force_time(), sum of all interfaces
  /// Added ones included. The main node of a rigid body has the mass of the body, and its other nodes keep theirs.
  [[nodiscard]] std::span<const double> masses() const;
  /// The velocities, to be changed before the next cycle. The energy that a change brings is booked as external work, so the
  /// balance stays closed. Nodes whose motion is imposed, and secondary nodes of rigid bodies, take no notice.
  [[nodiscard]] std::span<Vec3> edit_velocities();
  [[nodiscard]] std::span<Vec3> edit_angular_velocities();

  // ---- results ----
  [[nodiscard]] const Balance& balance() const;                       ///< at force_time()
  [[nodiscard]] std::span<const InterfaceResult> interfaces() const;  ///< order of Model::interfaces()
  /// A field of the animation (docs/guide/outputs.md) at every node: #N by components, row-major.
  /// @throws std::invalid_argument for an unknown name; node_field_names() has all
  [[nodiscard]] std::vector<double> node_field(std::string_view name) const;
  /// The same for all elements of one kind, in the order of Model::elements(kind); NaN for deleted elements.
  /// @throws std::invalid_argument for an unknown name; element_field_names() has all
  [[nodiscard]] std::vector<double> element_field(ElementKind kind, std::string_view name) const;
  [[nodiscard]] static std::vector<std::string> node_field_names();
  [[nodiscard]] static std::vector<std::string> element_field_names();
  [[nodiscard]] const History& history() const;                            ///< without RunSettings::record_history it has no columns
  [[nodiscard]] std::span<const Diagnostic> initial_findings() const;      ///< of reading and of the inspection, as text
  [[nodiscard]] std::span<const ContactFinding> contact_findings() const;  ///< of the inspection before the run
  [[nodiscard]] std::span<const RunFinding> findings() const;              ///< of the run so far
  [[nodiscard]] std::vector<PhaseTime> timings() const;                    ///< wall-clock time of this session so far
  [[nodiscard]] const std::filesystem::path& output() const;               ///< run folder; empty: none

 private:
  struct Impl;
  explicit Run(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// "abut 0.1.0 (commit), compiler, instruction set".
[[nodiscard]] std::string version_text();

}  // namespace abut
