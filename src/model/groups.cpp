// /GRNOD, /GRSHEL, /GRSH3N, /GRBRIC, /GRPART (deck-format.md C.1 to C.3).
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_set>

#include "deck/text.hpp"
#include "model/sets.hpp"

namespace abut::model {

namespace {

std::string_view element_word(SetFamily family) {
  return family == SetFamily::grshel ? "SHEL" : (family == SetFamily::grsh3n ? "SH3N" : "BRIC");
}

}  // namespace

SetReader::SignedIds SetReader::signed_ids(BlockReader& r, std::string_view field) const {
  SignedIds out;
  for (const Id id : r.id_list(field)) {
    if (id > 0) out.plus.push_back(id);
    if (id < 0 && id > std::numeric_limits<Id>::min()) out.minus.push_back(-id);
  }
  return out;
}

void SetReader::warn_missing(BlockReader& r, std::string_view what, const std::vector<Id>& missing) {
  if (missing.empty()) return;
  std::string message = fmt::format("no {} with id {}", what, missing.front());
  if (missing.size() > 1) message += fmt::format(" (nor {} more of the list)", missing.size() - 1);
  c_.diagnostics->warning("model.unknown_member", r.place(), message + ": left out");
}

bool SetReader::subset_exists(Id subset) const { return subset_children_.count(subset) > 0 || subset_parts_.count(subset) > 0; }

std::vector<Index> SetReader::parts_of_subset(Id subset) const {
  std::vector<Index> parts;
  std::unordered_set<Id> seen{subset};
  for (std::vector<Id> open{subset}; !open.empty();) {
    const Id current = open.back();
    open.pop_back();
    if (const auto own = subset_parts_.find(current); own != subset_parts_.end())
      parts.insert(parts.end(), own->second.begin(), own->second.end());
    if (const auto children = subset_children_.find(current); children != subset_children_.end()) {
      for (const Id child : children->second) {
        if (seen.insert(child).second) open.push_back(child);
      }
    }
  }
  make_set(parts);
  return parts;
}

/// nullopt: `type` is not a word that selects parts.
std::optional<SetReader::SignedParts> SetReader::parts_of(BlockReader& r, std::string_view type, const SignedIds& ids) {
  const bool by_part = deck::same_word(type, "PART");
  const bool by_subset = deck::same_word(type, "SUBSET") || deck::same_word(type, "SUBS");
  const bool by_material = deck::same_word(type, "MAT");
  const bool by_property = deck::same_word(type, "PROP");
  if (!by_part && !by_subset && !by_material && !by_property) return std::nullopt;
  const std::string_view what = by_part ? "/PART" : (by_subset ? "/SUBSET" : (by_material ? "/MAT" : "/PROP"));
  std::vector<Id> missing;
  const auto append = [&](Id id, Members& out) {
    if (by_subset) {
      if (!subset_exists(id)) missing.push_back(id);
      const std::vector<Index> parts = parts_of_subset(id);
      out.insert(out.end(), parts.begin(), parts.end());
      return;
    }
    const Tables::Map& table = by_part ? c_.tables.parts : (by_material ? c_.tables.materials : c_.tables.properties);
    const auto found = table.find(id);
    if (found == table.end()) {
      missing.push_back(id);
    } else if (by_part) {
      out.push_back(found->second);
    } else {
      for (std::size_t p = 0; p < m_.parts.size(); ++p) {
        if ((by_material ? m_.parts[p].material : m_.parts[p].property) == found->second) out.push_back(static_cast<Index>(p));
      }
    }
  };
  SignedParts parts;
  for (const Id id : ids.plus) append(id, parts.plus);
  for (const Id id : ids.minus) append(id, parts.minus);
  warn_missing(r, what, missing);
  return parts;
}

void SetReader::add_ranges(BlockReader& r, bool triples, const std::vector<std::pair<const Ids*, Index>>& tables, Members& out) {
  // Place of the first id that is not below `wanted`.
  const auto first_of = [](const Ids& ids, Id wanted) {
    std::size_t low = 0, high = ids.size();
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (ids[middle] < wanted) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  };
  const auto add = [&](Id first, Id last, Id step) {
    for (const auto& [ids, offset] : tables) {
      for (std::size_t k = first_of(*ids, first); k < ids->size() && (*ids)[k] <= last; ++k) {
        if (((*ids)[k] - first) % step == 0) out.push_back(static_cast<Index>(k) + offset);
      }
    }
  };
  while (r.next_card()) {
    for (int k = 0; k < (triples ? 1 : 5); ++k) {
      const deck::Columns first_columns{20 * k + 1, 20 * k + 10};
      const deck::Columns last_columns{20 * k + 11, 20 * k + 20};
      const Id first = r.integer(first_columns, "first");
      Id last = r.integer(last_columns, "last");
      const Id step = triples ? r.integer({21, 30}, "increment") : 1;
      if (first == 0 && last == 0) continue;
      if (last == 0) last = first;
      if (first < 0 || last < first) {
        r.error("model.bad_range", last_columns, "last",
                fmt::format("the range {} to {} is empty: it goes from a smaller to a larger id", first, last));
        continue;
      }
      if (triples && step < 0) {
        r.error("model.bad_range", {21, 30}, "increment", fmt::format("the increment {} must be positive", step));
        continue;
      }
      add(first, last, step == 0 ? 1 : step);
    }
  }
}

std::span<const Index> SetReader::nodes_of(SetFamily family, Index element) const {
  const auto e = static_cast<std::size_t>(element);
  if (family == SetFamily::grshel) return m_.shells.nodes[e];
  if (family == SetFamily::grsh3n) return m_.sh3ns.nodes[e];
  return solid_nodes(m_, element);
}

Index SetReader::element_count(SetFamily family) const {
  return family == SetFamily::grshel ? m_.shells.size() : (family == SetFamily::grsh3n ? m_.sh3ns.size() : solid_count(m_));
}

const SetReader::Members& SetReader::elements_of_part(SetFamily family, Index part) const {
  const auto p = static_cast<std::size_t>(part);
  return family == SetFamily::grshel ? part_shells_[p] : (family == SetFamily::grsh3n ? part_sh3ns_[p] : part_solids_[p]);
}

std::optional<Index> SetReader::element_index(SetFamily family, Id id) const {
  const auto look = [id](const Tables::Map& table, Index offset) -> std::optional<Index> {
    const auto found = table.find(id);
    return found == table.end() ? std::nullopt : std::optional<Index>(found->second + offset);
  };
  if (family == SetFamily::grshel) return look(c_.tables.shells, 0);
  if (family == SetFamily::grsh3n) return look(c_.tables.sh3ns, 0);
  const std::optional<Index> brick = look(c_.tables.bricks, 0);
  return brick ? brick : look(c_.tables.tetras, m_.bricks.size());
}

void SetReader::append_nodes_of_element(SetFamily family, Index element, Members& out) const {
  const std::span<const Index> nodes = nodes_of(family, element);
  out.insert(out.end(), nodes.begin(), nodes.end());
}

void SetReader::append_nodes_of_part(Index part, Members& out) const {
  for (const SetFamily family : {SetFamily::grshel, SetFamily::grsh3n, SetFamily::grbric}) {
    for (const Index e : elements_of_part(family, part)) append_nodes_of_element(family, e, out);
  }
}

SetReader::Members SetReader::elements_inside(SetFamily family, const std::vector<bool>& inside, bool any) const {
  Members out;
  for (Index e = 0; e < element_count(family); ++e) {
    const std::span<const Index> nodes = nodes_of(family, e);
    const auto in = [&](Index n) { return inside[static_cast<std::size_t>(n)]; };
    if (any ? std::any_of(nodes.begin(), nodes.end(), in) : std::all_of(nodes.begin(), nodes.end(), in)) out.push_back(e);
  }
  return out;
}

std::vector<bool> SetReader::inside_boxes(BlockReader& r) {
  std::vector<bool> in(m_.node_x.size(), false);
  std::vector<Id> missing;
  const SignedIds ids = signed_ids(r, "box_ID");
  for (const bool removing : {false, true}) {
    for (const Id id : removing ? ids.minus : ids.plus) {
      const std::vector<bool>* other = boxes_.nodes_inside(id);
      if (other == nullptr) missing.push_back(id);
      for (std::size_t k = 0; other != nullptr && k < in.size(); ++k) {
        if ((*other)[k]) in[k] = !removing;
      }
    }
  }
  warn_missing(r, "/BOX", missing);
  return in;
}

/// Union of the positive groups minus the negative ones; `append(member, out)` turns a member into what is collected.
template <class Append>
SetReader::Members SetReader::combine_groups(BlockReader& r, SetFamily family, std::string_view what, const Append& append) {
  const SignedIds ids = signed_ids(r, "group_ID");
  std::vector<Id> missing;
  Members plus;
  Members minus;
  for (const bool removing : {false, true}) {
    for (const Id id : removing ? ids.minus : ids.plus) {
      const Members* group = members(family, id);
      if (group == nullptr) {
        missing.push_back(id);
        continue;
      }
      for (const Index member : *group) append(member, removing ? minus : plus);
    }
  }
  warn_missing(r, what, missing);
  make_set(plus);
  make_set(minus);
  return difference(plus, minus);
}

SetReader::Members SetReader::combine_groups_of_solids(BlockReader& r) {
  return combine_groups(r, SetFamily::grbric, "/GRBRIC", [](Index e, Members& out) { out.push_back(e); });
}

void SetReader::evaluate_node_group(Item& item) {
  BlockReader r(c_, *item.block, item.id_word, true);
  item.title = r.title();
  const std::string type = deck::to_upper(item.block->word(1));
  Members plus;
  Members minus;
  if (type == "NODE" || type == "NODENS") {
    std::vector<Id> missing;
    const SignedIds ids = signed_ids(r, "node_ID");
    for (const bool removing : {false, true}) {
      for (const Id id : removing ? ids.minus : ids.plus) {
        const auto found = c_.tables.nodes.find(id);
        if (found == c_.tables.nodes.end()) {
          missing.push_back(id);
        } else {
          (removing ? minus : plus).push_back(found->second);
        }
      }
    }
    warn_missing(r, "/NODE", missing);
  } else if (type == "GENE" || type == "GEN_INCR") {
    add_ranges(r, type == "GEN_INCR", {{&m_.node_id, 0}}, plus);
  } else if (type == "GRNOD") {
    plus = combine_groups(r, SetFamily::grnod, "/GRNOD", [](Index n, Members& out) { out.push_back(n); });
  } else if (type == "GRSHEL" || type == "GRSH3N" || type == "GRBRIC") {
    const SetFamily family = type == "GRSHEL" ? SetFamily::grshel : (type == "GRSH3N" ? SetFamily::grsh3n : SetFamily::grbric);
    plus = combine_groups(r, family, family_name(family), [&](Index e, Members& out) { append_nodes_of_element(family, e, out); });
  } else if (type == "SURF") {
    std::vector<Id> missing;
    const SignedIds ids = signed_ids(r, "surf_ID");
    for (const bool removing : {false, true}) {
      for (const Id id : removing ? ids.minus : ids.plus) {
        const std::vector<Segment>* surface = segments(id);
        if (surface == nullptr) {
          missing.push_back(id);
          continue;
        }
        for (const Segment& s : *surface) (removing ? minus : plus).insert((removing ? minus : plus).end(), s.nodes.begin(), s.nodes.end());
      }
    }
    warn_missing(r, "/SURF", missing);
  } else if (type == "BOX") {
    const std::vector<bool> in = inside_boxes(r);
    for (std::size_t k = 0; k < in.size(); ++k) {
      if (in[k]) plus.push_back(static_cast<Index>(k));
    }
  } else if (const std::optional<SignedParts> parts = parts_of(r, type, signed_ids(r, "ID"))) {
    for (const Index p : parts->plus) append_nodes_of_part(p, plus);
    for (const Index p : parts->minus) append_nodes_of_part(p, minus);
  } else {
    c_.diagnostics->error(
        "model.unknown_type", r.place(),
        fmt::format("type '{}' of /GRNOD is not supported: NODE, GENE, GEN_INCR, PART, SUBSET, MAT, PROP, GRNOD, GRSHEL, GRSH3N, "
                    "GRBRIC, SURF and BOX are",
                    deck::printable(item.block->word(1))));
    return;
  }
  make_set(plus);
  make_set(minus);
  item.members = minus.empty() ? std::move(plus) : difference(plus, minus);
  if (item.members.empty()) c_.diagnostics->warning("model.empty_group", r.place(), "the group holds no node");
}

void SetReader::evaluate_element_group(Item& item) {
  BlockReader r(c_, *item.block, item.id_word, true);
  item.title = r.title();
  const SetFamily family = item.family;
  const std::string type = deck::to_upper(item.block->word(1));
  Members plus;
  Members minus;
  if (type == element_word(family) || (type == "SHELL" && family == SetFamily::grshel) ||
      (type == "BRICK" && family == SetFamily::grbric)) {
    std::vector<Id> missing;
    const SignedIds ids = signed_ids(r, "elem_ID");
    for (const bool removing : {false, true}) {
      for (const Id id : removing ? ids.minus : ids.plus) {
        if (const std::optional<Index> e = element_index(family, id)) {
          (removing ? minus : plus).push_back(*e);
        } else {
          missing.push_back(id);
        }
      }
    }
    warn_missing(r, family == SetFamily::grshel ? "/SHELL" : (family == SetFamily::grsh3n ? "/SH3N" : "/BRICK or /TETRA4"), missing);
  } else if (type == "GENE" || type == "GEN_INCR") {
    const bool triples = type == "GEN_INCR";
    if (family == SetFamily::grshel) add_ranges(r, triples, {{&m_.shells.id, 0}}, plus);
    if (family == SetFamily::grsh3n) add_ranges(r, triples, {{&m_.sh3ns.id, 0}}, plus);
    if (family == SetFamily::grbric) add_ranges(r, triples, {{&m_.bricks.id, 0}, {&m_.tetras.id, m_.bricks.size()}}, plus);
  } else if (type == family_name(family).substr(1)) {
    plus = combine_groups(r, family, family_name(family), [](Index e, Members& out) { out.push_back(e); });
  } else if (type == "BOX" || type == "BOX2") {
    plus = elements_inside(family, inside_boxes(r), type == "BOX2");
  } else if (const std::optional<SignedParts> parts = parts_of(r, type, signed_ids(r, "ID"))) {
    for (const Index p : parts->plus) plus.insert(plus.end(), elements_of_part(family, p).begin(), elements_of_part(family, p).end());
    for (const Index p : parts->minus) minus.insert(minus.end(), elements_of_part(family, p).begin(), elements_of_part(family, p).end());
  } else {
    c_.diagnostics->error(
        "model.unknown_type", r.place(),
        fmt::format("type '{}' of {} is not supported: {}, GENE, GEN_INCR, PART, SUBSET, MAT, PROP, {}, BOX and BOX2 are",
                    deck::printable(item.block->word(1)), family_name(family), element_word(family), family_name(family).substr(1)));
    return;
  }
  make_set(plus);
  make_set(minus);
  item.members = minus.empty() ? std::move(plus) : difference(plus, minus);
  if (item.members.empty()) c_.diagnostics->warning("model.empty_group", r.place(), "the group holds no element");
}

void SetReader::evaluate_part_group(Item& item) {
  BlockReader r(c_, *item.block, item.id_word, true);
  item.title = r.title();
  const std::string type = deck::to_upper(item.block->word(1));
  if (type == "GRPART") {
    item.members = combine_groups(r, SetFamily::grpart, "/GRPART", [](Index p, Members& out) { out.push_back(p); });
  } else if (type == "GENE" || type == "GEN_INCR") {
    Ids ids;
    for (const Part& p : m_.parts) ids.push_back(p.id);
    add_ranges(r, type == "GEN_INCR", {{&ids, 0}}, item.members);
    make_set(item.members);
  } else if (std::optional<SignedParts> parts = parts_of(r, type, signed_ids(r, "ID"))) {
    make_set(parts->plus);
    make_set(parts->minus);
    item.members = difference(parts->plus, parts->minus);
  } else {
    c_.diagnostics->error("model.unknown_type", r.place(),
                          fmt::format("type '{}' of /GRPART is not supported: PART, GRPART, SUBSET, MAT, PROP, GENE and GEN_INCR are",
                                      deck::printable(item.block->word(1))));
    return;
  }
  if (item.members.empty()) c_.diagnostics->warning("model.empty_group", r.place(), "the group holds no part");
}

}  // namespace abut::model
