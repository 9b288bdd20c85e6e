// Boundary conditions, initial velocities, imposed motion and loads (deck-format.md D.1 to D.6).
#include <fmt/format.h>

#include <map>
#include <utility>

#include "deck/text.hpp"
#include "model/condition_fields.hpp"
#include "model/condition_readers.hpp"

namespace abut::model {

namespace {

void read_bcs(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  BoundaryCondition b;
  b.id = r.id();
  r.next_card();
  constexpr std::array<std::string_view, 6> names{"Tx", "Ty", "Tz", "Rx", "Ry", "Rz"};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    b.translation[k] = r.flag(4 + i, names[k]);
    b.rotation[k] = r.flag(8 + i, names[k + 3]);
  }
  r.only_flags(
      {1, 10}, {4, 5, 6, 8, 9, 10}, "Tra rot",
      old_layout(c) ? "Tx, Ty, Tz go in columns 2 to 4, Rx, Ry, Rz in 6 to 8" : "Tx, Ty, Tz go in columns 4 to 6, Rx, Ry, Rz in 8 to 10");
  b.skew = read_skew(r, {11, 20}, "skew_ID");
  b.nodes = required_group(r, {21, 30}, "grnd_ID");
  c.model->boundary_conditions.push_back(std::move(b));
}

Vec3 read_vector(BlockReader& r, int first, std::array<std::string_view, 3> names, Dimension d) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = r.real({first + 20 * i, first + 20 * i + 19}, names[static_cast<std::size_t>(i)], d);
  return v;
}

Vec3 to_global(BlockReader& r, const Vec3& local, Index skew, deck::Columns columns) {
  if (skew == no_index) return local;
  const Skew& s = r.context().model->skews[static_cast<std::size_t>(skew)];
  if (s.nodes[0] != no_index) {
    r.warning("model.moving_skew", columns, "skew_ID", "an initial velocity in a moving skew uses its axes at t = 0");
  }
  return local.x * s.axes[0] + local.y * s.axes[1] + local.z * s.axes[2];
}

/// v2025: a last card may delay the velocity.
void refuse_delay(BlockReader& r) {
  if (!r.next_card()) return;
  if (r.real({1, 20}, "Tstart", dim::time) != 0.0 || r.integer({21, 30}, "sens_ID") != 0) {
    r.error("model.unsupported", {1, 30}, "Tstart",
            "an initial velocity that starts later is not supported; leave Tstart and sens_ID blank");
  }
}

void read_uniform_velocity(Context& c, const deck::Block& block, bool rotational) {
  BlockReader r(c, block, 2, true);
  r.last_column(80);
  InitialVelocity v;
  v.id = r.id();
  v.rotational = rotational;
  r.next_card();
  const Vec3 local = read_vector(r, 1, {"Vx", "Vy", "Vz"}, rotational ? dim::rate : dim::velocity);
  v.nodes = required_group(r, {61, 70}, "grnd_ID");
  v.value = to_global(r, local, read_skew(r, {71, 80}, "skew_ID"), {71, 80});
  refuse_delay(r);
  c.model->initial_velocities.push_back(std::move(v));
}

void read_axis_velocity(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  r.last_column(80);
  InitialVelocity v;
  v.about_axis = true;
  v.id = r.id();
  r.next_card();
  const int direction = read_direction(r, {1, 10}, "Dir");
  if (direction > 2) r.error("model.bad_direction", {1, 10}, "Dir", "the axis is written X, Y or Z");
  if (r.integer({11, 20}, "frame_ID") != 0) {
    r.error("model.unsupported", {11, 20}, "frame_ID", "frames are not supported; write 0 for the global origin and axes");
  }
  v.nodes = required_group(r, {21, 30}, "grnd_ID");
  r.next_card();
  v.value = read_vector(r, 1, {"Vx", "Vy", "Vz"}, dim::velocity);
  v.spin[direction % 3] = r.real({61, 80}, "Vr", dim::rate);
  refuse_delay(r);
  c.model->initial_velocities.push_back(std::move(v));
}

