#include "init/contact_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

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

contact::Facet facet_of(const model::Segment& s) { return {s.nodes}; }

contact::Surface make_surface(const model::Model& model, const model::Surface& surface) {
  std::vector<contact::Facet> facets;
  facets.reserve(surface.segments.size());
  for (const model::Segment& s : surface.segments) facets.push_back(facet_of(s));
  return contact::Surface(std::move(facets), model.node_id);
}

contact::Options make_options(const model::Interface& card, const Profile& profile, std::optional<contact::Law> law) {
  contact::Options o;
  o.stiffness_scale = card.stfac;
  o.friction = card.friction;
  o.gap = card.gap;
  o.birth = card.t_start;
  o.death = card.t_stop;
  o.rules = profile.reference_contact ? contact::Rules::reference() : contact::Rules::standard();
  o.shear_limit = profile.reference_contact ? model::infinity : card.ptlim;
  if (law) o.rules.law = *law;
  return o;
}

/// Thickness behind a segment for gaps: virtual thickness of the part, else the element's, else the property's; 0 for solids.
double gap_thickness(const model::Model& model, const ElementRef& e) {
  if (e.kind != ElementKind::shell4 && e.kind != ElementKind::shell3) return 0.0;
  const model::Part& part = model.parts[static_cast<std::size_t>(part_of(model, e))];
  if (part.contact_thickness > 0.0) return part.contact_thickness;
  const auto& own = e.kind == ElementKind::shell4 ? model.shells.thickness : model.sh3ns.thickness;
  const auto i = static_cast<std::size_t>(e.index);
  if (i < own.size() && own[i] > 0.0) return own[i];
  return property_thickness(model.properties[static_cast<std::size_t>(part.property)]);
}

/// Default gap of TYPE7 (numerics.md 7.7.1, Igap 0): the smaller of the mean shell thickness and half of the shortest side;
/// a tenth of the shortest side on solids.
double default_gap(const model::Model& model, const model::Surface& surface, std::span<const Vec3> x) {
  double side = 1e30;
  double thickness = 0.0;
  int shells = 0;
  for (const model::Segment& s : surface.segments) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = norm(x[static_cast<std::size_t>(s.nodes[(k + 1) % 4])] - x[static_cast<std::size_t>(s.nodes[k])]);
      if (length > 0.0) side = std::min(side, length);
    }
    const double t = gap_thickness(model, s.element);
    if (t > 0.0) {
      thickness += t;
      ++shells;
    }
  }
  return shells > 0 ? std::min(thickness / shells, 0.5 * side) : 0.1 * side;
}

contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const model::InterfaceType7& t7,
                                             const model::Surface& surface, std::span<const Vec3> x) {
  using Options = contact::BothSidesOptions;
  Options o;
  o.gap = t7.gap_given ? card.gap : default_gap(model, surface, x);
  o.friction = card.friction;
  o.friction_form = t7.iform == 2 ? Options::Friction::incremental : Options::Friction::viscous;
  o.damping = t7.vis_s;
  o.friction_viscosity = t7.iform == 2 || card.friction == 0.0 ? 0.0 : t7.vis_f;
  o.initial = t7.inacti == 5 ? Options::Initial::offset : (t7.inacti == 6 ? Options::Initial::offset_with_margin : Options::Initial::keep);
  o.largest_penetration = t7.pen_max;
  o.birth = card.t_start;
  o.death = card.t_stop;
  const model::Controls& control = model.controls;
  o.step_minimum = t7.dt_min;
  if (o.step_minimum == 0.0 && control.contact_action == model::StepControl::Action::remove) o.step_minimum = control.contact_minimum;
  o.step_scale = control.contact_scale;
  return o;
}

using FaceKey = std::array<Index, 4>;

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

/// The nodes of an element's face in cyclic order, from its sorted key.
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

