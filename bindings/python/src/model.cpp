// Models: read from a deck or from its text, looked at, inspected.
#include "abut/model.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "model_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;

Model read(const Path& path, bool orient, const std::optional<Path>& write_deck, int run) {
  const ReadOptions options{orient, write_deck.value_or(Path{}), run};
  const py::gil_scoped_release free;
  return Model::read(path, options);
}

Model from_text(const std::string& starter, const std::vector<std::string>& engines, const std::string& name, bool orient, int run) {
  const DeckText text{starter, engines, name};
  const ReadOptions options{orient, {}, run};
  const py::gil_scoped_release free;
  return Model::from_text(text, options);
}

/// Positions of ids in the model's order.
py::array node_indices(const Model& m, const ArrayLike& wanted) {
  const std::span<const Id> all = m.node_ids();
  std::vector<Index> found;
  for (const Id id : ids(wanted, "ids")) {
    const auto at = std::lower_bound(all.begin(), all.end(), id);
    if (at == all.end() || *at != id) throw py::key_error("there is no node " + std::to_string(id));
    found.push_back(static_cast<Index>(at - all.begin()));
  }
  return copy(std::span<const Index>(found));
}

Inspection inspect(const Model& m, const std::string& rules, const InterfaceSettings& interfaces, bool with_step) {
  const Choices choices = choices_of(rules, interfaces);
  const py::gil_scoped_release free;
  return m.inspect(choices, with_step);
}

/// Spans of a model with the Python object that keeps it.
struct HeldTable {
  ElementTable table;
  py::object model;
};

void bind_values(py::module_& m) {
  py::class_<Units>(m, "Units", "Size of the work units in SI (kg, m, s) and their names as the deck writes them.")
      .def_readonly("mass", &Units::mass, "kg per unit")
      .def_readonly("length", &Units::length, "m per unit")
      .def_readonly("time", &Units::time, "s per unit")
      .def_readonly("mass_name", &Units::mass_name, "as the deck writes it, e.g. 'kg'")
      .def_readonly("length_name", &Units::length_name, "as the deck writes it, e.g. 'mm'")
      .def_readonly("time_name", &Units::time_name, "as the deck writes it, e.g. 'ms'")
      .def("__repr__", [](const Units& u) { return "Units(" + u.mass_name + ", " + u.length_name + ", " + u.time_name + ")"; });

  py::class_<HeldTable>(m, "ElementTable", "All E elements of one kind, as read-only views.")
      .def_property_readonly(
          "kind", [](const HeldTable& t) { return name_of(t.table.kind, element_kinds); }, "'shell4', 'shell3', 'brick' or 'tetra'")
      .def_property_readonly(
          "ids", [](const HeldTable& t) { return view(t.table.id, t.model); }, "(E,) ascending")
      .def_property_readonly(
          "parts", [](const HeldTable& t) { return view(t.table.part, t.model); }, "(E,) indices into Model.parts")
      .def_property_readonly(
          "nodes", [](const HeldTable& t) { return view(t.table.node, t.model, std::max(1, t.table.nodes_per_element)); },
          "(E, nodes per element) node indices")
      .def("__len__", [](const HeldTable& t) { return t.table.size(); });

  py::class_<PartInfo>(m, "Part", "A part of the deck.")
      .def_readonly("id", &PartInfo::id, "of the deck")
      .def_readonly("title", &PartInfo::title, "of the deck")
      .def_readonly("property_id", &PartInfo::property_id, "id of its property")
      .def_readonly("material_id", &PartInfo::material_id, "id of its material")
      .def("__repr__", [](const PartInfo& p) { return "<part " + std::to_string(p.id) + " '" + p.title + "'>"; });

  py::class_<SurfaceInfo>(m, "ModelSurface", "A surface of the deck.")
      .def_readonly("id", &SurfaceInfo::id, "of the deck")
      .def_readonly("title", &SurfaceInfo::title, "of the deck")
      .def_property_readonly(
          "facets", [](const SurfaceInfo& s) { return copy(std::span<const std::array<Index, 4>>(s.facets)); },
          "(F, 4) node indices; a triangle repeats its third")
      .def("__repr__", [](const SurfaceInfo& s) {
        return "<surface " + std::to_string(s.id) + " '" + s.title + "', " + std::to_string(s.facets.size()) + " facets>";
      });

  py::class_<InterfaceInfo>(m, "ModelInterface", "An interface of the deck.")
      .def_readonly("id", &InterfaceInfo::id, "of the deck")
      .def_readonly("title", &InterfaceInfo::title, "of the deck")
      .def_readonly("type", &InterfaceInfo::type, "'TYPE3', 'TYPE5' or 'TYPE7'")
      .def_readonly("surfaces", &InterfaceInfo::surface, "first and second, indices into Model.surfaces; -1: a set of nodes")
      .def_property_readonly(
          "nodes", [](const InterfaceInfo& i) { return copy(std::span<const Index>(i.nodes)); },
          "(S,) node indices held, of TYPE5 and TYPE7")
      .def_readonly("stiffness_scale", &InterfaceInfo::stiffness_scale, "s of K = s K1 K2/(K1 + K2), without a unit (Stfac)")
      .def_readonly("friction", &InterfaceInfo::friction, "Coulomb coefficient, without a unit (Fric)")
      .def_readonly("gap", &InterfaceInfo::gap, "length at which a surface starts to repel (Gap)")
      .def("__repr__", [](const InterfaceInfo& i) { return "<interface " + std::to_string(i.id) + " " + i.type + " '" + i.title + "'>"; });
}

