// A whole report from files that abut's own outputs wrote: what the page can read back is what the run had.
#include "report/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "core/diagnostic.hpp"
#include "output/run_outputs.hpp"
#include "read_back.hpp"
#include "unit/output/scene.hpp"

namespace abut::report {
namespace {

using Json = nlohmann::json;
using abut::test::Scene;
constexpr std::string_view page = "<html><!--abut:first--><script>viewer</script><!--abut:rest--></html>";

class ReportTest : public ::testing::Test {
 protected:
  /// Runs the outputs over made-up states, one per time.
  void run(const std::vector<double>& times, const std::function<void(std::size_t)>& change = {}) {
    output::RunInfo info;
    info.version = "test";
    info.contact = std::make_shared<const std::vector<ContactFinding>>(findings_);
    output::SinkSet sinks;
    output::add_run_outputs(sinks, output::RunFolder{folder_.path(), "scene"}, info, {});
    scene_.state.times.t = 0.0;
    sinks.begin(scene_.snapshot());
    for (std::size_t k = 0; k < times.size(); ++k) {
      scene_.state.times.t = times[k];
      scene_.state.times.cycle = 10 * static_cast<std::int64_t>(k);
      if (change) change(k);
      cycle::Snapshot s = scene_.snapshot();
      s.animation_due = s.history_due = true;
      s.controller = {cycle::StepController::Kind::brick, controller_};
      sinks.cycle(s);
    }
    sinks.end({});
  }
  void write(Fields fields = Fields::automatic) {
    written_ = write_report(folder_.path(), file(), page, fields);
    text_ = abut::test::slurp(file());
    std::smatch match;
    ASSERT_TRUE(std::regex_search(text_, match, std::regex("id=\"abut-document\">([^<]*)</script>")));
    document_ = Json::parse(match[1].str());
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "report.html"; }
  [[nodiscard]] std::string chunk_text(const Json& about) const {
    const std::string start = "id=\"c" + std::to_string(about["id"].get<int>()) + "\">";
    const std::size_t at = text_.find(start);
    EXPECT_NE(at, std::string::npos) << start;
    const std::size_t from = at + start.size();
    return text_.substr(from, text_.find('<', from) - from);
  }
  [[nodiscard]] std::vector<std::uint32_t> integers_of(const Json& about) const {
    return test::read_integers(about["kind"], about["count"], about["components"], chunk_text(about));
  }
  [[nodiscard]] std::vector<std::int64_t> ids_of(const Json& about) const {
    EXPECT_EQ(about["components"], 2);
    const std::vector<std::uint32_t> words = integers_of(about);
    std::vector<std::int64_t> ids;
    for (std::size_t i = 0; i < words.size(); i += 2) ids.push_back(words[i] + (std::int64_t{words[i + 1]} << 32));
    return ids;
  }
  [[nodiscard]] std::vector<double> values_of(std::size_t frame, const std::string& field) const {
    const Json& fields = document_["fields"];
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i]["name"] != field) continue;
      const Json& about = document_["frames"][frame]["values"][i];
      Chunk chunk{about["kind"], about["count"], about["components"], about["low"], about["high"], {}};
      if (about["id"] >= 0) chunk.text = chunk_text(about);
      return test::read_values(chunk);
    }
    ADD_FAILURE() << "no field " << field;
    return {};
  }

  abut::test::TemporaryFolder folder_;
  Scene scene_;
  Id controller_ = 41;
  std::vector<init::ContactFinding> findings_;
  Written written_;
  std::string text_;
  Json document_;
};

