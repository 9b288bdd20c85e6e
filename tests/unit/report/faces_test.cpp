// What is seen of a mesh: outer faces of solids, looking outward; deleted solids lay open what is behind them.
#include "report/faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "abut/vec3.hpp"

namespace abut::report {
namespace {

/// n x n x n bricks on unit cells.
struct Cube {
  explicit Cube(int n) {
    const auto at = [n](int i, int j, int k) { return static_cast<Index>(i + (n + 1) * (j + (n + 1) * k)); };
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) x.push_back({double(i), double(j), double(k)});
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          Cell c{Shape::hexahedron,
                 {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1),
                  at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)},
                 static_cast<Id>(cells.size()) + 1,
                 1};
          cells.push_back(c);
        }
  }
  std::vector<Vec3> x;
  std::vector<Cell> cells;
};

/// Volume inside closed faces by the divergence theorem: positive when they look outward.
double volume(std::span<const Face> faces, std::span<const std::uint8_t> hidden, const std::vector<Vec3>& x) {
  double sum = 0.0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (hidden[f] != 0) continue;
    const auto p = [&](std::size_t k) { return x[static_cast<std::size_t>(faces[f].nodes[k])]; };
    sum += dot(p(0), cross(p(1), p(2))) / 6.0;
    if (faces[f].nodes[3] != faces[f].nodes[2]) sum += dot(p(0), cross(p(2), p(3))) / 6.0;
  }
  return sum;
}

std::size_t seen(std::span<const std::uint8_t> hidden) { return static_cast<std::size_t>(std::count(hidden.begin(), hidden.end(), 0)); }

TEST(Faces, OfABlockOnlyItsSkin) {
  const Cube cube(3);
  const FaceSet set(cube.cells, std::vector<std::uint8_t>(27));
  EXPECT_EQ(set.faces().size(), 6u * 9u);
  const auto hidden = set.hidden(std::vector<std::uint8_t>(27, 1));
  EXPECT_EQ(seen(hidden), 54u);
  EXPECT_NEAR(volume(set.faces(), hidden, cube.x), 27.0, 1e-12);
}

TEST(Faces, DeletedSolidsOpenTheHoleTheyLeave) {
  const Cube cube(3);
  std::vector<std::uint8_t> erodes(27), active(27, 1);
  erodes[13] = erodes[4] = 1;  // the middle one, and the middle of the bottom
  const FaceSet set(cube.cells, erodes);
  EXPECT_EQ(seen(set.hidden(active)), 54u);
  active[4] = 0;
  EXPECT_EQ(seen(set.hidden(active)), 54u - 1u + 5u);
  EXPECT_NEAR(volume(set.faces(), set.hidden(active), cube.x), 26.0, 1e-12);
  active[13] = 0;
  EXPECT_NEAR(volume(set.faces(), set.hidden(active), cube.x), 25.0, 1e-12);
}

TEST(Faces, EveryShapeLooksOutward) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  struct Case {
    Cell cell;
    std::size_t faces;
    double volume;
  };
  // Corners in VTK's order: a wedge's base looks outward, a pyramid's towards its apex.
  const std::vector<Case> cases{{{Shape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 1, 1}, 6, 1.0},
                                {{Shape::tetrahedron, {0, 1, 3, 4}, 1, 1}, 4, 1.0 / 6.0},
                                {{Shape::pyramid, {0, 1, 2, 3, 4}, 1, 1}, 5, 1.0 / 3.0},
                                {{Shape::wedge, {0, 3, 1, 4, 7, 5}, 1, 1}, 5, 0.5},
                                {{Shape::hexahedron, {0, 1, 2, 2, 4, 5, 6, 6}, 1, 1}, 5, 0.5}};
  for (const Case& c : cases) {
    const FaceSet set(std::vector<Cell>{c.cell}, std::vector<std::uint8_t>(1));
    EXPECT_EQ(set.faces().size(), c.faces) << static_cast<int>(c.cell.shape);
    EXPECT_NEAR(volume(set.faces(), set.hidden(std::vector<std::uint8_t>{1}), x), c.volume, 1e-12) << static_cast<int>(c.cell.shape);
  }
}

TEST(Faces, AShellIsItsOwnFaceAndStaysOnASolid) {
  std::vector<Cell> cells = Cube(1).cells;
  cells.push_back({Shape::quadrilateral, {4, 5, 7, 6}, 1, 2});
  cells.push_back({Shape::triangle, {0, 1, 2}, 2, 2});
  const FaceSet set(cells, std::vector<std::uint8_t>(3));
  EXPECT_EQ(set.faces().size(), 8u);
  const auto hidden = set.hidden(std::vector<std::uint8_t>{1, 0, 1});
  EXPECT_EQ(seen(hidden), 7u);
}

}  // namespace
}  // namespace abut::report
