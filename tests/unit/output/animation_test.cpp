// Animation states read back with VTK's own reader: every state, every array, every value; the index is complete after
// each state and never names a file that is not whole.
#include "output/animation.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <limits>
#include <regex>
#include <span>

#include "core/diagnostic.hpp"
#include "model/animation_names.hpp"
#include "output/animation_fields.hpp"
#include "output/cell_shape.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using test::FakeGroup;
using test::Scene;

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  EXPECT_TRUE(reader->CanReadFile(path.c_str())) << path;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

struct IndexEntry {
  double time = 0.0;
  std::string file;
};
std::vector<IndexEntry> read_index(const std::filesystem::path& path) {
  const std::string text = test::slurp(path);
  const std::regex pattern("<DataSet timestep=\"([^\"]*)\" part=\"0\" file=\"([^\"]*)\"/>");
  std::vector<IndexEntry> entries;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) { entries.push_back({std::stod((*i)[1]), (*i)[2]}); }
  EXPECT_TRUE(text.ends_with("</VTKFile>\n"));
  return entries;
}

class AnimationTest : public ::testing::Test {
 protected:
  void write(Animation& sink, double time) {
    scene_.state.times.t = time;
    ++scene_.state.times.cycle;
    cycle::Snapshot s = scene_.snapshot();
    s.animation_due = true;
    sink.cycle(s);
  }
  /// A checkpoint waits until the last state is on the disk.
  static void settle(Animation& sink) {
    state::Archive checkpoint;
    sink.persist(checkpoint);
  }
  vtkSmartPointer<vtkUnstructuredGrid> written() {
    Animation sink(folder_);
    sink.begin(scene_.snapshot());
    write(sink, 0.5);
    sink.end({});
    return read_grid(folder_.animation_state(0));
  }
  static void expect_vectors(vtkUnstructuredGrid* grid, const char* name, std::span<const Vec3> expected) {
    vtkDataArray* array = grid->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    ASSERT_EQ(array->GetNumberOfComponents(), 3);
    ASSERT_EQ(array->GetNumberOfTuples(), static_cast<vtkIdType>(expected.size()));
    for (std::size_t n = 0; n < expected.size(); ++n) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(array->GetComponent(static_cast<vtkIdType>(n), c), static_cast<float>(expected[n][c])) << name << " " << n;
      }
    }
  }
  static void expect_cell(vtkUnstructuredGrid* grid, const char* name, vtkIdType cell, double expected, int component = 0) {
    vtkDataArray* array = grid->GetCellData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetComponent(cell, component), static_cast<float>(expected)) << name << " " << cell;
  }

  test::TemporaryFolder temporary_;
  RunFolder folder_{temporary_.path(), "scene"};
  Scene scene_;
};

TEST_F(AnimationTest, PointsAreTheCurrentPositionsInDoublePrecision) {
  scene_.state.x[5].x = 1.0 / 3.0;
  const auto grid = written();
  ASSERT_EQ(grid->GetNumberOfPoints(), 12);
  for (std::size_t n = 0; n < 12; ++n) {
    double p[3];
    grid->GetPoint(static_cast<vtkIdType>(n), p);
    EXPECT_EQ((Vec3{p[0], p[1], p[2]}), scene_.state.x[n]);
    EXPECT_EQ(grid->GetPointData()->GetArray("node_id")->GetComponent(static_cast<vtkIdType>(n), 0), 101.0 + static_cast<double>(n));
  }
}

TEST_F(AnimationTest, CellsAreTheElementsWithTheirDegenerateShapes) {
  const auto grid = written();
  const std::vector<int> types{VTK_QUAD, VTK_TRIANGLE, VTK_HEXAHEDRON, VTK_WEDGE, VTK_TETRA, VTK_TETRA};
  const std::vector<double> ids{31, 32, 41, 42, 43, 51};
  const std::vector<double> parts{11, 11, 22, 22, 22, 22};
  ASSERT_EQ(grid->GetNumberOfCells(), 6);
  for (vtkIdType c = 0; c < 6; ++c) {
    EXPECT_EQ(grid->GetCellType(c), types[static_cast<std::size_t>(c)]) << c;
    EXPECT_EQ(grid->GetCellData()->GetArray("element_id")->GetComponent(c, 0), ids[static_cast<std::size_t>(c)]);
    EXPECT_EQ(grid->GetCellData()->GetArray("part_id")->GetComponent(c, 0), parts[static_cast<std::size_t>(c)]);
  }
}

