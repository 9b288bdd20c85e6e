// Ordinary held nodes: the packed kernel says what the general way says, to rounding, and the same bits at every width and in any company.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

#include "contact/enforce/account.hpp"
#include "contact/enforce/friction.hpp"
#include "contact/enforce/held_formulas.hpp"
#include "contact/enforce/pair.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::Host;

/// Along which a node in front of a facet is held.
Vec3 direction(const Patch& patch, const ClosestPoint& c, const Vec3& x) {
  return c.feature == Feature::face ? normal_at(patch, c.s, c.t) : normalized(x - c.point);
}

/// Random nodes over random warped facets, all moving, with a history of friction.
struct Lanes {
  std::vector<Vec3> held_x, surface_x, v;
  HeldRules rules;
  std::unique_ptr<HeldBatch> batch = std::make_unique<HeldBatch>();

  explicit Lanes(unsigned seed, double gap = 0.3) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    rules = {gap, 0.2, 0.1, 0.3, std::sqrt(1.09), 1e-3, 1.1e-3, 1.2e-3, 1e-12, 2.0, gap > 0.0, true, true};
    constexpr std::array<std::array<double, 2>, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    HeldBatch& b = *batch;
    b.count = HeldBatch::size;
    for (int k = 0; k < HeldBatch::size; ++k) {
      held_x.push_back({1.3 * u(random), 1.3 * u(random), 0.2 * u(random)});
      v.push_back({u(random), u(random), u(random)});
      b.node[k] = b.node_v[k] = 3 * k;
      b.mass[4][k] = 1.0 + 0.5 * u(random);
      b.node_stiffness[k] = 2.0 + u(random);
      // Every third facet has free borders; over the flat part of their strips a node is as over the inside.
      const std::uint8_t sides = borders(k);
      b.reach[k] = sides != 0 ? (1.0 + 2.0 * border_strip) * (1.0 + 2.0 * border_strip) : 1.0;
      for (int side = 0; side < 4; ++side) b.end[side][k] = (sides >> side & 1) != 0 ? 1.0 + 2.0 * border_flat * border_strip : 1.0;
      b.rate_before[k] = u(random);
      b.acceleration_before[k] = u(random);
      b.tangential_stiffness_before[k] = 0.1;
      b.force_before[k] = 0.5 + 0.5 * u(random);
      b.stored_before[k] = 0.1 + 0.1 * u(random);
      b.made_before[k] = 0.1 * u(random);
      b.reckoned[k] = k % 4 != 0 ? 1.0 : 0.0;
      for (auto& component : b.push_before) component[k] = u(random);
      double sum = 0.0;
      for (int c = 0; c < 4; ++c) {
        const auto& at = square[static_cast<std::size_t>(c)];
        surface_x.push_back({at[0] + 0.2 * u(random), at[1] + 0.2 * u(random), 0.2 * u(random)});
        b.corner[c][k] = 3 * (4 * k + c);
        b.corner_v[c][k] = 3 * (HeldBatch::size + 4 * k + c);
        b.mass[c][k] = k % 5 == 0 ? 0.0 : 2.0 + u(random);
        b.corner_stiffness[c][k] = k % 3 == 0 ? 1.0 : 1.0 + 0.4 * u(random);
        b.anchor[c][k] = c < 3 ? 0.25 + 0.05 * u(random) : 1.0 - sum;
        sum += b.anchor[c][k];
        b.last[c][k] = b.anchor[c][k];
      }
      const Vec3 normal = normalized({0.1 * u(random), 0.1 * u(random), 1.0});
      const Vec3 across = cross(normal, Vec3{u(random), u(random), u(random)});
      for (int c = 0; c < 3; ++c) {
        b.slip_normal_before[c][k] = normal[c];
        b.slip_before[c][k] = 0.1 * across[c];
      }
      // A few lanes' normals have turned too far for them to be ordinary.
      const Patch facet{{corner(k, 0), corner(k, 1), corner(k, 2), corner(k, 3)}, false, sides, border_strip};
      const ClosestPoint c = closest_point(facet, held_x.back());
      const double turned = k % 8 == 7 ? 0.1 : 0.01;
      const Vec3 last = normalized(direction(facet, c, held_x.back()) + turned * Vec3{u(random), u(random), u(random)});
      for (int i = 0; i < 3; ++i) b.normal_before[i][k] = last[i];
    }
    for (int k = 0; k < 4 * HeldBatch::size; ++k) v.push_back({u(random), u(random), u(random)});
    b.held_x = &held_x.data()->x;
    b.surface_x = &surface_x.data()->x;
    b.v = &v.data()->x;
  }
  [[nodiscard]] static std::uint8_t borders(int k) { return k % 3 == 1 ? static_cast<std::uint8_t>(k % 15) : 0; }
  [[nodiscard]] Vec3 corner(int k, int c) const { return surface_x[static_cast<std::size_t>(4 * k + c)]; }
};

