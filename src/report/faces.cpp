#include "report/faces.hpp"

#include <algorithm>

namespace abut::report {
namespace {

using Corners = std::array<int, 4>;  // -1: a triangle

/// Faces by corner numbers in VTK's order, outward.
std::span<const Corners> faces_of(Shape shape) {
  static constexpr Corners tetrahedron[] = {{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}};
  static constexpr Corners pyramid[] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
  static constexpr Corners wedge[] = {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static constexpr Corners hexahedron[] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  static constexpr Corners quadrilateral[] = {{0, 1, 2, 3}};
  static constexpr Corners triangle[] = {{0, 1, 2, -1}};
  switch (shape) {
    case Shape::triangle:
      return triangle;
    case Shape::quadrilateral:
      return quadrilateral;
    case Shape::tetrahedron:
      return tetrahedron;
    case Shape::pyramid:
      return pyramid;
    case Shape::wedge:
      return wedge;
    case Shape::hexahedron:
      return hexahedron;
  }
  return {};
}

struct Candidate {
  std::array<Index, 4> key{};  ///< nodes, ascending; of a triangle no_index first
  Face face;
  Index order = 0;
};

/// Distinct corners in their order; fewer than three: no face.
bool make(const Cell& cell, const Corners& corners, Candidate& out) {
  std::array<Index, 4> distinct{};
  std::size_t count = 0;
  for (const int corner : corners) {
    if (corner < 0) continue;
    const Index n = cell.nodes[static_cast<std::size_t>(corner)];
    if (std::find(distinct.begin(), distinct.begin() + static_cast<std::ptrdiff_t>(count), n) ==
        distinct.begin() + static_cast<std::ptrdiff_t>(count)) {
      distinct[count++] = n;
    }
  }
  if (count < 3) return false;
  if (count == 3) distinct[3] = distinct[2];
  out.face.nodes = distinct;
  out.key = distinct;
  if (count == 3) out.key[3] = no_index;
  std::sort(out.key.begin(), out.key.end());
  return true;
}

}  // namespace

FaceSet::FaceSet(std::span<const Cell> cells, std::span<const std::uint8_t> erodes) {
  std::vector<Candidate> shells, solids;
  Index order = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const Corners& corners : faces_of(cells[c].shape)) {
      Candidate candidate;
      if (!make(cells[c], corners, candidate)) continue;
      candidate.face.cell = static_cast<Index>(c);
      candidate.order = order++;
      (cells[c].solid() ? solids : shells).push_back(candidate);
    }
  }
  std::sort(solids.begin(), solids.end(),
            [](const Candidate& a, const Candidate& b) { return a.key != b.key ? a.key < b.key : a.order < b.order; });
  struct Kept {
    Index order;
    Face face;
    std::vector<Index> others;
  };
  std::vector<Kept> kept;
  for (const Candidate& s : shells) kept.push_back({s.order, s.face, {}});
  for (std::size_t first = 0; first < solids.size();) {
    std::size_t last = first;
    bool opens = false;
    while (last < solids.size() && solids[last].key == solids[first].key) {
      opens = opens || erodes[static_cast<std::size_t>(solids[last].face.cell)] != 0;
      ++last;
    }
    for (std::size_t i = first; (last - first == 1 || opens) && i < last; ++i) {
      Kept k{solids[i].order, solids[i].face, {}};
      for (std::size_t j = first; j < last; ++j) {
        if (j != i) k.others.push_back(solids[j].face.cell);
      }
      kept.push_back(std::move(k));
    }
    first = last;
  }
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.order < b.order; });
  for (Kept& k : kept) {
    faces_.push_back(k.face);
    others_.push_back(std::move(k.others));
  }
}

std::vector<std::uint8_t> FaceSet::hidden(std::span<const std::uint8_t> active) const {
  std::vector<std::uint8_t> out(faces_.size());
  const auto is_active = [active](Index cell) { return active[static_cast<std::size_t>(cell)] != 0; };
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    out[f] = !is_active(faces_[f].cell) || std::any_of(others_[f].begin(), others_[f].end(), is_active) ? 1 : 0;
  }
  return out;
}

}  // namespace abut::report