TEST_F(AnimationTest, NodalFieldsThatEveryStateHas) {
  const auto grid = written();
  expect_vectors(grid, "displacement", scene_.state.u);
  expect_vectors(grid, "velocity", scene_.state.v);
  std::vector<Vec3> force, normal, tangential;
  for (std::size_t n = 0; n < 12; ++n) {
    const double area = scene_.contact_area[n];
    force.push_back(scene_.contact_normal[n] + scene_.contact_tangential[n]);
    normal.push_back(area > 0.0 ? scene_.contact_normal[n] / area : Vec3{});
    tangential.push_back(area > 0.0 ? scene_.contact_tangential[n] / area : Vec3{});
  }
  EXPECT_EQ(normal[2], Vec3{});  // the scene has a node without area
  expect_vectors(grid, "contact_force", force);
  expect_vectors(grid, "contact_pressure_normal", normal);
  expect_vectors(grid, "contact_pressure_tangential", tangential);
  EXPECT_EQ(grid->GetPointData()->GetArray("acceleration"), nullptr);
}

TEST_F(AnimationTest, ElementFieldsThatEveryStateHas) {
  const auto grid = written();
  const std::vector<Index> table_index{0, 0, 0, 1, 2, 0};
  for (vtkIdType c = 0; c < 6; ++c) {
    const auto expected = FakeGroup::expected(table_index[static_cast<std::size_t>(c)], 1.0);
    expect_cell(grid, "plastic_strain", c, expected.plastic_max);
    expect_cell(grid, "von_mises", c, expected.von_mises);
    for (int k = 0; k < 6; ++k) expect_cell(grid, "stress", c, expected.stress[static_cast<std::size_t>(k)], k);
  }
  EXPECT_STREQ(grid->GetCellData()->GetArray("stress")->GetComponentName(0), "XX");
  EXPECT_STREQ(grid->GetCellData()->GetArray("stress")->GetComponentName(5), "XZ");
  EXPECT_EQ(grid->GetCellData()->GetArray("energy_per_mass"), nullptr);
}

TEST_F(AnimationTest, SelectionsOfTheDeckAddFields) {
  scene_.model.controls.animation_fields = {"VECT/ACC", "VECT/VROT", "VECT/FINT",  "VECT/FEXT",  "MASS",      "ELEM/ENER",
                                            "BRICK/P",  "ELEM/DENS", "SHELL/THIC", "ELEM/HOURG", "VECT/DISP", "SHELL/TENS/STRESS/MEMB"};
  EXPECT_TRUE(select_animation_fields(scene_.model.controls.animation_fields).left_out.empty());
  const auto grid = written();
  expect_vectors(grid, "acceleration", scene_.state.a);
  expect_vectors(grid, "angular_velocity", scene_.state.w);
  expect_vectors(grid, "internal_force", scene_.state.f_internal);
  expect_vectors(grid, "external_force", scene_.state.f_external);
  EXPECT_EQ(grid->GetPointData()->GetArray("mass")->GetComponent(3, 0), 4.0);
  const auto expected = FakeGroup::expected(1, 1.0);  // brick 42, mass 5
  expect_cell(grid, "energy_per_mass", 3, expected.internal_energy / 5.0);
  expect_cell(grid, "pressure", 3, expected.pressure);
  expect_cell(grid, "density", 3, expected.density);
  expect_cell(grid, "thickness", 3, expected.thickness);
  expect_cell(grid, "hourglass_energy", 3, expected.hourglass_energy);
}