/// Elements that contain each given face: shells with just these nodes, solids with this face.
class FaceOwners {
 public:
  explicit FaceOwners(const model::Model& model) {
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

  [[nodiscard]] std::vector<ElementRef> of(const std::array<Index, 4>& nodes) const {
    const auto found = owners_.find(face_key(nodes));
    return found == owners_.end() ? std::vector<ElementRef>{} : found->second;
  }
  [[nodiscard]] const std::map<FaceKey, std::vector<ElementRef>>& all() const { return owners_; }

 private:
  void add(const std::array<Index, 4>& nodes, ElementRef e) { owners_[face_key(nodes)].push_back(e); }
  std::map<FaceKey, std::vector<ElementRef>> owners_;
};

bool is_shell(const ElementRef& e) { return e.kind == ElementKind::shell4 || e.kind == ElementKind::shell3; }

/// Own stiffness of nodes that no surface describes (TYPE5): a quarter (triangles: a third) of E t of every shell around
/// the node and of B A^2/V of every free solid face; where a shell lies on a face, the shell's (T18).
std::vector<double> node_stiffness(const model::Model& model, const FaceOwners& owners, std::span<const Index> nodes,
                                   std::span<const Vec3> x) {
  std::vector<double> all(static_cast<std::size_t>(model.node_count()), 0.0);
  for (const auto& [key, elements] : owners.all()) {
    const auto shell = std::find_if(elements.begin(), elements.end(), is_shell);
    if (shell == elements.end() && elements.size() != 1) continue;  // between two solids
    model::Segment face;
    face.element = shell != elements.end() ? *shell : elements.front();
    face.nodes = face_of(model, face.element, key);
    const bool triangle = key[3] == no_index;
    const double share = segment_stiffness(model, face, x) / (triangle ? 3.0 : 4.0);
    for (std::size_t k = 0; k < (triangle ? 3U : 4U); ++k) all[static_cast<std::size_t>(key[k])] += share;
  }
  std::vector<double> out;
  for (const Index n : nodes) out.push_back(all[static_cast<std::size_t>(n)]);
  return out;
}

RunInterface::Side make_side(const model::Model& model, const model::Surface& surface, const FaceOwners* owners, std::span<const Vec3> x) {
  RunInterface::Side side;
  for (const model::Segment& s : surface.segments) {
    side.stiffness.push_back(segment_stiffness(model, s, x));
    if (owners != nullptr) side.elements.push_back(owners->of(s.nodes));
  }
  side.active.assign(surface.segments.size(), 1);
  return side;
}

}  // namespace

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

std::vector<RunInterface> make_interfaces(const model::Model& model, const Profile& profile, std::optional<contact::Law> law,
                                          state::State& state) {
  std::optional<FaceOwners> owners;
  if (std::any_of(model.interfaces.begin(), model.interfaces.end(),
                  [](const model::Interface& i) { return i.idel != 0 || !std::holds_alternative<model::InterfaceType3>(i.type); })) {
    owners.emplace(model);
  }
  const std::span<const Vec3> x(state.x);
  std::vector<RunInterface> out;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    const model::Interface& card = model.interfaces[i];
    const contact::Options options = make_options(card, profile, law);
    const FaceOwners* own = card.idel != 0 ? &*owners : nullptr;
    if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) {
      const model::Surface& first = model.surfaces[static_cast<std::size_t>(t3->surface_1)];
      const model::Surface& second = model.surfaces[static_cast<std::size_t>(t3->surface_2)];
      RunInterface r{static_cast<Index>(i),
                     contact::Interface::two_surfaces(make_surface(model, first), make_surface(model, second), options),
                     {make_side(model, first, own, x), make_side(model, second, own, x)}};
      for (int side = 0; side < 2; ++side) {
        const RunInterface::Side& s = r.sides[static_cast<std::size_t>(side)];
        r.contact.set_surface(side, {s.stiffness, {}, s.active});
      }
      out.push_back(std::move(r));
    } else if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) {
      const model::Surface& main = model.surfaces[static_cast<std::size_t>(t5->surface)];
      RunInterface r{
          static_cast<Index>(i),
          contact::Interface::nodes_to_surface(t5->nodes, node_stiffness(model, *owners, t5->nodes, x), make_surface(model, main), options),
          {{}, make_side(model, main, own, x)}};
      r.contact.set_surface(1, {r.sides[1].stiffness, {}, r.sides[1].active});
      out.push_back(std::move(r));
    } else if (const auto* t7 = std::get_if<model::InterfaceType7>(&card.type)) {
      const model::Surface& main = model.surfaces[static_cast<std::size_t>(t7->surface)];
      RunInterface r{static_cast<Index>(i),
                     contact::Interface::both_sides(t7->nodes, make_surface(model, main), both_sides_options(model, card, *t7, main, x)),
                     {{}, make_side(model, main, own, x)}};
      // Istf 1: the card's value is K0 itself, which the law takes as half of K.
      for (double& k : r.sides[1].stiffness) k = t7->istf == 1 ? 2.0 * card.stfac : card.stfac * k;
      r.contact.set_surface(1, {r.sides[1].stiffness, {}, r.sides[1].active});
      out.push_back(std::move(r));
    }
  }
  return out;
}

void update_erosion(const model::Model& model, std::span<RunInterface> interfaces, const std::function<bool(const ElementRef&)>& alive) {
  for (RunInterface& r : interfaces) {
    const int idel = std::abs(model.interfaces[static_cast<std::size_t>(r.model_index)].idel);
    if (idel == 0) continue;
    for (std::size_t side = 0; side < r.sides.size(); ++side) {
      RunInterface::Side& s = r.sides[side];
      bool changed = false;
      for (std::size_t f = 0; f < s.elements.size(); ++f) {
        if (s.active[f] == 0 || s.elements[f].empty()) continue;
        const auto dead = std::count_if(s.elements[f].begin(), s.elements[f].end(), [&](const ElementRef& e) { return !alive(e); });
        const bool gone = idel == 2 ? dead > 0 : static_cast<std::size_t>(dead) == s.elements[f].size();
        if (!gone) continue;
        s.active[f] = 0;
        changed = true;
      }
      if (changed) r.contact.set_surface(static_cast<int>(side), {s.stiffness, {}, s.active});
    }
  }
}

}  // namespace abut::init
