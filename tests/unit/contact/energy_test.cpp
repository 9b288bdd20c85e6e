// No energy from switching, edges, borders or changes of stiffness (issue 3, section 2).
#include <gtest/gtest.h>

#include <abut/contact/interface.hpp>
#include <cmath>
#include <cstdio>

#include "contact/enforce/law.hpp"
#include "unit/contact/energy_scenes.hpp"

namespace abut::contact {
namespace {

using test::Bounce;
using test::bounces;
using test::ClosedPathCase;
using test::plates_meet;

// T24: force = d potential/dP, tangent = d force/dP, both laws, at every P, also across the bend.
TEST(NormalLaw, force_and_tangent_are_derivatives) {
  for (const double gap : {0.0, 0.01, 3.0}) {
    const NormalLaw law{gap};
    const double scale = gap > 0.0 ? gap : 1.0;
    for (int i = 1; i <= 300; ++i) {
      const double p = 0.005 * i * scale;
      if (std::abs(p - 0.9 * gap) < 1e-4 * scale) continue;
      const double d = 1e-5 * scale;
      const double slope = (law.potential(p + d) - law.potential(p - d)) / (2 * d);
      EXPECT_NEAR(slope / law.force(p), 1.0, 3e-6) << gap << " " << p;
      const double tangent = (law.force(p + d) - law.force(p - d)) / (2 * d);
      EXPECT_NEAR(tangent / law.tangent(p), 1.0, 1e-6) << gap << " " << p;
    }
    EXPECT_EQ(law.force(0.0), 0.0);
    EXPECT_EQ(law.potential(-1.0), 0.0);
  }
  // Own logarithm against libm.
  const NormalLaw law{1.0};
  for (int i = 1; i <= 899; ++i) {
    const double u = 0.001 * i;
    const double exact = -u - std::log1p(-u);
    EXPECT_NEAR(law.potential(u) / exact, 1.0, 1e-14 / std::min(1.0, u)) << u;  // libm's sum cancels like 1/u
  }
}

// Issue 3, 2: contact that starts or ends inside a step makes no energy.
TEST(Switching, bounce_keeps_its_energy) {
  Rules plain_switch = Rules::standard();
  plain_switch.switch_correction = false;
  for (const double gap : {0.0, 0.1}) {
    for (const double hhk : {0.5, 0.35, 0.2, 0.05}) {
      for (const double free_mass : {0.0, 3.0}) {
        const Bounce with = bounces(Rules::standard(), gap, hhk, free_mass);
        const Bounce without = bounces(plain_switch, gap, hhk, free_mass);
        std::printf("  gap %.2f h2K/m %.2f facet mass %.0f: |CX| mean %.4f %% worst %.4f %%, without correction %.4f %% and %.4f %%\n", gap,
                    hhk, free_mass, 100 * with.mean, 100 * with.worst, 100 * without.mean, 100 * without.worst);
        EXPECT_LT(with.mean, gap > 0.0 ? 0.002 : 1e-7);
        EXPECT_LT(with.worst, 0.015);
      }
    }
  }
}

TEST(Switching, plates_keep_their_energy) {
  Rules plain_switch = Rules::standard();
  plain_switch.switch_correction = false;
  for (const double gap : {0.0, 0.1}) {
    for (const double hhk : {0.5, 0.2, 0.05}) {
      for (const double shift : {0.0, 0.37}) {
        const Bounce with = plates_meet(Rules::standard(), gap, hhk, shift);
        const Bounce without = plates_meet(plain_switch, gap, hhk, shift);
        std::printf("  gap %.2f h2K/m %.2f shift %.2f: |CX| mean %.4f %% worst %.4f %%, without correction %.4f %% and %.4f %%\n", gap, hhk,
                    shift, 100 * with.mean, 100 * with.worst, 100 * without.mean, 100 * without.worst);
        // 0.5 is beyond what the step rule allows here (four springs act on each relative motion); 0.2 is at its limit.
        EXPECT_LT(with.mean, hhk > 0.2 ? 0.007 : 0.002);
      }
    }
  }
}

TEST(ClosedPath, gives_its_work_back) {
  const std::vector<ClosedPathCase> cases = test::closed_path_cases();
  double worst = 0.0;
  for (const ClosedPathCase& c : cases) {
    for (const double gap : {0.0, 0.2}) {
      for (const double part : {0.1, 0.5, 0.9}) {
        if (gap == 0.0 && part != 0.1) continue;
        const double p = gap > 0.0 ? part * gap : 0.1;
        for (const Law law : {Law::stiffening, Law::constant}) {
          if (gap == 0.0 && law == Law::stiffening) continue;
          Rules standard = Rules::standard();
          standard.law = law;
          Rules plain = Rules::reference();
          plain.law = law;
          const double net = test::net_of_lap(c, standard, gap, p, 40000);
          const double theirs = test::net_of_lap(c, plain, gap, p, 5000);
          std::printf("  %-34s gap %.1f P %.2f %s: net/CE %.2e (plain %.2e)\n", c.name.c_str(), gap, p,
                      law == Law::constant ? "const" : "stiff", net, theirs);
          worst = std::max(worst, net);
          EXPECT_GT(net, 0.0) << c.name;  // it was in contact
          EXPECT_LE(net, 1e-3) << c.name;
        }
      }
    }
  }
  std::printf("  worst %.2e\n", worst);
}

// Over the border of a curved surface, where two strips that are equally near have faded differently.
TEST(ClosedPath, over_the_border_of_a_curved_surface) {
  double worst = 0.0;
  const std::vector<ClosedPathCase> cases = test::curved_border_cases();
  for (const ClosedPathCase& c : cases) {
    for (const double gap : {0.0, 0.2}) {
      for (const double p : {0.02, 0.1}) {
        Rules standard = Rules::standard();
        standard.law = gap > 0.0 ? Law::stiffening : Law::constant;
        const double net = test::net_of_lap(c, standard, gap, p, 40000);
        std::printf("  %-18s gap %.1f P %.2f: net/CE %.2e\n", c.name.c_str(), gap, p, net);
        worst = std::max(worst, net);
        EXPECT_GT(net, 0.0) << c.name;
        EXPECT_LE(net, 1e-3) << c.name;
      }
    }
  }
  std::printf("  worst %.2e\n", worst);
}

// The same for a patch of nodes with facets of its own, both passes.
TEST(ClosedPath, patch_gives_its_work_back) {
  const std::vector<ClosedPathCase> cases = test::closed_path_cases();
  double worst = 0.0;
  for (const ClosedPathCase& c : cases) {
    for (const Law law : {Law::stiffening, Law::constant}) {
      for (const double part : {0.3, 0.8}) {
        Rules standard = Rules::standard();
        standard.law = law;
        Rules plain = Rules::reference();
        plain.law = law;
        const double net = test::net_of_patch(c, standard, 0.2, 0.2 * part, 8000);
        const double theirs = test::net_of_patch(c, plain, 0.2, 0.2 * part, 1000);
        std::printf("  %-34s P %.2f Gap %s: net/CE %.2e (plain %.2e)\n", c.name.c_str(), part, law == Law::constant ? "const" : "stiff",
                    net, theirs);
        worst = std::max(worst, net);
        EXPECT_GT(net, 0.0) << c.name;
        EXPECT_LE(net, 1e-3) << c.name;
      }
    }
  }
  std::printf("  worst %.2e\n", worst);
}

// Random surfaces, places, depths and changes of stiffness: where a lap of 20000 steps keeps more than 1e-3, one of 16 times as many steps
// does not: a kink costs its force jump times the step, a jump of the energy would stay.
TEST(ClosedPathFull, random_laps_give_their_work_back) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  double worst = 0.0, finer = 0.0;
  int repeated = 0;
  for (int lap = 0; lap < 400; ++lap) {
    const double bend = 0.03 + 0.12 * u(random), angle = 10.0 + 80.0 * u(random);
    const std::vector<std::function<double(double, double)>> heights{
        [bend](double x, double y) { return bend * (x * x - y * y); },
        [bend](double x, double y) { return -bend * (x * x + y * y); },
        [bend](double x, double y) { return bend * (x * x + y * y); },
        [angle](double x, double) { return test::fold_height(x, angle, true); },
        [angle](double x, double) { return test::fold_height(x, angle, false); },
        [bend](double x, double y) { return bend * (std::sin(2 * x + 1.7 * y) + std::cos(2.3 * y - 1.1 * x)); }};
    const bool jump = u(random) < 0.5;
    const double gap = u(random) < 0.35 ? 0.0 : 0.2;
    const double p = gap > 0.0 ? gap * (0.1 + 0.8 * u(random)) : 0.02 + 0.13 * u(random);
    Rules rules = Rules::standard();
    rules.law = gap > 0.0 && u(random) < 0.5 ? Law::stiffening : Law::constant;
    const ClosedPathCase c{"",
                           heights[static_cast<std::size_t>(lap) % heights.size()],
                           jump,
                           4 * u(random) - 2,
                           4 * u(random) - 2,
                           0.6 + 0.8 * u(random),
                           0.6 + 0.8 * u(random)};
    double net = test::net_of_lap(c, rules, gap, p, 20000);
    worst = std::max(worst, net);
    if (net > 1e-3) {
      ++repeated;
      net = test::net_of_lap(c, rules, gap, p, 320000);
    }
    finer = std::max(finer, net);
    EXPECT_LE(net, 1e-3) << lap;
  }
  std::printf("  worst of 20000 steps %.2e; %d laps repeated with 320000, worst then %.2e\n", worst, repeated, finer);
}

}  // namespace
}  // namespace abut::contact
