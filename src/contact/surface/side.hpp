// One surface of an interface as it is now: positions, stiffness fields, activity, borders.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/interface.hpp"
#include "contact/project/closest_point.hpp"
#include "simd/few_values.hpp"

namespace abut::contact {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Of facets or nodes of a surface.
using Values = simd::FewValues<std::uint8_t>;

/// @throws std::invalid_argument, with the name of the values, when one is negative or not finite
void check_finite(std::span<const double> values, const char* what);
/// @throws std::invalid_argument for a node that is negative or listed twice
void check_held_nodes(std::span<const Index> nodes);

class Side {
 public:
  Side() = default;
  /// @param canonical  facets in an order that does not depend on how they were listed
  Side(Surface surface, bool canonical);
  /// Nodes without facets (the held nodes of nodes_to_surface), in the order given.
  Side(std::vector<Index> nodes, std::vector<double> stiffness);

  /// Facet values in the order in which the host listed its facets; for nodes without facets: stiffness and active per node.
  /// @throws std::invalid_argument on a wrong length or a negative or non-finite stiffness or thickness
  void set(const SurfaceState& state, bool third_node_twice);

  [[nodiscard]] const SurfaceTopology& surface() const { return surface_; }
  [[nodiscard]] std::span<const Index> nodes() const { return facet_count() > 0 ? surface_.nodes() : std::span<const Index>(nodes_); }
  [[nodiscard]] Index node_count() const { return static_cast<Index>(x_.size()); }
  [[nodiscard]] Index facet_count() const { return surface_.facet_count(); }
  /// Position of facet f in the host's list.
  [[nodiscard]] Index listed(Index f) const { return listed_.empty() ? f : listed_[at(f)]; }
  /// What set() was given last, in the host's order.
  [[nodiscard]] std::vector<double> listed_stiffness() const { return as_listed(facet_count() > 0 ? facet_stiffness_ : node_stiffness_); }
  [[nodiscard]] std::vector<double> listed_thickness() const { return as_listed(facet_count() > 0 ? thickness_ : node_thickness_); }
  [[nodiscard]] bool active(Index f) const { return active_[at(f)] != 0; }
  /// False when all facets around the node are eroded.
  [[nodiscard]] bool node_active(Index s) const { return node_active_[at(s)] != 0; }
  [[nodiscard]] double facet_stiffness(Index f) const { return facet_stiffness_[at(f)]; }
  /// Own stiffness of a node: a quarter (third) of each facet around it.
  [[nodiscard]] double node_stiffness(Index s) const { return node_stiffness_[at(s)]; }
  /// Facet stiffness averaged at a node: the corner values of a field that is continuous over the surface.
  [[nodiscard]] double corner_stiffness(Index s) const { return corner_stiffness_[at(s)]; }
  [[nodiscard]] double largest_corner_stiffness() const { return largest_corner_stiffness_; }
  /// All corners are equally stiff, to rounding.
  [[nodiscard]] bool evenly_stiff() const { return smallest_corner_stiffness_ >= (1.0 - 1e-9) * largest_corner_stiffness_; }
  [[nodiscard]] double thickness(Index f) const { return thickness_.empty() ? 0.0 : thickness_[at(f)]; }
  /// Thickness averaged at a node over its facets (of nodes without facets: their own); 0: none.
  [[nodiscard]] double node_thickness(Index s) const { return node_thickness_.empty() ? 0.0 : node_thickness_[at(s)]; }
  /// The same interpolated over a facet; beyond its sides within its corners' values.
  [[nodiscard]] double thickness_at(Index f, const std::array<double, 4>& weight) const;
  [[nodiscard]] double largest_thickness() const;
  /// All corners are equally thick, to rounding.
  [[nodiscard]] bool evenly_thick() const { return evenly_thick_; }

  /// Bit e: side e of the facet is a free border.
  [[nodiscard]] std::uint8_t borders(Index f) const { return borders_[at(f)]; }

  /// Copies the host's positions of this surface's nodes.
  void gather(std::span<const Vec3> x) { gather(x, 0, x_.size()); }
  /// Those of nodes begin to end - 1.
  void gather(std::span<const Vec3> x, std::size_t begin, std::size_t end);
  [[nodiscard]] std::span<const Vec3> x() const { return x_; }
  /// Gives its positions for others, #N.
  void swap_positions(std::vector<Vec3>& x) { x_.swap(x); }
  [[nodiscard]] Patch patch(Index f) const {
    Patch patch = bare_patch(f);
    patch.borders = borders_[at(f)];
    if (patch.borders != 0) fit_strips(patch);
    return patch;
  }
  /// Without strips, whatever its borders.
  [[nodiscard]] Patch bare_patch(Index f) const {
    const std::array<Index, 4>& local = surface_.local()[at(f)];
    return {{x_[at(local[0])], x_[at(local[1])], x_[at(local[2])], x_[at(local[3])]}, local[2] == local[3]};
  }

  /// Unit normal of the surface at a closest point: of the facet on a face, the mean of two on an edge, the angle-weighted mean
  /// at a corner [Baerentzen, Aanaes 2005]. Its sign against x - point tells in front from behind.
  [[nodiscard]] Vec3 pseudonormal(Index f, const ClosestPoint& point) const;

  [[nodiscard]] double facet_area(Index f) const;
  /// Force over the facet's area; 0 on a facet without area.
  [[nodiscard]] double pressure(Index f, double force) const;
  /// Facet areas over their corners at node s.
  [[nodiscard]] double tributary_area(Index s) const;
  /// Mean square root of the facets' areas.
  [[nodiscard]] double mean_size() const;

 private:
  SurfaceTopology surface_;
  std::vector<Index> nodes_;   ///< without facets
  std::vector<Index> listed_;  ///< facet number as the host listed it; empty: the same
  std::vector<std::uint8_t> active_, node_active_, borders_;
  std::vector<std::uint8_t> nodes_said_;  ///< activity of nodes as the host said it last; empty: never
  Values facet_stiffness_, node_stiffness_, corner_stiffness_, thickness_, node_thickness_;
  double largest_corner_stiffness_ = 0.0, smallest_corner_stiffness_ = 0.0;  ///< of active corners
  bool evenly_thick_ = true;
  std::vector<Vec3> x_;

  /// Free borders and edges at eroded facets.
  void find_borders();
  [[nodiscard]] std::vector<double> as_listed(const Values& values) const;
};

}  // namespace abut::contact
