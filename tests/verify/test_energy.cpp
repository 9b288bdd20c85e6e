// Momentum and energy of contact runs (issue: run a real deck, 6.3, 6.5), default profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "support/impacts.hpp"
#include "support/recorder.hpp"

namespace {

using abut::Vec3;
using abut::scenes::Recorder;
using abut::scenes::Variant;
namespace model = abut::model;

struct Case {
  const char* name;
  std::function<model::Model(const Variant&)> build;
};

class Energy : public testing::TestWithParam<Case> {};

Recorder solve(const model::Model& m) {
  Recorder recorder;
  const auto report = abut::cycle::run(m, {}, recorder);
  EXPECT_EQ(report.outcome.kind, abut::cycle::Outcome::Kind::finished) << report.outcome.message;
  return recorder;
}

// 6.5: a free two-body impact keeps its linear momentum to 1e-12 of sum m |v|, with friction and with plastic shells.
TEST_P(Energy, FreeImpactKeepsItsMomentum) {
  Variant free;
  free.supported = false;
  const model::Model m = GetParam().build(free);
  const Recorder r = solve(m);
  double scale = 0.0;
  for (std::size_t i = 0; i < r.last_state.mass.size(); ++i) scale += r.last_state.mass[i] * norm(r.last_state.v[i]);
  double worst = 0.0;
  abut::Index touched = 0;
  for (const auto& sample : r.samples) {
    worst = std::max(worst, norm(sample.balance.momentum - r.samples.front().balance.momentum));
    touched = std::max(touched, sample.interfaces[0].in_contact);
  }
  std::printf("[found] momentum, %s: %.1e of sum m |v|\n", GetParam().name, worst / scale);
  EXPECT_GT(touched, 0);
  EXPECT_LT(worst, 1e-12 * scale);
}

// 6.3: ERR at most 1 % outside contact and 2 % during it; the ledger of discrete works closes to 0.2 %.
TEST_P(Energy, BalanceCloses) {
  const Recorder r = solve(GetParam().build({}));
  double outside = 0.0;
  double during = 0.0;
  double ledger = 0.0;
  for (const auto& sample : r.samples) {
    double& worst = sample.interfaces[0].in_contact > 0 ? during : outside;
    worst = std::max(worst, std::abs(sample.balance.err));
    ledger = std::max(ledger, std::abs(sample.balance.ledger));
  }
  const auto& last = r.samples.back().balance;
  std::printf("[found] energy, %s: ERR %.2e outside, %.2e during contact, LEDGER %.1e, CX %.1e, FW %.1e of the largest term\n",
              GetParam().name, outside, during, ledger, last.cx / last.largest, last.fw / last.largest);
  EXPECT_LT(outside, 0.01);
  EXPECT_LT(during, 0.02);
  EXPECT_LT(ledger, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Energy,
                         testing::Values(Case{"plates", [](const Variant& v) { return abut::scenes::plates(v); }},
                                         Case{"slide", [](const Variant& v) { return abut::scenes::slide(v); }},
                                         Case{"mixed", [](const Variant& v) { return abut::scenes::mixed(v); }}),
                         [](const auto& info) { return std::string(info.param.name); });

// 6.3: what the numerics of contact make or lose falls at least with the square of the step, on average over scenes and over phases (where
// in a step contact begins).
TEST(EnergyMadeByContact, FallsAtLeastToAQuarterWhenTheStepIsHalved) {
  const Case cases[] = {{"plates", [](const Variant& v) { return abut::scenes::plates(v); }},
                        {"slide", [](const Variant& v) { return abut::scenes::slide(v); }},
                        {"mixed", [](const Variant& v) { return abut::scenes::mixed(v); }}};
  double logs = 0.0;
  for (const Case& c : cases) {
    constexpr int phases = 8;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int p = 0; p < phases; ++p) {
      for (int level = 0; level < 3; ++level) {
        Variant v;
        v.step_scale = 0.9 / (1 << level);
        v.lift = 1.3e-6 * p;
        const Recorder r = solve(c.build(v));
        sum[level] += std::abs(r.samples.back().balance.cx) / r.samples.back().balance.largest / phases;
      }
    }
    std::printf("[found] CX, %s: mean |CX| over the largest term %.2e, %.2e, %.2e at scale 0.9, 0.45, 0.225: ratios %.2f, %.2f\n", c.name,
                sum[0], sum[1], sum[2], sum[0] / sum[1], sum[1] / sum[2]);
    EXPECT_LT(sum[1], sum[0]) << c.name;
    logs += 0.5 * std::log(sum[0] / sum[2]);
  }
  const double mean = std::exp(logs / 3.0);
  std::printf("[found] CX: halving the step divides it by %.2f on average\n", mean);
  EXPECT_GT(mean, 4.0);
}

}  // namespace
