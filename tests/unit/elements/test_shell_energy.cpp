// Energies of shells are the work of their forces: under stress, in finite steps, in rotation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "unit/elements/shell_support.hpp"

namespace abut::elements {
namespace {

using namespace test;

struct Books {
  double internal = 0.0, work = 0.0;
};

/// One element is stretched by 1 % and bent, then breathes by up to 0.1 % in 3000 steps.
Books breathe(bool quad, bool thins, bool bends, const Profile& profile) {
  ShellModel s({1.0, 0.3, 1.0}, 0.1);
  s.property().thickness_changes = thins;
  std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  if (!quad) corners.pop_back();
  s.single(corners);
  Runner r(s, quad, profile);
  const double h = 1.0;
  constexpr int ramp = 200, steps = 3000;
  double last = 0.0;
  Books at_ramp, now;
  r.step(0.0);
  for (int n = 1; n <= ramp + steps; ++n) {
    const double breath = n > ramp ? 1e-3 * std::sin(2.0 * n) * std::sin(1e-3 * n) : 0.0;
    const double stretch = (bends ? 0.0 : 0.01 * std::min(1.0, static_cast<double>(n) / ramp)) + breath;
    // bending: the curvature grows to 0.1 of the thickness's inverse, then breathes with the stretch
    const double turn = !bends ? 0.0 : n <= ramp ? 0.2 / ramp : 20.0 * (stretch - last);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 was = r.x[k];
      r.x[k] = (1.0 + stretch) * corners[k];
      r.v[k] = (1.0 / h) * (r.x[k] - was);
      r.w[k] = {0, (corners[k].x - 0.5) * turn / h, 0};
    }
    last = stretch;
    const std::vector<Vec3> f = r.f, m = r.m;
    now.internal = r.step(h).internal_energy;
    for (std::size_t k = 0; k < corners.size(); ++k) now.work += 0.5 * h * (dot(f[k] + r.f[k], r.v[k]) + dot(m[k] + r.m[k], r.w[k]));
    if (n == ramp) at_ramp = now;
  }
  return {now.internal - at_ramp.internal, now.work - at_ramp.work};
}

// Strains are those of mid-step, so that the forces of both ends belong to the mean volume. With the volume at the end every step of a
// stretched element books 1/2 V sigma (tr de)^2 too much: a sheet at 0.1 % that vibrates with 10 m/s had 50 % of all energy from it.
TEST(ShellEnergy, IsTheWorkOfTheForcesUnderStress) {
  for (const bool quad : {true, false}) {
    for (const bool thins : {false, true}) {
      for (const bool bends : {false, true}) {
        const Books b = breathe(quad, thins, bends, Profile::standard());
        std::printf("[found] %s%s%s: internal energy grows by %.3e, work of the forces %.3e\n", quad ? "quadrilateral" : "triangle",
                    thins ? ", thinning" : "", bends ? ", bent" : "", b.internal, b.work);
        EXPECT_NEAR(b.internal, b.work, 2e-3 * b.work);
      }
    }
  }
}

// N = 1 with dn: the normal viscosity takes energy by the mean of old and new force, or the sum is 10 % short.
TEST(ShellEnergy, NormalViscosityOfMembranesCloses) {
  ShellModel s({1.0, 0.3, 1.0}, 0.1);
  s.property().points = 1;
  s.property().dn = 0.1;
  s.single({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Runner r(s, true);
  for (std::size_t k = 0; k < 4; ++k) r.v[k].z = 1e-6 * (k < 2 ? 1.0 : -0.5);
  const double h = 0.9 * r.step(0.0).step, first = r.kinetic();
  double taken = 0.0, worst = 0.0, start = 0.0;
  for (int n = 0; n < 200; ++n) {
    const std::vector<Vec3> v = r.v;
    const GroupResult g = r.cycle(h, n == 0);
    double kinetic = 0.0;
    for (std::size_t k = 0; k < 4; ++k) kinetic += 0.5 * r.mass[k] * dot(v[k], r.v[k]);
    if (n == 0) continue;
    const double all = kinetic + g.internal_energy + g.hourglass_energy;
    if (n == 1) start = all;
    worst = std::max(worst, std::abs(all - start) / first);
    taken = g.hourglass_energy / first;
  }
  std::printf("[found] normal viscosity takes %.3f of the energy, balance closes to %.1e\n", taken, worst);
  EXPECT_GT(taken, 0.5);
  EXPECT_LT(worst, 1e-3);
}

}  // namespace
}  // namespace abut::elements
