// The parts of the inspection. Each adds what it finds to a list.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/inspect/facing.hpp"
#include "contact/inspect/shape.hpp"

namespace abut::contact {

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
};

/// "12 facets", "1 facet".
[[nodiscard]] std::string counted(std::size_t n, const char* one, const char* many);
/// Three significant digits.
[[nodiscard]] std::string short_number(double value);

void find_topology(const InspectionContext& c);     ///< shared nodes, degenerate, duplicate, junctions, no stiffness
void find_orientation(const InspectionContext& c);  ///< facing, mixed orientation
void find_shape(const InspectionContext& c);        ///< aspect ratio, warp, concave edges
void find_nearness(const InspectionContext& c);     ///< penetrations, clearance, blind nodes, sizes, stiffness, gap, step

}  // namespace abut::contact
