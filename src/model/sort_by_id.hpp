// Items of one keyword family, sorted by id; an id used twice is an error that names both places.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "model/reader.hpp"

namespace abut::model {

/// Order in which `ids` are ascending (stable).
[[nodiscard]] inline std::vector<std::size_t> ascending_order(const std::vector<Id>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(ids.begin(), ids.end())) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  }
  return order;
}

[[nodiscard]] inline std::string describe(const Place& p) { return fmt::format("{}:{}", p.file, p.line); }

inline void report_duplicate(Context& c, std::string_view what, Id id, Place second, const Place& first) {
  c.diagnostics->error("model.duplicate_id", std::move(second),
                       fmt::format("a second {} with id {} (the first is at {}): ids must be unique", what, id, describe(first)));
}

/// Sorts `items` (with a member `id`) and fills `table`; `places[i]` is where items[i] is defined.
template <class Item>
void sort_by_id(Context& c, std::vector<Item>& items, const std::vector<Place>& places, std::string_view what, Tables::Map& table) {
  std::vector<Id> ids;
  ids.reserve(items.size());
  for (const Item& item : items) ids.push_back(item.id);
  std::vector<Item> sorted;
  sorted.reserve(items.size());
  const Place* last = nullptr;
  for (const std::size_t k : ascending_order(ids)) {
    if (!sorted.empty() && sorted.back().id == ids[k]) {
      report_duplicate(c, what, ids[k], places[k], *last);
      continue;
    }
    last = &places[k];
    table.emplace(ids[k], static_cast<Index>(sorted.size()));
    sorted.push_back(std::move(items[k]));
  }
  items = std::move(sorted);
}

}  // namespace abut::model
