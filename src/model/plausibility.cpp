// What a deck may say, but rarely means: materials in other units than /BEGIN, walls on bodies beside their centre of gravity, nodes
// that a rigid wall does not stop.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "model/condition_fields.hpp"
#include "model/measure.hpp"

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

}  // namespace

void check_plausibility(Context& context) {
  speeds_of_sound(context);
  wall_beside_the_centre(context);
  walls_and_bodies(context);
}

}  // namespace abut::model
