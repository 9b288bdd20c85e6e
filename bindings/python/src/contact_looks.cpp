// What an interface tells its host besides the three verbs: findings, forces and contact at nodes, projections.
#include <algorithm>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "held_interface.hpp"

namespace abut::python {
namespace {

using namespace py::literals;

Points positions(const HeldInterface& i, const ArrayLike& x) {
  Points at = points(x, "x");
  if (at.array.shape(0) < i.nodes_needed) throw py::value_error("x must have at least " + std::to_string(i.nodes_needed) + " rows");
  return at;
}

void check_count(const HeldInterface& i, py::ssize_t count) {
  if (count < i.nodes_needed) throw py::value_error("node_count must be at least " + std::to_string(i.nodes_needed));
}

std::vector<contact::Finding> inspect(HeldInterface& i, const ArrayLike& x, const std::optional<ArrayLike>& v,
                                      const std::optional<ArrayLike>& mass, double element_step,
                                      const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward,
                                      const contact::InspectionLimits& limits) {
  const Points at = positions(i, x), speed = v ? points(*v, "v", at.array.shape(0)) : Points{};
  const Reals mass_of = masses(mass, at.array.shape(0));
  const auto sign = [](const std::optional<ArrayLike>& value, const char* name) {
    std::vector<std::int8_t> signs;
    for (const double o : reals(value, name).span) signs.push_back(o > 0.0 ? 1 : o < 0.0 ? -1 : 0);
    return signs;
  };
  const auto first = sign(first_outward, "first_outward"), second = sign(second_outward, "second_outward");
  const Work work(i);
  return i.interface.inspect({.x = at.span, .v = speed.span, .mass = mass_of.span}, element_step, {first, second}, limits);
}

py::tuple nodal_forces(HeldInterface& i, py::ssize_t count) {
  check_count(i, count);
  py::array_t<double> normal({count, py::ssize_t{3}}), tangential({count, py::ssize_t{3}});
  const auto zeroed = [count](py::array_t<double>& a) {
    std::fill_n(a.mutable_data(), a.size(), 0.0);
    return std::span<Vec3>(reinterpret_cast<Vec3*>(a.mutable_data()), static_cast<std::size_t>(count));
  };
  const auto n = zeroed(normal), t = zeroed(tangential);
  const Work work(i);
  i.interface.add_nodal_forces(n, t);
  return py::make_tuple(normal, tangential);
}

py::tuple nodal_contact(HeldInterface& i, py::ssize_t count) {
  check_count(i, count);
  std::vector<contact::NodalContact> nodes(static_cast<std::size_t>(count));
  const Work work(i);
  i.interface.add_nodal_contact(nodes);
  py::array_t<std::int8_t> states(count);
  std::vector<double> opening, penetration;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    states.mutable_at(static_cast<py::ssize_t>(n)) = static_cast<std::int8_t>(nodes[n].state);
    opening.push_back(nodes[n].opening);
    penetration.push_back(nodes[n].penetration);
  }
  return py::make_tuple(states, take(std::move(opening)), take(std::move(penetration)));
}

py::array nodal_area(HeldInterface& i, const ArrayLike& x) {
  const Points at = positions(i, x);
  std::vector<double> area(at.span.size(), 0.0);
  const Work work(i);
  i.interface.add_nodal_area(at.span, area);
  return take(std::move(area));
}

py::tuple projections(HeldInterface& i, const ArrayLike& x, bool move_surface) {
  const Points at = positions(i, x);
  std::vector<Index> nodes;
  std::vector<Vec3> moves;
  const Work work(i);
  for (const contact::Projection& p : i.interface.projections(at.span, move_surface)) {
    nodes.push_back(p.node);
    moves.push_back(p.by);
  }
  return py::make_tuple(copy(std::span<const Index>(nodes)), copy(std::span<const Vec3>(moves)));
}

py::array node_list(HeldInterface& i, std::span<const Index> (contact::Interface::*nodes)() const) {
  const Work work(i);
  return copy((i.interface.*nodes)());
}

}  // namespace

void bind_interface_looks(InterfaceClass& interface) {
  interface
      .def(
          "inspect", &inspect, "x"_a, py::kw_only(), "v"_a = py::none(), "mass"_a = py::none(), "element_step"_a = 0.0,
          "first_outward"_a = py::none(), "second_outward"_a = py::none(), "limits"_a = contact::InspectionLimits{},
          "contact.inspect() of what this interface knows of itself: surfaces, stiffness, gap and stiffness scale. Best before the first\n"
          "step; worst first. Eroded facets are looked at like others.\n\n"
          "x, v: (N, 3), v None: at rest. mass: (N,), None: not known. element_step: time, stable step without the interface, 0: not "
          "known.\n"
          "*_outward: (F,) +1 normal out of the solid behind, -1 into it, 0 shell or not known. Raises ValueError for arrays that are too\n"
          "short or of another shape, a negative mass, or an element_step that is negative or not finite.")
      .def("nodal_forces", &nodal_forces, "node_count"_a, "Normal and tangential contact force on the host's nodes: two (N, 3) arrays.")
      .def("nodal_contact", &nodal_contact, "node_count"_a,
           "What held nodes have to do with the other side, at the positions of the last search: three (N,) arrays.\n\n"
           "State: 0 apart, 1 stick, 2 slip. Opening: distance less the gap, nan where nothing is near or the node is not held.\n"
           "Penetration: of a node in contact, else 0.")
      .def("nodal_area", &nodal_area, "x"_a, "(N,) tributary area of the surfaces' nodes at positions x (N, 3).")
      .def_property_readonly(
          "nodes_in_contact", [](HeldInterface& i) { return node_list(i, &contact::Interface::nodes_in_contact); },
          "(K,) held nodes that touch now: indices, each once")
      .def_property_readonly(
          "nodes_crossed", [](HeldInterface& i) { return node_list(i, &contact::Interface::nodes_crossed); },
          "(K,) nodes that StepResult.crossed of the last evaluate() counts: indices")
      .def_property_readonly(
          "nodes_lost", [](HeldInterface& i) { return node_list(i, &contact::Interface::nodes_lost); },
          "(K,) nodes that StepResult.lost of the last evaluate() counts: indices")
      .def("projections", &projections, "x"_a, py::kw_only(), "move_surface"_a = false,
           "Moves that take initial penetrations away, for the host to apply before it starts: nodes (K,) and moves (K, 3).");
}

}  // namespace abut::python
