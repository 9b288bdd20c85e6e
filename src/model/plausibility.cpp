// What a deck may say, but rarely means: materials in other units than /BEGIN, walls on bodies beside their centre of gravity, nodes
// that a rigid wall does not stop, bricks whose mass is not that of their shape, hourglass forces that brake rotations.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <variant>
#include <vector>

#include "model/condition_fields.hpp"
#include "model/measure.hpp"
#include "model/topology.hpp"
#include "model/wording.hpp"

namespace abut::model {

namespace {

double young_of(const Law& law) {
  struct Young {
    double operator()(const LawVoid&) const { return 0.0; }
    double operator()(const LawElastic& l) const { return l.young; }
    double operator()(const LawJohnsonCook& l) const { return l.young; }
  };
  return std::visit(Young{}, law);
}

/// A note: data in a consistent set under another label give the right results. A length that is wrong by a thousand makes the speed
/// of sound wrong by a thousand: 5 m/s or 5000 km/s for steel.
constexpr double slowest = 10.0, fastest = 5e4;  // m/s; soft rubber 30, diamond 18000

void speeds_of_sound(Context& c) {
  const Model& m = *c.model;
  const double metres_per_second = m.units.length / m.units.time;
  for (const Material& material : m.materials) {
    const double young = young_of(material.law);
    if (!(material.density > 0.0) || !(young > 0.0)) continue;
    const double speed = std::sqrt(young / material.density) * metres_per_second;
    if (speed >= slowest && speed <= fastest) continue;
    c.diagnostics->note("model.speed_of_sound", place_of(c, "MAT", material.id),
                        fmt::format("the speed of sound in this material would be {:.3g} m/s; are its density and Young's modulus in the "
                                    "units of /BEGIN ({}, {}, {})?",
                                    speed, m.units.mass_name, m.units.length_name, m.units.time_name));
  }
}

/// A main node that stays where it is and carries a moving wall carries the mass of its body as if it were the centre of gravity.
void wall_beside_the_centre(Context& c) {
  const Model& m = *c.model;
  std::vector<bool> held(static_cast<std::size_t>(m.node_count()), false);
  for (const RigidWall& card : m.rigid_walls) {
    if (card.node != no_index) held[static_cast<std::size_t>(card.node)] = true;
  }
  const std::vector<double> masses = nodal_masses(m);
  for (const RigidBody& b : m.rigid_bodies) {
    if (b.main == no_index || b.nodes.empty() || (b.sensor == no_index && b.icog != 3)) continue;
    if (!held[static_cast<std::size_t>(b.main)]) continue;
    double mass = 0.0, size = 0.0;
    Vec3 moment{};
    const Vec3 main = m.node_x[static_cast<std::size_t>(b.main)];
    for (const Index n : b.nodes) {
      const auto i = static_cast<std::size_t>(n);
      mass += masses[i];
      moment += masses[i] * (m.node_x[i] - main);
      size = std::max(size, norm(m.node_x[i] - main));
    }
    mass += masses[static_cast<std::size_t>(b.main)] + (b.sensor == no_index ? b.mass : 0.0);
    if (mass <= 0.0 || norm(moment) <= 0.01 * size * mass) continue;
    const Vec3 centre = main + moment / mass;
    c.diagnostics->warning(
        "model.late_body", place_of(c, "RBODY", b.id),
        fmt::format("its main node carries a moving wall and stays {:.4g} beside the centre of gravity: the "
                    "body then moves as if its mass were there, which makes energy when it turns; put node {} at {:.6g} {:.6g} {:.6g}",
                    norm(moment) / mass, m.node_id[static_cast<std::size_t>(b.main)], centre.x, centre.y, centre.z));
  }
}

void walls_and_bodies(Context& c) {
  const Model& m = *c.model;
  const auto n = static_cast<std::size_t>(m.node_count());
  std::vector<Index> body(n, no_index);     // whose secondary node it is from the start, no_index: none
  std::vector<Index> stopped(n, no_index);  // body that a wall may stop there
  for (std::size_t b = 0; b < m.rigid_bodies.size(); ++b) {
    const RigidBody& card = m.rigid_bodies[b];
    if (!card.active) continue;
    stopped[static_cast<std::size_t>(card.main)] = static_cast<Index>(b);
    if (!card.keep_in_walls && card.sensor == no_index) continue;
    for (const Index node : card.nodes) stopped[static_cast<std::size_t>(node)] = static_cast<Index>(b);
  }
  for (std::size_t b = 0; b < m.rigid_bodies.size(); ++b) {
    const RigidBody& card = m.rigid_bodies[b];
    if (card.sensor != no_index || !card.active) continue;  // Ikrem 1 is forced for a body with a sensor
    for (const Index n : card.nodes) body[static_cast<std::size_t>(n)] = static_cast<Index>(b);
  }
  for (const RigidWall& w : m.rigid_walls) {
    const auto follows = [&](Index n) { return body[static_cast<std::size_t>(n)] != no_index; };
    const auto passes = [&](Index n) {
      return follows(n) && !m.rigid_bodies[static_cast<std::size_t>(body[static_cast<std::size_t>(n)])].keep_in_walls;
    };
    const auto count = std::count_if(w.nodes.begin(), w.nodes.end(), passes);
    if (count > 0) {
      const Index first = *std::find_if(w.nodes.begin(), w.nodes.end(), passes);
      const RigidBody& b = m.rigid_bodies[static_cast<std::size_t>(body[static_cast<std::size_t>(first)])];
      c.diagnostics->note(
          "model.wall_and_body", place_of(c, "RWALL", w.id),
          fmt::format("{} a rigid body (the first is node {}, of rigid body {}) and {} not stopped by this wall, because Ikrem = 0 of "
                      "/RBODY takes secondary nodes out of walls; write 1 where the wall is to stop the body",
                      count == 1 ? "1 node follows" : fmt::format("{} nodes follow", count), m.node_id[static_cast<std::size_t>(first)],
                      b.id, count == 1 ? "is" : "are"));
    }
    const auto unfiltered = [&](Index node) { return stopped[static_cast<std::size_t>(node)] != no_index && node != w.node; };
    const auto at_once = w.slide == 2 && w.filter_kind != 0 ? std::count_if(w.nodes.begin(), w.nodes.end(), unfiltered) : 0;
    if (at_once > 0) {
      const Index first = *std::find_if(w.nodes.begin(), w.nodes.end(), unfiltered);
      c.diagnostics->note("model.wall_and_body", place_of(c, "RWALL", w.id),
                          fmt::format("ifq filters the friction of free nodes; that of {} (the first is node {}, of rigid body {}) acts in "
                                      "full at once: 0 of ifq filters none",
                                      at_once == 1 ? "1 node of a rigid body" : fmt::format("{} nodes of rigid bodies", at_once),
                                      m.node_id[static_cast<std::size_t>(first)],
                                      m.rigid_bodies[static_cast<std::size_t>(stopped[static_cast<std::size_t>(first)])].id));
    }
    if (w.node != no_index && follows(w.node) && w.velocity != Vec3{}) {
      c.diagnostics->warning("model.wall_and_body", place_of(c, "RWALL", w.id),
                             fmt::format("the wall's initial velocity is not used: its node {} follows a rigid body, give the velocity to "
                                         "the body's main node (/INIVEL)",
                                         m.node_id[static_cast<std::size_t>(w.node)]));
    }
  }
}

/// The mass of a brick is that of its volume at the centre (docs/theory/cycle.md): of a collapsed one it may be far off.
constexpr double volume_share = 0.05;

void masses_of_collapsed_bricks(Context& c) {
  const Model& m = *c.model;
  struct Odd {
    std::vector<Id> ids;
    double worst = 0.0;
    Id worst_id = 0;
  };
  std::map<Index, Odd> odd;  // by part
  for (std::size_t e = 0; e < m.bricks.id.size(); ++e) {
    std::array<Vec3, 8> x;
    for (std::size_t k = 0; k < 8; ++k) x[k] = m.node_x[static_cast<std::size_t>(m.bricks.nodes[e][k])];
    const double shape = std::abs(shape_volume(x));
    const double off = shape > 0.0 ? std::abs(one_point_volume(x)) / shape - 1.0 : 0.0;
    if (std::abs(off) <= volume_share) continue;
    Odd& of_part = odd[m.bricks.part[e]];
    of_part.ids.push_back(m.bricks.id[e]);
    if (std::abs(off) > std::abs(of_part.worst)) {
      of_part.worst = off;
      of_part.worst_id = m.bricks.id[e];
    }
  }
  for (const auto& [part, of_part] : odd) {
    c.diagnostics->warning(
        "model.brick_mass", place_of(c, "PART", m.parts[static_cast<std::size_t>(part)].id),
        fmt::format(
            "the mass of {} is that of the volume at the centre and differs by more than {:g} % from that of the shape: {} (element {} "
            "by {:+.3g} %); enter tetrahedra as /TETRA4, and mesh other collapsed shapes anew",
            of_part.ids.size() == 1 ? "1 brick" : fmt::format("{} bricks", of_part.ids.size()), 100.0 * volume_share, list(of_part.ids),
            of_part.worst_id, 100.0 * of_part.worst));
  }
}

/// Hourglass rates of Isolid 2 see a rigid rotation of a brick that is no parallelepiped (docs/theory/elements.md).
constexpr double irregular = 0.01;  // of its longest row

void braked_rotations(Context& c) {
  const Model& m = *c.model;
  static constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  std::map<Index, std::vector<Id>> braked;  // by part
  for (std::size_t e = 0; e < m.bricks.id.size(); ++e) {
    const Part& part = m.parts[static_cast<std::size_t>(m.bricks.part[e])];
    const auto* solid = std::get_if<SolidProperty>(&m.properties[static_cast<std::size_t>(part.property)].data);
    if (solid == nullptr || solid->isolid != 2) continue;
    Vec3 rows[3], modes[4];
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3& x = m.node_x[static_cast<std::size_t>(m.bricks.nodes[e][k])];
      const auto& s = corner[k];
      for (int i = 0; i < 3; ++i) rows[i] += s[i] * x;
      for (int i = 0; i < 3; ++i) modes[i] += s[i] * s[(i + 1) % 3] * x;
      modes[3] += s[0] * s[1] * s[2] * x;
    }
    const auto longest = [](const auto& of) {
      double length = 0.0;
      for (const Vec3& a : of) length = std::max(length, norm(a));
      return length;
    };
    if (longest(modes) > irregular * longest(rows)) braked[m.bricks.part[e]].push_back(m.bricks.id[e]);
  }
  for (const auto& [part, ids] : braked) {
    c.diagnostics->warning("model.braked_rotation", place_of(c, "PART", m.parts[static_cast<std::size_t>(part)].id),
                           fmt::format("the hourglass forces of Isolid 2 brake every rotation of {} that {} no parallelepiped{}: {}; "
                                       "Isolid 1 leaves rotations alone",
                                       ids.size() == 1 ? "1 brick" : fmt::format("{} bricks", ids.size()), ids.size() == 1 ? "is" : "are",
                                       ids.size() == 1 ? "" : "s", list(ids)));
  }
}

/// 3-node shells have one kinematics, whatever Ismstr asks for.
void small_strain_of_triangles(Context& c) {
  const Model& m = *c.model;
  std::set<Index> properties;
  for (const Index part : m.sh3ns.part) properties.insert(m.parts[static_cast<std::size_t>(part)].property);
  for (const Index p : properties) {
    const auto* shell = p == no_index ? nullptr : std::get_if<ShellProperty>(&m.properties[static_cast<std::size_t>(p)].data);
    if (shell == nullptr || shell->ismstr != 1) continue;
    c.diagnostics->warning("model.no_effect", place_of(c, "PROP", m.properties[static_cast<std::size_t>(p)].id),
                           "Ismstr 1 (small strain) does nothing for 3-node shells: their strains follow their geometry");
  }
}

/// Plastic shells have no global integration: N = 0 becomes 3 points (elements/shell_common/setup.cpp).
void points_of_plastic_shells(Context& c) {
  const Model& m = *c.model;
  std::set<Index> parts, properties;
  parts.insert(m.shells.part.begin(), m.shells.part.end());
  parts.insert(m.sh3ns.part.begin(), m.sh3ns.part.end());
  for (const Index p : parts) {
    const Part& part = m.parts[static_cast<std::size_t>(p)];
    if (part.property == no_index || part.material == no_index) continue;
    if (std::holds_alternative<LawJohnsonCook>(m.materials[static_cast<std::size_t>(part.material)].law)) properties.insert(part.property);
  }
  for (const Index p : properties) {
    const Property& property = m.properties[static_cast<std::size_t>(p)];
    const auto* shell = std::get_if<ShellProperty>(&property.data);
    if (shell == nullptr || shell->points != 0) continue;
    c.diagnostics->warning("model.shell_points", place_of(c, "PROP", property.id),
                           "N is blank or 0, and LAW2 knows no global integration: 3 points are used. Their limit moment is that of first "
                           "yield, Y t^2/6, a third below Y t^2/4; 5 points have 8 % less, 9 points 2 %. Set N");
  }
}

}  // namespace

void check_plausibility(Context& context) {
  speeds_of_sound(context);
  wall_beside_the_centre(context);
  walls_and_bodies(context);
  masses_of_collapsed_bricks(context);
  braked_rotations(context);
  small_strain_of_triangles(context);
  points_of_plastic_shells(context);
}

}  // namespace abut::model
