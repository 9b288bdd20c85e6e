// Hertz contact of two parallel cylinders: protocol and theory in support/hertz.hpp.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "support/hertz.hpp"

namespace {

using namespace abut;
using namespace abut::scenes::hertz;
using scenes::EqualStepParts;
using scenes::Scene;
using scenes::StaticRecord;
using scenes::Sweep;

struct Cylinders {
  double radius = 254.0, young = 206e3, poisson = 0.3, density = 7.8e-9;  // mm, N, t, s
  double s = 4.0;
  double load = 10e3;        ///< per length
  double approach = 0.1842;  ///< of the ends, chosen so that the force is the load; the tests compare at the force that is there
  double fine = 5.5;         ///< half width of even bricks
  double size = 40.0;
  double brick = 0.35;  ///< width of the lower body's bricks there; the upper one's are 0.86 of it
};

/// Half of the end of a cylinder, one brick thick along y: x in [0, size], rows 0..rows, the last one is the arc.
struct Strip {
  Sweep solid;
  int columns = 0, rows = 0;
  [[nodiscard]] Index at(int column, int row, int y) const { return solid.at(column + (columns + 1) * row, y); }
  [[nodiscard]] std::vector<std::array<Index, 4>> arc() const {  ///< normals along +z
    std::vector<std::array<Index, 4>> faces;
    for (int i = 0; i < columns; ++i) faces.push_back({at(i, rows, 0), at(i + 1, rows, 0), at(i + 1, rows, 1), at(i, rows, 1)});
    return faces;
  }
};

Strip strip(Scene& scene, const Cylinders& c, double brick, bool upper, EqualStepParts& parts) {
  const int fine = static_cast<int>(std::lround(c.fine / brick));
  const int coarse = static_cast<int>(std::lround(1.6 * fine));
  const double h = c.fine / fine;
  Strip s;
  s.columns = fine + coarse;
  s.rows = static_cast<int>(std::lround(2.2 * fine));
  const std::vector<double> out = scenes::graded(coarse, scenes::growth_from(h, c.size - c.fine, coarse));
  const std::vector<double> depth = scenes::graded(s.rows, scenes::growth_from(h, c.size, s.rows));
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> quads;
  const double side = upper ? -1.0 : 1.0;
  for (int k = 0; k <= s.rows; ++k) {
    for (int i = 0; i <= s.columns; ++i) {
      const double x = i <= fine ? h * i : c.fine + (c.size - c.fine) * out[static_cast<std::size_t>(i - fine)];
      const double top = std::sqrt(c.radius * c.radius - x * x) - c.radius;
      const double zeta = depth[static_cast<std::size_t>(s.rows - k)];
      points.push_back({x, 0.0, side * ((1.0 - zeta) * top - zeta * c.size)});
      if (i == s.columns || k == s.rows) continue;
      const int p = i + (s.columns + 1) * k;
      quads.push_back({p, p + 1, p + s.columns + 2, p + s.columns + 1});
    }
  }
  s.solid = scenes::sweep(
      scene, static_cast<int>(points.size()), quads, 1,
      [&points](int p, int k) {
        const Vec3& x = points[static_cast<std::size_t>(p)];
        return Vec3{x.x, static_cast<double>(k), x.z};
      },
      std::ref(parts));
  return s;
}

Answer press(const Cylinders& c, const std::string& csv) {
  Scene scene("cylinders");
  EqualStepParts parts(scene, scene.solid_property(), c.young, c.poisson, c.density, c.brick);
  const Strip lower = strip(scene, c, c.brick, false, parts);
  const Strip upper = strip(scene, c, 0.86 * c.brick, true, parts);
  for (const Strip* s : {&lower, &upper}) {
    scene.fix(s->solid.nodes, {false, true, false});
    scene.fix(scenes::nodes_on(scene, s->solid.nodes, 0, 0.0), {true, false, false});
  }
  const double unit = 4.0 * c.fine / std::sqrt(c.young / c.density);
  const double time = 24.0 * unit;
  scene.fix(scenes::nodes_on(scene, lower.solid.nodes, 2, -c.size), {false, false, true});
  scene.displacement(scenes::nodes_on(scene, upper.solid.nodes, 2, c.size), 2, -c.approach, scenes::ramp(scene, time));
  const Index below = scene.surface(lower.arc());
  const Index above = scene.surface(scenes::turned(upper.arc()));
  scene.contact(below, above, c.s);
  const StaticRecord r = scenes::solve_static(scene, time + unit);
  Answer a = energies_of(scene, r, time);
  Pressure pressure;
  const std::vector<double> area = scenes::nodal_areas(scene, {below, above});
  for (const Strip* s : {&lower, &upper}) {
    for (int i = 0; i <= s->columns; ++i) {
      for (int y = 0; y < 2; ++y) {
        const auto n = static_cast<std::size_t>(s->at(i, s->rows, y));
        pressure.add(scene.model.node_x[n].x, std::abs(r.contact[n].z), area[n]);
      }
    }
  }
  a.force = 2.0 * std::abs(r.energies.back().force.z);
  a.radius = pressure.radius(4.0);
  a.pressure = pressure.peak(0.9 * 3.78);
  a.middle = pressure.middle();
  if (!csv.empty()) pressure.write(csv);
  return a;
}

Shares compare(const Cylinders& c, const Answer& a) {
  const double radius = std::sqrt(4.0 * a.force * 0.5 * c.radius / (pi * modulus(c.young, c.poisson)));
  const double pressure = 2.0 * a.force / (pi * radius);
  std::printf(
      "[found] Hertz, cylinders: s %.3g, gap 0, bricks of %.3g and %.3g mm, %d bricks, %d cycles: F %.3f kN/mm, a %.3f mm (%.3f), p0 %.0f "
      "MPa "
      "(%.0f), middle %.0f, KE/IE %.1e, HE/IE %.1e\n",
      c.s, c.brick, 0.86 * c.brick, a.bricks, a.cycles, 1e-3 * a.force, a.radius, radius, a.pressure, pressure, a.middle, a.kinetic,
      a.hourglass);
  return {a.force / c.load, a.radius / radius, a.pressure / pressure};
}

TEST(Hertz, CylindersConvergeToWidthAndPressure) {
  Cylinders c;
  const double width = std::sqrt(4.0 * c.load * 0.5 * c.radius / (pi * modulus(c.young, c.poisson)));
  EXPECT_NEAR(width, 3.78, 0.001);
  EXPECT_NEAR(2.0 * c.load / (pi * width), 1684.0, 1.0);
  double radius_error = 1e30;
  for (const double brick : {0.8, 0.5, 0.35}) {
    c.brick = brick;
    const Answer a = press(c, brick == 0.35 ? "hertz_cylinders" : "");
    expect_static(a);
    const Shares share = compare(c, a);
    EXPECT_NEAR(share.force, 1.0, 0.015) << brick;
    EXPECT_NEAR(share.radius, 1.0, 0.03) << brick;
    EXPECT_NEAR(share.pressure, 1.0, 0.05) << brick;
    EXPECT_LT(std::abs(share.radius - 1.0), radius_error) << brick;
    radius_error = std::abs(share.radius - 1.0);
    if (brick == 0.35) {
      EXPECT_NEAR(a.radius, 3.78, 0.03 * 3.78);
      EXPECT_NEAR(a.pressure, 1684.0, 0.05 * 1684.0);
    }
  }
}

TEST(HertzFull, CylindersOnAFinerMesh) {
  Cylinders c;
  c.brick = 0.2;
  const Answer a = press(c, "");
  expect_static(a);
  const Shares share = compare(c, a);
  EXPECT_NEAR(share.radius, 1.0, 0.02);
  EXPECT_NEAR(share.pressure, 1.0, 0.03);
}

}  // namespace
