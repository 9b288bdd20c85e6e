// Arrays of every type and of lengths around a block come back from VTK's own reader as they were; values that wait to be written take the
// room of what differs.
#include "output/vtu.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/diagnostic.hpp"
#include "output/column.hpp"
#include "scene.hpp"

namespace abut::output {
namespace {

using Type = VtuArray::Type;

double coordinate(std::size_t i) { return std::sin(static_cast<double>(i)); }

/// Triangles (k, k + 1, k + 2) over `points` points.
VtuGrid strip(std::size_t points) {
  const std::size_t cells = points < 3 ? 0 : points - 2;
  VtuGrid grid;
  grid.points = VtuArray::of<double>("Points", Type::float64, 3, points, coordinate);
  grid.connectivity = VtuArray::of<std::int32_t>("connectivity", Type::int32, 1, 3 * cells, [](std::size_t i) { return i / 3 + i % 3; });
  grid.offsets = VtuArray::of<std::int64_t>("offsets", Type::int64, 1, cells, [](std::size_t c) { return 3 * (c + 1); });
  grid.types = VtuArray::of<std::uint8_t>("types", Type::uint8, 1, cells, [](std::size_t) { return 5; });
  grid.point_data.push_back(VtuArray::of<std::int64_t>(
      "id", Type::int64, 1, points, [](std::size_t i) { return (std::int64_t{1} << 40) + static_cast<std::int64_t>(i); }));
  grid.cell_data.push_back(
      VtuArray::of<float>("value", Type::float32, 1, cells, [](std::size_t i) { return 0.5F * static_cast<float>(i); }));
  return grid;
}

TEST(Vtu, ArraysAroundABlocksLengthComeBack) {
  const test::TemporaryFolder folder;
  // 4096 numbers of 8 bytes fill a block.
  for (const std::size_t points :
       {std::size_t{0}, std::size_t{2}, std::size_t{4095}, std::size_t{4096}, std::size_t{4097}, std::size_t{8194}}) {
    const std::filesystem::path path = folder.path() / "strip.vtu";
    write_vtu(path, strip(points));
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkUnstructuredGrid* grid = reader->GetOutput();
    ASSERT_EQ(reader->GetErrorCode(), 0U) << points;
    ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(points));
    const std::size_t cells = points < 3 ? 0 : points - 2;
    ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(cells));
    for (std::size_t n = 0; n < points; ++n) {
      double x[3];
      grid->GetPoint(static_cast<vtkIdType>(n), x);
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(x[k], coordinate(3 * n + k)) << points << " " << n;
      ASSERT_EQ(grid->GetPointData()->GetArray("id")->GetComponent(static_cast<vtkIdType>(n), 0),
                std::ldexp(1.0, 40) + static_cast<double>(n));
    }
    for (std::size_t c = 0; c < cells; ++c) {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      grid->GetCellPoints(static_cast<vtkIdType>(c), count, corners);
      ASSERT_EQ(count, 3);
      for (vtkIdType k = 0; k < 3; ++k) ASSERT_EQ(corners[k], static_cast<vtkIdType>(c) + k);
      ASSERT_EQ(grid->GetCellData()->GetArray("value")->GetComponent(static_cast<vtkIdType>(c), 0), 0.5 * static_cast<double>(c));
    }
  }
}

TEST(Vtu, AFileThatFailsHalfWayLeavesTheOldOne) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "strip.vtu";
  write_vtu(path, strip(10));
  const std::string before = test::slurp(path);
  VtuGrid grid = strip(5000);
  grid.types.fill = [](std::size_t, void*) { throw RunError("no more"); };
  EXPECT_THROW(write_vtu(path, std::move(grid)), RunError);
  EXPECT_EQ(test::slurp(path), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Column, TuplesComeBackWhereverTheyAreAlike) {
  // Alike for three thousand, then not, then NaN, then zeros of both signs.
  const auto tuple = [](std::size_t i) {
    std::array<float, 3> t{1.0F, -2.0F, 3.0F};
    if (i >= 3000 && i < 5000) t[1] = static_cast<float>(i);
    if (i >= 5000 && i < 8000) t = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F};
    if (i >= 8000) t = {i % 2 == 0 ? 0.0F : -0.0F, 0.0F, 0.0F};
    return t;
  };
  for (const std::size_t tuples : {std::size_t{0}, std::size_t{1}, std::size_t{1024}, std::size_t{10000}}) {
    Column<float> column(3);
    for (std::size_t i = 0; i < tuples; ++i) column.add(tuple(i).data());
    column.finish();
    ASSERT_EQ(column.tuples(), tuples);
    for (std::size_t i = 0; i < tuples; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = column.value(3 * i + c), expected = tuple(i)[c];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(expected)) << i << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace abut::output
