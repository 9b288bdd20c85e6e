// The two rule sets of one code: named choices, handed to whoever needs them; no global switch, no branches by name.
#pragma once

#include <string_view>

namespace abut {

/// Every choice on which `standard` (theory and good numerics) and `reference` (the reference program's rule, so that
/// decks can be compared; docs/guide/profiles.md lists each with its reason) differ.
struct Profile {
  /// Element steps: a bound of the element's exact largest eigenvalue, or the reference program's length over speed.
  enum class ElementStep { bound, reference };
  /// Step of the assembled system: nodal sum of element and contact stiffness, or the smallest element step
  /// (contact of TYPE3/5 left out).
  enum class SystemStep { nodal, reference };
  /// Rotational hourglass viscosity of the one-point shell: dimensionally homogeneous, or the reference's constants.
  enum class RotationalHourglass { homogeneous, reference };
  /// Quadratic hourglass viscosity of the one-point brick: on the size of a mode's rate, which does not know the axes; or on each
  /// component of its own, which does.
  enum class HourglassViscosity { objective, components };
  /// Bricks of Isolid 1: all four hourglass modes leave out linear fields, or only the first three: the fourth then brakes rotations.
  enum class HourglassModes { orthogonal, three };
  /// Energy increment of hourglass forces: trapezoidal, or with the end-of-step force.
  enum class HourglassEnergy { trapezoidal, end_of_step };
  /// Internal energy of bricks of small strain: the work of their forces, on the volume of cycle 0; or on the mean volume of the step.
  enum class SmallStrainEnergy { work, mean_volume };
  /// Stretch that a finite rotation over one step leaves in shells of Ishell 1 and 2: removed, or the reference's correction,
  /// which is twice as large.
  enum class ShellRotation { exact, reference };
  /// Strain increment of a step (elements of large strain; shells: of the membrane; quadrilaterals: all rates): that of the motion at
  /// mid-step, turned to the axes at its end, to second order; or from the geometry at its end, without what a rotation in the step adds
  /// but where the reference takes it out.
  enum class StrainIncrement { midpoint, reference };
  /// Warped shells: hourglass rates leave out what a rigid rotation makes, rates and forces see the same, the nodes' rotations, or v_z
  /// where there are none (N = 1); or Ishell 3 and 4 have rates that see v_z and forces on the rotations, if there are any, and 1 and 2 are
  /// flat.
  enum class WarpedShell { balanced, reference };
  /// Stress that turns with the spin of its element (Iframe 1, TETRA4): by a rotation, which keeps its size, and the stress that a step
  /// finds does its work turned to the axes at the end; or to first order, and its work in the axes it was found in.
  enum class StressRotation { finite, first_order };
  /// Solid sound speed: sqrt((B + 4/3 G)/rho), or with the literal 1.333.
  enum class SolidSoundSpeed { exact, literal };
  /// Rigid bodies: exact rotation of secondary nodes, gyroscopic moment at mid-step (keeps energy and angular momentum),
  /// boundary conditions of secondary nodes without any effect; or rotation to second order, gyroscopic moment at n - 1/2
  /// and half-step velocities of secondary nodes that their boundary conditions set to zero.
  enum class RigidBody { conserving, reference };
  /// Spin of TETRA4: the skew part of the velocity gradient, or with the reference's symmetric second-order terms.
  enum class TetraSpin { exact, reference };
  /// Moving rigid walls: node and wall exchange momentum in the cycle of impact (plastic impact, momentum conserved); or the
  /// reaction acts one cycle later on the mass of wall and impacted nodes together.
  enum class MovingWall { same_cycle, reference };
  /// Friction filter of rigid walls by a frequency f (ifq 3): weight of the new force min(1, 2 pi f h), no filter in steps that are too
  /// long for it; or 2 pi f h, which amplifies there.
  enum class WallFilter { bounded, reference };

  /// Mass, momentum and kinetic energy of parts: of all their elements that are not deleted, with the masses and inertias that their nodes
  /// got from them; or with equal masses at an element's nodes, and without the elements that lie in a rigid body.
  enum class PartSums { nodal, reference };

  /// Kinetic energy of the balance: the leap-frog form m v(n-1/2).v(n+1/2)/2, whose sum with the potential of a linear
  /// structure is constant to rounding, or m |v(n)|^2/2 with v(n) = v(n-1/2) + h-/2 a(n), which oscillates by h^2 m a^2/8.
  enum class KineticEnergy { leapfrog, midpoint };
  /// External work: the exact discrete work of loads and constraints, or as the reference program books it.
  enum class ExternalWork { discrete, booked };
  /// Time integrals of the forces on interfaces, rigid bodies and sections: times the step of the kick that the force gives, so that they
  /// are the momentum that it gave; or times the step before the force (interfaces: the kick before).
  enum class Impulses { kick, step_before };

  ElementStep element_step = ElementStep::bound;
  SystemStep system_step = SystemStep::nodal;
  KineticEnergy kinetic_energy = KineticEnergy::leapfrog;
  ExternalWork external_work = ExternalWork::discrete;
  RotationalHourglass rotational_hourglass = RotationalHourglass::homogeneous;
  HourglassViscosity hourglass_viscosity = HourglassViscosity::objective;
  HourglassModes hourglass_modes = HourglassModes::orthogonal;
  HourglassEnergy hourglass_energy = HourglassEnergy::trapezoidal;
  SmallStrainEnergy small_strain_energy = SmallStrainEnergy::work;
  ShellRotation shell_rotation = ShellRotation::exact;
  StrainIncrement strain_increment = StrainIncrement::midpoint;
  WarpedShell warped_shell = WarpedShell::balanced;
  StressRotation stress_rotation = StressRotation::finite;
  SolidSoundSpeed solid_sound_speed = SolidSoundSpeed::exact;
  RigidBody rigid_body = RigidBody::conserving;
  TetraSpin tetra_spin = TetraSpin::exact;
  MovingWall moving_wall = MovingWall::same_cycle;
  WallFilter wall_filter = WallFilter::bounded;
  PartSums part_sums = PartSums::nodal;
  Impulses impulses = Impulses::kick;
  /// Contact rules are chosen in contact::Rules (a library of its own); this says which set the run asks for.
  bool reference_contact = false;

  [[nodiscard]] static constexpr Profile standard() { return {}; }
  [[nodiscard]] static constexpr Profile reference() {
    Profile p;
    p.element_step = ElementStep::reference;
    p.system_step = SystemStep::reference;
    p.kinetic_energy = KineticEnergy::midpoint;
    p.external_work = ExternalWork::booked;
    p.rotational_hourglass = RotationalHourglass::reference;
    p.hourglass_viscosity = HourglassViscosity::components;
    p.hourglass_modes = HourglassModes::three;
    p.hourglass_energy = HourglassEnergy::end_of_step;
    p.small_strain_energy = SmallStrainEnergy::mean_volume;
    p.shell_rotation = ShellRotation::reference;
    p.strain_increment = StrainIncrement::reference;
    p.warped_shell = WarpedShell::reference;
    p.stress_rotation = StressRotation::first_order;
    p.solid_sound_speed = SolidSoundSpeed::literal;
    p.rigid_body = RigidBody::reference;
    p.tetra_spin = TetraSpin::reference;
    p.moving_wall = MovingWall::reference;
    p.wall_filter = WallFilter::reference;
    p.part_sums = PartSums::reference;
    p.impulses = Impulses::step_before;
    p.reference_contact = true;
    return p;
  }
};

}  // namespace abut
