// Runs that go wrong, or beyond a limit of the Engine deck, stop and say where.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "abut/diagnostic.hpp"
#include "abut/run.hpp"
#include "unit/model/deck_text.hpp"

namespace abut {
namespace {

using model::base_deck::base_engine;
using model::base_deck::base_starter;
using model::base_deck::with_line;

abut::Run base_run(const std::string& engine) {
  RunSettings settings;
  settings.allow_findings = true;
  return abut::Run(Model::from_text({.starter = base_starter, .engines = {engine}, .name = "base"}), settings);
}

/// What the run of this Engine deck says when it fails, in its first cycle or later.
std::string failure_of(const std::string& engine) {
  try {
    abut::Run run = base_run(engine);
    run.advance_to_end();
    return to_string(run.outcome());
  } catch (const RunError& error) { return error.what(); }
}

TEST(Stops, NameTheFirstNodeWhoseMotionIsNotFinite) {
  abut::Run run = base_run(base_engine);
  for (int i = 0; i < 5; ++i) run.advance();
  run.edit_velocities()[9].x = std::numeric_limits<double>::quiet_NaN();  // node 10
  EXPECT_THROW(run.advance_to_end(), RunError);
  EXPECT_EQ(run.outcome().kind, Outcome::Kind::failed);
  const std::string& message = run.outcome().message;
  EXPECT_NE(message.find("at cycle 5"), std::string::npos) << message;
  EXPECT_EQ(message.find("node 10 is the first with a motion that is not finite"), 0U) << message;
}

/// The limit of /STOP acts in the cycle that goes beyond it; the balance of this deck is better than 1 % and worse than 1e-9.
TEST(Stops, AtTheEnergyErrorOfTheDeck) {
  const std::string message = failure_of(with_line(base_engine, "/STOP", 1, "1e-9"));
  EXPECT_NE(message.find("beyond the limit of 1e-07 % of /STOP"), std::string::npos) << message;
  EXPECT_NE(message.find("; the fastest node is "), std::string::npos) << message;
  abut::Run good = base_run(with_line(base_engine, "/STOP", 1, "0.01"));
  good.advance_to_end();
  EXPECT_EQ(good.outcome().kind, Outcome::Kind::finished) << good.outcome().message;
}

TEST(Stops, AtTheMinimumStepOfAnElement) {
  const std::string message = failure_of(with_line(base_engine, "/DT/BRICK/STOP", 1, "0.9 1e-3"));
  EXPECT_NE(message.find("the time step of element 1 of part 1 fell to "), std::string::npos) << message;
  EXPECT_NE(message.find(", below the minimum 0.001 of /DT, at cycle 0"), std::string::npos) << message;
}

// A step that never gets to the end is an error at once, not a run that goes on for ever.
TEST(Stops, WhereTheStepDoesNotGetToTheEnd) {
  const std::string message = failure_of(with_line(base_engine, "/DT", 1, "1e-30 0"));
  EXPECT_EQ(message.find("the time step "), 0U) << message;
  EXPECT_NE(message.find(" does not get to the end time "), std::string::npos) << message;
  EXPECT_NE(message.find(" in 1e+13 cycles (cycle 0, time 0)"), std::string::npos) << message;
  const std::string limited = failure_of(with_line(base_engine, "/DT", 0, "/DTIX\n1e-30 1e-30\n/DT"));  // a first step that cannot grow
  EXPECT_NE(limited.find(" does not get to the end time "), std::string::npos) << limited;
}

TEST(Stops, AtTheAddedMassOfTheDeck) {
  const std::string scaled = with_line(base_engine, "/DT", 0, "/DT/NODA/CST\n0.9 1e-3\n/DT");
  EXPECT_NE(failure_of(with_line(scaled, "/STOP", 1, "0 0.01")).find("beyond the limit of 0.01 of /STOP at cycle "), std::string::npos);
  const std::string message = failure_of(with_line(scaled, "/STOP", 1, "0 0 0.01"));
  EXPECT_EQ(message.find("mass scaling has added more to node "), 0U) << message;
  EXPECT_NE(message.find(" than 0.01 times its mass, the nodal limit of /STOP at cycle "), std::string::npos) << message;
}

}  // namespace
}  // namespace abut
