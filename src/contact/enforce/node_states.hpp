// What the held nodes of a pass remember, before and after a step. Most nodes of a surface remember nothing, or only that they were seen in
// front: a byte each says so. Nodes have full states, in groups, where one of a group remembers more.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::contact {

/// A material point of the surface.
struct SurfacePoint {
  std::array<double, 4> weight{};
  std::int64_t facet = no_index;
};

/// What a held node remembers from step to step (no padding: it is written to the history as it is).
struct NodeState {
  Vec3 normal;          ///< direction of the last contact
  Vec3 slip;            ///< return mapping: elastic slip in the anchor's facet frame; anchors: F0
  Vec3 slip_normal;     ///< return mapping: contact normal in the same frame
  Vec3 push;            ///< normal force of the last step with what a varying stiffness adds to it, without damping
  Vec3 friction;        ///< friction force of the last step, as it acted on the surface
  SurfacePoint anchor;  ///< return mapping: last contact point; anchors: where F0 acted
  double tangential_stiffness = 0.0;
  double rate = 0.0;          ///< speed of opening in the last step
  double acceleration = 0.0;  ///< that the contact force gave to the opening
  double force = 0.0;         ///< normal force of the last step, without damping
  double stored = 0.0;        ///< energy that it held
  double made = 0.0;          ///< account of the pair (account.hpp): energy made since it began
  std::int32_t facet = no_index;
  std::uint8_t held = 0;     ///< 1: came over a border; 2: came through the front, its strips widen with its depth
  std::uint8_t ignored = 0;  ///< lies behind and came from behind: not met until it is seen in front
  std::uint8_t anchored = 0;
  std::uint8_t in_front = 0;  ///< was in front of a facet when it was last in contact or about to be
  std::uint8_t reckoned = 0;  ///< `made` counts
  std::uint8_t light = 0;  ///< 1: its steps were once long for its stiffness, or it passed over a fold; settled: its last force was tried;
                           ///< passive: it may give no more than it took
  std::array<std::uint8_t, 2> unused{};
  float step_stiffness = 0.0F;  ///< that it gave the host in its last step in contact
  static constexpr std::uint8_t settled = 2, passive = 3;
  double offset = 0.0;   ///< the gap of this node is smaller by this (initial penetration)
  double damping = 0.0;  ///< damping force of the last step
  Vec3 filtered;         ///< with a filter: filtered trial friction; return mapping: as a slip in the anchor's facet frame
  SurfacePoint last;     ///< anchors and accounts: last contact point
};

/// What of a node takes a byte, here and in the history.
enum class Remembered : std::uint8_t { nothing, seen_in_front, all };

[[nodiscard]] Remembered remembered(const NodeState& state);
/// The state of a node that remembers nothing, or that it was seen in front.
[[nodiscard]] const NodeState& plain_state(Remembered what);

class NodeStates {
 public:
  static constexpr Index group = 128;
  /// Full states for a group that has none, while it is evaluated; one per thread.
  struct Scratch {
    std::array<NodeState, group> before, after;
  };

  explicit NodeStates(std::size_t nodes);

  [[nodiscard]] std::size_t size() const { return before_.size(); }
  [[nodiscard]] const NodeState& before(Index i) const {
    const Page& page = pages_[number(i)];
    return page.before != nullptr ? page.before[place(i)] : plain_state(before_[static_cast<std::size_t>(i)]);
  }
  [[nodiscard]] const NodeState& after(Index i) const {
    const Page& page = pages_[number(i)];
    return page.after != nullptr ? page.after[place(i)] : plain_state(after_[static_cast<std::size_t>(i)]);
  }
  /// @pre the group of node i has full states, of its own or lent
  [[nodiscard]] NodeState& after(Index i) { return pages_[number(i)].after[place(i)]; }
  /// Gives both copies a value. Not while a group is evaluated.
  void set(Index i, const NodeState& state);
  /// The steps' ends: what was after becomes before.
  void commit();

  /// Lends full states to a group that has none as long as it lives. Groups are independent: a thread each.
  class Loan {
   public:
    Loan(NodeStates& states, std::size_t group, Scratch& scratch);
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    /// Makes before(i). @pre called for every node of the group whose state is looked at
    void wake(Index i);
    /// Keeps what these nodes remember after the step. The group gets full states of its own when one of them needs it.
    void settle(std::span<const Index> nodes);

   private:
    NodeStates& states_;
    std::size_t group_;
    bool lent_;
  };

 private:
  struct Page {
    NodeState* before = nullptr;
    NodeState* after = nullptr;
  };
  std::vector<Page> pages_;                         // per group
  std::vector<std::unique_ptr<NodeState[]>> full_;  // per group: what its page points to, or nothing
  std::vector<Remembered> before_, after_;          // per node; of groups without full states

  [[nodiscard]] static std::size_t number(Index i) { return static_cast<std::size_t>(i) / group; }
  [[nodiscard]] static std::size_t place(Index i) { return static_cast<std::size_t>(i) % group; }
  void give_full(std::size_t group);
};

}  // namespace abut::contact