TEST_F(ReportTest, NodesElementsAndFacesAreThoseOfTheModel) {
  run({0.0, 0.5});
  write();
  EXPECT_EQ(written_.states, 2u);
  EXPECT_EQ(written_.elements, 6u);
  EXPECT_EQ(written_.bytes, text_.size());
  const Json& mesh = document_["mesh"];
  const auto node_id = ids_of(mesh["node_id"]);
  const auto element_id = ids_of(mesh["element_id"]);
  EXPECT_EQ(node_id.size(), 12u);
  for (const std::int64_t id : {31, 32, 41, 42, 43, 51}) {
    EXPECT_NE(std::find(element_id.begin(), element_id.end(), id), element_id.end()) << id;
  }
  EXPECT_EQ(mesh["parts"], (Json{11, 22}));
  EXPECT_EQ(mesh["part_elements"], (Json{2, 4}));
  // The quadrilateral shell 31 comes first, with its nodes by id.
  const auto faces = integers_of(mesh["faces"]);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(node_id[faces[k]], 101 + static_cast<std::int64_t>(k));
  // Positions: origin + point is the initial position.
  const auto words = test::read_integers("f32", 12, 3, chunk_text(mesh["points"]));
  for (std::size_t n = 0; n < 12; ++n) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = mesh["origin"][c].get<double>() + static_cast<double>(std::bit_cast<float>(words[3 * n + c]));
      EXPECT_NEAR(x, scene_.model.node_x[static_cast<std::size_t>(node_id[n]) - 101][static_cast<int>(c)], 1e-6);
    }
  }
}

TEST_F(ReportTest, FieldsComeBackWithinAQuantum) {
  run({0.0, 0.5}, [this](std::size_t k) {
    for (std::size_t n = 0; n < scene_.state.u.size(); ++n) {
      scene_.state.u[n] = {0.01 * double(n * (k + 1)), -0.5, 2.0 * double(k) - 0.1 * double(n)};
      scene_.state.x[n] = scene_.model.node_x[n] + scene_.state.u[n];
    }
  });
  write();
  const auto node_id = ids_of(document_["mesh"]["node_id"]);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto u = values_of(k, "displacement");
    const auto pressure = values_of(k, "contact_pressure");
    for (std::size_t n = 0; n < node_id.size(); ++n) {
      const auto m = static_cast<std::size_t>(node_id[n] - 101);
      EXPECT_NEAR(u[3 * n], 0.01 * double(m * (k + 1)), 1e-5);
      EXPECT_NEAR(u[3 * n + 1], -0.5, 1e-7);
      EXPECT_NEAR(u[3 * n + 2], 2.0 * double(k) - 0.1 * double(m), 2e-5);
      const double expected = scene_.contact_area[m] > 0.0 ? norm(scene_.contact_normal[m]) / scene_.contact_area[m] : 0.0;
      EXPECT_NEAR(pressure[n], expected, 2e-5 * expected + 2e-3);
    }
  }
  EXPECT_EQ(document_["frames"][1]["time"], 0.5);
  EXPECT_EQ(document_["frames"][1]["cycle"], 10);
}

TEST_F(ReportTest, DeletedElementsDisappearAndWhatIsBehindThemIsSeen) {
  run({0.0, 0.5}, [this](std::size_t k) {
    if (k == 1) scene_.group(2).remove(1);  // the wedge 42 on the brick 41
  });
  write();
  EXPECT_EQ(document_["frames"][1]["deleted"], 1);
  const auto hidden = integers_of(document_["frames"][1]["hidden"]);
  const auto element = integers_of(document_["mesh"]["face_element"]);
  const auto element_id = ids_of(document_["mesh"]["element_id"]);
  int of_wedge = 0;
  for (std::size_t f = 0; f < hidden.size(); ++f) {
    if (element_id[element[f]] != 42) continue;
    ++of_wedge;
    EXPECT_EQ(hidden[f], 1u);
  }
  EXPECT_EQ(of_wedge, 5);
  EXPECT_TRUE(std::isnan(
      values_of(1, "von_mises")[static_cast<std::size_t>(std::find(element_id.begin(), element_id.end(), 42) - element_id.begin())]));
}

