// /FUNCT, /MOVE_FUNCT and /SKEW (deck-format.md B.15, B.16; numerics.md 6.6).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/mesh.hpp"
#include "model/sort_by_id.hpp"

namespace abut::model {

namespace {

void check_ascending(BlockReader& r, const Function& f) {
  const std::size_t n = f.x.size();
  if (n > 1 && !(f.x[n - 2] < f.x[n - 1])) {
    r.error("model.function_order", {1, 20}, "X",
            fmt::format("abscissa {:g} is not larger than the one before, {:g}: points go in ascending order", f.x[n - 1], f.x[n - 2]));
  }
}

void move_function(Context& c, const deck::Block& b) {
  BlockReader r(c, b, 1, true);
  if (r.id() == 0) return;
  r.next_card();
  const auto scale = [](double s) { return s == 0.0 ? 1.0 : s; };
  const double scale_x = scale(r.real({1, 20}, "Ascale_x"));
  const double scale_y = scale(r.real({21, 40}, "Fscale_y"));
  const double shift_x = r.real({41, 60}, "Ashift_x");
  const double shift_y = r.real({61, 80}, "Fshift_y");
  const auto found = c.tables.functions.find(r.id());
  if (found == c.tables.functions.end()) {
    c.diagnostics->error("model.unknown_reference", r.place(), fmt::format("no /FUNCT with id {} to move", r.id()));
    return;
  }
  Function& f = c.model->functions[static_cast<std::size_t>(found->second)];
  for (double& x : f.x) x = scale_x * x + shift_x;
  for (double& y : f.y) y = scale_y * y + shift_y;
  if (scale_x < 0.0) {
    std::reverse(f.x.begin(), f.x.end());
    std::reverse(f.y.begin(), f.y.end());
  }
}

Vec3 read_vector(BlockReader& r, std::string_view x, std::string_view y, std::string_view z, Dimension d = dim::none) {
  return {r.real({1, 20}, x, d), r.real({21, 40}, y, d), r.real({41, 60}, z, d)};
}

/// Of any length that a double holds. Zero stays zero.
Vec3 unit(const Vec3& a) {
  const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  return largest > 0.0 ? normalized({a.x / largest, a.y / largest, a.z / largest}) : Vec3{};
}

/// A card too few or too many is read as one vector and a blank one, which then has its default.
void warn_half_given(BlockReader& r, const Vec3& y, const Vec3& z, bool has_origin) {
  const bool only_y = z == Vec3{} && (y.x != 0.0 || y.z != 0.0);
  const bool only_z = y == Vec3{} && (z.x != 0.0 || z.y != 0.0);
  if (!only_y && !only_z) return;
  r.warning(
      "model.skew_half_given", {1, 60}, only_y ? "Z'" : "Y'",
      fmt::format("only {}' is given, {}' is taken as the global {} axis; {}", only_y ? 'y' : 'z', only_y ? 'z' : 'y', only_y ? 'Z' : 'Y',
                  has_origin ? "from version 120 on three cards are read, the origin first, then y' and z': is one missing?"
                             : "up to version 110 two cards are read, y' and z', without an origin: is one too many?"));
}

/// z' is kept, x' = y' x z', y' = z' x x' (numerics.md 6.6.1).
void read_fixed_axes(BlockReader& r, Skew& s, bool has_origin) {
  r.last_column(60);
  if (has_origin) r.next_card();
  r.next_card();
  const Vec3 y = read_vector(r, "X1", "Y1", "Z1");
  r.next_card();
  const Vec3 z = read_vector(r, "X2", "Y2", "Z2");
  const Vec3 y0 = y == Vec3{} ? Vec3{0, 1, 0} : y;
  const Vec3 z0 = z == Vec3{} ? Vec3{0, 0, 1} : z;
  s.axes[2] = unit(z0);
  s.axes[0] = normalized(cross(unit(y0), s.axes[2]));
  s.axes[1] = cross(s.axes[2], s.axes[0]);
  if (squared_norm(s.axes[0]) == 0.0) {
    r.error("model.skew_axes", {1, 60}, "Z'", "the vectors of y' and z' are parallel: they must span a plane");
  } else {
    warn_half_given(r, y, z, has_origin);
  }
}

/// N1 to N2 is the axis `direction`, N1 to N3 gives the next one provisionally, the third is their product (numerics.md 6.6.2).
void read_moving_axes(Context& c, BlockReader& r, Skew& s, bool second_kind) {
  static constexpr std::array<std::string_view, 3> names{"node_ID1", "node_ID2", "node_ID3"};
  r.next_card();
  bool complete = true;
  for (int k = 0; k < 3; ++k) {
    const deck::Columns columns{10 * k + 1, 10 * k + 10};
    const auto i = static_cast<std::size_t>(k);
    const Id id = r.integer(columns, names[i]);
    if (id == 0) r.error("model.missing_reference", columns, names[i], "a moving skew needs three nodes");
    s.nodes[i] = r.resolve(c.tables.nodes, id, "/NODE", columns, names[i]);
    complete = complete && s.nodes[i] != no_index;
  }
  s.direction = second_kind ? 2 : 0;
  if (!second_kind) {
    const std::string_view direction = r.text({31, 40}, "Dir");
    if (direction == "Y" || direction == "y") s.direction = 1;
    if (direction == "Z" || direction == "z") s.direction = 2;
    if (s.direction == 0 && !direction.empty() && direction != "X" && direction != "x") {
      r.error("model.bad_direction", {31, 40}, "Dir", "the axis carried by the first two nodes is X, Y or Z");
    }
  }
  if (!complete) {
    s.nodes = {no_index, no_index, no_index};
    return;
  }
  const auto x = [&](std::size_t k) { return c.model->node_x[static_cast<std::size_t>(s.nodes[k])]; };
  const auto first = static_cast<std::size_t>(s.direction);
  const std::size_t second = (first + 1) % 3;
  const std::size_t third = (first + 2) % 3;
  s.axes[first] = normalized(x(1) - x(0));
  s.axes[third] = normalized(cross(s.axes[first], x(2) - x(0)));
  s.axes[second] = cross(s.axes[third], s.axes[first]);
  if (squared_norm(s.axes[third]) == 0.0) {
    r.error("model.skew_axes", {1, 30}, "node_ID3", "the three nodes lie on one line: they must span a plane");
  }
}

}  // namespace

void read_functions(Context& c) {
  std::vector<Place> places;
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "FUNCT")) continue;
    BlockReader r(c, b, 1, true);
    Function f;
    f.id = r.id();
    f.x.reserve(b.cards.size());
    f.y.reserve(b.cards.size());
    while (r.next_card()) {
      f.x.push_back(r.real({1, 20}, "X"));
      f.y.push_back(r.real({21, 40}, "Y"));
      check_ascending(r, f);
    }
    if (f.x.size() < 2) {
      c.diagnostics->error("model.function_points", r.place(), fmt::format("{} points: a function needs at least 2", f.x.size()));
    }
    c.model->functions.push_back(std::move(f));
    places.push_back(r.place());
  }
  sort_by_id(c, c.model->functions, places, "/FUNCT", c.tables.functions);
  std::map<Id, Place> moved;
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "MOVE_FUNCT")) continue;
    const Id id = deck::parse_integer(b.word(1)).value_or(0);
    const auto [first, is_new] = moved.try_emplace(id, c.deck->place(b));
    if (!is_new && id != 0) report_duplicate(c, "/MOVE_FUNCT", id, c.deck->place(b), first->second);
    move_function(c, b);
  }
}

void read_skews(Context& c) {
  constexpr int first_version_with_origin = 120;
  std::vector<Place> places;
  for (const deck::Block& b : c.deck->blocks) {
    if (!b.is(0, "SKEW")) continue;
    const bool fixed = b.is(1, "FIX");
    if (!fixed && !b.is(1, "MOV") && !b.is(1, "MOV2")) {
      c.diagnostics->error("model.unknown_type", c.deck->place(b), "the types of /SKEW are FIX, MOV and MOV2");
      continue;
    }
    BlockReader r(c, b, 2, true);
    Skew s;
    s.id = r.id();
    if (fixed) {
      read_fixed_axes(r, s, c.model->version >= first_version_with_origin);
    } else {
      read_moving_axes(c, r, s, b.is(1, "MOV2"));
    }
    c.model->skews.push_back(s);
    places.push_back(r.place());
  }
  sort_by_id(c, c.model->skews, places, "/SKEW", c.tables.skews);
}

}  // namespace abut::model
