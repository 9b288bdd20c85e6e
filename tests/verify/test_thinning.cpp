// Shells that become thinner (Ithick 1): contact stiffness K = E t and the automatic gap follow the thickness (T16, T25).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "cycle/run.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Scene;

constexpr double young = 200e9, yield = 100e6, thickness = 2e-3, side = 0.04, end = 2e-3;

struct Watch final : abut::cycle::Sink {
  void begin(const abut::cycle::Snapshot&) override {}
  void cycle(const abut::cycle::Snapshot& now) override {
    const abut::cycle::InterfaceResult& r = now.interfaces[0];
    opening_force.push_back({r.normal_force.z, r.largest_penetration, now.groups[0]->thickness(0)});
    in_contact = std::max(in_contact, r.in_contact);
  }
  void end(const abut::cycle::Outcome& outcome) override { kind = outcome.kind; }
  struct Row {
    double force, penetration, thickness;
  };
  std::vector<Row> opening_force;
  Index in_contact = 0;
  abut::cycle::Outcome::Kind kind = abut::cycle::Outcome::Kind::failed;
};

/// A perfectly plastic sheet is stretched to 1.3 times its length, its mid-surface held at z = 0, under a stiff plate (elastic, all nodes
/// held) whose mid-surface lies `above`. Their surfaces face each other; s K1 K2/(K1 + K2) with K1 of the sheet, K2 of the plate.
Scene stretched(double above, double gap, bool changes) {
  Scene s("thinning");
  const Index soft = s.johnson_cook(7800.0, young, 0.3, yield, 0.0, 1.0), hard = s.elastic(7800.0, young, 0.3);
  const Index sheet = s.shell_property(thickness), plate = s.shell_property(thickness);
  std::get<abut::model::ShellProperty>(s.model.properties[static_cast<std::size_t>(sheet)].data).thickness_changes = changes;
  const auto flat = [](double x0, double size, double z) {
    return [=](double u, double v) { return Vec3{x0 + size * u, x0 + size * v, z}; };
  };
  const Index sheet_part = s.part(sheet, soft), plate_part = s.part(plate, hard);
  const std::vector<Index> lower = s.shells(sheet_part, 4, 4, flat(0.0, side, 0.0));
  const std::vector<Index> upper = s.shells(plate_part, 4, 4, flat(0.002, side - 0.004, above), true);
  s.fix(lower, {false, false, true}, {true, true, true});
  s.fix(upper, {true, true, true}, {true, true, true});
  // Every column of nodes is moved: the sheet stretches alike everywhere.
  const Index pull = s.function({0.0, end}, {0.0, 1.0});
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<Index> column;
    for (std::size_t j = 0; j < 5; ++j) column.push_back(lower[5 * j + i]);
    s.displacement(column, 0, 0.3 * side * static_cast<double>(i) / 4.0, pull);
  }
  s.contact(s.shell_surface(sheet_part), s.shell_surface(plate_part), 0.2, 0.0, gap);
  s.end(end);
  return s;
}

Watch run(const Scene& s, const std::vector<abut::InterfaceChoice>& choices = {}) {
  abut::cycle::RunOptions options;
  options.contacts = choices;
  Watch watch;
  (void)abut::cycle::run(s.model, options, watch);
  return watch;
}

// All springs see the same constant penetration P. Their force is P sum s K1 K2/(K1 + K2): with K1 = E t(t) it falls as the sheet thins,
// without Ithick 1 it does not.
TEST(Thinning, ContactStiffnessFollowsTheThickness) {
  for (const bool changes : {true, false}) {
    const Watch w = run(stretched(1e-3, 1.1e-3, changes), {{.interface_id = 0, .law = abut::contact::Law::constant}});
    ASSERT_EQ(w.kind, abut::cycle::Outcome::Kind::finished);
    const Watch::Row &first = w.opening_force[2], &last = w.opening_force.back();
    const double thinner = last.thickness / thickness;
    if (changes) {
      EXPECT_LT(thinner, 0.92);
    } else {
      EXPECT_EQ(thinner, 1.0);
    }
    // Sheet's nodes over the plate's facets and plate's nodes over the sheet's: K2 or K1 a quarter per facet around a node. All pairs have
    // one of the two as facet and the other as node, so s K1 K2/(K1 + K2) with k = K1/K: (k w)/(k + w) for a node of weight w.
    const auto share = [](double k, double node) { return k * node / (k + node); };
    const double inside = 1.0, factor = share(thinner, inside) / share(1.0, inside);
    std::printf("  t/t0 %.4f, force over that at the start %.4f, of equal inner nodes %.4f\n", thinner, last.force / first.force, factor);
    EXPECT_NEAR(last.force / first.force, factor, 0.02);
  }
}

// Automatic gap: the plates touch while half of both thicknesses reaches over the distance; as the sheet thins the contact opens by itself.
TEST(Thinning, AutomaticGapFollowsTheThickness) {
  const double above = 0.97 * thickness;
  const Watch w = run(stretched(above, 0.0, true), {{.interface_id = 0, .automatic_gap = true}});
  ASSERT_EQ(w.kind, abut::cycle::Outcome::Kind::finished);
  EXPECT_NEAR(w.opening_force[2].penetration, thickness - above, 1e-9);
  EXPECT_GT(w.in_contact, 0);
  std::size_t checked = 0;
  for (std::size_t i = 200; i < w.opening_force.size(); i += 50) {
    const Watch::Row& row = w.opening_force[i];
    // Values of at most 100 cycles ago, and noticed from 0.1 % on.
    const double before = w.opening_force[i - 101].thickness;
    const auto gap = [&](double t) { return std::max(0.0, 0.5 * (thickness + t) - above); };
    EXPECT_LE(row.penetration, gap(before) + 2e-3 * thickness);
    EXPECT_GE(row.penetration, gap(row.thickness) - 2e-3 * thickness);
    ++checked;
  }
  EXPECT_GT(checked, 5U);
  EXPECT_EQ(w.opening_force.back().penetration, 0.0);
}

}  // namespace