using Column = std::vector<double>;

/// All results of a lane; those of one that is not ordinary are not told.
Column results(const HeldBatch& b, int k) {
  if (b.ordinary[k] == 0.0) return {0.0};
  Column all{1.0,
             b.squared_distance[k],
             b.distance[k],
             b.penetration[k],
             b.force[k],
             b.potential[k],
             b.stiffness[k],
             b.step_stiffness[k],
             b.rate[k],
             b.acceleration[k],
             b.approach[k],
             b.kinematic_step[k],
             b.tangential_stiffness[k],
             b.stick[k],
             b.dissipated[k],
             b.slips[k],
             b.made[k],
             b.stepped[k],
             b.light[k]};
  for (int c = 0; c < 3; ++c) {
    for (const double value : {b.normal[c][k], b.on_node[c][k], b.slip[c][k], b.slip_normal[c][k], b.on_surface[c][k]})
      all.push_back(value);
    for (int i = 0; i < 4; ++i) all.push_back(b.on_corner[i][c][k]);
  }
  for (int i = 0; i < 4; ++i) all.push_back(b.weight[i][k]);
  return all;
}

bool same_bits(const Column& a, const Column& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

template <class T>
void run(const HeldRules& rules, HeldBatch& b) {
  for (int k = 0; k < b.count; k += simd::NumberTraits<T>::width) held::ordinary_nodes<T>(rules, b, k);
}

TEST(HeldKernel, has_the_same_bits_at_every_width) {
  int ordinary = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double gap = seed % 4 == 0 ? 0.0 : 0.3;
    const Lanes scalar(seed, gap), two(seed, gap), active(seed, gap);
    run<double>(scalar.rules, *scalar.batch);
    run<simd::Pack<2>>(two.rules, *two.batch);
    held_kernel()(active.rules, *active.batch);
    for (int k = 0; k < HeldBatch::size; ++k) {
      const Column truth = results(*scalar.batch, k);
      ordinary += truth.size() > 1 ? 1 : 0;
      ASSERT_TRUE(same_bits(truth, results(*two.batch, k))) << "seed " << seed << " lane " << k;
      ASSERT_TRUE(same_bits(truth, results(*active.batch, k))) << "seed " << seed << " lane " << k;
    }
  }
  EXPECT_GT(ordinary, 200);
}