TEST_F(ReportTest, TheHistoryHasEveryColumnAndTheController) {
  run({0.0, 0.25, 0.5});
  write();
  const auto& names = document_["history"]["names"];
  EXPECT_EQ(document_["history"]["rows"], 3);
  EXPECT_EQ(names[0], "time");
  const auto column = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    const Json& about = document_["history"]["columns"][static_cast<std::size_t>(at)];
    std::vector<float> out;
    for (const std::uint32_t word : test::read_integers("f32", about["count"], 1, chunk_text(about)))
      out.push_back(std::bit_cast<float>(word));
    return out;
  };
  EXPECT_EQ(column("time"), (std::vector<float>{0.0f, 0.25f, 0.5f}));
  EXPECT_EQ(column("GLOBAL/DTKIND"), (std::vector<float>{3.0f, 3.0f, 3.0f}));
  const auto at = std::find(names.begin(), names.end(), "GLOBAL/DTID") - names.begin();
  EXPECT_EQ(ids_of(document_["history"]["columns"][static_cast<std::size_t>(at)]), (std::vector<std::int64_t>(3, controller_)));
}

// Ids have up to ten digits: single precision knows 7 of them, 32 bits 9.
TEST_F(ReportTest, LargeIdsAreExact) {
  controller_ = 5000000001;
  std::vector<Id> nodes = scene_.model.node_id.all();
  nodes.back() = 9999999999;
  scene_.model.node_id = {};
  for (const Id id : nodes) scene_.model.node_id.push_back(id);
  scene_.model.shells.id = {5000000001};
  run({0.0, 0.5});
  write();
  const auto has = [](const std::vector<std::int64_t>& ids, std::int64_t id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); };
  EXPECT_TRUE(has(ids_of(document_["mesh"]["node_id"]), 9999999999));
  EXPECT_TRUE(has(ids_of(document_["mesh"]["element_id"]), 5000000001));
  const auto& names = document_["history"]["names"];
  const auto at = std::find(names.begin(), names.end(), "GLOBAL/DTID") - names.begin();
  EXPECT_EQ(ids_of(document_["history"]["columns"][static_cast<std::size_t>(at)]), (std::vector<std::int64_t>(2, controller_)));
}

TEST_F(ReportTest, ContactSurfacesAreThereWithTheirSides) {
  scene_.model.surfaces.emplace_back().id = 70;
  scene_.model.surfaces.emplace_back().id = 71;
  scene_.model.surfaces[0].segments.push_back({{0, 1, 2, 3}, {}});
  scene_.model.surfaces[1].segments.push_back({{8, 9, 10, 10}, {}});
  scene_.model.interfaces[0].type = model::InterfaceType3{.surface_1 = 0, .surface_2 = 1};
  scene_.model.interfaces[1].type = model::InterfaceType5{.nodes = {}, .surface = 1};
  run({0.0});
  write();
  const Json& contact = document_["contact"];
  ASSERT_EQ(contact.size(), 3u);
  EXPECT_EQ(contact[0]["interface"], 3);
  EXPECT_EQ(contact[0]["side"], 1);
  EXPECT_EQ(contact[1]["surface"], 71);
  EXPECT_EQ(contact[2]["interface"], 7);
  EXPECT_EQ(contact[2]["side"], 2);
  EXPECT_EQ(integers_of(contact[1]["segments"]), (std::vector<std::uint32_t>{8, 9, 10, 10}));
}

TEST_F(ReportTest, TextOfTheDeckCannotEndItsElement) {
  scene_.model.title = "</script><script>alert(1)</script>";
  run({0.0});
  write();
  EXPECT_EQ(text_.find("<script>alert"), std::string::npos);
  EXPECT_EQ(document_["run"]["model"]["title"], scene_.model.title);
}

TEST_F(ReportTest, TheFirstPictureComesBeforeTheViewerAndTheRestAfter) {
  run({0.0, 0.5, 1.0}, [this](std::size_t k) {
    for (Vec3& u : scene_.state.u) u.x += 0.1 * double(k + 1) * u.z;
  });
  write();
  const std::size_t viewer = text_.find("<script>viewer");
  const auto place = [&](const Json& about) { return text_.find("id=\"c" + std::to_string(about["id"].get<int>()) + "\""); };
  EXPECT_LT(place(document_["mesh"]["faces"]), viewer);
  const auto first = document_["first"].get<std::size_t>();
  EXPECT_LT(place(document_["frames"][first]["values"][0]), viewer);
  EXPECT_GT(place(document_["frames"][first == 0 ? 1 : 0]["values"][0]), viewer);
}

