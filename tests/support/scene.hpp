// Models built in code for verification runs: the deck reader is not in the way of the physics.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace abut::scenes {

/// Node and face numbering of a structured block of bricks.
struct Block {
  std::array<int, 3> cells{};
  std::vector<Index> nodes;  ///< (nx+1) (ny+1) (nz+1), x fastest
  [[nodiscard]] Index at(int i, int j, int k) const {
    return nodes[static_cast<std::size_t>(i + (cells[0] + 1) * (j + (cells[1] + 1) * k))];
  }
  /// Node indices of a grid plane: axis 0..2, low or high end.
  [[nodiscard]] std::vector<Index> plane(int axis, bool high) const;
};

class Scene {
 public:
  explicit Scene(std::string name);

  Index elastic(double density, double young, double poisson);
  Index johnson_cook(double density, double young, double poisson, double a, double b, double n);
  /// Isolid 1, or small strain without bulk viscosity, for comparison with linear theory.
  Index solid_property(int isolid = 1);
  Index linear_solid_property();
  Index shell_property(double thickness, int points = 3);
  Index part(Index property, Index material);

  /// Bricks on a regular grid; `shape` maps grid positions to space (identity when empty).
  Block block(Index part, const Vec3& origin, const Vec3& size, std::array<int, 3> cells,
              const std::function<Vec3(const Vec3&)>& shape = {});
  /// Shells over (u, v) in [0,1]^2, normal along du x dv unless flipped. @return (nu+1)(nv+1) node indices, u fastest
  std::vector<Index> shells(Index part, int nu, int nv, const std::function<Vec3(double, double)>& shape, bool flip = false);

  Index node(const Vec3& x) { return add_node(x); }
  void brick(Index part, const std::array<Index, 8>& nodes);

  /// Faces of bricks of this scene as a surface; each gets its brick (faces of the hull have one).
  Index surface(const std::vector<std::array<Index, 4>>& faces);
  /// Outward faces of a block on one side: axis 0..2, low or high end.
  Index surface(const Block& block, int axis, bool high);
  /// All shells of a part, their own orientation.
  Index shell_surface(Index part);

  void velocity(const std::vector<Index>& nodes, const Vec3& v);
  /// @return the main node, a new one
  Index rigid_body(const std::vector<Index>& nodes, const Vec3& centre);
  void fix(const std::vector<Index>& nodes, std::array<bool, 3> translation, std::array<bool, 3> rotation = {});
  Index function(std::vector<double> x, std::vector<double> y);
  void load(const std::vector<Index>& nodes, int direction, double total, Index function = no_index);
  /// Uniform traction on one side of a regular block: a total force shared by tributary area. Axis, high: as surface().
  void traction(const Block& block, int axis, bool high, int direction, double total, Index function = no_index);
  void gravity(int direction, double value);
  /// u = value * function(t) along one direction, of global axes or a skew.
  void displacement(const std::vector<Index>& nodes, int direction, double value, Index function, Index skew = no_index);
  /// Fixed axes: x' at `angle` from x in the plane of x and y, z' = z.
  Index skew_about_z(double angle);
  /// Pressure on faces, positive against their outward normals.
  void pressure(const std::vector<std::array<Index, 4>>& faces, double value, Index function = no_index);
  /// TYPE3 with the given stiffness factor, friction and gap. @return index of the interface
  Index contact(Index surface_1, Index surface_2, double stfac = 0.2, double friction = 0.0, double gap = 0.0);
  void history_node(Index node);

  void end(double time, double history_interval = 0.0, double step_scale = 0.9);

  model::Model model;

 private:
  Index add_node(const Vec3& x);
};

}  // namespace abut::scenes
