#include "init/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
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

/// A sensor on the card takes the place of Tstart and Tstop (deck-format.md E.2).
struct Window {
  double birth = 0.0, death = 1e30;
};
Window window_of(const model::Model& model, const model::Interface& card) {
  if (card.sensor == no_index) return {card.t_start, card.t_stop};
  const model::Sensor& s = model.sensors[static_cast<std::size_t>(card.sensor)];
  return {s.t_on, s.t_off};
}

contact::FrictionLaw friction_law_of(const model::Interface& card) {
  using Model = contact::FrictionLaw::Model;
  static constexpr Model models[] = {Model::coulomb, Model::polynomial, Model::darmstadt, Model::renard, Model::exponential};
  return {models[card.ifric], card.c};
}

/// The reference program takes the larger of 2 pi f h and 1 for Ifiltr 3, which is no filter (numerics.md 7.4.5, 7.7.5).
contact::FrictionFilter filter_of(const model::Interface& card, const Profile& profile) {
  constexpr double two_pi = 6.283185307179586476925;
  if (card.ifiltr == 1) return {card.xfreq, 0.0};
  if (card.ifiltr == 2) return {two_pi / card.xfreq, 0.0};
  if (card.ifiltr == 3 && !profile.reference_contact) return {1.0, card.xfreq};
  return {};
}

contact::Options make_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                              std::optional<contact::Law> law) {
  contact::Options o;
  o.stiffness_scale = card.stfac;
  o.friction = card.friction;
  o.gap = card.gap;
  o.friction_law = friction_law_of(card);
  o.filter = filter_of(card, profile);
  o.birth = window_of(model, card).birth;
  o.death = window_of(model, card).death;
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

struct ShortestSides {
  std::vector<double> of;  ///< per segment
  double least = 1e30;
};
ShortestSides shortest_sides(const model::Surface& surface, std::span<const Vec3> x) {
  ShortestSides s;
  for (const model::Segment& segment : surface.segments) {
    double side = 1e30;
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = norm(x[static_cast<std::size_t>(segment.nodes[(k + 1) % 4])] - x[static_cast<std::size_t>(segment.nodes[k])]);
      if (length > 0.0) side = std::min(side, length);
    }
    s.of.push_back(side);
    s.least = std::min(s.least, side);
  }
  return s;
}

/// Default Gapmin of TYPE7 (numerics.md 7.7.1): the smaller of a shell thickness and half of the shortest side, a tenth of the
/// shortest side on solids. The thickness: Igap 0 the mean of the main shells, else the smallest, with the scale for 2 and 3.
double default_gap(const model::Model& model, const model::InterfaceType7& t7, const model::Surface& surface, double side) {
  double sum = 0.0;
  double least = 1e30;
  int shells = 0;
  for (const model::Segment& s : surface.segments) {
    const double t = gap_thickness(model, s.element);
    if (t <= 0.0) continue;
    sum += t;
    least = std::min(least, t);
    ++shells;
  }
  if (shells == 0) return 0.1 * side;
  const double thickness = t7.igap == 0 ? sum / shells : least * (t7.igap >= 2 ? t7.gap_scale : 1.0);
  return std::min(thickness, 0.5 * side);
}

/// Largest thickness of the shells around each node; 0 without.
std::vector<double> nodal_thickness(const model::Model& model) {
  std::vector<double> t(static_cast<std::size_t>(model.node_count()), 0.0);
  const auto add = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const double own = gap_thickness(model, {kind, e});
      for (const Index n : elements.nodes[static_cast<std::size_t>(e)]) {
        double& largest = t[static_cast<std::size_t>(n)];
        largest = std::max(largest, own);
      }
    }
  };
  add(model.shells, ElementKind::shell4);
  add(model.sh3ns, ElementKind::shell3);
  return t;
}

