// A run: cycle by cycle with the interpreter's lock free, Ctrl-C and callbacks in between.
#include "abut/run.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "model_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;
using Clock = std::chrono::steady_clock;

constexpr auto signal_interval = std::chrono::milliseconds(20);  // between two looks for Ctrl-C

/// `going` is read and written under the interpreter's lock: true while a thread is inside without it.
struct HeldRun {
  std::atomic<bool> interrupt = false;
  bool going = false;
  std::unique_ptr<Run> run;
  const Vec3* own_velocities = nullptr;  ///< what velocities() shows while nothing is edited
  const Vec3* own_angular = nullptr;

  [[nodiscard]] Run& idle() const {
    if (going) throw std::runtime_error("the run goes on in another thread: look at it from a callback, or when it has stopped");
    return *run;
  }
};

/// Frees the interpreter's lock for the time between two looks at it.
class Freedom {
 public:
  explicit Freedom(HeldRun& r) : run_(r) { leave(); }
  ~Freedom() {
    if (free_) come_back();
  }
  Freedom(const Freedom&) = delete;
  Freedom& operator=(const Freedom&) = delete;
  void leave() {
    run_.going = true;
    free_.emplace();
  }
  void come_back() {
    free_.reset();
    run_.going = false;
  }

 private:
  HeldRun& run_;
  std::optional<py::gil_scoped_release> free_;
};

/// Ends the run, so that its files are complete, and hands the exception on.
[[noreturn]] void end_by_user(Run& run, py::error_already_set& error) {
  try {
    run.finish(Outcome::Kind::interrupted, "interrupted by the user");
  } catch (const RunError&) {  // a file that cannot be written: the interrupt is what the caller asked for
  }
  throw std::move(error);
}

void look_for_signals(Run& run) {
  if (PyErr_CheckSignals() == 0) return;
  py::error_already_set error;
  end_by_user(run, error);
}

/// @return true: go on
bool call_back(const py::object& self, Run& run, const py::function& callback) {
  try {
    return !callback(self).is(py::handle(Py_False));
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt)) end_by_user(run, error);
    throw;
  }
}

struct Limits {
  double time = std::numeric_limits<double>::infinity();
  std::int64_t cycles = std::numeric_limits<std::int64_t>::max();
};

bool go_on(const py::object& self, const Limits& limits, const std::optional<py::function>& callback, int every) {
  if (every < 1) throw py::value_error("every must be 1 or more");
  auto& held = self.cast<HeldRun&>();
  Run& run = held.idle();
  look_for_signals(run);
  auto last_look = Clock::now();
  Freedom freedom(held);
  for (std::int64_t done = 0; done < limits.cycles && !run.is_over() && run.time() <= limits.time;) {
    if (!run.advance()) break;
    ++done;
    const bool calls = callback && done % every == 0;
    const auto now = Clock::now();
    if (!calls && now - last_look < signal_interval) continue;
    last_look = now;
    freedom.come_back();
    look_for_signals(run);
    if (calls && !call_back(self, run, *callback)) return !run.is_over();
    (void)held.idle();  // a callback may have let another thread start
    freedom.leave();
  }
  return !run.is_over();
}

using OptionalPath = std::optional<Path>;
using OptionalWord = std::optional<std::string>;
using Durations = std::map<Id, double>;

