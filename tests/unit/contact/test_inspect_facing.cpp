// The facing rule and automatic orientation: T5, T31.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "contact/inspect/shape.hpp"
#include "inspect_scenes.hpp"

namespace abut::contact {
namespace {

using test::Pair;

void expect_all(const Facing& f, int answer) {
  std::size_t decided = 0;
  for (const std::int8_t a : f.facet) {
    if (a == 0) continue;
    EXPECT_EQ(a, answer);
    ++decided;
  }
  EXPECT_GT(decided, 0u);
}

/// T5: four ways to orient two plates; each side is judged on its own, so both can be wrong.
TEST(Facing, T5_plates_right_one_wrong_both_wrong) {
  for (const bool first_right : {true, false}) {
    for (const bool second_right : {true, false}) {
      Pair p;
      p.facets[0] = p.plate(6, 6, 0.0, 1.0, 0.0, first_right);
      p.facets[1] = p.plate(5, 5, 0.1, 0.9, 0.01, !second_right);
      const auto [a, b] = facing(p.input());
      expect_all(a, first_right ? 1 : -1);
      expect_all(b, second_right ? 1 : -1);
      EXPECT_EQ(test::has(inspect(p.input()), "contact.normals_away", 0), !first_right);
      EXPECT_EQ(test::has(inspect(p.input()), "contact.normals_away", 1), !second_right);

      const Orientation o = orient(p.input());
      EXPECT_EQ(o.flip[0].size(), first_right ? 0u : 36u);
      EXPECT_EQ(o.flip[1].size(), second_right ? 0u : 25u);
      EXPECT_FALSE(o.ambiguous[0] || o.ambiguous[1]);
      p.apply(o);
      EXPECT_FALSE(test::has_errors(inspect(p.input())));
    }
  }
}

/// T31: a single reversed segment is found by its number, and only it is turned.
TEST(Facing, T31_one_reversed_segment_in_a_plate) {
  Pair p;
  p.facets[0] = p.plate(6, 6, 0.0, 1.0, 0.0, true);
  p.facets[1] = p.plate(5, 5, 0.0, 1.0, 0.01, false);
  p.facets[0][14] = reversed(p.facets[0][14]);
  const auto found = inspect(p.input());
  const Finding* away = test::find(found, "contact.normals_away", 0);
  ASSERT_NE(away, nullptr);
  EXPECT_EQ(away->facets, std::vector<Index>{14});
  EXPECT_NEAR(away->measure, 35.0 / 36.0, 1e-12);
  const Finding* mixed = test::find(found, "contact.mixed_orientation", 0);
  ASSERT_NE(mixed, nullptr);
  EXPECT_EQ(mixed->facets, std::vector<Index>{14});
  EXPECT_DOUBLE_EQ(mixed->measure, 4.0);
  EXPECT_EQ(orient(p.input()).flip[0], std::vector<Index>{14});
}

/// A thin closed box on a plate: only its bottom sees the plate; top and walls are hidden or look along it.
TEST(Facing, T5_closed_box_on_a_plate) {
  for (const bool inside_out : {false, true}) {
    Pair p;
    p.facets[0] = p.plate(8, 8, -1.0, 2.0, 0.0, true);
    p.facets[1] = p.box({0.0, 0.0, 0.02}, {1.0, 1.0, 0.15}, 4, inside_out);
    const auto [a, b] = facing(p.input());
    expect_all(a, 1);
    expect_all(b, inside_out ? -1 : 1);
    const Orientation o = orient(p.input());
    EXPECT_EQ(o.flip[1].size(), inside_out ? p.facets[1].size() : 0u);
  }
}

/// A box that has sunk into a plate by less than half a segment: its normals are right, the overlap is what is found.
TEST(Facing, a_closed_body_tells_overlap_from_reversal) {
  Pair p;
  p.facets[0] = p.plate(8, 8, -1.0, 2.0, 0.0, true);
  p.facets[1] = p.box({0.03, 0.03, -0.02}, {1.0, 1.0, 0.5}, 4, false);
  const auto found = inspect(p.input());
  EXPECT_FALSE(test::has(found, "contact.normals_away", 1));
  EXPECT_TRUE(test::has(found, "contact.overlap", 1));
}

/// A block of solids that has sunk a little into another, a hair within its border or far from it: the faces beside see the other block
/// behind them, farther than half a segment, and are right.
TEST(Facing, faces_that_look_out_of_their_solid_are_never_reversed) {
  for (const double inset : {0.003, 0.006, 0.01, 0.018}) {
    Pair p;
    p.facets[0] = p.box({0.0, 0.0, 0.0}, {0.1, 0.1, 0.05}, 10, false);
    p.facets[1] = p.box({inset, inset, 0.0495}, {0.1 - 2.0 * inset, 0.1 - 2.0 * inset, 0.03}, 8, false);
    for (std::size_t k = 0; k < 2; ++k) p.outward[k].assign(p.facets[k].size(), 1);
    const auto found = inspect(p.input());
    EXPECT_FALSE(test::has_errors(found)) << inset;
    EXPECT_TRUE(test::has(found, "contact.overlap", 0) && test::has(found, "contact.overlap", 1)) << inset;
    const Orientation o = orient(p.input());
    EXPECT_TRUE(o.flip[0].empty() && o.flip[1].empty()) << inset;
  }
}

/// Where no face of a solid's surface has the other side before it, contact is felt nowhere: an error that does not ask to reverse
/// anything.
TEST(Facing, T31_a_surface_behind_the_faces_of_its_solid) {
  Pair p;
  p.facets[0] = p.plate(8, 8, 0.0, 1.0, 0.0, true);  // the top of a block, the other body is below that block
  p.outward[0].assign(p.facets[0].size(), 1);
  p.facets[1] = p.plate(6, 6, 0.1, 0.9, -0.1, true);
  const auto found = inspect(p.input());
  const Finding* away = test::find(found, "contact.normals_away", 0);
  ASSERT_NE(away, nullptr);
  EXPECT_EQ(away->advice.find("everse"), std::string::npos) << away->advice;
  EXPECT_TRUE(orient(p.input()).flip[0].empty());
}

/// A block within a closed box of shells, at any clearance or none: the box must look inwards. Outward normals prove nothing there.
TEST(Facing, T31_what_lies_within_a_closed_shell_tells_its_side) {
  for (const double clearance : {0.0, 0.001, 0.005, 0.009, 0.011, 0.02}) {
    for (const bool inward : {false, true}) {
      Pair p;
      p.facets[0] = p.box({0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}, 5, inward);
      const double size = 0.1 - 2.0 * clearance;
      p.facets[1] = p.box({clearance, clearance, clearance}, {size, size, size}, 4, false);
      p.outward[1].assign(p.facets[1].size(), 1);
      EXPECT_EQ(test::has(inspect(p.input()), "contact.normals_away", 0), !inward) << clearance;
      EXPECT_FALSE(test::has(inspect(p.input()), "contact.normals_away", 1)) << clearance;
      const Orientation o = orient(p.input());
      EXPECT_EQ(o.flip[0].size(), inward ? 0u : p.facets[0].size()) << clearance;
      EXPECT_TRUE(o.flip[1].empty()) << clearance;
    }
  }
}

/// Concentric cylinders: a shaft in a ring, either of them turned inside out; meshes that do not match.
TEST(Facing, T5_cylinders) {
  for (const bool shaft_wrong : {false, true}) {
    for (const bool ring_wrong : {false, true}) {
      Pair p;
      p.facets[0] = p.cylinder(1.0, 24, 5, shaft_wrong);
      p.facets[1] = p.cylinder(1.03, 31, 4, !ring_wrong);
      const auto [a, b] = facing(p.input());
      expect_all(a, shaft_wrong ? -1 : 1);
      expect_all(b, ring_wrong ? -1 : 1);
    }
  }
}

/// Two crossed cylinders: the answer does not depend on where the pair lies in space, or on the order of the facets.
TEST(Facing, does_not_depend_on_place_or_listing) {
  Pair p;
  p.facets[0] = p.cylinder(1.0, 20, 6, false);
  p.facets[1] = p.plate(7, 7, -1.0, 1.0, 1.02, false);
  const auto before = facing(p.input());
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vec3& x : p.x) x = Vec3{c * x.x - s * x.z + 3.0, x.y - 2.0, s * x.x + c * x.z};
  std::reverse(p.facets[0].begin(), p.facets[0].end());
  const auto after = facing(p.input());
  EXPECT_NEAR(before[0].area_facing, after[0].area_facing, 1e-12);
  EXPECT_NEAR(before[1].area_facing, after[1].area_facing, 1e-12);
  EXPECT_EQ(after[0].area_away + after[1].area_away, 0.0);
}

/// T33: a watch that keeps what it found at first says of every later shape what a first look at it says: moved, bent, turned inside out,
/// with a facet pressed flat for a while.
TEST(Facing, T33_a_watch_says_what_a_first_look_says) {
  Pair p;
  p.facets[0] = p.cylinder(1.0, 20, 6, false);
  p.facets[1] = p.plate(7, 7, -1.0, 1.0, 1.02, false);
  const std::vector<Vec3> start = p.x;
  FacingWatch watch;
  for (int n = 0; n <= 12; ++n) {
    const double angle = 0.5 * n, c = std::cos(angle), s = std::sin(angle), turn = n > 8 ? -1.0 : 1.0;
    for (std::size_t k = 0; k < p.x.size(); ++k) {
      const Vec3& a = start[k];
      p.x[k] = {c * turn * a.x - s * a.z + n, a.y * (1.0 + 0.1 * n), s * turn * a.x + c * a.z};
    }
    if (n % 3 == 1) {
      const auto& corners = p.facets[1][24].node;
      for (const Index i : corners) p.x[static_cast<std::size_t>(i)] = p.x[static_cast<std::size_t>(corners[0])];
    }
    const auto fresh = facing(p.input()), watched = watch.look(p.input());
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(fresh[k].facet, watched[k].facet) << n;
      EXPECT_EQ(fresh[k].area_facing, watched[k].area_facing) << n;
      EXPECT_EQ(fresh[k].area_away, watched[k].area_away) << n;
      EXPECT_EQ(fresh[k].distance, watched[k].distance) << n;
    }
    EXPECT_GT(fresh[0].area_facing + fresh[0].area_away, 0.0) << n;
  }
}

