#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <stdexcept>

#include "contact/inspect/findings.hpp"

namespace abut::contact {

namespace {

constexpr std::string_view codes[] = {
    "contact.shared_nodes",      "contact.degenerate_facets",
    "contact.duplicate_facets",  "contact.normals_away",
    "contact.normals_alike",     "contact.partly_away",
    "contact.mixed_orientation", "contact.one_sided",
    "contact.junctions",         "contact.no_stiffness",
    "contact.overlap",           "contact.initial_penetration",
    "contact.out_of_reach",      "contact.blind_nodes",
    "contact.clearance",         "contact.stiffness_ratio",
    "contact.size_ratio",        "contact.gap_large",
    "contact.gap_small",         "contact.interface_step",
    "contact.aspect_ratio",      "contact.warp",
    "contact.concave",
};

}  // namespace

std::span<const std::string_view> inspection_codes() { return codes; }

std::string counted(std::size_t n, const char* one, const char* many) { return std::to_string(n) + " " + (n == 1 ? one : many); }

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::vector<Finding> inspect(const InspectionInput& input, const InspectionLimits& limits, std::array<Facing, 2>* facing) {
  check(input);
  for (const double limit : {limits.aspect_ratio, limits.warp_degrees, limits.size_ratio, limits.stiffness_ratio, limits.concave_degrees,
                             limits.gap_of_size, limits.steps_through_gap}) {
    if (std::isnan(limit)) throw std::invalid_argument("contact: a limit of the inspection is not a number");
  }
  const std::array<Shape, 2> shapes{Shape(input.side[0], input.x), Shape(input.side[1], input.x)};
  BothViews views = input.both_sides ? look_unsigned(shapes, input.x, input.gap) : look(shapes, input.gap);
  std::vector<Finding> out;
  const InspectionContext c{input, limits, shapes, views, out};
  find_topology(c);
  if (!input.both_sides) find_orientation(c);
  find_nearness(c);
  find_shape(c);
  const auto rank = [](const Finding& f) { return std::find(std::begin(codes), std::end(codes), f.code) - std::begin(codes); };
  std::stable_sort(out.begin(), out.end(), [&](const Finding& a, const Finding& b) {
    if (a.severity != b.severity) return a.severity > b.severity;
    return rank(a) < rank(b);
  });
  if (facing != nullptr && !input.both_sides) *facing = views.take_facing();
  return out;
}

}  // namespace abut::contact