TEST_F(ReportTest, ARunWithoutAnimationHasPlotsOnly) {
  run({0.0, 0.5});
  std::filesystem::remove(folder_.path() / "scene.pvd");
  write();
  EXPECT_TRUE(document_["frames"].empty());
  EXPECT_FALSE(document_.contains("mesh"));
  EXPECT_EQ(document_["history"]["rows"], 2);
}

TEST_F(ReportTest, ARunThatWasKilledLosesItsLastRowOnly) {
  run({0.0, 0.5});
  std::ofstream(folder_.path() / "scene_th.csv", std::ios::app) << "0.75,1.0,";
  write();
  EXPECT_EQ(document_["history"]["rows"], 2);
}

TEST_F(ReportTest, WhatIsNoRunFolderIsRefusedByName) {
  const auto message = [this] {
    try {
      (void)write_report(folder_.path(), file(), page, Fields::automatic);
    } catch (const RunError& e) { return std::string(e.what()); }
    return std::string();
  };
  EXPECT_NE(message().find("no run.json"), std::string::npos);
  std::ofstream(folder_.path() / "run.json") << "{\"half\": ";
  EXPECT_NE(message().find("not a manifest"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file()));
  run({0.0});
  std::ofstream(folder_.path() / "scene_anim" / "scene_00000.vtu") << "not a grid";
  EXPECT_NE(message().find("scene_00000.vtu"), std::string::npos);
}

// A full disk or a copy that broke off cuts one state, or loses it: the others are shown, and VTK says nothing on the console.
TEST_F(ReportTest, AStateThatCannotBeReadIsLeftOut) {
  const auto state = [this](int k) { return folder_.path() / "scene_anim" / ("scene_0000" + std::to_string(k) + ".vtu"); };
  for (int broken = 0; broken < 3; ++broken) {
    for (const bool missing : {false, true}) {
      run({0.0, 0.5, 1.0});
      if (missing) {
        std::filesystem::remove(state(broken));
      } else {
        std::filesystem::resize_file(state(broken), std::filesystem::file_size(state(broken)) / 2);
      }
      ::testing::internal::CaptureStderr();
      write();
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
      EXPECT_EQ(written_.states, 2u);
      ASSERT_EQ(written_.left_out.size(), 1u);
      EXPECT_EQ(written_.left_out.front(),
                state(broken).string() + (missing ? ": not a readable animation state" : ": damaged animation state"));
      EXPECT_EQ(document_["frames"].size(), 2u);
      EXPECT_EQ(document_["frames"][1]["time"], broken == 2 ? 0.5 : 1.0);
      EXPECT_EQ(document_["states_left_out"], 1);
      EXPECT_LT(document_["first"].get<std::size_t>(), 2u);
    }
  }
}

