#include "model/orientation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "model/measure.hpp"
#include "model/topology.hpp"

namespace abut::model {

namespace {

/// The segment without repeated corners: a triangle repeats its third node and nothing else (E.1, clean-up).
/// @return true when it had to be changed
bool clean(std::array<Index, 4>& n) {
  const std::array<Index, 4> before = n;
  if (n[3] == n[0]) n[3] = n[2];
  if (n[1] == n[2]) n[2] = n[3];
  if (n[0] == n[1]) n = {n[0], n[2], n[3], n[3]};
  return n != before;
}

std::array<Index, 4> reversed(const std::array<Index, 4>& n) {
  using Nodes = std::array<Index, 4>;
  return n[2] == n[3] ? Nodes{n[1], n[0], n[2], n[2]} : Nodes{n[3], n[2], n[1], n[0]};
}

Vec3 mean_position(const Model& m, std::span<const Index> nodes) {
  Vec3 sum;
  for (const Index n : nodes) sum += m.node_x[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size());
}

struct SolidAtFace {
  int count = 0;
  Vec3 centre;  ///< mean of the solid's nodes
};

/// Solids at those faces whose nodes are all marked.
std::map<Face, SolidAtFace> solids_at_faces(const Model& m, const std::vector<bool>& marked) {
  std::map<Face, SolidAtFace> faces;
  const auto is_marked = [&](Index n) { return n == no_index || marked[static_cast<std::size_t>(n)]; };
  for (Index solid = 0; solid < solid_count(m); ++solid) {
    const std::span<const Index> nodes = solid_nodes(m, solid);
    if (std::count_if(nodes.begin(), nodes.end(), is_marked) < 3) continue;
    for (const Face& face : solid_faces(m, solid)) {
      if (face[0] == no_index || !std::all_of(face.begin(), face.end(), is_marked)) continue;
      SolidAtFace& at = faces[sorted_face(face)];
      ++at.count;
      at.centre = mean_position(m, nodes);
    }
  }
  return faces;
}

/// The face that a segment's nodes make: unused places hold no_index.
Face face_of(const std::array<Index, 4>& n) { return {n[0], n[1], n[2], n[3] == n[2] ? no_index : n[3]}; }

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
    const auto solid = faces.find(sorted_face(face_of(s.nodes)));
    if (solid == faces.end() || solid->second.count != 1) continue;
    if (dot(face_area(m, s.nodes), solid->second.centre - mean_position(m, s.nodes)) < 0.0) continue;
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
    c.diagnostics->warning(
        "model.repeated_corner", place,
        fmt::format("{} segments of surface {} name a corner twice; they are used as triangles (write the third node twice)", cleaned, id));
  }
  int turned = 0;
  if (flag == 0) {
    turned = turn_outward(m, segments);
    if (turned > 0) {
      c.diagnostics->note(
          "model.segments_turned", place,
          fmt::format("{} of {} segments of surface {} looked into their solid and were turned", turned, segments.size(), id));
    }
  } else if (flag == 1) {
    for (Segment& s : segments) {
      s.nodes = s.nodes[2] == s.nodes[3] ? reversed(s.nodes) : std::array<Index, 4>{s.nodes[1], s.nodes[0], s.nodes[3], s.nodes[2]};
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