/// K_s of a secondary node (numerics.md 7.7.1): mean E t of the shells around it, plus B (2 V)^(1/3) with V its share of the
/// solids around it and B their bulk modulus weighted with volume.
std::vector<double> secondary_stiffness(const model::Model& model, std::span<const Index> nodes, std::span<const Vec3> x) {
  const auto n = static_cast<std::size_t>(model.node_count());
  std::vector<double> et(n, 0.0), volume(n, 0.0), bulk_volume(n, 0.0);
  std::vector<int> shells(n, 0);
  const auto material_of = [&](const ElementRef& e) -> const model::Material* {
    const Index m = model.parts[static_cast<std::size_t>(part_of(model, e))].material;
    return m == no_index ? nullptr : &model.materials[static_cast<std::size_t>(m)];
  };
  const auto add_shells = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const ElementRef ref{kind, e};
      const model::Material* material = material_of(ref);
      const Index property = model.parts[static_cast<std::size_t>(part_of(model, ref))].property;
      if (material == nullptr || property == no_index) continue;
      const double own = young_of(*material) * property_thickness(model.properties[static_cast<std::size_t>(property)]);
      for (const Index node : elements.nodes[static_cast<std::size_t>(e)]) {
        et[static_cast<std::size_t>(node)] += own;
        ++shells[static_cast<std::size_t>(node)];
      }
    }
  };
  const auto add_solids = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const ElementRef ref{kind, e};
      const model::Material* material = material_of(ref);
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
  add_shells(model.shells, ElementKind::shell4);
  add_shells(model.sh3ns, ElementKind::shell3);
  add_solids(model.bricks, ElementKind::brick);
  add_solids(model.tetras, ElementKind::tetra);
  std::vector<double> out;
  for (const Index node : nodes) {
    const auto i = static_cast<std::size_t>(node);
    double k = shells[i] > 0 ? et[i] / shells[i] : 0.0;
    if (volume[i] > 0.0) k += bulk_volume[i] / volume[i] * std::cbrt(2.0 * volume[i]);
    out.push_back(k);
  }
  return out;
}

void variable_gap(const model::Model& model, const model::InterfaceType7& t7, const model::Surface& surface, const ShortestSides& sides,
                  contact::BothSidesOptions& o) {
  constexpr double unlimited = 1e30;
  const double scale = t7.igap >= 2 ? t7.gap_scale : 1.0;
  const std::vector<double> thickness = nodal_thickness(model);
  for (const Index n : t7.nodes) o.node_gap.push_back(0.5 * scale * thickness[static_cast<std::size_t>(n)]);
  for (const model::Segment& s : surface.segments) o.facet_gap.push_back(0.5 * scale * gap_thickness(model, s.element));
  if (t7.igap >= 2) o.gap_max = t7.gap_max;
  if (t7.igap < 3) return;
  std::vector<double> around(static_cast<std::size_t>(model.node_count()), unlimited);
  for (std::size_t f = 0; f < surface.segments.size(); ++f) {
    o.facet_size.push_back(t7.mesh_size * sides.of[f]);
    for (const Index n : surface.segments[f].nodes) {
      double& least = around[static_cast<std::size_t>(n)];
      least = std::min(least, t7.mesh_size * sides.of[f]);
    }
  }
  for (const Index n : t7.nodes) o.node_size.push_back(around[static_cast<std::size_t>(n)]);
}

contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const model::InterfaceType7& t7,
                                             const model::Surface& surface, const Profile& profile, std::span<const Vec3> x) {
  using Options = contact::BothSidesOptions;
  using Initial = Options::Initial;
  using Stiffness = Options::Stiffness;
  Options o;
  const ShortestSides sides = shortest_sides(surface, x);
  o.gap = t7.gap_given ? card.gap : default_gap(model, t7, surface, sides.least);
  if (t7.igap > 0) variable_gap(model, t7, surface, sides, o);
  static constexpr Stiffness rules[] = {Stiffness::facet,  Stiffness::facet,   Stiffness::mean,
                                        Stiffness::larger, Stiffness::smaller, Stiffness::series};
  o.stiffness = rules[t7.istf];
  o.stiffness_min = t7.st_min;
  o.stiffness_max = t7.st_max;
  o.friction = card.friction;
  o.friction_law = friction_law_of(card);
  o.filter = filter_of(card, profile);
  o.friction_form = t7.iform == 2 ? Options::Friction::incremental : Options::Friction::viscous;
  o.damping = t7.vis_s;
  o.friction_viscosity = t7.vis_f;
  static constexpr Initial treatments[] = {Initial::keep, Initial::drop_nodes, Initial::drop_facets,       Initial::keep,
                                           Initial::keep, Initial::offset,     Initial::offset_with_margin};
  o.initial = treatments[t7.inacti];
  o.largest_penetration = t7.pen_max;
  o.birth = window_of(model, card).birth;
  o.death = window_of(model, card).death;
  o.reference_step = profile.reference_contact;
  o.all_pieces = profile.reference_contact;
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
    if (owners == nullptr) continue;
    side.elements.push_back(owners->of(s.nodes));
    side.corners.push_back(s.nodes);
  }
  side.active.assign(surface.segments.size(), 1);
  const contact::Surface topology = make_surface(model, surface);
  side.nodes.assign(topology.nodes().begin(), topology.nodes().end());
  return side;
}

