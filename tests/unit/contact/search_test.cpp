// The search against brute force, and the swept test (T9; issue 3, section 1).
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "contact/search/incremental.hpp"
#include "contact/search/nearest.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

// Truth of a free node, word for word: the smallest |distance| over all faces, edges and corners.
Measure brute_force(const Side& surface, const Vec3& x) {
  Measure best;
  double smallest = 1e300;
  for (Index f = 0; f < surface.facet_count(); ++f) {
    const ClosestPoint c = closest_point(surface.patch(f), x);
    if (c.squared_distance < smallest) {
      smallest = c.squared_distance;
      best = signed_measure(surface, f, c, x);
    }
  }
  return best;
}

Vec3 rotate(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (dot(axis, v) * (1 - c)) * axis;
}

TEST(Search, equals_brute_force) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const std::vector<std::pair<const char*, std::function<double(double, double)>>> shapes{
      {"flat", [](double, double) { return 0.0; }},
      {"cylinder", [](double x, double) { return 1.0 - std::sqrt(std::max(0.0, 1.2 - x * x)); }},
      {"sphere", [](double x, double y) { return 2.0 - std::sqrt(std::max(0.0, 2.5 - x * x - y * y)); }},
      {"saddle", [](double x, double y) { return 0.3 * (x * x - y * y); }},
      {"folded", [](double x, double y) { return 0.4 * std::abs(std::sin(4 * x)) + 0.2 * std::abs(y); }},
      {"rough", [](double x, double y) { return 0.05 * std::sin(31 * x + 17 * y) + 0.04 * std::cos(23 * y - 11 * x); }}};
  long node_steps = 0, wrong = 0;
  for (const auto& [name, height] : shapes) {
    for (const bool triangles : {false, true}) {
      for (const int ratio : {1, 10}) {
        Host host;
        const auto main = grid(host, 12 / ratio + 1, 10 / ratio + 1, -1, 1, -1, 1, height, true, triangles);
        const std::size_t first_held = host.x.size();
        for (int i = 0; i < 60; ++i) {
          const double x = 2.2 * u(random) - 1.1, y = 2.2 * u(random) - 1.1;
          host.add({x, y, height(x, y) + 0.3 * (u(random) - 0.5)}, 1.0);
        }
        std::vector<Index> nodes;
        for (std::size_t i = first_held; i < host.x.size(); ++i) nodes.push_back(static_cast<Index>(i));
        Side surface(Surface(main), true);
        surface.set({}, false);
        Side held(nodes, std::vector<double>(nodes.size(), 1.0));
        Candidates lists;
        const Vec3 axis = normalized({0.3, 0.5, 0.8});
        const double reach = 0.3;
        for (int step = 0; step < 30; ++step) {
          // Both bodies tumble, slide over several facets, and shake; some steps are large.
          const double turn = step % 7 == 0 ? 0.9 : 0.01;
          const Vec3 slide{step % 5 == 0 ? 0.4 : 0.003, -0.002, 0.001};
          for (std::size_t i = 0; i < host.x.size(); ++i) {
            host.x[i] = rotate(host.x[i], axis, turn) + Vec3{0.05, 0.02, -0.01};
            if (i >= first_held)
              host.x[i] += (step % 10 < 5 ? 1.0 : -1.0) * slide + 0.004 * Vec3{u(random) - 0.5, u(random) - 0.5, u(random) - 0.5};
          }
          surface.gather(host.x);
          held.gather(host.x);
          lists.update(
              held, surface, [reach](Index) { return reach; }, 0.08, false);
          for (Index i = 0; i < held.node_count(); ++i) {
            const Vec3 x = held.x()[at(i)];
            const Measure truth = brute_force(surface, x);
            const Measure found = nearest(surface, lists, i, x, {});
            ++node_steps;
            if (std::abs(truth.distance) > reach) continue;
            if (!found.found() || found.distance != truth.distance || found.normal != truth.normal) {
              // The same distance from another facet (a shared edge) is the same answer to rounding.
              const bool same = found.found() && std::abs(found.distance - truth.distance) < 1e-13 &&
                                norm(found.closest.point - truth.closest.point) < 1e-7;
              if (!same) ++wrong;
            }
          }
        }
      }
    }
  }
  std::printf("  %ld node-steps, %ld differ\n", node_steps, wrong);
  EXPECT_EQ(wrong, 0);
}

