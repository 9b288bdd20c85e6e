// NAME_th.csv: names of the design, values of the snapshot to the last bit, rows that survive a kill.
#include "output/time_history.hpp"

#include <map>
#include <set>
#include <tuple>

#include "core/diagnostic.hpp"
#include "model/th_variables.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using test::Scene;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

struct Table {
  std::vector<std::string> names;
  std::vector<std::map<std::string, double>> rows;
};

Table read_table(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  Table table;
  std::getline(in, line);
  table.names = split(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    EXPECT_EQ(cells.size(), table.names.size());
    std::map<std::string, double> row;
    for (std::size_t k = 0; k < cells.size(); ++k) row[table.names[k]] = std::stod(cells[k]);
    table.rows.push_back(row);
  }
  return table;
}

model::ThRequest request(model::ThKind kind, Id id, Index index, std::vector<std::string> variables, Index skew = no_index) {
  model::ThRequest r;
  r.kind = kind;
  r.id = id;
  r.index = index;
  r.skew = skew;
  r.variables = std::move(variables);
  return r;
}

class TimeHistoryTest : public ::testing::Test {
 protected:
  /// Writes one row of the scene and reads it back.
  std::map<std::string, double> row() {
    TimeHistory sink(folder_);
    cycle::Snapshot s = scene_.snapshot();
    sink.begin(s);
    s.history_due = true;
    sink.cycle(s);
    sink.end({});
    const Table table = read_table(folder_.history());
    EXPECT_EQ(table.rows.size(), 1U);
    names_ = table.names;
    return table.rows.at(0);
  }

  test::TemporaryFolder temporary_;
  RunFolder folder_{temporary_.path(), "scene"};
  Scene scene_;
  std::vector<std::string> names_;
};

TEST_F(TimeHistoryTest, BalanceColumnsComeFirstUnderTheNamesOfTheDesign) {
  scene_.state.times.t = 0.125;
  scene_.state.times.h_plus = 1e-6;
  scene_.balance = {.ie = 1.0,
                    .he = 2.0,
                    .ke = 3.0,
                    .ker = 4.0,
                    .ce = 5.0,
                    .fw = 6.0,
                    .dw = 7.0,
                    .cx = 8.0,
                    .extw = 9.0,
                    .xe = 10.0,
                    .err = 1.0 / 3.0,
                    .ledger = -1e-17,
                    .momentum = {12.0, 13.0, 14.0}};
  const auto r = row();
  const std::vector<std::string> expected{"time",          "GLOBAL/IE",   "GLOBAL/HE",   "GLOBAL/KE",   "GLOBAL/KER", "GLOBAL/CE",
                                          "GLOBAL/FW",     "GLOBAL/DW",   "GLOBAL/CX",   "GLOBAL/EXTW", "GLOBAL/XE",  "GLOBAL/ERR",
                                          "GLOBAL/LEDGER", "GLOBAL/XMOM", "GLOBAL/YMOM", "GLOBAL/ZMOM", "GLOBAL/DT"};
  ASSERT_GE(names_.size(), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), names_.begin()));
  const std::vector<double> values{0.125, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1.0 / 3.0, -1e-17, 12, 13, 14, 1e-6};
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_EQ(r.at(expected[k]), values[k]) << expected[k];
}

TEST_F(TimeHistoryTest, NodeVariablesAreTheNodalArrays) {
  scene_.model.th_requests.push_back(request(model::ThKind::node, 105, 4, {"DX", "DY", "DZ", "VX", "AX", "AZ", "VRY", "ARZ", "X", "Z"}));
  const auto r = row();
  const state::State& s = scene_.state;
  EXPECT_EQ(r.at("NODE/105/DX"), s.u[4].x);
  EXPECT_EQ(r.at("NODE/105/DY"), s.u[4].y);
  EXPECT_EQ(r.at("NODE/105/DZ"), s.u[4].z);
  EXPECT_EQ(r.at("NODE/105/VX"), s.v[4].x);
  EXPECT_EQ(r.at("NODE/105/AX"), s.a[4].x);
  EXPECT_EQ(r.at("NODE/105/AZ"), s.a[4].z);
  EXPECT_EQ(r.at("NODE/105/VRY"), s.w[4].y);
  EXPECT_EQ(r.at("NODE/105/ARZ"), s.alpha[4].z);
  EXPECT_EQ(r.at("NODE/105/X"), s.x[4].x);
  EXPECT_EQ(r.at("NODE/105/Z"), s.x[4].z);
}

