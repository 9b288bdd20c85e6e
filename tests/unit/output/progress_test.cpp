// The console line: content, throttling, and where it keeps quiet.
#include "output/progress.hpp"

#include "scene.hpp"

namespace abut::output {
namespace {

class ProgressTest : public ::testing::Test {
 protected:
  Progress make(bool terminal) {
    return Progress(
        {.terminal = terminal, .min_interval = 0.5}, [this](std::string_view s) { written_.emplace_back(s); }, [this] { return now_; });
  }
  double now_ = 100.0;
  std::vector<std::string> written_;
  test::Scene scene_;
};

TEST_F(ProgressTest, SaysTimeStepControllerErrorRateAndTimeLeft) {
  scene_.model.controls.t_end = 1.0;
  Progress sink = make(false);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  now_ = 130.0;  // a quarter in 30 s
  scene_.state.times = {.cycle = 1000, .t = 0.25, .h_minus = 0.0, .h_plus = 2.5e-4};
  scene_.balance.err = -0.0123;
  s.controller = {cycle::StepController::Kind::shell, 31};
  s.listing_due = true;
  sink.cycle(s);
  ASSERT_EQ(written_.size(), 1U);
  // 6 elements x 1000 cycles / 30 s
  EXPECT_EQ(written_[0], "cycle     1000  time 0.25        dt 0.00025    by SHELL 31  error -1.23 %  200 element-cycles/s  1:30 left\n");
}

TEST_F(ProgressTest, IntoAFileOnlyListedCyclesAndNotTooOften) {
  Progress sink = make(false);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  sink.cycle(s);
  EXPECT_TRUE(written_.empty());
  s.listing_due = true;
  sink.cycle(s);
  EXPECT_EQ(written_.size(), 1U);
  now_ += 0.4;
  sink.cycle(s);
  EXPECT_EQ(written_.size(), 1U);
  now_ += 0.1;
  sink.cycle(s);
  EXPECT_EQ(written_.size(), 2U);
  sink.end({});
  EXPECT_EQ(written_.size(), 2U);
}

TEST_F(ProgressTest, OnATerminalOneLineIsRewrittenAndLeftWhole) {
  Progress sink = make(true);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  sink.cycle(s);  // needs no listing
  ASSERT_EQ(written_.size(), 1U);
  EXPECT_TRUE(written_[0].starts_with("\rcycle "));
  EXPECT_TRUE(written_[0].ends_with("- left\x1b[K"));  // nothing done yet: no estimate
  sink.end({});
  EXPECT_EQ(written_.back(), "\n");
}

}  // namespace
}  // namespace abut::output
