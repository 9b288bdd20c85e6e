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

// With every spring counted twice, as where meshes face: 0.08 to 3.2 % in the mean.
TEST(Switching, unlike_meshes_keep_their_energy) {
  for (const double gap : {0.0, 0.1}) {
    for (const double hhk : {0.5, 0.2}) {
      for (const int facets : {1, 3}) {
        const Bounce b = test::on_a_large_facet(gap, hhk, facets);
        std::printf("  gap %.2f h2K/m %.2f, %d by %d facets: |CX| mean %.4f %% worst %.4f %%\n", gap, hhk, facets, facets, 100 * b.mean,
                    100 * b.worst);
        EXPECT_LT(b.mean, gap > 0.0 ? 0.001 : 1e-6);
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

// What a lap over folds keeps is what trapezoidal work misses of a force that jumps: at most |df . dx|/2 in the step over the fold, so it
// falls with the step of the path. A jump of the stored energy would be beyond that bound and would stay.
struct Laps {
  double worst = 0.0, of_bound = 0.0;  ///< largest net work over CE, and over the bound
};
Laps walk_all(const std::vector<test::RandomLap>& laps, int steps) {
  Laps all;
  for (const test::RandomLap& lap : laps) {
    const test::Path path = test::walk(lap.path, lap.rules, lap.gap, lap.p, steps);
    if (path.largest <= 0.0) continue;
    all.worst = std::max(all.worst, path.net / path.largest);
    all.of_bound = std::max(all.of_bound, path.net / path.bound);
  }
  return all;
}

TEST(ClosedPath, what_folds_keep_falls_with_the_step) {
  const std::vector<test::RandomLap> laps = test::random_laps(60);
  const Laps coarse = walk_all(laps, 500), fine = walk_all(laps, 8000);
  std::printf("  worst of 500 steps %.1e (%.2f of the bound), of 8000 %.1e (%.2f)\n", coarse.worst, coarse.of_bound, fine.worst,
              fine.of_bound);
  EXPECT_LE(coarse.of_bound, 1.0);
  EXPECT_LE(fine.of_bound, 1.0);
  EXPECT_LE(fine.worst, coarse.worst / 8.0);
}

// Where a lap of 20000 steps keeps more than 1e-3, one of 16 times as many steps does not.
TEST(ClosedPathFull, random_laps_give_their_work_back) {
  const std::vector<test::RandomLap> laps = test::random_laps(400);
  double worst = 0.0, finer = 0.0, of_bound = 0.0;
  int repeated = 0;
  for (std::size_t lap = 0; lap < laps.size(); ++lap) {
    const test::RandomLap& one = laps[lap];
    double net = 0.0;
    for (const int steps : {20000, 320000}) {
      const test::Path path = test::walk(one.path, one.rules, one.gap, one.p, steps);
      if (path.largest <= 0.0) break;
      EXPECT_LE(path.net, path.bound) << lap;
      of_bound = std::max(of_bound, path.net / path.bound);
      net = path.net / path.largest;
      if (steps == 20000) worst = std::max(worst, net);
      if (net <= 1e-3) break;
      if (steps == 20000) ++repeated;
    }
    finer = std::max(finer, net);
    EXPECT_LE(net, 1e-3) << lap;
  }
  std::printf("  worst of 20000 steps %.2e; %d laps repeated with 320000, worst then %.2e; worst over the bound %.2f\n", worst, repeated,
              finer, of_bound);
}

TEST(ClosedPathFull, what_folds_keep_falls_with_the_step) {
  const std::vector<test::RandomLap> laps = test::random_laps(400);
  double first = 0.0, last = 0.0;
  for (const int steps : {1250, 5000, 20000, 80000}) {
    const Laps all = walk_all(laps, steps);
    std::printf("  %6d steps: worst of 400 laps %.2e of CE, %.2f of the bound\n", steps, all.worst, all.of_bound);
    EXPECT_LE(all.of_bound, 1.0);
    if (first == 0.0) first = all.worst;
    last = all.worst;
  }
  EXPECT_LE(last, first / 16.0);  // 1/64, but for where in its step each lap meets its folds
}

}  // namespace
}  // namespace abut::contact
