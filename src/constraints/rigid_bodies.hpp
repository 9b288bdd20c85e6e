// /RBODY: nodes that move with one main node (numerics.md 6.2; energy: 1.6.2).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "abut/contact/mobility.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"
#include "constraints/axes.hpp"
#include "constraints/boundary_conditions.hpp"
#include "core/profile.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::constraints {

/// Sums of one body: force and moment about the main node of the secondary nodes (without the main node's own), this cycle
/// and integrated over time; rotation: integral of the main node's angular velocity.
struct BodySums {
  Vec3 force_impulse, moment_impulse, force, moment, rotation;
};

class ImposedMotions;

/// What nodal sums (1/2 m v^2, ...) over all nodes need to become those of the structure, because the mass of secondary nodes
/// also sits in the main node: add these.
struct EnergyCorrection {
  double translation = 0.0, rotation = 0.0, mass = 0.0;
  Vec3 momentum;
};

/// Standard profile: a main node that stays where it is beside the centre of gravity (ICoG 3, or switched on by a sensor) is one more
/// point of the body. Momentum, inertia and Euler's equations are those of the centre of gravity; from accelerate() to scatter() the
/// main node's entries of v and a hold the centre's velocity and acceleration, so that gravity and walls act on the centre. Boundary
/// conditions and imposed motions of such a node act at the point where it is: hold(). A main node with a moving wall carries the body's
/// mass itself, as in the reference profile.
class RigidBodies {
 public:
  explicit RigidBodies(const model::Model& model, const Profile& profile = {});

  /// Masses, inertia, centre of gravity: moves the main node in x, gives it the body's mass and smallest principal inertia,
  /// gives secondary nodes the rigid motion of the main node (numerics.md 6.2.1). After masses and initial velocities.
  /// Bodies with a sensor that has not fired, or that are switched off, are left alone until they are switched on (by the sensor, or
  /// by /RBODY/ON of a later run).
  void initialise(state::State& state);

  /// Body (index in the model) of which the node is a secondary node of an active body; no_index: none.
  [[nodiscard]] Index body_of(Index node) const { return body_of_.empty() ? no_index : body_of_[static_cast<std::size_t>(node)]; }
  /// Body of which the node is the main node, of an active body; no_index: none.
  [[nodiscard]] Index main_of(Index node) const { return main_of_.empty() ? no_index : main_of_[static_cast<std::size_t>(node)]; }
  /// True when all nodes belong to one active body (main node included): the element is switched off.
  [[nodiscard]] bool contains(std::span<const Index> nodes) const;
  /// Changes whenever a body is switched on or off: the cycle then asks contains() again.
  [[nodiscard]] int revision() const { return revision_; }

  /// Step 11: f, m, stiffness and rotational stiffness of secondary nodes go to the main node; their own stiffness is reset to
  /// zero (they do not control the step; 1e-20 in the reference profile), their f is kept for output. In the standard profile the main
  /// node's two stiffnesses are then its mass and inertia times the square of the body's largest frequency (body_frequency.hpp). Turns the
  /// principal axes by w h_- first. Reference profile: sets the main node's moment to inertia times the angular acceleration of Euler's
  /// equations, so that alpha = m / inertia holds for it too.
  void gather(state::State& state, const BoundaryConditions& conditions);
  void book_impulses(double h);  ///< of this cycle's forces and moments, once its step is known

  /// After step 16, standard profile: angular acceleration of the main nodes by Euler's equations, over the step that is now
  /// chosen. Rotational boundary conditions of the main node reduce the system to the free directions.
  void accelerate(state::State& state, const BoundaryConditions& conditions);

  /// Step 13, mass scaling of a main node: the body gains mass where its main node is ...
  void add_mass(Index body, double mass) { bodies_[static_cast<std::size_t>(body)].inertia.mass += mass; }
  /// ... and brings the velocity of the centre of gravity.
  [[nodiscard]] Vec3 centre_velocity(Index body, const state::State& state) const;
  /// ... and its tensor, with the main node's inertia, grows by a factor.
  /// @return kinetic energy that this brings at the main node's angular velocity
  double scale_inertia(Index body, double factor, state::State& state);

  /// Step 20, standard profile: true for the main node of an active body that is the centre of its mass; turn() imposes its rotations.
  [[nodiscard]] bool turns(Index node) const { return conserving_ && main_of(node) != no_index && !holds(node); }
  /// Euler's equations with the angular acceleration `given` along the held directions. Leaves the main node with what it has without the
  /// moment that this takes. @return that moment
  Vec3 turn(Index node, state::State& state, const BoundaryConditions::Held& held, const Vec3& given);
  /// J^-1 b
  [[nodiscard]] Vec3 times_inverse_inertia(Index body, const Vec3& b) const;