// The plain rule's search: never further from the truth than the exact nearest node.
TEST(Search, incremental_finds_the_nearest_node) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Host host;
  const auto main = grid(host, 15, 13, -1, 1, -1, 1, [](double x, double y) { return 0.2 * std::sin(6 * x) * std::cos(5 * y); });
  const std::size_t first = host.x.size();
  std::vector<Index> nodes;
  for (int i = 0; i < 50; ++i) nodes.push_back(host.add({u(random) * 2 - 1, u(random) * 2 - 1, 0.1}, 1.0));
  Side surface(Surface(main), false);
  surface.set({}, false);
  Side held(nodes, std::vector<double>(nodes.size(), 1.0));
  surface.gather(host.x);
  held.gather(host.x);
  IncrementalSearch search;
  std::vector<Tracked> tracked;
  search.start(held, surface, tracked);
  for (int step = 0; step < 40; ++step) {
    for (std::size_t i = first; i < host.x.size(); ++i) host.x[i] = {u(random) * 2 - 1, u(random) * 2 - 1, 0.2 * (u(random) - 0.5)};
    held.gather(host.x);
    search.update(held, surface, tracked, 0.0);
    for (Index i = 0; i < held.node_count(); ++i) {
      double best = 1e300;
      for (const Vec3& s : surface.x()) best = std::min(best, squared_norm(s - held.x()[at(i)]));
      EXPECT_EQ(squared_norm(surface.x()[at(tracked[at(i)].node)] - held.x()[at(i)]), best);
    }
  }
}

// T29: a node that would jump through in one step is caught, pushed back, and ends in front; its energy is kept.
struct Shots {
  int count = 0, caught = 0, behind = 0;
  double worst = 0.0;
};

Shots shoot(double curvature, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Shots result;
  Host plate;
  const auto height = [curvature](double x, double y) { return curvature * (x * x + y * y); };
  const auto main = grid(plate, 40, 40, -20, 20, -20, 20, height);
  for (const double gap : {0.0, 2e-3}) {
    for (int shot = 0; shot < count; ++shot) {
      Host host = plate;
      const double h = 1.0;
      const double per_step = gap > 0.0 ? gap * std::pow(10.0, 3.0 * u(random)) : std::pow(10.0, -3.0 + 3.3 * u(random));
      const Vec3 aim{2 * u(random) - 1, 2 * u(random) - 1, 0};
      const Vec3 direction = normalized({u(random) - 0.5, u(random) - 0.5, -1.0});
      const Vec3 start = aim - (1.0 + u(random)) * per_step * direction;
      const Index n = host.add({start.x, start.y, start.z + height(start.x, start.y) + gap + 0.05}, 1.0, (per_step / h) * direction);
      Options o;
      o.gap = gap;
      o.stiffness_scale = 1.0;
      // The host's step is stable for the stiffest part of the law: h^2 k / m = 0.2 there.
      const double k = gap > 0.0 ? 0.002 : 0.2;
      Interface i = Interface::nodes_to_surface({n}, {2.0 * k}, Surface(main), o);
      set_stiffness(i, 1, main.size(), 2.0 * k);
      bool touched = false, left = false;
      for (int step = 0; step < 4000 && !left; ++step) {
        host.step(i, h);
        result.caught += host.last.crossed;
        touched = touched || host.last.in_contact > 0;
        left = touched && host.last.in_contact == 0;
      }
      const Vec3 end = host.x[static_cast<std::size_t>(n)];
      const Vec3 speed = host.v[static_cast<std::size_t>(n)];
      if (!left || end.z < height(end.x, end.y) - 0.1 * curvature || speed.z <= 0.0) ++result.behind;
      result.worst = std::max(result.worst, std::abs(host.last.made) / (0.5 * per_step * per_step / (h * h)));
      ++result.count;
    }
  }
  return result;
}

// T29: a node that would jump through in one step is caught, pushed back, ends in front, and keeps its energy.
TEST(Swept, fast_projectiles_end_in_front) {
  const Shots flat = shoot(0.0, 200, 21);
  const Shots curved = shoot(0.01, 200, 22);
  std::printf("  flat: %d shots, %d caught by the swept test, %d behind, worst |CX| %.3f %% of the kinetic energy\n", flat.count,
              flat.caught, flat.behind, 100 * flat.worst);
  std::printf("  curved: %d shots, %d caught, %d behind, worst |CX| %.3f %%\n", curved.count, curved.caught, curved.behind,
              100 * curved.worst);
  EXPECT_EQ(flat.behind, 0);
  EXPECT_EQ(curved.behind, 0);
  EXPECT_GT(flat.caught, 0);
  EXPECT_GT(curved.caught, 0);
  EXPECT_LT(flat.worst, 0.01);
}

}  // namespace
}  // namespace abut::contact
