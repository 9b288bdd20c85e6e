#include "model/measure.hpp"

#include <cmath>

#include "model/topology.hpp"

namespace abut::model {

namespace {

const Vec3& position(const Model& m, Index node) { return m.node_x[static_cast<std::size_t>(node)]; }

const Part* part_at(const Model& m, Index part) { return part == no_index ? nullptr : &m.parts[static_cast<std::size_t>(part)]; }

}  // namespace

Vec3 face_area(const Model& m, const std::array<Index, 4>& n) {
  return 0.5 * cross(position(m, n[2]) - position(m, n[0]), position(m, n[3]) - position(m, n[1]));
}

double property_thickness(const Model& m, Index part) {
  const Part* p = part_at(m, part);
  if (p == nullptr || p->property == no_index) return 0.0;
  const auto& data = m.properties[static_cast<std::size_t>(p->property)].data;
  if (const auto* shell = std::get_if<ShellProperty>(&data)) return shell->thickness;
  if (const auto* hollow = std::get_if<VoidProperty>(&data)) return hollow->thickness;
  return 0.0;
}

double shell_thickness(const Model& m, Index part, double element_thickness) {
  return element_thickness > 0.0 ? element_thickness : property_thickness(m, part);
}

double part_density(const Model& m, Index part) {
  const Part* p = part_at(m, part);
  return p == nullptr || p->material == no_index ? 0.0 : m.materials[static_cast<std::size_t>(p->material)].density;
}

double part_young(const Model& m, Index part) {
  const Part* p = part_at(m, part);
  if (p == nullptr || p->material == no_index) return 0.0;
  return std::visit([](const auto& law) { return law.young; }, m.materials[static_cast<std::size_t>(p->material)].law);
}

double shell_mass(const Model& m, Index shell) {
  const auto k = static_cast<std::size_t>(shell);
  const Index part = m.shells.part[k];
  return part_density(m, part) * shell_thickness(m, part, m.shells.own_thickness(k)) * norm(face_area(m, m.shells.nodes[k]));
}

double sh3n_mass(const Model& m, Index sh3n) {
  const auto k = static_cast<std::size_t>(sh3n);
  const auto& n = m.sh3ns.nodes[k];
  const Index part = m.sh3ns.part[k];
  return part_density(m, part) * shell_thickness(m, part, m.sh3ns.own_thickness(k)) * norm(face_area(m, {n[0], n[1], n[2], n[2]}));
}

double brick_volume(const Model& m, Index brick) {
  const auto& n = m.bricks.nodes[static_cast<std::size_t>(brick)];
  std::array<Vec3, 8> x;
  for (std::size_t i = 0; i < 8; ++i) x[i] = position(m, n[i]);
  return one_point_volume(x);
}

double brick_mass(const Model& m, Index brick) {
  return part_density(m, m.bricks.part[static_cast<std::size_t>(brick)]) * std::abs(brick_volume(m, brick));
}

double tetra_volume(const Model& m, Index tetra) {
  const auto& n = m.tetras.nodes[static_cast<std::size_t>(tetra)];
  return tetra_volume(std::array{position(m, n[0]), position(m, n[1]), position(m, n[2]), position(m, n[3])});
}

double tetra_mass(const Model& m, Index tetra) {
  return part_density(m, m.tetras.part[static_cast<std::size_t>(tetra)]) * std::abs(tetra_volume(m, tetra));
}

std::vector<double> part_masses(const Model& m) {
  std::vector<double> masses(m.parts.size(), 0.0);
  for_each_element(m, [&](std::span<const Index>, Index part, double mass) {
    if (part != no_index) masses[static_cast<std::size_t>(part)] += mass;
  });
  return masses;
}

std::vector<double> nodal_masses(const Model& m) {
  std::vector<double> masses(m.node_id.size(), 0.0);
  for_each_element(m, [&](std::span<const Index> nodes, Index, double mass) {
    for (const Index n : nodes) masses[static_cast<std::size_t>(n)] += mass / static_cast<double>(nodes.size());
  });
  for (const AddedMass& a : m.added_masses) masses[static_cast<std::size_t>(a.node)] += a.mass;
  return masses;
}

}  // namespace abut::model
