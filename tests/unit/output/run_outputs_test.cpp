// All sinks together: the files of a run, and what is left when one of them fails.
#include "output/run_outputs.hpp"

#include <nlohmann/json.hpp>

#include "core/diagnostic.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using test::Scene;

/// Records its calls; throws where it is told to.
class Probe final : public cycle::Sink {
 public:
  Probe(std::string name, std::vector<std::string>& log, std::string throws_in = {})
      : name_(std::move(name)), log_(log), throws_in_(std::move(throws_in)) {}
  void begin(const cycle::Snapshot&) override { call("begin"); }
  void cycle(const cycle::Snapshot&) override { call("cycle"); }
  void end(const cycle::Outcome&) override { call("end"); }

 private:
  void call(const std::string& what) {
    log_.push_back(name_ + "." + what);
    if (throws_in_.find(what) != std::string::npos) throw RunError(name_ + " cannot " + what);
  }
  std::string name_;
  std::vector<std::string>& log_;
  std::string throws_in_;
};

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const RunError& e) { return e.what(); }
  return {};
}

TEST(SinkSet, CallsInOrderAndEndsAllWhateverFails) {
  std::vector<std::string> log;
  Scene scene;
  SinkSet sinks;
  sinks.add(std::make_unique<Probe>("a", log, "end"));
  sinks.add(std::make_unique<Probe>("b", log, "end"));
  sinks.add(std::make_unique<Probe>("c", log));
  sinks.begin(scene.snapshot());
  sinks.cycle(scene.snapshot());
  EXPECT_EQ(message_of([&] { sinks.end({}); }), "a cannot end");
  EXPECT_EQ(log, (std::vector<std::string>{"a.begin", "b.begin", "c.begin", "a.cycle", "b.cycle", "c.cycle", "a.end", "b.end", "c.end"}));
}

TEST(SinkSet, ASinkThatHasFailedSaysSoOnce) {
  std::vector<std::string> log;
  Scene scene;
  SinkSet sinks;
  sinks.add(std::make_unique<Probe>("a", log, "cycle end"));
  sinks.add(std::make_unique<Probe>("b", log));
  sinks.begin(scene.snapshot());
  EXPECT_EQ(message_of([&] { sinks.cycle(scene.snapshot()); }), "a cannot cycle");
  EXPECT_EQ(message_of([&] { sinks.end({cycle::Outcome::Kind::failed, "a cannot cycle", 1, 0.0}); }), "");
  EXPECT_EQ(log.back(), "b.end");
}

TEST(RunOutputs, ARunFillsItsFolderUnderTheNamesOfTheDesign) {
  const test::TemporaryFolder temporary;
  const RunFolder folder{temporary.path() / "a" / "new folder", "scene"};
  Scene scene;
  SinkSet sinks;
  add_run_outputs(sinks, folder, {}, {});
  cycle::Snapshot s = scene.snapshot();
  sinks.begin(s);
  s.history_due = s.animation_due = s.listing_due = true;
  sinks.cycle(s);
  sinks.end({});
  for (const char* file : {"scene.out", "scene_th.csv", "scene.pvd", "scene_anim/scene_00000.vtu", "run.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.directory / file)) << file;
  }
  EXPECT_EQ(nlohmann::json::parse(test::slurp(folder.manifest()))["outcome"]["kind"], "finished");
}

TEST(RunOutputs, AFullDiskDuringTheRunLeavesTheOtherOutputsComplete) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const test::TemporaryFolder temporary;
  const RunFolder folder{temporary.path(), "scene"};
  std::filesystem::create_symlink("/dev/full", folder.history());
  Scene scene;
  SinkSet sinks;
  add_run_outputs(sinks, folder, {}, {});
  const std::string message = message_of([&] { sinks.begin(scene.snapshot()); });
  EXPECT_EQ(message, "cannot write '" + folder.history().string() + "': No space left on device");
  EXPECT_EQ(message_of([&] { sinks.end({cycle::Outcome::Kind::failed, message, 0, 0.0}); }), "");
  EXPECT_NE(test::slurp(folder.listing()).find("The run failed at time 0 after 0 cycles: " + message), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(test::slurp(folder.manifest()))["outcome"]["message"], message);
}

TEST(RunOutputs, AFolderThatCannotBeMadeIsNamed) {
  const test::TemporaryFolder temporary;
  write_atomically(temporary.path() / "file", "");
  const RunFolder folder{temporary.path() / "file" / "run", "scene"};
  EXPECT_EQ(message_of([&] {
              SinkSet sinks;
              add_run_outputs(sinks, folder, {}, {});
            }),
            "cannot create the folder '" + folder.directory.string() + "': Not a directory");
}

}  // namespace
}  // namespace abut::output
