// Steps where nothing deforms, and steps that collapse.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "abut/diagnostic.hpp"
#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

const std::string rigid_cube = materials + nodes(1, cube) + nodes(9, {{0.5, 0.5, 0.5}}) + part(1, 1, 1) +
                               element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) + group("GRNOD/NODE", 1, {1, 2, 3, 4, 5, 6, 7, 8}) +
                               group("GRNOD/NODE", 2, {9}) + "/RBODY/1\nbody\n" +
                               "         9         0         0         0                   0         1         0         1         0\n" +
                               reals({0, 0, 0}) + reals({0, 0, 0}) + ints({0, 0, 0});

// A short pulse in a long run: v = impulse / mass.
TEST(FreeFlight, FollowsTheLoadsOfARigidBody) {
  const double force = 1e-6, rise = 0.3;
  const std::string pulse = "/FUNCT/1\npulse\n" + reals({0, 0}) + reals({3.2, 0}) + reals({3.2 + rise, 1}) + reals({3.2 + 2 * rise, 0}) +
                            reals({1000, 0}) + "/CLOAD/1\npush\n         1         X         0         0         2         0" +
                            fmt::format("{:>20g}{:>20g}\n", 1.0, force);
  const abut::Run run = run_of(rigid_cube + pulse, engine(1000, ""));
  const double speed = force * rise / density;
  EXPECT_NEAR(run.velocities()[8].x, speed, 0.01 * speed);
  EXPECT_LT(run.time() / run.step(), 200.0);  // and the rest of the run takes long steps
}

// Half a turn in a step would be an error, and a tenth of one a wrong motion.
TEST(FreeFlight, FollowsTheSpinOfARigidBody) {
  const std::string spin = "/INIVEL/ROT/1\nspin\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 0.0, 0.0, 2.0) + ints({2, 0});
  const abut::Run run = run_of(rigid_cube + spin, engine(1000, ""));
  EXPECT_NEAR(run.step(), 0.05 / 2.0, 1e-9);
  EXPECT_NEAR(norm(run.positions()[6] - run.positions()[8]), std::sqrt(0.75), 1e-9);
}

// A brick that is pressed flat: its step goes to zero faster than the time to the end.
TEST(Collapse, EndsARunThatWouldNeverEnd) {
  const std::string large_strain = "/PROP/SOLID/5\nlarge strain\n" + ints({1, 4, 0, 0, 0, 0, 0, 1}) + reals({0, 0, 0}) + reals({0});
  const std::string deck = materials + large_strain + nodes(1, cube) + part(1, 5, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) +
                           group("GRNOD/NODE", 1, {1, 2, 3, 4}) + group("GRNOD/NODE", 2, {5, 6, 7, 8}) + bcs("111 111", 1) +
                           "/FUNCT/1\nconstant\n" + reals({0, 1}) + reals({10, 1}) +
                           "/IMPVEL/1\npress\n         1         Z         0         0         2         0         0\n" +
                           reals({0, -2000, 0, 0});
  RunSettings settings;
  settings.threads = 1;
  settings.allow_findings = true;
  abut::Run run(Model::from_text({.starter = deck + "/END\n", .engines = {engine(1)}, .name = "keywords"}), settings);
  EXPECT_THROW(run.advance_to_end(), RunError);
  const std::string& message = run.outcome().message;
  EXPECT_EQ(message.find("the time step of node "), 0U) << message;
  EXPECT_NE(message.find(" has collapsed from "), std::string::npos) << message;
  EXPECT_LT(run.time(), 1.0 / 2000.0);
}

}  // namespace
}  // namespace abut::small_decks
