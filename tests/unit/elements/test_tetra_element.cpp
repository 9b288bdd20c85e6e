// TETRA4: kinematics, masses, stress, objectivity, steps (numerics.md 4.9, 1.4, 2.1.7, 2.2).
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "stability.hpp"

namespace abut::elements::test {
namespace {

const std::vector<std::vector<Index>> one = {{0, 1, 2, 3}};

std::vector<Vec3> corner() { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

std::vector<Vec3> random_tetra(Random& random, double amount) {
  auto x = corner();
  for (Vec3& p : x) p += amount * random.vec();
  return x;
}

TEST(Tetra, MassesAndAreaShares) {
  SolidSetup s;
  SolidBody equal(corner(), one, s);
  for (const double m : equal.m) EXPECT_DOUBLE_EQ(m, 7.8 / 24);
  s.property.imas = 1;
  SolidBody areas(corner(), one, s);
  const double oblique = std::sqrt(3.0) / 2, total = oblique + 1.5;
  EXPECT_NEAR(areas.m[0], 7.8 / 6 * oblique / total, 1e-15);
  EXPECT_NEAR(areas.m[1], 7.8 / 6 * 0.5 / total, 1e-15);
}

// Translation: nothing. Any linear field: the stress of that field, forces f = V sigma grad N (virtual work), balanced moments.
TEST(Tetra, LinearFieldsAndWorkConjugacy) {
  Random random(1);
  SolidSetup s;
  s.property.qa = s.property.qb = 0.0;
  SolidBody body(random_tetra(random, 0.2), one, s);
  body.set_velocity([](const Vec3&) { return Vec3{1, -2, 3}; });
  body.advance(1e-2);
  for (const Vec3& f : body.f) EXPECT_LT(norm(f), 1e-12);
  for (Vec3& v : body.v) v = random.vec();
  body.advance(1e-2);
  const ElementOutput out = body.output();
  const double sigma[3][3] = {{out.stress[0], out.stress[3], out.stress[5]},
                              {out.stress[3], out.stress[1], out.stress[4]},
                              {out.stress[5], out.stress[4], out.stress[2]}};
  Vec3 moment, sum;
  for (std::size_t k = 0; k < 4; ++k) {
    moment += cross(body.x[k], body.f[k]);
    sum += body.f[k];
  }
  EXPECT_LT(norm(moment), 1e-12);
  EXPECT_LT(norm(sum), 1e-12);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double work = 0.0;
      for (std::size_t k = 0; k < 4; ++k) work += body.f[k][i] * body.x[k][j];
      EXPECT_NEAR(work, out.volume * sigma[i][j], 1e-12);
    }
}

// Constant-strain patch test: a distorted mesh of tetrahedra, interior nodes in equilibrium.
TEST(Tetra, PatchTest) {
  Random random(2);
  Box box(3, 3, 3, {1, 1, 1});
  for (int k = 1; k < 3; ++k)
    for (int j = 1; j < 3; ++j)
      for (int i = 1; i < 3; ++i) box.nodes[static_cast<std::size_t>(box.node(i, j, k))] += 0.2 * random.vec();
  SolidSetup s;
  s.property.qa = s.property.qb = 0.0;
  SolidBody body(box.nodes, split(box.bricks), s);
  body.set_velocity([](const Vec3& x) { return Vec3{0.1 * x.x + 0.2 * x.y, -0.1 * x.y + 0.3 * x.z, 0.05 * x.z + 0.1 * x.x}; });
  body.advance(1e-3);
  for (int k = 1; k < 3; ++k)
    for (int j = 1; j < 3; ++j)
      for (int i = 1; i < 3; ++i) EXPECT_LT(norm(body.f[static_cast<std::size_t>(box.node(i, j, k))]), 1e-13 * 210.0);
  double volume = 0.0;
  for (Index e = 0; e < body.group->size(); ++e) {
    volume += body.output(e).volume;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(body.output(e).stress[i], body.output(0).stress[i], 1e-12);
  }
  double mass = 0.0;
  for (const double m : body.m) mass += m;
  EXPECT_NEAR(mass, 27 * 7.8, 1e-10);
  EXPECT_GT(volume, 27.0);
}

TEST(Tetra, HydrostaticPressureFromVolume) {
  SolidBody body(corner(), one, SolidSetup{});
  body.step(0.0);
  body.set_velocity([](const Vec3& x) { return -0.2 * x; });
  body.advance(1.0);
  EXPECT_NEAR(body.output().pressure, 210.0 / 1.2 * (1 / (0.8 * 0.8 * 0.8) - 1), 1e-10);
}

/// Change of the stress (relative) when a stressed element turns by one revolution in `steps` steps.
double stress_error(const Profile& profile, int steps) {
  SolidSetup s;
  s.profile = profile;
  s.property.qa = s.property.qb = 0.0;
  SolidBody body(corner(), one, s);
  body.set_velocity([](const Vec3& x) { return Vec3{x.x + x.y, -0.5 * x.y, 0.3 * x.x - 0.5 * x.z}; });
  body.advance(1e-2);
  const auto before = body.output().stress;
  const Rotation r = rotation({1, 2, -1}, 2 * std::numbers::pi / steps);
  for (int i = 0; i < steps; ++i) {
    for (std::size_t k = 0; k < 4; ++k) body.v[k] = 1e3 * (r * body.x[k] - body.x[k]);
    body.advance(1e-3);
  }
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    error = std::max(error, std::abs(body.output().stress[i] - before[i]));
    size = std::max(size, std::abs(before[i]));
  }
  return error / size;
}

// The strain increment vanishes in a rigid turn and the stress turns by a rotation. The reference turns it to first order, with symmetric
// terms of that order in its spin: it drifts by O(1/N), without the terms by another O(1/N).
TEST(Tetra, StressTurnsWithTheElement) {
  EXPECT_LT(stress_error(Profile::standard(), 1000), 1e-8);
  EXPECT_LT(stress_error(Profile::standard(), 50), 4e-4);
  Profile first_order;
  first_order.stress_rotation = Profile::StressRotation::first_order;
  const double coarse = stress_error(first_order, 1000);
  EXPECT_NEAR(coarse / stress_error(first_order, 2000), 2.0, 0.1);
  EXPECT_LT(coarse, 0.05);
  const double reference = stress_error(Profile::reference(), 1000);
  EXPECT_GT(std::abs(reference - coarse), 0.01 * coarse);
  EXPECT_NEAR(reference / stress_error(Profile::reference(), 2000), 2.0, 0.1);
  RecordProperty("drift_1000_reference", std::to_string(reference));
}

TEST(Tetra, ReferenceStep) {
  SolidSetup s;
  s.profile = Profile::reference();
  SolidBody body(corner(), one, s);
  const double bulk = 210.0 / 1.2, shear = 210.0 / 2.6, c = std::sqrt((bulk + 1.333 * shear) / 7.8);
  const double dt = 1 / std::sqrt(3.0) / (c * (0.05 + std::sqrt(1.0025)));
  EXPECT_NEAR(body.step(0.0).step, 0.9 * dt, 1e-14);
  for (const double k : body.k) EXPECT_NEAR(k, 2 * 7.8 / 6 / (4 * dt * dt), 1e-10);
}

TEST(Tetra, BoundStepIsBelowTheExactLimit) {
  Random random(3);
  double worst = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double nus[] = {-0.5, 0.0, 0.2, 0.3, 0.45, 0.49};
    SolidSetup s;
    s.law = model::LawElastic{210.0, nus[i % 6]};
    s.property.imas = 1 + i % 2;
    auto x = random_tetra(random, 0.3);
    for (Vec3& p : x) p = {p.x, (1 + std::abs(random()) * 0.1) * p.y, 2.0 * p.z};
    const auto make = [&](bool bulk_viscosity, bool) {
      SolidSetup q = s;
      if (!bulk_viscosity) q.property.qa = q.property.qb = 0.0;
      return std::make_unique<SolidBody>(x, one, q);
    };
    auto body = make(true, true);
    const double bound = body->step(0.0).step / 0.9;
    if (body->result.bad_element != no_index) continue;
    const double exact = exact_step(linearise(make, 0.3));
    EXPECT_LE(bound, exact * (1 + 1e-7)) << i;
    for (std::size_t n = 0; n < 4; ++n) EXPECT_LE(std::sqrt(2 * body->m[n] / body->k[n]), exact * (1 + 1e-7)) << i;
    worst = std::min(worst, bound / exact);
  }
  RecordProperty("smallest_ratio", std::to_string(worst));
  EXPECT_GT(worst, 0.8);
}

