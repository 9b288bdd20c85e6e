// Time steps and nodal stiffness of bricks: the reference's formulas (numerics.md 2.1.5, 2.2) and the rigorous bound.
#include <gtest/gtest.h>

#include "stability.hpp"

namespace abut::elements::test {
namespace {

const std::vector<std::vector<Index>> one = {{0, 1, 2, 3, 4, 5, 6, 7}};

struct Sample {
  double bound = 0.0, exact = 0.0, nodal = 0.0;
};

/// Unscaled bound step, exact limit and nodal step of one brick, after an optional homogeneous preload.
Sample sample(const std::vector<Vec3>& x, SolidSetup setup, double preload = 0.0) {
  const double size = 1.0;
  const auto make = [&](bool bulk_viscosity, bool hourglass) {
    SolidSetup s = setup;
    if (!bulk_viscosity) s.property.qa = s.property.qb = 0.0;
    if (!hourglass) s.property.h = 0.0;
    auto body = std::make_unique<SolidBody>(x, one, s);
    if (preload != 0.0) {
      body->set_velocity([&](const Vec3& p) { return preload * Vec3{p.x + 0.5 * p.y, -0.3 * p.y, -0.5 * p.z + p.x}; });
      body->advance(1.0);
    }
    return body;
  };
  const ElementMatrices e = linearise(make, size);
  Sample out;
  out.exact = exact_step(e);
  auto body = make(true, true);
  std::fill(body->v.begin(), body->v.end(), Vec3{});
  const GroupResult r = body->step(0.0);
  out.bound = r.step / 0.9;
  out.nodal = 1e30;
  for (std::size_t i = 0; i < body->x.size(); ++i) out.nodal = std::min(out.nodal, std::sqrt(2.0 * body->m[i] / body->k[i]));
  return out;
}

SolidSetup with_poisson(double nu) {
  SolidSetup s;
  s.law = model::LawElastic{210.0, nu};
  return s;
}

// The bound is never above the exact limit of the element's eigenproblem with its viscosities: random shapes, both hourglass forms,
// both frames, Poisson ratios from -0.5 to 0.49. It is not below 0.6 of it for corners moved by up to 15 % of an edge, and
// not below 0.5 for 25 % (where the viscosity of the hourglass control itself is bounded coarsely).
TEST(BrickStep, BoundIsBelowTheExactLimitOnRandomShapes) {
  Random random(11);
  double worst = 1.0, moderate = 1.0, best = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double nus[] = {-0.5, 0.0, 0.2, 0.3, 0.45, 0.49};
    SolidSetup s = with_poisson(nus[i % 6]);
    s.property.isolid = 1 + (i / 6) % 2;
    s.property.iframe = 1 + (i / 12) % 2;
    s.property.h = i % 5 == 0 ? 0.15 : 0.1;
    auto x = unit_cube();
    const Vec3 scale{1.0, 1.0 + 4.0 * std::abs(random()), 1.0 + 4.0 * std::abs(random())};
    const double shear = 0.8 * random(), amount = 0.25 * std::abs(random());
    for (Vec3& p : x) {
      p += amount * random.vec();
      p = {p.x * scale.x + shear * p.y, p.y * scale.y, p.z * scale.z};
    }
    SolidBody probe(x, one, s);
    if (probe.step(0.0).bad_element != no_index) continue;
    const Sample r = sample(x, s);
    EXPECT_LE(r.bound, r.exact * (1 + 1e-7)) << "shape " << i;
    EXPECT_LE(r.nodal, r.exact * (1 + 1e-7)) << "shape " << i;
    if (amount < 0.15) moderate = std::min(moderate, r.bound / r.exact);
    worst = std::min(worst, r.bound / r.exact);
    best = std::max(best, r.bound / r.exact);
  }
  RecordProperty("smallest_ratio", std::to_string(worst));
  RecordProperty("largest_ratio", std::to_string(best));
  RecordProperty("smallest_ratio_moderate", std::to_string(moderate));
  EXPECT_GT(moderate, 0.6);
  EXPECT_GT(worst, 0.5);
}

// On boxes and parallelepipeds the bound is close to the limit.
TEST(BrickStep, BoundIsSharpOnRegularShapes) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    for (const Vec3 edge : {Vec3{1, 1, 1}, Vec3{1, 2, 3}, Vec3{1, 1, 0.1}, Vec3{0.1, 0.1, 1}}) {
      for (const double shear : {0.0, 0.5}) {
        auto x = unit_cube();
        for (Vec3& p : x) p = {edge.x * p.x + shear * edge.y * p.y, edge.y * p.y, edge.z * p.z};
        const Sample r = sample(x, with_poisson(nu));
        EXPECT_LE(r.bound, r.exact * (1 + 1e-7));
        EXPECT_GT(r.bound, 0.75 * r.exact) << nu << " " << edge.x << " " << edge.y << " " << edge.z << " " << shear;
      }
    }
  }
}

