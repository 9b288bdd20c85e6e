// Meshes of round bodies for closed forms: discs of quads without a singular centre, swept into bricks.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "support/scene.hpp"

namespace abut::scenes {

/// A plane mesh of quads over the quarter of the unit disc x >= 0, y >= 0: a core of n by n quads and two blocks of n by m
/// around it (no quad touches the centre with more than one corner).
struct QuarterDisc {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise
  std::vector<int> rim;                   ///< points on the arc, from the x axis to the y axis

  /// @param n quads along half of the core's side, m quads between core and rim
  /// @param core radius of the core on the axes; spacing between core and rim grows by `growth` from quad to quad
  static QuarterDisc make(int n, int m, double core, double growth = 1.0);
};

/// n + 1 positions in [0, 1], the first interval shortest, each `growth` times the one before.
std::vector<double> graded(int n, double growth);

/// The growth with which n intervals, the first of length `first`, fill `length`.
double growth_from(double first, double length, int n);

/// A layered solid: layer k of node p is nodes[p + k * points]; bricks between the layers.
struct Sweep {
  int points = 0, layers = 0;  ///< points of the plane mesh, bricks along the sweep
  std::vector<std::array<int, 4>> quads;
  std::vector<Index> nodes;
  [[nodiscard]] Index at(int point, int layer) const { return nodes[static_cast<std::size_t>(point + layer * points)]; }
  [[nodiscard]] std::vector<Index> layer(int k) const;
  /// Faces of layer k, 0 or the last, normals out of the solid when `place` keeps the sense of (x, y, layer).
  [[nodiscard]] std::vector<std::array<Index, 4>> cap(bool last) const;
};

/// Faces with the opposite normals.
std::vector<std::array<Index, 4>> turned(std::vector<std::array<Index, 4>> faces);

/// Quarter shares of the undeformed facets of some surfaces, per node.
std::vector<double> nodal_areas(const Scene& scene, const std::vector<Index>& surfaces);

using Corners = std::array<Vec3, 8>;

/// Sweeps quads over layers 0..n. @param place (point, layer) -> position; @param part_of corners of a brick -> its part
Sweep sweep(Scene& scene, int points, const std::vector<std::array<int, 4>>& quads, int layers, const std::function<Vec3(int, int)>& place,
            const std::function<Index(const Corners&)>& part_of);

/// Elastic parts for a quasi-static run on a graded mesh: density goes with 1 / size^2 in classes of a factor 2, so that all
/// bricks have about the same time step. The static solution does not depend on it.
class EqualStepParts {
 public:
  /// @param density of bricks of `size` (volume over largest mid-face)
  EqualStepParts(Scene& scene, Index property, double young, double poisson, double density, double size);
  [[nodiscard]] Index operator()(const Corners& corners);

 private:
  Scene* scene_;
  Index property_;
  double young_, poisson_, density_, size_;
  std::map<int, Index> part_;
};

/// Nodes of `nodes` with |component axis - value| <= 1e-9 max(1, |value|) at the start.
std::vector<Index> nodes_on(const Scene& scene, const std::vector<Index>& nodes, int axis, double value, double tolerance = 1e-9);

}  // namespace abut::scenes
