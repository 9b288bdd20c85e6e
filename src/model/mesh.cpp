// /NODE and /PART, and the order in which the mesh is read (deck-format.md B.1, B.2).
#include "model/mesh.hpp"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "model/sort_by_id.hpp"

namespace abut::model {

void read_nodes(Context& c) {
  std::vector<Id> ids;
  std::vector<Vec3> positions;
  std::vector<std::pair<std::int32_t, std::int32_t>> origin;  // block and line, for messages about duplicates
  std::vector<std::int32_t> files;
  std::size_t count = 0;
  for (const deck::Block& b : c.deck->blocks) count += b.is(0, "NODE") ? b.cards.size() : 0;
  ids.reserve(count);
  positions.reserve(count);
  origin.reserve(count);
  files.reserve(count);
  for (std::size_t k = 0; k < c.deck->blocks.size(); ++k) {
    const deck::Block& b = c.deck->blocks[k];
    if (!b.is(0, "NODE")) continue;
    BlockReader r(c, b, -1, false);
    r.last_column(70);
    for (const deck::Card& card : b.cards) {
      r.next_card();
      if (deck::field_text(card.text, {1, 100}).empty()) continue;
      const Id id = r.integer({1, 10}, "node_ID");
      const Vec3 x{r.real({11, 30}, "X", dim::length), r.real({31, 50}, "Y", dim::length), r.real({51, 70}, "Z", dim::length)};
      if (id <= 0) {
        if (!r.blank({1, 10}) && deck::parse_integer(r.text({1, 10})).has_value()) {
          r.error("deck.bad_id", {1, 10}, "node_ID", fmt::format("{} is not an id: a positive integer is needed", id));
        } else if (r.blank({1, 10})) {
          r.error("deck.bad_id", {1, 10}, "node_ID", "a node needs an id: a positive integer");
        }
        continue;
      }
      ids.push_back(id);
      positions.push_back(x);
      origin.emplace_back(static_cast<std::int32_t>(k), card.line);
      files.push_back(card.file);
    }
  }
  const auto place_of = [&](std::size_t k) {
    const deck::Block& block = c.deck->blocks[static_cast<std::size_t>(origin[k].first)];
    return c.deck->place(block, {{}, files[k], origin[k].second});
  };
  Model& m = *c.model;
  m.node_x.reserve(ids.size());
  c.tables.nodes.reserve(ids.size());
  std::size_t first = 0;
  for (const std::size_t k : ascending_order(ids)) {
    if (!m.node_id.empty() && m.node_id.back() == ids[k]) {
      report_duplicate(c, "/NODE", ids[k], place_of(k), place_of(first));
      continue;
    }
    first = k;
    c.tables.nodes.emplace(ids[k], m.node_count());
    m.node_id.push_back(ids[k]);
    m.node_x.push_back(positions[k]);
  }
}

namespace {

/// Ids of all blocks of a keyword, also of those that are refused: a part that refers to one is not at fault itself.
std::set<Id> declared_ids(const Context& c, std::string_view keyword) {
  std::set<Id> ids;
  for (const deck::Block& b : c.deck->blocks) {
    if (b.is(0, keyword)) ids.insert(deck::parse_integer(b.word(2)).value_or(0));
  }
  return ids;
}

}  // namespace

void read_parts(Context& c) {
  struct Entry : Part {
    Id subset = 0;
    Place subset_place;
    bool lacks_material = false;
  };
  std::vector<Entry> parts;
  std::vector<Place> places;
  const std::set<Id> properties = declared_ids(c, "PROP");
  const std::set<Id> materials = declared_ids(c, "MAT");
  const auto resolve = [](BlockReader& r, const Tables::Map& table, const std::set<Id>& declared, Id id, std::string_view what,
                          deck::Columns columns, std::string_view field) {
    return table.count(id) == 0 && declared.count(id) > 0 ? no_index : r.resolve(table, id, what, columns, field);
  };
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "PART")) continue;
    BlockReader r(c, b, 1, true);
    r.last_column(50);
    r.next_card();
    Entry p;
    p.id = r.id();
    p.title = r.title();
    const Id property = r.integer({1, 10}, "prop_ID");
    if (property == 0) r.error("model.missing_reference", {1, 10}, "prop_ID", "a part needs a property: the id of a /PROP block");
    p.property = resolve(r, c.tables.properties, properties, property, "/PROP", {1, 10}, "prop_ID");
    const Id material = r.integer({11, 20}, "mat_ID");
    p.lacks_material = material == 0;
    p.material = resolve(r, c.tables.materials, materials, material, "/MAT", {11, 20}, "mat_ID");
    p.subset = r.integer({21, 30}, "subset_ID");
    p.subset_place = r.place({21, 30}, "subset_ID");
    p.contact_thickness = r.real({31, 50}, "Thick", dim::length);
    if (p.contact_thickness < 0.0)
      r.error("model.negative_thickness", {31, 50}, "Thick",
              fmt::format("{:g} is negative: a thickness is positive, or 0 for that of the property", p.contact_thickness));
    parts.push_back(std::move(p));
    places.push_back(r.place());
  }
  sort_by_id(c, parts, places, "/PART", c.tables.parts);
  for (Entry& p : parts) {
    c.part_subset.push_back(p.subset);
    c.part_subset_place.push_back(std::move(p.subset_place));
    c.part_lacks_material.push_back(p.lacks_material);
    c.model->parts.push_back(std::move(static_cast<Part&>(p)));
  }
}

void refuse_formulations(Context& c, const std::vector<RefusedFormulation>& refused) {
  const Model& m = *c.model;
  std::set<std::pair<Index, ElementKind>> used;
  const auto collect = [&](const std::vector<Index>& parts, ElementKind kind) {
    for (const Index part : parts) used.emplace(m.parts[static_cast<std::size_t>(part)].property, kind);
  };
  collect(m.shells.part, ElementKind::shell4);
  collect(m.sh3ns.part, ElementKind::shell3);
  collect(m.bricks.part, ElementKind::brick);
  collect(m.tetras.part, ElementKind::tetra);
  for (const RefusedFormulation& r : refused) {
    const auto found = c.tables.properties.find(r.property);
    if (found != c.tables.properties.end() && used.count({found->second, r.kind}) > 0) c.diagnostics->add(r.diagnostic);
  }
}

void read_mesh(Context& c) {
  read_nodes(c);
  read_functions(c);
  read_skews(c);
  read_materials(c);
  const std::vector<RefusedFormulation> refused = read_properties(c);
  read_parts(c);
  read_elements(c);
  refuse_formulations(c, refused);
}

}  // namespace abut::model
