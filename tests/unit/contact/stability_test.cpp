// The nodal stiffness that an interface hands over bounds the largest eigenvalue of its stiffness matrix: h <= sqrt(2 m/K) is stable
// (numerics.md 2.3, T12; issue 3, section 3).
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cstdio>
#include <random>

#include "unit/contact/bench_host.hpp"

namespace abut::contact {
namespace {

using test::grid;
using test::Host;
using test::set_stiffness;

// omega_max^2 by power iteration on M^-1 J, J the finite-difference Jacobian of -f; M symmetric scaling keeps it real.
double largest_eigenvalue(const std::function<std::vector<Vec3>(const std::vector<Vec3>&)>& force, const Host& host, double delta) {
  const std::size_t n = host.x.size() * 3;
  std::vector<double> j(n * n);
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<Vec3> plus = host.x, minus = host.x;
    plus[c / 3][static_cast<int>(c % 3)] += delta;
    minus[c / 3][static_cast<int>(c % 3)] -= delta;
    const auto fp = force(plus), fm = force(minus);
    for (std::size_t r = 0; r < n; ++r) {
      const int k = static_cast<int>(r % 3);
      j[r * n + c] = -(fp[r / 3][k] - fm[r / 3][k]) / (2 * delta) / std::sqrt(host.m[r / 3] * host.m[c / 3]);
    }
  }
  std::vector<double> x(n), y(n);
  std::mt19937 random(1);
  for (double& v : x) v = std::uniform_real_distribution<double>(-1, 1)(random);
  double value = 0.0;
  for (int it = 0; it < 3000; ++it) {
    double length = 0.0;
    for (std::size_t r = 0; r < n; ++r) {
      y[r] = 0.0;
      for (std::size_t c = 0; c < n; ++c) y[r] += j[r * n + c] * x[c];
      length += y[r] * y[r];
    }
    value = std::sqrt(length);
    if (value == 0.0) return 0.0;
    for (std::size_t r = 0; r < n; ++r) x[r] = y[r] / value;
  }
  return value;
}

TEST(Stability, nodal_stiffness_bounds_the_largest_eigenvalue) {
  double tightest = 1e300, loosest = 0.0;
  for (const double friction : {0.0, 0.3}) {
    for (const double gap : {0.0, 0.1}) {
      for (const double overlap : {0.01, 0.04, 0.08}) {
        for (const unsigned seed : {1u, 2u, 3u}) {
          Host host;
          std::mt19937 random(seed);
          std::uniform_real_distribution<double> u(0.0, 1.0);
          const auto rough = [&](double, double) { return 0.01 * (u(random) - 0.5); };
          const auto lower = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, rough);
          const auto upper = grid(
              host, 2, 2, -0.9, 1.0, -1.0, 0.9, [&](double x, double y) { return gap - overlap + rough(x, y); }, false, seed == 3);
          for (double& m : host.m) m = 0.5 + u(random);
          for (std::size_t i = 0; i < host.x.size(); ++i) host.v[i] = 1e-9 * Vec3{u(random), u(random), u(random)};
          Options o;
          o.gap = gap;
          o.friction = friction;
          std::vector<double> k1(lower.size()), k2(upper.size());
          for (double& k : k1) k = 1.0 + 3.0 * u(random);
          for (double& k : k2) k = 1.0 + 3.0 * u(random);
          const auto make = [&] {
            Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
            i.set_surface(0, {k1, {}, {}});
            i.set_surface(1, {k2, {}, {}});
            return i;
          };
          Interface base = make();
          host.dt = 1e-6;
          host.contact(base);
          const auto blob = base.history();
          ASSERT_GT(host.last.in_contact, 0);
          Host probe = host;
          Interface other = make();
          const auto force = [&](const std::vector<Vec3>& x) {
            other.restore(blob);
            probe.x = x;
            probe.contact(other);
            return probe.f;
          };
          const double exact = largest_eigenvalue(force, host, 1e-7);
          double bound = 0.0;
          for (std::size_t i = 0; i < host.x.size(); ++i) bound = std::max(bound, 2.0 * host.k[i] / host.m[i]);
          tightest = std::min(tightest, bound / exact);
          loosest = std::max(loosest, bound / exact);
          EXPECT_GE(bound, exact) << "gap " << gap << " overlap " << overlap << " friction " << friction << " seed " << seed;
        }
      }
    }
  }
  std::printf("  bound / exact omega^2: %.3f to %.3f\n", tightest, loosest);
}

// A node on its way is announced before it touches: its first contact does not find a step too long.
TEST(Stability, coming_contact_is_announced) {
  Host host;
  const auto facets = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, test::flat);
  const Index n = host.add({0, 0, 0.015}, 1.0, {0, 0, -1.0});
  Options o;
  o.gap = 0.01;
  Interface i = Interface::nodes_to_surface({n}, {1.0}, Surface(facets), o);
  set_stiffness(i, 1, facets.size(), 1.0);
  host.dt = 0.002;
  host.contact(i);
  EXPECT_EQ(host.k[static_cast<std::size_t>(n)], 0.0);
  host.dt = 0.008;
  host.contact(i);
  EXPECT_EQ(host.last.in_contact, 0);
  EXPECT_GT(host.k[static_cast<std::size_t>(n)], 0.1);
  EXPECT_NEAR(host.last.kinematic_step, 0.0075, 1e-15);
  // The reference's TYPE3 and TYPE5 never limit the step.
  o.rules = Rules::reference();
  Interface r = Interface::nodes_to_surface({n}, {1.0}, Surface(facets), o);
  set_stiffness(r, 1, facets.size(), 1.0);
  host.x[static_cast<std::size_t>(n)].z = -0.01;
  host.contact(r);
  EXPECT_EQ(host.last.in_contact, 1);
  EXPECT_EQ(host.k[static_cast<std::size_t>(n)], 0.0);
  EXPECT_EQ(host.last.kinematic_step, 1e30);
}

}  // namespace
}  // namespace abut::contact
