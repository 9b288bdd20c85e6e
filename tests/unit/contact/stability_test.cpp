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

/// Kinematic limit of a plate of light nodes that moves along z over a plate at rest, at a depth P within the gap.
/// @param passes  2: TYPE3, the nodes of each plate against the other; 1: TYPE5
double kinematic_limit(int passes, const Options& o, double depth, double speed, double dt) {
  Host host;
  const auto lower = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, test::flat, true, false, 1.0);
  const auto first = static_cast<Index>(host.x.size());
  const double z = o.gap - depth;
  const auto upper = grid(
      host, 2, 2, -1.0, 0.9, -0.9, 1.0, [z](double, double) { return z; }, false, false, 1.0);
  std::vector<Index> nodes;
  for (auto n = first; n < static_cast<Index>(host.x.size()); ++n) {
    host.v[static_cast<std::size_t>(n)].z = -speed;
    nodes.push_back(n);
  }
  Interface i = passes == 2 ? Interface::two_surfaces(Surface(lower), Surface(upper), o)
                            : Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 1.0), Surface(lower), o);
  set_stiffness(i, passes == 2 ? 0 : 1, lower.size(), 1.0);
  if (passes == 2) set_stiffness(i, 1, upper.size(), 1.0);
  host.dt = dt;
  host.contact(i);
  EXPECT_EQ(host.last.in_contact > 0, depth > 0.0) << "depth " << depth;
  return host.last.kinematic_step;
}

// Inside the gap, P > 0: h <= (Gap - P)/2 over the closing speed, down to the bend of the law (0.9 Gap), where the tangent goes on and a
// tenth of the gap is always left.
TEST(Stability, kinematic_limit_is_half_the_way_that_is_left_in_the_gap) {
  Options o;
  o.gap = 0.01;
  for (const int passes : {1, 2}) {
    for (const double share : {0.05, 0.2, 0.5, 0.8, 0.89, 0.95, 1.2}) {
      for (const double speed : {0.3, 2.0}) {
        const double room = std::max((1.0 - share) * o.gap, 0.1 * o.gap);
        const double expected = 0.5 * room / speed;
        // A step of which the limit is less than twice: it is handed over.
        EXPECT_NEAR(kinematic_limit(passes, o, share * o.gap, speed, 0.9 * expected), expected, 1e-9 * expected)
            << "TYPE" << (passes == 2 ? 3 : 5) << ", P/Gap " << share << ", speed " << speed;
      }
    }
    EXPECT_EQ(kinematic_limit(passes, o, 0.5 * o.gap, -2.0, 1e-3), 1e30) << "it leaves: no limit";
    EXPECT_EQ(kinematic_limit(passes, o, 0.5 * o.gap, 0.0, 1e-3), 1e30) << "it rests: no limit";
    Options constant = o;
    constant.rules.law = Law::constant;
    EXPECT_EQ(kinematic_limit(passes, constant, 0.5 * o.gap, 2.0, 1e-3), 1e30) << "F = K P has no pole: no limit";
    Options reference = o;
    reference.rules = Rules::reference();
    EXPECT_EQ(kinematic_limit(passes, reference, 0.5 * o.gap, 2.0, 1e-3), 1e30) << "the reference's TYPE3 and TYPE5 never limit the step";
  }
}

/// Forces and nodal stiffness of several interfaces on one host.
struct Sum {
  std::vector<Vec3> f;
  std::vector<double> k;
  int touching = 0;
  double kinematic_step = 1e30;
};
Sum sum_of(Host& host, std::vector<Interface>& interfaces) {
  Sum s{std::vector<Vec3>(host.x.size()), std::vector<double>(host.x.size()), 0, 1e30};
  for (Interface& i : interfaces) {
    i.search(host.state());
    const StepResult r = i.evaluate(host.state(), s.f, s.k);
    s.touching += r.in_contact;
    s.kinematic_step = std::min(s.kinematic_step, r.kinematic_step);
    i.commit(host.dt);
  }
  return s;
}

