// Runs that end within a cycle: no checkpoint is made of what they leave, and the last one before goes on as if nothing had been.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "abut/run.hpp"
#include "support/size_limit.hpp"
#include "unit/model/deck_text.hpp"
#include "unit/run/folder.hpp"

namespace abut {
namespace {

using model::base_deck::base_engine;
using model::base_deck::base_starter;
using model::base_deck::with_line;

RunSettings settings_in(const std::filesystem::path& output) {
  RunSettings settings;
  settings.threads = 1;
  settings.allow_findings = true;
  settings.output = output;
  return settings;
}

/// Folder of a deck, for a run that is resumed.
std::filesystem::path base_deck_in(const Folder& folder) {
  std::ofstream(folder.file("base_0000.rad")) << base_starter;
  std::ofstream(folder.file("base_0001.rad")) << base_engine;
  return folder.file("base_0000.rad");
}

std::string failure_of(Run& run) {
  try {
    run.advance_to_end();
  } catch (const RunError& error) { return error.what(); }
  return {};
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The disk is full for the call log, which is written while the forces of a cycle are found, and has room for all else.
TEST(BrokenOff, WithoutRoomForACallLogTheLastCheckpointStays) {
  const Folder folder;
  const Model model = Model::read(base_deck_in(folder));
  RunSettings settings = settings_in(folder.file("whole"));
  settings.checkpoint_every = 50;
  settings.recordings.push_back({.interface_id = 1});
  abut::Run whole(model, settings);
  whole.advance_to_end();
  const auto size = std::filesystem::file_size(settings.output / "base_contact_1.calls");
  ASSERT_LT(2 * std::filesystem::file_size(settings.output / "base.rst"), size);

  settings.output = folder.file("cut");
  std::int64_t stopped = 0;
  {
    const SizeLimit limit(size / 2);
    abut::Run run(model, settings);
    EXPECT_EQ(failure_of(run), "contact: the call log cannot be written");
    EXPECT_TRUE(run.is_over());
    EXPECT_EQ(run.outcome().kind, Outcome::Kind::failed);
    EXPECT_FALSE(run.advance());
    EXPECT_THROW(run.save(folder.file("mine.rst")), RunError);
    EXPECT_FALSE(std::filesystem::exists(folder.file("mine.rst")));
    stopped = run.cycle();
  }
  EXPECT_NE(text_of(settings.output / "base.out").find("contact: the call log cannot be written"), std::string::npos);
  abut::Run again = abut::Run::resume(settings.output);
  EXPECT_EQ(again.cycle(), stopped - stopped % 50);
  again.advance_to_end();
  EXPECT_EQ(again.hash(), whole.hash());
  EXPECT_EQ(again.balance().err, whole.balance().err);
  EXPECT_EQ(text_of(settings.output / "base_th.csv"), text_of(folder.file("whole") / "base_th.csv"));
}

// A limit of the Engine deck ends a run within a cycle, too.
TEST(BrokenOff, AFailedRunIsNotSaved) {
  const Folder folder;
  const Model model = Model::from_text({.starter = base_starter, .engines = {with_line(base_engine, "/STOP", 1, "1e-9")}, .name = "base"});
  abut::Run run(model, settings_in({}));
  EXPECT_NE(failure_of(run), "");
  std::string message;
  try {
    run.save(folder.file("base.rst"));
  } catch (const RunError& error) { message = error.what(); }
  EXPECT_NE(message.find("base.rst' is not written: the run broke off within cycle "), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder.file("base.rst")));
}

// Stopped or interrupted before the first cycle: what was left by an earlier run is gone, and every file says what it is.
TEST(BrokenOff, BeforeTheFirstCycleFilesAreComplete) {
  const Model model = Model::from_text({.starter = base_starter, .engines = {base_engine}, .name = "base"});
  for (const bool interrupted : {false, true}) {
    const Folder folder;
    const RunSettings first = settings_in(folder.file("a"));
    {
      abut::Run earlier(model, first);
      ASSERT_TRUE(earlier.advance());
    }
    const std::string listing = text_of(first.output / "base.out"), history = text_of(first.output / "base_th.csv");
    std::filesystem::create_directories(first.output / "base_anim");
    for (const char* old : {"base.pvd", "base_contact.vtu", "base_anim/base_0007.vtu"}) std::ofstream(first.output / old) << "old";

    std::atomic<bool> stop = interrupted;
    RunSettings again = first;
    again.interrupt = &stop;
    abut::Run run(model, again);
    if (interrupted) {
      EXPECT_FALSE(run.advance());
    } else {
      run.finish();
    }
    EXPECT_EQ(run.cycle(), 0);
    for (const char* old : {"base.pvd", "base_contact.vtu", "base_anim/base_0007.vtu"}) {
      EXPECT_FALSE(std::filesystem::exists(first.output / old)) << old;
    }
    EXPECT_EQ(text_of(first.output / "base_th.csv"), history.substr(0, history.find('\n') + 1));
    const std::string said = text_of(first.output / "base.out"), head = listing.substr(0, listing.find("Columns of"));
    EXPECT_EQ(said.substr(0, head.size()), head);
    EXPECT_EQ(said.find("Energies"), std::string::npos);
    const std::string manifest = text_of(first.output / "run.json");
    for (const char* part : {"\"model\"", "\"settings\"", "\"files\"", "\"fingerprint\""}) {
      EXPECT_NE(manifest.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(manifest.find("\"energies\""), std::string::npos) << "there are none before a cycle";
    EXPECT_NE(manifest.find(interrupted ? "interrupted by the user" : "stopped by the caller"), std::string::npos);
  }
}

// A checkpoint of cycle 0 in the run's own folder holds files in which nothing stood.
TEST(BrokenOff, AResumeFromBeforeTheFirstCycleWritesTheWholeHistory) {
  const Folder folder;
  std::ofstream(folder.file("base_0000.rad")) << base_starter;
  std::ofstream(folder.file("base_0001.rad")) << base_engine;
  const Model model = Model::read(folder.file("base_0000.rad"));
  {
    abut::Run whole(model, settings_in(folder.file("whole")));
    whole.advance_to_end();
    abut::Run run(model, settings_in(folder.file("a")));
    run.save(folder.file("a") / "base.rst");
  }
  abut::Run run = abut::Run::resume(folder.file("a"), {});
  EXPECT_EQ(run.cycle(), 0);
  run.advance_to_end();
  EXPECT_EQ(text_of(folder.file("a") / "base_th.csv"), text_of(folder.file("whole") / "base_th.csv"));
}

// ~Run ends a run that goes on; so does the run that takes its place.
TEST(BrokenOff, AnotherRunInItsPlaceEndsTheFirst) {
  const Folder folder;
  const Model model = Model::from_text({.starter = base_starter, .engines = {base_engine}, .name = "base"});
  abut::Run run(model, settings_in(folder.file("a")));
  run.advance();
  run = abut::Run(model, settings_in(folder.file("b")));
  EXPECT_NE(text_of(folder.file("a") / "run.json").find("stopped by the caller"), std::string::npos);
  EXPECT_EQ(run.output(), folder.file("b"));
  EXPECT_TRUE(run.advance());
}

}  // namespace
}  // namespace abut
