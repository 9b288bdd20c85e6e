// Groups of one-point bricks: numbering, masses and geometry of cycle 0; the step is in brick_kernel.hpp.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "core/diagnostic.hpp"
#include "elements/brick8/brick_kernel.hpp"
#include "elements/inert.hpp"
#include "elements/solid/solid_group.hpp"

namespace abut::elements {

namespace {

using Corners = Vec<double>[8];

void fill(std::span<const Vec3> x, Corners& n) {
  for (std::size_t k = 0; k < 8; ++k) n[k] = {x[k].x, x[k].y, x[k].z};
}

double determinant(const BrickModes<double>& m) { return dot(m.xi, cross(m.eta, m.zeta)); }

BrickModes<double> modes(const Corners& n) {
  return brick_modes<double>([&n](int k) { return n[k]; });
}

class BrickGroup final : public SolidGroup {
 public:
  explicit BrickGroup(const GroupInput& in) : SolidGroup(in, 8, brick8_kernel(simd::active_isa())) {
    const model::Model& m = *in.model;
    const model::Part& part = m.parts[static_cast<std::size_t>(in.part)];
    const model::Property& property = m.properties[static_cast<std::size_t>(part.property)];
    const auto& solid = std::get<model::SolidProperty>(property.data);
    const auto refuse = [&property](const char* code, const char* field, const char* message) {
      Diagnostics d;
      Place place;
      place.keyword = "/PROP/SOLID/" + std::to_string(property.id);
      place.field = field;
      d.error(code, place, message);
      throw InputError(d);
    };
    if (solid.isolid != 1 && solid.isolid != 2) refuse("elements.brick_isolid", "Isolid", "use 1 or 2 (one integration point)");
    if (solid.iframe != 1 && solid.iframe != 2) refuse("elements.brick_iframe", "Iframe", "use 1 (Jaumann) or 2 (co-rotational)");
    config_.corotational = solid.iframe == 2;
    config_.orthogonal_hourglass = solid.isolid == 1;
    std::vector<Index> element_nodes;
    element_nodes.reserve(elements_.size() * 8);
    for (const Index e : elements_) {
      std::array<Index, 8> n = m.bricks.nodes[static_cast<std::size_t>(e)];
      Corners corners;
      for (std::size_t k = 0; k < 8; ++k) {
        const Vec3& x = m.node_x[static_cast<std::size_t>(n[k])];
        corners[k] = {x.x, x.y, x.z};
      }
      // A left-handed numbering is turned by exchanging its two faces.
      if (determinant(modes(corners)) < 0.0) {
        for (std::size_t k = 0; k < 4; ++k) std::swap(n[k], n[k + 4]);
      }
      element_nodes.insert(element_nodes.end(), n.begin(), n.end());
    }
    set_up(m.node_x, element_nodes, brick_frozen_fields, 0);
  }

  [[nodiscard]] Family family() const override { return Family::brick8; }
  [[nodiscard]] model::ElementKind kind() const override { return model::ElementKind::brick; }

 private:
  [[nodiscard]] SolidGeometry geometry(std::span<const Vec3> x) const override {
    Corners n;
    fill(x, n);
    BrickModes<double> m = modes(n);
    SolidGeometry g;
    g.volume = determinant(m) / 64.0;
    if (!config_.small_strain) return g;
    Vec<double> rows[7] = {m.xi, m.eta, m.zeta, m.g1, m.g2, m.g3, m.g4};
    if (config_.corotational) {
      const Matrix<double> frame = brick_frame(m.eta, m.zeta, m.xi);
      for (auto& r : rows) r = apply(frame, r);
    }
    for (const auto& r : rows) g.frozen.insert(g.frozen.end(), {r.x, r.y, r.z});
    g.frozen.push_back(largest_face<double>([&n](int k) { return n[k]; }));
    return g;
  }
};

std::unique_ptr<Group> make_void_bricks(const GroupInput& in) {
  const model::Model& m = *in.model;
  const double density = m.materials[static_cast<std::size_t>(m.parts[static_cast<std::size_t>(in.part)].material)].density;
  InertElements data;
  data.kind = model::ElementKind::brick;
  data.nodes_per_element = 8;
  for (const Index e : in.elements) {
    const auto& nodes = m.bricks.nodes[static_cast<std::size_t>(e)];
    Corners n;
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3& x = m.node_x[static_cast<std::size_t>(nodes[k])];
      n[k] = {x.x, x.y, x.z};
    }
    const double mass = density * std::abs(determinant(modes(n))) / 64.0;
    data.nodes.insert(data.nodes.end(), nodes.begin(), nodes.end());
    data.mass.insert(data.mass.end(), 8, mass / 8.0);
  }
  return make_inert(in, std::move(data));
}

}  // namespace

std::unique_ptr<Group> make_brick8(const GroupInput& in) {
  if (is_void(in)) return make_void_bricks(in);
  return std::make_unique<BrickGroup>(in);
}

}  // namespace abut::elements
