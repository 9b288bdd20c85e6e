// Initial velocities of the deck: what moves how before the first cycle.
#include <gtest/gtest.h>

#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

const std::string spin = "/INIVEL/AXIS/1\nspin\n         Z         0         1\n" + reals({0, 0, 0, 2.0});
const std::string fly = "/INIVEL/TRA/2\nfly\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 5.0, 0.0, 0.0) + ints({1, 0});

// A rigid cube spins about an axis through its corner, 1/2 omega^2 sum m r^2; its main node was typed elsewhere than at its centre of mass.
TEST(InitialVelocity, AboutAnAxisSpinsARigidBody) {
  const std::string deck = materials + nodes(1, cube) + nodes(9, {{3, 0, 0}}) + part(1, 1, 1) +
                           element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) + group("GRNOD/NODE", 1, {1, 2, 3, 4, 5, 6, 7, 8, 9}) +
                           group("GRNOD/NODE", 2, {1, 2, 3, 4, 5, 6, 7, 8}) + "/RBODY/1\nbody\n" +
                           "         9         0         0         0                   0         2         0         1         0\n" +
                           reals({0, 0, 0}) + reals({0, 0, 0}) + ints({0, 0, 0}) + spin;
  const double omega = 2.0, squares = 2.0 * (0.0 + 1.0 + 2.0 + 1.0);  // of r, over the nodes
  const abut::Run run = run_of(deck, engine(0.1, "/DT\n0.9 0.\n/DTIX\n0.001 0.001\n"));
  EXPECT_LT(norm(run.angular_velocities()[8] - Vec3{0, 0, omega}), 1e-12);
  const double energy = 0.5 * omega * omega * density / 8.0 * squares;
  EXPECT_NEAR(run.balance().ke + run.balance().ker, energy, 1e-9 * energy);
}

TEST(InitialVelocity, TheLastCardThatNamesANodeWins) {
  const std::string deck =
      materials + nodes(1, square) + part(1, 2, 1) + element("SHELL", 1, 1, {1, 2, 3, 4}) + group("GRNOD/NODE", 1, {1, 2, 3, 4});
  const auto first_speed = [&](const std::string& cards) {
    const abut::Run run = run_of(deck + cards, engine(1e-9, "/DT\n0.9 0.\n/DTIX\n1e-9 1e-9\n"));
    return run.velocities()[2];
  };
  EXPECT_LT(norm(first_speed(spin + fly) - Vec3{5, 0, 0}), 1e-6);
  EXPECT_LT(norm(first_speed(fly + spin) - Vec3{-2, 2, 0}), 1e-6);
}

}  // namespace
}  // namespace abut::small_decks