void bind_inspection_results(py::module_& m) {
  py::class_<StepController>(m, "StepController", "Who gives the time step.")
      .def_property_readonly(
          "kind", [](const StepController& c) { return name_of(c.kind, controller_kinds); },
          "'shell4', 'shell3', 'brick', 'tetra', 'node', 'interface', 'contact_node', 'fixed' or 'none'")
      .def_readonly("id", &StepController::id, "of the element, node or interface; 0 when there is none")
      .def("__repr__", [](const StepController& c) { return "<" + name_of(c.kind, controller_kinds) + " " + std::to_string(c.id) + ">"; });

  py::class_<ContactFinding>(m, "ContactFinding", "One finding of the contact inspection in the deck's ids; str() is a line for people.")
      .def_readonly("interface_id", &ContactFinding::interface_id, "of the deck")
      .def_readonly("surface_id", &ContactFinding::surface_id, "0: the interface as a whole, or its node group")
      .def_property_readonly(
          "severity", [](const ContactFinding& f) { return name_of(f.finding.severity, contact_severities); },
          "'note', 'warning' or 'error'")
      .def_property_readonly(
          "code", [](const ContactFinding& f) { return f.finding.code; }, "docs/findings/index.md has a section for it")
      .def_property_readonly(
          "what", [](const ContactFinding& f) { return f.finding.what; }, "one sentence: what was found")
      .def_property_readonly(
          "advice", [](const ContactFinding& f) { return f.finding.advice; }, "one sentence: what to do")
      .def_property_readonly(
          "measure_name", [](const ContactFinding& f) { return f.finding.measure_name; }, "what `measure` is, e.g. 'facing fraction'")
      .def_property_readonly(
          "measure", [](const ContactFinding& f) { return f.finding.measure; }, "how bad it is, in the model's units")
      .def_property_readonly(
          "nodes", [](const ContactFinding& f) { return copy(std::span<const Id>(f.nodes)); }, "(K,) node ids")
      .def_property_readonly(
          "segments", [](const ContactFinding& f) { return copy(std::span<const std::array<Id, 4>>(f.segments)); },
          "(K, 4) node ids; a triangle repeats its third")
      .def_readonly("finding", &ContactFinding::finding, "the same in node indices")
      .def("__str__", [](const ContactFinding& f) { return to_string(to_diagnostic(f)); })
      .def("__repr__", [](const ContactFinding& f) {
        return "<" + name_of(f.finding.severity, contact_severities) + " " + f.finding.code + " of interface " +
               std::to_string(f.interface_id) + ">";
      });

  py::class_<Inspection>(m, "Inspection", "What can be said of a model before it runs.")
      .def_readonly("contact", &Inspection::contact, "findings, worst first for each interface")
      .def_property_readonly(
          "part_masses", [](const Inspection& i) { return take(i.part_mass); }, "(P,) masses in the order of Model.parts")
      .def_readonly("first_step", &Inspection::first_step, "time; 0 when it was not asked for, or when interfaces have errors")
      .def_readonly("controller", &Inspection::controller, "of the first step");
}

}  // namespace