// Layers are fields of their own, each once; a group that has no layers gives its mean stress.
TEST_F(AnimationTest, LayersOfShellsAreFields) {
  scene_.model.controls.animation_fields = {"SHELL/TENS/STRESS/UPPER", "SHELL/TENS/STRESS/ALL", "TENS/STRESS/BEND", "SHELL/TENS/STRESS/3"};
  EXPECT_TRUE(select_animation_fields(scene_.model.controls.animation_fields).left_out.empty());
  EXPECT_EQ(select_animation_fields(scene_.model.controls.animation_fields).cells.size(), 3u + 4u);
  const auto grid = written();
  const auto expected = FakeGroup::expected(1, 1.0);
  for (const char* name : {"stress_upper", "stress_lower", "stress_bending", "stress_point_3"}) {
    for (int k = 0; k < 6; ++k) expect_cell(grid, name, 3, expected.stress[static_cast<std::size_t>(k)], k);
    EXPECT_STREQ(grid->GetCellData()->GetArray(name)->GetComponentName(5), "XZ");
  }
}

TEST_F(AnimationTest, SelectionsThatAreNotComputedAreNamed) {
  // "must" of deck-format.md H.1
  EXPECT_TRUE(select_animation_fields({"VECT/VEL", "VECT/DISP", "VECT/CONT", "VECT/PCONT", "ELEM/VONM", "ELEM/EPSP", "ELEM/ENER"})
                  .left_out.empty());
  EXPECT_EQ(select_animation_fields({"NODA/TEMP", "ELEM/VONM", "NODA/TEMP", "SHELL/TENS/STRAIN/UPPER", "SHELL/TENS/STRESS/0"}).left_out,
            (std::vector<std::string>{"NODA/TEMP", "SHELL/TENS/STRAIN/UPPER", "SHELL/TENS/STRESS/0"}));
}

// The reader warns of names that it does not know; it knows those that are computed, and no other.
TEST_F(AnimationTest, TheNamesThatTheReaderKnowsAreComputed) {
  EXPECT_EQ(select_animation_fields(model::animation_names()).left_out, std::vector<std::string>{});
  for (const std::string& name : model::animation_names_on_request()) {
    EXPECT_GT(select_animation_fields({name}).nodes.size() + select_animation_fields({name}).cells.size(),
              select_animation_fields({}).nodes.size() + select_animation_fields({}).cells.size())
        << name;
  }
  for (const char* name : {"NODA/TEMP", "SHELL/TENS/STRAIN/UPPER", "SHELL/TENS/STRESS/0", "SHELL/TENS/STRESS/3", "BRICK/EPSP", "FOO"}) {
    EXPECT_EQ(model::has_animation_field(name), select_animation_fields({name}).left_out.empty()) << name;
  }
}

TEST_F(AnimationTest, ADeletedElementIsLeftOutFromThenOn) {
  Animation sink(folder_);
  sink.begin(scene_.snapshot());
  write(sink, 0.0);
  scene_.group(2).remove(1);
  write(sink, 0.1);
  settle(sink);
  EXPECT_EQ(read_grid(folder_.animation_state(0))->GetNumberOfCells(), 6);
  const auto grid = read_grid(folder_.animation_state(1));
  const std::vector<double> ids{31, 32, 41, 43, 51};
  const std::vector<int> types{VTK_QUAD, VTK_TRIANGLE, VTK_HEXAHEDRON, VTK_TETRA, VTK_TETRA};
  const std::vector<Index> table_index{0, 0, 0, 2, 0};
  ASSERT_EQ(grid->GetNumberOfCells(), 5);
  EXPECT_EQ(grid->GetNumberOfPoints(), 12);
  for (vtkIdType c = 0; c < 5; ++c) {
    const auto k = static_cast<std::size_t>(c);
    EXPECT_EQ(grid->GetCellData()->GetArray("element_id")->GetComponent(c, 0), ids[k]);
    EXPECT_EQ(grid->GetCellType(c), types[k]);
    expect_cell(grid, "von_mises", c, FakeGroup::expected(table_index[k], 1.0).von_mises);
  }
}

