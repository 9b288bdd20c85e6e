#include "init/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simd/math.hpp"

namespace abut::init {

namespace {

using model::ElementKind;
using model::ElementRef;

double young_of(const model::Material& m) {
  return std::visit([](const auto& law) { return law.young; }, m.law);
}
double poisson_of(const model::Material& m) {
  return std::visit([](const auto& law) { return law.poisson; }, m.law);
}

/// One-point volume of a brick (numerics.md 4.1) or the volume of a tetrahedron.
double solid_volume(const model::Model& model, const ElementRef& e, std::span<const Vec3> x) {
  if (e.kind == ElementKind::tetra) {
    const auto& n = model.tetras.nodes[static_cast<std::size_t>(e.index)];
    const auto at = [&](int k) { return x[static_cast<std::size_t>(n[static_cast<std::size_t>(k)])]; };
    return std::abs(dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0)))) / 6.0;
  }
  const auto& n = model.bricks.nodes[static_cast<std::size_t>(e.index)];
  const auto at = [&](int k) { return x[static_cast<std::size_t>(n[static_cast<std::size_t>(k)])]; };
  const Vec3 d17 = at(6) - at(0);
  const Vec3 d28 = at(7) - at(1);
  const Vec3 d35 = at(4) - at(2);
  const Vec3 d46 = at(5) - at(3);
  return std::abs(dot(d17 - d28 - d35 + d46, cross(d17 + d28 - d35 - d46, d17 + d28 + d35 + d46))) / 64.0;
}

bool is_shell(const ElementRef& e) { return e.kind == ElementKind::shell4 || e.kind == ElementKind::shell3; }

}  // namespace

double property_thickness(const model::Property& p) {
  if (const auto* s = std::get_if<model::ShellProperty>(&p.data)) return s->thickness;
  if (const auto* v = std::get_if<model::VoidProperty>(&p.data)) return v->thickness;
  return 0.0;
}

Index part_of(const model::Model& model, const ElementRef& e) {
  const auto i = static_cast<std::size_t>(e.index);
  switch (e.kind) {
    case ElementKind::shell4:
      return model.shells.part[i];
    case ElementKind::shell3:
      return model.sh3ns.part[i];
    case ElementKind::brick:
      return model.bricks.part[i];
    case ElementKind::tetra:
      return model.tetras.part[i];
    case ElementKind::none:
      break;
  }
  return no_index;
}

double segment_stiffness(const model::Model& model, const model::Segment& segment, std::span<const Vec3> x) {
  const ElementRef& e = segment.element;
  const Index part = part_of(model, e);
  if (part == no_index) return 0.0;
  const model::Part& p = model.parts[static_cast<std::size_t>(part)];
  if (p.material == no_index || p.property == no_index) return 0.0;
  const model::Material& material = model.materials[static_cast<std::size_t>(p.material)];
  const double young = young_of(material);
  if (e.kind == ElementKind::shell4 || e.kind == ElementKind::shell3) {
    return young * property_thickness(model.properties[static_cast<std::size_t>(p.property)]);
  }
  const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(segment.nodes[k])]; };
  const double area = 0.5 * norm(cross(at(2) - at(0), at(3) - at(1)));
  const double bulk = young / (3.0 * (1.0 - 2.0 * poisson_of(material)));
  return bulk * area * area / solid_volume(model, e, x);
}

namespace {

const model::Material* material_of(const model::Model& model, const ElementRef& e) {
  const Index m = model.parts[static_cast<std::size_t>(part_of(model, e))].material;
  return m == no_index ? nullptr : &model.materials[static_cast<std::size_t>(m)];
}

/// Calls use(node, shell, E t) for each node of each shell, a triangle's third once.
template <class Use>
void each_shell_at_a_node(const model::Model& model, const Use& use) {
  const auto each = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const ElementRef ref{kind, e};
      const model::Material* material = material_of(model, ref);
      const Index property = model.parts[static_cast<std::size_t>(part_of(model, ref))].property;
      if (material == nullptr || property == no_index) continue;
      const double own = young_of(*material) * property_thickness(model.properties[static_cast<std::size_t>(property)]);
      for (const Index node : elements.nodes[static_cast<std::size_t>(e)]) use(node, ref, own);
    }
  };
  each(model.shells, ElementKind::shell4);
  each(model.sh3ns, ElementKind::shell3);
}

}  // namespace

