#include "model/condition_fields.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string>

namespace abut::model {

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
  });
}

bool is_keyword(const deck::Block& block, std::string_view first, std::string_view second) {
  return same_word(block.word(0), first) && (second.empty() || same_word(block.word(1), second));
}

bool is_id(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char x) { return x >= '0' && x <= '9'; });
}

void refuse(Context& c, const deck::Block& block, std::string message) {
  c.diagnostics->error("model.unsupported", c.deck->place(block), std::move(message));
}

double real_or(BlockReader& r, deck::Columns c, std::string_view field, Dimension d, double fallback) {
  const double value = r.real(c, field, d);
  return value == 0.0 ? fallback * r.context().factor(d, r.unit_id()) : value;
}

double stop_time(BlockReader& r, deck::Columns c, std::string_view field) {
  const double value = r.real(c, field, dim::time);
  const double never = infinity * r.context().factor(dim::time, r.unit_id());
  return value == 0.0 || value >= never ? infinity : value;
}

namespace {

std::vector<Index> group_nodes(BlockReader& r, Id id, deck::Columns c, std::string_view field) {
  const Index group = r.resolve(r.context().tables.node_groups, id, "/GRNOD", c, field);
  if (group == no_index) return {};
  return r.context().model->node_groups[static_cast<std::size_t>(group)].nodes;
}

}  // namespace

std::vector<Index> optional_group(BlockReader& r, deck::Columns c, std::string_view field) {
  return group_nodes(r, r.integer(c, field), c, field);
}

std::vector<Index> required_group(BlockReader& r, deck::Columns c, std::string_view field) {
  const Id id = r.integer(c, field);
  if (id == 0) r.error("model.missing_reference", c, field, "no node group is given; write the id of a /GRNOD");
  return group_nodes(r, id, c, field);
}

Index read_function(BlockReader& r, deck::Columns c, std::string_view field, bool required) {
  const Id id = r.integer(c, field);
  if (id == 0 && required) {
    r.error("model.missing_reference", c, field, "no function is given; write the id of a /FUNCT");
    return no_index;
  }
  return r.resolve(r.context().tables.functions, id, "/FUNCT", c, field);
}

Index read_skew(BlockReader& r, deck::Columns c, std::string_view field) {
  return r.resolve(r.context().tables.skews, r.integer(c, field), "/SKEW", c, field);
}

Index read_sensor(BlockReader& r, deck::Columns c, std::string_view field) {
  Context& context = r.context();
  const Id id = r.integer(c, field);
  if (id != 0 && !context.tables.sensors.contains(id)) {
    for (const deck::Block& block : context.deck->blocks) {
      if (!is_keyword(block, "SENSOR") || same_word(block.word(1), "TIME")) continue;
      if (deck::parse_integer(block.word(2)) != id) continue;
      r.error("model.unsupported", c, field,
              fmt::format("/SENSOR/{}/{} is of a kind that is not supported; use a /SENSOR/TIME", block.word(1), id));
      return no_index;
    }
  }
  return r.resolve(context.tables.sensors, id, "/SENSOR", c, field);
}

int read_direction(BlockReader& r, deck::Columns c, std::string_view field) {
  constexpr std::array<std::string_view, 6> names{"X", "Y", "Z", "XX", "YY", "ZZ"};
  const std::string_view text = r.text(c, field);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (same_word(text, names[i])) return static_cast<int>(i);
  }
  r.error("model.bad_direction", c, field,
          fmt::format("'{}' is not a direction; write X, Y or Z (translation) or XX, YY or ZZ (rotation)", text));
  return 0;
}

Place place_of(const Context& c, std::string_view word, Id id, int nth) {
  auto known = c.blocks_by_id.find(word);
  if (known == c.blocks_by_id.end()) {
    known = c.blocks_by_id.emplace(word, std::unordered_map<Id, std::vector<const deck::Block*>>()).first;
    for (const deck::Block& block : c.deck->blocks) {
      if (!is_keyword(block, word)) continue;
      const std::string_view text = is_id(block.word(1)) && !same_word(word, "ADMAS") ? block.word(1) : block.word(2);
      if (const auto number = deck::parse_integer(text)) known->second[*number].push_back(&block);
    }
  }
  if (const auto found = known->second.find(id); found != known->second.end() && static_cast<std::size_t>(nth) < found->second.size()) {
    return c.deck->place(*found->second[static_cast<std::size_t>(nth)]);
  }
  Place p;
  p.keyword = fmt::format("/{}/{}", word, id);
  return p;
}

void report_second(Context& c, std::string_view word, Id id, bool both_act) {
  const Place first = place_of(c, word, id, 0);
  const std::string message = fmt::format("a second /{} with id {} (the first is at {}:{}): ", word, id, first.file, first.line);
  if (both_act) {
    c.diagnostics->warning("model.duplicate_id", place_of(c, word, id, 1), message + "both act; ids should be unique");
  } else {
    c.diagnostics->error("model.duplicate_id", place_of(c, word, id, 1), message + "ids must be unique");
  }
}

int integer_in(BlockReader& r, deck::Columns c, std::string_view field, int low, int high, std::string_view what_is_right) {
  const Id value = r.integer(c, field);
  if (value < low || value > high) {
    r.error("model.out_of_range", c, field, fmt::format("{} is not {}", value, what_is_right));
    return low;
  }
  return static_cast<int>(value);
}

double filter_factor(BlockReader& r, deck::Columns c, std::string_view field, int kind, std::string_view kind_field) {
  constexpr double two_pi = 6.283185307179586476925;
  const double factor = r.real(c, field, kind == 3 ? dim::rate : dim::none);
  if (factor < 0.0) r.error("model.out_of_range", c, field, "a filter coefficient cannot be negative; write 0 or more");
  if (kind == 1 && factor > 1.0) {
    r.error("model.out_of_range", c, field,
            fmt::format("with {} 1 this is the share of the new force; write a value between 0 and 1", kind_field));
  }
  if (kind == 2 && factor > 0.0 && factor < two_pi) {
    r.error("model.out_of_range", c, field,
            fmt::format("with {} 2 this is a period in cycles and must be at least 6.2832 (2 pi): the filter would amplify", kind_field));
  }
  return factor;
}

}  // namespace abut::model