TEST_F(TimeHistoryTest, ASkewTurnsVectorsAndASecondSkewHasItsOwnName) {
  model::Skew fixed;
  fixed.id = 9;
  fixed.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
  scene_.model.skews.push_back(fixed);
  scene_.model.th_requests.push_back(request(model::ThKind::node, 105, 4, {"DX"}));
  scene_.model.th_requests.push_back(request(model::ThKind::node, 105, 4, {"DX", "DY", "DZ", "X"}, 0));
  scene_.model.th_requests.push_back(request(model::ThKind::node, 101, 0, {"DX"}, 0));
  scene_.model.th_requests.push_back(request(model::ThKind::node, 101, 0, {"DX"}));
  const auto r = row();
  EXPECT_EQ(r.at("NODE/101/DX"), scene_.state.u[0].y);
  EXPECT_EQ(r.at("NODE/101:0/DX"), scene_.state.u[0].x);
  EXPECT_EQ(r.at("NODE/105/DX"), scene_.state.u[4].x);
  EXPECT_EQ(r.at("NODE/105:9/DX"), scene_.state.u[4].y);
  EXPECT_EQ(r.at("NODE/105:9/DY"), -scene_.state.u[4].x);
  EXPECT_EQ(r.at("NODE/105:9/DZ"), scene_.state.u[4].z);
  EXPECT_EQ(r.at("NODE/105:9/X"), scene_.state.x[4].x);
}

TEST_F(TimeHistoryTest, AMovingSkewFollowsItsNodesForEachDirectionFlag) {
  // N1, N2, N3 turned by a quarter about z: first axis global y; the plane's other axis global -x; third global z.
  scene_.state.x[0] = {5, 5, 5};
  scene_.state.x[1] = {5, 7, 5};
  scene_.state.x[3] = {4, 6, 5};
  const Vec3 d = scene_.state.u[4];
  for (int flag = 0; flag < 3; ++flag) {
    scene_.model.skews = {{.id = 9, .nodes = {0, 1, 3}, .direction = flag}};
    scene_.model.th_requests = {request(model::ThKind::node, 105, 4, {"DX", "DY", "DZ"}, 0)};
    const auto r = row();
    const std::array<std::string, 3> name{"NODE/105/DX", "NODE/105/DY", "NODE/105/DZ"};
    const auto f = static_cast<std::size_t>(flag);
    EXPECT_DOUBLE_EQ(r.at(name[f]), d.y) << flag;
    EXPECT_DOUBLE_EQ(r.at(name[(f + 1) % 3]), -d.x) << flag;
    EXPECT_DOUBLE_EQ(r.at(name[(f + 2) % 3]), d.z) << flag;
  }
}

TEST_F(TimeHistoryTest, PartVariables) {
  scene_.parts[1] = {
      .ie = 1.5, .he = 2.5, .sums = {.kinetic_energy = 3.5, .rotational_energy = 4.5, .mass = 2.0, .momentum = {6, 7, 8}}, .eroded = 3};
  scene_.model.th_requests.push_back(
      request(model::ThKind::part, 22, 1, {"IE", "KE", "XMOM", "YMOM", "ZMOM", "MASS", "HE", "RKE", "ERODED", "VX", "VZ"}));
  const auto r = row();
  EXPECT_EQ(r.at("PART/22/IE"), 1.5);
  EXPECT_EQ(r.at("PART/22/HE"), 2.5);
  EXPECT_EQ(r.at("PART/22/KE"), 3.5);
  EXPECT_EQ(r.at("PART/22/RKE"), 4.5);
  EXPECT_EQ(r.at("PART/22/MASS"), 2.0);
  EXPECT_EQ(r.at("PART/22/XMOM"), 6.0);
  EXPECT_EQ(r.at("PART/22/YMOM"), 7.0);
  EXPECT_EQ(r.at("PART/22/ZMOM"), 8.0);
  EXPECT_EQ(r.at("PART/22/ERODED"), 3.0);
  EXPECT_EQ(r.at("PART/22/VX"), 3.0);
  EXPECT_EQ(r.at("PART/22/VZ"), 4.0);
}