void read_nodal_velocities(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  while (r.next_card()) {
    const Id id = r.integer({1, 10}, "node_ID");
    const Index node = r.resolve(c.tables.nodes, id, "/NODE", {1, 10}, "node_ID");
    const Index skew = read_skew(r, {11, 20}, "skew_ID");
    const Vec3 v = to_global(r, read_vector(r, 21, {"Vx", "Vy", "Vz"}, dim::velocity), skew, {11, 20});
    r.next_card();
    if (r.text({1, 20}).find_first_not_of(" 0") != std::string_view::npos) {
      r.error(
          "model.bad_card", {1, 20}, "blank",
          fmt::format("the second card of node {} begins with 20 blank columns; each node has two cards, Vx, Vy, Vz on the first and Vrx, "
                      "Vry, Vrz on the second, which is blank without a rotation",
                      id));
      return r.leave_rest();
    }
    const Vec3 w = to_global(r, read_vector(r, 21, {"Vrx", "Vry", "Vrz"}, dim::rate), skew, {11, 20});
    if (node == no_index) continue;
    c.model->initial_velocities.push_back({r.id(), false, v, {node}});
    if (w != Vec3{}) c.model->initial_velocities.push_back({r.id(), true, w, {node}});
  }
}

void read_initial_velocity(Context& c, const deck::Block& block) {
  const std::string_view kind = block.word(1);
  if (same_word(kind, "TRA") || same_word(kind, "T+G")) return read_uniform_velocity(c, block, false);
  if (same_word(kind, "ROT")) return read_uniform_velocity(c, block, true);
  if (same_word(kind, "AXIS")) return read_axis_velocity(c, block);
  if (same_word(kind, "NODE")) read_nodal_velocities(c, block);
}

void read_imposed_motion(Context& c, const deck::Block& block, ImposedMotion::Kind kind) {
  BlockReader r(c, block, 1, true);
  r.last_column(80);
  ImposedMotion m;
  m.id = r.id();
  m.kind = kind;
  r.next_card();
  m.function = read_function(r, {1, 10}, "fct_IDT", true);
  m.direction = read_direction(r, {11, 20}, "Dir");
  m.skew = read_skew(r, {21, 30}, "skew_ID");
  m.sensor = read_sensor(r, {31, 40}, "sens_ID");
  m.nodes = required_group(r, {41, 50}, "grnd_ID");
  if (r.integer({51, 60}, "frame_ID") != 0) {
    r.error("model.unsupported", {51, 60}, "frame_ID", "motion relative to a frame is not supported; use a skew, or leave it blank");
  }
  if (r.integer({61, 70}, "Icoor") != 0) {
    r.error("model.unsupported", {61, 70}, "Icoor", "cylindrical coordinates are not supported; write 0 (Cartesian)");
  }
  r.next_card();
  const bool rotation = m.direction > 2;
  const Dimension d = kind == ImposedMotion::Kind::velocity       ? (rotation ? dim::rate : dim::velocity)
                      : kind == ImposedMotion::Kind::displacement ? (rotation ? dim::none : dim::length)
                                                                  : (rotation ? dim::rate2 : dim::acceleration);
  int column = 1;
  if (old_layout(c)) {  // no abscissa scale
    m.scale_x = c.factor(dim::time, r.unit_id());
  } else {
    m.scale_x = real_or(r, {1, 20}, "Ascale_x", dim::time, 1.0);
    column = 21;
  }
  m.scale_y = real_or(r, {column, column + 19}, "Fscale_y", d, 1.0);
  m.t_start = r.real({column + 20, column + 39}, "Tstart", dim::time);
  const deck::Columns stop{column + 40, column + 59};
  m.t_stop = stop_time(r, stop, "Tstop");
  if (m.t_stop <= m.t_start) r.error("model.out_of_range", stop, "Tstop", "Tstop must be later than Tstart, or 0 for never");
  c.model->imposed_motions.push_back(std::move(m));
}

