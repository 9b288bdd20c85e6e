#include "init/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "init/contact_options.hpp"
#include "init/contact_stiffness.hpp"
#include "init/face_owners.hpp"

namespace abut::init {

namespace {

using model::ElementKind;
using model::ElementRef;

contact::Surface make_surface(const model::Surface& surface) {
  std::vector<contact::Facet> facets;
  facets.reserve(surface.segments.size());
  for (const model::Segment& s : surface.segments) facets.push_back({s.nodes});
  return contact::Surface(std::move(facets));  // nodes are sorted by id
}

RunInterface::Side make_side(const model::Model& model, const model::Surface& surface, const FaceOwners* owners, std::span<const Vec3> x,
                             bool automatic_gap = false) {
  RunInterface::Side side;
  for (const model::Segment& s : surface.segments) {
    const bool shell = s.element.kind == ElementKind::shell4 || s.element.kind == ElementKind::shell3;
    side.stiffness.push_back(segment_stiffness(model, s, x));
    side.shell.push_back(shell ? s.element : ElementRef{});
    if (automatic_gap) side.thickness.push_back(gap_thickness(model, s.element));
    if (owners == nullptr) continue;
    side.elements.push_back(owners->of(s.nodes));
    side.corners.push_back(s.nodes);
  }
  side.active.assign(surface.segments.size(), 1);
  const contact::Surface topology = make_surface(surface);
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
RunInterface make_interface(const model::Model& model, Index index, const Profile& profile, const InterfaceChoices& choices,
                            const FaceOwners* owners, std::span<const Vec3> x) {
  const model::Interface& card = model.interfaces[static_cast<std::size_t>(index)];
  const FaceOwners* own = card.idel != 0 ? owners : nullptr;
  const auto surface_of = [&model](Index s) -> const model::Surface& { return model.surfaces[static_cast<std::size_t>(s)]; };
  if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) {
    const model::Surface& first = surface_of(t3->surface_1);
    const model::Surface& second = surface_of(t3->surface_2);
    const contact::Options options = one_sided_options(model, card, profile, choices);
    RunInterface r{index,
                   contact::Interface::two_surfaces(make_surface(first), make_surface(second), options),
                   {make_side(model, first, own, x, options.automatic_gap), make_side(model, second, own, x, options.automatic_gap)}};
    for (std::size_t side = 0; side < 2; ++side) set_surface(r, side);
    return r;
  }
  if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) {
    const model::Surface& main = surface_of(t5->surface);
    const contact::Options options = one_sided_options(model, card, profile, choices);
    RunInterface::Side facets = make_side(model, main, own, x, options.automatic_gap);
    std::vector<NodeShare> shares = node_shares(model, *owners, t5->nodes, x, mean_stiffness(facets.stiffness));
    RunInterface r{index,
                   contact::Interface::nodes_to_surface(t5->nodes, node_stiffness(shares, t5->nodes.size()), make_surface(main), options),
                   {held_side(t5->nodes), std::move(facets)}};
    r.sides[0].shares = std::move(shares);
    if (options.automatic_gap) {
      const std::vector<double> thickness = nodal_thickness(model);
      for (const Index n : t5->nodes) r.sides[0].thickness.push_back(thickness[static_cast<std::size_t>(n)]);
    }
    for (std::size_t side = 0; side < 2; ++side) set_surface(r, side);
    return r;
  }
  const auto& t7 = std::get<model::InterfaceType7>(card.type);
  const model::Surface& main = surface_of(t7.surface);
  RunInterface r{index,
                 contact::Interface::both_sides(t7.nodes, make_surface(main), both_sides_options(model, card, profile, x)),
                 {held_side(t7.nodes), make_side(model, main, own, x)}};
  // Istf 1: the card's value is K0 itself, which the law takes as half of K.
  for (double& k : r.sides[1].stiffness) k = t7.istf == 1 ? 2.0 * card.stfac : card.stfac * k;
  r.contact.set_surface(1, {r.sides[1].stiffness, {}, r.sides[1].active, {}});
  if (t7.istf >= 2) r.contact.set_surface(0, {secondary_stiffness(model, t7.nodes, x), {}, {}, {}});
  // What follows shells that become thinner.
  if (t7.istf >= 2 || t7.igap > 0) {
    r.sides[0].shares = secondary_shares(model, t7.nodes, x);
    for (NodeShare& s : r.sides[0].shares) s.stiffness = t7.istf >= 2 ? s.stiffness : 0.0;
  }
  if (t7.igap > 0) {
    r.sides[0].thickness = gap_thickness_of_nodes(model, t7);
    r.sides[1].thickness = gap_thickness_of_facets(model, t7);
  }
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

void set_surface(RunInterface& interface, std::size_t side) {
  const RunInterface::Side& s = interface.sides[side];
  if (s.active.empty()) {  // held nodes without a surface
    interface.contact.set_surface(static_cast<int>(side), {s.stiffness, s.thickness, s.node_active, {}});
  } else {
    interface.contact.set_surface(static_cast<int>(side), {s.stiffness, s.thickness, s.active, s.node_active});
  }
}

std::vector<RunInterface> make_interfaces(const model::Model& model, const Profile& profile, const InterfaceChoices& choices,
                                          state::State& state) {
  std::optional<FaceOwners> owners;
  if (std::any_of(model.interfaces.begin(), model.interfaces.end(),
                  [](const model::Interface& i) { return i.idel != 0 || std::holds_alternative<model::InterfaceType5>(i.type); })) {
    owners.emplace(model);
  }
  std::vector<RunInterface> out;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    if (moves_nodes(model.interfaces[i])) throw std::logic_error("settle_initial_penetrations() must come before make_interfaces()");
    out.push_back(make_interface(model, static_cast<Index>(i), profile, choices, owners ? &*owners : nullptr, state.x));
  }
  return out;
}

namespace {

/// Moves held nodes, or with `move_surface` those of the segments, out of what penetrates. @param name  what asks for it, in the note
void move_out(model::Model& model, Index index, const InterfaceChoices& choices, const FaceOwners& owners, bool move_surface,
              const std::string& name, Diagnostics& findings) {
  const model::Interface& card = model.interfaces[static_cast<std::size_t>(index)];
  const std::vector<Vec3> x(model.node_x.begin(), model.node_x.end());
  const RunInterface r = make_interface(model, index, Profile::standard(), choices, &owners, x);
  const std::vector<contact::Projection> moves = r.contact.projections(x, move_surface);
  const contact::Projection* largest = nullptr;
  for (const contact::Projection& m : moves) {
    model.node_x[static_cast<std::size_t>(m.node)] += m.by;
    if (largest == nullptr || squared_norm(m.by) > squared_norm(largest->by)) largest = &m;
  }
  if (largest == nullptr) {
    findings.note("init.nothing_moved", card.place, fmt::format("{}: nothing penetrates at the start, no node is moved", name));
    return;
  }
  findings.note("init.nodes_moved", card.place,
                fmt::format("{} moved {} out of initial penetrations, the farthest by {:.6g} (node {}); "
                            "masses, displacements and the reference shape are those of the moved mesh",
                            name, moves.size() == 1 ? "1 node" : fmt::format("{} nodes", moves.size()), norm(largest->by),
                            model.node_id[static_cast<std::size_t>(largest->node)]));
}

}  // namespace

void settle_initial_penetrations(model::Model& model, Diagnostics& findings) {
  if (std::none_of(model.interfaces.begin(), model.interfaces.end(), moves_nodes)) return;
  const FaceOwners owners(model);
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    model::Interface& card = model.interfaces[i];
    if (!moves_nodes(card)) continue;
    const int inacti = inacti_of(card);
    move_out(model, static_cast<Index>(i), {}, owners, inacti == 4, fmt::format("Inacti {}", inacti), findings);
    std::visit(
        [](auto& type) {
          if constexpr (requires { type.inacti; }) type.inacti = 0;
        },
        card.type);
  }
}

void project_initial_penetrations(model::Model& model, const InterfaceChoices& choices, Diagnostics& findings) {
  std::optional<FaceOwners> owners;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    const model::Interface& card = model.interfaces[i];
    if (std::holds_alternative<model::InterfaceType7>(card.type)) continue;
    if (choice_of(choices, card.id).initial != contact::Initial::project) continue;
    if (!owners) owners.emplace(model);
    move_out(model, static_cast<Index>(i), choices, *owners, false, fmt::format("initial=project of interface {}", card.id), findings);
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
      set_surface(r, side);
    }
  }
}

}  // namespace abut::init
