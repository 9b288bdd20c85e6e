// The determinism contract within one process (docs/determinism.md): threads, and other ids. Instruction sets, compilers and the order
// of the deck's cards: scripts/determinism.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "support/recorder.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Scene;

/// A plate of LAW2 falls obliquely on a clamped one and rubs. Large enough that every loop of a cycle is cut into several ranges.
struct Drop {
  /// @param fails  shells fail while they touch, softly, and their facets go with them
  explicit Drop(bool falling_first, bool fails = false) : scene("drop") {
    const Index steel = scene.johnson_cook(7800.0, 210e9, 0.3, 60e6, 400e6, 0.5);
    if (fails) std::get<abut::model::LawJohnsonCook>(scene.model.materials.back().law).eps_max = 1e-3;
    const Index property = scene.shell_property(0.002);
    std::vector<Index> base, plate;
    const auto make_base = [&](Index part) {
      base = scene.shells(part, 40, 40, [](double u, double v) { return Vec3{0.2 * u, 0.2 * v, 0.0}; });
    };
    const auto make_plate = [&](Index part) {
      plate = scene.shells(
          part, 25, 25,
          [](double u, double v) {
            return Vec3{0.04 + 0.12 * u, 0.041 + 0.12 * v, 0.00205};
          },
          true);
    };
    const Index first = scene.part(property, steel), second = scene.part(property, steel);
    if (falling_first) {
      make_plate(first);
      make_base(second);
    } else {
      make_base(first);
      make_plate(second);
    }
    const Index lower = scene.shell_surface(falling_first ? second : first), upper = scene.shell_surface(falling_first ? first : second);
    std::vector<Index> edge;
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; j <= 40; ++j) {
        if (i == 0 || i == 40 || j == 0 || j == 40) edge.push_back(base[static_cast<std::size_t>(i + 41 * j)]);
      }
    }
    scene.fix(edge, {true, true, true}, {true, true, true});
    scene.velocity(plate, {8.0, 1.0, -30.0});
    scene.contact(lower, upper, fails ? 0.01 : 0.2, 0.3, 0.002);
    if (fails) scene.model.interfaces.back().idel = 2;
    scene.end(6e-5);
    middle = base[20 + 41 * 20];
    falling = plate[12 + 26 * 12];
  }
  Scene scene;
  Index middle = 0, falling = 0;
};

std::uint64_t hash_of(const Drop& drop, const abut::Profile& profile, int threads) {
  abut::cycle::RunOptions options;
  options.threads = threads;
  options.profile = profile;
  Recorder recorder;
  const abut::cycle::RunReport report = abut::cycle::run(drop.scene.model, options, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished);
  Index most = 0;  // the scene does what it is for
  for (const abut::scenes::Sample& sample : recorder.samples) most = std::max(most, sample.interfaces[0].in_contact);
  EXPECT_GT(most, 100);
  EXPECT_GT(recorder.samples.back().balance.fw, 0.0);
  return report.final_hash;
}

TEST(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  const Drop drop(false);
  for (const abut::Profile& profile : {abut::Profile::standard(), abut::Profile::reference()}) {
    const std::uint64_t one = hash_of(drop, profile, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(hash_of(drop, profile, threads), one) << threads << " threads";
  }
}

// Elements and contact go side by side, but contact loses the facets of an element in the step in which it fails.
TEST(Determinism, ElementsThatFailGiveTheSameBitsOnAnyNumberOfThreads) {
  const Drop drop(false, true);
  const std::uint64_t one = hash_of(drop, abut::Profile::standard(), 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(hash_of(drop, abut::Profile::standard(), threads), one) << threads << " threads";
}

TEST(Determinism, OtherIdsGiveTheSamePhysicsToRounding) {
  const Drop one(false), other(true);
  abut::cycle::RunOptions options;
  Recorder a({one.middle, one.falling}), b({other.middle, other.falling});
  for (const auto& [drop, recorder] : {std::pair(&one, &a), std::pair(&other, &b)}) {
    const abut::cycle::RunReport report = abut::cycle::run(drop->scene.model, options, *recorder);
    ASSERT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished);
  }
  const std::size_t cycles = std::min(a.samples.size(), b.samples.size());
  ASSERT_GT(cycles, 50u);
  const std::size_t n = cycles - 1;
  EXPECT_NEAR(a.samples[n].time, b.samples[n].time, 1e-12 * a.samples[n].time);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_GT(norm(a.samples[n].u[k]), 1e-5);
    EXPECT_LT(norm(a.samples[n].u[k] - b.samples[n].u[k]), 1e-9 * norm(a.samples[n].u[k]));
  }
  EXPECT_NEAR(a.samples[n].balance.ie, b.samples[n].balance.ie, 1e-9 * a.samples[n].balance.ie);
}

}  // namespace