RunInterface::Side held_side(const std::vector<Index>& nodes) {
  RunInterface::Side side;
  side.nodes = nodes;
  return side;
}

int inacti_of(const model::Interface& card) {
  if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) return t5->inacti;
  if (const auto* t7 = std::get_if<model::InterfaceType7>(&card.type)) return t7->inacti;
  return 0;
}
bool moves_nodes(const model::Interface& card) { return inacti_of(card) == 3 || inacti_of(card) == 4; }

/// One interface; `owners` is needed for the nodes of TYPE5 and where Idel asks for it.
RunInterface make_interface(const model::Model& model, Index index, const Profile& profile, std::optional<contact::Law> law,
                            const FaceOwners* owners, std::span<const Vec3> x) {
  const model::Interface& card = model.interfaces[static_cast<std::size_t>(index)];
  const FaceOwners* own = card.idel != 0 ? owners : nullptr;
  const auto surface_of = [&model](Index s) -> const model::Surface& { return model.surfaces[static_cast<std::size_t>(s)]; };
  if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) {
    const model::Surface& first = surface_of(t3->surface_1);
    const model::Surface& second = surface_of(t3->surface_2);
    const contact::Options options = make_options(model, card, profile, law);
    RunInterface r{index,
                   contact::Interface::two_surfaces(make_surface(model, first), make_surface(model, second), options),
                   {make_side(model, first, own, x), make_side(model, second, own, x)}};
    for (int side = 0; side < 2; ++side) {
      const RunInterface::Side& s = r.sides[static_cast<std::size_t>(side)];
      r.contact.set_surface(side, {s.stiffness, {}, s.active, {}});
    }
    return r;
  }
  if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) {
    const model::Surface& main = surface_of(t5->surface);
    const contact::Options options = make_options(model, card, profile, law);
    RunInterface r{
        index,
        contact::Interface::nodes_to_surface(t5->nodes, node_stiffness(model, *owners, t5->nodes, x), make_surface(model, main), options),
        {held_side(t5->nodes), make_side(model, main, own, x)}};
    r.contact.set_surface(1, {r.sides[1].stiffness, {}, r.sides[1].active, {}});
    return r;
  }
  const auto& t7 = std::get<model::InterfaceType7>(card.type);
  const model::Surface& main = surface_of(t7.surface);
  RunInterface r{index,
                 contact::Interface::both_sides(t7.nodes, make_surface(model, main), both_sides_options(model, card, t7, main, profile, x)),
                 {held_side(t7.nodes), make_side(model, main, own, x)}};
  // Istf 1: the card's value is K0 itself, which the law takes as half of K.
  for (double& k : r.sides[1].stiffness) k = t7.istf == 1 ? 2.0 * card.stfac : card.stfac * k;
  r.contact.set_surface(1, {r.sides[1].stiffness, {}, r.sides[1].active, {}});
  if (t7.istf >= 2) r.contact.set_surface(0, {secondary_stiffness(model, t7.nodes, x), {}, {}, {}});
  return r;
}

/// Which nodes belong to a live element, or never belonged to any.
std::vector<std::uint8_t> carried_nodes(const model::Model& model, const std::function<bool(const ElementRef&)>& alive) {
  const auto n = static_cast<std::size_t>(model.node_count());
  std::vector<std::uint8_t> carried(n, 0), had(n, 0);
  const auto mark = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const bool lives = alive({kind, e});
      for (const Index node : elements.nodes[static_cast<std::size_t>(e)]) {
        had[static_cast<std::size_t>(node)] = 1;
        if (lives) carried[static_cast<std::size_t>(node)] = 1;
      }
    }
  };
  mark(model.shells, ElementKind::shell4);
  mark(model.sh3ns, ElementKind::shell3);
  mark(model.bricks, ElementKind::brick);
  mark(model.tetras, ElementKind::tetra);
  for (std::size_t i = 0; i < n; ++i) carried[i] = carried[i] != 0 || had[i] == 0 ? 1 : 0;
  return carried;
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
                  [](const model::Interface& i) { return i.idel != 0 || std::holds_alternative<model::InterfaceType5>(i.type); })) {
    owners.emplace(model);
  }
  std::vector<RunInterface> out;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    if (moves_nodes(model.interfaces[i])) throw std::logic_error("settle_initial_penetrations() must come before make_interfaces()");
    out.push_back(make_interface(model, static_cast<Index>(i), profile, law, owners ? &*owners : nullptr, state.x));
  }
  return out;
}