/// Scales of a time function at the end of a load's card. Old decks have one field for the value only.
struct Scales {
  double x = 1.0, y = 1.0;
};
Scales read_scales(BlockReader& r, Dimension d) {
  Context& c = r.context();
  if (old_layout(c)) return {c.factor(dim::time, r.unit_id()), real_or(r, {41, 60}, "Fscale", d, 1.0)};
  return {real_or(r, {61, 80}, "Ascale_x", dim::time, 1.0), real_or(r, {81, 100}, "Fscale_y", d, 1.0)};
}

void refuse_abscissa(BlockReader& r, deck::Columns c) {
  if (!old_layout(r.context()) && r.integer(c, "Itypfun") > 1) {
    r.error("model.unsupported", c, "Itypfun", "a load as a function of displacement or velocity is not supported; write 0 or 1 (time)");
  }
}

void read_concentrated_load(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  ConcentratedLoad l;
  l.id = r.id();
  r.next_card();
  l.function = read_function(r, {1, 10}, "fct_IDT", false);
  l.direction = read_direction(r, {11, 20}, "Dir");
  l.skew = read_skew(r, {21, 30}, "skew_ID");
  l.sensor = read_sensor(r, {31, 40}, "sens_ID");
  l.nodes = old_layout(c) ? required_group(r, {61, 70}, "grnd_ID") : required_group(r, {41, 50}, "grnd_ID");
  refuse_abscissa(r, {51, 60});
  const Scales s = read_scales(r, l.direction > 2 ? dim::moment : dim::force);
  l.scale_x = s.x;
  l.scale_y = s.y;
  c.model->concentrated_loads.push_back(std::move(l));
}

void read_pressure_load(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  PressureLoad l;
  l.id = r.id();
  r.next_card();
  const Id surface_id = r.integer({1, 10}, "surf_ID");
  if (surface_id == 0) r.error("model.missing_reference", {1, 10}, "surf_ID", "no surface is given; write the id of a /SURF");
  const Index surface = r.resolve(c.tables.surfaces, surface_id, "/SURF", {1, 10}, "surf_ID");
  l.function = read_function(r, {11, 20}, "fct_IDT", false);
  l.sensor = read_sensor(r, {21, 30}, "sens_ID");
  if (!old_layout(c) && r.integer({31, 40}, "Ipinch") != 0) {
    r.error("model.unsupported", {31, 40}, "Ipinch", "pressure on the pinching of shells is not supported; write 0");
  }
  if (!old_layout(c) && r.integer({41, 50}, "Idel") != 0) {
    r.error("model.unsupported", {41, 50}, "Idel",
            "other rules for deleted elements are not supported: the pressure ends with the last element of a facet; write 0");
  }
  refuse_abscissa(r, {51, 60});
  const Scales s = read_scales(r, dim::pressure);
  l.scale_x = s.x;
  l.scale_y = s.y;
  if (surface != no_index) {
    for (const Segment& segment : c.model->surfaces[static_cast<std::size_t>(surface)].segments) l.segments.push_back(segment.nodes);
  }
  c.model->pressure_loads.push_back(std::move(l));
}

void read_gravity(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  Gravity g;
  g.id = r.id();
  r.next_card();
  g.function = read_function(r, {1, 10}, "fct_IDT", false);
  const std::string_view direction = r.text({11, 20}, "Dir");
  g.direction = same_word(direction, "X") ? 0 : same_word(direction, "Y") ? 1 : 2;
  if (g.direction == 2 && !same_word(direction, "Z")) {
    r.warning("model.bad_direction", {11, 20}, "Dir", fmt::format("'{}' is not X, Y or Z; gravity acts along Z", direction));
  }
  g.skew = read_skew(r, {21, 30}, "skew_ID");
  g.sensor = read_sensor(r, {31, 40}, "sens_ID");
  const deck::Columns group = old_layout(c) ? deck::Columns{61, 70} : deck::Columns{41, 50};
  if (r.integer(group, "grnd_ID") == 0) {
    for (Index n = 0; n < c.model->node_count(); ++n) g.nodes.push_back(n);
  } else {
    g.nodes = optional_group(r, group, "grnd_ID");
  }
  const Scales s = read_scales(r, dim::acceleration);
  g.scale_x = s.x;
  g.scale_y = s.y;
  c.model->gravities.push_back(std::move(g));
}

