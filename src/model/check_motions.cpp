// Motions that contradict each other, a boundary condition or a rigid body; conditions on nodes that follow a rigid body.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "model/condition_fields.hpp"
#include "model/wording.hpp"

namespace abut::model {

namespace {

class MotionChecks {
 public:
  explicit MotionChecks(Context& c)
      : c_(c), m_(*c.model), d_(*c.diagnostics), body_(static_cast<std::size_t>(m_.node_count()), nullptr), later_(body_) {
    for (const RigidBody& b : m_.rigid_bodies) {
      if (!b.active || b.main == no_index) continue;
      for (const Index n : b.nodes) (start_of(b) <= 0.0 ? body_ : later_)[static_cast<std::size_t>(n)] = &b;
    }
    for (const BoundaryCondition& b : m_.boundary_conditions) {
      for (const Index n : b.nodes) {
        std::array<bool, 6>& flags = held_[n][b.skew];
        for (std::size_t k = 0; k < 3; ++k) {
          flags[k] = flags[k] || b.translation[k];
          flags[k + 3] = flags[k + 3] || b.rotation[k];
        }
      }
    }
  }

  void run() {
    imposed_motions();
    if (d_.has_errors()) return;  // a group or body may be other than it is meant
    initial_velocities();
    boundary_conditions();
    gravities();
    rotations();
  }

 private:
  /// Held directions, X to ZZ, by the skew that they are in.
  using Held = std::map<Index, std::array<bool, 6>>;

  std::vector<Id> ids_of(const std::vector<Index>& nodes) const {
    std::vector<Id> ids;
    for (const Index n : nodes) ids.push_back(m_.node_id[static_cast<std::size_t>(n)]);
    return ids;
  }

  const RigidBody* body_of(Index node) const { return body_[static_cast<std::size_t>(node)]; }

  /// When its sensor switches the body on.
  double start_of(const RigidBody& b) const { return b.sensor == no_index ? 0.0 : m_.sensors[static_cast<std::size_t>(b.sensor)].t_on; }

  static std::string_view name_of(ImposedMotion::Kind kind) {
    return kind == ImposedMotion::Kind::velocity ? "IMPVEL" : kind == ImposedMotion::Kind::displacement ? "IMPDISP" : "IMPACC";
  }

  void imposed_motions() {
    std::map<std::tuple<Index, int, Index>, const ImposedMotion*> imposed;  // node, direction, skew
    for (const ImposedMotion& motion : m_.imposed_motions) {
      std::vector<Index> following, later, held, twice;
      const ImposedMotion* other = nullptr;
      for (const Index n : motion.nodes) {
        if (body_of(n) != nullptr) following.push_back(n);
        if (const RigidBody* b = later_[static_cast<std::size_t>(n)]; b != nullptr && start_of(*b) < motion.t_stop) later.push_back(n);
        if (body_of(n) == nullptr && holds(n, motion)) held.push_back(n);
        const auto [found, inserted] = imposed.emplace(std::tuple{n, motion.direction, motion.skew}, &motion);
        if (inserted) continue;
        const ImposedMotion& o = *found->second;
        if (o.t_start >= motion.t_stop || motion.t_start >= o.t_stop) continue;
        other = &o;
        twice.push_back(n);
      }
      const Place place = place_of(c_, name_of(motion.kind), motion.id);
      const auto warn_of = [&](const std::vector<Index>& nodes, std::string_view when, std::string_view too) {
        if (nodes.empty()) return;
        const bool one = nodes.size() == 1;
        d_.warning("model.motion_of_rigid_body", place,
                   fmt::format("{} of a rigid body and {} it{}: {}; impose the motion on the main node{}",
                               one ? "1 node is a secondary node" : fmt::format("{} nodes are secondary nodes", nodes.size()),
                               one ? "follows" : "follow", when, list(ids_of(nodes)), too));
      };
      warn_of(following, "", "");
      warn_of(later, " once a sensor switches it on", " too");
      if (!held.empty()) {
        d_.warning(
            "model.motion_of_held_node", place,
            fmt::format("a /BCS holds {} in this direction and the motion does nothing there: {}; take the direction out of the /BCS",
                        plural(held.size(), "node", "nodes"), list(ids_of(held))));
      }
      if (other != nullptr) {
        d_.warning("model.motion_twice", place,
                   fmt::format("/{}/{} imposes the same direction at the same time on {}: {}; the last one counts, keep one of them",
                               name_of(other->kind), other->id, plural(twice.size(), "node", "nodes"), list(ids_of(twice))));
      }
    }
  }

  /// A boundary condition in the same axes holds the direction, or one in any axes all three.
  bool holds(Index node, const ImposedMotion& motion) const {
    const auto found = held_.find(node);
    if (found == held_.end()) return false;
    const auto first = static_cast<std::size_t>(motion.direction / 3 * 3);
    return std::any_of(found->second.begin(), found->second.end(), [&](const auto& held) {
      const auto& [skew, flags] = held;
      if (flags[first] && flags[first + 1] && flags[first + 2]) return true;
      return skew == motion.skew && flags[static_cast<std::size_t>(motion.direction)];
    });
  }

  void initial_velocities() {
    std::map<Id, std::vector<Index>> nodes_of;  // /INIVEL/NODE is one item per node
    std::set<Index> moving;
    for (const InitialVelocity& v : m_.initial_velocities) {
      nodes_of[v.id].insert(nodes_of[v.id].end(), v.nodes.begin(), v.nodes.end());
      moving.insert(v.nodes.begin(), v.nodes.end());
    }
    for (const auto& [id, nodes] : nodes_of) {
      following(
          "INIVEL", id, nodes, [&](Index main) { return moving.contains(main); }, "give the velocity to {}");
    }
  }

