// Mass, momentum and kinetic energy of the parts are those of the model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

/// Sum over the parts 1 to 5 less the global one, over the size of the latter, at its largest in all rows.
double difference(const History& h, const std::string& of_part, const std::string& global, std::size_t rows) {
  const auto column = [&h](const std::string& name) {
    const auto found = std::find(h.names.begin(), h.names.end(), name);
    EXPECT_NE(found, h.names.end()) << name;
    return static_cast<std::size_t>(found - h.names.begin());
  };
  double largest = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double* value = h.values.data() + row * h.names.size();
    double sum = 0.0;
    for (int part = 1; part <= 5; ++part) sum += value[column(fmt::format("PART/{}/{}", part, of_part))];
    const double expected = value[column(global)];
    largest = std::max(largest, std::fabs(sum - expected) / std::fabs(expected));
  }
  return largest;
}

/// Bricks, uneven triangles and quadrilaterals that swing; a rigid cube of bricks with a void lid, which flies and turns.
const std::string swinging_and_rigid =
    materials + nodes(1, cube) + nodes(11, {{0, 0, 2}, {2, 0.3, 2}, {0.4, 1, 2}, {1.5, 1.2, 2}}) +
    nodes(21, {{0, 0, 4}, {1, 0, 4}, {1, 1, 4}, {0, 1, 4}}) +
    nodes(31, {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}, {5, 0, 1}, {6, 0, 1}, {6, 1, 1}, {5, 1, 1}}) + nodes(39, {{5.5, 0.5, 0.5}}) +
    part(1, 1, 1) + part(2, 2, 1) + part(3, 2, 1) + part(4, 1, 1) + part(5, 3, 2) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) +
    element("SH3N", 2, 2, {11, 12, 13}) + ints({3, 12, 14, 13}) + element("SHELL", 3, 4, {21, 22, 23, 24}) +
    element("BRICK", 4, 5, {31, 32, 33, 34, 35, 36, 37, 38}) + element("SHELL", 5, 6, {35, 36, 37, 38}) +
    group("GRNOD/NODE", 1, {31, 32, 33, 34, 35, 36, 37, 38, 39}) + group("GRNOD/NODE", 2, {31, 32, 33, 34, 35, 36, 37, 38}) +
    group("GRNOD/NODE", 3, {2, 3, 12, 13, 22, 24}) + "/RBODY/1\nbody\n" +
    "        39         0         0         0                   0         2         0         1         0\n" + reals({0, 0, 0}) +
    reals({0, 0, 0}) + ints({0, 0, 0}) + "/INIVEL/AXIS/1\nspin\n         X         0         1\n" + reals({3, 5, -7, 2.0}) +
    "/INIVEL/TRA/2\nfly\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 5.0, -2.0, 1.0) + ints({3, 0}) + "/TH/PART/1\nparts\nDEF       RKE\n" +
    ints({1, 2, 3, 4, 5});

TEST(PartSums, OfAFreeModelAddUpToTheGlobalOnes) {
  const abut::Run run = run_of(swinging_and_rigid, engine(0.05, "/DT\n0.9 0.\n/DTIX\n1e-9 1\n"));
  const History& h = run.history();
  const std::size_t rows = h.values.size() / h.names.size();
  ASSERT_GT(rows, 10U);
  for (const char* component : {"XMOM", "YMOM", "ZMOM"}) {
    EXPECT_LT(difference(h, component, std::string("GLOBAL/") + component, rows), 1e-12) << component;
  }
  double mass = 0.0;
  for (int part = 1; part <= 5; ++part) mass += last(run, fmt::format("PART/{}/MASS", part));
  EXPECT_NEAR(mass, run.balance().mass, 1e-14 * mass);
  EXPECT_NEAR(last(run, "PART/4/MASS"), density, 1e-14 * density);
  EXPECT_NEAR(last(run, "PART/5/MASS"), 0.1 * density, 1e-14 * density);
  // In the first row both are of the velocities of the start (and the first step is short: the global energy lacks what its kick adds).
  const auto sum = [&](const char* variable) {
    double all = 0.0;
    for (int part = 1; part <= 5; ++part) {
      const auto found = std::find(h.names.begin(), h.names.end(), fmt::format("PART/{}/{}", part, variable));
      all += h.values[static_cast<std::size_t>(found - h.names.begin())];
    }
    return all;
  };
  const double kinetic = h.values[3] + h.values[4];
  ASSERT_EQ(h.names[3], "GLOBAL/KE");
  EXPECT_NEAR(sum("KE") + sum("RKE"), kinetic, 1e-12 * kinetic);
}

}  // namespace
}  // namespace abut::small_decks