RunSettings settings_of(int threads, const std::string& rules, const OptionalWord& interface_law, const Durations& gradual_starts,
                        const OptionalPath& output, int checkpoint_every, int hash_every, bool record_history, bool progress,
                        bool allow_findings) {
  if (threads < 0) throw py::value_error("threads must be 0 (all) or more");
  if (hash_every < 0) throw py::value_error("hash_every must be 0 (never) or more");
  if (checkpoint_every < 0) throw py::value_error("checkpoint_every must be 0 (as the deck says) or more");
  RunSettings settings;
  settings.threads = threads;
  settings.choices = choices_of(rules, interface_law);
  for (const auto& [id, duration] : gradual_starts) settings.choices.gradual_starts.push_back({id, duration});
  settings.output = output.value_or(Path{});
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

std::unique_ptr<HeldRun> make_run(const Model& model, int threads, const std::string& rules, const OptionalWord& interface_law,
                                  const Durations& gradual_starts, const OptionalPath& output, int checkpoint_every, int hash_every,
                                  bool record_history, bool progress, bool allow_findings) {
  return hold(settings_of(threads, rules, interface_law, gradual_starts, output, checkpoint_every, hash_every, record_history, progress,
                          allow_findings),
              [&](const RunSettings& settings) { return std::make_unique<Run>(model, settings); });
}

std::unique_ptr<HeldRun> load_run(const Model& model, const Path& checkpoint, int threads, const std::string& rules,
                                  const OptionalWord& interface_law, const Durations& gradual_starts, const OptionalPath& output,
                                  int checkpoint_every, int hash_every, bool record_history, bool progress, bool allow_findings) {
  return hold(settings_of(threads, rules, interface_law, gradual_starts, output, checkpoint_every, hash_every, record_history, progress,
                          allow_findings),
              [&](const RunSettings& settings) { return std::make_unique<Run>(Run::load(model, checkpoint, settings)); });
}

std::unique_ptr<HeldRun> resume_run(const Path& folder, const OptionalPath& deck, int threads, const std::optional<int>& checkpoint_every,
                                    bool record_history, bool progress) {
  if (threads < 0) throw py::value_error("threads must be 0 (all) or more");
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

Run& run_of(const py::object& self) { return self.cast<HeldRun&>().idle(); }

/// A view; of velocities that wait for the next cycle a copy, whose memory is only lent.
py::array velocity_array(const py::object& self, std::span<const Vec3> now, const Vec3* own) {
  return now.data() == own ? view(now, self) : copy(now);
}

py::array velocities(const py::object& self) {
  return velocity_array(self, run_of(self).velocities(), self.cast<HeldRun&>().own_velocities);
}

py::array angular_velocities(const py::object& self) {
  return velocity_array(self, run_of(self).angular_velocities(), self.cast<HeldRun&>().own_angular);
}

void assign(std::span<Vec3> target, const Points& source) { std::copy(source.span.begin(), source.span.end(), target.begin()); }

void set_velocities(const HeldRun& self, const ArrayLike& value) {
  Run& run = self.idle();
  const Points v = points(value, "velocities", static_cast<py::ssize_t>(run.velocities().size()));
  assign(run.edit_velocities(), v);
}

void set_angular_velocities(const HeldRun& self, const ArrayLike& value) {
  Run& run = self.idle();
  const Points w = points(value, "angular_velocities", static_cast<py::ssize_t>(run.angular_velocities().size()));
  if (run.angular_velocities().empty()) return;
  assign(run.edit_angular_velocities(), w);
}

/// Copies to be changed inside a `with` block, handed over at its end: a view would outlive the cycle that it is meant for.
struct Edit {
  py::object run;
  py::object velocities = py::none(), angular_velocities = py::none();

  void enter() {
    velocities = copy(run_of(run).velocities());
    angular_velocities = copy(run_of(run).angular_velocities());
  }
  void leave() const {
    const auto& held = run.cast<const HeldRun&>();
    set_velocities(held, {velocities});
    set_angular_velocities(held, {angular_velocities});
  }
};

py::array node_field(const HeldRun& self, const std::string& name) {
  const Run& run = self.idle();
  std::vector<double> values = run.node_field(name);
  const std::size_t nodes = run.masses().size();
  return take(std::move(values), nodes == 0 ? 1 : values.size() / nodes);
}

py::array element_field(const HeldRun& self, const std::string& kind_name, const std::string& name) {
  const Run& run = self.idle();
  const ElementKind kind = named(kind_name, "kind", element_kinds);
  std::vector<double> values = run.element_field(kind, name);
  const std::size_t elements = run.model().elements(kind).size();
  return take(std::move(values), elements == 0 ? 1 : values.size() / elements);
}

py::object history(const HeldRun& self) {
  const History& h = self.idle().history();
  return py::module_::import("abut.history").attr("History")(h.names, take(h.values, std::max<std::size_t>(1, h.names.size())));
}

py::dict balance_terms(const Balance& b) {
  return py::dict("IE"_a = b.ie, "HE"_a = b.he, "KE"_a = b.ke, "KER"_a = b.ker, "CE"_a = b.ce, "FW"_a = b.fw, "DW"_a = b.dw, "CX"_a = b.cx,
                  "EXTW"_a = b.extw, "XE"_a = b.xe);
}

/// A result with the interface it is of.
struct NamedResult {
  Id id;
  InterfaceResult result;
};

std::vector<NamedResult> interface_results(const HeldRun& self) {
  const Run& run = self.idle();
  std::vector<NamedResult> all;
  const auto infos = run.model().interfaces();
  const auto results = run.interfaces();
  for (std::size_t i = 0; i < std::min(infos.size(), results.size()); ++i) all.push_back({infos[i].id, results[i]});
  return all;
}

void bind_results(py::module_& m) {
  py::class_<Balance>(m, "Balance", "Terms of the energy balance, in the model's unit of work (docs/guide/outputs.md).")
      .def_readonly("ie", &Balance::ie, "internal energy without hourglass")
      .def_readonly("he", &Balance::he, "hourglass energy")
      .def_readonly("ke", &Balance::ke, "kinetic energy of translation")
      .def_readonly("ker", &Balance::ker, "kinetic energy of rotation")
      .def_readonly("ce", &Balance::ce, "interfaces: stored")
      .def_readonly("fw", &Balance::fw, "interfaces: friction work")
      .def_readonly("dw", &Balance::dw, "interfaces: damping")
      .def_readonly("cx", &Balance::cx, "interfaces: made or lost by numerics")
      .def_readonly("extw", &Balance::extw, "external work")
      .def_readonly("xe", &Balance::xe, "eroded elements and added mass")
      .def_readonly("initial", &Balance::initial, "sum of the terms at the start")
      .def_readonly("largest", &Balance::largest, "largest term so far")
      .def_readonly("err", &Balance::err, "error of the balance over the largest term")
      .def_readonly("ledger", &Balance::ledger, "the same with the discrete works")
      .def_property_readonly(
          "momentum", [](const Balance& b) { return copy(b.momentum); }, "(3,)")
      .def_readonly("mass", &Balance::mass)
      .def_readonly("added_mass", &Balance::added_mass, "by mass scaling")
      .def("terms", &balance_terms, "The energies as a dict with the names of the time history (IE, HE, ...).")
      .def("__repr__", [](const Balance& b) {
        return "Balance(" + py::cast<std::string>(py::repr(balance_terms(b))) + ", err=" + std::to_string(b.err) + ")";
      });

  py::class_<NamedResult>(m, "InterfaceResult", "Forces of the last cycle, impulses since the start, on the second surface; energies.")
      .def_readonly("id", &NamedResult::id)
      .def_property_readonly(
          "normal_force", [](const NamedResult& r) { return copy(r.result.normal_force); }, "(3,)")
      .def_property_readonly(
          "tangential_force", [](const NamedResult& r) { return copy(r.result.tangential_force); }, "(3,)")
      .def_property_readonly(
          "normal_impulse", [](const NamedResult& r) { return copy(r.result.normal_impulse); }, "(3,) force x time")
      .def_property_readonly(
          "tangential_impulse", [](const NamedResult& r) { return copy(r.result.tangential_impulse); }, "(3,)")
      .def_property_readonly(
          "ce", [](const NamedResult& r) { return r.result.ce; }, "energy stored")
      .def_property_readonly(
          "fw", [](const NamedResult& r) { return r.result.fw; }, "friction work")
      .def_property_readonly(
          "dw", [](const NamedResult& r) { return r.result.dw; }, "damping work")
      .def_property_readonly(
          "cx", [](const NamedResult& r) { return r.result.cx; }, "energy made or lost by numerics")
      .def_property_readonly(
          "sw", [](const NamedResult& r) { return r.result.sw; }, "work put in by a gradual start, part of the external work")
      .def_property_readonly(
          "in_contact", [](const NamedResult& r) { return r.result.in_contact; }, "held nodes that touch, both passes")
      .def_property_readonly(
          "largest_penetration", [](const NamedResult& r) { return r.result.largest_penetration; }, "length")
      .def_property_readonly(
          "crossed", [](const NamedResult& r) { return r.result.crossed; }, "nodes caught before they jumped through")
      .def("__repr__", [](const NamedResult& r) {
        return "<interface " + std::to_string(r.id) + ": " + std::to_string(r.result.in_contact) + " nodes in contact>";
      });

  py::class_<Outcome>(m, "Outcome", "Why and how a run ended.")
      .def_property_readonly(
          "kind", [](const Outcome& o) { return name_of(o.kind, outcome_kinds); }, "'finished', 'stopped', 'interrupted' or 'failed'")
      .def_readonly("message", &Outcome::message)
      .def_readonly("cycles", &Outcome::cycles)
      .def_readonly("time", &Outcome::time)
      .def("__str__", [](const Outcome& o) { return to_string(o); })
      .def("__repr__", [](const Outcome& o) { return "<" + to_string(o) + ">"; });

  py::class_<RunFinding>(m, "RunFinding", "What the watch over the contacts found while the run went on.")
      .def_readonly("diagnostic", &RunFinding::diagnostic)
      .def_readonly("interface_id", &RunFinding::interface_id)
      .def_readonly("time", &RunFinding::time)
      .def_readonly("cycle", &RunFinding::cycle)
      .def_readonly("measure", &RunFinding::measure)
      .def("__str__", [](const RunFinding& f) { return to_string(f.diagnostic); })
      .def("__repr__",
           [](const RunFinding& f) { return "<" + f.diagnostic.code + " of interface " + std::to_string(f.interface_id) + ">"; });
}

void bind_edit(py::module_& m) {
  py::class_<Edit>(m, "Edit",
                   "Velocities to be changed inside a `with` block: copies that the run takes over at its end, not after an exception.")
      .def_readwrite("velocities", &Edit::velocities, "(N, 3)")
      .def_readwrite("angular_velocities", &Edit::angular_velocities, "(N, 3) or (0, 3)")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Edit&>().enter();
             return self;
           })
      .def("__exit__", [](const Edit& self, const py::object& kind, const py::object&, const py::object&) {
        if (kind.is_none()) self.leave();
      });
}