void settle_initial_penetrations(model::Model& model, Diagnostics& findings) {
  if (std::none_of(model.interfaces.begin(), model.interfaces.end(), moves_nodes)) return;
  const FaceOwners owners(model);
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    model::Interface& card = model.interfaces[i];
    if (!moves_nodes(card)) continue;
    const std::vector<Vec3> x(model.node_x.begin(), model.node_x.end());
    const RunInterface r = make_interface(model, static_cast<Index>(i), Profile::standard(), {}, &owners, x);
    const std::vector<contact::Projection> moves = r.contact.projections(x, inacti_of(card) == 4);
    const contact::Projection* largest = nullptr;
    for (const contact::Projection& m : moves) {
      model.node_x[static_cast<std::size_t>(m.node)] += m.by;
      if (largest == nullptr || squared_norm(m.by) > squared_norm(largest->by)) largest = &m;
    }
    const int inacti = inacti_of(card);
    std::visit(
        [](auto& type) {
          if constexpr (requires { type.inacti; }) type.inacti = 0;
        },
        card.type);
    if (largest == nullptr) {
      findings.note("init.nothing_moved", card.place, fmt::format("Inacti {}: nothing penetrates at the start, no node is moved", inacti));
      continue;
    }
    findings.note("init.nodes_moved", card.place,
                  fmt::format("Inacti {} moved {} out of initial penetrations, the farthest by {:.6g} (node {}); "
                              "masses, displacements and the reference shape are those of the moved mesh",
                              inacti, moves.size() == 1 ? "1 node" : fmt::format("{} nodes", moves.size()), norm(largest->by),
                              model.node_id[static_cast<std::size_t>(largest->node)]));
  }
}

void update_erosion(const model::Model& model, std::span<RunInterface> interfaces, const std::function<bool(const ElementRef&)>& alive) {
  if (std::none_of(interfaces.begin(), interfaces.end(),
                   [&](const RunInterface& r) { return model.interfaces[static_cast<std::size_t>(r.model_index)].idel != 0; })) {
    return;
  }
  const std::vector<std::uint8_t> carried = carried_nodes(model, alive);
  const auto free_corner = [&carried](const std::array<Index, 4>& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [&carried](Index n) { return carried[static_cast<std::size_t>(n)] == 0; });
  };
  for (RunInterface& r : interfaces) {
    const int signed_idel = model.interfaces[static_cast<std::size_t>(r.model_index)].idel;
    const int idel = std::abs(signed_idel);
    if (idel == 0) continue;
    for (std::size_t side = 0; side < r.sides.size(); ++side) {
      RunInterface::Side& s = r.sides[side];
      for (std::size_t f = 0; f < s.elements.size(); ++f) {
        if (s.active[f] == 0 || s.elements[f].empty()) continue;
        const auto dead = std::count_if(s.elements[f].begin(), s.elements[f].end(), [&](const ElementRef& e) { return !alive(e); });
        const bool gone = idel == 2 ? dead > 0 || free_corner(s.corners[f]) : static_cast<std::size_t>(dead) == s.elements[f].size();
        if (gone) s.active[f] = 0;
      }
      s.node_active.assign(s.nodes.size(), 1);
      for (std::size_t k = 0; k < s.nodes.size(); ++k) {
        if (signed_idel > 0) s.node_active[k] = carried[static_cast<std::size_t>(s.nodes[k])];
      }
      if (s.active.empty()) {  // held nodes without a surface
        r.contact.set_surface(static_cast<int>(side), {{}, {}, s.node_active, {}});
      } else {
        r.contact.set_surface(static_cast<int>(side), {s.stiffness, {}, s.active, s.node_active});
      }
    }
  }
}

}  // namespace abut::init
