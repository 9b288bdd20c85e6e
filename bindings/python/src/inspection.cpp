// The inspection of an interface's geometry, for hosts written in Python.
#include <string>
#include <variant>

#include "abut/contact/inspect.hpp"
#include "arrays.hpp"
#include "contact_names.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using contact::Finding;
using contact::InspectionInput;
using contact::InspectionLimits;
using contact::Surface;

/// Arrays behind the spans of one side.
struct Side {
  std::vector<contact::Facet> facets;
  std::vector<Index> nodes;
  Reals stiffness;
  std::vector<std::int8_t> outward;
};

void check_range(std::span<const Index> nodes, std::size_t count, const char* name) {
  for (const Index n : nodes) {
    if (static_cast<std::size_t>(n) >= count) {
      throw py::value_error(std::string(name) + " names node " + std::to_string(n) + ", but x has " + std::to_string(count) + " rows");
    }
  }
}

Side side_of(const ArrayLike& value, const std::optional<ArrayLike>& stiffness, const std::optional<ArrayLike>& outward, std::size_t count,
             const char* name) {
  Side side;
  if (py::isinstance<Surface>(value.value)) {
    const auto all = value.value.cast<const Surface&>().facets();
    side.facets.assign(all.begin(), all.end());
  } else if (dimensions(value, name) == 1) {
    side.nodes = indices(value, name);
  } else {
    side.facets = facets(value, name);
  }
  check_range(side.nodes, count, name);
  for (const contact::Facet& f : side.facets) check_range(f.node, count, name);
  const auto rows = static_cast<py::ssize_t>(side.facets.size());
  side.stiffness = stiffness ? reals(*stiffness, "stiffness", rows) : Reals{};
  if (outward) {
    for (const double o : reals(*outward, "outward", rows).span) side.outward.push_back(o > 0.0 ? 1 : o < 0.0 ? -1 : 0);
  }
  return side;
}

/// One call of inspect, facing or orient: the arrays and the input that looks at them.
struct Question {
  Points x, v;
  Reals mass;
  std::array<Side, 2> side;
  InspectionInput input;
};

void look_at(Question& q) {
  q.input.x = q.x.span;
  q.input.v = q.v.span;
  q.input.mass = q.mass.span;
  for (std::size_t s = 0; s < 2; ++s) {
    q.input.side[s] = {q.side[s].facets, q.side[s].nodes, q.side[s].stiffness.span, q.side[s].outward};
  }
}

std::vector<Finding> inspect(const ArrayLike& first, const ArrayLike& second, const ArrayLike& x, const std::optional<ArrayLike>& v,
                             const std::optional<ArrayLike>& mass, double gap, double stiffness_scale, bool both_sides, double element_step,
                             const std::optional<ArrayLike>& first_stiffness, const std::optional<ArrayLike>& second_stiffness,
                             const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward,
                             const InspectionLimits& limits) {
  Question q;
  q.x = points(x, "x");
  const std::size_t count = q.x.span.size();
  const auto rows = static_cast<py::ssize_t>(count);
  if (v) q.v = points(*v, "v", rows);
  q.mass = masses(mass, rows);
  q.side[0] = side_of(first, first_stiffness, first_outward, count, "first");
  q.side[1] = side_of(second, second_stiffness, second_outward, count, "second");
  look_at(q);
  q.input.gap = gap;
  q.input.stiffness_scale = stiffness_scale;
  q.input.both_sides = both_sides;
  q.input.element_step = element_step;
  const py::gil_scoped_release free;
  return contact::inspect(q.input, limits);
}

Question geometry(const ArrayLike& first, const ArrayLike& second, const ArrayLike& x, double gap,
                  const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward) {
  Question q;
  q.x = points(x, "x");
  q.side[0] = side_of(first, std::nullopt, first_outward, q.x.span.size(), "first");
  q.side[1] = side_of(second, std::nullopt, second_outward, q.x.span.size(), "second");
  look_at(q);
  q.input.gap = gap;
  return q;
}

py::tuple facing(const ArrayLike& first, const ArrayLike& second, const ArrayLike& x, double gap,
                 const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward) {
  const Question q = geometry(first, second, x, gap, first_outward, second_outward);
  const auto both = contact::facing(q.input);
  return py::make_tuple(both[0], both[1]);
}

py::tuple orient(const ArrayLike& first, const ArrayLike& second, const ArrayLike& x, double gap,
                 const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward) {
  const Question q = geometry(first, second, x, gap, first_outward, second_outward);
  const contact::Orientation o = contact::orient(q.input);
  return py::make_tuple(copy(std::span<const Index>(o.flip[0])), copy(std::span<const Index>(o.flip[1])), o.ambiguous);
}

py::array histogram(const Finding& f) {
  std::vector<double> rows;
  for (const contact::Bar& bar : f.histogram) rows.insert(rows.end(), {bar.low, bar.high, static_cast<double>(bar.count)});
  return py::array(take(std::move(rows))).reshape({py::ssize_t{-1}, py::ssize_t{3}});
}

InspectionLimits limits_of(double aspect_ratio, double warp_degrees, double size_ratio, double stiffness_ratio, double concave_degrees,
                           double gap_of_size, double steps_through_gap) {
  return {aspect_ratio, warp_degrees, size_ratio, stiffness_ratio, concave_degrees, gap_of_size, steps_through_gap};
}

}  // namespace

