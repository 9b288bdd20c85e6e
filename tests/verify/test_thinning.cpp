// Shells that become thinner (Ithick 1): contact stiffness K = E t and the automatic gap follow the thickness (T16, T25); the same of
// TYPE7's facets, nodes and variable gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "cycle/run.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Scene;

constexpr double young = 200e9, yield = 100e6, thickness = 2e-3, side = 0.08, end = 2e-3;
constexpr int cells = 8;

struct Watch final : abut::cycle::Sink {
  void begin(const abut::cycle::Snapshot&) override {}
  void cycle(const abut::cycle::Snapshot& now) override {
    const abut::cycle::InterfaceResult& r = now.interfaces[0];
    rows.push_back({r.normal_force.z, r.largest_penetration, now.groups[0]->thickness(0)});
    in_contact = std::max(in_contact, r.in_contact);
  }
  void end(const abut::cycle::Outcome& outcome) override {
    kind = outcome.kind;
    message = outcome.message;
  }
  struct Row {
    double force, penetration, thickness;
  };
  std::vector<Row> rows;
  Index in_contact = 0;
  abut::cycle::Outcome::Kind kind = abut::cycle::Outcome::Kind::failed;
  std::string message;
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
  const std::vector<Index> lower = s.shells(sheet_part, cells, cells, flat(0.0, side, 0.0));
  const std::vector<Index> upper = s.shells(plate_part, 4, 4, flat(0.3 * side, 0.4 * side, above), true);
  s.fix(lower, {false, false, true}, {true, true, true});
  s.fix(upper, {true, true, true}, {true, true, true});
  // Every column of nodes is moved: the sheet stretches alike everywhere.
  const Index pull = s.function({0.0, end}, {0.0, 1.0});
  for (std::size_t i = 0; i <= cells; ++i) {
    std::vector<Index> column;
    for (std::size_t j = 0; j <= cells; ++j) column.push_back(lower[(cells + 1) * j + i]);
    s.displacement(column, 0, 0.3 * side * (static_cast<double>(i) / cells - 0.5), pull);
  }
  s.contact(s.shell_surface(sheet_part), s.shell_surface(plate_part), 0.2, 0.0, gap);
  s.end(end);
  return s;
}

/// The same under TYPE7: nodes of one of the two parts against the other.
enum class Nodes { of_plate, of_sheet };
Scene stretched_under_type7(double above, double gap, bool changes, Nodes nodes, int istf, int igap) {
  Scene s = stretched(above, gap, changes);
  abut::model::Interface& card = s.model.interfaces[0];
  const auto surfaces = std::get<abut::model::InterfaceType3>(card.type);
  const bool of_plate = nodes == Nodes::of_plate;
  abut::model::InterfaceType7 t7;
  t7.surface = of_plate ? surfaces.surface_1 : surfaces.surface_2;
  std::vector<Index>& held = t7.nodes;
  for (const abut::model::Segment& f :
       s.model.surfaces[static_cast<std::size_t>(of_plate ? surfaces.surface_2 : surfaces.surface_1)].segments)
    held.insert(held.end(), f.nodes.begin(), f.nodes.end());
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  t7.istf = istf;
  t7.igap = igap;
  t7.gap_given = true;
  card.type = std::move(t7);
  card.stfac = 1.0;
  return s;
}

Watch run(const Scene& s, const abut::InterfaceChoice& choice = {}) {
  abut::cycle::RunOptions options;
  options.contacts = {choice};
  Watch watch;
  (void)abut::cycle::run(s.model, options, watch);
  return watch;
}

// All springs see the same constant penetration P; each pair has s K1 K2/(K1 + K2) (T13). Nodes of the plate (9 inside, 12 on its edges, 4
// at its corners, with 1, 1/2 and 1/4 of K) meet facets of k K, k = t/t0 of the sheet; its nodes inside, with k K, meet facets of K.
// Without Ithick 1 the same motion gives k = 1, and tells how many nodes of the sheet lie over the plate.
TEST(Thinning, ContactStiffnessFollowsTheThickness) {
  const double above = 1e-3, gap = 1.1e-3;
  abut::InterfaceChoice constant;
  constant.law = abut::contact::Law::constant;
  const auto pair = [](double one, double other) { return one * other / (one + other); };
  const auto of_plate = [&](double k) { return 9 * pair(1.0, k) + 12 * pair(0.5, k) + 4 * pair(0.25, k); };
  const double unit = (gap - above) * 0.2 * young * thickness;
  const Watch kept = run(stretched(above, gap, false), constant), follows = run(stretched(above, gap, true), constant);
  ASSERT_EQ(kept.kind, abut::cycle::Outcome::Kind::finished);
  ASSERT_EQ(follows.kind, abut::cycle::Outcome::Kind::finished);
  EXPECT_EQ(kept.rows.back().thickness, thickness);
  const double over = (std::abs(kept.rows.back().force) / unit - of_plate(1.0)) / pair(1.0, 1.0);  // nodes of the sheet over the plate
  EXPECT_GT(over, 5.0);
  const std::size_t taken = (follows.rows.size() - 1) / 100 * 100 - 1;  // values are looked at every 100 cycles
  const double k = follows.rows[taken].thickness / thickness;
  const double expected = unit * (of_plate(k) + over * pair(k, 1.0)), found = std::abs(follows.rows.back().force);
  std::printf("  t/t0 %.4f: force %.6g of %.6g, %.6g with the thickness of the start; %.3f nodes of the sheet over the plate\n", k, found,
              expected, std::abs(kept.rows.back().force), over);
  EXPECT_LT(k, 0.9);
  EXPECT_NEAR(found, expected, 1e-3 * expected);
}

