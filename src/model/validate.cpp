// What can only be judged with everything read: nodes that two interfaces' sides share, empty sets, surfaces without area or stiffness,
// nodes without mass, rigid bodies that overlap.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/condition_fields.hpp"
#include "model/main_nodes.hpp"
#include "model/measure.hpp"
#include "model/topology.hpp"
#include "model/wording.hpp"

namespace abut::model {

namespace {

class Validator {
 public:
  explicit Validator(Context& c) : m_(*c.model), d_(*c.diagnostics), c_(c), mass_(nodal_masses(m_)) {
    for (const RigidWall& w : m_.rigid_walls) {
      if (w.node != no_index) mass_[static_cast<std::size_t>(w.node)] += w.mass;
    }
  }

  void run() {
    // What a faulty mesh or set leaves behind (parts without elements, empty surfaces) is not a fault of its own.
    mesh_is_sound_ = !has_error_of({"NODE", "SHELL", "SH3N", "BRICK", "TETRA4", "PENTA6", "PART", "MAT", "PROP", "BEGIN", "UNIT"});
    const bool masses_are_known = mesh_is_sound_ && !has_error_of({"ADMAS", "RBODY"});
    if (mesh_is_sound_) {
      thicknesses();
      parts();
    }
    interfaces(masses_are_known);
    rigid_bodies(masses_are_known);
    if (masses_are_known) loads_on_massless_nodes();
    if (masses_are_known && !d_.has_errors()) check_main_nodes(c_, mass_);
    check_motions(c_);
    if (masses_are_known) something_moves();
    unused_functions();
  }

 private:
  /// An error was found in a block of one of these keywords.
  bool has_error_of(std::initializer_list<std::string_view> words) const {
    return std::any_of(d_.all().begin(), d_.all().end(), [&](const Diagnostic& d) {
      if (d.severity != Severity::error || d.place.keyword.empty()) return false;
      const std::string word = d.place.keyword.substr(1, d.place.keyword.find('/', 1) - 1);
      return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return same_word(w, word); });
    });
  }

  Place place(std::string_view word, Id id) const { return place_of(c_, word, id); }

  Id id_of(Index node) const { return m_.node_id[static_cast<std::size_t>(node)]; }

  std::vector<Id> ids_of(const std::vector<Index>& nodes) const {
    std::vector<Id> ids;
    for (const Index n : nodes) ids.push_back(id_of(n));
    return ids;
  }

  // ---- parts ------------------------------------------------------------------------------------------------------

  void thicknesses() {
    std::map<Index, std::vector<Id>> thin;  // by part
    const auto check = [&](const auto& elements) {
      for (std::size_t i = 0; i < elements.id.size(); ++i) {
        const Index part = elements.part[i];
        if (part == no_index || part_young(m_, part) == 0.0) continue;  // a void skin may have no thickness
        if (shell_thickness(m_, part, elements.own_thickness(i)) <= 0.0) thin[part].push_back(elements.id[i]);
      }
    };
    check(m_.shells);
    check(m_.sh3ns);
    for (const auto& [part, ids] : thin) {
      d_.error("model.no_thickness", place("PART", m_.parts[static_cast<std::size_t>(part)].id),
               fmt::format("{} no thickness: {}; give one greater than 0 in the property or with the element",
                           ids.size() == 1 ? "1 shell has" : fmt::format("{} shells have", ids.size()), list(ids)));
    }
  }

