// A run goes on: cycle by cycle with the interpreter's lock free, Ctrl-C and callbacks in between.
#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "held_run.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using Clock = std::chrono::steady_clock;

constexpr auto signal_interval = std::chrono::milliseconds(20);  // between two looks for Ctrl-C

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

/// What a callback says: nothing and true go on, false stops.
bool goes_on(const py::object& answer) {
  if (answer.is_none()) return true;
  if (!py::isinstance<py::bool_>(answer) && !py::isinstance(answer, py::module_::import("numpy").attr("bool_"))) {
    throw py::type_error(std::string("the callback returned a value of type ") + Py_TYPE(answer.ptr())->tp_name +
                         ", expected None or True to go on, False to stop");
  }
  return py::cast<bool>(py::bool_(answer));
}

/// @return true: go on
bool call_back(const py::object& self, Run& run, const py::function& callback) {
  try {
    return goes_on(callback(self));
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
  if (limits.cycles < 0) throw py::value_error("cycles must be 0 or more");
  if (std::isnan(limits.time)) throw py::value_error("time must be a number, not nan");
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

}  // namespace

void bind_going(RunClass& run) {
  run.def(
         "advance", [](const py::object& self, std::int64_t cycles) { return go_on(self, {.cycles = cycles}, std::nullopt, 1); },
         "cycles"_a = 1,
         "Cycles, one if not told. Returns False when the run is over.\n\n"
         "Raises RunError when it fails; its files are complete then. ValueError for less than 0 cycles.")
      .def(
          "advance_to",
          [](const py::object& self, double time, const std::optional<py::function>& callback, int every) {
            return go_on(self, {.time = time}, callback, every);
          },
          "time"_a, "callback"_a = py::none(), py::kw_only(), "every"_a = 1,
          "Cycles until `time` is passed; nothing when it has passed. Returns False when the run is over.\n\n"
          "callback(run) is called after every n-th cycle (`every`); when it returns False (numpy's too) the run stops there and can be\n"
          "continued, with True or None it goes on, and anything else raises TypeError. An exception of its leaves the run where it is.\n"
          "Ctrl-C ends the run with complete files and raises KeyboardInterrupt. Raises ValueError for a time that is nan.\n"
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
      .def_property_readonly(
          "is_over", [](const HeldRun& self) { return self.idle().is_over(); }, "True when it has ended: nothing goes on any more")
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

}  // namespace abut::python
