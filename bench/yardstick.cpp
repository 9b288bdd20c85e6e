// The yardstick of bench/run, two numbers: CPU nanoseconds of 1000 double multiply-adds in L1 cache (the unit), and GB/s of the triad
// a[i] = b[i] + s c[i] over three arrays of 64 MB. Each is the best of eleven runs.
// The first moves by a quarter with the place of its loop in memory: this program is left as it is, so that units stay comparable.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <vector>

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main() {
  constexpr int n = 1000, repeat = 20000, runs = 11;
  static std::array<double, n> a, b, c;
  for (std::size_t i = 0; i < n; ++i) {
    a[i] = 1 + 1e-3 * static_cast<double>(i);
    b[i] = 1e-6 * static_cast<double>(i);
    c[i] = 1;
  }
  double best = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double start = seconds();
    for (int r = 0; r < repeat; ++r) {
      const double s = 1e-9 * r;
      for (std::size_t i = 0; i < n; ++i) c[i] = a[i] * s + b[i] * c[i];
      asm volatile("" ::: "memory");
    }
    best = std::min(best, 1e9 * (seconds() - start) / repeat);
  }
  constexpr std::size_t large = std::size_t{8} << 20U;
  std::vector<double> x(large, 0.0), y(large, 1.0), z(large, 2.0);
  double shortest = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double start = seconds();
    for (std::size_t i = 0; i < large; ++i) x[i] = y[i] + 1.5 * z[i];
    asm volatile("" ::: "memory");
    shortest = std::min(shortest, seconds() - start);
  }
  std::printf("%.2f %.2f\n", best, 24e-9 * static_cast<double>(large) / shortest);
  return x[5] + c[5] < 0 ? 1 : 0;
}