TEST_F(TimeHistoryTest, EveryInterfaceHasForcesImpulsesAndEnergiesAlsoWhenNoGroupNamesIt) {
  scene_.interfaces[0] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, 13, 14, 15, 16, 0, 17, 0, no_index, 0.1, 0.2, {0.75, 0.5}, {}, {}};
  scene_.interfaces[1] = {{-1, -2, -3}, {-4, -5, -6}, {-7, -8, -9}, {-10, -11, -12}, -13, -14, -15, -16, 0, 18, 0,
                          no_index,     0.3,          0.4,          {1.0, 0.25},     {},  {}};
  scene_.model.th_requests.push_back(request(model::ThKind::inter, 3, 0, {"FNX", "FTZ", "CE_ELAST"}));
  const auto r = row();
  EXPECT_EQ(r.at("INTER/3/FNX"), 1);
  EXPECT_EQ(r.at("INTER/3/FTZ"), 6);
  EXPECT_EQ(r.at("INTER/3/CE_ELAST"), 13);
  EXPECT_FALSE(r.contains("INTER/3/FNY"));  // was not asked for
  const std::vector<std::string> names{"FNX",  "FNY",  "FNZ",  "FTX",  "FTY", "FTZ", "IFNX", "IFNY",
                                       "IFNZ", "IFTX", "IFTY", "IFTZ", "CE",  "FW",  "DW",   "CX"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double value = static_cast<double>(k + 1);
    if (k >= 6) { EXPECT_EQ(r.at("INTER/3/" + names[k]), value) << names[k]; }
    EXPECT_EQ(r.at("INTER/7/" + names[k]), -value) << names[k];
  }
  EXPECT_EQ(r.at("INTER/3/NC"), 17);
  EXPECT_EQ(r.at("INTER/7/NC"), 18);
  EXPECT_EQ(r.at("INTER/3/APPR"), 0.2);  // the largest since the row before
  EXPECT_EQ(r.at("INTER/3/FACE1"), 0.75);
  EXPECT_EQ(r.at("INTER/3/FACE2"), 0.5);
  EXPECT_EQ(r.at("INTER/7/FACE2"), 0.25);
  EXPECT_FALSE(r.contains("INTER/7/FACE1"));  // TYPE5 holds nodes
}

TEST_F(TimeHistoryTest, WallsBodiesAndSections) {
  scene_.walls[0] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  scene_.bodies[0] = {
      .force_impulse = {1, 2, 3}, .moment_impulse = {4, 5, 6}, .force = {7, 8, 9}, .moment = {10, 11, 12}, .rotation = {13, 14, 15}};
  scene_.sections[0] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, {13, 14, 15}, {16, 17, 18}};
  scene_.model.th_requests.push_back(request(model::ThKind::rwall, 5, 0, {"FNX", "FTZ"}));
  scene_.model.th_requests.push_back(request(model::ThKind::rbody, 6, 0, {"FX", "MZ", "RY", "DX", "VRZ"}));
  scene_.model.th_requests.push_back(request(model::ThKind::section, 8, 0, {"FNZ", "FTX", "M2"}));
  scene_.accelerometers[0] = {{1, 2, 3}, {4, 5, 6}};
  scene_.model.th_requests.push_back(request(model::ThKind::accelerometer, 9, 0, {"AX", "AZ", "WY"}));
  const auto r = row();
  EXPECT_EQ(r.at("RWALL/5/FNX"), 1);
  EXPECT_EQ(r.at("RWALL/5/FTZ"), 6);
  EXPECT_EQ(r.at("RWALL/5/IFNX"), 7);
  EXPECT_EQ(r.at("RWALL/5/IFTZ"), 12);
  EXPECT_EQ(r.at("RBODY/6/IFX"), 1);
  EXPECT_EQ(r.at("RBODY/6/IMZ"), 6);
  EXPECT_EQ(r.at("RBODY/6/FX"), 7);
  EXPECT_EQ(r.at("RBODY/6/MZ"), 12);
  EXPECT_EQ(r.at("RBODY/6/RY"), 14);
  EXPECT_EQ(r.at("RBODY/6/DX"), scene_.state.u[2].x);
  EXPECT_EQ(r.at("RBODY/6/VRZ"), scene_.state.w[2].z);
  EXPECT_EQ(r.at("SECTIO/8/FNZ"), 3);
  EXPECT_EQ(r.at("SECTIO/8/FTX"), 4);
  EXPECT_EQ(r.at("SECTIO/8/M2"), 8);
  EXPECT_EQ(r.at("SECTIO/8/IFNX"), 10);
  EXPECT_EQ(r.at("SECTIO/8/IM3"), 18);
  EXPECT_EQ(r.at("ACCEL/9/AX"), 1);
  EXPECT_EQ(r.at("ACCEL/9/AZ"), 3);
  EXPECT_EQ(r.at("ACCEL/9/WY"), 5);
}