/// Lowest longitudinal frequency of a free bar of 10 x 1 x 1, nu = 0, cells of six tetrahedra, over the exact pi c/L: the bar starts
/// undeformed with the velocities of the mode, whose amplitude is largest after a quarter of the period. The step falls with the cells.
double bar_frequency(int cells, int across) {
  constexpr double length = 10.0, speed = 1e-6;
  Box box(cells, across, across, {length / cells, 1.0 / across, 1.0 / across});
  SolidSetup s;
  s.law = model::LawElastic{210.0, 0.0};
  s.property.qa = s.property.qb = 0.0;
  SolidBody body(box.nodes, split(box.bricks), s);
  const auto start = body.x;
  const auto shape = [](double x) { return std::cos(std::numbers::pi * x / length); };
  body.set_velocity([&](const Vec3& x) { return Vec3{speed * shape(x.x), 0, 0}; });
  const double omega = std::numbers::pi / length * std::sqrt(210.0 / 7.8);
  const double h = 0.15 * length / cells / std::sqrt(210.0 / 7.8);
  body.step(0.0);
  const auto amplitude = [&] {
    double a = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) a += body.m[i] * shape(start[i].x) * (body.x[i].x - start[i].x);
    return a;
  };
  // The quarter period at which the amplitude is largest: where its rate changes sign, interpolated.
  double before = 0.0, rate_before = 0.0;
  for (int i = 0; i < 100000; ++i) {
    for (std::size_t k = 0; k < body.x.size(); ++k) body.v[k] += (-(i == 0 ? 0.5 : 1.0) * h / body.m[k]) * body.f[k];
    body.advance(h);
    const double now = amplitude(), rate = (now - before) / h;
    if (rate < 0.0) {
      const double quarter = (i - 0.5 + rate_before / (rate_before - rate)) * h;
      return 0.5 * std::numbers::pi / quarter / omega;
    }
    before = now;
    rate_before = rate;
  }
  return 0.0;
}

