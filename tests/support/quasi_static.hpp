// What quasi-static closed forms need: smooth ramps, and a record of the energies with the last state's forces and stresses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cycle/run.hpp"
#include "cycle/sink.hpp"
#include "support/scene.hpp"

namespace abut::scenes {

/// A function that goes from y0 at t0 to y1 at t1 with zero speed and acceleration at both ends (10 s^3 - 15 s^4 + 6 s^5), in
/// 200 chords, and is constant outside.
inline void smooth(std::vector<double>& x, std::vector<double>& y, double t0, double t1, double y0, double y1) {
  constexpr int chords = 200;
  for (int i = x.empty() ? 0 : 1; i <= chords; ++i) {
    const double s = static_cast<double>(i) / chords;
    x.push_back(t0 + (t1 - t0) * s);
    y.push_back(y0 + (y1 - y0) * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
  }
}

/// smooth() from 0 to 1 over [0, time], as a function of the scene.
inline Index ramp(Scene& scene, double time) {
  std::vector<double> x, y;
  smooth(x, y, 0.0, time, 0.0, 1.0);
  x.push_back(1e3 * time);
  y.push_back(1.0);
  return scene.function(std::move(x), std::move(y));
}

/// Energies of every cycle; forces of contact, stresses and motion of the last one.
class StaticRecord final : public cycle::Sink {
 public:
  struct Energies {
    double time = 0.0, ie = 0.0, he = 0.0, ke = 0.0, ce = 0.0, cx = 0.0, err = 0.0;
    Vec3 force;  ///< normal force on the second surface of interface 1
    Vec3 wall;   ///< normal force on wall 1
    double penetration = 0.0;
  };

  void begin(const cycle::Snapshot&) override {}
  void cycle(const cycle::Snapshot& now) override {
    const state::Balance& b = *now.balance;
    Energies e{now.state->times.t, b.ie, b.he, b.ke, b.ce, b.cx, b.err, {}, {}, 0.0};
    if (!now.interfaces.empty()) {
      e.force = now.interfaces[0].normal_force;
      e.penetration = now.interfaces[0].largest_penetration;
    }
    if (!now.walls.empty()) e.wall = now.walls[0].normal_force;
    energies.push_back(e);
    if (!now.animation_due) return;  // nodal contact forces are gathered for these cycles only
    last = *now.state;
    contact.assign(now.contact_normal.begin(), now.contact_normal.end());
    area.assign(now.contact_area.begin(), now.contact_area.end());
    stress.resize(static_cast<std::size_t>(now.model->bricks.size()));
    plastic.resize(stress.size());
    for (const auto& group : now.groups) {
      for (Index e_ = 0; e_ < group->size(); ++e_) {
        const auto output = group->output(e_);
        const auto i = static_cast<std::size_t>(group->elements()[static_cast<std::size_t>(e_)]);
        stress[i] = output.stress;
        plastic[i] = output.plastic_max;
      }
    }
  }
  void end(const cycle::Outcome& o) override { outcome = o; }

  /// Largest KE / IE from `time` on: the quasi-static claim.
  [[nodiscard]] double kinetic_share(double time) const {
    double worst = 0.0;
    for (const Energies& e : energies) {
      if (e.time >= time) worst = std::max(worst, e.ke / e.ie);
    }
    return worst;
  }

  std::vector<Energies> energies;
  state::State last;
  std::vector<Vec3> contact;                  ///< #N, normal contact force on each node
  std::vector<double> area;                   ///< #N, tributary area of the contact surfaces
  std::vector<std::array<double, 6>> stress;  ///< per brick, xx yy zz xy yz zx
  std::vector<double> plastic;                ///< per brick, equivalent plastic strain
  cycle::Outcome outcome;
};

/// Runs to `time`; the last cycle's forces are kept.
inline StaticRecord solve_static(Scene& scene, double time, const cycle::RunOptions& options = {}) {
  scene.end(time);
  scene.model.controls.animation_start = 0.98 * time;
  scene.model.controls.animation_interval = 1e-6 * time;
  StaticRecord record;
  (void)cycle::run(scene.model, options, record);
  return record;
}

}  // namespace abut::scenes
