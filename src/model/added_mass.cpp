// /ADMAS (deck-format.md D.7): every form ends as masses of single nodes.
#include <fmt/format.h>

#include <iterator>

#include "model/condition_fields.hpp"
#include "model/condition_readers.hpp"
#include "model/measure.hpp"

namespace abut::model {

namespace {

double read_mass(BlockReader& r, Dimension d) {
  const double mass = r.real({1, 20}, "Mass", d);
  if (mass < 0.0) r.error("model.out_of_range", {1, 20}, "Mass", "an added mass cannot be negative; write 0 or more");
  return mass;
}

/// `mass` shared among all elements of the parts in proportion to their own mass, equally by an element's nodes.
void add_to_parts(BlockReader& r, const std::vector<Index>& parts, double mass) {
  Model& m = *r.context().model;
  std::vector<bool> chosen(m.parts.size(), false);
  for (const Index p : parts) chosen[static_cast<std::size_t>(p)] = true;
  const auto is_chosen = [&](Index part) { return part != no_index && chosen[static_cast<std::size_t>(part)]; };
  double total = 0.0;
  for_each_element(m, [&](std::span<const Index>, Index part, double element) { total += is_chosen(part) ? element : 0.0; });
  if (total <= 0.0) {
    if (!parts.empty())
      r.error("model.no_mass", {21, 30}, "part",
              "these parts have no mass of their own to which mass could be added; use /ADMAS/1 with a node group");
    return;
  }
  for_each_element(m, [&](std::span<const Index> nodes, Index part, double element) {
    if (!is_chosen(part)) return;
    for (const Index n : nodes) m.added_masses.push_back({n, mass * element / total / static_cast<double>(nodes.size())});
  });
}

void add_to_surface(BlockReader& r, double mass_per_area) {
  Model& m = *r.context().model;
  const Id id = r.integer({21, 30}, "surf_ID");
  if (id == 0) r.error("model.missing_reference", {21, 30}, "surf_ID", "no surface is given; write the id of a /SURF");
  const Index surface = r.resolve(r.context().tables.surfaces, id, "/SURF", {21, 30}, "surf_ID");
  if (surface == no_index) return;
  for (const Segment& s : m.surfaces[static_cast<std::size_t>(surface)].segments) {
    const std::size_t corners = s.nodes[2] == s.nodes[3] ? 3 : 4;
    const double share = mass_per_area * norm(face_area(m, s.nodes)) / static_cast<double>(corners);
    for (std::size_t i = 0; i < corners; ++i) m.added_masses.push_back({s.nodes[i], share});
  }
}

}  // namespace

void read_added_mass(Context& c, const deck::Block& block) {
  const auto type = deck::parse_integer(block.word(1));
  if (!type || block.word(1).empty() || *type < 0 || *type > 7) {
    return refuse(c, block, fmt::format("'{}' is not a type of added mass; write /ADMAS/0, 1, 2, 3, 5 or 6", block.word(1)));
  }
  if (*type == 4 || *type == 7) {
    return refuse(c, block, fmt::format("a final mass of parts is not supported; give the mass to add with /ADMAS/{}", *type - 1));
  }
  BlockReader r(c, block, 2, true);
  Model& m = *c.model;
  const std::size_t before = m.added_masses.size();
  if (*type >= 5) {
    while (r.next_card()) {
      const double mass = read_mass(r, dim::mass);
      const Id id = r.integer({21, 30}, *type == 5 ? "node_ID" : "part_ID");
      if (*type == 5) {
        const Index node = r.resolve(c.tables.nodes, id, "/NODE", {21, 30}, "node_ID");
        if (node != no_index) m.added_masses.push_back({node, mass});
      } else {
        const Index part = r.resolve(c.tables.parts, id, "/PART", {21, 30}, "part_ID");
        if (part != no_index) add_to_parts(r, {part}, mass);
      }
    }
  } else {
    r.next_card();
    const double mass = read_mass(r, *type == 2 ? dim::mass_per_area : dim::mass);
    if (*type <= 1) {
      const std::vector<Index> nodes = required_group(r, {21, 30}, "grnd_ID");
      const double each = *type == 0 || nodes.empty() ? mass : mass / static_cast<double>(nodes.size());
      for (const Index n : nodes) m.added_masses.push_back({n, each});
    } else if (*type == 2) {
      add_to_surface(r, mass);
    } else {
      const Id id = r.integer({21, 30}, "grpart_ID");
      if (id == 0) r.error("model.missing_reference", {21, 30}, "grpart_ID", "no group of parts is given; write the id of a /GRPART");
      const Index group = r.resolve(c.tables.part_groups, id, "/GRPART", {21, 30}, "grpart_ID");
      if (group != no_index) add_to_parts(r, c.part_groups[static_cast<std::size_t>(group)].members, mass);
    }
  }
  if (m.added_masses.size() == before && !c.diagnostics->has_errors()) {
    c.diagnostics->warning("model.empty_set", r.place(), "no mass is added: the set of nodes is empty");
  }
}

}  // namespace abut::model
