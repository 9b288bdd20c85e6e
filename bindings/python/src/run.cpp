// A run: its state, which can be looked at and changed, and its answers.
#include "abut/run.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "held_run.hpp"
#include "model_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;

Run& run_of(const py::object& self) { return self.cast<HeldRun&>().idle(); }

/// A view; of velocities that wait for the next cycle a copy, whose memory is only lent.
py::array velocity_array(const py::object& self, std::span<const Vec3> now, const Vec3* own) {
  if (now.data() == own) return view(now, self);
  py::array lent = copy(now);
  lent.attr("flags").attr("writeable") = false;
  return lent;
}

py::array velocities(const py::object& self) {
  return velocity_array(self, run_of(self).velocities(), self.cast<HeldRun&>().own_velocities);
}

py::array angular_velocities(const py::object& self) {
  return velocity_array(self, run_of(self).angular_velocities(), self.cast<HeldRun&>().own_angular);
}

void assign(std::span<Vec3> target, const Points& source) { std::copy(source.span.begin(), source.span.end(), target.begin()); }

void set_velocities(HeldRun& self, const ArrayLike& value) {
  Run& run = self.idle();
  const Points v = points(value, "velocities", static_cast<py::ssize_t>(run.velocities().size()));
  assign(run.edit_velocities(), v);
  ++self.edits;
}

void set_angular_velocities(HeldRun& self, const ArrayLike& value) {
  Run& run = self.idle();
  const Points w = points(value, "angular_velocities", static_cast<py::ssize_t>(run.angular_velocities().size()));
  if (run.angular_velocities().empty()) return;
  assign(run.edit_angular_velocities(), w);
  ++self.edits;
}

/// Copies to be changed inside a `with` block, handed over at its end: a view would outlive the cycle that it is meant for.
struct Edit {
  py::object run;
  py::object velocities = py::none(), angular_velocities = py::none();
  std::int64_t cycle = 0, edits = 0;  ///< that they are of

  void enter() {
    cycle = run_of(run).cycle();
    edits = run.cast<HeldRun&>().edits;
    velocities = copy(run_of(run).velocities());
    angular_velocities = copy(run_of(run).angular_velocities());
  }
  void leave() const {
    auto& held = run.cast<HeldRun&>();
    if (held.idle().cycle() != cycle) {
      throw std::runtime_error("the run has gone from cycle " + std::to_string(cycle) + " to " + std::to_string(held.idle().cycle()) +
                               " inside the block of edit(): its velocities are of the past, and nothing is changed");
    }
    if (held.edits != edits) {
      throw std::runtime_error(
          "velocities were changed inside the block of edit() in another way (a second edit(), or an assignment): that change stays, "
          "those of this block are not taken over");
    }
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
  if (h.names.empty()) throw std::runtime_error("the run keeps no history: it was made with record_history=False");
  const auto columns = static_cast<py::ssize_t>(h.names.size());
  return py::module_::import("abut.history").attr("History")(h.names, py::array(take(h.values)).reshape({py::ssize_t{-1}, columns}));
}

std::vector<NamedResult> interface_results(const HeldRun& self) {
  const Run& run = self.idle();
  std::vector<NamedResult> all;
  const auto infos = run.model().interfaces();
  const auto results = run.interfaces();
  for (std::size_t i = 0; i < std::min(infos.size(), results.size()); ++i) all.emplace_back(infos[i].id, results[i]);
  return all;
}

void bind_edit(py::module_& m) {
  py::class_<Edit>(
      m, "Edit",
      "Velocities to be changed inside a `with` block: copies that the run takes over at its end, not after an exception.\n\n"
      "Raises RuntimeError at the end when inside the run has gone on, or its velocities were changed in another way: the copies\n"
      "would be of the past.")
      .def_readwrite("velocities", &Edit::velocities, "(N, 3) length/time, half a step before Run.time; None before the block begins")
      .def_readwrite("angular_velocities", &Edit::angular_velocities, "(N, 3) radians/time, (0, 3) in models without rotations")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<Edit&>().enter();
             return self;
           })
      .def("__exit__", [](const Edit& self, const py::object& kind, const py::object&, const py::object&) {
        if (kind.is_none()) self.leave();
      });
}