  void parts() {
    std::vector<bool> used(m_.parts.size(), false);
    for_each_element(m_, [&](std::span<const Index>, Index part, double) {
      if (part != no_index) used[static_cast<std::size_t>(part)] = true;
    });
    std::vector<Id> empty;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) empty.push_back(m_.parts[i].id);
    }
    if (!empty.empty()) {
      d_.note("model.empty_part", {},
              fmt::format("{} no element: {}", empty.size() == 1 ? "this part has" : "these parts have", list(empty)));
    }
  }

  // ---- interfaces -------------------------------------------------------------------------------------------------

  const Surface& surface(Index s) const { return m_.surfaces[static_cast<std::size_t>(s)]; }

  std::vector<Index> nodes_of(Index s) const {
    std::vector<Index> nodes;
    for (const Segment& segment : surface(s).segments) nodes.insert(nodes.end(), segment.nodes.begin(), segment.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  void interfaces(bool masses_are_known) {
    const bool sets_are_sound = mesh_is_sound_ && !has_error_of({"SURF", "GRNOD", "SET", "GRSHEL", "GRSH3N", "GRBRIC"});
    for (const Interface& i : m_.interfaces) {
      if (const auto* t3 = std::get_if<InterfaceType3>(&i.type)) {
        if (sets_are_sound) check_surface(i, t3->surface_1, false);
        if (sets_are_sound) check_surface(i, t3->surface_2, false);
        check_two_sides(i, *t3);
      } else if (const auto* t5 = std::get_if<InterfaceType5>(&i.type)) {
        if (sets_are_sound) check_surface(i, t5->surface, false);
        check_nodes(i, t5->nodes, t5->surface, masses_are_known);
      } else if (const auto* t7 = std::get_if<InterfaceType7>(&i.type)) {
        if (sets_are_sound) check_surface(i, t7->surface, t7->istf == 1);
        check_nodes(i, t7->nodes, no_index, masses_are_known);
        contact_step_action(i);
      }
    }
  }

  /// /DT/INTER/STOP and CST ask for what only a contact step of TYPE7 can trigger.
  void contact_step_action(const Interface& i) {
    using Action = StepControl::Action;
    const Controls& k = m_.controls;
    if (k.contact_minimum <= 0.0 || (k.contact_action != Action::stop && k.contact_action != Action::constant)) return;
    d_.error("model.unsupported", i.place,
             fmt::format("/DT/INTER/{} acts on this interface and is not supported; use /DT/INTER/DEL (nodes below the step leave the "
                         "interface), a larger Gapmin, or /DT/INTER without an action",
                         k.contact_action == Action::stop ? "STOP" : "CST"));
  }

  bool has_stiffness(const Segment& s) const {
    const auto k = static_cast<std::size_t>(s.element.index);
    switch (s.element.kind) {
      case ElementKind::none:
        return false;
      case ElementKind::shell4:
        return part_young(m_, m_.shells.part[k]) > 0.0 && shell_thickness(m_, m_.shells.part[k], m_.shells.own_thickness(k)) > 0.0;
      case ElementKind::shell3:
        return part_young(m_, m_.sh3ns.part[k]) > 0.0 && shell_thickness(m_, m_.sh3ns.part[k], m_.sh3ns.own_thickness(k)) > 0.0;
      case ElementKind::brick:
        return part_young(m_, m_.bricks.part[k]) > 0.0;
      case ElementKind::tetra:
        return part_young(m_, m_.tetras.part[k]) > 0.0;
    }
    return false;
  }

  std::string corners(const Segment& s) const {
    return s.nodes[2] == s.nodes[3]
               ? fmt::format("({} {} {})", id_of(s.nodes[0]), id_of(s.nodes[1]), id_of(s.nodes[2]))
               : fmt::format("({} {} {} {})", id_of(s.nodes[0]), id_of(s.nodes[1]), id_of(s.nodes[2]), id_of(s.nodes[3]));
  }

  void check_surface(const Interface& i, Index index, bool stiffness_given) {
    if (index == no_index) return;
    const Surface& s = surface(index);
    if (s.segments.empty()) {
      d_.error("model.empty_set", i.place, fmt::format("surface {} has no segment; nothing can touch it", s.id));
      return;
    }
    std::vector<std::string> flat, soft;
    for (const Segment& segment : s.segments) {
      const Vec3 a = m_.node_x[static_cast<std::size_t>(segment.nodes[0])];
      double size = 0.0;
      for (const Index n : segment.nodes) size = std::max(size, squared_norm(m_.node_x[static_cast<std::size_t>(n)] - a));
      // Rounding alone leaves about 1e-16 of the square of the size; a face this thin has no usable normal.
      if (!(norm(face_area(m_, segment.nodes)) > 1e-12 * size)) flat.push_back(corners(segment));
      if (!stiffness_given && !has_stiffness(segment)) soft.push_back(corners(segment));
    }
    if (!flat.empty()) {
      d_.error("model.zero_area", i.place,
               fmt::format("surface {} has {} without area: nodes {}; a segment needs three nodes that are not on one line", s.id,
                           plural(flat.size(), "segment", "segments"), list(flat)));
    }
    if (soft.size() == s.segments.size()) {
      d_.error("model.no_stiffness", i.place,
               fmt::format("no segment of surface {} has an element with stiffness behind it, so nothing could push back; "
                           "segments must be faces of shells or solids with E > 0 (and a thickness)",
                           s.id));
    } else if (!soft.empty()) {
      d_.warning("model.no_stiffness", i.place,
                 fmt::format("surface {} has {} with no stiffness behind: nodes {}; nothing pushes back there", s.id,
                             plural(soft.size(), "segment", "segments"), list(soft)));
    }
  }

  void check_two_sides(const Interface& i, const InterfaceType3& t) {
    if (t.surface_1 == no_index || t.surface_2 == no_index || surface(t.surface_1).id == surface(t.surface_2).id) return;
    const std::vector<Index> first = nodes_of(t.surface_1), second = nodes_of(t.surface_2);
    std::vector<Index> shared;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
    if (shared.empty()) return;
    d_.error(
        "model.shared_node", i.place,
        fmt::format("{} on both surfaces ({} and {}): {}; a node may belong to one of them only: separate the meshes, or use /INTER/TYPE7",
                    shared.size() == 1 ? "1 node is" : fmt::format("{} nodes are", shared.size()), surface(t.surface_1).id,
                    surface(t.surface_2).id, list(ids_of(shared))));
  }

  void check_nodes(const Interface& i, const std::vector<Index>& nodes, Index main, bool masses_are_known) {
    if (nodes.empty() && !d_.has_errors()) {  // else the missing group is what was reported
      d_.error("model.empty_set", i.place, "the group of secondary nodes (grnd_IDs) is empty; name the nodes that can touch the surface");
    }
    std::vector<Index> massless;
    const std::set<Index> held = held_nodes();
    for (const Index n : nodes) {
      if (masses_are_known && mass_[static_cast<std::size_t>(n)] <= 0.0 && !held.contains(n)) massless.push_back(n);
    }
    if (!massless.empty()) {
      d_.error("model.no_mass", i.place,
               fmt::format(
                   "{} no mass and cannot be held by contact: {}; secondary nodes must belong to elements with mass, or get one by /ADMAS",
                   massless.size() == 1 ? "1 secondary node has" : fmt::format("{} secondary nodes have", massless.size()),
                   list(ids_of(massless))));
    }
    if (main == no_index) return;
    const std::vector<Index> on_main = nodes_of(main);
    std::vector<Index> shared;
    std::set_intersection(nodes.begin(), nodes.end(), on_main.begin(), on_main.end(), std::back_inserter(shared));
    if (shared.empty()) return;
    d_.error("model.shared_node", i.place,
             fmt::format("{} also on the main surface {}: {}; a node cannot touch its own segment, take it out of the group",
                         shared.size() == 1 ? "1 secondary node is" : fmt::format("{} secondary nodes are", shared.size()),
                         surface(main).id, list(ids_of(shared))));
  }

  // ---- rigid bodies, loads ------------------------------------------------------------------------------------------

  /// Nodes whose motion comes from a rigid body.
  std::set<Index> held_nodes() const {
    std::set<Index> held;
    for (const RigidBody& b : m_.rigid_bodies) {
      held.insert(b.nodes.begin(), b.nodes.end());
      held.insert(b.main);
    }
    return held;
  }

  void rigid_bodies(bool masses_are_known) {
    std::map<Index, Id> owner;  // node -> body
    for (const RigidBody& b : m_.rigid_bodies) {
      std::map<Id, std::vector<Index>> shared;
      std::vector<Index> all = b.nodes;
      if (b.main != no_index) all.push_back(b.main);
      std::sort(all.begin(), all.end());
      for (const Index n : all) {
        const auto [found, inserted] = owner.emplace(n, b.id);
        if (!inserted && found->second != b.id) shared[found->second].push_back(n);
      }
      for (const auto& [other, nodes] : shared) {
        d_.error(
            "model.shared_node", place("RBODY", b.id),
            fmt::format("{} also to rigid body {}: {}; a node can follow one body only",
                        nodes.size() == 1 ? "1 node belongs" : fmt::format("{} nodes belong", nodes.size()), other, list(ids_of(nodes))));
      }
      double mass = b.mass;
      for (const Index n : all) {
        if (b.icog != 4 || n == b.main) mass += mass_[static_cast<std::size_t>(n)];  // ICoG 4 leaves those of the secondary nodes out
      }
      // A body that turns about a fixed main node needs no mass, so this is not an error.
      if (masses_are_known && b.sensor == no_index && !all.empty() && mass <= 0.0) {
        d_.warning(
            "model.no_mass", place("RBODY", b.id),
            b.icog == 4
                ? "the rigid body has no mass and cannot move freely: with ICoG 4 the masses of its secondary nodes do not count; give "
                  "one in the field Mass, or write another ICoG"
                : "the rigid body has no mass and cannot move freely; give one in the field Mass, or hold nodes of elements that "
                  "have mass");
      }
    }
  }

  void loads_on_massless_nodes() {
    const std::set<Index> held = held_nodes();
    const auto check = [&](std::string_view keyword, Id id, const std::vector<Index>& nodes) {
      std::vector<Index> massless;
      for (const Index n : nodes) {
        if (mass_[static_cast<std::size_t>(n)] <= 0.0 && !held.contains(n)) massless.push_back(n);
      }
      if (massless.empty()) return;
      d_.error(
          "model.no_mass", place(keyword, id),
          fmt::format("{} loaded but has no mass: {}; load nodes of elements with mass or of a rigid body, or give mass by /ADMAS",
                      massless.size() == 1 ? "1 node is" : fmt::format("each of {} nodes is", massless.size()), list(ids_of(massless))));
    };
    for (const ConcentratedLoad& l : m_.concentrated_loads) {
      if (l.direction < 3) check("CLOAD", l.id, l.nodes);
    }
    for (const PressureLoad& l : m_.pressure_loads) {
      std::vector<Index> nodes;
      for (const auto& segment : l.segments) nodes.insert(nodes.end(), segment.begin(), segment.end());
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      check("PLOAD", l.id, nodes);
    }
  }

  /// Nothing moves where there is no element, mass, rigid body or imposed motion: the deck is cut off.
  void something_moves() {
    const bool elements = m_.shells.size() + m_.sh3ns.size() + solid_count(m_) > 0;
    if (d_.has_errors() || elements || !m_.rigid_bodies.empty() || !m_.imposed_motions.empty() ||
        std::any_of(mass_.begin(), mass_.end(), [](double m) { return m > 0.0; }) ||
        std::any_of(m_.rigid_walls.begin(), m_.rigid_walls.end(), [](const RigidWall& w) { return w.mass > 0.0; })) {
      return;
    }
    Place deck;
    deck.file = c_.deck->files.front();
    d_.error("model.nothing_moves", std::move(deck),
             "the model has no element and no mass; give it elements, or nodes masses by /ADMAS or /RBODY");
  }

  void unused_functions() {
    std::vector<bool> used(m_.functions.size(), false);
    const auto mark = [&](const auto& items) {
      for (const auto& item : items) {
        if (item.function != no_index) used[static_cast<std::size_t>(item.function)] = true;
      }
    };
    mark(m_.imposed_motions);
    mark(m_.concentrated_loads);
    mark(m_.pressure_loads);
    mark(m_.gravities);
    std::vector<Id> unused;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) unused.push_back(m_.functions[i].id);
    }
    if (!unused.empty()) {
      d_.note("model.unused_function", {},
              fmt::format("nothing uses {}: {}", unused.size() == 1 ? "this /FUNCT" : "these /FUNCT", list(unused)));
    }
  }

  const Model& m_;
  Diagnostics& d_;
  Context& c_;
  std::vector<double> mass_;
  bool mesh_is_sound_ = true;
};

}  // namespace

void validate(Context& c) { Validator(c).run(); }

}  // namespace abut::model
