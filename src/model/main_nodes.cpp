// Main nodes of rigid bodies that the start would move out of the mesh: ICoG 1 and 2 put them to the centre of gravity, but elements and
// contact segments keep the form of the deck's coordinates.
#include "model/main_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "model/condition_fields.hpp"
#include "model/topology.hpp"

namespace abut::model {

namespace {

/// A main node moves when it goes farther than this share of the way to the nearest node of its mesh: less is rounding of typed digits.
constexpr double typed_digits = 1e-5;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class MainNodes {
 public:
  MainNodes(const Context& c, const std::vector<double>& mass) : c_(c), m_(*c.model), mass_(mass), body_(mass.size(), no_index) {
    for (std::size_t b = 0; b < m_.rigid_bodies.size(); ++b) {
      const RigidBody& card = m_.rigid_bodies[b];
      const bool goes = card.active && card.sensor == no_index && (card.icog == 1 || card.icog == 2);
      if (card.main != no_index && goes) body_[at(card.main)] = static_cast<Index>(b);
    }
    mesh_.resize(m_.rigid_bodies.size());
  }

  void run() {
    if (m_.controls.run_number > 1) return;  // its bodies are where the run before left them
    take_elements(m_.shells, ElementKind::shell4);
    take_elements(m_.sh3ns, ElementKind::shell3);
    take_elements(m_.bricks, ElementKind::brick);
    take_elements(m_.tetras, ElementKind::tetra);
    take_segments();
    for (std::size_t b = 0; b < mesh_.size(); ++b) judge(m_.rigid_bodies[b], mesh_[b]);
  }

 private:
  /// What the main node of a body is a node of.
  struct Mesh {
    ElementRef element;     ///< one that is not wholly inside the body, if there is one
    bool strained = false;  ///< there is
    Id surface = 0;         ///< of an interface
    double nearest = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] const Vec3& x(Index node) const { return m_.node_x[at(node)]; }

  /// Calls f(mesh, body) for each main node among `nodes`, with the way to the nearest of the others noted.
  template <class Nodes, class F>
  void for_main_nodes(const Nodes& nodes, F&& f) {
    for (const Index n : nodes) {
      if (body_[at(n)] == no_index) continue;
      Mesh& mesh = mesh_[at(body_[at(n)])];
      for (const Index other : nodes) {
        if (other != n) mesh.nearest = std::min(mesh.nearest, norm(x(other) - x(n)));
      }
      f(mesh, m_.rigid_bodies[at(body_[at(n)])]);
    }
  }

  template <class Elements>
  void take_elements(const Elements& elements, ElementKind kind) {
    for (std::size_t e = 0; e < elements.nodes.size(); ++e) {
      for_main_nodes(elements.nodes[e], [&](Mesh& mesh, const RigidBody& body) {
        const bool inside = std::all_of(elements.nodes[e].begin(), elements.nodes[e].end(), [&](Index n) {
          return n == body.main || std::binary_search(body.nodes.begin(), body.nodes.end(), n);
        });
        if (mesh.strained || (inside && mesh.element.kind != ElementKind::none)) return;
        mesh.element = {kind, static_cast<Index>(e)};
        mesh.strained = !inside;
      });
    }
  }

  void take_segments() {
    std::set<Index> surfaces;
    for (const Interface& i : m_.interfaces) {
      if (const auto* t3 = std::get_if<InterfaceType3>(&i.type)) surfaces.insert({t3->surface_1, t3->surface_2});
      if (const auto* t5 = std::get_if<InterfaceType5>(&i.type)) surfaces.insert(t5->surface);
      if (const auto* t7 = std::get_if<InterfaceType7>(&i.type)) surfaces.insert(t7->surface);
    }
    surfaces.erase(no_index);
    for (const Index s : surfaces) {
      for (const Segment& segment : m_.surfaces[at(s)].segments) {
        for_main_nodes(segment.nodes, [&](Mesh& mesh, const RigidBody&) { mesh.surface = m_.surfaces[at(s)].id; });
      }
    }
  }

  /// From the main node to where the start puts it.
  [[nodiscard]] Vec3 way_of(const RigidBody& b) const {
    double mass = b.icog == 1 ? b.mass + mass_[at(b.main)] : 0.0;
    Vec3 moment{};
    for (const Index n : b.nodes) {
      mass += mass_[at(n)];
      moment += mass_[at(n)] * (x(n) - x(b.main));
    }
    return mass > 0.0 ? moment / mass : Vec3{};
  }

  void judge(const RigidBody& b, const Mesh& mesh) const {
    if (mesh.nearest == std::numeric_limits<double>::infinity()) return;
    const Vec3 way = way_of(b), centre = x(b.main) + way;
    if (norm(way) <= typed_digits * mesh.nearest) return;
    const bool torn = mesh.strained || mesh.surface != 0;
    const std::string of = mesh.strained || mesh.surface == 0 ? fmt::format("element {}", element_id(m_, mesh.element))
                                                              : fmt::format("a segment of surface {}", mesh.surface);
    std::string message = fmt::format(
        "node {} belongs to {}, and ICoG {} moves it by {:.4g}, to the centre of gravity at {:.6g} {:.6g} {:.6g}: {}; give a free node, or "
        "ICoG 3",
        m_.node_id[at(b.main)], of, b.icog, norm(way), centre.x, centre.y, centre.z,
        torn ? "that tears the mesh" : "elements inside a body have no forces, but pictures show this one torn");
    Place place = place_of(c_, "RBODY", b.id);
    place.field = "node_ID";
    if (torn) {
      c_.diagnostics->error("model.main_in_mesh", std::move(place), std::move(message));
    } else {
      c_.diagnostics->warning("model.main_in_mesh", std::move(place), std::move(message));
    }
  }

  const Context& c_;
  const Model& m_;
  const std::vector<double>& mass_;
  std::vector<Index> body_;  ///< of a main node that the start moves
  std::vector<Mesh> mesh_;   ///< by body
};

}  // namespace

void check_main_nodes(const Context& c, const std::vector<double>& masses) { MainNodes(c, masses).run(); }

}  // namespace abut::model
