#include "cycle/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cycle/node_kernels.hpp"

namespace abut::cycle {

namespace {
constexpr std::size_t node_grain = 1024;  // nodes that make a loop worth a thread
}  // namespace

/// Adds the wall-clock time of a scope to a phase.
class Cycle::Timer {
 public:
  Timer(Cycle& cycle, Phase phase) : Timer(cycle.seconds_[phase]) {}
  explicit Timer(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~Timer() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

// The numbers are the steps of numerics.md 1.2.
void Cycle::advance(Sink& sink) {
  under_way_ = true;
  StepLimits limits;
  decide_outputs();
  switch_off_rigid_elements();
  axes_.update(state_);               //  1
  if (loaded_) loads_.apply(state_);  //  3
  forces(limits);                     //  2, 4 to 8
  assemble();                         //  10, 16
  {
    const Timer timer(*this, p_constraints);
    sections_.gather(state_, slots_);  // 11
    bodies_.gather(state_, boundary_);
    edited_work_ = take_over_edits();
    walls_.add_reaction(state_);                                          // 12
    const double scaled_now = time_step_->scale_masses(state_, bodies_);  // 13
    scaled_energy_ += scaled_now;
    ledger_.add(scaled_now);
    controller_ = time_step_->choose(state_, limits, contact_stiffness_, pool_);  // 14
    booked_work_ = loads_.book_work(state_);                                      // 15
    if (totals_wanted_) accelerate_again();                                       // 16
    bodies_.accelerate(state_, boundary_);
    gravities_.apply(state_);  // 17
    booked_work_ += gravities_.book_work(state_);
    if (caught_) caught_->before(state_);
    boundary_.apply(state_);  // 18
    if (caught_) caught_->after(state_);
    imposed_.apply(state_, boundary_);  // 20
    bodies_.hold(state_, boundary_, imposed_);
    booked_work_ += imposed_.book_work(state_);
    walls_.apply(state_);  // 21
    booked_work_ += walls_.work();
    if (held_again_) boundary_.apply(state_);  // 22
    bodies_.scatter(state_);                   // 23
    accelerometers_.record(state_);            // 24
    book_impulses();
    close_balance();  // 25
  }
  {
    const Timer timer(*this, p_output);  // 26
    const Snapshot now = snapshot_of_cycle();
    if (!std::exchange(begun_, true)) sink.begin(now);
    sink.cycle(now);
  }
  check_finite();
  integrate();  // 27, 28, 29
  under_way_ = false;
}

void Cycle::begin(Sink& sink) {
  if (!std::exchange(begun_, true)) sink.begin(snapshot());
}

void Cycle::decide_outputs() {
  const double t = state_.times.t;
  history_written_ = history_due_;
  const model::Controls& c = model_.controls;
  const bool after_end = t > c.t_end;  // a cycle for the animation; a row only where a run that goes on writes one too
  history_due_ = t >= (after_end ? next_history_ : std::min(c.t_end, next_history_));
  if (t >= next_history_) next_history_ = std::max(t, next_history_ + c.history_interval);
  animation_due_ = t >= next_animation_ || after_end;
  if (animation_due_) next_animation_ = std::max(t, next_animation_ + c.animation_interval);
  listing_due_ = c.print_every > 0 && state_.times.cycle % c.print_every == 0;
}

// Elements and contact read the same motion and write what is their own, unless contact is to know what the elements of this cycle become.
// Side by side a part of one that runs on one thread holds nobody up. What both take together is shared among their phases as they took it.
void Cycle::forces(StepLimits& limits) {
  const bool deletes = eroded_ || std::any_of(groups_.begin(), groups_.end(), [](const auto& g) { return g->may_delete(); });
  if (interfaces_.empty() || deletes || contact_thickness_.follows() || pool_.threads() == 1) {
    internal_forces(limits);
    contact_forces(limits);
    return;
  }
  const std::array<double, phase_count> before = seconds_;
  const std::array<double, 5> families_before = family_seconds_;
  double together = 0.0;
  {
    const Timer timer(together);
    pool_.both([&] { contact_forces(limits); }, [&] { internal_forces(limits); });
  }
  double alone = 0.0;
  for (const Phase p : {p_elements, p_search, p_contact}) alone += seconds_[p] - before[p];
  const double share = alone > 0.0 ? together / alone : 0.0;
  for (const Phase p : {p_elements, p_search, p_contact}) seconds_[p] = before[p] + share * (seconds_[p] - before[p]);
  for (std::size_t k = 0; k < family_seconds_.size(); ++k) {
    family_seconds_[k] = families_before[k] + share * (family_seconds_[k] - families_before[k]);
  }
}

void Cycle::internal_forces(StepLimits& limits) {
  const Timer timer(*this, p_elements);
  const elements::StepInput in{state_.x.data(), state_.v.data(), state_.w.data(), state_.times.t, state_.times.h_minus, history_due_};
  const elements::StepOutput out{sums_.data(), slots_.empty() ? nullptr : slots_.data()};
  for (PartResult& p : parts_) p = {0.0, 0.0, {}, p.eroded};
  removed_energy_ = 0.0;
  for (const std::unique_ptr<elements::Group>& g : groups_) {
    const Timer family(family_seconds_[static_cast<std::size_t>(g->kind())]);
    const elements::GroupResult r = g->step(in, out, pool_);
    if (r.bad_element != no_index) {
      throw RunError("element " + std::to_string(element_id(*g, r.bad_element)) + " of part " +
                     std::to_string(model_.parts[static_cast<std::size_t>(g->part())].id) +
                     " has a non-finite result or a negative volume at cycle " + std::to_string(state_.times.cycle));
    }
    PartResult& part = parts_[static_cast<std::size_t>(g->part())];
    part.ie += r.internal_energy;
    part.he += r.hourglass_energy;
    part.eroded += r.removed;
    removed_energy_ += r.removed_energy;
    if (r.removed > 0) eroded_ = true;
    check_minimum_step(*g, r);
    part.sums += r.part_sums;
    if (r.step < limits.element) {
      using Kind = StepController::Kind;
      static constexpr Kind kinds[] = {Kind::none, Kind::shell, Kind::sh3n, Kind::brick, Kind::tetra};
      limits.element = r.step;
      limits.element_controller = {kinds[static_cast<int>(g->kind())], element_id(*g, r.step_element)};
    }
  }
}

void Cycle::contact_forces(StepLimits& limits) {
  if (eroded_) erode();
  contact_thickness_.update(state_.times.cycle, groups_, interfaces_);
  record_contacts();
  const state::StepTimes& t = state_.times;
  contact_mobility_.update(state_, boundary_, imposed_, bodies_, contact_stiffness_);
  const contact::HostState host{
      state_.x, state_.v, state_.mass, t.t, t.h_minus, t.h_bar_old, contact_mobility_.constrained(), contact_mobility_.mobility()};
  {
    const Timer timer(*this, p_search);
    for (init::RunInterface& i : interfaces_) i.contact.search(host);
  }
  const Timer timer(*this, p_contact);
  if (interfaces_.empty()) return;
  if (contact_known_) {
    for (const init::RunInterface& i : interfaces_) i.contact.clear(state_.f_contact, contact_stiffness_);
  } else {
    std::fill(state_.f_contact.begin(), state_.f_contact.end(), Vec3{});
    std::fill(contact_stiffness_.begin(), contact_stiffness_.end(), 0.0);
    contact_known_ = true;
  }
  for (init::RunInterface& i : interfaces_) {
    const contact::StepResult r = i.contact.evaluate(host, state_.f_contact, contact_stiffness_);
    InterfaceResult& out = interface_results_[static_cast<std::size_t>(i.model_index)];
    out.normal_force = r.normal_force;
    out.tangential_force = r.tangential_force;
    out.ce = r.elastic;
    out.fw = r.friction_work;
    out.dw = r.damping_work;
    out.sw = r.start_work;
    out.cx = r.made;
    out.in_contact = r.in_contact;
    out.largest_penetration = r.largest_penetration;
    out.deepest_node = r.deepest_node;
    out.largest_approach = r.largest_approach;
    out.peak_approach = std::max(history_written_ ? 0.0 : out.peak_approach, r.largest_approach);
    out.crossed = i.contact.nodes_crossed();
    out.lost = i.contact.nodes_lost();
    if (r.kinematic_step < limits.interface_step) {
      limits.interface_step = r.kinematic_step;
      limits.interface_controller = {StepController::Kind::interface, model_.interfaces[static_cast<std::size_t>(i.model_index)].id};
    }
  }
  contact_facing_.look(state_, interface_results_);
  if (releases_) release_boundary_conditions();
}

void Cycle::assemble() {
  const Timer timer(*this, p_assembly);
  static_assert(elements::Assembly::Entries::padding >= AssembleArgs::ahead);
  const auto entries = [](const elements::Assembly::Entries& e) { return e.at.empty() ? nullptr : e.first.data(); };
  const auto vectors = [](state::ZeroArray<Vec3>& a, bool wanted) { return wanted ? &a.data()->x : nullptr; };
  const bool contact = !interfaces_.empty();
  AssembleArgs args;
  args.sums = sums_.data();
  args.shell_first = entries(assembly_.shells());
  args.shell_at = assembly_.shells().at.data();
  args.solid_first = entries(assembly_.solids());
  args.solid_at = assembly_.solids().at.data();
  args.f_external = vectors(state_.f_external, loaded_);
  args.m_external = vectors(state_.m_external, loaded_);
  args.f_contact = vectors(state_.f_contact, contact);
  args.contact_stiffness = contact_stiffness_.data();
  args.mass = state_.mass.data();
  args.inertia = state_.inertia.data();
  args.f_internal = vectors(state_.f_internal, true);
  args.a = vectors(state_.a, true);
  args.stiffness = state_.stiffness.data();
  args.m_internal = vectors(state_.m_internal, rotations_);
  args.alpha = vectors(state_.alpha, rotations_);
  args.rotational_stiffness = state_.rotational_stiffness.data();
  args.f = vectors(state_.f, totals_wanted_);
  args.m = vectors(state_.m, totals_wanted_ && rotations_);
  pool_.for_ranges(state_.mass.size(), node_grain,
                   [&args](std::size_t begin, std::size_t end) { node_kernels().assemble(args, begin, end); });
}

void Cycle::accelerate_again() {
  pool_.for_ranges(state_.mass.size(), node_grain, [this](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      state_.a[i] = state_.mass[i] > 0.0 ? state_.f[i] / state_.mass[i] : Vec3{};
      if (rotations_) state_.alpha[i] = state_.inertia[i] > 0.0 ? state_.m[i] / state_.inertia[i] : Vec3{};
    }
  });
}

void Cycle::integrate() {
  const Timer timer(*this, p_integrate);
  state::StepTimes& t = state_.times;
  const double h_bar = t.h_bar;
  const double h = t.h_plus;
  MotionArgs args;
  args.v = &state_.v.data()->x;
  args.a = &state_.a.data()->x;
  args.w = rotations_ ? &state_.w.data()->x : nullptr;
  args.alpha = &state_.alpha.data()->x;
  args.x = &state_.x.data()->x;
  args.u = &state_.u.data()->x;
  args.h_bar = h_bar;
  args.h_plus = h;
  pool_.for_ranges(state_.mass.size(), node_grain,
                   [&args](std::size_t begin, std::size_t end) { node_kernels().integrate(args, begin, end); });
  for (init::RunInterface& i : interfaces_) i.contact.commit(h);
  t.t += h;
  t.h_minus = h;
  t.h_bar_old = h_bar;
  ++t.cycle;
}

}  // namespace abut::cycle
