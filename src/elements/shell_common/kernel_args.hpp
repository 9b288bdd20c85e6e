// What a shell kernel works on: raw pointers only, so that objects built per instruction set need no standard header.
#pragma once

#include <cstddef>
#include <cstdint>

#include "elements/nodes_ahead.hpp"
#include "elements/shell_common/section.hpp"
#include "simd/gather.hpp"
#include "simd/pack.hpp"

namespace abut::elements {

/// Constants of one element (8 doubles each in a block) that never change after set-up.
namespace shell_constant {
enum : int {
  regular = 0,            ///< 0: nodes 3 and 4 of a quad coincide; else 1
  active,                 ///< 0: rigid or padding; else 1
  inertia,                ///< rotational inertia over mass, the same for every node of the element
  mass,                   ///< mass share of a node: one for all four of a quadrilateral, three for a triangle
  quad_count = mass + 1,  ///< constants of a quadrilateral
  triangle_count = mass + 3
};
}

/// What the blocks of a chunk add up to, lane by lane.
struct ShellBook {
  alignas(64) double internal[shell_lanes] = {};
  alignas(64) double hourglass[shell_lanes] = {};
  alignas(64) double removed[shell_lanes] = {};                                             ///< energies of elements without activity
  alignas(64) double on[shell_lanes] = {};                                                  ///< elements with activity
  alignas(64) double step[shell_lanes] = {1e30, 1e30, 1e30, 1e30, 1e30, 1e30, 1e30, 1e30};  ///< least step, and
  alignas(64) double block[shell_lanes] = {};                                               ///< the first block that has it
};

struct ShellKernelArgs {
  const double* x = nullptr;  ///< #N by 3
  const double* v = nullptr;
  const double* w = nullptr;
  double h = 0.0;  ///< length of the step that ends now
  const ShellSection* section = nullptr;
  double* state = nullptr;                   ///< #B by variables by 8
  const std::int32_t* nodes = nullptr;       ///< #B by nodes per element by 8; each 3 times the node's index
  const double* constants = nullptr;         ///< #B by quad_count or triangle_count by 8
  double* slots = nullptr;                   ///< of block 0; group.hpp, SlotLayout
  std::size_t slot_stride = 0;               ///< from block to block; 0: every block uses the same
  double* steps = nullptr;                   ///< of block 0, 8 each: element step, 1e30 for elements that are off
  std::size_t step_stride = 0;               ///< from block to block; 0: every block uses the same
  const std::uint16_t* positions = nullptr;  ///< of block 0 (chunks.hpp)
  double* sums = nullptr;                    ///< of the chunk that the blocks belong to; null: slots only
  NodesAhead ahead;                          ///< of the next chunk
  ShellBook* book = nullptr;                 ///< of that chunk; null: none
};

template <class T>
struct Vec {
  T x, y, z;
};
template <class T>
ABUT_INLINE Vec<T> operator+(Vec<T> a, Vec<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
ABUT_INLINE Vec<T> operator-(Vec<T> a, Vec<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
ABUT_INLINE Vec<T> operator*(T s, Vec<T> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
ABUT_INLINE T dot(Vec<T> a, Vec<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
ABUT_INLINE Vec<T> cross(Vec<T> a, Vec<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Vector of node `nodes[lane]` for each lane.
template <class T>
ABUT_INLINE Vec<T> gather(T type, const double* base, const std::int32_t* nodes) {
  const simd::Triple<T> a = simd::gather3(base, nodes, type);
  return {a.x, a.y, a.z};
}

}  // namespace abut::elements
