// The passes of a cycle over all nodes, built per instruction set: assembly with accelerations, limit of the step, sums of the
// balance, integration.
//
// Vectors are #N by 3 doubles. Four nodes are twelve doubles, three registers of four; sums keep four accumulators (twelve for the
// momentum), which are added in a fixed order at the end, so that the register width does not show in the bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace abut::cycle {

/// Chunk sums of every node (elements/assembly.hpp) -> forces, accelerations, stiffness (numerics.md 1.2 steps 10 and 16).
struct AssembleArgs {
  static constexpr std::uint32_t ahead = 24;  ///< entries behind the end of shell_at and solid_at that may be looked at
  const double* sums = nullptr;
  const std::uint32_t *shell_first = nullptr, *shell_at = nullptr;  ///< #N + 1 and where each node's sums begin; null: no such elements
  const std::uint32_t *solid_first = nullptr, *solid_at = nullptr;
  const double *f_external = nullptr, *m_external = nullptr;        ///< null: no loads
  const double *f_contact = nullptr, *contact_stiffness = nullptr;  ///< null: no interfaces
  const double *mass = nullptr, *inertia = nullptr;
  double *f_internal = nullptr, *a = nullptr, *stiffness = nullptr;
  double *m_internal = nullptr, *alpha = nullptr, *rotational_stiffness = nullptr;  ///< null: nothing rotates
  double *f = nullptr, *m = nullptr;                                                ///< totals; null: nobody reads them
};

struct MotionArgs {
  const double *f_internal = nullptr, *f_contact = nullptr, *m_internal = nullptr;  ///< f_contact null: no interfaces
  const double *mass = nullptr, *inertia = nullptr;
  const double *a = nullptr, *alpha = nullptr;
  double *v = nullptr, *w = nullptr;  ///< w null: nothing rotates
  double *x = nullptr, *u = nullptr;
  double half = 0.0;   ///< h_-/2
  double h_bar = 0.0;  ///< (h_- + h_+)/2
  double h_plus = 0.0;
};

/// Sums over some nodes. v = v(n-1/2), v' = v + h_bar a, v(n) = v + h_-/2 a; g = contact minus internal force; likewise w, alpha, J, -m.
struct KineticLeaf {
  double star = 0.0, square = 0.0;                    ///< m v.v', m v(n).v(n)
  double rotation_star = 0.0, rotation_square = 0.0;  ///< J w.w', J w(n).w(n)
  double power_before = 0.0, power_after = 0.0;       ///< g.v, g.v'
  double rotation_power_before = 0.0, rotation_power_after = 0.0;
  double mass = 0.0;
  double momentum[3] = {0.0, 0.0, 0.0};  ///< m v(n)
};

struct LimitArgs {
  const double *mass = nullptr, *stiffness = nullptr;
  const double *inertia = nullptr, *rotational_stiffness = nullptr;          ///< null: rotations do not count
  const std::uint8_t *free_translation = nullptr, *free_rotation = nullptr;  ///< 0: the node is held and does not count; null: all count
};

/// Smallest h^2 = 2 m/K (2 J/Kr) of some nodes (numerics.md 2.2), and the first node that has it, translation before rotation.
struct LimitLeaf {
  double square = 1e30;
  std::int64_t node = -1;
  bool rotation = false;
};

struct NodeKernels {
  void (*assemble)(const AssembleArgs&, std::size_t begin, std::size_t end);
  void (*limit)(const LimitArgs&, std::size_t begin, std::size_t end, LimitLeaf&);
  void (*sum)(const MotionArgs&, std::size_t begin, std::size_t end, KineticLeaf&);
  void (*integrate)(const MotionArgs&, std::size_t begin, std::size_t end);
};

/// Those of the active instruction set.
[[nodiscard]] const NodeKernels& node_kernels();

}  // namespace abut::cycle