// Cube: omega^2 = 12 B/(rho L^2) exactly (volumetric mode), xi from the linear bulk viscosity.
TEST(BrickStep, CubeClosedForm) {
  SolidSetup s;
  SolidBody body(unit_cube(), one, s);
  const double bulk = 210.0 / 1.2, shear = 210.0 / 2.6, c = std::sqrt((bulk + 4.0 / 3.0 * shear) / 7.8);
  const double omega = std::sqrt(12 * bulk / 7.8);
  // C = V eta tr G/m_n = 8/rho . rho qb c . 3/2
  const double xi = 12 * 0.05 * c / (2 * omega);
  EXPECT_NEAR(body.step(0.0).step, 0.9 * 2 / omega * (std::sqrt(1 + xi * xi) - xi), 1e-13);
}

// Initial stress (tension, compression and shear of 5 to 20 % of the modulus) stays covered.
TEST(BrickStep, BoundCoversInitialStress) {
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    auto x = unit_cube();
    for (Vec3& p : x) p += 0.15 * random.vec();
    const Sample r = sample(x, with_poisson(0.3), 0.2 * random());
    EXPECT_LE(r.bound, r.exact * (1 + 1e-6)) << i;
    EXPECT_GT(r.bound, 0.5 * r.exact) << i;
  }
}

// Small strain keeps its geometry: of a large stress only its rotation enters the tangent, and the bound stays near the limit. Preloads of
// up to half of the modulus; a third of uniaxial strain without lateral contraction or viscosity moves the bound by less than 2 %.
TEST(BrickStep, SmallStrainBoundCoversInitialStressAndFollowsItLittle) {
  Random random(14);
  for (int i = 0; i < 40; ++i) {
    auto x = unit_cube();
    for (Vec3& p : x) p += 0.15 * random.vec();
    SolidSetup s = with_poisson(i % 2 == 0 ? 0.3 : 0.0);
    s.property.ismstr = 1;
    s.property.isolid = 1 + i / 20;
    const double preload = 0.5 * random();
    const Sample rest = sample(x, s), r = sample(x, s, preload);
    EXPECT_LE(r.bound, r.exact * (1 + 1e-6)) << i;
    EXPECT_GT(r.bound, 0.6 * r.exact) << i;
    EXPECT_GT(r.bound, 0.9 * rest.bound) << i;
  }
  for (const double strain : {-1.0 / 3.0, 1.0 / 3.0}) {
    SolidSetup s = with_poisson(0.0);
    s.property.ismstr = 1;
    s.property.qa = s.property.qb = s.property.h = 0.0;
    SolidBody body(unit_cube(), one, s);
    const double rest = body.step(0.0).step;
    body.set_velocity([&](const Vec3& p) { return Vec3{0, 0, strain * p.z}; });
    body.advance(1.0);
    std::fill(body.v.begin(), body.v.end(), Vec3{});
    const double strained = body.step(0.0).step;
    EXPECT_LT(strained, rest);
    EXPECT_GT(strained, 0.98 * rest);
  }
}

// Assembled mesh, unequal elements: h = min sqrt(2 m/K) is below the exact limit of the assembled system with viscosity.
TEST(BrickStep, NodalStepBoundsTheAssembledSystem) {
  Random random(13);
  Box box(2, 2, 1, {1, 1, 1});
  for (Vec3& p : box.nodes) p = p + 0.15 * random.vec();
  for (Vec3& p : box.nodes) p.x *= p.x > 1.5 ? 2.0 : 1.0;
  SolidSetup setup;
  const auto make = [&](bool bulk_viscosity, bool hourglass) {
    SolidSetup s = setup;
    if (!bulk_viscosity) s.property.qa = s.property.qb = 0.0;
    if (!hourglass) s.property.h = 0.0;
    return std::make_unique<SolidBody>(box.nodes, box.bricks, s);
  };
  const ElementMatrices e = linearise(make, 1.0);
  const double exact = exact_step(e);
  auto body = make(true, true);
  const double element = body->step(0.0).step / 0.9;
  double h = 0.0;
  for (int i = 0; i < 5; ++i) {
    h = 1e30;
    for (std::size_t n = 0; n < body->x.size(); ++n) h = std::min(h, std::sqrt(2.0 * body->m[n] / body->k[n]));
    EXPECT_LE(h, exact * (1 + 1e-9));
    // Later cycles use the step made, 0.9 h: the share of viscosity in K grows by up to 1/0.9.
    if (i == 0) { EXPECT_GE(h, element * (1 - 1e-12)); }
    body->step(0.9 * h);
  }
  EXPECT_GT(h, 0.6 * exact);
}

