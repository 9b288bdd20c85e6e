// The truth about one node: the closest point of the one-sided surface (docs/theory/contact.md, "Who touches").
#pragma once

#include <algorithm>
#include <array>

#include "contact/search/candidates.hpp"

namespace abut::contact {

/// Relative difference of distances that count as the same.
inline constexpr double equally_near = 1e-8;

/// A node measured against a surface.
struct Measure {
  Index facet = no_index;
  ClosestPoint closest;
  Vec3 normal;            ///< unit, along which the contact pushes the node
  double distance = 0.0;  ///< signed: > 0 in front
  [[nodiscard]] bool found() const { return facet != no_index; }
};

/// Gives the closest point on facet f its sign and direction.
[[nodiscard]] Measure signed_measure(const Side& surface, Index f, const ClosestPoint& closest, const Vec3& x);

/// Facet f extended beyond its free borders by `strip` of a side, or as far as its shape allows.
[[nodiscard]] inline Patch extended(const Side& surface, Index f, double strip) {
  Patch patch = surface.patch(f);
  if (strip > border_strip) patch.strip = patch.narrow * border_strip + patch.widens * (strip - border_strip);
  return patch;
}

/// What was found when a node was measured against facets: each of them is looked at once, however many questions are asked about it.
class Looks {
 public:
  Looks() = default;  // NOLINT: what is not found yet has no value
  Looks(const Side& surface, const Vec3& x) { begin(surface, x); }
  /// Forgets all about the node before.
  void begin(const Side& surface, const Vec3& x) {
    surface_ = &surface;
    x_ = x;
    count_ = 0;
  }

  [[nodiscard]] bool has(Index f, double strip) const { return find(f, strip) < places; }
  /// Closest point on facet f with strips as wide as this. Valid until the next call.
  [[nodiscard]] const ClosestPoint& closest(Index f, double strip) { return look(f, strip).measure.closest; }
  /// The same with its sign and direction.
  [[nodiscard]] const Measure& measure(Index f, double strip) {
    Look& one = look(f, strip);
    if (!one.is_signed) {
      one.measure = signed_measure(*surface_, f, one.measure.closest, x_);
      one.is_signed = true;
    }
    return one.measure;
  }

 private:
  struct Look {
    Measure measure;
    double strip;
    bool is_signed;
  };
  static constexpr std::size_t places = 6;
  const Side* surface_ = nullptr;
  Vec3 x_;
  std::array<Look, places> look_;
  std::size_t count_ = 0;

  [[nodiscard]] std::size_t find(Index f, double strip) const {
    for (std::size_t k = 0; k < std::min(count_, places); ++k) {
      if (look_[k].measure.facet == f && look_[k].strip == strip) return k;
    }
    return places;
  }
  Look& look(Index f, double strip) {
    const std::size_t known = find(f, strip);
    if (known < places) return look_[known];
    Look& one = look_[count_++ % places];
    one.measure.facet = f;
    one.measure.closest = closest_point(extended(*surface_, f, strip), x_);
    one.strip = strip;
    one.is_signed = false;
    return one;
  }
};

/// What a held node remembers.
struct HeldBy {
  Index facet = no_index;  ///< no_index: a free node
  Vec3 normal;
  double strip = border_strip;  ///< where it looks beyond free borders
};

/// Free node: the smallest |distance| among the candidates. Held node: the smallest |distance| among facets that push in
/// about the same direction (n . n_held > -1/2), or any facet it is in front of while it is in front of its own: it is so
/// never handed to the far side of a thin body.
/// Distances that it measures go back into the node's list.
[[nodiscard]] Measure nearest(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held, Looks& looks);
[[nodiscard]] inline Measure nearest(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held) {
  Looks looks(surface, x);
  return nearest(surface, candidates, node, x, held, looks);
}

/// Where the facet that holds a node does so.
struct HeldAt {
  Vec3 point;
  double squared_distance = 0.0;
  double same = 0.0;  ///< square of the distance up to which a point of another facet, not nearer than this one, is the same point
};

/// No listed facet but the one that holds the node comes within `distance` of it at another point than `at`, by distances that go back into
/// its list. False where that facet is not listed.
[[nodiscard]] bool none_within(const Side& surface, Candidates& candidates, Index node, const Vec3& x, const HeldBy& held, double distance,
                               const HeldAt& at, Looks& looks);

/// It pushes in about the direction of `normal`.
[[nodiscard]] inline bool pushes_alike(const Measure& m, const Vec3& normal) { return dot(m.normal, normal) > -0.5; }

}  // namespace abut::contact