  void boundary_conditions() {
    for (const BoundaryCondition& b : m_.boundary_conditions) {
      const auto held_too = [&](Index main) {
        std::array<bool, 6> held{};
        if (const auto found = held_.find(main); found != held_.end()) {
          if (const auto same_axes = found->second.find(b.skew); same_axes != found->second.end()) held = same_axes->second;
        }
        for (std::size_t k = 0; k < 3; ++k) {
          if ((b.translation[k] && !held[k]) || (b.rotation[k] && !held[k + 3])) return false;
        }
        return true;
      };
      following("BCS", b.id, b.nodes, held_too, "hold {}");
      following("BCS", b.id, b.nodes, held_too, "hold {} too", true);
    }
  }

  void gravities() {
    for (const Gravity& g : m_.gravities) {
      const auto acts = [&](Index main) {
        return std::any_of(m_.gravities.begin(), m_.gravities.end(), [&](const Gravity& other) {
          return other.direction == g.direction && other.skew == g.skew && std::binary_search(other.nodes.begin(), other.nodes.end(), main);
        });
      };
      constexpr const char* advice = "take {} into the group, where the weight of the whole body acts";
      following("GRAV", g.id, g.nodes, acts, advice);
      following("GRAV", g.id, g.nodes, acts, advice, true);
    }
  }

  /// Moments and rotations of nodes that have no rotational inertia.
  void rotations() {
    std::vector<bool> turns(static_cast<std::size_t>(m_.node_count()), false);
    const auto mark = [&turns](const auto& nodes) {
      for (const Index n : nodes) turns[static_cast<std::size_t>(n)] = true;
    };
    for (const auto& nodes : m_.shells.nodes) mark(nodes);
    for (const auto& nodes : m_.sh3ns.nodes) mark(nodes);
    for (const RigidBody& b : m_.rigid_bodies) {
      mark(b.nodes);
      if (b.main != no_index) turns[static_cast<std::size_t>(b.main)] = true;
    }
    std::map<std::pair<std::string_view, Id>, std::vector<Index>> lost;
    const auto look = [&](std::string_view word, Id id, const std::vector<Index>& nodes) {
      for (const Index n : nodes) {
        if (!turns[static_cast<std::size_t>(n)]) lost[{word, id}].push_back(n);
      }
    };
    for (const InitialVelocity& v : m_.initial_velocities) {
      if (v.rotational && v.value != Vec3{}) look("INIVEL", v.id, v.nodes);
    }
    for (const ImposedMotion& motion : m_.imposed_motions) {
      if (motion.direction > 2) look(name_of(motion.kind), motion.id, motion.nodes);
    }
    for (const ConcentratedLoad& l : m_.concentrated_loads) {
      if (l.direction > 2) look("CLOAD", l.id, l.nodes);
    }
    for (const auto& [card, nodes] : lost) {
      const bool one = nodes.size() == 1;
      d_.warning("model.rotation_of_solid", place_of(c_, card.first, card.second),
                 fmt::format("{} of no shell and no rigid body and cannot turn, so this does nothing there: {}; {}",
                             one ? "1 node is" : fmt::format("{} nodes are", nodes.size()), list(ids_of(nodes)),
                             card.first == "INIVEL" ? "/INIVEL/AXIS gives a solid that spins its velocities"
                                                    : "use forces or motions along X, Y, Z, or hold the nodes by a rigid body"));
    }
  }

  /// Warns of nodes that follow a rigid body whose main node has no such condition: there it does nothing.
  /// @param later  of the bodies that a sensor switches on after the start, not of those that are there from the start
  template <class MainHasIt>
  void following(std::string_view word, Id id, const std::vector<Index>& nodes, const MainHasIt& main_has_it,
                 fmt::format_string<std::string> advice, bool later = false) {
    std::map<const RigidBody*, bool> lacking;
    std::vector<Index> lost;
    for (const Index n : nodes) {
      const RigidBody* body = (later ? later_ : body_)[static_cast<std::size_t>(n)];
      if (body == nullptr) continue;
      const auto [found, inserted] = lacking.emplace(body, false);
      if (inserted) found->second = !main_has_it(body->main);
      if (found->second) lost.push_back(n);
    }
    if (lost.empty()) return;
    std::sort(lost.begin(), lost.end());
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    std::vector<Id> bodies, mains;
    for (const RigidBody& b : m_.rigid_bodies) {
      if (const auto found = lacking.find(&b); found == lacking.end() || !found->second) continue;
      bodies.push_back(b.id);
      mains.push_back(m_.node_id[static_cast<std::size_t>(b.main)]);
    }
    const bool one = bodies.size() == 1;
    d_.warning(
        "model.condition_of_rigid_body", place_of(c_, word, id),
        fmt::format("{} of rigid {} {} and {} {}{}, so this does nothing there{}: {}; {}",
                    lost.size() == 1 ? "1 node is a secondary node" : fmt::format("{} nodes are secondary nodes", lost.size()),
                    one ? "body" : "bodies", list(bodies), lost.size() == 1 ? "follows" : "follow", one ? "it" : "them",
                    later ? one ? " once its sensor switches it on" : " once their sensors switch them on" : "", later ? " any more" : "",
                    list(ids_of(lost)), fmt::format(advice, (one ? "its main node " : "their main nodes ") + list(mains))));
  }

  Context& c_;
  const Model& m_;
  Diagnostics& d_;
  std::vector<const RigidBody*> body_, later_;  ///< of secondary nodes: the one that they follow from the start; once a sensor says so
  std::map<Index, Held> held_;
};

}  // namespace

void check_motions(Context& c) { MotionChecks(c).run(); }

}  // namespace abut::model