/// Added masses, initial velocities and imposed motions whose block comes a second time, as in a file that is included twice.
void report_blocks_twice(Context& c) {
  std::map<std::pair<std::string, Id>, const deck::Block*> first;  // null: told
  for (const deck::Block& block : c.deck->blocks) {
    const bool mass = is_keyword(block, "ADMAS"), velocity = is_keyword(block, "INIVEL");
    if (!mass && !velocity && !is_keyword(block, "IMPVEL") && !is_keyword(block, "IMPDISP") && !is_keyword(block, "IMPACC")) continue;
    const std::size_t id_word = mass || velocity ? 2 : 1;
    const std::optional<Id> id = deck::parse_integer(block.word(id_word));
    if (!id || *id == 0 || is_refused(block)) continue;
    const std::string name = "/" + deck::to_upper(block.word(0)) + (id_word == 2 ? "/" + deck::to_upper(block.word(1)) : "");
    const auto [known, is_new] = first.try_emplace({name, *id}, &block);
    if (is_new || known->second == nullptr) continue;
    const Place place = c.deck->place(*std::exchange(known->second, nullptr));
    std::string_view then = "both are read";
    if (mass) then = "both act";
    if (velocity) then = "where both name a node the last one counts";
    c.diagnostics->warning(
        "model.duplicate_id", c.deck->place(block),
        fmt::format("a second {} with id {} (the first is at {}:{}): {}; ids should be unique", name, *id, place.file, place.line, then));
  }
}

}  // namespace

void read_conditions(Context& c) {
  for (const deck::Block& block : c.deck->blocks) {
    if (is_refused(block)) continue;
    if (is_keyword(block, "BCS")) read_bcs(c, block);
    if (is_keyword(block, "INIVEL")) read_initial_velocity(c, block);
    if (is_keyword(block, "IMPVEL")) read_imposed_motion(c, block, ImposedMotion::Kind::velocity);
    if (is_keyword(block, "IMPDISP")) read_imposed_motion(c, block, ImposedMotion::Kind::displacement);
    if (is_keyword(block, "IMPACC")) read_imposed_motion(c, block, ImposedMotion::Kind::acceleration);
    if (is_keyword(block, "CLOAD")) read_concentrated_load(c, block);
    if (is_keyword(block, "PLOAD")) read_pressure_load(c, block);
    if (is_keyword(block, "GRAV")) read_gravity(c, block);
    if (is_keyword(block, "ADMAS")) read_added_mass(c, block);
    if (is_keyword(block, "RBODY")) read_rigid_body(c, block);
    if (is_keyword(block, "RWALL")) read_rigid_wall(c, block);
  }
  report_blocks_twice(c);
  Model& m = *c.model;
  order_by_id(c, m.boundary_conditions, "BCS", true);
  std::stable_sort(m.imposed_motions.begin(), m.imposed_motions.end(),
                   [](const ImposedMotion& a, const ImposedMotion& b) { return a.kind != b.kind ? a.kind < b.kind : a.id < b.id; });
  order_by_id(c, m.concentrated_loads, "CLOAD", true);
  order_by_id(c, m.pressure_loads, "PLOAD", true);
  order_by_id(c, m.gravities, "GRAV", true);
  order_by_id(c, m.rigid_bodies, "RBODY", false);
  order_by_id(c, m.rigid_walls, "RWALL", false);
  // Initial velocities keep the order of the deck: where two touch one node the last one wins (D.2).
  std::stable_sort(m.added_masses.begin(), m.added_masses.end(), [](const AddedMass& a, const AddedMass& b) { return a.node < b.node; });
  fill_table(c.tables.rigid_bodies, m.rigid_bodies);
  fill_table(c.tables.rigid_walls, m.rigid_walls);
}

}  // namespace abut::model