// Frequency of a known mode, refined: c = sqrt(E/rho), omega = pi c/L (Graff 1975, 2.3).
TEST(Tetra, LongitudinalModeOfABarConverges) {
  double error[3];
  const int across[3] = {1, 2, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    error[i] = bar_frequency(10 * across[i], across[i]) - 1.0;
    std::printf("[found] bar of tetrahedra, %d x %d x %d cells: frequency / exact - 1 = %.3e\n", 10 * across[i], across[i], across[i],
                error[i]);
  }
  EXPECT_LT(std::abs(error[2]), 5e-4);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_NEAR(error[i - 1] / error[i], 4.0, 0.6) << "second order, " << across[i];
}

TEST(Tetra, OrientationAndCollapse) {
  SolidBody left(corner(), {{0, 2, 1, 3}}, SolidSetup{});
  EXPECT_EQ(left.step(0.0).bad_element, no_index);
  EXPECT_NEAR(left.group->element_mass(0), 7.8 / 6, 1e-15);
  SolidBody body(corner(), one, SolidSetup{});
  body.step(0.0);
  body.x[3].z = -0.1;
  EXPECT_EQ(body.step(1e-3).bad_element, 0);
  for (const Vec3& f : body.f) EXPECT_TRUE(std::isfinite(norm(f)));
}

// LAW0: mass and kinetic energy only.
TEST(VoidSolids, CarryMassOnly) {
  SolidSetup s;
  s.law = model::LawVoid{};
  for (const bool tetra : {false, true}) {
    SolidBody body(tetra ? corner() : unit_cube(), tetra ? one : std::vector<std::vector<Index>>{{0, 1, 2, 3, 4, 5, 6, 7}}, s);
    double mass = 0.0;
    for (const double m : body.m) mass += m;
    EXPECT_NEAR(mass, tetra ? 1.3 : 7.8, 1e-14);
    body.set_velocity([](const Vec3& x) { return Vec3{x.x, 0, 1}; });
    const GroupResult r = body.advance(0.1);
    EXPECT_EQ(r.internal_energy, 0.0);
    EXPECT_GE(r.step, 1e30);
    for (const Vec3& f : body.f) EXPECT_EQ(norm(f), 0.0);
    EXPECT_EQ(body.group->family(), Family::inert);
    EXPECT_NEAR(body.group->part_sums(body.v.data(), nullptr).momentum.z, mass, 1e-14);
  }
}

}  // namespace
}  // namespace abut::elements::test