void bind_state(RunClass& run) {
  const auto points_of = [&run](const char* name, auto member, const char* doc) {
    run.def_property_readonly(
        name, [member](const py::object& self) { return view((run_of(self).*member)(), self); }, doc);
  };
  run.def_property_readonly(
         "model", [](const HeldRun& self) { return self.run->model(); }, "what moves")
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
          "state_hash", [](const HeldRun& self) { return self.idle().hash(); },
          "over time, last step, positions, velocities and masses of nodes, histories of elements and of contacts");
  points_of("positions", &Run::positions,
            "(N, 3) lengths at `time`; a read-only view.\n\n"
            "Between cycles velocities can be changed, positions cannot: stresses and the anchors of friction are sums over the way that\n"
            "nodes have gone, and a jump has no work that the balance could book. A position is reached by a velocity.");
  points_of("displacements", &Run::displacements,
            "(N, 3) lengths that nodes have moved since the start of the run; a read-only view.\n\n"
            "They are positions less Model.coordinates, but for nodes that the start itself moves: the main node of a rigid body to its\n"
            "centre of mass, and what initial=project brings out of the other surface.");
  points_of("accelerations", &Run::accelerations, "(N, 3) length/time^2 at `force_time`; a read-only view");
  points_of("contact_forces", &Run::contact_forces, "(N, 3) forces, the sum of all interfaces, at `force_time`; a read-only view");
  points_of("masses", &Run::masses,
            "(N,) masses, added ones included; a read-only view.\n\n"
            "The main node of a rigid body has the mass of the body, and its other nodes keep theirs: their sum counts bodies twice,\n"
            "balance.mass once.");
  run.def_property("velocities", &velocities, &set_velocities,
                   "(N, 3) length/time, half a step before `time`; read-only, assign to change all of them, or use edit().\n\n"
                   "The energy that a change brings is booked as external work. Nodes whose motion is imposed, and secondary nodes of\n"
                   "rigid bodies, take no notice.")
      .def_property("angular_velocities", &angular_velocities, &set_angular_velocities,
                    "(N, 3) radians/time; as velocities. Empty in models without rotations.")
      .def(
          "edit", [](const py::object& self) { return Edit{self}; },
          "`with run.edit() as e: e.velocities[nodes] = v` changes velocities (and angular_velocities) before the next cycle.");
}

void bind_answers(RunClass& run) {
  run.def_property_readonly(
         "balance", [](const HeldRun& self) { return self.idle().balance(); }, "energies at `force_time`")
      .def_property_readonly("interfaces", &interface_results, "results in the order of Model.interfaces")
      .def("node_field", &node_field, "name"_a,
           "A field of the animation at every node: (N,) or (N, components). Raises ValueError for another name.")
      .def("element_field", &element_field, "kind"_a, "name"_a,
           "The same for all elements of one kind: (E,) or (E, components); nan for deleted elements.")
      .def_static("node_field_names", &Run::node_field_names, "What node_field() knows.")
      .def_static("element_field_names", &Run::element_field_names, "What element_field() knows.")
      .def_property_readonly(
          "history", &history,
          "the time history so far: a History, a copy; without rows before the first cycle. Raises RuntimeError for a run made\n"
          "with record_history=False.")
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
  RunClass run(
      m, "Run",
      "A model that moves, cycle by cycle (leap-frog). Results do not depend on the number of threads.\n\n"
      "After a cycle positions and displacements are those of `time`; velocities those of time - step/2; forces, energies, interfaces\n"
      "and elements those of `force_time`, the start of the last cycle. Views show the present state: copy what is to be kept. Used\n"
      "with `with`, the run is finished, and its files complete, at the end of the block.");
  bind_making(run);
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
