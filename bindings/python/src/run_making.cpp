// A run begins: from a model, from a checkpoint, from a run folder.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.hpp"
#include "held_run.hpp"
#include "model_names.hpp"
#include "parallel/thread_pool.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;
using OptionalPath = std::optional<Path>;
/// Interface id to the times from and to which its inputs are kept; none: all.
using Recordings = std::map<Id, std::optional<std::pair<double, double>>>;

void check_threads(int threads) {
  if (threads < 0 || threads > parallel::most_threads) {
    throw py::value_error("threads must be 0 (all) to " + std::to_string(parallel::most_threads));
  }
}

RunSettings settings_of(int threads, const std::string& rules, const InterfaceSettings& interfaces, const OptionalPath& output,
                        int checkpoint_every, int hash_every, bool record_history, bool progress, bool allow_findings,
                        const Recordings& record_contact) {
  check_threads(threads);
  if (hash_every < 0) throw py::value_error("hash_every must be 0 (never) or more");
  if (checkpoint_every < 0) throw py::value_error("checkpoint_every must be 0 (as the deck says) or more");
  RunSettings settings;
  settings.threads = threads;
  settings.choices = choices_of(rules, interfaces);
  settings.output = output.value_or(Path{});
  if (!record_contact.empty() && !output) throw py::value_error("record_contact needs an output folder");
  for (const auto& [id, times] : record_contact) {
    ContactRecording& recording = settings.recordings.emplace_back();
    recording.interface_id = id;
    if (times) std::tie(recording.from, recording.to) = *times;
  }
  settings.checkpoint_every = checkpoint_every;
  settings.hash_every = hash_every;
  settings.record_history = record_history;
  settings.progress = progress;
  settings.allow_findings = allow_findings;
  return settings;
}

/// @param make  gives the run, with the settings' interrupt set, while the interpreter's lock is free
template <class Settings, class Make>
std::unique_ptr<HeldRun> hold(Settings settings, const Make& make) {
  auto held = std::make_unique<HeldRun>();
  settings.interrupt = &held->interrupt;
  const py::gil_scoped_release free;
  held->run = make(settings);
  held->own_velocities = held->run->velocities().data();
  held->own_angular = held->run->angular_velocities().data();
  return held;
}

std::unique_ptr<HeldRun> make_run(const Model& model, int threads, const std::string& rules, const InterfaceSettings& interfaces,
                                  const OptionalPath& output, int checkpoint_every, int hash_every, bool record_history, bool progress,
                                  bool allow_findings, const Recordings& record_contact) {
  return hold(settings_of(threads, rules, interfaces, output, checkpoint_every, hash_every, record_history, progress, allow_findings,
                          record_contact),
              [&](const RunSettings& settings) { return std::make_unique<Run>(model, settings); });
}

std::unique_ptr<HeldRun> load_run(const Model& model, const Path& checkpoint, int threads, const std::string& rules,
                                  const InterfaceSettings& interfaces, const OptionalPath& output, int checkpoint_every, int hash_every,
                                  bool record_history, bool progress, bool allow_findings, const Recordings& record_contact) {
  return hold(settings_of(threads, rules, interfaces, output, checkpoint_every, hash_every, record_history, progress, allow_findings,
                          record_contact),
              [&](const RunSettings& settings) { return std::make_unique<Run>(Run::load(model, checkpoint, settings)); });
}

std::unique_ptr<HeldRun> resume_run(const Path& folder, const OptionalPath& deck, int threads, const std::optional<int>& checkpoint_every,
                                    bool record_history, bool progress) {
  check_threads(threads);
  if (checkpoint_every && *checkpoint_every < 0) throw py::value_error("checkpoint_every must be 0 or more");
  ResumeSettings resumed;
  resumed.deck = deck.value_or(Path{});
  resumed.threads = threads;
  resumed.checkpoint_every = checkpoint_every.value_or(-1);
  resumed.record_history = record_history;
  resumed.progress = progress;
  return hold(resumed, [&](const ResumeSettings& settings) { return std::make_unique<Run>(Run::resume(folder, settings)); });
}

void save_run(const HeldRun& self, const Path& checkpoint) { self.idle().save(checkpoint); }

}  // namespace

void bind_making(RunClass& run) {
  run.def(py::init(&make_run), "model"_a, py::kw_only(), "threads"_a = 0, "rules"_a = "standard", "interfaces"_a = InterfaceSettings{},
          "output"_a = py::none(), "checkpoint_every"_a = 0, "hash_every"_a = 0, "record_history"_a = true, "progress"_a = false,
          "allow_findings"_a = false, "record_contact"_a = Recordings{},
          "Inspects the contacts, makes the first state, opens the files.\n\n"
          "threads: at most 4096, 0 for all. rules: 'standard' or 'reference'.\n"
          "interfaces: {id or 'all': 'KEY=VALUE,...'}, settings of interfaces of TYPE3 and TYPE5 as --interface takes them: law, gap,\n"
          "initial, damping, depth, start.\n"
          "output: run folder; None: no files. What an earlier run of the same name left there to be resumed goes; another Run that was "
          "not\n"
          "finished must not write there. checkpoint_every: cycles between checkpoints in it, 0: as /RFILE of the deck says.\n"
          "hash_every: cycles between state hashes in run.json. allow_findings: run although the inspection found errors.\n"
          "record_contact: {interface id: (from, to) or None} keeps all inputs of an interface between two times, or all the time, in\n"
          "NAME_contact_ID.calls in the run folder, for contact.replay().\n"
          "Raises InputError when it did; RunError when a file cannot be written, when the system does not give so many threads, and when\n"
          "`interfaces` or `record_contact` names an interface that is not there or asks for what it cannot have; ValueError for another\n"
          "argument out of its range.")
      .def_static("load", &load_run, "model"_a, "checkpoint"_a, py::kw_only(), "threads"_a = 0, "rules"_a = "standard",
                  "interfaces"_a = InterfaceSettings{}, "output"_a = py::none(), "checkpoint_every"_a = 0, "hash_every"_a = 0,
                  "record_history"_a = true, "progress"_a = false, "allow_findings"_a = false, "record_contact"_a = Recordings{},
                  "A run of `model` that begins in the state of a checkpoint of save(); arguments as of Run().\n\n"
                  "Raises RunError when the checkpoint is not one of this model and these choices.")
      .def_static(
          "resume", &resume_run, "folder"_a, py::kw_only(), "deck"_a = py::none(), "threads"_a = 0, "checkpoint_every"_a = py::none(),
          "record_history"_a = true, "progress"_a = false,
          "Goes on from the newest whole checkpoint of a run folder, with its files: the same bits as if it had never stopped.\n\n"
          "folder: run folder or a checkpoint file in it. deck: Starter deck, None: where it was. checkpoint_every: None: as before.\n"
          "Raises RunError when there is no usable checkpoint, when it is of another model, version or deck, or another run writes in the\n"
          "folder; InputError of the deck.")
      .def("save", &save_run, "checkpoint"_a,
           "Writes a checkpoint: the whole state, in a file that is complete or not there, in the place of a file of that name.\n\n"
           "Raises RunError when it cannot be written, when something else than a file is there (a folder, a device), or when the run has\n"
           "failed: what it left within its last cycle is not a state to go on from.");
}

}  // namespace abut::python
