#include "constraints/rotation.hpp"

#include <cmath>

namespace abut::constraints {

void diagonalise(const Symmetric& a, std::array<double, 3>& values, std::array<Vec3, 3>& axes) {
  double m[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
  double e[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // columns: axes
  for (int sweep = 0; sweep < 50; ++sweep) {
    const double off = m[0][1] * m[0][1] + m[1][2] * m[1][2] + m[0][2] * m[0][2];
    const double diagonal = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
    if (off <= 1e-34 * diagonal) break;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0.0) continue;
        const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        const double s = t * c;
        for (auto& row : m) {
          const double mp = row[p], mq = row[q];
          row[p] = c * mp - s * mq;
          row[q] = s * mp + c * mq;
        }
        for (int k = 0; k < 3; ++k) {
          const double mp = m[p][k], mq = m[q][k];
          m[p][k] = c * mp - s * mq;
          m[q][k] = s * mp + c * mq;
        }
        for (auto& row : e) {
          const double ep = row[p], eq = row[q];
          row[p] = c * ep - s * eq;
          row[q] = s * ep + c * eq;
        }
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    values[static_cast<std::size_t>(k)] = m[k][k];
    axes[static_cast<std::size_t>(k)] = {e[0][k], e[1][k], e[2][k]};
  }
  axes[2] = cross(axes[0], axes[1]);
}

}  // namespace abut::constraints
