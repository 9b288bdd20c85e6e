// The parts of the inspection. Each adds what it finds to a list.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "contact/inspect/facing.hpp"
#include "contact/inspect/shape.hpp"

namespace abut::contact {

/// "12 facets", "1 facet".
[[nodiscard]] std::string counted(std::size_t n, const char* one, const char* many);
/// Three significant digits.
[[nodiscard]] std::string short_number(double value);

/// What is said about facets: "1 segment is" or "12 segments are", the rest of the sentence, what to do.
struct AboutFacets {
  const char* one;
  const char* many;
  std::string rest;
  const char* advice;
};
struct Measured {
  const char* name = nullptr;  ///< none: the number of facets
  double value = 0.0;
};

struct InspectionContext {
  const InspectionInput& input;
  const InspectionLimits& limits;
  const std::array<Shape, 2>& shapes;
  const BothViews& views;
  std::vector<Finding>& out;

  Finding& add(Severity severity, const char* code, int side) const {
    Finding f;
    f.severity = severity;
    f.code = code;
    f.side = side;
    out.push_back(std::move(f));
    return out.back();
  }
  /// Nothing when there are no facets to speak of.
  void add_facets(Severity severity, const char* code, int side, std::vector<Index> facets, const AboutFacets& about,
                  const Measured& measured = {}) const {
    if (facets.empty()) return;
    Finding& f = add(severity, code, side);
    f.measure_name = measured.name != nullptr ? measured.name : "facets";
    f.measure = measured.name != nullptr ? measured.value : static_cast<double>(facets.size());
    f.what = counted(facets.size(), about.one, about.many) + " " + about.rest;
    f.advice = about.advice;
    f.facets = std::move(facets);
  }
};

void find_topology(const InspectionContext& c);     ///< shared nodes, degenerate, duplicate, junctions, no stiffness
void find_orientation(const InspectionContext& c);  ///< facing, mixed orientation
void find_shape(const InspectionContext& c);        ///< aspect ratio, warp, concave edges
void find_nearness(const InspectionContext& c);     ///< penetrations, clearance, blind nodes, sizes, stiffness, gap, step

}  // namespace abut::contact