/// Nothing near decides nothing: a wall beside a plate, edge on.
TEST(Facing, edge_on_is_undecided) {
  Pair p;
  p.facets[0] = p.plate(4, 4, 0.0, 1.0, 0.0, true);
  p.facets[1] = p.wall(4, 4, 0.5, 0.02);
  const auto [a, b] = facing(p.input());
  EXPECT_TRUE(std::isnan(b.fraction()));
  EXPECT_DOUBLE_EQ(a.fraction(), 1.0);
}

/// Plates that touch have no line of sight: unlike normals pass, alike ones are an error, and nothing is guessed.
TEST(Facing, T31_plates_that_touch) {
  for (const bool good : {true, false}) {
    Pair p;
    p.facets[0] = p.plate(4, 4, 0.0, 1.0, 0.0, true);
    p.facets[1] = p.plate(4, 4, 0.0, 1.0, 0.0, !good);
    EXPECT_EQ(test::has(inspect(p.input()), "contact.normals_alike", 0), !good);
    EXPECT_EQ(orient(p.input()).ambiguous[0], !good);
    EXPECT_TRUE(orient(p.input()).flip[0].empty());
  }
}

/// Held nodes (TYPE5) are looked at like a surface.
TEST(Facing, T5_nodes_against_a_surface) {
  for (const bool right : {true, false}) {
    Pair p;
    (void)p.plate(5, 5, 0.1, 0.9, 0.01, true);
    for (Index n = 0; n < static_cast<Index>(p.x.size()); ++n) p.held.push_back(n);
    p.facets[1] = p.plate(6, 6, 0.0, 1.0, 0.0, right);
    EXPECT_EQ(test::has(inspect(p.input()), "contact.normals_away", 1), !right);
  }
}

