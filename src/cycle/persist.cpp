// What a checkpoint holds of a cycle. Not in it: what the model gives (topology, curves, stiffness of contact surfaces) and
// what every cycle computes anew (slots, contact sums, search lists).
#include <algorithm>
#include <stdexcept>

#include "cycle/cycle.hpp"

namespace abut::cycle {

namespace {

void persist_balance(state::Archive& a, state::Balance& b) {
  for (double* term : {&b.ie, &b.he, &b.ke, &b.ker, &b.ce, &b.fw, &b.dw, &b.cx, &b.extw, &b.xe, &b.initial, &b.largest, &b.err, &b.ledger,
                       &b.mass, &b.added_mass}) {
    a(*term);
  }
  a(b.momentum);
}

void persist_controller(state::Archive& a, StepController& controller) {
  auto kind = static_cast<std::int32_t>(controller.kind);
  a(kind);
  a(controller.id);
  if (kind < 0 || kind > static_cast<std::int32_t>(StepController::Kind::contact_node))
    throw state::ArchiveError("the checkpoint is damaged");
  controller.kind = static_cast<StepController::Kind>(kind);
}

void persist_result(state::Archive& a, InterfaceResult& r) {
  for (Vec3* v : {&r.normal_force, &r.tangential_force, &r.normal_impulse, &r.tangential_impulse}) a(*v);
  for (double* d : {&r.ce, &r.fw, &r.dw, &r.cx, &r.sw, &r.largest_penetration, &r.largest_approach, &r.peak_approach}) a(*d);
  a(r.facing);
  a(r.in_contact);
  a(r.deepest_node);
  if (a.loading()) r.crossed = r.lost = {};  // of the last step only
}

}  // namespace

void TimeStep::persist(state::Archive& a) {
  for (double* d : {&previous_step_, &largest_step_, &window_time_, &added_mass_}) a(*d);
  a.growing(added_);
  if (!added_.empty() && added_.size() != static_cast<std::size_t>(model_.node_count())) {
    throw state::ArchiveError("the checkpoint does not fit the model (added masses)");
  }
}

void Cycle::persist(state::Archive& a) {
  a.section("state", [&] { state_.persist(a); });
  a.section("elements", [&] {
    for (const std::unique_ptr<elements::Group>& g : groups_) {
      for (const std::span<double> array : g->history()) a.fixed(array);
    }
  });
  if (a.loading()) {
    const auto any_deleted = [](const std::unique_ptr<elements::Group>& g) {
      for (Index e = 0; e < g->size(); ++e) {
        if (!g->active(e)) return true;
      }
      return false;
    };
    if (std::any_of(groups_.begin(), groups_.end(), any_deleted)) erode();
  }
  a.section("contact", [&] {
    for (init::RunInterface& i : interfaces_) {
      std::vector<std::byte> history;
      if (!a.loading()) history = i.contact.history();
      a.growing(history);
      if (!a.loading()) continue;
      contact_known_ = false;
      try {
        i.contact.restore(history);
      } catch (const std::exception& error) { throw state::ArchiveError(error.what()); }
    }
  });
  a.section("limits", [&] {
    axes_.persist(a);
    bodies_.persist(a);
    loads_.persist(a);
    gravities_.persist(a);
    boundary_.persist(a);
    imposed_.persist(a);
    walls_.persist(a);
    sections_.persist(a);
    accelerometers_.persist(a);
  });
  if (a.loading()) bodies_revision_ = -1;  // the groups are told again which elements are rigid
  a.section("cycle", [&] {
    time_step_->persist(a);
    a.fixed_or_zero(std::span<double>(contact_stiffness_));  // shares the masses of rigid bodies among their nodes in the next cycle
    ledger_.persist(a);
    persist_balance(a, balance_);
    persist_controller(a, controller_);
    for (double* d : {&scaled_energy_, &removed_energy_, &booked_work_, &waiting_work_, &start_work_, &edited_work_, &worst_error_,
                      &worst_contact_error_}) {
      a(*d);
    }
    a(beyond_limit_);
    a.each(parts_, [&a](PartResult& p) {
      for (double* d : {&p.ie, &p.he, &p.sums.kinetic_energy, &p.sums.rotational_energy, &p.sums.mass}) a(*d);
      a(p.sums.momentum);
      a(p.eroded);
    });
    a(history_due_);
    contact_facing_.persist(a);
    contact_thickness_.persist(a, interfaces_);
    a.each(interface_results_, [&a](InterfaceResult& r) { persist_result(a, r); });
    for (std::vector<Vec3>* edited : {&edited_v_, &edited_w_}) {
      a.growing(*edited);
      if (!edited->empty() && edited->size() != state_.x.size()) throw state::ArchiveError("the checkpoint does not fit the model (edits)");
    }
  });
  a.section("outputs", [&] { persist_output_times(a); });
}

void Cycle::persist_output_times(state::Archive& a) {
  const model::Controls& c = model_.controls;
  double history_interval = c.history_interval, animation_start = c.animation_start, animation_interval = c.animation_interval;
  for (double* d : {&next_history_, &next_animation_, &history_interval, &animation_start, &animation_interval}) a(*d);
  if (!a.loading()) return;
  // A later run may ask for other intervals: they begin where it begins.
  if (history_interval != c.history_interval) next_history_ = state_.times.t;
  if (animation_start != c.animation_start || animation_interval != c.animation_interval) {
    next_animation_ = std::max(state_.times.t, c.animation_start);
  }
}

}  // namespace abut::cycle
