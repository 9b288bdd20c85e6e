#include "constraints/body_frequency.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace abut::constraints {

namespace {

using Matrix = std::array<std::array<double, 6>, 6>;

double trace(const Matrix& a) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i][i];
  return sum;
}

/// A A / size^2 of a symmetric matrix.
Matrix squared(const Matrix& a, double size) {
  Matrix b{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j) {
      for (std::size_t k = 0; k < 6; ++k) b[i][j] += a[i][k] / size * (a[k][j] / size);
      b[j][i] = b[i][j];
    }
  }
  return b;
}

}  // namespace

double largest_rate(const BodySprings& springs, double mass, const RigidBodies::Inertia& inertia) {
  const double m = mass > 0.0 ? 1.0 / std::sqrt(mass) : 0.0;
  std::array<double, 3> j{};
  for (std::size_t k = 0; k < 3; ++k) j[k] = inertia.principal[k] > 0.0 ? 1.0 / std::sqrt(inertia.principal[k]) : 0.0;
  const auto& e = inertia.axes;

  Matrix a{};
  for (std::size_t i = 0; i < 3; ++i) {
    a[i][i] = springs.translation * m * m;
    for (std::size_t k = 0; k < 3; ++k) a[3 + i][3 + k] = dot(e[i], times(springs.second, e[k])) * j[i] * j[k];
    const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
    const double c = dot(e[last], springs.first) * m;  // v_i w_next c_last - v_next w_i c_last
    a[i][3 + next] = a[3 + next][i] = c * j[next];
    a[next][3 + i] = a[3 + i][next] = -c * j[i];
  }

  // trace(A^16)^(1/16): four squarings, each divided by its trace so that nothing overflows.
  double rate = 1.0;
  for (int n = 0; n < 4; ++n) {
    const double size = trace(a);
    if (size <= 0.0) return 0.0;
    double power = size;  // size^(1/2^n)
    for (int k = 0; k < n; ++k) power = std::sqrt(power);
    rate *= power;
    a = squared(a, size);
  }
  double root = trace(a);
  for (int k = 0; k < 4; ++k) root = std::sqrt(root);
  return rate * root;
}

}  // namespace abut::constraints
