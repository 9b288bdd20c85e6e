// Exact stability limit of an element: K from central differences of its forces, C from its response to velocities, both against
// the lumped mass. The lagged viscosity of leap-frog makes a step h stable iff lambda_max(M^-1 (h^2 K + 2 h C)) <= 4.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <memory>

#include "solid_fixture.hpp"

namespace abut::elements::test {

struct ElementMatrices {
  Eigen::MatrixXd k, c;
  Eigen::VectorXd m;
};

/// Builds the body in the state about which it is linearised (after any preload), with or without each viscosity.
using MakeBody = std::function<std::unique_ptr<SolidBody>(bool bulk_viscosity, bool hourglass)>;

inline ElementMatrices linearise(const MakeBody& make, double size) {
  const auto base = make(true, true);
  const auto n = static_cast<Eigen::Index>(3 * base->x.size());
  ElementMatrices out{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n), Eigen::VectorXd(n)};
  // Forces after a motion of one coordinate at velocity u over a time dt.
  const auto response = [&make](Eigen::Index j, double u, double dt, bool bulk_viscosity, bool hourglass) {
    auto b = make(bulk_viscosity, hourglass);
    std::fill(b->v.begin(), b->v.end(), Vec3{});
    b->v[static_cast<std::size_t>(j / 3)][static_cast<int>(j % 3)] = u;
    b->advance(dt);
    Eigen::VectorXd f(static_cast<Eigen::Index>(3 * b->x.size()));
    for (std::size_t i = 0; i < b->x.size(); ++i)
      for (int a = 0; a < 3; ++a) f(static_cast<Eigen::Index>(3 * i) + a) = b->f[i][a];
    return f;
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    out.m(j) = base->m[static_cast<std::size_t>(j / 3)];
    const double d = 1e-6 * size, u = 1e-9;
    out.k.col(j) = (response(j, d, 1.0, false, false) - response(j, -d, 1.0, false, false)) / (2.0 * d);
    // Bulk viscosity acts in compression only, i.e. for one of the two signs: the difference is the tangent of compression.
    out.c.col(j) = (response(j, u, 0.0, true, false) - response(j, -u, 0.0, true, false)) / u +
                   (response(j, u, 0.0, false, true) - response(j, -u, 0.0, false, true)) / (2.0 * u);
  }
  return out;
}

/// Largest eigenvalue of M^-1/2 sym(A) M^-1/2.
inline double largest_eigenvalue(const Eigen::MatrixXd& a, const Eigen::VectorXd& m) {
  const Eigen::VectorXd w = m.array().sqrt().inverse();
  const Eigen::MatrixXd s = w.asDiagonal() * (0.5 * (a + a.transpose())) * w.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// Largest stable h of one element (bisection).
inline double exact_step(const ElementMatrices& e) {
  double low = 0.0, high = 10.0 / std::sqrt(largest_eigenvalue(e.k, e.m));
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (low + high);
    (largest_eigenvalue(h * h * e.k + 2.0 * h * e.c, e.m) <= 4.0 ? low : high) = h;
  }
  return low;
}

}  // namespace abut::elements::test
