// /BCS: components of motion that are held at zero (numerics.md 6.6.3).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/mobility.hpp"
#include "constraints/axes.hpp"
#include "constraints/work_meter.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

class RigidBodies;

/// Removes fixed components from acceleration and half-step velocity: a -= (a.e) e, v -= (v.e) e, rotations alike.
/// Cards on one node with the same skew accumulate; with different skews the fixed directions are orthonormalised.
class BoundaryConditions {
 public:
  BoundaryConditions(const model::Model& model, const Axes& axes, const RigidBodies& bodies, const Profile& profile = {});

  /// Steps 18 and 22. Secondary nodes of active rigid bodies are left alone: step 23 overwrites them (reference profile: their
  /// half-step velocity is zeroed as everywhere, which shows in outputs only), and so are main nodes that RigidBodies::hold() holds.
  void apply(state::State& state);

  /// IBC of interfaces: direction 0..2 translation, 3..5 rotation, along the axes of the node's own card.
  void release(Index node, int direction);
  void restore(Index node, int direction);
  void restore_all();

  /// Nodes with a card, sorted.
  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }

  /// True when a card holds this direction of the node and it is not released.
  [[nodiscard]] bool fixed(Index node, int direction) const;

  /// Orthonormal directions that are held now, first `count` of the array. @param rotation rotations, else translations
  struct Held {
    std::array<Vec3, 3> axis;
    int count = 0;
    void add(Vec3 direction);  ///< keeps what a unit vector adds to the span
    [[nodiscard]] Vec3 free_part(Vec3 b) const;
    /// Of a mass that is held in these directions.
    [[nodiscard]] contact::Mobility mobility(double mass) const;
  };
  /// @param without  directions of the node's own card (bit k: direction k of 0..5) that count as released whether they are or not
  [[nodiscard]] Held held(Index node, bool rotation, unsigned without = 0) const;
  /// What is held of this node is the same at all times, unless an interface lifts it: one card, no skew.
  [[nodiscard]] bool is_plain(Index node) const { return plain_entry(node) != no_index; }

  /// Step 25: exact discrete work of both applications (negative: kinetic energy taken).
  double ledger_work(const state::State& state) { return meter_.settle(state); }
  /// Before ledger_work: its part that jumps of the velocity are.
  [[nodiscard]] double jump_work() const { return meter_.jump_work(); }

  void persist(state::Archive& a) {
    a.fixed(released_);
    meter_.persist(a);
  }

 private:
  struct Entry {
    Index node, skew;
    std::uint8_t bits;
  };  ///< bit k: direction k of 0..5
  /// Index into entries_ of the only card on a node if that holds global directions, else no_index.
  [[nodiscard]] Index plain_entry(Index node) const {
    const Index e = first_[static_cast<std::size_t>(node)];
    const bool plain = first_[static_cast<std::size_t>(node) + 1] == e + 1 && entries_[static_cast<std::size_t>(e)].skew == no_index;
    return plain ? e : no_index;
  }
  [[nodiscard]] std::uint8_t held_bits(const Entry& entry) const {
    return static_cast<std::uint8_t>(entry.bits & ~released_[static_cast<std::size_t>(entry.node)]);
  }

  const Axes* axes_;
  const RigidBodies* bodies_;
  bool secondary_too_;
  std::vector<Entry> entries_;          ///< sorted by node, then skew
  std::vector<Index> first_;            ///< #N + 1: entries of node i are [first_[i], first_[i + 1])
  std::vector<Index> nodes_;            ///< nodes with an entry
  std::vector<std::uint8_t> released_;  ///< #N
  WorkMeter meter_;
};

}  // namespace abut::constraints