// Reference step (2.1.5) at rest: V/A_max/(1.0513 c), and K = rho V/(4 dt^2) (2.2), c with the literal 1.333.
TEST(BrickStep, ReferenceFormula) {
  SolidSetup s;
  s.profile = Profile::reference();
  auto x = unit_cube();
  for (Vec3& p : x) p = {2 * p.x, p.y, 0.5 * p.z};
  SolidBody body(x, one, s);
  const double bulk = 210.0 / 1.2, shear = 210.0 / 2.6, c = std::sqrt((bulk + 1.333 * shear) / 7.8);
  const double dx = 0.5, dt = dx / (0.05 * c + std::sqrt(0.0025 * c * c + c * c));
  EXPECT_NEAR(body.step(0.0).step, 0.9 * dt, 1e-14);
  EXPECT_NEAR(dx / dt / c, 1.0513, 1e-4);
  for (const double k : body.k) EXPECT_NEAR(k, 7.8 / (4 * dt * dt), 1e-10);
  // In compression Q = qb c + qa^2 l <-tr D>; the linear term acts in expansion too.
  body.set_velocity([](const Vec3& p) { return Vec3{-0.3 * p.x, 0, 0}; });
  const double q = 0.05 * c + 1.21 * 0.3;
  EXPECT_NEAR(body.step(0.0).step, 0.9 * dx / (q + std::sqrt(q * q + c * c)), 1e-14);
  body.set_velocity([](const Vec3& p) { return Vec3{0.3 * p.x, 0, 0}; });
  EXPECT_NEAR(body.step(0.0).step, 0.9 * dt, 1e-14);
}

// Reference step of a wedge: the zero-area face does not enter the largest face.
TEST(BrickStep, ReferenceWedge) {
  SolidSetup s;
  s.profile = Profile::reference();
  s.property.qb = 0.0;
  const auto x = unit_cube();
  SolidBody body({x[0], x[1], x[2], x[4], x[5], x[6]}, {{0, 1, 2, 2, 3, 4, 5, 5}}, s);
  const double bulk = 210.0 / 1.2, shear = 210.0 / 2.6, c = std::sqrt((bulk + 1.333 * shear) / 7.8);
  // V = 1/2, largest face sqrt 2.
  EXPECT_NEAR(body.step(0.0).step, 0.9 * 0.5 / std::sqrt(2.0) / c, 1e-14);
}

// /DT/BRICK/DEL: an element at or below Tmin is deleted, gives no force or stiffness and its energy moves to removed_energy.
TEST(BrickStep, RemoveAction) {
  SolidSetup s;
  s.action = model::StepControl::Action::remove;
  Box box(2, 1, 1, {1, 1, 1});
  SolidBody probe(box.nodes, box.bricks, s);
  s.step_minimum = 0.7 * probe.step(0.0).step;
  SolidBody body(box.nodes, box.bricks, s);
  for (int j = 0; j <= 1; ++j)
    for (int k = 0; k <= 1; ++k) body.v[static_cast<std::size_t>(box.node(2, j, k))].x = -0.1;
  EXPECT_EQ(body.step(0.0).removed, 0);
  GroupResult r;
  double before = 0.0;
  for (int i = 0; i < 10; ++i) {
    r = body.advance(1.0);
    if (r.removed > 0) break;
    before = r.internal_energy + r.hourglass_energy;
  }
  EXPECT_EQ(r.removed, 1);
  EXPECT_DOUBLE_EQ(r.part_sums.mass, 7.8);
  EXPECT_EQ(r.part_sums.kinetic_energy, body.group->part_sums(body.v.data(), nullptr).kinetic_energy);
  EXPECT_TRUE(body.group->active(0));
  EXPECT_FALSE(body.group->active(1));
  EXPECT_EQ(body.output(1).off, 0.0);
  EXPECT_GT(r.removed_energy, 0.9 * before);
  EXPECT_DOUBLE_EQ(r.removed_energy, body.group->element_energy(1));
  EXPECT_EQ(r.step_element, 0);
  EXPECT_EQ(norm(body.f[static_cast<std::size_t>(box.node(2, 0, 0))]), 0.0);
  EXPECT_EQ(body.k[static_cast<std::size_t>(box.node(2, 0, 0))], 0.0);
  const GroupResult next = body.advance(1.0);
  EXPECT_EQ(next.removed, 0);
  EXPECT_DOUBLE_EQ(next.removed_energy, r.removed_energy);
}

// Rigid elements: no force, no step, in the reference profile no part sums; and they come back unharmed.
class RigidBricks : public testing::TestWithParam<bool> {};
TEST_P(RigidBricks, AreSilent) {
  SolidSetup s;
  if (GetParam()) s.profile = Profile::reference();
  Box box(2, 1, 1, {1, 1, 1});
  SolidBody body(box.nodes, box.bricks, s);
  body.set_velocity([](const Vec3& p) { return Vec3{0.1 * p.x, 0, 0}; });
  const std::uint8_t rigid[] = {1, 1};
  body.group->set_rigid(rigid);
  const GroupResult r = body.advance(0.1);
  EXPECT_EQ(r.step_element, no_index);
  EXPECT_GE(r.step, 1e30);
  for (const Vec3& f : body.f) EXPECT_EQ(norm(f), 0.0);
  EXPECT_DOUBLE_EQ(r.part_sums.mass, GetParam() ? 0.0 : 2 * 7.8);
  const std::uint8_t free[] = {0, 0};
  body.group->set_rigid(free);
  EXPECT_GT(body.advance(0.1).internal_energy, 0.0);
  EXPECT_DOUBLE_EQ(body.group->part_sums(body.v.data(), nullptr).mass, 2 * 7.8);
}
INSTANTIATE_TEST_SUITE_P(BrickStep, RigidBricks, testing::Bool());

}  // namespace
}  // namespace abut::elements::test
