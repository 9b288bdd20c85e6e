// What the contacts of an interface do to the nodes of one side.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "contact/enforce/node_states.hpp"
#include "contact/search/motion_kernel.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

/// Contact forces on the nodes of a side: from being held, and as corners of facets that hold others. Kept apart so that
/// neither the order of the passes nor that of the surfaces shows in the sums. Most nodes of a surface have none: memory is taken by pages.
struct SideLoads {
  struct Node {
    Vec3 own_normal, own_tangential, reaction_normal, reaction_tangential;
    double own_stiffness = 0.0, reaction_stiffness = 0.0;
    double own_springs = 0.0, reaction_springs = 0.0;  ///< kappa phi'' of the pairs alone
    Vec3 force_before;                                 ///< of the last committed step

    [[nodiscard]] Vec3 total() const { return (own_normal + own_tangential) + (reaction_normal + reaction_tangential); }
  };
  std::vector<Vec3> x_before;                     ///< of the last committed step
  std::vector<float> own_before, springs_before;  ///< own springs, own and reaction springs of that step
  /// Per block of nodes: the largest square of a node's motions in the last and in the coming step, less the other side's mean motion.
  static constexpr std::size_t block = MotionArgs::block;
  std::vector<double> squared_motion;
  /// Which of them can be other than zero: the loads of this step, the force of the last.
  static constexpr std::uint8_t now = 1, before = 2;
  std::vector<std::uint8_t> loaded;
  double work = 0.0;       ///< committed: sum (f_old + f_new)/2 . dx
  double work_step = 0.0;  ///< of the step that evaluate() saw
  std::vector<double> work_parts;

  void resize(std::size_t nodes);
  /// Those of nodes begin to end - 1.
  void clear(std::size_t begin, std::size_t end);
  /// What nodes begin to end - 1 carry becomes what they carried before.
  void commit(std::size_t begin, std::size_t end);
  /// @pre loaded[s] != 0
  [[nodiscard]] Node& node(std::size_t s) { return pages_[s / page][s % page]; }
  [[nodiscard]] const Node& node(std::size_t s) const { return pages_[s / page][s % page]; }
  /// Node i, which is loaded in this step. Nodes of a group belong to one thread at a time.
  [[nodiscard]] Node& load(Index i) {
    const std::size_t s = at(i);
    if (pages_[s / page] == nullptr) pages_[s / page] = std::make_unique<Node[]>(page);
    loaded[s] |= now;
    return node(s);
  }
  /// Calls visit(s) for those of nodes begin to end - 1 that are loaded, in their order.
  template <class Visit>
  void for_loaded(std::size_t begin, std::size_t end, Visit&& visit) const {
    std::uint64_t eight;
    for (std::size_t s = begin; s < end;) {
      const std::size_t next = std::min(s + sizeof eight, end);
      eight = 1;
      if (next - s == sizeof eight) std::memcpy(&eight, &loaded[s], sizeof eight);
      if (eight == 0) s = next;
      for (; s < next; ++s) {
        if (loaded[s] != 0) visit(s);
      }
    }
  }
  /// #nodes
  [[nodiscard]] std::vector<Vec3> forces_before() const;
  /// @pre springs_before is set
  void set_forces_before(std::span<const Vec3> force);

 private:
  static constexpr std::size_t page = NodeStates::group;
  std::vector<std::unique_ptr<Node[]>> pages_;
};

}  // namespace abut::contact