template <class Class>
void bind_going(Class& run) {
  run.def(
         "advance", [](const py::object& self, std::int64_t cycles) { return go_on(self, {.cycles = cycles}, std::nullopt, 1); },
         "cycles"_a = 1,
         "Cycles, one if not told. Returns False when the run is over.\n\nRaises RunError when it fails; its files are complete then.")
      .def(
          "advance_to",
          [](const py::object& self, double time, const std::optional<py::function>& callback, int every) {
            return go_on(self, {.time = time}, callback, every);
          },
          "time"_a, "callback"_a = py::none(), py::kw_only(), "every"_a = 1,
          "Cycles until `time` is passed. Returns False when the run is over.\n\n"
          "callback(run) is called after every n-th cycle (`every`); when it returns False the run stops there and can be continued, and\n"
          "an exception of its leaves the run where it is. Ctrl-C ends the run with complete files and raises KeyboardInterrupt.\n"
          "The interpreter's lock is free but for callbacks.")
      .def(
          "advance_to_end",
          [](const py::object& self, const std::optional<py::function>& callback, int every) { return go_on(self, {}, callback, every); },
          "callback"_a = py::none(), py::kw_only(), "every"_a = 1, "Cycles until the end; see advance_to().")
      .def(
          "finish", [](const HeldRun& self, const std::string& message) { return self.idle().finish(Outcome::Kind::stopped, message); },
          "message"_a = "stopped by the caller", "Ends the run where it is: summary, manifest, files closed. Nothing when it is over.")
      .def(
          "interrupt", [](HeldRun& self) { self.interrupt.store(true); },
          "Asks a run that goes on in another thread to end after its cycle, with complete files. Any thread may call this.")
      .def_property_readonly("is_over", [](const HeldRun& self) { return self.idle().is_over(); })
      .def_property_readonly(
          "outcome",
          [](const HeldRun& self) {
            const Run& r = self.idle();
            return r.is_over() ? std::optional<Outcome>(r.outcome()) : std::nullopt;
          },
          "how it ended; None while it is not over")
      .def("__enter__", [](py::object self) { return self; })
      .def("__exit__", [](const HeldRun& self, const py::object&, const py::object&, const py::object&) { self.idle().finish(); });
}