// Lane k computed beside copies of every other lane gives what it gave before: nobody sees the neighbours.
TEST(HeldKernel, does_not_see_its_neighbours) {
  const Lanes all(7);
  held_kernel()(all.rules, *all.batch);
  for (int shift = 1; shift < 8; ++shift) {
    Lanes turned(7);
    HeldBatch& b = *turned.batch;
    const auto rotate = [shift](auto& values) { std::rotate(std::begin(values), std::begin(values) + shift, std::end(values)); };
    for (auto* one : {&b.node_stiffness, &b.reach, &b.rate_before, &b.acceleration_before, &b.tangential_stiffness_before, &b.force_before,
                      &b.stored_before, &b.made_before, &b.reckoned}) {
      rotate(*one);
    }
    for (auto* one : {&b.node, &b.node_v}) rotate(*one);
    for (int c = 0; c < 4; ++c) {
      rotate(b.corner[c]);
      rotate(b.corner_v[c]);
      rotate(b.corner_stiffness[c]);
      rotate(b.anchor[c]);
      rotate(b.last[c]);
      rotate(b.end[c]);
    }
    for (auto& mass : b.mass) rotate(mass);
    for (int c = 0; c < 3; ++c) {
      rotate(b.slip_before[c]);
      rotate(b.slip_normal_before[c]);
      rotate(b.push_before[c]);
      rotate(b.normal_before[c]);
    }
    held_kernel()(turned.rules, b);
    for (int k = 0; k + shift < HeldBatch::size; ++k)
      ASSERT_TRUE(same_bits(results(*all.batch, k + shift), results(b, k))) << shift << ", " << k;
  }
}

