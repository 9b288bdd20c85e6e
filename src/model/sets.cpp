// Which groups, surfaces and sets there are; their evaluation on demand; their place in the model.
#include "model/sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "deck/text.hpp"
#include "model/sort_by_id.hpp"

namespace abut::model {

namespace {

constexpr int deepest_nesting = 200;

constexpr std::array<std::string_view, set_family_count> names{"/GRNOD", "/GRSHEL", "/GRSH3N", "/GRBRIC", "/GRPART", "/SURF", "/SET"};

}  // namespace

std::string_view family_name(SetFamily family) { return names[static_cast<std::size_t>(family)]; }

void make_set(std::vector<Index>& members) {
  if (!std::is_sorted(members.begin(), members.end())) std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

std::vector<Index> difference(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::vector<Index> out;
  out.reserve(a.size());
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

std::array<Index, 4> reversed_nodes(const std::array<Index, 4>& n) {
  if (n[2] == n[3]) return {n[2], n[1], n[0], n[0]};
  return {n[3], n[2], n[1], n[0]};
}

SetReader::SetReader(Context& c) : c_(c), m_(*c.model), boxes_(c) {
  const std::size_t parts = m_.parts.size();
  part_shells_.resize(parts);
  part_sh3ns_.resize(parts);
  part_solids_.resize(parts);
  for (Index e = 0; e < m_.shells.size(); ++e)
    part_shells_[static_cast<std::size_t>(m_.shells.part[static_cast<std::size_t>(e)])].push_back(e);
  for (Index e = 0; e < m_.sh3ns.size(); ++e)
    part_sh3ns_[static_cast<std::size_t>(m_.sh3ns.part[static_cast<std::size_t>(e)])].push_back(e);
  for (Index e = 0; e < solid_count(m_); ++e) part_solids_[static_cast<std::size_t>(solid_part(m_, e))].push_back(e);
  for (std::size_t p = 0; p < parts; ++p) subset_parts_[c_.part_subset[p]].push_back(static_cast<Index>(p));
}

void SetReader::collect() {
  std::array<std::unordered_map<Id, Place>, set_family_count> first;
  for (const deck::Block& b : c_.deck->blocks) {
    if (b.is(0, "SUBSET")) {
      BlockReader r(c_, b, 1, true);
      const auto [first_of_id, is_new] = subset_places_.try_emplace(r.id(), r.place());
      if (r.id() > 0 && !is_new) report_duplicate(c_, "/SUBSET", r.id(), r.place(), first_of_id->second);
      std::vector<Id>& children = subset_children_[r.id()];
      for (const Id child : r.id_list("subset_ID")) children.push_back(child);
      continue;
    }
    const auto name = std::find_if(names.begin(), names.end(), [&](std::string_view n) { return b.is(0, n.substr(1)); });
    if (name == names.end()) continue;
    const auto family = static_cast<SetFamily>(name - names.begin());
    if (family == SetFamily::set && !b.is(1, "GENERAL")) {
      c_.diagnostics->error("model.unknown_type", c_.deck->place(b), "of the types of /SET only GENERAL is supported");
      continue;
    }
    const bool has_option = family == SetFamily::surf && (b.is(2, "EXT") || b.is(2, "ALL") || b.is(2, "FREE"));
    Item& item = items_.emplace_back();
    item.family = family;
    item.block = &b;
    item.id_word = has_option ? 3 : 2;
    item.id = deck::parse_integer(b.word(static_cast<std::size_t>(item.id_word))).value_or(0);  // a bad id is reported on evaluation
    const Place place = c_.deck->place(b);
    const auto slot = static_cast<std::size_t>(family);
    if (item.id <= 0) continue;
    if (by_id_[slot].emplace(item.id, &item).second) {
      first[slot].emplace(item.id, place);
    } else {
      report_duplicate(c_, family_name(family), item.id, place, first[slot][item.id]);
    }
  }
  check_subsets();
}

void SetReader::check_subsets() {
  // Depth first: a child that is still open holds the subset that names it.
  std::unordered_map<Id, bool> open;
  for (const auto& [root, root_place] : subset_places_) {
    std::vector<std::pair<Id, std::size_t>> path;  // subset, children looked at
    if (open.try_emplace(root, true).second) path.emplace_back(root, 0);
    while (!path.empty()) {
      auto& [id, next] = path.back();
      const std::vector<Id>& children = subset_children_.at(id);
      if (next == children.size()) {
        open[id] = false;
        path.pop_back();
        continue;
      }
      const Id child = children[next++];
      const auto place = subset_places_.find(child);
      if (place == subset_places_.end()) continue;
      const auto [entry, is_new] = open.try_emplace(child, true);
      if (is_new) {
        path.emplace_back(child, 0);
      } else if (entry->second) {
        c_.diagnostics->error("model.circular_reference", place->second, "the subset contains itself");
      }
    }
  }
  for (const auto& [id, place] : subset_places_) {
    for (const Id child : subset_children_[id]) {
      if (subset_places_.count(child) > 0) continue;
      const bool named = subset_parts_.count(child) > 0;
      c_.diagnostics->warning(
          "model.unknown_member", place,
          fmt::format("no /SUBSET with id {}: {}", child, named ? "it is taken as that of the parts that name it" : "left out"));
    }
  }
  std::set<Id> told;
  for (std::size_t p = 0; p < c_.part_subset.size(); ++p) {
    const Id subset = c_.part_subset[p];
    if (subset == 0 || subset_places_.count(subset) > 0 || !told.insert(subset).second) continue;
    c_.diagnostics->warning("model.unknown_member", c_.part_subset_place[p],
                            fmt::format("no /SUBSET with id {}: parts that name it are reached by this id alone", subset));
  }
}

SetReader::Item* SetReader::find(SetFamily family, Id id) {
  for (const SetFamily f : {family, SetFamily::set}) {
    const auto& table = by_id_[static_cast<std::size_t>(f)];
    const auto found = table.find(id);
    if (found != table.end()) return found->second;
  }
  return nullptr;
}

bool SetReader::evaluate(Item& item) {
  if (item.state == Item::State::done) return true;
  if (item.state == Item::State::in_progress || depth_ >= deepest_nesting) {
    c_.diagnostics->error("model.circular_reference", c_.deck->place(*item.block),
                          "the set contains itself, or sets are nested too deeply");
    return false;
  }
  item.state = Item::State::in_progress;
  ++depth_;
  switch (item.family) {
    case SetFamily::grnod:
      evaluate_node_group(item);
      break;
    case SetFamily::grshel:
    case SetFamily::grsh3n:
    case SetFamily::grbric:
      evaluate_element_group(item);
      break;
    case SetFamily::grpart:
      evaluate_part_group(item);
      break;
    case SetFamily::surf:
      evaluate_surface(item);
      break;
    case SetFamily::set:
      evaluate_general_set(item);
      break;
  }
  --depth_;
  item.state = Item::State::done;
  return true;
}

const SetReader::Members* SetReader::members(SetFamily family, Id id) {
  Item* item = find(family, id);
  if (item == nullptr || !evaluate(*item)) return nullptr;
  if (item->family != SetFamily::set || family == SetFamily::grnod) return &item->members;
  switch (family) {
    case SetFamily::grshel:
      return &item->shells;
    case SetFamily::grsh3n:
      return &item->sh3ns;
    case SetFamily::grbric:
      return &item->solids;
    default:
      return &item->parts;
  }
}

const std::vector<Segment>* SetReader::segments(Id id) {
  Item* item = find(SetFamily::surf, id);
  return item != nullptr && evaluate(*item) ? &item->segments : nullptr;
}

void SetReader::register_results() {
  Model& m = *c_.model;
  std::vector<Item*> order;
  for (Item& item : items_) {
    if (item.id > 0 && by_id_[static_cast<std::size_t>(item.family)].at(item.id) == &item) order.push_back(&item);
  }
  // Sets come after the family they may stand in for, so that a group of the same id wins.
  std::stable_sort(order.begin(), order.end(), [](const Item* a, const Item* b) {
    return std::pair(a->id, a->family == SetFamily::set) < std::pair(b->id, b->family == SetFamily::set);
  });
  std::string first_served;  // families that have the id of the set at hand
  const auto add = [&](Tables::Map& table, auto& groups, SetFamily family, Id id, auto members, auto... title) {
    const bool empty = members.empty();
    if (table.emplace(id, static_cast<Index>(groups.size())).second) {
      groups.push_back({id, std::move(title)..., std::move(members)});
    } else if (!empty) {
      first_served += fmt::format("{}{}", first_served.empty() ? "" : ", ", family_name(family));
    }
  };
  for (Item* item : order) {
    first_served.clear();
    const bool is_set = item->family == SetFamily::set;
    const auto serves = [&](SetFamily family) { return item->family == family || is_set; };
    const auto of_kind = [&](Members& of_set) { return std::move(is_set ? of_set : item->members); };
    if (serves(SetFamily::grshel)) add(c_.tables.shell_groups, c_.shell_groups, SetFamily::grshel, item->id, of_kind(item->shells));
    if (serves(SetFamily::grsh3n)) add(c_.tables.sh3n_groups, c_.sh3n_groups, SetFamily::grsh3n, item->id, of_kind(item->sh3ns));
    if (serves(SetFamily::grbric)) add(c_.tables.brick_groups, c_.brick_groups, SetFamily::grbric, item->id, of_kind(item->solids));
    if (serves(SetFamily::grpart)) add(c_.tables.part_groups, c_.part_groups, SetFamily::grpart, item->id, of_kind(item->parts));
    if (serves(SetFamily::surf) && !(is_set && item->segments.empty())) {
      add(c_.tables.surfaces, m.surfaces, SetFamily::surf, item->id, std::move(item->segments), item->title);
    }
    if (serves(SetFamily::grnod))
      add(c_.tables.node_groups, m.node_groups, SetFamily::grnod, item->id, std::move(item->members), item->title);
    if (!first_served.empty()) {
      c_.diagnostics->warning("model.ambiguous_group", c_.deck->place(*item->block),
                              fmt::format("{} with the same id: references to id {} get those, not this set", first_served, item->id));
    }
  }
}

void SetReader::read() {
  collect();
  for (Item& item : items_) {
    if (item.state == Item::State::unknown) evaluate(item);
  }
  register_results();
}

void read_sets(Context& c) { SetReader(c).read(); }

}  // namespace abut::model
