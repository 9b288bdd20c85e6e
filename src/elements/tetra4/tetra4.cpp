// Groups of four-node tetrahedra: numbering and mass split; the step is in tetra_kernel.hpp.
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "elements/inert.hpp"
#include "elements/solid/solid_group.hpp"
#include "elements/tetra4/tetra_kernel.hpp"

namespace abut::elements {

namespace {

class TetraGroup final : public SolidGroup {
 public:
  explicit TetraGroup(const GroupInput& in) : SolidGroup(in, 4, tetra4_kernel(simd::active_isa())) {
    const model::Model& m = *in.model;
    const model::Part& part = m.parts[static_cast<std::size_t>(in.part)];
    by_area_ = std::get<model::SolidProperty>(m.properties[static_cast<std::size_t>(part.property)].data).imas == 1;
    std::vector<Index> element_nodes;
    element_nodes.reserve(elements_.size() * 4);
    for (const Index e : elements_) {
      std::array<Index, 4> n = m.tetras.nodes[static_cast<std::size_t>(e)];
      const auto at = [&](std::size_t k) { return m.node_x[static_cast<std::size_t>(n[k])]; };
      if (dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0))) < 0.0) std::swap(n[2], n[3]);
      element_nodes.insert(element_nodes.end(), n.begin(), n.end());
    }
    set_up(m.node_x, element_nodes, tetra_frozen_fields, tetra_share_fields);
  }

  [[nodiscard]] Family family() const override { return Family::tetra4; }
  [[nodiscard]] model::ElementKind kind() const override { return model::ElementKind::tetra; }

 private:
  [[nodiscard]] SolidGeometry geometry(std::span<const Vec3> x) const override {
    SolidGeometry g;
    const Vec3 e[3] = {x[1] - x[0], x[2] - x[0], x[3] - x[0]};
    g.volume = dot(e[0], cross(e[1], e[2])) / 6.0;
    for (const Vec3& a : e) g.frozen.insert(g.frozen.end(), {a.x, a.y, a.z});
    g.mass_share.assign(4, 0.25);
    if (by_area_) {
      // Node I takes the share of the face opposite to it (numerics.md 1.4).
      double total = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 &a = x[(i + 1) % 4], &b = x[(i + 2) % 4], &c = x[(i + 3) % 4];
        g.mass_share[i] = norm(cross(b - a, c - a));
        total += g.mass_share[i];
      }
      for (double& s : g.mass_share) s /= total;
    }
    return g;
  }

  bool by_area_ = false;
};

std::unique_ptr<Group> make_void_tetras(const GroupInput& in) {
  const model::Model& m = *in.model;
  const double density = m.materials[static_cast<std::size_t>(m.parts[static_cast<std::size_t>(in.part)].material)].density;
  InertElements data;
  data.kind = model::ElementKind::tetra;
  data.nodes_per_element = 4;
  for (const Index e : in.elements) {
    const auto& n = m.tetras.nodes[static_cast<std::size_t>(e)];
    const auto at = [&](std::size_t k) { return m.node_x[static_cast<std::size_t>(n[k])]; };
    const double mass = density * std::abs(dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0)))) / 6.0;
    data.nodes.insert(data.nodes.end(), n.begin(), n.end());
    data.mass.insert(data.mass.end(), 4, mass / 4.0);
  }
  return make_inert(in, std::move(data));
}

}  // namespace

std::unique_ptr<Group> make_tetra4(const GroupInput& in) {
  if (is_void(in)) return make_void_tetras(in);
  return std::make_unique<TetraGroup>(in);
}

}  // namespace abut::elements
