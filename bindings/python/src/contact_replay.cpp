// The calls of a log, made again.
#include <fstream>
#include <string>

#include "abut/contact/call_log.hpp"
#include "arrays.hpp"
#include "files.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using contact::Replay;
using contact::ReplayedStep;

Replay replay(const std::filesystem::path& path, const std::optional<py::function>& each) {
  std::ifstream log(path, std::ios::binary);
  if (!log) throw_os_error(path);
  if (each) return contact::replay(log, [&each](const ReplayedStep& step) { (*each)(step); });
  const py::gil_scoped_release free;
  return contact::replay(log);
}

}  // namespace

void bind_replay(py::module_& m) {
  py::class_<ReplayedStep>(m, "ReplayedStep", "One step of a call log, made again.")
      .def_readonly("number", &ReplayedStep::number, "from 0, in the log")
      .def_readonly("time", &ReplayedStep::time, "t^n, in the unit of the host that recorded")
      .def_readonly("dt", &ReplayedStep::dt, "the step that ended there")
      .def_readonly("recorded", &ReplayedStep::recorded, "the results that the log holds")
      .def_readonly("replayed", &ReplayedStep::replayed, "the results of now")
      .def_readonly("same", &ReplayedStep::same, "forces, stiffness and results agree in every bit");

  py::class_<Replay>(m, "Replay", "What came of the calls of a log.")
      .def_readonly("label", &Replay::label, "what the host called itself")
      .def_readonly("kind", &Replay::kind, "'two surfaces', 'nodes to surface' or 'both sides'")
      .def_readonly("nodes", &Replay::nodes, "number of the interface's nodes")
      .def_readonly("facets", &Replay::facets, "number of the interface's facets, both sides")
      .def_readonly("steps", &Replay::steps, "number of steps in the log")
      .def_readonly("different", &Replay::different, "steps that do not agree in every bit")
      .def_readonly("first_different", &Replay::first_different, "number of the first of them; -1: none")
      .def("__repr__", [](const Replay& r) {
        return "<replay of " + std::to_string(r.steps) + " steps, " + std::to_string(r.different) + " different>";
      });

  m.def(
      "replay", &replay, "path"_a, "each"_a = py::none(),
      "Makes the calls of Interface.record() or `abut run --record-contact` again, on an interface of its own, and compares every bit.\n\n"
      "each(step) is called with a ReplayedStep after every step. Raises ValueError, naming the record, when the file is no log, of\n"
      "another version, damaged or cut off; OSError when it cannot be opened.");
}

}  // namespace abut::python
