#include "init/contact_inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "init/contact_options.hpp"
#include "init/contact_stiffness.hpp"
#include "init/face_owners.hpp"
#include "init/same_pair.hpp"

namespace abut::init {

namespace {

using model::ElementKind;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::size_t listed = 20;

/// +1 when the segment's normal points out of the solid behind it, -1 into it, 0 for shells.
std::int8_t outward_of(const model::Model& model, const model::Segment& s, std::span<const Vec3> x) {
  std::span<const Index> nodes;
  if (s.element.kind == ElementKind::brick) nodes = model.bricks.nodes[at(s.element.index)];
  if (s.element.kind == ElementKind::tetra) nodes = model.tetras.nodes[at(s.element.index)];
  if (nodes.empty()) return 0;
  Vec3 body, face;
  for (const Index n : nodes) body += x[at(n)];
  for (const Index n : s.nodes) face += x[at(n)];
  const Vec3 inwards = body / static_cast<double>(nodes.size()) - face / 4.0;
  const Vec3 normal = cross(x[at(s.nodes[2])] - x[at(s.nodes[0])], x[at(s.nodes[3])] - x[at(s.nodes[1])]);
  const double d = dot(normal, inwards);
  return d < 0.0 ? std::int8_t{1} : (d > 0.0 ? std::int8_t{-1} : std::int8_t{0});
}

std::array<Id, 4> ids_of(const model::Model& model, const std::array<Index, 4>& nodes) {
  std::array<Id, 4> ids{};
  for (std::size_t k = 0; k < 4; ++k) ids[k] = model.node_id[at(nodes[k])];
  return ids;
}

std::string text_of(const std::array<Id, 4>& s) {
  return s[2] == s[3] ? fmt::format("({} {} {})", s[0], s[1], s[2]) : fmt::format("({} {} {} {})", s[0], s[1], s[2], s[3]);
}

/// "1, 2, 3 (and 5 more)"
template <class T, class Text>
std::string list_of(const std::vector<T>& items, Text text) {
  std::string s;
  for (std::size_t i = 0; i < std::min(items.size(), listed); ++i) s += (i > 0 ? ", " : "") + text(items[i]);
  if (items.size() > listed) s += fmt::format(" (and {} more)", items.size() - listed);
  return s;
}

std::string segments_text(const std::vector<std::array<Id, 4>>& segments) {
  return list_of(segments, [](const std::array<Id, 4>& s) { return text_of(s); });
}

/// Contact nodes of one interface with their direction of contact (zero for held nodes: every direction counts).
struct ContactNode {
  Index node;
  Vec3 normal;
  double size;  ///< of the facets around it
};

std::vector<ContactNode> contact_nodes(const contact::InspectionInput& input, std::span<const Vec3> x) {
  std::vector<Index> nodes;  // not a place for every node of the model: there may be as many interfaces as parts
  for (const contact::InspectedSide& side : input.side) {
    for (const contact::Facet& f : side.facets) nodes.insert(nodes.end(), f.node.begin(), f.node.begin() + f.corners());
    if (side.facets.empty()) nodes.insert(nodes.end(), side.nodes.begin(), side.nodes.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<ContactNode> all;
  for (const Index n : nodes) all.push_back({n, {}, 0.0});
  for (const contact::InspectedSide& side : input.side) {
    for (const contact::Facet& f : side.facets) {
      const Index last = f.is_triangle() ? f.node[2] : f.node[3];
      const Vec3 doubled = cross(x[at(f.node[2])] - x[at(f.node[0])], x[at(last)] - x[at(f.node[1])]);
      const double size = std::sqrt(0.5 * norm(doubled));
      for (std::size_t k = 0; k < static_cast<std::size_t>(f.corners()); ++k) {
        const auto place = std::lower_bound(nodes.begin(), nodes.end(), f.node[k]) - nodes.begin();
        ContactNode& c = all[static_cast<std::size_t>(place)];
        c.normal += doubled;
        c.size = std::max(c.size, size);
      }
    }
  }
  for (ContactNode& c : all) {
    const double length = norm(c.normal);
    if (length > 0.0) c.normal = c.normal / length;
  }
  return all;
}

/// Directions in which nodes cannot move freely: an orthonormal set per node.
class HeldDirections {
 public:
  explicit HeldDirections(const model::Model& model) : held_(model.node_id.size()) {
    const auto axis = [&](Index skew, int k) {
      if (skew != no_index) return model.skews[at(skew)].axes[static_cast<std::size_t>(k)];
      return std::array<Vec3, 3>{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}[static_cast<std::size_t>(k)];
    };
    for (const model::BoundaryCondition& b : model.boundary_conditions) {
      for (int k = 0; k < 3; ++k) {
        if (!b.translation[static_cast<std::size_t>(k)]) continue;
        for (const Index n : b.nodes) add(n, axis(b.skew, k));
      }
    }
    for (const model::ImposedMotion& m : model.imposed_motions) {
      if (m.direction > 2) continue;
      for (const Index n : m.nodes) add(n, axis(m.skew, m.direction));
    }
  }
  /// Nearly all of `direction` is held (any direction, when it is zero).
  [[nodiscard]] bool holds(Index node, const Vec3& direction) const {
    const auto& held = held_[at(node)];
    if (held.empty()) return false;
    if (squared_norm(direction) == 0.0) return held.size() == 3;
    double share = 0.0;
    for (const Vec3& h : held) share += dot(h, direction) * dot(h, direction);
    return share > 0.81;
  }

 private:
  std::vector<std::vector<Vec3>> held_;
  void add(Index node, Vec3 direction) {
    auto& held = held_[at(node)];
    for (const Vec3& h : held) direction -= dot(direction, h) * h;
    const double length = norm(direction);
    if (length > 1e-6) held.push_back(direction / length);
  }
};

void kinematic_findings(const model::Model& model, const HeldDirections& held, std::span<const ContactNode> nodes, std::span<const Vec3> x,
                        const std::vector<std::uint8_t>& in_body, std::vector<contact::Finding>& out) {
  contact::Finding wall, condition, body;
  for (const ContactNode& c : nodes) {
    if (held.holds(c.node, c.normal)) condition.nodes.push_back(c.node);
    if (in_body[at(c.node)] != 0) body.nodes.push_back(c.node);
  }
  for (const model::RigidWall& w : model.rigid_walls) {
    for (const Index n : w.nodes) {
      const auto found = std::lower_bound(nodes.begin(), nodes.end(), n, [](const ContactNode& a, Index b) { return a.node < b; });
      if (found == nodes.end() || found->node != n) continue;
      const Vec3 point = w.node != no_index ? x[at(w.node)] : w.point;
      const double distance = dot(x[at(n)] - point, w.normal);
      const bool along = squared_norm(found->normal) == 0.0 || std::abs(dot(found->normal, w.normal)) > 0.7;
      if (along && distance < 0.1 * found->size) wall.nodes.push_back(n);
    }
  }
  std::sort(wall.nodes.begin(), wall.nodes.end());
  wall.nodes.erase(std::unique(wall.nodes.begin(), wall.nodes.end()), wall.nodes.end());
  const auto count = static_cast<double>(nodes.size());
  const auto finish = [&](contact::Finding& f, contact::Severity severity, std::string_view code, std::string_view by, const char* advice) {
    if (f.nodes.empty()) return;
    f.severity = severity;
    f.code = code;
    f.measure_name = "share of the interface's nodes";
    f.measure = static_cast<double>(f.nodes.size()) / count;
    f.what = fmt::format("{} {} also bound {}", f.nodes.size(), f.nodes.size() == 1 ? "contact node is" : "contact nodes are", by);
    f.advice = advice;
    out.push_back(std::move(f));
  };
  finish(wall, contact::Severity::warning, model_codes[0], "by a rigid wall across the contact",
         "The wall overrides what the contact asks for: leave these nodes out of the wall, or let the wall alone carry them.");
  finish(condition, contact::Severity::note, model_codes[1], "by a boundary condition or an imposed motion along the normal",
         "Contact forces on them go into the support and move nothing; leave them out of the condition if they are to give way.");
  finish(body, contact::Severity::note, model_codes[2], "by a rigid body",
         "They move with the body, whose mass then counts for the contact; the interface time step is that of the body.");
}

/// The same contact a second time: its springs add up.
void same_pair_finding(const std::vector<const model::Interface*>& others, std::vector<contact::Finding>& out) {
  if (others.empty()) return;
  contact::Finding f;
  f.severity = contact::Severity::warning;
  f.code = model_codes[3];
  f.measure_name = "interfaces before this one on its two sides";
  f.measure = static_cast<double>(others.size());
  f.what = fmt::format(
      "{} {} between the same two sides at the same time: their stiffnesses add up", others.size() == 1 ? "interface" : "interfaces",
      list_of(others, [](const model::Interface* i) { return fmt::format("{}", i->id); }) + (others.size() == 1 ? " acts" : " act"));
  f.advice = "Keep one of them; for a stiffer contact raise its Stfac.";
  out.push_back(std::move(f));
}

/// Initial penetrations of a TYPE7: Inacti may take them away, and an automatic gap is where they come from unasked.
void follow_card(const model::Interface& card, double gap, std::vector<contact::Finding>& findings) {
  const auto* t7 = std::get_if<model::InterfaceType7>(&card.type);
  if (t7 == nullptr) return;
  const auto is_it = [](const contact::Finding& f) { return f.code == "contact.initial_penetration"; };
  if (t7->inacti != 0) std::erase_if(findings, is_it);
  if (t7->gap_given || t7->igap != 0) return;
  for (contact::Finding& f : findings) {
    if (!is_it(f)) continue;
    f.severity = contact::Severity::warning;
    f.what += fmt::format("; the gap of {:.5g} follows from the thickness (Gapmin is not given)", gap);
  }
}

/// Of nodes that no surface describes: mean size (square root of the area) of the shells and free solid faces around each; 0 without.
std::vector<double> face_sizes(const model::Model& model, const FaceOwners& owners, std::span<const Index> nodes, std::span<const Vec3> x) {
  std::vector<double> sum(static_cast<std::size_t>(model.node_count()), 0.0);
  std::vector<int> around(sum.size(), 0);
  for (const auto& [key, elements] : owners.all()) {
    const auto shell = std::find_if(elements.begin(), elements.end(), [](const model::ElementRef& e) {
      return e.kind == ElementKind::shell4 || e.kind == ElementKind::shell3;
    });
    if (shell == elements.end() && elements.size() != 1) continue;  // between two solids
    const std::array<Index, 4> n = face_of(model, shell != elements.end() ? *shell : elements.front(), key);
    const std::size_t corners = key[3] == no_index ? 3 : 4;
    const double size = std::sqrt(0.5 * norm(cross(x[at(n[2])] - x[at(n[0])], x[at(n[corners - 1])] - x[at(n[1])])));
    for (std::size_t k = 0; k < corners; ++k) {
      sum[at(n[k])] += size;
      ++around[at(n[k])];
    }
  }
  std::vector<double> out;
  for (const Index n : nodes) out.push_back(around[at(n)] > 0 ? sum[at(n)] / around[at(n)] : 0.0);
  return out;
}

Severity severity_of(contact::Severity s) {
  return s == contact::Severity::error ? Severity::error : (s == contact::Severity::warning ? Severity::warning : Severity::note);
}

}  // namespace

InspectedInterface::InspectedInterface(const model::Model& model, const model::Interface& card, std::span<const Vec3> x,
                                       const InterfaceChoices& choices)
    : surface_(model::surfaces_of(card)), stiffness_scale_(card.stfac), gap_(card.gap) {
  if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) {
    nodes_ = t5->nodes;
  } else if (const auto* t7 = std::get_if<model::InterfaceType7>(&card.type)) {
    nodes_ = t7->nodes;
    pairs_ = both_sides_options(model, card, Profile::standard(), x);
    gap_ = pairs_->largest_gap();
  }
  if (!pairs_ && choice_of(choices, card.id).automatic_gap.value_or(false)) gap_ = std::max(gap_, largest_automatic_gap(model, card));
  for (std::size_t k = 0; k < 2; ++k) {
    if (surface_[k] == no_index) continue;
    for (const model::Segment& s : model.surfaces[at(surface_[k])].segments) {
      facets_[k].push_back({s.nodes});
      stiffness_[k].push_back(segment_stiffness(model, s, x));
      outward_[k].push_back(outward_of(model, s, x));
    }
  }
  const auto* t7 = std::get_if<model::InterfaceType7>(&card.type);
  if (t7 != nullptr && t7->istf == 1) stiffness_[1].clear();  // the card gives the stiffness
}

double InspectedInterface::facet_size(std::span<const Vec3> x) const {
  double size = 1e300;
  for (const std::vector<contact::Facet>& facets : facets_) {
    if (facets.empty()) continue;
    double sum = 0.0;
    for (const contact::Facet& f : facets) {
      const auto corner = [&](std::size_t k) { return x[at(f.node[k])]; };
      sum += std::sqrt(0.5 * norm(cross(corner(2) - corner(0), corner(3) - corner(1))));
    }
    size = std::min(size, sum / static_cast<double>(facets.size()));
  }
  return size;
}

contact::InspectionInput InspectedInterface::input(std::span<const Vec3> x) const {
  contact::InspectionInput in;
  for (std::size_t k = 0; k < 2; ++k) in.side[k] = {facets_[k], {}, stiffness_[k], outward_[k]};
  in.side[0].nodes = nodes_;
  in.both_sides = pairs_.has_value();
  in.pairs = pairs_ ? &*pairs_ : nullptr;
  in.one_pass = surface_[0] == no_index;
  in.stiffness_scale = stiffness_scale_;
  in.gap = gap_;
  in.x = x;
  return in;
}

std::vector<ContactFinding> inspect_contacts(const model::Model& model, const InspectedState& state, const InterfaceChoices& choices,
                                             FacingShares* facing) {
  std::vector<ContactFinding> out;
  if (model.interfaces.empty()) return out;
  const std::span<const Vec3> x = state.x.empty() ? std::span<const Vec3>(model.node_x) : state.x;
  const HeldDirections held(model);
  std::vector<std::uint8_t> in_body(model.node_id.size(), 0);
  for (const model::RigidBody& b : model.rigid_bodies) {
    if (!b.active) continue;
    in_body[at(b.main)] = 1;
    for (const Index n : b.nodes) in_body[at(n)] = 1;
  }
  std::optional<FaceOwners> owners;
  if (std::any_of(model.interfaces.begin(), model.interfaces.end(),
                  [](const model::Interface& i) { return !std::holds_alternative<model::InterfaceType3>(i.type); })) {
    owners.emplace(model);
  }
  SamePairs pairs(model);
  for (const model::Interface& card : model.interfaces) {
    const InspectedInterface inspected(model, card, x, choices);
    contact::InspectionInput input = inspected.input(x);
    std::vector<double> sizes, stiffness;
    if (!input.side[0].nodes.empty()) {
      sizes = face_sizes(model, *owners, input.side[0].nodes, x);
      const std::span<const Index> held_nodes = input.side[0].nodes;
      stiffness = input.both_sides ? secondary_stiffness(model, held_nodes, x)
                                   : node_stiffness(node_shares(model, *owners, held_nodes, x, mean_stiffness(input.side[1].stiffness)),
                                                    held_nodes.size());
      input.side[0].size = sizes;
      input.side[0].stiffness = stiffness;
    }
    input.v = state.v;
    input.mass = state.mass;
    input.element_step = state.element_step;
    std::array<contact::Facing, 2> sides;
    std::vector<contact::Finding> findings = contact::inspect(input, {}, facing != nullptr ? &sides : nullptr);
    if (facing != nullptr) facing->push_back({sides[0].fraction(), sides[1].fraction()});
    const std::vector<ContactNode> nodes = contact_nodes(input, x);
    kinematic_findings(model, held, nodes, x, in_body, findings);
    same_pair_finding(pairs.add(card), findings);
    follow_card(card, input.gap, findings);
    for (contact::Finding& f : findings) {
      ContactFinding c;
      c.interface_id = card.id;
      if (f.side >= 0 && inspected.surface(f.side) != no_index) c.surface_id = model.surfaces[at(inspected.surface(f.side))].id;
      for (const Index n : f.nodes) c.nodes.push_back(model.node_id[at(n)]);
      for (const Index s : f.facets) c.segments.push_back(ids_of(model, input.side[static_cast<std::size_t>(f.side)].facets[at(s)].node));
      c.place = card.place;
      c.finding = std::move(f);
      out.push_back(std::move(c));
    }
  }
  return out;
}

Diagnostic to_diagnostic(const ContactFinding& c) {
  const contact::Finding& f = c.finding;
  std::string text = c.surface_id != 0 ? fmt::format("surface {}: ", c.surface_id) : std::string();
  text += f.what;
  if (!c.segments.empty()) text += ": segments " + segments_text(c.segments);
  if (!c.nodes.empty()) {
    text += (c.segments.empty() ? ": nodes " : "; nodes ") + list_of(c.nodes, [](Id id) { return fmt::format("{}", id); });
  }
  text += fmt::format(". {} [{}]", f.advice, f.code);
  return {severity_of(f.severity), f.code, c.place, std::move(text)};
}

std::vector<TurnedSurface> orient_contacts(model::Model& model) {
  std::vector<TurnedSurface> out;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    const InspectedInterface inspected(model, model.interfaces[i], model.node_x);
    const contact::InspectionInput input = inspected.input(model.node_x);
    const contact::Orientation orientation = contact::orient(input);
    for (int side = 0; side < 2; ++side) {
      const auto k = static_cast<std::size_t>(side);
      if (inspected.surface(side) == no_index || (orientation.flip[k].empty() && !orientation.ambiguous[k])) continue;
      model::Surface copy = model.surfaces[at(inspected.surface(side))];
      TurnedSurface turned{static_cast<Index>(i), side, copy.id, copy.segments.size(), {}, orientation.ambiguous[k]};
      for (const Index f : orientation.flip[k]) {
        auto& nodes = copy.segments[at(f)].nodes;
        turned.segments.push_back(ids_of(model, nodes));
        nodes = contact::reversed({nodes}).node;
      }
      if (!turned.segments.empty()) {
        const auto index = static_cast<Index>(model.surfaces.size());
        model.surfaces.push_back(std::move(copy));
        if (auto* t3 = std::get_if<model::InterfaceType3>(&model.interfaces[i].type)) (side == 0 ? t3->surface_1 : t3->surface_2) = index;
        if (auto* t5 = std::get_if<model::InterfaceType5>(&model.interfaces[i].type)) t5->surface = index;
      }
      out.push_back(std::move(turned));
    }
  }
  return out;
}

Diagnostic to_diagnostic(const model::Model& model, const TurnedSurface& turned) {
  std::string text = fmt::format("surface {}: ", turned.surface_id);
  if (!turned.segments.empty()) {
    text += fmt::format("{} of {} segments were turned to face the other side: {}", turned.segments.size(), turned.total,
                        segments_text(turned.segments));
  }
  if (turned.ambiguous) {
    text += std::string(turned.segments.empty() ? "" : "; ") + "part of it has no clear direction and was left as it is: orient it by hand";
  }
  return {turned.ambiguous ? Severity::warning : Severity::note, "contact.oriented", model.interfaces[at(turned.interface)].place,
          text + ". [contact.oriented]"};
}

}  // namespace abut::init
