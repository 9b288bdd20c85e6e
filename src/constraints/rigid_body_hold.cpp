// Rigid bodies that are held or moved at a point beside their centre of gravity.
//
// Unknown: force P and moment L at the main node, on the span of the directions that are held or moved. With the centre's velocity v, the
// spin w and r from the centre to the main node,
//   M dv/dt = F + P,  J dw/dt = T - w x J w + L + r x P,  v' + (R(h_+ w') r - r)/h_+ and w' as the conditions and motions say,
// primes at n + 1/2. P acts with the lever of t^n while the point is on its place at t^(n+1): the constraint of [Ryckaert 1977], which does
// not drift and makes no energy on the average. Newton's iteration with the matrix of small angles, whose error falls by the angle per step
// in each pass. Rows are made orthonormal in the body's response, which solves that matrix and leaves out what is said twice.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "constraints/body_tensor.hpp"
#include "constraints/imposed_motions.hpp"
#include "constraints/rigid_bodies.hpp"
#include "constraints/rotation.hpp"

namespace abut::constraints {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double said_twice = 1e-12;  ///< share of a row that must be new
constexpr double exact = 1e-15;       ///< of the speeds that meet in a row
constexpr int largest_count = 60;     ///< of passes; at a tenth of a radian per step some ten

}  // namespace

void RigidBodies::add_row(HeldRows& rows, const Body& body, const Vec3& force, const Vec3& moment, double wanted) const {
  if (rows.count == 6 || !(body.inertia.mass > 0.0)) return;
  HeldRow row{force, moment, {}, {}, wanted};
  const auto respond = [&] {
    row.v = row.force / body.inertia.mass;
    row.w = times_inverse(body.inertia, row.moment + cross(rows.arm, row.force));
    return row.value(row.v + cross(row.w, rows.arm), row.w);
  };
  const double alone = respond();
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < rows.count; ++k) {
      const HeldRow& other = rows.row[static_cast<std::size_t>(k)];
      const double shared = other.value(row.v + cross(row.w, rows.arm), row.w);
      row.force -= shared * other.force;
      row.moment -= shared * other.moment;
      row.wanted -= shared * other.wanted;
      (void)respond();
    }
  }
  const double left = respond();
  if (!(left > said_twice * alone)) return;
  const double scale = 1.0 / std::sqrt(left);
  for (Vec3* part : {&row.force, &row.moment, &row.v, &row.w}) *part *= scale;
  row.wanted *= scale;
  rows.row[static_cast<std::size_t>(rows.count++)] = row;
}

void RigidBodies::hold(state::State& state, const BoundaryConditions& conditions, const ImposedMotions& motions) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (!body.on || !body.beside) continue;
    const Index node = model_->rigid_bodies[i].main;
    body.held.arm = state.x[at(node)] - body.centre;
    const BoundaryConditions::Held translation = conditions.held(node, false), rotation = conditions.held(node, true);
    for (int k = 0; k < translation.count; ++k) add_row(body.held, body, translation.axis[static_cast<std::size_t>(k)], {}, 0.0);
    for (int k = 0; k < rotation.count; ++k) add_row(body.held, body, {}, rotation.axis[static_cast<std::size_t>(k)], 0.0);
    motions.for_each_wanted(node, [&](bool turns, const Vec3& axis, double wanted) {
      add_row(body.held, body, turns ? Vec3{} : axis, turns ? axis : Vec3{}, wanted);
    });
    satisfy(i, state);
  }
}

void RigidBodies::satisfy(std::size_t index, state::State& state) {
  Body& body = bodies_[index];
  if (!body.beside || body.held.count == 0) return;
  const std::size_t main = at(model_->rigid_bodies[index].main);
  const double h = state.times.h_plus, hb = state.times.h_bar;
  const Vec3 arm = body.held.arm, free_torque = torque(index, state);
  for (int pass = 0; pass < largest_count; ++pass) {
    const Vec3 w = state.w[main] + hb * state.alpha[main], centre_v = state.v[main] + hb * state.a[main];
    if (squared_norm(h * w) > 1.0) return;  // scatter() will refuse it
    const Vec3 turning = chord(arm, h * w) / h, point_v = centre_v + turning;
    Vec3 force{}, moment{};
    bool done = true;
    for (int k = 0; k < body.held.count; ++k) {
      const HeldRow& row = body.held.row[static_cast<std::size_t>(k)];
      const double left = row.wanted - row.value(point_v, w);
      const double speeds = norm(row.force) * (norm(centre_v) + norm(turning)) + norm(row.moment) * norm(w) + std::fabs(row.wanted);
      done = done && std::fabs(left) <= exact * speeds;
      force += left / hb * row.force;
      moment += left / hb * row.moment;
    }
    if (done) return;
    body.held_force += force;
    body.held_moment += moment;
    state.a[main] += force / body.inertia.mass;
    const Vec3 others = state.alpha[main] - body.euler_alpha;  // what walls have added
    body.euler_alpha = angular_acceleration(body, free_torque + body.held_moment + cross(arm, body.held_force), state.w[main], hb,
                                            BoundaryConditions::Held{});
    state.alpha[main] = body.euler_alpha + others;
  }
}

double RigidBodies::hold_work(const state::State& state) {
  const double hb = state.times.h_bar;
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    if (!body.on || !body.beside) continue;
    const std::size_t main = at(model_->rigid_bodies[i].main);
    first += dot(body.held_force, state.v[main]) + dot(body.held_moment, state.w[main]);
    second += dot(body.held_force, state.v[main] + hb * state.a[main]) + dot(body.held_moment, state.w[main] + hb * state.alpha[main]);
  }
  const double booked = 0.5 * hb * first + hold_second_half_;
  hold_second_half_ = 0.5 * hb * second;
  return booked;
}

}  // namespace abut::constraints
