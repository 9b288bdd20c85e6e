// Checkpoints: a run that goes on has the bits of one that never stopped; a file that is not whole, or not of this model, is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "abut/run.hpp"
#include "output/files.hpp"
#include "state/archive.hpp"
#include "state/checkpoint.hpp"
#include "unit/model/deck_text.hpp"
#include "unit/run/folder.hpp"

namespace abut {
namespace {

using model::base_deck::base_engine;
using model::base_deck::base_starter;
using model::base_deck::integers;
using model::base_deck::reals;
using model::base_deck::with_line;

void put(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Model base_model(const std::string& starter = base_starter, const std::string& engine = base_engine) {
  return Model::from_text({.starter = starter, .engines = {engine}, .name = "base"});
}

RunSettings settings_of(Rules rules, int threads = 1) {
  RunSettings settings;
  settings.threads = threads;
  settings.choices.rules = rules;
  settings.allow_findings = true;
  return settings;
}

/// Everything that a user can compare of two runs.
void expect_same(const Run& a, const Run& b, const std::string& what) {
  ASSERT_EQ(a.cycle(), b.cycle()) << what;
  EXPECT_EQ(a.time(), b.time()) << what;
  EXPECT_EQ(a.hash(), b.hash()) << what;
  EXPECT_EQ(std::memcmp(&a.balance(), &b.balance(), sizeof(Balance)), 0) << what;
  ASSERT_EQ(a.interfaces().size(), b.interfaces().size());
  for (std::size_t i = 0; i < a.interfaces().size(); ++i) {
    EXPECT_EQ(a.interfaces()[i].normal_impulse, b.interfaces()[i].normal_impulse) << what;
    EXPECT_EQ(a.interfaces()[i].cx, b.interfaces()[i].cx) << what;
  }
  EXPECT_EQ(a.history().names, b.history().names) << what;
  EXPECT_EQ(a.history().values, b.history().values) << what;
  for (const std::string& name : abut::Run::node_field_names()) {
    const std::vector<double> one = a.node_field(name), other = b.node_field(name);
    ASSERT_EQ(one.size(), other.size()) << what << ' ' << name;
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(double)), 0) << what << ' ' << name;  // bits: some are NaN
  }
}

/// Runs to the end; at some cycles a copy goes on from a checkpoint in memory of its own and must end alike.
void expect_restarts(const Model& model, const RunSettings& settings, const std::vector<std::int64_t>& cycles, const std::string& what) {
  const Folder folder;
  abut::Run run(model, settings);
  run.advance_to_end([&](Run& r) {
    for (const std::int64_t c : cycles) {
      if (r.cycle() == c) r.save(folder.file((std::to_string(c) + ".rst").c_str()));
    }
    return true;
  });
  ASSERT_EQ(run.outcome().kind, Outcome::Kind::finished) << what << ": " << run.outcome().message;
  ASSERT_GT(run.cycle(), cycles.back()) << what;
  for (const std::int64_t c : cycles) {
    RunSettings other = settings;
    other.threads = settings.threads == 1 ? 3 : 1;
    abut::Run again = abut::Run::load(model, folder.file((std::to_string(c) + ".rst").c_str()), other);
    EXPECT_EQ(again.cycle(), c);
    again.advance_to_end();
    expect_same(run, again, what + " from cycle " + std::to_string(c));
  }
}

TEST(Restart, EveryKindOfConditionAndInterfaceGoesOnWithTheSameBits) {
  const Model model = base_model();
  for (const Rules rules : {Rules::standard, Rules::reference}) {
    expect_restarts(model, settings_of(rules), {1, 7, 60}, rules == Rules::standard ? "standard" : "reference");
  }
}

TEST(Restart, DeletedElementsScaledMassesSensorsAndInstrumentsGoOnWithTheSameBits) {
  // The plates tear at a small plastic strain; the lid becomes rigid while the run goes on, with a main node at rest.
  std::string starter = with_line(base_starter, "/MAT/PLAS_JOHNS/2", 4,
                                  "                 0.3                 0.5                 0.5              0.0002                   0");
  starter = with_line(starter, "/GRNOD/NODE/2", 2, integers({"9", "10", "11", "12", "13", "14", "15", "16"}));
  starter = with_line(starter, "/RBODY/1", 2,
                      "        30         1         0         0                1E-6         3         0         0         0");
  starter = with_line(starter, "/INTER/TYPE5/2", 2, "         4         3                                                 0         1");
  starter.replace(
      starter.find("/TH/PART/2"), 0,
      "/ACCEL/5\nsensor\n" + integers({"13", "1", ""}) + reals({"1.65"}) + "\n/TH/ACCEL/15\nacc\nDEF\n" + integers({"5"}) + "\n");
  const std::string engine = std::string(base_engine) + "/DT/NODA/CST\n0.9 1.5e-4\n";
  const Model model = base_model(starter, engine);
  expect_restarts(model, settings_of(Rules::standard), {3, 80, 200}, "deleted");
}

TEST(Restart, BodiesHeldBesideTheirCentreGoOnWithTheSameBits) {
  std::string starter = with_line(base_starter, "/RBODY/1", 2,
                                  "        30         0         0         0                1E-6         3         0         3         0");
  starter.replace(starter.find("/INIVEL/TRA/1"), 0,
                  "/BCS/2\npin\n   010 000         0         5\n/IMPVEL/2\npull\n" + integers({"1", "X", "0", "0", "5"}) + "\n" +
                      reals({"1", "3", "0", "1"}) + "\n");
  const Model model = base_model(starter);
  abut::Run run(model, settings_of(Rules::standard));
  while (run.time() < 0.04) run.advance();
  const auto main = static_cast<std::size_t>(std::find(model.node_ids().begin(), model.node_ids().end(), 30) - model.node_ids().begin());
  EXPECT_NEAR(run.velocities()[main].x, 3.0 * (run.time() - 0.5 * run.step()), 1e-12);
  EXPECT_LT(std::fabs(run.displacements()[main].y), 1e-12);
  EXPECT_GT(norm(run.angular_velocities()[main]), 1e-3);
  expect_restarts(model, settings_of(Rules::standard), {1, 7, 60}, "held");
}

TEST(Restart, VelocitiesThatWereChangedAreInTheCheckpoint) {
  const Folder folder;
  const Model model = base_model();
  abut::Run run(model, settings_of(Rules::standard));
  for (int i = 0; i < 20; ++i) run.advance();
  run.edit_velocities()[9].x += 1.0;
  run.save(folder.file("edited.rst"));
  abut::Run again = abut::Run::load(model, folder.file("edited.rst"), settings_of(Rules::standard));
  for (int i = 0; i < 20; ++i) {
    run.advance();
    again.advance();
  }
  expect_same(run, again, "edited");
}

std::string message_of_load(const Model& model, const std::filesystem::path& file, const RunSettings& settings) {
  try {
    (void)abut::Run::load(model, file, settings);
    return {};
  } catch (const RunError& error) { return error.what(); }
}

TEST(Restart, OtherModelsRulesAndFilesAreRefusedByName) {
  const Folder folder;
  const RunSettings settings = settings_of(Rules::standard);
  const auto file = folder.file("a.rst");
  {
    abut::Run run(base_model(), settings);
    run.advance();
    run.save(file);
  }
  EXPECT_EQ(message_of_load(base_model(), file, settings), "");
  const Model other =
      base_model(with_line(base_starter, "/NODE", 3, "         3                   1                1.01                   0"));
  EXPECT_NE(message_of_load(other, file, settings).find("it is of another model"), std::string::npos);
  EXPECT_NE(message_of_load(base_model(), file, settings_of(Rules::reference)).find("another rule set"), std::string::npos);
  EXPECT_NE(message_of_load(base_model(), folder.file("none.rst"), settings).find("No such file"), std::string::npos);
  put(file, {});
  EXPECT_NE(message_of_load(base_model(), file, settings).find("not a checkpoint of abut"), std::string::npos);
}

std::string message_of_save(abut::Run& run, const std::filesystem::path& file) {
  try {
    run.save(file);
    return {};
  } catch (const RunError& error) { return error.what(); }
}

/// A caller's folder: save() writes the file that it was given and touches no other.
TEST(Restart, ACheckpointOfTheCallerReplacesOneFileOnly) {
  const Folder folder;
  const Model model = base_model();
  const RunSettings settings = settings_of(Rules::standard);
  abut::Run run(model, settings);
  const std::vector<std::byte> own(3, std::byte{7});
  put(folder.file("a_previous.rst"), own);
  run.advance();
  run.save(folder.file("a.rst"));
  run.advance();
  run.save(folder.file("a.rst"));
  EXPECT_EQ(abut::Run::load(model, folder.file("a.rst"), settings).cycle(), 2);
  EXPECT_EQ(output::read_bytes(folder.file("a_previous.rst")), own);
  std::filesystem::create_symlink("a.rst", folder.file("link"));
  run.advance();
  run.save(folder.file("link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(abut::Run::load(model, folder.file("a.rst"), settings).cycle(), 3);
}

TEST(Restart, ACheckpointTakesThePlaceOfNothingButAFile) {
  const Folder folder;
  abut::Run run(base_model(), settings_of(Rules::standard));
  run.advance();
  std::filesystem::create_directory(folder.file("folder"));
  std::filesystem::create_symlink("folder", folder.file("link"));
  std::filesystem::create_symlink("none", folder.file("nowhere"));
  for (const auto& [name, reason] :
       {std::pair{"folder", "Is a directory"}, std::pair{"link", "Is a directory"}, std::pair{"nowhere", "No such file or directory"}}) {
    const auto file = folder.file(name);
    EXPECT_EQ(message_of_save(run, file), "cannot write '" + file.string() + "': " + reason);
  }
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("folder")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")) && std::filesystem::is_symlink(folder.file("nowhere")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("")), std::filesystem::directory_iterator()), 3);
}

/// Damaged files: every one is refused with a message, whatever was changed.
TEST(Restart, EveryFlippedBitAndEveryCutIsFound) {
  const Folder folder;
  const Model model = base_model();
  const RunSettings settings = settings_of(Rules::standard);
  abut::Run run(model, settings);
  for (int i = 0; i < 70; ++i) run.advance();
  run.save(folder.file("good.rst"));
  const std::vector<std::byte> good = output::read_bytes(folder.file("good.rst"));
  ASSERT_NO_THROW((void)state::unseal(good));
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bad = good;
    for (std::uint64_t flips = 1 + random() % 3; flips > 0; --flips) bad[random() % bad.size()] ^= std::byte(1U << random() % 8);
    if (bad == good) continue;
    EXPECT_THROW((void)state::unseal(bad), state::ArchiveError);
  }
  for (int i = 0; i < 300; ++i) {
    const std::size_t length = random() % good.size();
    EXPECT_THROW((void)state::unseal(std::span(good).first(length)), state::ArchiveError) << length;
  }
}

/// Changed files whose checksum is right: nothing is believed that the model contradicts, and nothing crashes.
TEST(Restart, AFileWithARightChecksumIsNotTrusted) {
  const Folder folder;
  const Model model = base_model();
  RunSettings settings = settings_of(Rules::standard);
  settings.record_history = false;
  abut::Run run(model, settings);
  for (int i = 0; i < 70; ++i) run.advance();
  run.save(folder.file("good.rst"));
  const std::vector<std::byte> file = output::read_bytes(folder.file("good.rst"));
  const std::span<const std::byte> content = state::unseal(file);
  std::mt19937_64 random(11);
  int refused = 0;
  constexpr int tries = 300;
  for (int i = 0; i < tries; ++i) {
    std::vector<std::byte> changed(content.begin(), content.end());
    switch (random() % 3) {
      case 0:
        changed[random() % changed.size()] ^= std::byte(1U << random() % 8);
        break;
      case 1:
        changed.resize(random() % changed.size());
        break;
      default: {  // a stretch of noise
        const std::size_t at = random() % changed.size();
        for (std::size_t k = at; k < std::min(changed.size(), at + 64); ++k) changed[k] = std::byte(random() & 0xff);
      }
    }
    std::vector<std::byte> sealed;
    state::Sealer sealer([&sealed](std::span<const std::byte> piece) { sealed.insert(sealed.end(), piece.begin(), piece.end()); });
    sealer.add(changed);
    sealer.finish();
    put(folder.file("changed.rst"), sealed);
    try {
      abut::Run again = abut::Run::load(model, folder.file("changed.rst"), settings);
      again.advance();  // what was changed is a number that no check can know
    } catch (const RunError&) { ++refused; }
  }
  EXPECT_GT(refused, tries / 2);
}

}  // namespace
}  // namespace abut
