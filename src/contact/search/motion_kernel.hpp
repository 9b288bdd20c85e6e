// How far the nodes of a side have moved, in one go over a number type: what every step asks of every node.
//
// Four nodes at a time on every instruction set, so that the order of the sum does not show in its bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace abut::contact {

struct MotionArgs {
  static constexpr std::size_t block = 16;       ///< nodes
  const double *x = nullptr, *before = nullptr;  ///< the side's, by 3
  const double* v = nullptr;                     ///< the host's, #N by 3
  const std::int32_t* node = nullptr;            ///< host index of each node of the side
  double dt = 0.0;
  double common[2][3] = {};  ///< motions to be taken off
  int facing = 0;            ///< which of them is that of the other side
  /// Per block of nodes: largest |d - common|^2, of the last motion d = x - before and the coming one dt v, `common` that of the other
  /// side.
  double* of_block = nullptr;
};

/// Of some nodes: sum of d, largest |d - common|^2.
struct MotionPart {
  double sum[3] = {0.0, 0.0, 0.0};
  double largest[2] = {0.0, 0.0};
};

/// @pre begin is a multiple of `block`
using MotionKernel = MotionPart (*)(const MotionArgs&, std::size_t begin, std::size_t end);

/// That of the active instruction set.
[[nodiscard]] MotionKernel motion_kernel();

}  // namespace abut::contact