  /// Step 20, after the conditions and motions of other nodes: bodies whose main node is beside the centre get the forces and moments at
  /// that node which give it the velocity n + 1/2 of its conditions (none) and imposed motions, on the chord of the body's rotation. Its
  /// place does not drift. scatter() does so again, for what walls have changed.
  void hold(state::State& state, const BoundaryConditions& conditions, const ImposedMotions& motions);
  /// True for the main node of an active body that is beside the centre: its conditions and motions are those of hold().
  [[nodiscard]] bool holds(Index node) const {
    const Index body = main_of(node);
    return body != no_index && bodies_[static_cast<std::size_t>(body)].beside;
  }
  /// Step 25, after scatter: discrete work of the forces of hold(). Once per cycle.
  double hold_work(const state::State& state);

  /// Step 23: accelerations of secondary nodes such that they move rigidly with the main node in this step.
  /// @throws RunError when a body turns by more than one radian in a step
  void scatter(state::State& state);

  /// Step 25: corrections of kinetic energies, mass and momentum at t^n, v^n = v + h_- a / 2 (numerics.md 1.6.2).
  [[nodiscard]] EnergyCorrection energy_correction(const state::State& state) const;

  /// Step 25, after scatter: correction of ledger_kinetic_energy() (work_meter.hpp).
  [[nodiscard]] double ledger_correction(const state::State& state) const;
  /// Step 25, after scatter: energy that the numerics of the bodies made or lost up to t^n: change of their T* less the discrete
  /// work credited to their nodes by forces and meters. Of second order in the angle per step (nodes move on chords, axes turn
  /// between cycles), plus the energy of impact of a body that a sensor switches on. Once per cycle.
  double ledger_work(const state::State& state);

  /// Step 25, before ledger_work, of the external work: the impacts of bodies switched on or off in this cycle, with what the energies of
  /// elements and contact lack of the work up to them (StopWork).
  [[nodiscard]] double switch_work(const state::State& state) const;

  void persist(state::Archive& a);

  [[nodiscard]] std::span<const BodySums> results() const { return sums_; }  ///< per model rigid body
  /// Mass, principal inertias and axes of an active body.
  struct Inertia {
    double mass = 0.0;
    std::array<double, 3> principal{};
    Frame axes{};
  };
  [[nodiscard]] const Inertia& inertia(Index body) const { return bodies_[static_cast<std::size_t>(body)].inertia; }
  /// Velocity of an active body's main node relative to the centre of gravity at n - 1/2; zero where the node is the centre.
  [[nodiscard]] const Vec3& relative_velocity(Index body) const { return bodies_[static_cast<std::size_t>(body)].relative; }
  /// Step 25: velocity n - 1/2 and acceleration of the mass that the node carries: its own, or those of its body's centre of gravity.
  struct Motion {
    Vec3 v, a;
  };
  [[nodiscard]] Motion carried_motion(Index node, const state::State& state) const;
  /// J b, J the body's inertia tensor at t^n.
  [[nodiscard]] Vec3 times_inertia(Index body, const Vec3& b) const;

  /// What carries a node `point`: itself, or the main node of its body; with the directions in which that cannot yield.
  struct Carrier {
    Index point = no_index, node = no_index, body = no_index;
    BoundaryConditions::Held translation, rotation;
  };
  /// Velocity gained by the point from an impulse on it: answer(), or of a node without a body.
  [[nodiscard]] Vec3 response(const state::State& state, const Carrier& carrier, const Vec3& impulse) const;
  /// Steps 18 to 23: velocity v^(n+1/2) of the point by the accelerations of its carrier.
  [[nodiscard]] Vec3 next_velocity(const state::State& state, const Carrier& carrier) const;
  /// Steps 18 to 23: accelerations of the carrier that an impulse on the point adds over h_bar.
  void push(state::State& state, const Carrier& carrier, const Vec3& impulse) const;

  /// A component of the motion of a held point, f.v + m.w of its velocity and spin, and what the impulse f and the angular impulse m on it
  /// give: velocity of the centre and spin. Rows of one body are orthonormal: f_i, m_i give row k the value 1 for i = k, else 0.
  struct HeldRow {
    Vec3 force, moment, v, w;
    double wanted = 0.0;  ///< value at n + 1/2
    [[nodiscard]] double value(const Vec3& point_v, const Vec3& spin) const { return dot(force, point_v) + dot(moment, spin); }
  };
  struct HeldRows {
    std::array<HeldRow, 6> row;
    int count = 0;
    Vec3 arm;  ///< of the held point from the centre
  };

