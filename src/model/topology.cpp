#include "model/topology.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace abut::model {

namespace {

/// Faces of the brick in local nodes, normals outward for a positive volume.
constexpr std::array<std::array<std::size_t, 4>, 6> brick_faces{
    {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}}};
constexpr std::array<std::array<std::size_t, 3>, 4> tetra_faces{{{0, 2, 3}, {1, 3, 2}, {0, 1, 2}, {0, 3, 1}}};

/// Distinct nodes, first occurrence kept; fewer than three: no face.
Face distinct(const std::array<Index, 4>& nodes) {
  Face f{no_index, no_index, no_index, no_index};
  std::size_t n = 0;
  for (const Index node : nodes) {
    if (std::find(f.begin(), f.begin() + n, node) == f.begin() + n) f[n++] = node;
  }
  return n < 3 ? Face{no_index, no_index, no_index, no_index} : f;
}

std::size_t corner_count(const Face& f) { return f[3] == no_index ? 3 : 4; }

/// The face from its smallest node on, in the sense in which the second node is smaller than the last; `flipped` tells whether it was
/// turned.
std::pair<Face, bool> canonical(const Face& f) {
  const std::size_t n = corner_count(f);
  Face out{no_index, no_index, no_index, no_index};
  const auto begin = static_cast<std::size_t>(std::min_element(f.begin(), f.begin() + n) - f.begin());
  for (std::size_t k = 0; k < n; ++k) out[k] = f[(begin + k) % n];
  const bool flip = out[n - 1] < out[1];
  if (flip) std::swap(out[1], out[n - 1]);
  return {out, flip};
}

double thickness_of(const Model& m, Index part, double own) {
  if (own > 0.0) return own;
  const Index property = m.parts[static_cast<std::size_t>(part)].property;
  if (property == no_index) return 0.0;
  const auto& data = m.properties[static_cast<std::size_t>(property)].data;
  if (const auto* shell = std::get_if<ShellProperty>(&data)) return shell->thickness;
  if (const auto* empty = std::get_if<VoidProperty>(&data)) return empty->thickness;
  return 0.0;
}

double young_of(const Model& m, Index part) {
  const Index material = m.parts[static_cast<std::size_t>(part)].material;
  if (material == no_index) return 0.0;
  return std::visit([](const auto& law) { return law.young; }, m.materials[static_cast<std::size_t>(material)].law);
}

}  // namespace

double one_point_volume(const std::array<Vec3, 8>& x) {
  const Vec3 x17 = x[6] - x[0];
  const Vec3 x28 = x[7] - x[1];
  const Vec3 x35 = x[4] - x[2];
  const Vec3 x46 = x[5] - x[3];
  // dx/dxi, dx/deta, dx/dzeta at the centre, each times 8
  const Vec3 a = x17 - x28 - x35 + x46;
  const Vec3 b = x17 + x28 - x35 - x46;
  const Vec3 c = x17 + x28 + x35 + x46;
  return dot(cross(a, b), c) / 64.0;
}

int inverted_corners(const std::array<Vec3, 8>& x) {
  static constexpr std::size_t ends[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  constexpr double straight = 1e-6;
  const double size = std::abs(one_point_volume(x));
  int inverted = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    if (dot(cross(x[ends[k][0]] - x[k], x[ends[k][1]] - x[k]), x[ends[k][2]] - x[k]) < -straight * size) ++inverted;
  }
  return inverted;
}

bool has_crossed_face(const std::array<Vec3, 8>& x) {
  static constexpr std::size_t faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return std::any_of(std::begin(faces), std::end(faces), [&x](const auto& f) {
    const std::array<Vec3, 4> face{x[f[0]], x[f[1]], x[f[2]], x[f[3]]};
    constexpr double flat = 1e-12;  // both halves of a crossed square are the same: no area is left
    const double size = std::max(squared_norm(face[2] - face[0]), squared_norm(face[3] - face[1]));
    return !(facet_area(face) > flat * size) || turned_corners(face) > 1;
  });
}

Id element_id(const Model& model, const ElementRef& element) {
  const auto i = static_cast<std::size_t>(element.index);
  switch (element.kind) {
    case ElementKind::shell4:
      return model.shells.id[i];
    case ElementKind::shell3:
      return model.sh3ns.id[i];
    case ElementKind::brick:
      return model.bricks.id[i];
    case ElementKind::tetra:
      return model.tetras.id[i];
    case ElementKind::none:
      break;
  }
  return 0;
}

