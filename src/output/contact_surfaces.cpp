#include "output/contact_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "output/cell_shape.hpp"

namespace abut::output {
namespace {

bool is_triangle(const model::Segment& segment) { return segment.nodes[3] == segment.nodes[2]; }

}  // namespace

VtuGrid contact_surfaces(const model::Model& model) {
  using Type = VtuArray::Type;
  // Which cells lie on which side of which interface.
  struct Piece {
    std::size_t first;
    Id interface;
    const model::Surface* surface;
    int side;
  };
  std::vector<Piece> pieces;
  std::size_t cells = 0, corners = 0;
  for (const model::Interface& card : model.interfaces) {
    const std::array<Index, 2> surfaces = model::surfaces_of(card);
    for (std::size_t side = 0; side < 2; ++side) {
      if (surfaces[side] == no_index) continue;
      const model::Surface& surface = model.surfaces[static_cast<std::size_t>(surfaces[side])];
      if (surface.segments.empty()) continue;
      pieces.push_back({cells, card.id, &surface, static_cast<int>(side) + 1});
      cells += surface.segments.size();
      for (const model::Segment& segment : surface.segments) corners += is_triangle(segment) ? 3 : 4;
    }
  }
  const auto piece_of = [pieces](std::size_t c) {
    return *std::prev(std::upper_bound(pieces.begin(), pieces.end(), c, [](std::size_t at, const Piece& p) { return at < p.first; }));
  };
  const auto segment_of = [piece_of](std::size_t c) -> const model::Segment& {
    const Piece piece = piece_of(c);
    return piece.surface->segments[c - piece.first];
  };

  VtuGrid grid;
  const std::size_t points = model.node_x.size();
  grid.point_data = {VtuArray::of<std::int64_t>("node_id", Type::int64, 1, points, [&model](std::size_t n) { return model.node_id[n]; })};
  grid.cell_data = {
      VtuArray::of<std::int64_t>("interface_id", Type::int64, 1, cells, [piece_of](std::size_t c) { return piece_of(c).interface; }),
      VtuArray::of<std::int64_t>("surface_id", Type::int64, 1, cells, [piece_of](std::size_t c) { return piece_of(c).surface->id; }),
      VtuArray::of<std::int64_t>("side", Type::int64, 1, cells, [piece_of](std::size_t c) { return piece_of(c).side; })};
  grid.points = VtuArray::of<double>("Points", Type::float64, 3, points,
                                     [&model](std::size_t i) { return model.node_x[i / 3][static_cast<int>(i % 3)]; });
  grid.connectivity = VtuArray::of<std::int32_t>("connectivity", Type::int32, 1, corners,
                                                 [segment_of, c = std::size_t{0}, corner = std::size_t{0}](std::size_t) mutable {
                                                   const model::Segment& segment = segment_of(c);
                                                   const Index node = segment.nodes[corner++];
                                                   if (corner == (is_triangle(segment) ? 3U : 4U)) {
                                                     corner = 0;
                                                     ++c;
                                                   }
                                                   return node;
                                                 });
  grid.offsets = VtuArray::of<std::int64_t>("offsets", Type::int64, 1, cells, [segment_of, end = std::int64_t{0}](std::size_t c) mutable {
    return end += is_triangle(segment_of(c)) ? 3 : 4;
  });
  grid.types = VtuArray::of<std::uint8_t>("types", Type::uint8, 1, cells, [segment_of](std::size_t c) {
    return vtk_number(is_triangle(segment_of(c)) ? CellKind::triangle : CellKind::quadrilateral);
  });
  return grid;
}

}  // namespace abut::output