// Projection, weights and normal are those of closest_point(); forces of a node and its facet have no sum and no moment; friction is
// that of slip().
TEST(HeldKernel, is_the_general_way_to_rounding) {
  int ordinary = 0, slides = 0, over_strips = 0, over_edges = 0, over_corners = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Lanes lanes(seed);
    held_kernel()(lanes.rules, *lanes.batch);
    const HeldBatch& b = *lanes.batch;
    for (int k = 0; k < HeldBatch::size; ++k) {
      if (b.ordinary[k] == 0.0) continue;
      ++ordinary;
      const Patch patch{
          {lanes.corner(k, 0), lanes.corner(k, 1), lanes.corner(k, 2), lanes.corner(k, 3)}, false, Lanes::borders(k), border_strip};
      const Vec3 x = lanes.held_x[static_cast<std::size_t>(k)];
      const ClosestPoint c = closest_point(patch, x);
      over_edges += c.feature == Feature::edge ? 1 : 0;
      over_corners += c.feature == Feature::corner ? 1 : 0;
      ASSERT_FALSE(c.beyond);
      ASSERT_EQ(taper(patch, c.s, c.t).value, 1.0);
      const bool over_strip = std::max(std::abs(c.s), std::abs(c.t)) > 1.0;
      over_strips += over_strip ? 1 : 0;
      EXPECT_NEAR(c.squared_distance, b.squared_distance[k], 1e-14);
      const Vec3 n = direction(patch, c, x), r = x - c.point;
      const NormalLaw law{lanes.rules.gap};
      const double p = lanes.rules.gap - dot(n, r);
      Vec3 sum{b.on_node[0][k], b.on_node[1][k], b.on_node[2][k]};
      const Vec3 on_node = sum;
      Vec3 moment{};
      const FrictionCouple couple = friction_couple(patch, c, x, {b.on_surface[0][k], b.on_surface[1][k], b.on_surface[2][k]});
      EXPECT_NEAR(b.couple_stiffness[4][k], b.tangential_stiffness[k] * couple.node_share, 1e-12 * b.tangential_stiffness[k]);
      double k1 = 0.0, softest = 1e300, stiffest = 0.0, spread = 0.0;
      for (int i = 0; i < 4; ++i) {
        const auto corner = static_cast<std::size_t>(i);
        EXPECT_NEAR(c.weight[corner], b.weight[i][k], 1e-12);
        const Vec3 f{b.on_corner[i][0][k], b.on_corner[i][1][k], b.on_corner[i][2][k]};
        sum += f;
        moment += cross(patch.x[corner] - x, f - couple.on_facet[corner]);
        EXPECT_NEAR(b.couple_stiffness[i][k], b.tangential_stiffness[k] * couple.corner_share[corner], 1e-12 * b.tangential_stiffness[k]);
        k1 += c.weight[corner] * b.corner_stiffness[i][k];
        softest = std::min(softest, b.corner_stiffness[i][k]);
        stiffest = std::max(stiffest, b.corner_stiffness[i][k]);
        spread += std::abs(c.weight[corner]);
      }
      const bool clipped = k1 < softest || k1 > stiffest;
      k1 = std::clamp(k1, softest, stiffest);
      const double kappa = 0.2 * k1 * b.node_stiffness[k] / (k1 + b.node_stiffness[k]);
      EXPECT_NEAR(b.penetration[k], p, 1e-13);
      constexpr double rounding = 1e-15;  // of P, the difference of gap and distance
      EXPECT_NEAR(b.force[k], kappa * law.force(p), 1e-12 * b.force[k] + rounding * kappa);
      EXPECT_NEAR(b.stiffness[k], kappa, 1e-12 * kappa);
      EXPECT_NEAR(b.potential[k], kappa * law.potential(p), 1e-12 * b.potential[k] + rounding * b.force[k]);
      EXPECT_LT(norm(sum), 1e-14 * norm(on_node));
      EXPECT_LT(norm(moment), 1e-14 * (1.0 + norm(on_node)));
      EXPECT_GE(dot(on_node, n), 0.999 * b.force[k]);
      if (clipped) {  // no gradient of stiffness: the step's stiffness is the law's, in the share of what weights that extrapolate may add
        const double reached = p + step_growth * lanes.rules.step * std::max(-b.rate[k], 0.0);
        EXPECT_NEAR(b.step_stiffness[k], 0.5 * (1.0 + spread) * lanes.rules.step_factor * kappa * law.tangent(reached),
                    1e-12 * b.step_stiffness[k]);
      }
      // The account: trapezoidal work over the last step, the change of the potential, and what the changed step made.
      const auto over = [&](const double(&weight)[4][HeldBatch::size]) {
        Vec3 v = lanes.v[static_cast<std::size_t>(k)];
        for (int i = 0; i < 4; ++i) v -= weight[i][k] * lanes.v[static_cast<std::size_t>(HeldBatch::size + 4 * k + i)];
        return v;
      };
      const double step = lanes.rules.step;
      const Vec3 last{b.normal_before[0][k], b.normal_before[1][k], b.normal_before[2][k]};
      EXPECT_GT(dot(last, n), 0.999);
      const double rate = dot(over(b.weight), last);
      const double stepped = made_by_changing_step(b.force_before[k], lanes.rules.step_before, step, b.rate_before[k], rate);
      const Vec3 push{b.push_before[0][k], b.push_before[1][k], b.push_before[2][k]};
      const double made = b.made_before[k] - b.stored_before[k] + 0.5 * step * dot(push, over(b.last)) + stepped +
                          0.5 * step * dot(on_node, over(b.weight)) + b.potential[k];
      EXPECT_NEAR(b.stepped[k], stepped, 1e-15);
      EXPECT_NEAR(b.made[k], b.reckoned[k] != 0.0 ? made : 0.0, 1e-14);
      const double limit = lanes.rules.friction * b.force[k];
      const Vec3 rubs{b.on_surface[0][k], b.on_surface[1][k], b.on_surface[2][k]};
      EXPECT_LE(norm(rubs), limit * (1.0 + 1e-14));
      EXPECT_LT(std::abs(dot(rubs, n)), 1e-14);
      EXPECT_GE(b.dissipated[k], 0.0);
      EXPECT_EQ(b.slips[k] != 0.0, norm(rubs) >= (1.0 - 1e-9) * limit);
      slides += b.slips[k] != 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(ordinary, 300);
  EXPECT_GT(over_strips, 5);
  EXPECT_GT(over_edges, 50);
  EXPECT_GT(over_corners, 20);
  EXPECT_GT(slides, 20);
  EXPECT_LT(slides, ordinary);
}

/// Two bodies on rails, which press, slide, turn and cross facets: the forces and stiffness of each step by batches, or node by node
/// (a shear limit that is never reached makes it go the general way).
struct Rails {
  std::vector<std::vector<Vec3>> path;
  StepResult last;
  double largest = 0.0;

  using Height = double (*)(double, double);
  Rails(bool batches, int lower_facets, std::array<double, 4> upper_sides, int upper_facets, Height lower_height, Height upper_height,
        bool evenly_stiff, double speed) {
    Host host;
    const auto lower = test::grid(host, lower_facets, 8, -2, 2, -2, 2, lower_height);
    const std::size_t first = host.x.size();
    const auto [x0, x1, y0, y1] = upper_sides;
    const auto upper = test::grid(host, upper_facets, upper_facets, x0, x1, y0, y1, upper_height, false, false, 1.0);
    Options o;
    o.gap = 0.1;
    o.friction = 0.25;
    if (!batches) o.shear_limit = 1e28;
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
    std::vector<double> k0(lower.size(), 1000.0), k1(upper.size(), 800.0);
    for (std::size_t f = 0; f < k0.size() && !evenly_stiff; ++f) k0[f] = 900.0 + 40.0 * static_cast<double>(f % 7);
    for (std::size_t f = 0; f < k1.size() && !evenly_stiff; ++f) k1[f] = 700.0 + 60.0 * static_cast<double>(f % 5);
    i.set_surface(0, {k0, {}, {}});
    i.set_surface(1, {k1, {}, {}});
    // The paths of the two ways cannot drift apart, forces are compared in each step.
    std::vector<Vec3> x = host.x;
    for (int s = 0; s < 600; ++s) {
      for (std::size_t n = first; n < x.size(); ++n) {
        const Vec3 at = host.x[n];
        x[n] = at + Vec3{speed * (2.0 - at.y), speed * at.x, -0.03 * (std::sin(0.02 * (s + 1)) - std::sin(0.02 * s))};
      }
      host.place(i, x, s % 3 == 0 ? 1e-3 : 1.2e-3);  // accounts count what a changing step makes
      path.push_back(host.f);
      path.emplace_back();
      for (const double k : host.k) path.back().push_back({k, 0.0, 0.0});
      for (const Vec3& f : host.f) largest = std::max(largest, norm(f));
    }
    last = host.last;
  }
};

void expect_the_same(const Rails& batches, const Rails& general) {
  for (std::size_t s = 0; s < batches.path.size(); ++s) {
    for (std::size_t n = 0; n < batches.path[s].size(); ++n)
      ASSERT_LT(norm(batches.path[s][n] - general.path[s][n]), 1e-10 * general.largest) << s << ", " << n;
  }
  EXPECT_GT(batches.last.friction_work, 0.0);
  EXPECT_NEAR(batches.last.friction_work, general.last.friction_work, 1e-10 * general.last.friction_work);
  EXPECT_NEAR(batches.last.made, general.last.made, 1e-10 * general.last.friction_work);
}

TEST(HeldKernel, whole_interfaces_agree_with_the_general_way) {
  const auto run = [](bool batches) {
    return Rails(
        batches, 9, {-1.03, 1.01, -1.02, 0.97}, 5, [](double x, double y) { return 0.05 * x * x - 0.03 * x * y; },
        [](double x, double y) { return 0.11 + 0.05 * x * x - 0.03 * x * y + 0.01 * y * y; }, false, 1e-3);
  };
  expect_the_same(run(true), run(false));
}

// Nodes over nodes: over edges and corners where the surface is convex, and the same point seen from up to four facets where it is flat.
TEST(HeldKernel, whole_interfaces_agree_where_meshes_match) {
  const auto run = [](bool batches, Rails::Height lower, Rails::Height upper) {
    return Rails(batches, 8, {-1.0, 1.0, -1.0, 1.0}, 4, lower, upper, true, 1e-5);
  };
  const Rails::Height flat = [](double, double) { return 0.0; }, above = [](double, double) { return 0.11; };
  expect_the_same(run(true, flat, above), run(false, flat, above));
  const Rails::Height round = [](double x, double y) { return -0.04 * x * x - 0.02 * y * y; };
  const Rails::Height below = [](double x, double y) { return 0.11 - 0.03 * x * x - 0.01 * y * y; };
  expect_the_same(run(true, round, below), run(false, round, below));
}

}  // namespace
}  // namespace abut::contact
