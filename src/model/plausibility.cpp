// What a deck may say, but rarely means: materials in other units than /BEGIN, late bodies beside their centre of gravity, nodes that a
// rigid wall cannot stop.
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

/// A body that a sensor switches on keeps its main node where it is and moves about it as about its centre of gravity.
void centres_of_late_bodies(Context& c) {
  const Model& m = *c.model;
  const std::vector<double> masses = nodal_masses(m);
  for (const RigidBody& b : m.rigid_bodies) {
    if (b.sensor == no_index || b.main == no_index || b.nodes.empty()) continue;
    double mass = 0.0, size = 0.0;
    Vec3 moment{};
    const Vec3 main = m.node_x[static_cast<std::size_t>(b.main)];
    for (const Index n : b.nodes) {
      const auto i = static_cast<std::size_t>(n);
      mass += masses[i];
      moment += masses[i] * (m.node_x[i] - main);
      size = std::max(size, norm(m.node_x[i] - main));
    }
    mass += masses[static_cast<std::size_t>(b.main)];
    if (mass <= 0.0 || norm(moment) <= 0.01 * size * mass) continue;
    const Vec3 centre = main + moment / mass;
    c.diagnostics->warning(
        "model.late_body", place_of(c, "RBODY", b.id),
        fmt::format("a body that a sensor switches on keeps its main node where it is and turns about it, but the centre of "
                    "gravity is {:.4g} away: it would start to turn and make energy; put node {} at {:.6g} {:.6g} {:.6g}",
                    norm(moment) / mass, m.node_id[static_cast<std::size_t>(b.main)], centre.x, centre.y, centre.z));
  }
}

void walls_and_bodies(Context& c) {
  const Model& m = *c.model;
  std::vector<Index> body(static_cast<std::size_t>(m.node_count()), no_index);
  for (std::size_t b = 0; b < m.rigid_bodies.size(); ++b) {
    const RigidBody& card = m.rigid_bodies[b];
    if (card.sensor != no_index || !card.active) continue;
    for (const Index n : card.nodes) body[static_cast<std::size_t>(n)] = static_cast<Index>(b);
  }
  for (const RigidWall& w : m.rigid_walls) {
    const auto follows = [&](Index n) { return body[static_cast<std::size_t>(n)] != no_index; };
    const auto count = std::count_if(w.nodes.begin(), w.nodes.end(), follows);
    if (count > 0) {
      const Index first = *std::find_if(w.nodes.begin(), w.nodes.end(), follows);
      const RigidBody& b = m.rigid_bodies[static_cast<std::size_t>(body[static_cast<std::size_t>(first)])];
      c.diagnostics->note(
          "model.wall_and_body", place_of(c, "RWALL", w.id),
          fmt::format("{} a rigid body (the first is node {}, of rigid body {}) and {} not stopped by this wall: of a body it "
                      "stops the main node only; use an interface (/INTER/TYPE7) where the body's faces are to be held",
                      count == 1 ? "1 node follows" : fmt::format("{} nodes follow", count), m.node_id[static_cast<std::size_t>(first)],
                      b.id, count == 1 ? "is" : "are"));
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
  centres_of_late_bodies(context);
  walls_and_bodies(context);
}

}  // namespace abut::model