void bind_inspection(py::module_& m) {
  py::class_<Finding>(m, "Finding", "One thing that the inspection found; docs/findings/index.md has a section for every code.")
      .def_property_readonly(
          "severity", [](const Finding& f) { return name_of(f.severity, contact_severities); }, "'note', 'warning' or 'error'")
      .def_readonly("code", &Finding::code, "stable name, e.g. 'contact.normals_away'")
      .def_readonly("side", &Finding::side, "0 first, 1 second surface, -1 the interface")
      .def_property_readonly(
          "facets", [](const Finding& f) { return copy(std::span<const Index>(f.facets)); }, "(K,) positions in the side's list of facets")
      .def_property_readonly(
          "nodes", [](const Finding& f) { return copy(std::span<const Index>(f.nodes)); }, "(K,) the host's node indices")
      .def_readonly("measure_name", &Finding::measure_name, "what `measure` is")
      .def_readonly("measure", &Finding::measure, "how bad it is, in the host's units")
      .def_readonly("what", &Finding::what, "one sentence: what was found")
      .def_readonly("advice", &Finding::advice, "one sentence: what to do")
      .def_property_readonly("histogram", &histogram, "(B, 3): low, high, count")
      .def("__repr__", [](const Finding& f) { return "<" + name_of(f.severity, contact_severities) + " " + f.code + ": " + f.what + ">"; });

  const InspectionLimits d;
  py::class_<InspectionLimits>(m, "InspectionLimits", "Beyond these the inspection speaks.")
      .def(py::init(&limits_of), py::kw_only(), "aspect_ratio"_a = d.aspect_ratio, "warp_degrees"_a = d.warp_degrees,
           "size_ratio"_a = d.size_ratio, "stiffness_ratio"_a = d.stiffness_ratio, "concave_degrees"_a = d.concave_degrees,
           "gap_of_size"_a = d.gap_of_size, "steps_through_gap"_a = d.steps_through_gap, "Every limit is a property too, described there.")
      .def_readwrite("aspect_ratio", &InspectionLimits::aspect_ratio, "longest over shortest side of a facet")
      .def_readwrite("warp_degrees", &InspectionLimits::warp_degrees, "angle between the two triangles of a quadrilateral, degrees")
      .def_readwrite("size_ratio", &InspectionLimits::size_ratio, "mean facet size of one side over the other's, where they are near")
      .def_readwrite("stiffness_ratio", &InspectionLimits::stiffness_ratio, "own stiffness of one side over the other's")
      .def_readwrite("concave_degrees", &InspectionLimits::concave_degrees, "inward fold, degrees")
      .def_readwrite("gap_of_size", &InspectionLimits::gap_of_size, "gap over the smallest facet size")
      .def_readwrite("steps_through_gap", &InspectionLimits::steps_through_gap, "steps that the fastest approach takes through the gap");

  py::class_<contact::Facing>(m, "Facing", "Whether each facet of a side looks at the other side.")
      .def_property_readonly(
          "facets", [](const contact::Facing& f) { return py::array(py::dtype::of<std::int8_t>(), f.facet.size(), f.facet.data()); },
          "(F,) +1 faces, -1 faces away, 0 nothing near or undecided")
      .def_readonly("area_facing", &contact::Facing::area_facing, "length^2: area of the facets that face")
      .def_readonly("area_away", &contact::Facing::area_away, "length^2: area of the facets that face away")
      .def_readonly("distance", &contact::Facing::distance, "length: smallest distance of the centre of a facet to the other side")
      .def_property_readonly("fraction", &contact::Facing::fraction, "share of the decided area that faces; nan when nothing is decided");

  m.def("inspect", &inspect, "first"_a, "second"_a, "x"_a, py::kw_only(), "v"_a = py::none(), "mass"_a = py::none(), "gap"_a = 0.0,
        "stiffness_scale"_a = 0.2, "both_sides"_a = false, "element_step"_a = 0.0, "first_stiffness"_a = py::none(),
        "second_stiffness"_a = py::none(), "first_outward"_a = py::none(), "second_outward"_a = py::none(), "limits"_a = d,
        "Everything that can be said of an interface before the first step, worst first. Bad geometry is found, not refused;\n"
        "ValueError for arrays that do not fit and for a gap, stiffness_scale or element_step that is negative or not finite.\n\n"
        "first, second: a Surface, facets (F, 3 or 4), or nodes (S,). x, v: (N, 3). mass: (N,). gap: length.\n"
        "*_stiffness: (F,) own stiffness. *_outward: (F,) +1 normal out of the solid behind, -1 into it, 0 shell or not known.");
  m.def("facing", &facing, "first"_a, "second"_a, "x"_a, py::kw_only(), "gap"_a = 0.0, "first_outward"_a = py::none(),
        "second_outward"_a = py::none(), "Facing of both sides; arguments as of inspect().");
  m.def("orient", &orient, "first"_a, "second"_a, "x"_a, py::kw_only(), "gap"_a = 0.0, "first_outward"_a = py::none(),
        "second_outward"_a = py::none(),
        "Facets to reverse so that each side is oriented alike and faces the other: two index arrays, and for each side whether\n"
        "some piece has no clear answer and is left as it is.");
}

}  // namespace abut::python