// Automatic gap: the plates touch while half of both thicknesses reaches over the distance; as the sheet thins the contact opens by itself.
TEST(Thinning, AutomaticGapFollowsTheThickness) {
  const double above = 0.97 * thickness;
  abut::InterfaceChoice automatic;
  automatic.automatic_gap = true;
  const Watch w = run(stretched(above, 0.0, true), automatic);
  ASSERT_EQ(w.kind, abut::cycle::Outcome::Kind::finished);
  EXPECT_NEAR(w.rows[2].penetration, thickness - above, 1e-9);
  EXPECT_GT(w.in_contact, 0);
  std::size_t checked = 0;
  for (std::size_t i = 200; i < w.rows.size(); i += 50) {
    const Watch::Row& row = w.rows[i];
    // Values of at most 100 cycles ago, and noticed from 0.1 % on.
    const double before = w.rows[i - 101].thickness;
    const auto gap = [&](double t) { return std::max(0.0, 0.5 * (thickness + t) - above); };
    EXPECT_LE(row.penetration, gap(before) + 2e-3 * thickness);
    EXPECT_GE(row.penetration, gap(row.thickness) - 2e-3 * thickness);
    ++checked;
  }
  EXPECT_GT(checked, 5U);
  EXPECT_EQ(w.rows.back().penetration, 0.0);
}

// TYPE7: the same motion with and without Ithick 1 has the same pairs at the same depth, so their forces are as K of the pairs. With k =
// t/t0 of the sheet: its facets k (Istf 0), the mean of facet and node (Istf 2), in series (Istf 5), whichever of the two is the sheet.
TEST(Thinning, StiffnessOfType7FollowsTheThickness) {
  struct Case {
    Nodes nodes;
    int istf;
    double (*ratio)(double);
  };
  const auto kept = [](double) { return 1.0; };
  const auto own = [](double k) { return k; };
  const auto mean = [](double k) { return 0.5 * (1.0 + k); };
  const auto series = [](double k) { return 2.0 * k / (1.0 + k); };
  for (const Case& c : {Case{Nodes::of_plate, 0, own}, Case{Nodes::of_sheet, 0, kept}, Case{Nodes::of_plate, 1, kept},
                        Case{Nodes::of_sheet, 2, mean}, Case{Nodes::of_sheet, 5, series}, Case{Nodes::of_plate, 5, series}}) {
    const Watch constant = run(stretched_under_type7(1e-3, 1.1e-3, false, c.nodes, c.istf, 0));
    const Watch follows = run(stretched_under_type7(1e-3, 1.1e-3, true, c.nodes, c.istf, 0));
    ASSERT_EQ(constant.kind, abut::cycle::Outcome::Kind::finished);
    ASSERT_EQ(follows.kind, abut::cycle::Outcome::Kind::finished);
    const double k = follows.rows[(follows.rows.size() - 1) / 100 * 100 - 1].thickness / thickness;
    const double found = follows.rows.back().force / constant.rows.back().force, expected = c.ratio(k);
    std::printf("  Istf %d, nodes of the %s: t/t0 %.4f, force over that of the start's thickness %.5f of %.5f\n", c.istf,
                c.nodes == Nodes::of_plate ? "plate" : "sheet", k, found, expected);
    EXPECT_LT(k, 0.9);
    EXPECT_NEAR(found, expected, 1e-3);
  }
}

// TYPE7, Igap 1: g = (t_sheet + t_plate)/2, at least Gapmin, whichever of the two has the nodes.
TEST(Thinning, VariableGapOfType7FollowsTheThickness) {
  const double above = 0.97 * thickness, least = 0.5 * thickness;
  for (const Nodes nodes : {Nodes::of_plate, Nodes::of_sheet}) {
    for (const int istf : {0, 1, 5}) {
      const Watch w = run(stretched_under_type7(above, least, true, nodes, istf, 1));
      ASSERT_EQ(w.kind, abut::cycle::Outcome::Kind::finished) << w.message;
      EXPECT_NEAR(w.rows[2].penetration, thickness - above, 1e-9);
      std::size_t checked = 0;
      for (std::size_t i = 200; i < w.rows.size(); i += 50) {
        const Watch::Row& row = w.rows[i];
        const auto penetration = [&](double t) { return std::max(0.0, 0.5 * (thickness + t) - above); };
        EXPECT_LE(row.penetration, penetration(w.rows[i - 101].thickness) + 2e-3 * thickness);
        EXPECT_GE(row.penetration, penetration(row.thickness) - 2e-3 * thickness);
        ++checked;
      }
      EXPECT_GT(checked, 5U);
      EXPECT_LT(w.rows.back().thickness, 0.9 * thickness);
    }
  }
}

}  // namespace
