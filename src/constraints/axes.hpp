// Axes of skews, fixed or carried by three nodes (numerics.md 6.6).
#pragma once

#include <array>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

using Frame = std::array<Vec3, 3>;  ///< three orthonormal axes

class Axes {
 public:
  explicit Axes(const model::Model& model);

  /// Step 1: refreshes moving skews from x^n. A degenerate skew (nodes on a line) keeps its last axes.
  void update(const state::State& state);

  void persist(state::Archive& a) {
    a.each(frames_, [&a](Frame& frame) { a(frame); });
  }

  /// k-th unit axis, k in 0..2; skew == no_index: global axes.
  [[nodiscard]] Vec3 axis(Index skew, int k) const { return frame(skew)[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const Frame& frame(Index skew) const;

 private:
  const model::Model* model_;
  std::vector<Frame> frames_;  ///< per skew of the model
};

/// Axes of a skew carried by nodes at p1, p2, p3; `direction` 0 X, 1 Y, 2 Z is the axis along p1 -> p2 (numerics.md 6.6.2).
/// @return false when the points do not span a plane; `frame` is then left alone
bool frame_of_points(const Vec3& p1, const Vec3& p2, const Vec3& p3, int direction, Frame& frame);

}  // namespace abut::constraints
