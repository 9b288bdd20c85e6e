// run.json parses at every stage and says what ran, how it ended and how well the energy closed.
#include "output/manifest.hpp"

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "scene.hpp"

namespace abut::output {
namespace {

using nlohmann::json;
using test::Scene;

class ManifestTest : public ::testing::Test {
 protected:
  json read() { return json::parse(test::slurp(folder_.manifest())); }
  test::TemporaryFolder temporary_;
  RunFolder folder_{temporary_.path(), "scene"};
  Scene scene_;
};

TEST_F(ManifestTest, ARunThatWasKilledLeavesWhatItWas) {
  RunInfo info;
  info.version = "1.2.3";
  info.profile = "reference";
  info.threads = 3;
  info.decks = {"a_0000.rad", "a_0001.rad"};
  info.findings.push_back({Severity::warning, "deck.odd", {"a_0000.rad", 12, "/INTER/TYPE3/1", "Gap", 41, 60}, "odd"});
  Manifest sink(folder_, info, {});
  sink.begin(scene_.snapshot());
  const json j = read();
  EXPECT_EQ(j["outcome"]["kind"], "running");
  EXPECT_EQ(j["abut"]["version"], "1.2.3");
  EXPECT_EQ(j["settings"]["profile"], "reference");
  EXPECT_EQ(j["settings"]["threads"], 3);
  EXPECT_TRUE(j["settings"]["interfaces"].empty());
  EXPECT_EQ(j["decks"], json({"a_0000.rad", "a_0001.rad"}));
  EXPECT_EQ(j["model"]["nodes"], 12);
  EXPECT_EQ(j["model"]["bricks"], 3);
  EXPECT_EQ(j["model"]["units"]["length"], "m");
  EXPECT_EQ(j["model"]["parts"][1]["id"], 22);
  EXPECT_EQ(j["model"]["parts"][1]["mass"], 19.0);
  EXPECT_EQ(j["model"]["interfaces"][0]["type"], "TYPE3");
  const json finding = {{"severity", "warning"},       {"code", "deck.odd"}, {"message", "odd"},   {"file", "a_0000.rad"}, {"line", 12},
                        {"keyword", "/INTER/TYPE3/1"}, {"field", "Gap"},     {"columns", {41, 60}}};
  EXPECT_EQ(j["findings"], json::array({finding}));
}

TEST_F(ManifestTest, TheEndAddsOutcomeTimingsEnergiesWorstAndHashes) {
  Manifest sink(folder_, {}, [] { return std::vector<PhaseTime>{{"read", 0.25}, {"run", 2.0}}; });
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  const std::vector<double> errors{0.0, -0.04, 0.03};
  for (std::size_t k = 0; k < errors.size(); ++k) {
    scene_.state.times.t = 0.5 * static_cast<double>(k);
    scene_.state.times.cycle = static_cast<std::int64_t>(k);
    scene_.balance.err = errors[k];
    scene_.balance.cx = 1.0 + static_cast<double>(k);
    scene_.balance.ie = 10.0 * static_cast<double>(k);
    s.hash_due = k != 1;
    s.state_hash = 0xffffffffffffff00ULL + k;
    sink.cycle(s);
  }
  sink.end({cycle::Outcome::Kind::interrupted, "SIGINT", 3, 1.0});
  const json j = read();
  EXPECT_EQ(j["outcome"]["kind"], "interrupted");
  EXPECT_EQ(j["outcome"]["message"], "SIGINT");
  EXPECT_EQ(j["outcome"]["cycles"], 3);
  EXPECT_EQ(j["timings"], json({{{"name", "read"}, {"seconds", 0.25}}, {{"name", "run"}, {"seconds", 2.0}}}));
  EXPECT_EQ(j["energies"]["IE"], 20.0);
  EXPECT_EQ(j["energies"]["ERR"], 0.03);
  EXPECT_EQ(j["worst"]["ERR"], json({{"value", -0.04}, {"time", 0.5}}));
  EXPECT_EQ(j["worst"]["CX"], json({{"value", 3.0}, {"time", 1.0}}));
  EXPECT_EQ(j["hashes"], json({{{"cycle", 0}, {"state", "ffffffffffffff00"}}, {{"cycle", 2}, {"state", "ffffffffffffff02"}}}));
  EXPECT_EQ(j["model"]["nodes"], 12);  // what begin() wrote is kept
}

TEST_F(ManifestTest, TimesArePhaseByPhaseThoseOfAllSessions) {
  const auto timings = [](double share) {
    return [share] {
      return std::vector<PhaseTime>{{"read", 0.25}, {"elements", share}, {"elements bricks", 0.5 * share}, {"run", 2 * share}};
    };
  };
  state::Archive first, second;
  {
    Manifest sink(folder_, {}, timings(1.0));
    sink.begin(scene_.snapshot());
    sink.persist(first);
  }
  {
    Manifest sink(folder_, {}, timings(8.0));
    state::Archive from(first.bytes());
    sink.persist(from);
    sink.begin(scene_.snapshot());
    sink.persist(second);
  }
  Manifest sink(folder_, {}, timings(64.0));
  state::Archive from(second.bytes());
  sink.persist(from);
  sink.begin(scene_.snapshot());
  sink.end({cycle::Outcome::Kind::finished, "", 3, 1.0});
  std::map<std::string, double> seconds;
  const json j = read();
  for (const json& phase : j["timings"]) seconds[phase["name"]] = phase["seconds"];
  EXPECT_EQ(seconds, (std::map<std::string, double>{{"read", 0.75}, {"elements", 73.0}, {"elements bricks", 36.5}, {"run", 146.0}}));
}

TEST_F(ManifestTest, ABadTitleAndANumberThatIsNoneStillGiveJson) {
  scene_.model.title = "caf\xe9";  // Latin-1
  Manifest sink(folder_, {}, {});
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  scene_.state.times.t = 0.5;
  scene_.balance.err = std::numeric_limits<double>::quiet_NaN();
  sink.cycle(s);
  scene_.balance.err = 0.5;
  sink.cycle(s);
  sink.end({});
  const json j = read();
  EXPECT_EQ(j["model"]["title"], "caf\xef\xbf\xbd");
  EXPECT_TRUE(j["worst"]["ERR"]["value"].is_null());  // once not a number, the worst there is
  EXPECT_EQ(j["worst"]["ERR"]["time"], 0.5);
}

}  // namespace
}  // namespace abut::output
