// /SET/GENERAL (deck-format.md C.8): clauses that add entities to, or remove them from, one set.
#include <fmt/format.h>

#include <algorithm>

#include "deck/text.hpp"
#include "model/sets.hpp"

namespace abut::model {

namespace {

constexpr deck::Columns key_columns{1, 10};
constexpr std::string_view key_name =
    "clause (NODE, NODENS, PART, SUBS, SHELL, SH3N, SOLID, SET, ALL; SEG with n1 to n4 in 21-60; suffix _D removes, _O reverses, _A all "
    "faces, _E outer faces)";

enum class Action { add, remove, reversed, all_faces, external_faces };

std::optional<Action> action_of(std::string_view suffix) {
  if (suffix.empty()) return Action::add;
  if (suffix == "_D") return Action::remove;
  if (suffix == "_O") return Action::reversed;
  if (suffix == "_A") return Action::all_faces;
  if (suffix == "_E") return Action::external_faces;
  return std::nullopt;
}

}  // namespace

void SetReader::apply_clause(BlockReader& r, std::string_view key, const std::vector<Id>& ids, Content& content) {
  const std::size_t underscore = key.find('_');
  const std::string_view kind = key.substr(0, underscore);
  const std::optional<Action> action = action_of(underscore == std::string_view::npos ? std::string_view{} : key.substr(underscore));
  const auto refuse = [&] {
    r.error(
        "model.set_clause", key_columns, "KEY",
        fmt::format(
            "clause '{}' is not supported: NODE, PART, SUBS, SHELL, SH3N, SOLID, SEG, SET and ALL are, with the suffixes _D, _O, _A and _E",
            deck::printable(key)));
  };
  if (!action) return refuse();
  const bool removing = *action == Action::remove;
  const auto put = [&](std::map<Index, bool>& elements, Index e, bool flag) {
    if (removing) {
      elements.erase(e);
    } else {
      elements.insert_or_assign(e, flag);
    }
  };
  const auto put_node = [&](Index n) {
    if (removing) {
      content.nodes.erase(n);
      content.removed_nodes.insert(n);
    } else {
      content.nodes.insert(n);
      content.removed_nodes.erase(n);
    }
  };
  const auto put_part = [&](Index p) {
    if (removing) {
      content.parts.erase(p);
    } else {
      content.parts.insert(p);
    }
    const auto i = static_cast<std::size_t>(p);
    for (const Index e : part_shells_[i]) put(content.shells, e, *action == Action::reversed);
    for (const Index e : part_sh3ns_[i]) put(content.sh3ns, e, *action == Action::reversed);
    for (const Index e : part_solids_[i]) put(content.solids, e, *action == Action::all_faces);
  };
  std::vector<Id> missing;
  const auto put_elements = [&](SetFamily family, std::map<Index, bool>& elements, Action flag, std::string_view what) {
    for (const Id id : ids) {
      if (const std::optional<Index> e = element_index(family, id)) {
        put(elements, *e, *action == flag);
      } else {
        missing.push_back(id);
      }
    }
    warn_missing(r, what, missing);
  };
  if (kind == "NODE" || kind == "NODENS") {
    for (const Id id : ids) {
      const auto found = c_.tables.nodes.find(id);
      if (found == c_.tables.nodes.end()) {
        missing.push_back(id);
      } else {
        put_node(found->second);
      }
    }
    warn_missing(r, "/NODE", missing);
  } else if (kind == "PART" || kind == "SUBS") {
    const std::optional<SignedParts> parts = parts_of(r, kind, {ids, {}});
    for (const Index p : parts->plus) put_part(p);
  } else if (kind == "SHELL") {
    put_elements(SetFamily::grshel, content.shells, Action::reversed, "/SHELL");
  } else if (kind == "SH3N") {
    put_elements(SetFamily::grsh3n, content.sh3ns, Action::reversed, "/SH3N");
  } else if (kind == "SOLID") {
    put_elements(SetFamily::grbric, content.solids, Action::all_faces, "/BRICK or /TETRA4");
  } else if (kind == "ALL") {
    for (Index n = 0; n < m_.node_count(); ++n) put_node(n);
    for (std::size_t p = 0; p < m_.parts.size(); ++p) put_part(static_cast<Index>(p));
  } else if (kind == "SET") {
    for (const Id id : ids) {
      const auto& sets = by_id_[static_cast<std::size_t>(SetFamily::set)];
      const auto found = sets.find(id);
      if (found == sets.end()) {
        missing.push_back(id);
        continue;
      }
      if (!evaluate(*found->second) || !found->second->content) continue;
      const Content& other = *found->second->content;
      for (const Index n : other.nodes) put_node(n);
      for (const Index p : other.parts) {
        if (removing) {
          content.parts.erase(p);
        } else {
          content.parts.insert(p);
        }
      }
      for (const auto& [e, flag] : other.shells) put(content.shells, e, flag != (*action == Action::reversed));
      for (const auto& [e, flag] : other.sh3ns) put(content.sh3ns, e, flag != (*action == Action::reversed));
      for (const auto& [e, flag] : other.solids) put(content.solids, e, flag || *action == Action::all_faces);
      if (!removing) content.segments.insert(content.segments.end(), other.segments.begin(), other.segments.end());
    }
    warn_missing(r, "/SET", missing);
  } else {
    refuse();
  }
}

void SetReader::evaluate_general_set(Item& item) {
  BlockReader r(c_, *item.block, item.id_word, true);
  item.title = r.title();
  item.content = std::make_unique<Content>();
  std::string key;
  while (r.next_card()) {
    if (r.blank({1, 100})) continue;
    if (!r.blank(key_columns)) key = deck::to_upper(r.text(key_columns, key_name));
    if (key.empty()) {
      r.error("model.set_clause", key_columns, "KEY", "the first line of a set names a kind, such as NODE or PART");
      continue;
    }
    if (key == "SEG" || key == "SEG_O") {
      (void)r.integer({11, 20}, "seg_ID");
      if (std::optional<Segment> s = read_segment(r, 21)) {
        if (key == "SEG_O") s->nodes = reversed_nodes(s->nodes);
        item.content->segments.push_back(*s);
      }
      continue;
    }
    std::vector<Id> ids;
    for (int k = 1; k < 10; ++k) {
      const Id id = r.integer({10 * k + 1, 10 * k + 10}, "ID");
      if (id != 0) ids.push_back(id);
    }
    r.surplus_text("ID");
    apply_clause(r, key, ids, *item.content);
  }
  finish_general_set(item);
  if (item.members.empty()) c_.diagnostics->warning("model.empty_group", r.place(), "the set holds nothing");
}

void SetReader::finish_general_set(Item& item) {
  const Content& content = *item.content;
  Members nodes(content.nodes.begin(), content.nodes.end());
  Members all_faced;
  for (const auto& [e, reversed] : content.shells) {
    item.shells.push_back(e);
    append_nodes_of_element(SetFamily::grshel, e, nodes);
    add_shell(e, reversed, item.segments);
  }
  for (const auto& [e, reversed] : content.sh3ns) {
    item.sh3ns.push_back(e);
    append_nodes_of_element(SetFamily::grsh3n, e, nodes);
    add_sh3n(e, reversed, item.segments);
  }
  for (const auto& [e, all] : content.solids) {
    item.solids.push_back(e);
    if (all) all_faced.push_back(e);
    append_nodes_of_element(SetFamily::grbric, e, nodes);
  }
  const std::vector<Segment> shells = item.segments;
  add_solids(difference(item.solids, all_faced), item.solids, Faces::external, shells, item.segments);
  add_solids(all_faced, all_faced, Faces::all, {}, item.segments);
  for (const Segment& s : content.segments) {
    item.segments.push_back(s);
    nodes.insert(nodes.end(), s.nodes.begin(), s.nodes.end());
  }
  item.parts.assign(content.parts.begin(), content.parts.end());
  make_set(nodes);
  item.members = difference(nodes, Members(content.removed_nodes.begin(), content.removed_nodes.end()));
}

}  // namespace abut::model