std::vector<double> secondary_stiffness(const model::Model& model, std::span<const Index> nodes, std::span<const Vec3> x) {
  const auto n = static_cast<std::size_t>(model.node_count());
  std::vector<double> et(n, 0.0), volume(n, 0.0), bulk_volume(n, 0.0);
  std::vector<int> shells(n, 0);
  const auto add_solids = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const ElementRef ref{kind, e};
      const model::Material* material = material_of(model, ref);
      if (material == nullptr) continue;
      const auto& corners = elements.nodes[static_cast<std::size_t>(e)];
      const double share = solid_volume(model, ref, x) / static_cast<double>(corners.size());
      const double bulk = young_of(*material) / (3.0 * (1.0 - 2.0 * poisson_of(*material)));
      for (const Index node : corners) {
        volume[static_cast<std::size_t>(node)] += share;
        bulk_volume[static_cast<std::size_t>(node)] += bulk * share;
      }
    }
  };
  each_shell_at_a_node(model, [&](Index node, const ElementRef&, double own) {
    et[static_cast<std::size_t>(node)] += own;
    ++shells[static_cast<std::size_t>(node)];
  });
  add_solids(model.bricks, ElementKind::brick);
  add_solids(model.tetras, ElementKind::tetra);
  std::vector<double> out;
  for (const Index node : nodes) {
    const auto i = static_cast<std::size_t>(node);
    double k = shells[i] > 0 ? et[i] / shells[i] : 0.0;
    if (volume[i] > 0.0) k += bulk_volume[i] / volume[i] / simd::inverse_cube_root(2.0 * volume[i]);
    out.push_back(k);
  }
  return out;
}

std::vector<NodeShare> secondary_shares(const model::Model& model, std::span<const Index> nodes, std::span<const Vec3> x) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> position(static_cast<std::size_t>(model.node_count()), none);
  for (std::size_t k = 0; k < nodes.size(); ++k) position[static_cast<std::size_t>(nodes[k])] = k;
  std::vector<NodeShare> shares;
  std::vector<int> shells(nodes.size(), 0);
  each_shell_at_a_node(model, [&](Index node, const ElementRef& shell, double own) {
    const std::size_t k = position[static_cast<std::size_t>(node)];
    if (k == none) return;
    shares.push_back({k, shell, own});
    ++shells[k];
  });
  std::vector<double> rest = secondary_stiffness(model, nodes, x);
  for (NodeShare& s : shares) rest[s.node] -= s.stiffness /= shells[s.node];
  for (std::size_t k = 0; k < nodes.size(); ++k) shares.push_back({k, {}, std::max(0.0, rest[k])});
  return shares;
}

std::vector<NodeShare> node_shares(const model::Model& model, const FaceOwners& owners, std::span<const Index> nodes,
                                   std::span<const Vec3> x, double of_others) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> position(static_cast<std::size_t>(model.node_count()), none);
  for (std::size_t k = 0; k < nodes.size(); ++k) position[static_cast<std::size_t>(nodes[k])] = k;
  std::vector<NodeShare> shares;
  for (const auto& [key, elements] : owners.all()) {
    const auto shell = std::find_if(elements.begin(), elements.end(), is_shell);
    if (shell == elements.end() && elements.size() != 1) continue;  // between two solids
    const std::size_t corners = key[3] == no_index ? 3 : 4;
    if (std::all_of(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(corners),
                    [&](Index n) { return position[static_cast<std::size_t>(n)] == none; })) {
      continue;
    }
    model::Segment face;
    face.element = shell != elements.end() ? *shell : elements.front();
    face.nodes = face_of(model, face.element, key);
    const double share = segment_stiffness(model, face, x) / static_cast<double>(corners);
    for (std::size_t k = 0; k < corners; ++k) {
      const std::size_t node = position[static_cast<std::size_t>(key[k])];
      if (node != none) shares.push_back({node, face.element, share});
    }
  }
  std::vector<bool> has(nodes.size(), false);
  for (const NodeShare& s : shares) has[s.node] = true;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has[i]) shares.push_back({i, {}, of_others});
  }
  std::stable_sort(shares.begin(), shares.end(), [](const NodeShare& a, const NodeShare& b) { return a.node < b.node; });
  return shares;
}

double mean_stiffness(std::span<const double> facets) {
  return facets.empty() ? 0.0 : std::accumulate(facets.begin(), facets.end(), 0.0) / static_cast<double>(facets.size());
}

std::vector<double> node_stiffness(std::span<const NodeShare> shares, std::size_t nodes) {
  std::vector<double> out(nodes, 0.0);
  for (const NodeShare& s : shares) out[s.node] += s.stiffness;
  return out;
}

}  // namespace abut::init
