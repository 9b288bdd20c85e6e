// Rigid bodies and rigid walls (deck-format.md D.8, D.9).
#include <fmt/format.h>

#include <cmath>

#include "model/condition_fields.hpp"
#include "model/condition_readers.hpp"

namespace abut::model {

namespace {

Index required_node(BlockReader& r, deck::Columns c, std::string_view field, std::string_view what) {
  const Id id = r.integer(c, field);
  if (id == 0) r.error("model.missing_reference", c, field, fmt::format("no {} is given; write the id of a /NODE", what));
  return r.resolve(r.context().tables.nodes, id, "/NODE", c, field);
}

Vec3 read_reals(BlockReader& r, std::array<std::string_view, 3> names, Dimension d) {
  return {r.real({1, 20}, names[0], d), r.real({21, 40}, names[1], d), r.real({41, 60}, names[2], d)};
}

/// Products of inertia, on the card at hand, that go with these moments: no principal moment of a body is negative.
void check_products(BlockReader& r, const Vec3& j, const Vec3& off) {
  if (j.x < 0.0 || j.y < 0.0 || j.z < 0.0) return;
  constexpr double rounding = 1e-4;  // of typed digits
  constexpr std::array<std::string_view, 3> moments{"Jxx", "Jyy", "Jzz"}, products{"Jxy", "Jyz", "Jxz"};
  const double size = rounding * (j.x + j.y + j.z);
  for (int k = 0; k < 3; ++k) {  // Jxy with Jxx and Jyy, ...
    const int a = k == 2 ? 0 : k, b = k == 2 ? 2 : k + 1;
    if (off[k] * off[k] <= (j[a] + size) * (j[b] + size)) continue;
    const auto name = [](const auto& names, int i) { return names[static_cast<std::size_t>(i)]; };
    r.error("model.out_of_range", {20 * k + 1, 20 * k + 20}, name(products, k),
            fmt::format("{0}^2 = {1:g} is larger than {2} {3} = {4:g}, which no body has: a principal moment of inertia would be negative; "
                        "give the moments {2} and {3} of the same tensor",
                        name(products, k), off[k] * off[k], name(moments, a), name(moments, b), j[a] * j[b]));
    return;
  }
  const Vec3 t = j + Vec3{size, size, size};
  const double det = t.x * (t.y * t.z - off.y * off.y) - off.x * (off.x * t.z - off.y * off.z) + off.z * (off.x * off.y - t.y * off.z);
  if (det < 0.0) {
    r.error("model.out_of_range", {1, 60}, "Jxy, Jyz, Jxz",
            "a principal moment of inertia of this tensor is negative, which no body has; check the products of inertia and their signs");
  }
}

/// A wall does not bring a node back that begins behind it: it stops the node there, or lets it go.
void warn_of_nodes_behind(const BlockReader& r, Context& c, const RigidWall& w) {
  std::size_t behind = 0;
  double deepest = 0.0;
  Index node = no_index;
  for (const Index n : w.nodes) {
    const Vec3 x = c.model->node_x[static_cast<std::size_t>(n)];
    const double depth = dot(w.point - x, w.normal);
    if (depth <= 1e-6 * (norm(x) + norm(w.point))) continue;
    ++behind;
    if (depth <= deepest) continue;
    deepest = depth;
    node = n;
  }
  if (behind == 0) return;
  const std::string where =
      fmt::format("node {} deepest, {:.4g} from the plane", c.model->node_id[static_cast<std::size_t>(node)], deepest);
  c.diagnostics->warning(
      "model.behind_wall", r.place(),
      behind == w.nodes.size()
          ? fmt::format(
                "all {} nodes of this wall begin behind it ({}): it looks the other way, and a node that moves against its normal stops "
                "where it is; M to M1 must point to the side where the nodes are",
                behind, where)
          : fmt::format("{} of {} nodes of this wall begin behind it ({}), and one that moves on stops where it is, not at the plane; move "
                        "the wall or the nodes, or take them out with grnd_ID2",
                        behind, w.nodes.size(), where));
}

}  // namespace

void read_rigid_body(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  RigidBody b;
  b.id = r.id();
  r.next_card();
  b.main = required_node(r, {1, 10}, "node_ID", "main node");
  b.sensor = read_sensor(r, {11, 20}, "sens_ID");
  b.skew = read_skew(r, {21, 30}, "skew_ID");
  b.ispher = integer_in(r, {31, 40}, "Ispher", 0, 3, "0 (default), 1 (spherical), 2 or 3");
  if (b.ispher == 0) b.ispher = 2;
  b.mass = r.real({41, 60}, "Mass", dim::mass);
  if (b.mass < 0.0) r.error("model.out_of_range", {41, 60}, "Mass", "an added mass cannot be negative; write 0 or more");
  b.nodes = required_group(r, {61, 70}, "grnd_ID");
  if (std::erase(b.nodes, b.main) > 0) {
    r.warning("model.main_is_secondary", {61, 70}, "grnd_ID",
              "the main node is also in the group of secondary nodes; it is taken out of the group");
  }
  if (b.nodes.empty()) r.warning("model.empty_set", {61, 70}, "grnd_ID", "the rigid body has no secondary node and holds nothing");
  b.keep_in_walls = integer_in(r, {71, 80}, "Ikrem", 0, 1, "0 (secondary nodes leave rigid walls) or 1 (they stay)") == 1;
  b.icog = integer_in(r, {81, 90}, "ICoG", 0, 4, "0 (default) or 1 to 4");
  if (b.icog == 0) b.icog = 1;
  r.next_card();
  b.j_diagonal = read_reals(r, {"Jxx", "Jyy", "Jzz"}, dim::inertia);
  for (int i = 0; i < 3; ++i) {
    if (b.j_diagonal[i] < 0.0) {
      r.error("model.out_of_range", {20 * i + 1, 20 * i + 20}, std::array{"Jxx", "Jyy", "Jzz"}[static_cast<std::size_t>(i)],
              "a moment of inertia cannot be negative; write 0 or more");
    }
  }
  r.next_card();
  b.j_off = read_reals(r, {"Jxy", "Jyz", "Jxz"}, dim::inertia);
  check_products(r, b.j_diagonal, b.j_off);
  if (!old_layout(c) && r.next_card() && r.integer({21, 30}, "Ifail") != 0) {
    r.error("model.unsupported", {21, 30}, "Ifail", "failure of a rigid body's links is not supported; write 0");
  }
  if (b.sensor != no_index) {  // D.8: such a body takes nothing from the card but its nodes
    b.mass = 0.0;
    b.j_diagonal = b.j_off = Vec3{};
    b.skew = no_index;
    b.icog = 0;
    b.keep_in_walls = true;
  }
  c.model->rigid_bodies.push_back(std::move(b));
}

void read_rigid_wall(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 2, true);
  RigidWall w;
  w.id = r.id();
  w.title = r.title();
  r.next_card();
  const Id node = r.integer({1, 10}, "node_ID");
  w.node = r.resolve(c.tables.nodes, node, "/NODE", {1, 10}, "node_ID");
  const bool moving = node != 0;
  w.slide = integer_in(r, {11, 20}, "Slide", 0, 2, "0 (frictionless), 1 (tied) or 2 (friction)");
  std::vector<Index> added = optional_group(r, {21, 30}, "grnd_ID1");
  const std::vector<Index> removed = optional_group(r, {31, 40}, "grnd_ID2");
  if (!old_layout(c) && r.integer({41, 50}, "Iform") != 0) {
    r.error("model.unsupported", {41, 50}, "Iform", "a penalty wall is not supported; write 0 (kinematic)");
  }
  r.next_card();
  const double search = r.real({1, 20}, "Dsearch", dim::length);
  if (search < 0.0) r.error("model.out_of_range", {1, 20}, "Dsearch", "a search distance cannot be negative; write 0 or more");
  w.friction = r.real({21, 40}, "fric");
  if (w.friction < 0.0) r.error("model.out_of_range", {21, 40}, "fric", "a friction coefficient cannot be negative; write 0 or more");
  w.filter_kind = integer_in(r, {81, 90}, "ifq", 0, 3, "0 (no filter), 1, 2 or 3");
  w.filter = filter_factor(r, {61, 80}, "ffac", w.filter_kind, "ifq");
  if (w.filter == 0.0) w.filter_kind = 0;
  r.next_card();
  r.last_column(moving ? 80 : 60);
  if (moving) {
    w.mass = r.real({1, 20}, "Mass", dim::mass);
    if (w.mass < 0.0) r.error("model.out_of_range", {1, 20}, "Mass", "an added mass cannot be negative; write 0 or more");
    w.velocity = {r.real({21, 40}, "Vx0", dim::velocity), r.real({41, 60}, "Vy0", dim::velocity), r.real({61, 80}, "Vz0", dim::velocity)};
    if (w.node != no_index) w.point = c.model->node_x[static_cast<std::size_t>(w.node)];
  } else {
    w.point = read_reals(r, {"XM", "YM", "ZM"}, dim::length);
  }
  r.next_card();
  r.last_column(60);
  const Vec3 normal = read_reals(r, {"X_M1", "Y_M1", "Z_M1"}, dim::length) - w.point;
  w.normal = normalized(normal);
  if (w.normal == Vec3{}) {
    r.error("model.out_of_range", {1, 60}, "M1",
            "M and M1 are the same point; M1 must lie on the side where the nodes are, as M to M1 is the wall's normal");
  }
  if (search > 0.0) {
    // A node on the plane counts, whatever the rounding of the three products: 1e-12 of the sizes involved.
    for (Index n = 0; n < c.model->node_count(); ++n) {
      const Vec3 x = c.model->node_x[static_cast<std::size_t>(n)];
      const double distance = dot(x - w.point, w.normal);
      const double rounding = 1e-12 * (norm(x) + norm(w.point));
      if (distance >= -rounding && distance <= search + rounding) added.push_back(n);
    }
  }
  std::sort(added.begin(), added.end());
  added.erase(std::unique(added.begin(), added.end()), added.end());
  std::set_difference(added.begin(), added.end(), removed.begin(), removed.end(), std::back_inserter(w.nodes));
  std::erase(w.nodes, w.node);
  if (w.nodes.empty()) {
    c.diagnostics->warning("model.empty_set", r.place(),
                           "no node can touch this wall; give a node group (grnd_ID1) or a search distance (Dsearch)");
  }
  warn_of_nodes_behind(r, c, w);
  c.model->rigid_walls.push_back(std::move(w));
}

}  // namespace abut::model