template <class Class>
void bind_state(Class& run) {
  const auto points_of = [&run](const char* name, auto member, const char* doc) {
    run.def_property_readonly(
        name, [member](const py::object& self) { return view((run_of(self).*member)(), self); }, doc);
  };
  run.def_property_readonly("model", [](const HeldRun& self) { return self.run->model(); })
      .def_property_readonly(
          "time", [](const HeldRun& self) { return self.idle().time(); }, "t of positions")
      .def_property_readonly(
          "cycle", [](const HeldRun& self) { return self.idle().cycle(); }, "cycles done")
      .def_property_readonly(
          "step", [](const HeldRun& self) { return self.idle().step(); }, "the last time step; 0 before the first cycle")
      .def_property_readonly(
          "force_time", [](const HeldRun& self) { return self.idle().force_time(); }, "t of forces and energies")
      .def_property_readonly(
          "controller", [](const HeldRun& self) { return self.idle().controller(); }, "who gave the step")
      .def_property_readonly(
          "state_hash", [](const HeldRun& self) { return self.idle().hash(); }, "over every bit of the state that influences the future");
  points_of("positions", &Run::positions, "(N, 3) lengths at `time`; a read-only view");
  points_of("displacements", &Run::displacements, "(N, 3) lengths; a read-only view");
  points_of("accelerations", &Run::accelerations, "(N, 3) a read-only view");
  points_of("contact_forces", &Run::contact_forces, "(N, 3) forces of all interfaces; a read-only view");
  points_of("masses", &Run::masses, "(N,) a read-only view");
  run.def_property("velocities", &velocities, &set_velocities,
                   "(N, 3) half a step before `time`; read-only, assign to change all of them, or use edit().\n\n"
                   "The energy that a change brings is booked as external work. Nodes whose motion is imposed, and secondary nodes of\n"
                   "rigid bodies, take no notice.")
      .def_property("angular_velocities", &angular_velocities, &set_angular_velocities,
                    "(N, 3) rate; as velocities. Empty in models without rotations.")
      .def(
          "edit", [](const py::object& self) { return Edit{self}; },
          "`with run.edit() as e: e.velocities[nodes] = v` changes velocities (and angular_velocities) before the next cycle.");
}

