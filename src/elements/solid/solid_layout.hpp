// What the kernels of one-point solids (brick, tetra) share with the groups that own their data: plain structs only, because
// the kernels are built per instruction set and include no standard library.
#pragma once

#include <cstddef>
#include <cstdint>

#include "elements/nodes_ahead.hpp"
#include "materials/solid_law.hpp"

namespace abut::elements {

/// State of a block: `Field` f of lane l is state[(block * fields + f) * 8 + l]. Optional fields follow `common_fields`.
enum SolidField : int {
  f_sxx,
  f_syy,
  f_szz,
  f_sxy,
  f_syz,
  f_szx,             ///< stress deviator (in the element frame when co-rotational)
  f_pressure,        ///< p of the law
  f_viscosity,       ///< q, bulk viscous pressure
  f_volume,          ///< V at the last step; the frozen volume in small strain
  f_inverse_length,  ///< V^(-1/3)
  f_density,         ///< rho at the last step in small strain; else m_e/V counts
  f_energy,          ///< internal energy
  f_hourglass,       ///< hourglass energy
  f_off,             ///< 1 active, 0 deleted
  f_live,            ///< 1 takes part in the step, 0 deleted, rigid or padding
  f_mass,            ///< m_e
  f_inverse_mass,    ///< 1/m_e
  common_fields
};

inline constexpr int frame_fields = 9;             ///< e1, e2, e3 of co-rotational bricks, for output
inline constexpr int hourglass_force_fields = 12;  ///< old generalised hourglass forces (trapezoidal energy)

/// Choices and constants of a group.
struct SolidConfig {
  int law = 1;
  double rho_0 = 0.0, bulk = 0.0, shear = 0.0, sound = 0.0, p_min = -1e20;
  materials::JohnsonCook plastic;
  double qa_squared = 0.0, qb = 0.0, hourglass = 0.0;
  bool corotational = false;         ///< Iframe 2 (bricks)
  bool orthogonal_hourglass = true;  ///< Isolid 1
  bool orthogonal_fourth = true;     ///< Profile::HourglassModes, of Isolid 1
  bool small_strain = false;         ///< Ismstr 1
  bool reference_step = false;
  bool trapezoidal_hourglass = true;
  bool small_strain_work = true;    ///< internal energy on the frozen volume, as the forces are
  bool objective_hourglass = true;  ///< quadratic viscosity on the size of a mode's rate, not on its components
  bool midpoint_strain = true;      ///< Profile::StrainIncrement; not with small strain
  bool finite_rotation = true;      ///< Profile::StressRotation
  bool literal_spin = false;        ///< TETRA4: spin with the reference's second-order terms
  double step_scale = 0.9, step_minimum = 0.0;
  double viscous_rate = 1.0;  ///< group.hpp
  bool remove_small_step = false;
  bool step_wanted = true;                                                                 ///< GroupInput
  int fields = common_fields;                                                              ///< per block
  int law_field = 0, force_field = 0, frozen_field = 0, frame_field = 0, share_field = 0;  ///< first optional field of each kind
};

/// Fixed-order result of a chunk of blocks.
struct SolidChunk {
  double energy = 0.0, hourglass = 0.0, removed_energy = 0.0;
  double inverse_step = 0.0;  ///< largest 1/dt_e of the live elements
  std::int32_t step_element = -1, bad_element = -1, removed = 0;
};

/// Arguments of a kernel: steps blocks [first, last).
struct SolidTask {
  const SolidConfig* config = nullptr;
  const double* x = nullptr;              ///< #N by 3 positions at t^n
  const double* v = nullptr;              ///< #N by 3 velocities at n - 1/2
  const std::int32_t* offsets = nullptr;  ///< 3 * node at (block * nodes_per_element + k) * 8 + l
  double* state = nullptr;
  double* slots = nullptr;         ///< of block 0; layout of SlotLayout, 4 components
  std::ptrdiff_t slot_stride = 0;  ///< from block to block; 0: every block uses the same
  const std::uint16_t* positions = nullptr;
  double* sums = nullptr;  ///< of the chunk (chunks.hpp), or null
  double dt = 0.0;
  std::int32_t first = 0, last = 0;
  NodesAhead ahead;  ///< of the next chunk
  SolidChunk* chunk = nullptr;
};

using SolidKernel = void (*)(const SolidTask&);

}  // namespace abut::elements