// Bound over the exact largest omega^2 of everything that acts on the host; > 1 is safe.
double bound_over_exact(Host host, const std::function<std::vector<Interface>()>& make, double delta, int& touching) {
  std::vector<Interface> base = make();
  const Sum now = sum_of(host, base);
  touching = now.touching;
  const auto force = [&](const std::vector<Vec3>& x) {
    std::vector<Interface> fresh = make();
    for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i].restore(base[i].history());
    Host probe = host;
    probe.x = x;
    return sum_of(probe, fresh).f;
  };
  const double exact = largest_eigenvalue(force, host, delta);
  double bound = 0.0;
  for (std::size_t i = 0; i < host.x.size(); ++i) bound = std::max(bound, 2.0 * now.k[i] / host.m[i]);
  return bound / exact;
}

// TYPE7 at every penetration, flat and rough plates of free nodes.
TEST(Stability, type7_stiffness_bounds_the_largest_eigenvalue) {
  double tightest = 1e300, loosest = 0.0;
  for (const double share : {0.02, 0.3, 0.6, 0.9}) {
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      Host host;
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> u(0.0, 1.0);
      const double gap = 0.1, roughness = seed == 1 ? 0.0 : 0.1 * gap * (1 - share);
      const auto rough = [&](double, double) { return roughness * (u(random) - 0.5); };
      const auto lower = grid(host, 3, 3, -1.5, 1.5, -1.5, 1.5, rough, true, seed == 3);
      const auto first = static_cast<Index>(host.x.size());
      grid(
          host, 2, 2, -0.9, 1.0, -1.0, 0.9, [&](double x, double y) { return gap * (1 - share) + rough(x, y); }, false);
      std::vector<Index> nodes;
      for (Index n = first; n < static_cast<Index>(host.x.size()); ++n) nodes.push_back(n);
      for (double& m : host.m) m = 0.5 + u(random);
      host.dt = host.before = 1e-6;
      BothSidesOptions o;
      o.gap = gap;
      o.damping = 0.0;
      const auto make = [&] {
        std::vector<Interface> all;
        all.push_back(Interface::both_sides(nodes, Surface(lower), o));
        set_stiffness(all[0], 1, lower.size(), 2.0);
        return all;
      };
      int touching = 0;
      const double ratio = bound_over_exact(host, make, 1e-8, touching);
      ASSERT_GT(touching, 0);
      EXPECT_GE(ratio, 1.0) << share << " seed " << seed;
      tightest = std::min(tightest, ratio);
      loosest = std::max(loosest, ratio);
    }
  }
  std::printf("  TYPE7 bound / exact omega^2: %.3f to %.3f\n", tightest, loosest);
}

// The same nodes in a TYPE3, a TYPE5 and a TYPE7: the sum of what they hand over bounds what they do together.
TEST(Stability, nodes_shared_by_three_interfaces) {
  double tightest = 1e300;
  for (const unsigned seed : {1u, 2u, 3u}) {
    Host host;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    const auto rough = [&](double, double) { return 0.004 * (u(random) - 0.5); };
    const auto middle = grid(host, 2, 2, -1, 1, -1, 1, rough);
    const auto above = grid(
        host, 2, 2, -0.9, 1.1, -1, 0.9, [&](double x, double y) { return 0.06 + rough(x, y); }, false);
    const auto below = grid(host, 2, 2, -1.1, 0.9, -0.9, 1, [&](double x, double y) { return -0.05 + rough(x, y); });
    std::vector<Index> nodes;
    for (Index n = 0; n < 9; ++n) nodes.push_back(n);
    for (double& m : host.m) m = 0.5 + u(random);
    host.dt = host.before = 1e-6;
    Options o;
    o.gap = 0.1;
    BothSidesOptions both;
    both.gap = 0.1;
    both.damping = 0.0;
    const auto make = [&] {
      std::vector<Interface> all;
      all.push_back(Interface::two_surfaces(Surface(middle), Surface(above), o));
      all.push_back(Interface::nodes_to_surface(nodes, std::vector<double>(9, 2.0), Surface(below), o));
      all.push_back(Interface::both_sides(nodes, Surface(above), both));
      set_stiffness(all[0], 0, middle.size(), 1.5);
      set_stiffness(all[0], 1, above.size(), 1.0);
      set_stiffness(all[1], 1, below.size(), 3.0);
      set_stiffness(all[2], 1, above.size(), 0.2);
      return all;
    };
    int touching = 0;
    const double ratio = bound_over_exact(host, make, 1e-8, touching);
    EXPECT_GE(touching, 20);
    EXPECT_GE(ratio, 1.0) << seed;
    tightest = std::min(tightest, ratio);
  }
  std::printf("  three interfaces: bound / exact omega^2 from %.3f\n", tightest);
}

