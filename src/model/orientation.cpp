#include "model/orientation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/measure.hpp"

namespace abut::model {

namespace {

using Face = std::array<Index, 4>;

Face key_of(Face f) {
  std::sort(f.begin(), f.end());
  const auto end = std::unique(f.begin(), f.end());
  std::fill(end, f.end(), no_index);
  return f;
}

/// The segment without repeated corners: a triangle repeats its third node and nothing else (E.1, clean-up).
/// @return true when it had to be changed
bool clean(Face& n) {
  const Face before = n;
  if (n[3] == n[0]) n[3] = n[2];
  if (n[1] == n[2]) n[2] = n[3];
  if (n[0] == n[1]) n = {n[0], n[2], n[3], n[3]};
  return n != before;
}

Face reversed(const Face& n) {
  return n[2] == n[3] ? Face{n[1], n[0], n[2], n[2]} : Face{n[3], n[2], n[1], n[0]};
}

constexpr std::array<std::array<int, 4>, 6> brick_faces{
    {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}}};
constexpr std::array<std::array<int, 3>, 4> tetra_faces{{{0, 2, 3}, {1, 3, 2}, {0, 1, 2}, {0, 3, 1}}};

struct SolidAtFace {
  int count = 0;
  Vec3 centre;  ///< mean of the solid's nodes
};

template <std::size_t N>
Vec3 centre_of(const Model& m, const std::array<Index, N>& nodes) {
  Vec3 sum;
  for (const Index n : nodes) sum += m.node_x[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(N);
}

/// Solids at those faces whose nodes are all marked.
std::map<Face, SolidAtFace> solids_at_faces(const Model& m, const std::vector<bool>& marked) {
  std::map<Face, SolidAtFace> faces;
  const auto is_marked = [&](Index n) { return marked[static_cast<std::size_t>(n)]; };
  const auto add = [&](const Face& face, const Vec3& centre) {
    const Face key = key_of(face);
    if (key[2] == no_index) return;  // an edge or a point of a degenerate brick
    SolidAtFace& solid = faces[key];
    ++solid.count;
    solid.centre = centre;
  };
  for (const auto& nodes : m.bricks.nodes) {
    if (std::count_if(nodes.begin(), nodes.end(), is_marked) < 3) continue;
    for (const auto& f : brick_faces) {
      Face face;
      for (std::size_t i = 0; i < 4; ++i) face[i] = nodes[static_cast<std::size_t>(f[i])];
      if (std::all_of(face.begin(), face.end(), is_marked)) add(face, centre_of(m, nodes));
    }
  }
  for (const auto& nodes : m.tetras.nodes) {
    if (std::count_if(nodes.begin(), nodes.end(), is_marked) < 3) continue;
    for (const auto& f : tetra_faces) {
      const Face face{nodes[static_cast<std::size_t>(f[0])], nodes[static_cast<std::size_t>(f[1])],
                      nodes[static_cast<std::size_t>(f[2])], nodes[static_cast<std::size_t>(f[2])]};
      if (std::all_of(face.begin(), face.end(), is_marked)) add(face, centre_of(m, nodes));
    }
  }
  return faces;
}

bool on_shell(const Segment& s) { return s.element.kind == ElementKind::shell4 || s.element.kind == ElementKind::shell3; }

/// Segments that look into the one solid behind them are turned.
int turn_outward(const Model& m, std::vector<Segment>& segments) {
  std::vector<bool> marked(m.node_id.size(), false);
  bool any = false;
  for (const Segment& s : segments) {
    if (on_shell(s)) continue;
    any = true;
    for (const Index n : s.nodes) marked[static_cast<std::size_t>(n)] = true;
  }
  if (!any) return 0;
  const std::map<Face, SolidAtFace> faces = solids_at_faces(m, marked);
  int turned = 0;
  for (Segment& s : segments) {
    if (on_shell(s)) continue;
    const auto solid = faces.find(key_of(s.nodes));
    if (solid == faces.end() || solid->second.count != 1) continue;
    if (dot(face_area(m, s.nodes), solid->second.centre - centre_of(m, s.nodes)) < 0.0) continue;
    s.nodes = reversed(s.nodes);
    ++turned;
  }
  return turned;
}

}  // namespace

Index SegmentOrientation::apply(Context& c, Index surface, int flag, const Place& place) {
  if (surface == no_index) return surface;
  const auto found = done_.find({surface, flag});
  if (found != done_.end()) return found->second;
  Model& m = *c.model;
  std::vector<Segment> segments = m.surfaces[static_cast<std::size_t>(surface)].segments;
  const Id id = m.surfaces[static_cast<std::size_t>(surface)].id;
  int cleaned = 0;
  for (Segment& s : segments) cleaned += clean(s.nodes) ? 1 : 0;
  if (cleaned > 0) {
    c.diagnostics->warning("model.repeated_corner", place,
                           fmt::format("{} segments of surface {} name a corner twice; they are used as triangles (write the third node twice)",
                                       cleaned, id));
  }
  int turned = 0;
  if (flag == 0) {
    turned = turn_outward(m, segments);
    if (turned > 0) {
      c.diagnostics->note("model.segments_turned", place,
                          fmt::format("{} of {} segments of surface {} looked into their solid and were turned", turned, segments.size(), id));
    }
  } else if (flag == 1) {
    for (Segment& s : segments) {
      s.nodes = s.nodes[2] == s.nodes[3] ? reversed(s.nodes) : Face{s.nodes[1], s.nodes[0], s.nodes[3], s.nodes[2]};
    }
    turned = static_cast<int>(segments.size());
  }
  Index result = surface;
  if (cleaned + turned > 0) {
    Surface copy = m.surfaces[static_cast<std::size_t>(surface)];
    copy.segments = std::move(segments);
    result = static_cast<Index>(m.surfaces.size());
    m.surfaces.push_back(std::move(copy));
  }
  done_.emplace(std::tuple{surface, flag}, result);
  return result;
}

}  // namespace abut::model
