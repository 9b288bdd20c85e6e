// Velocities that a caller changes between two cycles.
//
// v(n-1/2) has already moved the nodes to x(n), and elements and contact of cycle n still measure that motion with it. So a change
// takes effect after they have, as a jump of the half-step velocity like those of boundary conditions and walls, and books
// what a jump books (constraints/work_meter.hpp): sum 1/2 m (|v|^2 - |V|^2), exact for the ledger, and in the balance what the energies of
// elements and contact lack of the work up to the jump (StopWork).
#include <cstddef>
#include <numeric>

#include "cycle/cycle.hpp"

namespace abut::cycle {

std::span<Vec3> Cycle::edit_velocities() {
  if (edited_v_.empty()) edited_v_.assign(state_.v.begin(), state_.v.end());
  return edited_v_;
}

std::span<Vec3> Cycle::edit_angular_velocities() {
  if (edited_w_.empty()) edited_w_.assign(state_.w.begin(), state_.w.end());
  return edited_w_;
}

double Cycle::take_over_edits() {
  double work = 0.0;
  stops_.reset();
  if ((!edited_v_.empty() || !edited_w_.empty()) && state_.times.cycle > 0) {
    std::vector<Index> all(state_.v.size());
    std::iota(all.begin(), all.end(), Index{0});
    stops_.emplace(std::move(all)).before(state_);
  }
  const auto own = [this](std::size_t i) { return bodies_.body_of(static_cast<Index>(i)) == no_index; };  // not moved by a body
  for (std::size_t i = 0; i < edited_v_.size(); ++i) {
    if (!own(i)) continue;
    const Index body = bodies_.main_of(static_cast<Index>(i));
    const Vec3 relative = body == no_index ? Vec3{} : bodies_.relative_velocity(body);  // of a main node beside the centre of its mass
    work += 0.5 * state_.mass[i] * dot(edited_v_[i] - state_.v[i], edited_v_[i] + state_.v[i] - 2.0 * relative);
    state_.v[i] = edited_v_[i];
  }
  for (std::size_t i = 0; rotations_ && i < edited_w_.size(); ++i) {
    if (!own(i)) continue;
    const Vec3 jump = edited_w_[i] - state_.w[i];
    const Index body = bodies_.main_of(static_cast<Index>(i));
    const Vec3 spin = body == no_index ? state_.inertia[i] * jump : bodies_.times_inertia(body, jump);
    work += 0.5 * dot(spin, edited_w_[i] + state_.w[i]);
    state_.w[i] = edited_w_[i];
  }
  edited_v_.clear();
  edited_w_.clear();
  if (state_.times.cycle > 0) return work;
  ledger_.raise_start(work);  // before the first cycle: an initial velocity
  return 0.0;
}

}  // namespace abut::cycle