double shape_volume(const std::array<Vec3, 8>& x) {
  static constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  const double g = 1.0 / std::sqrt(3.0);
  double volume = 0.0;
  for (const auto& p : sign) {
    std::array<Vec3, 3> d;
    for (std::size_t i = 0; i < 8; ++i) {
      const auto& s = sign[i];
      const double f[3] = {1.0 + s[0] * p[0] * g, 1.0 + s[1] * p[1] * g, 1.0 + s[2] * p[2] * g};
      d[0] += 0.125 * s[0] * f[1] * f[2] * x[i];
      d[1] += 0.125 * s[1] * f[2] * f[0] * x[i];
      d[2] += 0.125 * s[2] * f[0] * f[1] * x[i];
    }
    volume += dot(cross(d[0], d[1]), d[2]);
  }
  return volume;
}

double tetra_volume(const std::array<Vec3, 4>& x) { return -dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]) / 6.0; }

double facet_area(const std::array<Vec3, 4>& x) { return 0.5 * norm(cross(x[2] - x[0], x[3] - x[1])); }

const char* why_no_area(const std::array<Vec3, 4>& x) {
  const double size = std::max(squared_norm(x[2] - x[0]), squared_norm(x[3] - x[1]));
  const bool has_corner = norm(cross(x[1] - x[0], x[2] - x[0])) > 1e-9 * size && norm(cross(x[2] - x[0], x[3] - x[0])) > 1e-9 * size;
  return has_corner ? "the order of its nodes is crossed: list them one after the other around its border"
                    : "its nodes must be distinct and not on one line";
}

int turned_corners(const std::array<Vec3, 4>& x) {
  constexpr double straight = 1e-6;
  const Vec3 normal = cross(x[2] - x[0], x[3] - x[1]);
  const double size = squared_norm(normal);
  int turned = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (dot(cross(x[(k + 1) % 4] - x[k], x[(k + 3) % 4] - x[k]), normal) < -straight * size) ++turned;
  }
  return turned;
}

Index solid_count(const Model& m) { return m.bricks.size() + m.tetras.size(); }

std::span<const Index> solid_nodes(const Model& m, Index solid) {
  if (solid < m.bricks.size()) return m.bricks.nodes[static_cast<std::size_t>(solid)];
  return m.tetras.nodes[static_cast<std::size_t>(solid - m.bricks.size())];
}

ElementRef solid_ref(const Model& m, Index solid) {
  if (solid < m.bricks.size()) return {ElementKind::brick, solid};
  return {ElementKind::tetra, solid - m.bricks.size()};
}

Index solid_part(const Model& m, Index solid) {
  if (solid < m.bricks.size()) return m.bricks.part[static_cast<std::size_t>(solid)];
  return m.tetras.part[static_cast<std::size_t>(solid - m.bricks.size())];
}

std::array<Face, 6> solid_faces(const Model& m, Index solid) {
  std::array<Face, 6> faces;
  faces.fill({no_index, no_index, no_index, no_index});
  const std::span<const Index> n = solid_nodes(m, solid);
  if (n.size() == 8) {
    for (std::size_t k = 0; k < 6; ++k) {
      const auto& f = brick_faces[k];
      faces[k] = distinct({n[f[0]], n[f[1]], n[f[2]], n[f[3]]});
    }
  } else {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& f = tetra_faces[k];
      faces[k] = distinct({n[f[0]], n[f[1]], n[f[2]], n[f[2]]});
    }
  }
  return faces;
}

Face sorted_face(Face f) {
  std::sort(f.begin(), f.begin() + corner_count(f));
  return f;
}

std::array<Index, 4> segment_nodes(const Face& f) { return {f[0], f[1], f[2], f[3] == no_index ? f[2] : f[3]}; }

