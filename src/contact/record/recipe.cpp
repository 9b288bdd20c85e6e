#include "contact/record/recipe.hpp"

#include <algorithm>

#include "contact/record/fields.hpp"

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class T>
void replace(std::vector<T>& values, std::span<const T> by) {
  if (!by.empty()) values.assign(by.begin(), by.end());
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

}  // namespace

void SurfaceFlags::take(const SurfaceState& state) {
  stiffness = stiffness || !state.stiffness.empty();
  thickness = thickness || !state.thickness.empty();
  replace(active, state.active);
  replace(node_active, state.node_active);
}

Recipe::Topology::Topology(const Surface& surface)
    : facets(surface.facets().begin(), surface.facets().end()), order(surface.nodes().begin(), surface.nodes().end()) {}

Surface Recipe::Topology::surface() const {
  Index largest = no_index;
  for (const Index n : order) largest = std::max(largest, n);
  std::vector<Id> key(at(largest + 1), 0);
  for (std::size_t s = 0; s < order.size(); ++s) key[at(order[s])] = static_cast<Id>(s);
  return Surface(facets, key);
}

void Recipe::collect() {
  hosted = nodes;
  for (const Topology& t : side) hosted.insert(hosted.end(), t.order.begin(), t.order.end());
  std::sort(hosted.begin(), hosted.end());
  hosted.erase(std::unique(hosted.begin(), hosted.end()), hosted.end());
}

Recipe Recipe::compact() const {
  Recipe r = *this;
  const auto rename = [this](Index& n) { n = static_cast<Index>(std::lower_bound(hosted.begin(), hosted.end(), n) - hosted.begin()); };
  for (Topology& t : r.side) {
    for (Facet& f : t.facets) std::for_each(f.node.begin(), f.node.end(), rename);
    std::for_each(t.order.begin(), t.order.end(), rename);
  }
  std::for_each(r.nodes.begin(), r.nodes.end(), rename);
  std::for_each(r.hosted.begin(), r.hosted.end(), rename);
  return r;
}

std::uint64_t Recipe::fingerprint() const {
  const Recipe r = compact();
  ByteWriter rules;
  rules.put(static_cast<std::uint32_t>(kind));
  rules.put(static_cast<std::uint32_t>(options.rules.edges));
  rules.put(static_cast<std::uint32_t>(options.rules.reference_friction ? 1 : 0));
  rules.put(static_cast<std::uint32_t>(both.friction_form));
  std::uint64_t hash = checksum(rules.bytes());
  for (const Topology& t : r.side) hash = checksum(bytes_of(t.order), checksum(bytes_of(t.facets), hash));
  return checksum(bytes_of(r.nodes), hash);
}

Interface Recipe::make() const {
  switch (kind) {
    case Kind::nodes_to_surface:
      return Interface::nodes_to_surface(nodes, node_stiffness, side[1].surface(), options);
    case Kind::both_sides:
      return Interface::both_sides(nodes, side[1].surface(), both);
    case Kind::two_surfaces:
      break;
  }
  return Interface::two_surfaces(side[0].surface(), side[1].surface(), options);
}

void Recipe::write(ByteWriter& out) const {
  out.put(kind);
  for (const Topology& t : side) {
    out.put_all(t.facets);
    out.put_all(t.order);
  }
  out.put_all(nodes);
  out.put_all(node_stiffness);
  FieldWriter fields_out(out);
  fields(fields_out, options);
  fields(fields_out, both);
}

Recipe Recipe::read(ByteReader& in) {
  Recipe r;
  FieldReader fields_in(in);
  fields_in.choice(r.kind, Kind::both_sides);
  for (Topology& t : r.side) {
    in.get_any(t.facets);
    in.get_any(t.order);
    for (const Index n : t.order) {
      if (n < 0) in.refuse("has a negative node number");
    }
    std::vector<Index> listed = t.order, met;
    for (const Facet& f : t.facets) met.insert(met.end(), f.node.begin(), f.node.end());
    for (std::vector<Index>* v : {&listed, &met}) {
      std::sort(v->begin(), v->end());
      v->erase(std::unique(v->begin(), v->end()), v->end());
    }
    if (listed != met || listed.size() != t.order.size()) in.refuse("has a surface whose facets and nodes do not fit");
  }
  in.get_any(r.nodes);
  in.get_any(r.node_stiffness);
  fields(fields_in, r.options);
  fields(fields_in, r.both);
  r.collect();
  if (!r.hosted.empty() && (r.hosted.front() < 0 || at(r.hosted.back()) >= r.hosted.size())) in.refuse("has node numbers with holes");
  return r;
}

}  // namespace abut::contact