  /// Answer of an active body, its main node held in the given directions, to an impulse j at x: velocity T j of the main node (1/M where
  /// it is free), angular velocity R (r x j) with r = x - centre (J^-1 where it is free). Where the main node is beside the centre, T and R
  /// are those of the free body, and the impulses that hold the rows come in addition.
  struct Answer {
    contact::Mobility translation;
    std::array<Vec3, 3> rotation{};  ///< columns of R
    Vec3 centre;
    HeldRows held;
    struct Motion {
      Vec3 v, w;  ///< of the centre; spin
    };
    [[nodiscard]] Motion motion(const Vec3& from, const Vec3& impulse) const {
      const Vec3 moment = cross(from - centre, impulse);
      Motion m{translation * impulse, moment.x * rotation[0] + moment.y * rotation[1] + moment.z * rotation[2]};
      const Vec3 point_v = m.v + cross(m.w, held.arm), spin = m.w;
      for (int k = 0; k < held.count; ++k) {
        const HeldRow& row = held.row[static_cast<std::size_t>(k)];
        const double value = row.value(point_v, spin);
        m.v -= value * row.v;
        m.w -= value * row.w;
      }
      return m;
    }
    /// Velocity that the point of the body at `to` gains from an impulse at `from`, to first order in the angle per step.
    [[nodiscard]] Vec3 velocity(const Vec3& to, const Vec3& from, const Vec3& impulse) const {
      const Motion m = motion(from, impulse);
      return m.v + cross(m.w, to - centre);
    }
  };
  [[nodiscard]] Answer answer(const state::State& state, Index body, const BoundaryConditions::Held& translation,
                              const BoundaryConditions::Held& rotation) const;

 private:
  struct Body {
    bool on = false;
    bool beside = false;           ///< the main node is beside the centre of gravity; else the next seven are not used
    Vec3 centre;                   ///< of gravity, t^n
    Vec3 relative;                 ///< velocity of the main node less the centre's, n - 1/2
    Vec3 centre_v, centre_a;       ///< of the cycle, from scatter() on
    HeldRows held;                 ///< of the cycle, from hold() on
    Vec3 held_force, held_moment;  ///< at the main node, this cycle
    Inertia inertia;
    Vec3 axis_spin;                            ///< of the main node's initial velocity, when that is one about an axis; else 0
    double own_mass = 0.0, own_inertia = 0.0;  ///< of the main node alone
    Vec3 own_moment;                           ///< moment on the main node alone, this cycle
    Vec3 entry_w;                              ///< angular velocity of the main node at gather
    Vec3 euler_alpha;                          ///< angular acceleration of Euler's equations, this cycle
    double rotation_before = 0.0;              ///< rotational T* of the previous cycle plus its second halves, or 1/2 w.Jw when switched on
    double switch_work = 0.0;                  ///< kinetic energy gained (negative: lost) when the body was switched on or off
    double switch_power = 0.0;                 ///< structure_power gained when it was switched on
  };
  void follow_sensors(state::State& state);
  void switch_on(std::size_t index, state::State& state, bool at_start);
  void take_axis_spins();
  void switch_off(std::size_t index, state::State& state);
  void compute_inertia(std::size_t index, state::State& state, int icog, bool card_values);
  void claim(std::size_t index, bool on);
  void turn_axes(Inertia& inertia, const Vec3& angle) const;
  [[nodiscard]] const Vec3& centre_of(Index body, const state::State& state) const {
    const Body& b = bodies_[static_cast<std::size_t>(body)];
    return b.beside ? b.centre : state.x[static_cast<std::size_t>(model_->rigid_bodies[static_cast<std::size_t>(body)].main)];
  }
  /// Adds a row, less its part in the rows before; one that says nothing new is left out.
  void add_row(HeldRows& rows, const Body& body, const Vec3& force, const Vec3& moment, double wanted) const;
  /// The rows' values: adds to held_force and held_moment, and to the main node's accelerations.
  void satisfy(std::size_t index, state::State& state);
  [[nodiscard]] Vec3 torque(std::size_t index, const state::State& state) const;
  /// @param given  its part along the held directions
  [[nodiscard]] Vec3 angular_acceleration(const Body& body, const Vec3& torque, const Vec3& w, double h_bar,
                                          const BoundaryConditions::Held& held, const Vec3& given = {}) const;
  /// Kinetic energy of the body's nodes as free nodes, or as a body, from the half-step velocities.
  [[nodiscard]] double free_energy(std::size_t index, const state::State& state) const;
  [[nodiscard]] double rigid_energy(std::size_t index, const state::State& state) const;
  /// Power of elements and contact on the body's nodes.
  [[nodiscard]] double structure_power(std::size_t index, const state::State& state) const;

  const model::Model* model_;
  bool conserving_;
  std::vector<Body> bodies_;
  std::vector<BodySums> sums_;
  std::vector<Index> body_of_, main_of_;  // #N; empty: the model has no bodies
  std::vector<bool> bound_;               ///< per body: the main node has a moving wall
  double hold_second_half_ = 0.0;
  int revision_ = 0;
};

}  // namespace abut::constraints