std::vector<SolidFace> external_faces(const Model& m, const std::vector<Index>& solids, const std::vector<Index>& candidates) {
  struct Entry {
    Face key;
    Index solid;
    std::uint8_t local;
    bool flipped;
  };
  std::vector<Entry> entries;
  entries.reserve(6 * candidates.size());
  for (const Index s : candidates) {
    const std::array<Face, 6> faces = solid_faces(m, s);
    for (std::size_t k = 0; k < 6; ++k) {
      if (faces[k][0] == no_index) continue;
      const auto [key, flipped] = canonical(faces[k]);
      entries.push_back({key, s, static_cast<std::uint8_t>(k), flipped});
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.key, a.solid, a.local) < std::tie(b.key, b.solid, b.local); });
  std::vector<std::pair<Index, std::uint8_t>> outside;
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first;
    // Owners of each sense: a face is internal when another solid has it the other way round.
    std::array<Index, 2> owner{no_index, no_index};
    std::array<bool, 2> several{};
    for (; last < entries.size() && entries[last].key == entries[first].key; ++last) {
      const std::size_t sense = entries[last].flipped ? 1 : 0;
      if (owner[sense] == no_index) owner[sense] = entries[last].solid;
      several[sense] = several[sense] || owner[sense] != entries[last].solid;
    }
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t other = entries[k].flipped ? 0 : 1;
      const bool internal = owner[other] != no_index && (several[other] || owner[other] != entries[k].solid);
      if (!internal) outside.emplace_back(entries[k].solid, entries[k].local);
    }
    first = last;
  }
  std::sort(outside.begin(), outside.end());
  std::vector<SolidFace> out;
  out.reserve(outside.size());
  for (const auto& [solid, local] : outside) {
    if (std::binary_search(solids.begin(), solids.end(), solid)) out.push_back({solid, solid_faces(m, solid)[local]});
  }
  return out;
}

template <class Nodes>
NodeElements::Rows NodeElements::make_rows(Index node_count, Index element_count, const Nodes& nodes_of) {
  Rows rows;
  rows.start.assign(static_cast<std::size_t>(node_count) + 1, 0);
  for (Index e = 0; e < element_count; ++e) {
    for (const Index n : nodes_of(e)) ++rows.start[static_cast<std::size_t>(n) + 1];
  }
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.element.resize(static_cast<std::size_t>(rows.start.back()));
  std::vector<Index> next(rows.start.begin(), rows.start.end() - 1);
  for (Index e = 0; e < element_count; ++e) {
    for (const Index n : nodes_of(e)) rows.element[static_cast<std::size_t>(next[static_cast<std::size_t>(n)]++)] = e;
  }
  return rows;
}

NodeElements::NodeElements(const Model& m)
    : shells_(make_rows(m.node_count(), m.shells.size(), [&](Index e) { return std::span(m.shells.nodes[static_cast<std::size_t>(e)]); })),
      sh3ns_(make_rows(m.node_count(), m.sh3ns.size(), [&](Index e) { return std::span(m.sh3ns.nodes[static_cast<std::size_t>(e)]); })),
      solids_(make_rows(m.node_count(), solid_count(m), [&](Index e) { return solid_nodes(m, e); })) {}

ElementRef NodeElements::behind(const Model& m, const std::array<Index, 4>& segment) const {
  const Face face = distinct(segment);
  if (face[0] == no_index) return {};
  const Face key = sorted_face(face);
  ElementRef best;
  for (const Index s : solids_.at(segment[0])) {
    for (const Face& f : solid_faces(m, s)) {
      if (best.kind == ElementKind::none && f[0] != no_index && sorted_face(f) == key) best = solid_ref(m, s);
    }
  }
  double thickest = -1.0;
  double stiffest = -1.0;
  const auto offer = [&](ElementRef ref, const Face& f, Index part, double own_thickness) {
    if (f[0] == no_index || sorted_face(f) != key) return;
    const double t = thickness_of(m, part, own_thickness);
    const double young = young_of(m, part);
    if (t > thickest || (t == thickest && young > stiffest)) {
      best = ref;
      thickest = t;
      stiffest = young;
    }
  };
  for (const Index e : shells_.at(segment[0])) {
    const auto i = static_cast<std::size_t>(e);
    offer({ElementKind::shell4, e}, distinct(m.shells.nodes[i]), m.shells.part[i], m.shells.own_thickness(i));
  }
  for (const Index e : sh3ns_.at(segment[0])) {
    const auto i = static_cast<std::size_t>(e);
    const auto& n = m.sh3ns.nodes[i];
    offer({ElementKind::shell3, e}, distinct({n[0], n[1], n[2], n[2]}), m.sh3ns.part[i], m.sh3ns.own_thickness(i));
  }
  return best;
}

}  // namespace abut::model