template <class Class>
void bind_answers(Class& run) {
  run.def_property_readonly(
         "balance", [](const HeldRun& self) { return self.idle().balance(); }, "energies at `force_time`")
      .def_property_readonly("interfaces", &interface_results, "results in the order of Model.interfaces")
      .def("node_field", &node_field, "name"_a,
           "A field of the animation at every node: (N,) or (N, components). Raises ValueError for another name.")
      .def("element_field", &element_field, "kind"_a, "name"_a,
           "The same for all elements of one kind: (E,) or (E, components); nan for deleted elements.")
      .def_static("node_field_names", &Run::node_field_names)
      .def_static("element_field_names", &Run::element_field_names)
      .def_property_readonly("history", &history, "the time history so far: a History, a copy")
      .def_property_readonly(
          "initial_findings",
          [](const HeldRun& self) {
            const auto all = self.idle().initial_findings();
            return std::vector<Diagnostic>(all.begin(), all.end());
          },
          "of reading and of the inspection, as text")
      .def_property_readonly(
          "contact_findings",
          [](const HeldRun& self) {
            const auto all = self.idle().contact_findings();
            return std::vector<ContactFinding>(all.begin(), all.end());
          },
          "of the inspection before the run")
      .def_property_readonly(
          "findings",
          [](const HeldRun& self) {
            const auto all = self.idle().findings();
            return std::vector<RunFinding>(all.begin(), all.end());
          },
          "of the run so far")
      .def_property_readonly(
          "timings",
          [](const HeldRun& self) {
            py::dict all;
            for (const PhaseTime& phase : self.idle().timings()) all[py::str(phase.name)] = phase.seconds;
            return all;
          },
          "wall-clock seconds by phase")
      .def_property_readonly(
          "output", [](const HeldRun& self) { return self.run->output().empty() ? std::nullopt : std::optional<Path>(self.run->output()); },
          "run folder; None when no files are written");
}

}  // namespace

