// Which facets each held node must be measured against: lists from a box tree, kept until something has moved by a skin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "abut/contact/interface.hpp"
#include "contact/search/box_tree.hpp"
#include "contact/search/motion.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

/// A time of the clock below: kept in single precision, never later than what it is given.
class Due {
 public:
  Due() = default;
  Due(double due) : due_(below(due)) {}     // NOLINT: a number like any other
  operator double() const { return due_; }  // NOLINT

 private:
  float due_ = 0.0F;
  static float below(double d) {
    const auto f = static_cast<float>(std::clamp(d, -3e38, 3e38));
    return f > d ? f - (1.2e-7F * std::abs(f) + std::numeric_limits<float>::min()) : f;
  }
};

/// Positions as parts of their extent, 21 bits for each coordinate, and how far they may be from the true ones.
class Positions {
 public:
  void keep(std::span<const Vec3> x);
  /// Upper bound of the largest |x - kept - common|.
  [[nodiscard]] double largest_motion(std::span<const Vec3> x, const Vec3& common) const;

 private:
  static constexpr std::uint64_t bits = 21, largest = (std::uint64_t{1} << bits) - 1;
  std::vector<std::uint64_t> x_;
  Vec3 low_, unit_;
  double error_ = 0.0;

  [[nodiscard]] Vec3 kept(std::size_t i) const {
    const auto part = [this, i](std::uint64_t axis) {
      return static_cast<double>(static_cast<std::int64_t>(x_[i] >> (axis * bits) & largest));
    };
    return {low_.x + unit_.x * part(0), low_.y + unit_.y * part(1), low_.z + unit_.z * part(2)};
  }
};

/// Lists hold every active facet whose distance to the node is at most its reach, now and until slack() exceeds the skin.
///
/// A clock counts, step by step, how much any node-to-facet distance can have changed: a distance measured when the clock showed c is
/// at least its value then - (clock - c). Entries keep value + c, so that one comparison tells whether a facet can be the nearest.
class Candidates {
 public:
  struct Entry {
    Index facet : 30;
    bool wide : 1;    ///< `due` counts strips as wide as a held node's can be
    bool border : 1;  ///< the facet had free borders when the list was made
    Due due;  ///< distance when last measured, before that a lower bound, + the clock then: the distance now is at least due - clock()

    Entry() : Entry(0, false, false, 0.0) {}
    /// @pre 0 <= f < 2^29
    Entry(Index f, bool w, bool b, double d) : facet(f & 0x1fffffff), wide(w), border(b), due(d) {}
  };
  static_assert(sizeof(Entry) == 8);

  /// Rebuilds the lists when any node-to-facet distance may have changed by more than `skin` since the last build (or `force` is set).
  /// @param motion  since the last update
  /// @param reach  #held, distance within which facets matter (< 0: this node needs none)
  /// @param executor  runs loops over held nodes; empty: the caller does
  /// @return true when the lists are new
  bool update(const Side& held, const Side& surface, const Motion& motion, const std::function<double(Index)>& reach, double skin,
              bool force, const Executor& executor = {});

  /// False before the first update().
  [[nodiscard]] bool made() const { return !first_.empty(); }
  [[nodiscard]] std::span<const Entry> of(Index node) const {
    return std::span(entries_).subspan(at(first_[at(node)]), at(first_[at(node) + 1] - first_[at(node)]));
  }
  /// The same, for whoever measures a distance and writes it back with the clock. Entries of a node belong to one thread at a time.
  [[nodiscard]] std::span<Entry> of(Index node) {
    return std::span(entries_).subspan(at(first_[at(node)]), at(first_[at(node) + 1] - first_[at(node)]));
  }
  [[nodiscard]] double clock() const { return clock_; }
  /// Distance of the node's nearest listed facet + the clock when it was measured (see Entry::due); 1e300: none listed. Of facets at a free
  /// border also the height over their plane: whoever goes around it does not stay in front unseen.
  [[nodiscard]] double nearest_due(Index node) const { return nearest_[at(node)]; }
  void set_nearest_due(Index node, double due) { nearest_[at(node)] = due; }
  void limit_nearest_due(Index node, double due) { nearest_[at(node)] = std::min(nearest_due(node), due); }
  /// The least height of the node over the planes of listed facets at free borders, + the clock when it was measured; 1e300: none listed.
  [[nodiscard]] double border_due(Index node) const { return border_[at(node)]; }
  void set_border_due(Index node, double due) { border_[at(node)] = due; }
  /// When the node may next be near the outer end of a strip, by the clock; 1e300: no facet with free borders listed.
  [[nodiscard]] double strips_due(Index node) const { return strips_[at(node)]; }
  void set_strips_due(Index node, double due) { strips_[at(node)] = due; }
  /// Of all active facets in the node's list but `facet`, the nearest one: when the first of them is due.
  struct Others {
    Index facet = no_index;  ///< no_index: unknown
    bool wide = false;       ///< as in Entry
    double due = 0.0;
  };
  [[nodiscard]] Others others(Index node) const {
    const Entry& kept = others_[at(node)];
    return {kept.facet - 1, kept.wide, kept.due};
  }
  void set_others(Index node, const Others& others) { others_[at(node)] = {others.facet + 1, others.wide, false, others.due}; }
  /// Upper bound of the change of any node-to-facet distance since the lists were made.
  [[nodiscard]] double slack() const { return slack_; }
  /// Facets whose box at the last build, moved with the surface, comes within `margin` (beyond slack) of the box, and some of their
  /// neighbours.
  template <class Visit>
  void near(Bounds box, double margin, Visit&& visit) const {
    box.low -= shift_;
    box.high -= shift_;
    box.inflate(margin + slack_);
    tree_.query(box, visit);
  }

 private:
  BoxTree tree_;
  std::vector<Index> first_;
  std::vector<Entry> entries_;
  std::vector<Due> nearest_, border_, strips_;
  std::vector<Entry> others_;           ///< facet + 1
  Positions held_then_, surface_then_;  ///< when the lists were made
  Vec3 shift_;                          ///< mean motion of the surface since then
  double slack_ = 0.0;
  double clock_ = 0.0;

  void make(const Side& held, const Side& surface, const std::function<double(Index)>& reach, double skin, const Executor& executor);
  /// A facet near some nodes.
  struct Near {
    Index facet = no_index;
    bool border = false;
    std::array<Index, 4> node{};  ///< of the host
    MeanPlane plane;
  };
  /// Appends the lists of neighbouring nodes [first, first + within.size()).
  /// @param within  distance to which each list reaches; < 0: it needs none
  /// @param near    work space
  void list(const Side& held, const Side& surface, Index first, std::span<const double> within, std::vector<Near>& near,
            std::vector<Entry>& entries);
};

/// Box of a facet with its strips.
[[nodiscard]] Bounds facet_bounds(const Patch& patch);

}  // namespace abut::contact