/// Random orientation of every facet of two curved surfaces comes back to what it was.
TEST(Facing, orient_undoes_any_mixture) {
  Pair p;
  p.facets[0] = p.cylinder(1.0, 24, 5, false);
  p.facets[1] = p.cylinder(1.03, 31, 4, true);
  const auto good = p.facets;
  std::uint32_t state = 12345;
  for (auto& side : p.facets) {
    for (Facet& f : side) {
      state = state * 1664525u + 1013904223u;
      if (state >> 31) f = reversed(f);
    }
  }
  p.apply(orient(p.input()));
  Pair q = p;
  q.facets = good;
  const auto a = facing(p.input()), b = facing(q.input());
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(a[k].facet, b[k].facet);
    EXPECT_DOUBLE_EQ(a[k].fraction(), 1.0);
  }
  EXPECT_FALSE(test::has_errors(inspect(p.input())));
}

/// Boxes and discs leave out no nearest facet and none that hides: as by brute force over facets one by one, from the middle of a closed
/// surface (all are about equally far), beside and on it, also after it has moved.
TEST(Facing, nearest_and_hiding_facets_are_those_of_brute_force) {
  Pair p;
  p.facets[0] = p.box({-0.9, -1.0, -1.1}, {1.8, 2.0, 2.2}, 6, false);
  const auto blown_up = [&p](double turn) {
    for (Vec3& x : p.x) {
      x = x / norm(x);
      x = Vec3{x.x * std::cos(turn) - x.y * std::sin(turn), x.x * std::sin(turn) + x.y * std::cos(turn), x.z};
    }
  };
  blown_up(0.0);
  Shape shape(p.input().side[0], p.x);
  for (const double turn : {0.0, 0.4}) {
    if (turn > 0.0) {
      blown_up(turn);
      shape.move(p.input().side[0], p.x);
    }
    std::vector<Shape> single;
    for (const Facet& f : p.facets[0]) single.emplace_back(InspectedSide{std::span<const Facet>(&f, 1), {}, {}, {}}, p.x);
    int hidden = 0;
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(0.94, i % 50) * 1.6;
      const Vec3 from = size * Vec3{std::sin(1.7 * i), std::cos(2.9 * i), std::sin(0.3 * i + 1.0)};
      const Vec3 to = 0.7 * Vec3{std::cos(0.9 * i), std::sin(2.1 * i), std::cos(1.3 * i)};
      NearPoint best;
      bool hides = false;
      for (std::size_t f = 0; f < single.size(); ++f) {
        NearPoint found = single[f].nearest(from, 1e150);
        found.item = static_cast<Index>(f);
        if (found.squared < best.squared) best = found;
        hides = hides || single[f].hides(from, to, no_index);
      }
      const NearPoint found = shape.nearest(from, 1e150);
      ASSERT_EQ(found.item, best.item) << i;
      ASSERT_EQ(found.squared, best.squared);
      ASSERT_EQ(shape.hides(from, to, no_index), hides) << i;
      hidden += hides ? 1 : 0;
    }
    EXPECT_GT(hidden, 20);
    EXPECT_LT(hidden, 180);
  }
}

