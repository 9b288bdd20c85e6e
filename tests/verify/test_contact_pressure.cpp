// Contact pressure as the animation shows it: a node's net normal contact force over its tributary area. On a flat conforming patch
// that carries a uniform pressure it is that pressure at every node, corners and edges too, on both sides, and two passes do not
// count it twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cycle/run.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Scene;

/// Mean over the last half of the run of every node's pressure, and of the area beside it.
class PressureRecorder final : public abut::cycle::Sink {
 public:
  explicit PressureRecorder(double from) : from_(from) {}
  void begin(const abut::cycle::Snapshot&) override {}
  void cycle(const abut::cycle::Snapshot& now) override {
    if (!now.animation_due || now.state->times.t < from_) return;
    pressure.resize(now.contact_normal.size());
    area.assign(now.contact_area.begin(), now.contact_area.end());
    for (std::size_t n = 0; n < pressure.size(); ++n) {
      if (area[n] > 0.0) pressure[n] += norm(now.contact_normal[n]) / area[n];
    }
    ++states;
  }
  void end(const abut::cycle::Outcome& outcome) override {
    kind = outcome.kind;
    for (double& p : pressure) p /= std::max(1, states);
  }
  std::vector<double> pressure, area;
  int states = 0;
  abut::cycle::Outcome::Kind kind = abut::cycle::Outcome::Kind::failed;

 private:
  double from_;
};

constexpr int cells = 6;
constexpr double side = 0.06, gap = 2e-3, pressure = 1e5, end = 4e-3;

/// Two thin steel plates, `gap` apart, pressed on each other by a pressure that rises smoothly over the first half of the run. The plates
/// bend so easily that every node has to carry its own load: statics alone say what the pressure is, whatever the springs are.
Scene two_plates(bool second_interface) {
  Scene scene("patch");
  const Index material = scene.elastic(7800.0, 210e9, 0.3);
  const Index property = scene.shell_property(3e-4);
  const auto grid = [&](double z, bool flip) {
    const Index part = scene.part(property, material);
    const auto nodes = scene.shells(
        part, cells, cells,
        [z](double u, double v) {
          return Vec3{side * u, side * v, z};
        },
        flip);
    return std::pair{part, nodes};
  };
  const auto [lower_part, lower] = grid(0.0, false);
  const auto [upper_part, upper] = grid(gap, true);
  std::vector<double> t, y;
  for (int k = 0; k <= 60; ++k) {
    const double s = std::min(1.0, k / 50.0);
    t.push_back(0.5 * end * k / 50.0);
    y.push_back(s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
  }
  t.push_back(10.0 * end);
  y.push_back(1.0);
  const Index ramp = scene.function(t, y);
  const double facet = (side / cells) * (side / cells);
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double share = facet / ((i == 0 || i == cells ? 2.0 : 1.0) * (j == 0 || j == cells ? 2.0 : 1.0));
      const auto n = static_cast<std::size_t>(i + (cells + 1) * j);
      scene.load({lower[n]}, 2, share * pressure, ramp);
      scene.load({upper[n]}, 2, -share * pressure, ramp);
    }
  }
  const Index first = scene.shell_surface(lower_part), second = scene.shell_surface(upper_part);
  scene.contact(first, second, 0.2, 0.0, gap);
  if (second_interface) scene.contact(first, second, 0.2, 0.0, gap);
  scene.end(end);
  scene.model.controls.animation_start = 0.0;
  scene.model.controls.animation_interval = end / 400.0;
  return scene;
}

struct Found {
  double lowest = 1e300, highest = 0.0, area = 0.0;
  int nodes = 0;
};
Found solve(const Scene& scene) {
  PressureRecorder r(0.6 * end);
  (void)abut::cycle::run(scene.model, {}, r);
  EXPECT_EQ(r.kind, abut::cycle::Outcome::Kind::finished);
  Found found;
  for (std::size_t n = 0; n < r.pressure.size(); ++n) {
    if (!(r.area[n] > 0.0)) continue;
    found.lowest = std::min(found.lowest, r.pressure[n]);
    found.highest = std::max(found.highest, r.pressure[n]);
    found.area += r.area[n];
    ++found.nodes;
  }
  return found;
}

TEST(ContactPressure, IsUniformOnAFlatConformingPatch) {
  const Found f = solve(two_plates(false));
  std::printf("[found] contact pressure over applied: %.4f to %.4f at %d nodes\n", f.lowest / pressure, f.highest / pressure, f.nodes);
  EXPECT_EQ(f.nodes, 2 * (cells + 1) * (cells + 1));
  EXPECT_NEAR(f.area, 2.0 * side * side, 1e-3 * side * side);
  EXPECT_GT(f.lowest, 0.98 * pressure);
  EXPECT_LT(f.highest, 1.02 * pressure);
}

TEST(ContactPressure, AreaOfSurfacesThatServeInTwoInterfacesCountsOnce) {
  const Found f = solve(two_plates(true));
  std::printf("[found] the same with two interfaces: %.4f to %.4f\n", f.lowest / pressure, f.highest / pressure);
  EXPECT_NEAR(f.area, 2.0 * side * side, 1e-3 * side * side);
  EXPECT_GT(f.lowest, 0.98 * pressure);
  EXPECT_LT(f.highest, 1.02 * pressure);
}

}  // namespace
