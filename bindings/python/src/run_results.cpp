// What a run answers with: the balance, results of interfaces, the outcome, findings.
#include <string>

#include "abut/run.hpp"
#include "arrays.hpp"
#include "held_run.hpp"
#include "model_names.hpp"

namespace abut::python {
namespace {

using namespace py::literals;

py::dict balance_terms(const Balance& b) {
  return py::dict("IE"_a = b.ie, "HE"_a = b.he, "KE"_a = b.ke, "KER"_a = b.ker, "CE"_a = b.ce, "FW"_a = b.fw, "DW"_a = b.dw, "CX"_a = b.cx,
                  "EXTW"_a = b.extw, "XE"_a = b.xe);
}

}  // namespace

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
          "momentum", [](const Balance& b) { return copy(b.momentum); }, "(3,) of all nodes, mass x speed")
      .def_readonly("mass", &Balance::mass, "of all nodes, added mass included")
      .def_readonly("added_mass", &Balance::added_mass, "by mass scaling, in the model's unit of mass")
      .def("terms", &balance_terms, "The energies as a dict with the names of the time history (IE, HE, ...).")
      .def("__repr__", [](const Balance& b) {
        return "Balance(" + py::cast<std::string>(py::repr(balance_terms(b))) + ", err=" + std::to_string(b.err) + ")";
      });

  py::class_<NamedResult>(m, "InterfaceResult", "Forces of the last cycle, impulses since the start, on the second surface; energies.")
      .def_readonly("id", &NamedResult::id, "of the interface in the deck")
      .def_property_readonly(
          "normal_force", [](const NamedResult& r) { return copy(r.result.normal_force); }, "(3,) on the second surface")
      .def_property_readonly(
          "tangential_force", [](const NamedResult& r) { return copy(r.result.tangential_force); }, "(3,) friction on the second surface")
      .def_property_readonly(
          "normal_impulse", [](const NamedResult& r) { return copy(r.result.normal_impulse); }, "(3,) force x time")
      .def_property_readonly(
          "tangential_impulse", [](const NamedResult& r) { return copy(r.result.tangential_impulse); }, "(3,) force x time")
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
          "deepest_node", [](const NamedResult& r) { return r.result.deepest_node; },
          "index of the node that has penetrated by that much; -1: none")
      .def_property_readonly(
          "largest_approach", [](const NamedResult& r) { return r.result.largest_approach; },
          "largest normal approach of a held node in the last step, in gaps; 0 without a gap and for TYPE7")
      .def_property_readonly(
          "peak_approach", [](const NamedResult& r) { return r.result.peak_approach; },
          "the largest of them since the last row of the time history before this one")
      .def_property_readonly(
          "facing", [](const NamedResult& r) { return r.result.facing; },
          "(first, second) share of the surface near the other one that faces it, when last looked at; nan: undecided, nodes, TYPE7")
      .def_property_readonly(
          "crossed", [](const NamedResult& r) { return r.crossed.size(); },
          "number of nodes caught in the last cycle before they jumped through")
      .def_property_readonly(
          "lost", [](const NamedResult& r) { return r.lost.size(); }, "number of nodes that went over a free border in the last cycle")
      .def_property_readonly(
          "crossed_nodes", [](const NamedResult& r) { return copy(std::span<const Index>(r.crossed)); },
          "(crossed,) their indices in the order of Model.node_ids")
      .def_property_readonly(
          "lost_nodes", [](const NamedResult& r) { return copy(std::span<const Index>(r.lost)); },
          "(lost,) their indices in the order of Model.node_ids")
      .def("__repr__", [](const NamedResult& r) {
        return "<interface " + std::to_string(r.id) + ": " + std::to_string(r.result.in_contact) + " nodes in contact>";
      });

  py::class_<Outcome>(m, "Outcome", "Why and how a run ended.")
      .def_property_readonly(
          "kind", [](const Outcome& o) { return name_of(o.kind, outcome_kinds); }, "'finished', 'stopped', 'interrupted' or 'failed'")
      .def_readonly("message", &Outcome::message, "why, for people; empty when there is nothing to say")
      .def_readonly("cycles", &Outcome::cycles, "done")
      .def_readonly("time", &Outcome::time, "reached, in the model's unit of time")
      .def("__str__", [](const Outcome& o) { return to_string(o); })
      .def("__repr__", [](const Outcome& o) { return "<" + to_string(o) + ">"; });

  py::class_<RunFinding>(m, "RunFinding", "What was found while the run went on: contacts, deleted elements.")
      .def_readonly("diagnostic", &RunFinding::diagnostic, "code and sentence; the sentence names up to twenty nodes")
      .def_readonly("interface_id", &RunFinding::interface_id, "of the deck; 0: it is not about one")
      .def_readonly("time", &RunFinding::time, "when it was found, in the model's unit of time")
      .def_readonly("cycle", &RunFinding::cycle, "when it was found, cycles from 0")
      .def_readonly("measure", &RunFinding::measure, "how bad it is; docs/findings/index.md says of what, code by code")
      .def_property_readonly(
          "nodes", [](const RunFinding& f) { return copy(std::span<const Id>(f.nodes)); }, "(K,) node ids, all of them")
      .def_property_readonly(
          "segments", [](const RunFinding& f) { return copy(std::span<const std::array<Id, 4>>(f.segments)); },
          "(K, 4) node ids of segments; a triangle repeats its third")
      .def("__str__", [](const RunFinding& f) { return to_string(f.diagnostic); })
      .def("__repr__", [](const RunFinding& f) {
        return "<" + f.diagnostic.code + (f.interface_id == 0 ? "" : " of interface " + std::to_string(f.interface_id)) + ">";
      });
}

}  // namespace abut::python
