// Facets as nodes in front of them see them in one step: their plane, and how they move. Neighbouring nodes list the same facets: what was
// found for one serves the others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "contact/surface/side.hpp"

namespace abut::contact {

/// A facet without its strips.
struct FacetView : MeanPlane {
  Index facet = no_index;
  bool moves_known = false;
  bool flat = false;  ///< so nearly that the plane's normal is that of every point of it, within `tilt`
  std::uint64_t step = 0;
  Vec3 along_s, along_t;  ///< flat: s and t of a point over the facet are about the products of these and its place relative to the center
  double narrow = 0.0;    ///< flat: square of the smaller half side
  Vec3 last, coming;      ///< mean motion of the corners, in the last and in the coming step
  double last_spread = 0.0, coming_spread = 0.0;  ///< no corner's motion differs from the mean by more
  double rises = 0.0;                             ///< largest motion of a corner along the normal in the coming step

  /// A node moves by less than `way` relative to every point of the facet, in the last and in the coming step.
  /// @param beyond  1: points of the facet; more: points as far beyond its sides that their weights' magnitudes sum to this
  [[nodiscard]] bool moves_less(const Vec3& its_last, const Vec3& its_coming, double beyond, double way) const {
    const double rest = way - beyond * coming_spread, rest_of_last = way - beyond * last_spread;
    return rest > 0.0 && rest_of_last > 0.0 && squared_norm(its_coming - coming) < rest * rest &&
           squared_norm(its_last - last) < rest_of_last * rest_of_last;
  }
  /// The node, as high over the plane, comes nearer by less than `way` in the coming step. False also where that is not easily told.
  [[nodiscard]] bool comes_less(const Vec3& x, double over, const Vec3& its_coming, double way) const {
    constexpr double tilt = 0.05, inside = 0.9;
    const Vec3 from = x - center;
    if (!flat || !(way > 0.0) || over * over > narrow || std::abs(dot(along_s, from)) > inside || std::abs(dot(along_t, from)) > inside)
      return false;
    return tilt * (norm(its_coming - coming) + coming_spread) - (dot(normal, its_coming) - rises) < way;
  }
};

/// The facets that were looked at last, by one thread.
class FacetViews {
 public:
  /// What was found belongs to another step, or to another surface.
  void forget() { ++step_; }
  [[nodiscard]] const FacetView& plane(const Side& surface, Index f) { return place(surface, f); }
  /// @param before  positions in the last step
  /// @param v, dt   of the host
  [[nodiscard]] const FacetView& moving(const Side& surface, std::span<const Vec3> before, std::span<const Vec3> v, double dt, Index f);

 private:
  static constexpr std::size_t places = 512;
  std::array<FacetView, places> view_;
  std::uint64_t step_ = 0;

  FacetView& place(const Side& surface, Index f) {
    FacetView& view = view_[at(f) % places];
    if (view.facet != f || view.step != step_) look(surface, f, view);
    return view;
  }
  void look(const Side& surface, Index f, FacetView& view) const;
};

}  // namespace abut::contact