/// A grid of one cell on the points of four nodes.
std::string small_grid(const char* connectivity, const char* offsets, int type, const char* cell_arrays, int displacements = 3) {
  const auto array = [](const char* kind, const char* name, int components, const std::string& values) {
    return "<DataArray type=\"" + std::string(kind) + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
           "\" format=\"ascii\">" + values + "</DataArray>";
  };
  std::string zeros, text = "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" ";
  for (int i = 0; i < 4 * displacements; ++i) zeros += "0 ";
  text += "header_type=\"UInt64\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>";
  text +=
      array("Int64", "node_id", 1, "101 102 103 104") + array("Float32", "displacement", displacements, zeros) + "</PointData><CellData>";
  for (std::istringstream names(cell_arrays); names >> zeros;) text += array("Int64", zeros.c_str(), 1, "1");
  text += "</CellData><Points>" + array("Float64", "Points", 3, "0 0 0 1 0 0 1 1 0 0 1 0") + "</Points><Cells>";
  text += array("Int32", "connectivity", 1, connectivity) + array("Int64", "offsets", 1, offsets) +
          array("UInt8", "types", 1, std::to_string(type));
  return text + "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

// VTK reads these files without a word: cells that point beyond the nodes, and fields of another width.
TEST_F(ReportTest, AStateWithCellsThatAreNoneIsLeftOut) {
  const struct {
    const char *connectivity, *offsets;
    int type;
    const char* why;
  } damages[] = {{"0 1 2 900000000", "4", 9, "a cell with a corner that is no point of the file"},
                 {"0 1 2 -1", "4", 9, "a cell with a corner that is no point of the file"},
                 {"0 1 2 4", "4", 9, "a cell with a corner that is no point of the file"},
                 {"0 1 2 3", "3", 9, "a cell with a wrong number of corners"},
                 {"0 1 2 3", "9", 9, "damaged animation state"},
                 {"0 1 2", "3", 9, "a cell with a wrong number of corners"},
                 {"0 1 2 3 0 1 2 3 0 1", "10", 12, "a cell with a wrong number of corners"},
                 {"0 1", "2", 3, "a cell of a kind that abut does not write"}};
  const std::filesystem::path state = folder_.path() / "scene_anim" / "scene_00000.vtu";
  run({0.0, 0.5});
  for (const auto& damage : damages) {
    SCOPED_TRACE(std::string(damage.connectivity) + ", type " + std::to_string(damage.type));
    std::ofstream(state) << small_grid(damage.connectivity, damage.offsets, damage.type, "element_id part_id");
    write();
    EXPECT_EQ(written_.left_out, std::vector<std::string>{state.string() + ": " + damage.why});
    EXPECT_EQ(document_["frames"].size(), 1u);
  }
}

TEST_F(ReportTest, AStateOfAnotherRunIsLeftOut) {
  run({0.0, 0.5});
  const auto state = [this](int k) { return folder_.path() / "scene_anim" / ("scene_0000" + std::to_string(k) + ".vtu"); };
  std::ofstream(state(1)) << small_grid("0 1 2 3", "4", 9, "element_id part_id");
  write();
  EXPECT_EQ(written_.left_out, std::vector<std::string>{state(1).string() + ": other nodes than the first state"});
  std::filesystem::remove(folder_.path() / "scene_contact.vtu");
  std::ofstream(state(0)) << small_grid("0 1 2 3", "4", 9, "element_id part_id");
  std::ofstream(state(1)) << small_grid("0 1 2 3", "4", 9, "element_id part_id", 2);
  write();
  EXPECT_EQ(written_.left_out, std::vector<std::string>{state(1).string() + ": no field displacement as in the first state"});
}

TEST_F(ReportTest, ContactSurfacesOfAnotherMeshAreRefusedByName) {
  run({0.0});
  const std::filesystem::path surfaces = folder_.path() / "scene_contact.vtu";
  std::ofstream(surfaces) << small_grid("0 1 2 3", "4", 9, "interface_id surface_id side");
  try {
    (void)write_report(folder_.path(), file(), page, Fields::automatic);
    ADD_FAILURE() << "drawn without a word";
  } catch (const RunError& e) { EXPECT_EQ(std::string(e.what()), surfaces.string() + ": its nodes are not those of the animation"); }
}

TEST_F(ReportTest, AManifestOfOtherTypesIsNone) {
  for (const char* text : {"{\"model\":1,\"files\":2}", "[1]", "{\"model\":{},\"files\":{\"history\":3}}", "{\"model\":{},\"files\":[]}"}) {
    std::ofstream(folder_.path() / "run.json") << text;
    try {
      (void)write_report(folder_.path(), file(), page, Fields::automatic);
      ADD_FAILURE() << text;
    } catch (const RunError& e) { EXPECT_EQ(std::string(e.what()), (folder_.path() / "run.json").string() + ": not a manifest of abut"); }
  }
}

}  // namespace
}  // namespace abut::report