TEST_F(AnimationTest, AStateWithoutCellsCanBeRead) {
  for (std::size_t g = 0; g < 4; ++g) {
    for (Index e = 0; e < scene_.group(g).size(); ++e) scene_.group(g).remove(e);
  }
  const auto grid = written();
  EXPECT_EQ(grid->GetNumberOfCells(), 0);
  EXPECT_EQ(grid->GetNumberOfPoints(), 12);
}

TEST_F(AnimationTest, AnElementWithoutAGroupShowsZeros) {
  scene_.groups.pop_back();  // the tetrahedron's
  const auto grid = written();
  expect_cell(grid, "von_mises", 5, 0.0);
}

TEST_F(AnimationTest, ValuesBeyondSinglePrecisionStayFinite) {
  scene_.state.v[0] = {1e300, -1e300, 0.0};
  const auto grid = written();
  EXPECT_EQ(grid->GetPointData()->GetArray("velocity")->GetComponent(0, 0), std::numeric_limits<float>::max());
  EXPECT_EQ(grid->GetPointData()->GetArray("velocity")->GetComponent(0, 1), -std::numeric_limits<float>::max());
}

TEST_F(AnimationTest, TheIndexIsCompleteAfterEachState) {
  Animation sink(folder_);
  sink.begin(scene_.snapshot());
  cycle::Snapshot idle = scene_.snapshot();
  sink.cycle(idle);
  EXPECT_FALSE(std::filesystem::exists(folder_.animation_index()));
  for (int k = 0; k < 4; ++k) {
    scene_.group(0).scale = 1.0 + k;
    scene_.state.u[1].x = 0.5 * k;
    write(sink, 0.1 * k);
    settle(sink);
    const auto entries = read_index(folder_.animation_index());
    ASSERT_EQ(entries.size(), static_cast<std::size_t>(k + 1));
    for (int j = 0; j <= k; ++j) {
      const IndexEntry& entry = entries[static_cast<std::size_t>(j)];
      EXPECT_EQ(entry.time, 0.1 * j);
      const auto grid = read_grid(folder_.directory / entry.file);
      EXPECT_EQ(grid->GetNumberOfCells(), 6);
      EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.1 * j);
      EXPECT_EQ(grid->GetFieldData()->GetArray("cycle")->GetComponent(0, 0), j + 1.0);
      expect_cell(grid, "von_mises", 0, FakeGroup::expected(0, 1.0 + j).von_mises);
      EXPECT_EQ(grid->GetPointData()->GetArray("displacement")->GetComponent(1, 0), 0.5 * j);
    }
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(temporary_.path())) {
    EXPECT_FALSE(entry.path().filename().string().ends_with(".part")) << entry.path();
  }
}

TEST_F(AnimationTest, AStateThatCannotBeWrittenIsNotInTheIndex) {
  Animation sink(folder_);
  sink.begin(scene_.snapshot());
  write(sink, 0.0);
  // A folder in the place of the next state: the rename fails, as root too.
  std::filesystem::create_directories(folder_.animation_state(1) / "in the way");
  write(sink, 0.1);  // by a thread of its own: whoever waits for it hears of the failure
  // A checkpoint that hears of it first does not make the run a good one.
  EXPECT_THROW(settle(sink), RunError);
  EXPECT_THROW(sink.end({}), RunError);
  EXPECT_EQ(read_index(folder_.animation_index()).size(), 1U);
  EXPECT_EQ(read_grid(folder_.animation_state(0))->GetNumberOfCells(), 6);
  EXPECT_FALSE(std::filesystem::exists(folder_.animation_folder() / ".scene_00001.vtu.part"));
}