void bind_model(py::module_& m) {
  bind_values(m);
  bind_inspection_results(m);
  py::class_<Model>(m, "Model",
                    "What a deck means: validated, immutable. N nodes, sorted by id as elements and parts are; units are the deck's.\n\n"
                    "Arrays are read-only views of the model's own memory.")
      .def_static("read", &read, "path"_a, py::kw_only(), "orient"_a = false, "write_deck"_a = py::none(), "run"_a = 1,
                  "Reads NAME_0000.rad and the Engine decks beside it.\n\n"
                  "orient: turn the segments of contact surfaces to face each other where that is unambiguous; write_deck: the Starter\n"
                  "deck with the turned surfaces goes to this file. run: Engine decks 1 to `run` are read.\n"
                  "Raises InputError with every finding when there is an error; RunError when write_deck cannot be written, is one of the\n"
                  "deck's own files, or is asked for without orient.")
      .def_static("from_text", &from_text, "starter"_a, "engines"_a, py::kw_only(), "name"_a = "deck", "orient"_a = false, "run"_a = 1,
                  "The same from text: `starter` holds what NAME_0000.rad would, `engines` is a list of what NAME_0001.rad, ... would.")
      .def_property_readonly("name", &Model::name, "NAME of NAME_0000.rad")
      .def_property_readonly("title", &Model::title, "of the deck")
      .def_property_readonly("units", &Model::units, "of everything: lengths, times, masses and what is made of them")
      .def_property_readonly("end_time", &Model::end_time, "time at which the Engine deck ends the run")
      .def_property_readonly("run_number", &Model::run_number, "n of /RUN/name/n that the controls are of")
      .def_property_readonly("last_run_number", &Model::last_run_number, "of the last Engine deck that there is")
      .def_property_readonly(
          "path", [](const Model& model) { return model.path().empty() ? std::nullopt : std::optional<Path>(model.path()); },
          "of the Starter deck; None: from text")
      .def_property_readonly(
          "files", [](const Model& model) { return std::vector<std::string>(model.files().begin(), model.files().end()); },
          "decks and includes")
      .def_property_readonly(
          "findings", [](const Model& model) { return std::vector<Diagnostic>(model.findings().begin(), model.findings().end()); },
          "warnings and notes of reading")
      .def_property_readonly("fingerprint", &Model::fingerprint, "hash over the deck's text and the options that change the model")
      .def_property_readonly(
          "node_ids", [](const py::object& self) { return view(self.cast<const Model&>().node_ids(), self); }, "(N,) ascending")
      .def_property_readonly(
          "coordinates", [](const py::object& self) { return view(self.cast<const Model&>().coordinates(), self); }, "(N, 3) lengths")
      .def("node_indices", &node_indices, "ids"_a,
           "(K,) positions of nodes in the order of node_ids, for ids (K,). Raises KeyError for an id that there is not.")
      .def(
          "elements",
          [](const py::object& self, const std::string& kind) {
            return HeldTable{self.cast<const Model&>().elements(named(kind, "kind", element_kinds)), self};
          },
          "kind"_a, "All elements of one kind: 'shell4', 'shell3', 'brick' (degenerate forms too) or 'tetra'.")
      .def_property_readonly("element_count", &Model::element_count, "of all kinds")
      .def_property_readonly(
          "parts", [](const Model& model) { return std::vector<PartInfo>(model.parts().begin(), model.parts().end()); }, "by id")
      .def_property_readonly(
          "surfaces", [](const Model& model) { return std::vector<SurfaceInfo>(model.surfaces().begin(), model.surfaces().end()); },
          "by id")
      .def_property_readonly(
          "interfaces", [](const Model& model) { return std::vector<InterfaceInfo>(model.interfaces().begin(), model.interfaces().end()); },
          "by id")
      .def("inspect", &inspect, py::kw_only(), "rules"_a = "standard", "interfaces"_a = InterfaceSettings{}, "with_step"_a = false,
           "Looks at the contacts with the masses, velocities and step of the first cycle.\n\n"
           "rules: 'standard' or 'reference'; interfaces: as of Run(); with_step: the first time step too.\n"
           "Raises RunError for interfaces that are not there or settings that are none.")
      .def("__repr__", [](const Model& model) {
        return "<model '" + model.name() + "': " + std::to_string(model.node_ids().size()) + " nodes, " +
               std::to_string(model.element_count()) + " elements, " + std::to_string(model.interfaces().size()) + " interfaces>";
      });
}

}  // namespace abut::python