TEST_F(TimeHistoryTest, ElementVariablesComeFromTheirGroup) {
  scene_.model.th_requests.push_back(request(
      model::ThKind::shell, 31, 0, {"F1", "F2", "F12", "Q1", "Q2", "M1", "M2", "M12", "IEM", "IEB", "OFF", "EMIN", "EMAX", "THIC"}));
  scene_.model.th_requests.push_back(request(model::ThKind::sh3n, 32, 0, {"F1", "M12"}));
  scene_.model.th_requests.push_back(
      request(model::ThKind::brick, 42, 1, {"OFF", "SX", "SY", "SZ", "SXY", "SYZ", "SXZ", "IE", "DENS", "PLAS", "BULK", "VOL"}));
  scene_.group(2).remove(1);
  const auto r = row();
  const auto shell = test::FakeGroup::expected(0, 1.0);
  const std::vector<std::string> resultants{"F1", "F2", "F12", "Q1", "Q2", "M1", "M2", "M12"};
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(r.at("SHEL/31/" + resultants[k]), shell.resultants[k]) << resultants[k];
  EXPECT_EQ(r.at("SHEL/31/IEM"), shell.membrane_energy);
  EXPECT_EQ(r.at("SHEL/31/IEB"), shell.bending_energy);
  EXPECT_EQ(r.at("SHEL/31/OFF"), 1.0);
  EXPECT_EQ(r.at("SHEL/31/EMIN"), shell.plastic_min);
  EXPECT_EQ(r.at("SHEL/31/EMAX"), shell.plastic_max);
  EXPECT_EQ(r.at("SHEL/31/THIC"), shell.thickness);
  EXPECT_EQ(r.at("SH3N/32/M12"), shell.resultants[7]);
  const auto brick = test::FakeGroup::expected(1, 1.0);
  const std::vector<std::string> stresses{"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(r.at("BRIC/42/" + stresses[k]), brick.stress[k]) << stresses[k];
  EXPECT_EQ(r.at("BRIC/42/OFF"), 0.0);
  EXPECT_EQ(r.at("BRIC/42/DENS"), brick.density);
  EXPECT_EQ(r.at("BRIC/42/PLAS"), brick.plastic_max);
  EXPECT_EQ(r.at("BRIC/42/BULK"), brick.bulk_viscosity);
  EXPECT_EQ(r.at("BRIC/42/VOL"), brick.volume);
  // Energy per initial volume (numerics.md 8.6): mass 5 at density 8 fills 0.625.
  EXPECT_DOUBLE_EQ(r.at("BRIC/42/IE"), brick.internal_energy / 0.625);
}

TEST_F(TimeHistoryTest, VariablesThatAreNotComputedAreNamedOnceAndLeftOut) {
  scene_.model.th_requests.push_back(request(model::ThKind::part, 11, 0, {"IE", "HEAT"}));
  scene_.model.th_requests.push_back(request(model::ThKind::part, 22, 1, {"IE", "HEAT"}));
  scene_.model.th_requests.push_back(request(model::ThKind::node, 101, 0, {"DX", "TEMP", "REACX"}));
  const HistoryColumns columns = make_history_columns(scene_.model, ElementLookup(scene_.model, scene_.groups));
  EXPECT_EQ(columns.left_out, (std::vector<std::string>{"PART HEAT", "NODE TEMP", "NODE REACX"}));
  const auto r = row();
  EXPECT_FALSE(r.contains("PART/11/HEAT"));
  EXPECT_TRUE(r.contains("PART/22/IE"));
}

/// Columns that docs/guide/outputs.md explains, by kind: "`NODE/31/X`, `Y`" in the first cell of a row.
std::map<std::string, std::set<std::string>> explained_columns() {
  std::map<std::string, std::set<std::string>> all;
  std::ifstream page(ABUT_SOURCE_DIR "/docs/guide/outputs.md");
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(2, line.find(" | ", 2) - 2);
    std::string kind;
    for (std::size_t at = cell.find('`'); at != std::string::npos; at = cell.find('`', at)) {
      const std::size_t end = cell.find('`', at + 1);
      const std::string word = cell.substr(at + 1, end - at - 1);
      if (kind.empty()) kind = word.substr(0, word.find('/'));
      all[kind].insert(word.substr(word.rfind('/') + 1));
      at = end + 1;
    }
  }
  return all;
}

