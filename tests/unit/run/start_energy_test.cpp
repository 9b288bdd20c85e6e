// The balance of runs in which a constraint takes or gives energy at once: in cycle 0, or when a sensor switches a body on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

const std::string begin = "#RADIOSS STARTER\n/BEGIN\nstart\n      2022         0\n" + unit_system + unit_system;

/// A rigid body of eight corners of 1 kg around node 9, of 1 kg, the first four at z = 0.
std::string body(int sensor) {
  std::vector<Vec3> x = cube;
  x.push_back({0.5, 0.5, 0.5});
  return begin + nodes(1, x) + group("GRNOD/NODE", 1, {1, 2, 3, 4, 5, 6, 7, 8}) + group("GRNOD/NODE", 2, {9}) +
         group("GRNOD/NODE", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}) + "/ADMAS/0/1\nmass\n" + reals({1}).substr(0, 20) + ints({3}) +
         "/RBODY/1\nbody\n" + ints({9, sensor, 0, 3}).substr(0, 40) + reals({0}).substr(0, 20) + ints({1, 1, 1}) + reals({0, 0, 0}) +
         reals({0, 0, 0}) + "\n";
}

std::string initial_velocity(int id, const Vec3& v, int nodes_of) {
  return fmt::format("/INIVEL/TRA/{}\nstart\n", id) + reals({v.x, v.y, v.z}).substr(0, 60) + ints({nodes_of, 0});
}

std::string constant(double value) { return "/FUNCT/1\nf\n" + reals({0, value}) + reals({1, value}); }

std::string imposed_velocity(int nodes_of) {
  return "/IMPVEL/1\nv\n         1         X         0         0" + ints({nodes_of, 0, 0}) + reals({1, 1, 0, 0});
}

/// Of all rows of the history.
double largest_error(const abut::Run& run) {
  const History& h = run.history();
  const auto column = static_cast<std::size_t>(std::find(h.names.begin(), h.names.end(), "GLOBAL/ERR") - h.names.begin());
  double largest = 0.0;
  for (std::size_t k = column; k < h.values.size(); k += h.names.size()) largest = std::max(largest, std::fabs(h.values[k]));
  return largest;
}

// The wall stops the body in cycle 0: all of its energy is work of the wall, and the run goes on to its end.
TEST(StartEnergy, OfABodyFlushOnAWall) {
  const std::string deck = body(0) + initial_velocity(1, {0, 0, -0.05}, 3) + "/RWALL/PLANE/1\nwall\n" + ints({0, 0, 1, 0}) +
                           reals({0, 0, 0, 0}) + reals({0, 0, 0}) + reals({0, 0, 1});
  const abut::Run run = run_of(deck, engine(200, "/DT\n0.9 0.\n/DTIX\n1 1\n"));
  EXPECT_GT(run.cycle(), 150);  // more than the patience of the default limit
  EXPECT_LT(largest_error(run), 1e-12);
  EXPECT_EQ(first(run, "GLOBAL/EXTW"), 0.0);
  EXPECT_NEAR(first(run, "GLOBAL/KE"), 0.01125, 1e-14);
  EXPECT_NEAR(last(run, "GLOBAL/EXTW"), -0.01125, 1e-14);
  EXPECT_NEAR(last(run, "GLOBAL/KE"), 0.0, 1e-14);
}

// From 1 to 3 mm/ms at once: the work is 1/2 m (9 - 1).
TEST(StartEnergy, OfAnImposedVelocity) {
  const abut::Run of_body =
      run_of(body(0) + initial_velocity(1, {1, 0, 0}, 3) + constant(3) + imposed_velocity(2), engine(20, "/DT\n0.9 0.\n/DTIX\n1 1\n"));
  EXPECT_LT(largest_error(of_body), 1e-12);
  EXPECT_NEAR(last(of_body, "GLOBAL/EXTW"), 36.0, 1e-10);
  const std::string node = begin + nodes(1, {{0, 0, 0}}) + group("GRNOD/NODE", 1, {1}) + "/ADMAS/0/1\nmass\n" + reals({1}).substr(0, 20) +
                           ints({1}) + initial_velocity(1, {1, 0, 0}, 1) + constant(1e-9) + imposed_velocity(1);
  const abut::Run of_node = run_of(node, engine(200, "/DT\n0.9 0.\n/DTIX\n1 1\n"));
  EXPECT_LT(largest_error(of_node), 1e-12);
  EXPECT_NEAR(last(of_node, "GLOBAL/EXTW"), -0.5, 1e-12);
}

// Corners that come together at 1 mm/ms become one body at rest: the impact takes all, and no limit stops the run.
TEST(StartEnergy, OfABodyThatASensorSwitchesOn) {
  const std::string sensor = "/SENSOR/TIME/1\nsensor\n" + reals({10}) + reals({0});
  const abut::Run run = run_of(body(1) + sensor + group("GRNOD/NODE", 4, {1, 2, 3, 4}) + group("GRNOD/NODE", 5, {5, 6, 7, 8}) +
                                   initial_velocity(1, {0, 0, 0.01}, 4) + initial_velocity(2, {0, 0, -0.01}, 5),
                               engine(200, "/DT\n0.9 0.\n/DTIX\n1 1\n"));
  EXPECT_GT(run.cycle(), 150);
  EXPECT_LT(largest_error(run), 1e-12);
  EXPECT_NEAR(last(run, "GLOBAL/EXTW"), -4e-4, 1e-15);
  EXPECT_NEAR(last(run, "GLOBAL/KE"), 0.0, 1e-15);
}

}  // namespace
}  // namespace abut::small_decks
