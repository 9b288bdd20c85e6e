// Momentum of a body and the moving wall that it hits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/run/small_decks.hpp"

namespace abut::small_decks {
namespace {

/// A free cube flies at a free wall, which it hits and leaves several times. @param slide 0 without friction, 1 tied, 2 with friction
std::string cube_on_a_moving_wall(int slide) {
  return materials + nodes(1, cube) + nodes(9, {{0.5, 0.5, -1e-4}}) + part(1, 1, 1) + element("BRICK", 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}) +
         group("GRNOD/NODE", 1, {1, 2, 3, 4, 5, 6, 7, 8}) + "/RWALL/PLANE/1\nwall\n" + ints({9, slide, 1, 0}) + reals({0, 0.3, 0, 0}) +
         reals({5e-6, 0, 0, 2}) + reals({0, 0, 1}) + "/INIVEL/TRA/1\nfly\n" + fmt::format("{:>20g}{:>20g}{:>20g}", 1.0, 0.5, -4.0) +
         ints({1, 0});
}

TEST(WallMomentum, IsKeptInEveryCycle) {
  const Vec3 exact = density * Vec3{1.0, 0.5, -4.0} + 5e-6 * Vec3{0, 0, 2.0};
  for (const int slide : {0, 1, 2}) {
    RunSettings settings;
    settings.threads = 1;
    settings.allow_findings = true;
    abut::Run run(Model::from_text({.starter = cube_on_a_moving_wall(slide) + "/END\n", .engines = {engine(0.01)}, .name = "wall"}),
                  settings);
    double error = 0.0;
    bool hit = false;
    while (run.advance()) {
      error = std::max(error, norm(run.balance().momentum - exact));
      hit = hit || run.velocities()[8].z < 1.0;
    }
    EXPECT_TRUE(hit) << slide;
    EXPECT_LT(error, 1e-14 * norm(exact)) << slide;
  }
}

}  // namespace
}  // namespace abut::small_decks