TEST_F(TimeHistoryTest, EveryColumnIsExplainedInTheGuide) {
  using model::ThKind;
  for (const auto& [kind, id, index] : {std::tuple<ThKind, Id, Index>{ThKind::node, 105, 4},
                                        {ThKind::part, 22, 1},
                                        {ThKind::shell, 31, 0},
                                        {ThKind::sh3n, 32, 0},
                                        {ThKind::brick, 42, 1},
                                        {ThKind::inter, 3, 0},
                                        {ThKind::rwall, 5, 0},
                                        {ThKind::rbody, 6, 0},
                                        {ThKind::section, 8, 0},
                                        {ThKind::accelerometer, 9, 0}}) {
    scene_.model.th_requests.push_back(request(kind, id, index, model::th_variables(kind)));
  }
  const auto explained = explained_columns();
  const std::vector<HistoryColumn> columns = make_history_columns(scene_.model, ElementLookup(scene_.model, scene_.groups)).columns;
  EXPECT_GT(columns.size(), 150U);
  for (const HistoryColumn& column : columns) {
    const std::string kind = column.name.substr(0, column.name.find('/'));
    const auto found = explained.find(kind);
    EXPECT_TRUE(found != explained.end() && found->second.contains(column.name.substr(column.name.rfind('/') + 1))) << column.name;
  }
}

TEST_F(TimeHistoryTest, NoColumnTwice) {
  for (int k = 0; k < 2; ++k) {
    scene_.model.th_requests.push_back(request(model::ThKind::node, 101, 0, {"DX", "DX", "DY"}));
    scene_.model.th_requests.push_back(request(model::ThKind::inter, 3, 0, {"FNX", "IFNX"}));
  }
  row();
  std::vector<std::string> sorted = names_;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
}

TEST_F(TimeHistoryTest, ARowPerDueCycleIsInTheFileAtOnce) {
  TimeHistory sink(folder_);
  cycle::Snapshot s = scene_.snapshot();
  sink.begin(s);
  for (int cycle = 0; cycle < 6; ++cycle) {
    scene_.state.times.t = 0.1 * cycle;
    s.history_due = cycle % 2 == 0;
    sink.cycle(s);
    // Read while the sink is open, as after a kill.
    EXPECT_EQ(read_table(folder_.history()).rows.size(), static_cast<std::size_t>(cycle / 2 + 1));
  }
  EXPECT_EQ(read_table(folder_.history()).rows.back().at("time"), 0.1 * 4);
}

TEST_F(TimeHistoryTest, AFullDiskNamesTheFileAndTheReason) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  std::filesystem::create_symlink("/dev/full", folder_.history());
  TimeHistory sink(folder_);
  try {
    sink.begin(scene_.snapshot());
    FAIL() << "nothing was thrown";
  } catch (const RunError& e) {
    EXPECT_EQ(std::string(e.what()), "cannot write '" + folder_.history().string() + "': No space left on device");
  }
}

}  // namespace
}  // namespace abut::output