void bind_run(py::module_& m) {
  bind_results(m);
  bind_edit(m);
  py::class_<HeldRun> run(
      m, "Run",
      "A model that moves, cycle by cycle (leap-frog). Results do not depend on the number of threads.\n\n"
      "After a cycle positions and displacements are those of `time`; velocities those of time - step/2; forces, energies, interfaces\n"
      "and elements those of `force_time`, the start of the last cycle. Views show the present state: copy what is to be kept. Used\n"
      "with `with`, the run is finished, and its files complete, at the end of the block.");
  run.def(py::init(&make_run), "model"_a, py::kw_only(), "threads"_a = 0, "rules"_a = "standard", "interface_law"_a = py::none(),
          "gradual_starts"_a = Durations{}, "output"_a = py::none(), "checkpoint_every"_a = 0, "hash_every"_a = 0,
          "record_history"_a = true, "progress"_a = false, "allow_findings"_a = false,
          "Inspects the contacts, makes the first state, opens the files.\n\n"
          "threads: 0 for all. rules: 'standard' or 'reference'. interface_law: 'stiffening', 'constant' or None for the rule set's.\n"
          "gradual_starts: {interface id: time over which initial penetrations are pushed out}.\n"
          "output: run folder; None: no files. checkpoint_every: cycles between checkpoints in it, 0: as /RFILE of the deck says.\n"
          "hash_every: cycles between state hashes in run.json. allow_findings: run although the inspection found errors.\n"
          "Raises InputError when it did, RunError when a file cannot be written.")
      .def_static("load", &load_run, "model"_a, "checkpoint"_a, py::kw_only(), "threads"_a = 0, "rules"_a = "standard",
                  "interface_law"_a = py::none(), "gradual_starts"_a = Durations{}, "output"_a = py::none(), "checkpoint_every"_a = 0,
                  "hash_every"_a = 0, "record_history"_a = true, "progress"_a = false, "allow_findings"_a = false,
                  "A run of `model` that begins in the state of a checkpoint of save(); arguments as of Run().\n\n"
                  "Raises RunError when the checkpoint is not one of this model and these choices.")
      .def_static(
          "resume", &resume_run, "folder"_a, py::kw_only(), "deck"_a = py::none(), "threads"_a = 0, "checkpoint_every"_a = py::none(),
          "record_history"_a = true, "progress"_a = false,
          "Goes on from the newest whole checkpoint of a run folder, with its files: the same bits as if it had never stopped.\n\n"
          "folder: run folder or a checkpoint file in it. deck: Starter deck, None: where it was. checkpoint_every: None: as before.\n"
          "Raises RunError when there is no usable checkpoint, or it is of another model, version or deck; InputError of the deck.")
      .def("save", &save_run, "checkpoint"_a,
           "Writes a checkpoint: the whole state, in a file that is complete or not there. Raises RunError when it cannot be written.");
  bind_going(run);
  bind_state(run);
  bind_answers(run);
  run.def("__repr__", [](const HeldRun& self) {
    if (self.going) return std::string("<run that goes on in another thread>");
    return "<run of '" + self.run->model().name() + "' at cycle " + std::to_string(self.run->cycle()) + ", time " +
           std::to_string(self.run->time()) + ">";
  });
}

}  // namespace abut::python
