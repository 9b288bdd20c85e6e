// Element steps and nodal stiffnesses of the shells against eigenvalues of their own stiffness and damping, taken by differences.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/elements/shell_support.hpp"

namespace abut::elements::test {
namespace {

bool quads(int form) { return form <= 4; }

constexpr double tiny = 1e-7;

/// M^-1/2 K M^-1/2 (or C) of the assembled group, 6 unknowns per node: column j from the force that a velocity of `tiny` in unknown j
/// leaves after a step of length h. Divided by h it is the stiffness, with viscous parts the sum C + h K is returned.
Eigen::MatrixXd scaled_operator(const ShellModel& s, bool quad, double h) {
  const Runner base(s, quad);
  const auto n = static_cast<Eigen::Index>(base.x.size());
  Eigen::MatrixXd a(6 * n, 6 * n);
  const auto weight = [&](Eigen::Index i) {
    const auto node = static_cast<std::size_t>(i / 6);
    return 1.0 / std::sqrt(i % 6 < 3 ? base.mass[node] : base.inertia[node]);
  };
  for (Eigen::Index j = 0; j < 6 * n; ++j) {
    Runner r(s, quad);
    const auto node = static_cast<std::size_t>(j / 6);
    (j % 6 < 3 ? r.v : r.w)[node][static_cast<int>(j % 3)] = tiny;
    r.step(h);
    for (Eigen::Index i = 0; i < 6 * n; ++i) {
      const auto k = static_cast<std::size_t>(i / 6);
      a(i, j) = (i % 6 < 3 ? r.f : r.m)[k][static_cast<int>(i % 3)] / tiny * weight(i) * weight(j);
    }
  }
  return a;
}

double largest_eigenvalue(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

double bound_step(const ShellModel& s, bool quad) {
  Runner r(s, quad);
  return r.step(0.0).step;
}

ShellModel make(int form, double nu, double t) {
  ShellModel s({1.0, nu, 1.0}, t);
  s.property().ishell = quads(form) ? form : 1;
  s.property().ish3n = form == 5 ? 1 : 2;
  // The linear rotational viscosity of form 3 is checked with the damping below.
  if (form == 3) s.property().hr = 0.0;
  return s;
}

class StepBound : public ::testing::TestWithParam<int> {};

// Never above the exact limit 2/sqrt(lambda_max), whatever the shape.
TEST_P(StepBound, NeverAboveTheExactLimit) {
  const int form = GetParam();
  std::mt19937 random(static_cast<unsigned>(form));
  std::uniform_real_distribution<double> u(0.0, 1.0);
  double closest = 0.0, farthest = 1e30;
  for (int i = 0; i < 400; ++i) {
    const double nu = 0.49 * u(random), t = std::pow(10.0, -3.0 + 3.0 * u(random));
    ShellModel s = make(form, nu, t);
    s.property().hm = s.property().hf = std::pow(10.0, -3.0 + 2.0 * u(random));
    s.property().points = i % 7 == 0 ? 1 : 0;
    std::vector<Vec3> x;
    do {
      x = random_quad(random, 0.35 * u(random), std::pow(10.0, 2.0 * u(random) - 1.0), i % 3 == 0 ? 0.3 * u(random) : 0.0);
      if (!quads(form)) x.pop_back();
    } while (!convex(x));
    s.single(x);
    const double exact = 2.0 / std::sqrt(largest_eigenvalue(scaled_operator(s, quads(form), 1.0)));
    const double ratio = bound_step(s, quads(form)) / exact;
    EXPECT_LE(ratio, 1.0 + 2e-6) << "shape " << i << " nu " << nu << " t " << t;
    closest = std::max(closest, ratio);
    farthest = std::min(farthest, ratio);
  }
  std::printf("form %d: bound / exact from %.4f to %.7f over 400 shapes\n", form, farthest, closest);
}

// Not below 0.6 of it on regular shapes, thin to thick, soft to nearly incompressible.
TEST_P(StepBound, NotBelowSixTenthsOnRegularShapes) {
  const int form = GetParam();
  double farthest = 1e30;
  for (const double aspect : {1.0, 1.5, 2.0, 4.0, 10.0}) {
    for (const double t : {0.001, 0.03, 0.1, 0.3, 1.0}) {
      for (const double nu : {0.0, 0.3, 0.49}) {
        ShellModel s = make(form, nu, t);
        std::vector<Vec3> x{{0, 0, 0}, {aspect, 0, 0}, {aspect, 1, 0}, {0, 1, 0}};
        if (!quads(form)) x = {{0, 0, 0}, {aspect, 0, 0}, {0.5 * aspect, std::sqrt(0.75), 0}};
        s.single(x);
        const double exact = 2.0 / std::sqrt(largest_eigenvalue(scaled_operator(s, quads(form), 1.0)));
        const double ratio = bound_step(s, quads(form)) / exact;
        EXPECT_GE(ratio, 0.6) << "aspect " << aspect << " t " << t << " nu " << nu;
        EXPECT_LE(ratio, 1.0 + 2e-6);
        farthest = std::min(farthest, ratio);
      }
    }
  }
  std::printf("form %d: bound / exact at least %.4f on regular shapes\n", form, farthest);
}

// With viscosity the step must keep M - h/2 C - h^2/4 K positive semi-definite: membrane damping, and form 3's rotations.
TEST_P(StepBound, DampedStepKeepsTheEnergyPositive) {
  const int form = GetParam();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  double closest = 0.0;
  for (int i = 0; i < 100; ++i) {
    ShellModel s = make(form, 0.3, 0.05 + 0.2 * u(random));
    if (form == 3) s.property().hr = 0.1 * u(random);
    s.property().dm = 0.4 * u(random);
    std::vector<Vec3> x;
    do {
      x = random_quad(random, 0.2, 1.0, 0.0);
      if (!quads(form)) x.pop_back();
    } while (!convex(x));
    s.single(x);
    const double h = bound_step(s, quads(form));
    // Two lengths separate stiffness and viscosity: A(h) = C + h K.
    const Eigen::MatrixXd one = scaled_operator(s, quads(form), 1e-3), two = scaled_operator(s, quads(form), 2e-3);
    const Eigen::MatrixXd k = (two - one) * 1e3, c = 2.0 * one - two;
    const Eigen::MatrixXd sum = 0.5 * h * c + 0.25 * h * h * k;
    const double used = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (sum + sum.transpose())).eigenvalues().maxCoeff();
    EXPECT_LE(used, 1.0 + 1e-5) << "shape " << i;
    closest = std::max(closest, used);
  }
  std::printf("form %d: h/2 C + h^2/4 K reaches %.4f of M\n", form, closest);
}

// Nodal stiffnesses: min sqrt(2 m/K), sqrt(2 I/Kr) over the nodes is below the exact limit of the assembled mesh.
TEST_P(StepBound, NodalStiffnessBoundsTheAssembledMesh) {
  const int form = GetParam();
  std::mt19937 random(23);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  for (int i = 0; i < 10; ++i) {
    ShellModel s = make(form, 0.3, 0.02 + 0.1 * (i % 4));
    for (int b = 0; b < 4; ++b) {
      for (int a = 0; a < 4; ++a) { s.node({(1.0 + 0.5 * i) * (a + 0.2 * d(random)), b + 0.2 * d(random), 0.0}); }
    }
    for (Index b = 0; b < 3; ++b) {
      for (Index a = 0; a < 3; ++a) {
        const Index n = 4 * b + a;
        if (quads(form)) {
          s.quad(n, n + 1, n + 5, n + 4);
        } else {
          s.triangle(n, n + 1, n + 5);
          s.triangle(n, n + 5, n + 4);
        }
      }
    }
    const double exact = 2.0 / std::sqrt(largest_eigenvalue(scaled_operator(s, quads(form), 1.0)));
    Runner r(s, quads(form));
    const double element = r.step(0.0).step;
    double nodal = 1e30;
    for (std::size_t k = 0; k < r.x.size(); ++k) {
      nodal = std::min({nodal, std::sqrt(2.0 * r.mass[k] / r.stiffness[k]), std::sqrt(2.0 * r.inertia[k] / r.rotational[k])});
    }
    EXPECT_LE(nodal, exact * (1.0 + 2e-6));
    EXPECT_GE(nodal, element * (1.0 - 1e-12));
    // Slivers of aspect 3 to 5.5: assembly of element bounds loses more (triangles down to 0.43), never the sign of the inequality.
    if (i < 4) { EXPECT_GE(nodal, 0.7 * exact) << "mesh " << i; }
  }
}

INSTANTIATE_TEST_SUITE_P(Shells, StepBound, ::testing::Values(1, 2, 3, 4, 5, 6));

/// Kinetic energy of a free square after 3000 steps of `factor` times the exact limit, over the initial one.
double growth_of_a_free_square(double factor) {
  ShellModel s = make(1, 0.3, 0.05);
  s.property().hm = s.property().hf = s.property().hr = 0.0;  // the bound is exact then
  s.single({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const double exact = 2.0 / std::sqrt(largest_eigenvalue(scaled_operator(s, true, 1.0)));
  EXPECT_NEAR(bound_step(s, true), exact, 1e-6 * exact);
  Runner r(s, true);
  std::mt19937 random(29);
  std::uniform_real_distribution<double> d(-1e-9, 1e-9);
  for (std::size_t k = 0; k < 4; ++k) {
    r.v[k] = {d(random), d(random), d(random)};
    r.w[k] = {d(random), d(random), d(random)};
  }
  const double start = r.kinetic();
  for (int n = 0; n < 3000; ++n) r.cycle(factor * exact, n == 0);
  return r.kinetic() / start;
}

// The limit is the limit: below it a free square stays bounded, just above it explodes.
TEST(ShellStep, FreeSquareIsStableBelowTheLimitOnly) {
  EXPECT_LT(growth_of_a_free_square(0.98), 100.0);
  EXPECT_FALSE(growth_of_a_free_square(1.02) < 1e10);  // overflow to NaN counts as explosion
}

// Numerics.md 2.1.1, 2.1.3, 2.2, 9.4: the reference's lengths and stiffnesses.
TEST(ShellStep, ReferenceLengthsAndStiffnesses) {
  const double e = 210.0, rho = 7.8, c = std::sqrt(e / rho), t = 0.1;
  ShellModel square({e, 0.3, rho}, t);
  square.single({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  Runner q(square, true, Profile::reference());
  EXPECT_NEAR(q.step(0.0).step, 2.0 / c, 1e-14);
  EXPECT_NEAR(q.stiffness[0], 0.81 * 0.5 * 4.0 * t * e / 4.0, 1e-12);
  EXPECT_EQ(q.rotational[0], 0.0);

  // Rectangle 4 by 1: A^2 over squared diagonal = 16/17 < 1 = shortest side.
  ShellModel rectangle({e, 0.3, rho}, t);
  rectangle.single({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}});
  EXPECT_NEAR(Runner(rectangle, true, Profile::reference()).step(0.0).step, 1.0 / c, 1e-14);

  // A quad with nodes 3 and 4 in one place: sides 12, 23, 41 only.
  ShellModel folded({e, 0.3, rho}, t);
  const Index a = folded.node({0, 0, 0}), b = folded.node({2, 0, 0}), d = folded.node({0, 2, 0});
  folded.quad(a, b, d, d);
  Runner f(folded, true, Profile::reference());
  EXPECT_NEAR(f.step(0.0).step, 2.0 / c, 1e-14);  // A^2/l13^2 = 4/4... < shortest side 2

  ShellModel triangle({e, 0.3, rho}, t);
  triangle.single({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}});
  Runner r(triangle, false, Profile::reference());
  const double length = 2.0 / std::sqrt(5.0);
  EXPECT_NEAR(r.step(0.0).step, length / c, 1e-14);
  const double a11 = e / (1.0 - 0.09);
  EXPECT_NEAR(r.stiffness[0], 0.81 * 0.81 * 1.0 * t * a11 / (length * length), 1e-10);

  square.model.controls.nodal_step = true;
  Runner n(square, true, Profile::reference());
  n.step(0.0);
  // b1 = b2 = 2 for side 2 (P = +-1, +-1); hourglass eta = E h_m t/8, gamma = 1.
  const double k = 2.0 * t * a11 / 4.0 + 0.125 * e * 0.01 * t;
  EXPECT_NEAR(n.stiffness[0], k, 1e-12 * k);
  EXPECT_NEAR(n.rotational[0], k * (t * t / 12.0 + 4.0 / 9.0), 1e-12 * k);

  // Membrane damping shortens the step by sqrt(1 + dm^2) - dm.
  square.model.controls.nodal_step = false;
  square.property().dm = 0.2;
  EXPECT_NEAR(Runner(square, true, Profile::reference()).step(0.0).step, 2.0 / c * (std::sqrt(1.04) - 0.2), 1e-14);
}

}  // namespace
}  // namespace abut::elements::test
