#include "constraints/axes.hpp"

#include <cstddef>

namespace abut::constraints {

namespace {
const Frame global_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
}

bool frame_of_points(const Vec3& p1, const Vec3& p2, const Vec3& p3, int direction, Frame& frame) {
  const Vec3 first = normalized(p2 - p1);
  const Vec3 third = normalized(cross(first, p3 - p1));
  if (squared_norm(third) == 0.0) return false;
  // Direction X: x' = first, z' = x' x (p3 - p1), y' = z' x x'; Y and Z by cyclic permutation.
  const auto k = static_cast<std::size_t>(direction);
  frame[k] = first;
  frame[(k + 2) % 3] = third;
  frame[(k + 1) % 3] = cross(third, first);
  return true;
}

Axes::Axes(const model::Model& model) : model_(&model) {
  frames_.reserve(model.skews.size());
  for (const model::Skew& skew : model.skews) frames_.push_back(skew.axes);
}

void Axes::update(const state::State& state) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const model::Skew& skew = model_->skews[i];
    if (skew.nodes[0] == no_index) continue;
    const auto at = [&](int k) { return state.x[static_cast<std::size_t>(skew.nodes[static_cast<std::size_t>(k)])]; };
    frame_of_points(at(0), at(1), at(2), skew.direction, frames_[i]);
  }
}

const Frame& Axes::frame(Index skew) const { return skew == no_index ? global_axes : frames_[static_cast<std::size_t>(skew)]; }

}  // namespace abut::constraints