TEST_F(AnimationTest, StatesOfAnEarlierRunAreRemoved) {
  for (int run = 0; run < 2; ++run) {
    Animation sink(folder_);
    sink.begin(scene_.snapshot());
    for (int k = 0; k < (run == 0 ? 3 : 1); ++k) write(sink, 0.1 * k);
    sink.end({});
  }
  EXPECT_TRUE(std::filesystem::exists(folder_.animation_state(0)));
  EXPECT_FALSE(std::filesystem::exists(folder_.animation_state(1)));
  EXPECT_EQ(read_index(folder_.animation_index()).size(), 1U);
}

TEST(CellShape, EveryWayToCollapseTwoParallelEdgesGivesAWedgeOfHalfTheCube) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  // Opposite edges of one face collapse in pairs: (a, b) and (c, d) are such edges, b -> a and d -> c.
  const std::vector<std::array<int, 4>> collapses{{0, 1, 4, 5}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 0, 7, 4}, {0, 1, 3, 2}, {4, 5, 7, 6},
                                                  {1, 2, 0, 3}, {5, 6, 4, 7}, {0, 4, 1, 5}, {1, 5, 2, 6}, {2, 6, 3, 7}, {3, 7, 0, 4}};
  for (const auto& [a, b, c, d] : collapses) {
    std::array<Index, 8> nodes{0, 1, 2, 3, 4, 5, 6, 7};
    nodes[static_cast<std::size_t>(b)] = a;
    nodes[static_cast<std::size_t>(d)] = c;
    const CellShape shape = brick_shape(nodes, x);
    ASSERT_EQ(shape.kind, CellKind::wedge);
    ASSERT_EQ(shape.count, 6);
    const auto at = [&](int k) { return x[static_cast<std::size_t>(shape.nodes[static_cast<std::size_t>(k)])]; };
    const auto volume6 = [](Vec3 p, Vec3 q, Vec3 r, Vec3 s) { return dot(cross(q - p, r - p), s - p); };
    // VTK's wedge, base outward: three tetrahedra of positive volume that fill the half cube.
    const double v = volume6(at(0), at(2), at(1), at(3)) + volume6(at(1), at(3), at(5), at(4)) + volume6(at(1), at(3), at(2), at(5));
    EXPECT_NEAR(std::abs(v) / 6.0, 0.5, 1e-15) << a << b << c << d;
    EXPECT_GT(volume6(at(0), at(2), at(1), at(3)), 0.0) << a << b << c << d;
  }
}

TEST(CellShape, PyramidAndTetrahedronHavePositiveVolume) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const auto at = [&](Index n) { return x[static_cast<std::size_t>(n)]; };
  for (const std::array<Index, 8>& nodes : {std::array<Index, 8>{0, 1, 2, 3, 4, 4, 4, 4}, std::array<Index, 8>{6, 6, 6, 6, 4, 5, 1, 0}}) {
    const CellShape shape = brick_shape(nodes, x);
    ASSERT_EQ(shape.kind, CellKind::pyramid);
    EXPECT_GT(dot(cross(at(shape.nodes[1]) - at(shape.nodes[0]), at(shape.nodes[2]) - at(shape.nodes[0])),
                  at(shape.nodes[4]) - at(shape.nodes[0])),
              0.0);
  }
  for (const std::array<Index, 4>& nodes : {std::array<Index, 4>{0, 1, 2, 5}, std::array<Index, 4>{0, 2, 1, 5}}) {
    const CellShape s = tetra_shape(nodes, x);
    EXPECT_GT(dot(cross(at(s.nodes[1]) - at(s.nodes[0]), at(s.nodes[2]) - at(s.nodes[0])), at(s.nodes[3]) - at(s.nodes[0])), 0.0);
  }
}

TEST(CellShape, AnythingElseStaysAHexahedron) {
  const std::vector<Vec3> x(8);
  const std::array<Index, 8> seven{0, 1, 2, 2, 4, 5, 6, 7};
  EXPECT_EQ(brick_shape(seven, x).kind, CellKind::hexahedron);
  EXPECT_EQ(brick_shape(seven, x).nodes, seven);
}

}  // namespace
}  // namespace abut::output