// Two free equal masses (a rigid facet, a node) pressed together and shaken, with the usual h = 0.9 sqrt(2 m/K) of the nodal sum and growth
// of 1.1: with any viscosity the motion relative to each other dies out (a step too long makes it grow until the gap is crossed or it
// chatters for ever).
TEST(Stability, dampers_are_in_the_step) {
  for (const double damping : {0.02, 0.2, 0.5, 1.0}) {
    for (const int kind : {5, 7, 77}) {  // 77: the reference program's share of dampers, c/h
      const bool two_sided = kind != 5;
      Host host;
      const auto facets = grid(host, 1, 1, -1, 1, -1, 1, test::flat, true, false, 0.25);
      const Index n = host.add({0, 0, 0.07}, 1.0, {two_sided ? 0.02 : 0.0, 0, -0.05});
      std::vector<Interface> all;
      if (two_sided) {
        BothSidesOptions o;
        o.gap = 0.1;
        o.damping = damping;
        o.friction = 5.0;  // far from the limit: the viscous branch
        o.friction_viscosity = 1.0;
        o.reference_step = kind == 77;
        o.switch_correction = kind != 77;
        all.push_back(Interface::both_sides({n}, Surface(facets), o));
        set_stiffness(all[0], 1, 1, 200.0);
      } else {
        Options o;
        o.gap = 0.1;
        o.rules.law = Law::constant;
        o.damping = damping;
        all.push_back(Interface::nodes_to_surface({n}, {1000.0}, Surface(facets), o));
        set_stiffness(all[0], 1, 1, 1000.0);
      }
      const double press = 3.0;
      double largest = 0.0;
      constexpr int steps = 4000;
      for (int step = 0; step < steps; ++step) {
        Sum s = sum_of(host, all);
        double h = 0.2;
        for (std::size_t i = 0; i < host.x.size(); ++i) {
          if (s.k[i] > 0.0) h = std::min(h, 0.9 * std::sqrt(2.0 * host.m[i] / s.k[i]));
        }
        h = std::min(h, s.kinematic_step);
        if (host.dt > 0.0) h = std::min(h, 1.1 * host.dt);
        s.f[4].z -= press;
        Vec3 on_facet{0, 0, press};
        for (std::size_t i = 0; i < 4; ++i) on_facet += s.f[i];
        for (std::size_t i = 0; i < 4; ++i) s.f[i] = 0.25 * on_facet;
        const double bar = 0.5 * (host.dt + h);
        Vec3 mean{};
        for (std::size_t i = 0; i < host.x.size(); ++i) {
          host.v[i] += (bar / host.m[i]) * s.f[i];
          host.x[i] += h * host.v[i];
          if (i < 4) mean += 0.25 * host.v[i];
        }
        host.before = host.dt;
        host.dt = h;
        const Vec3 relative = host.v[4] - mean;
        if (step > steps - 100) largest = std::max(largest, two_sided ? norm(relative) : std::abs(relative.z));
      }
      if (kind == 77) {
        if (damping == 1.0) { EXPECT_GT(largest, 1.0); }  // why abut has its own share
      } else {
        EXPECT_LT(largest, 1e-3 * 0.05) << damping << " TYPE" << kind;
      }
    }
  }
}

}  // namespace
}  // namespace abut::contact
