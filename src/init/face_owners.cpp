#include "init/face_owners.hpp"

#include <algorithm>

namespace abut::init {

namespace {

using model::ElementKind;
using model::ElementRef;

FaceKey face_key(std::array<Index, 4> n) {
  std::sort(n.begin(), n.end());
  const auto last = std::unique(n.begin(), n.end());
  std::fill(last, n.end(), no_index);
  return n;
}

/// Repeated nodes of a degenerate face dropped, order kept; a triangle repeats its third node.
std::array<Index, 4> distinct_first(const std::array<Index, 4>& face) {
  std::array<Index, 4> out{};
  std::size_t count = 0;
  for (const Index n : face) {
    if (std::find(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count), n) == out.begin() + static_cast<std::ptrdiff_t>(count))
      out[count++] = n;
  }
  if (count == 3) out[3] = out[2];
  return out;
}

constexpr int brick_faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};

}  // namespace

std::array<Index, 4> face_of(const model::Model& model, const ElementRef& e, const FaceKey& key) {
  if (e.kind == ElementKind::shell4) return model.shells.nodes[static_cast<std::size_t>(e.index)];
  if (e.kind == ElementKind::brick) {
    const auto& n = model.bricks.nodes[static_cast<std::size_t>(e.index)];
    for (const auto& f : brick_faces) {
      const std::array<Index, 4> face{n[static_cast<std::size_t>(f[0])], n[static_cast<std::size_t>(f[1])],
                                      n[static_cast<std::size_t>(f[2])], n[static_cast<std::size_t>(f[3])]};
      if (face_key(face) == key) return distinct_first(face);
    }
  }
  return {key[0], key[1], key[2], key[2]};
}

FaceOwners::FaceOwners(const model::Model& model) {
  for (Index e = 0; e < model.shells.size(); ++e) add(model.shells.nodes[static_cast<std::size_t>(e)], {ElementKind::shell4, e});
  for (Index e = 0; e < model.sh3ns.size(); ++e) {
    const auto& n = model.sh3ns.nodes[static_cast<std::size_t>(e)];
    add({n[0], n[1], n[2], n[2]}, {ElementKind::shell3, e});
  }
  for (Index e = 0; e < model.bricks.size(); ++e) {
    const auto& n = model.bricks.nodes[static_cast<std::size_t>(e)];
    for (const auto& f : brick_faces) {
      add({n[static_cast<std::size_t>(f[0])], n[static_cast<std::size_t>(f[1])], n[static_cast<std::size_t>(f[2])],
           n[static_cast<std::size_t>(f[3])]},
          {ElementKind::brick, e});
    }
  }
  static constexpr int sides[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
  for (Index e = 0; e < model.tetras.size(); ++e) {
    const auto& n = model.tetras.nodes[static_cast<std::size_t>(e)];
    for (const auto& f : sides) {
      const Index third = n[static_cast<std::size_t>(f[2])];
      add({n[static_cast<std::size_t>(f[0])], n[static_cast<std::size_t>(f[1])], third, third}, {ElementKind::tetra, e});
    }
  }
}

std::vector<ElementRef> FaceOwners::of(const std::array<Index, 4>& nodes) const {
  const auto found = owners_.find(face_key(nodes));
  return found == owners_.end() ? std::vector<ElementRef>{} : found->second;
}

void FaceOwners::add(const std::array<Index, 4>& nodes, ElementRef e) {
  const FaceKey key = face_key(nodes);
  if (key[2] != no_index) owners_[key].push_back(e);  // else a side that a degenerate solid has collapsed to a line or a point
}

}  // namespace abut::init