/// A guess makes the search for the nearest facet short and changes nothing, also where several are equally near.
TEST(Facing, guesses_change_no_answer) {
  Pair p;
  p.facets[0] = p.plate(8, 8, 0.0, 1.0, 0.0, true);
  p.facets[1] = p.plate(3, 3, 0.0, 1.0, 0.3, true);
  const Shape shape(p.input().side[0], p.x);
  int ties = 0;
  for (int i = -4; i <= 20; ++i) {
    for (int j = -4; j <= 20; ++j) {
      const Vec3 from{i / 16.0, j / 16.0, 0.01 * ((i * 7 + j * 3) % 5)};  // over corners, edges, centres, and outside
      for (const double radius : {0.05, 0.2, 1e150}) {
        const NearPoint alone = shape.nearest(from, radius);
        ties += i % 2 == 0 && alone.found() ? 1 : 0;
        for (Index guess = 0; guess < shape.count(); guess += 5) {
          const NearPoint guided = shape.nearest(from, radius, no_index, guess);
          ASSERT_EQ(guided.item, alone.item) << i << " " << j << " " << guess;
          ASSERT_EQ(guided.squared, alone.squared);
          ASSERT_EQ(guided.point, alone.point);
        }
      }
    }
  }
  EXPECT_GT(ties, 100);
}

}  // namespace
}  // namespace abut::contact
