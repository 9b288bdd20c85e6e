// Energies, impulses, outputs and checks of a cycle.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "cycle/contact_area.hpp"
#include "cycle/cycle.hpp"

namespace abut::cycle {

namespace {

/// Share of the largest energy term that may be made or lost before a run is stopped as wrong, when the deck sets none.
constexpr double default_error_limit = 0.5;
/// Cycles in a row that must be beyond it: at the start from rest all terms are tiny and their ratio says little. The limit of /STOP acts
/// at once.
constexpr int patience = 100;

class Fnv {
 public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ULL + (word >> 29); }
  void add(double d) { add(std::bit_cast<std::uint64_t>(d)); }
  void add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  /// By words, the last one filled with zeros.
  void add(std::span<const std::byte> bytes) {
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// Energy that rounding of the positions makes: of nodes that move by some units of their last place against the stiffness of all around.
/// Less says nothing about a balance.
double rounding_energy(const state::State& s) {
  constexpr double units = 32.0 * std::numeric_limits<double>::epsilon();
  double sum = 0.0;
  for (std::size_t i = 0; i < s.x.size(); ++i) sum += s.stiffness[i] * squared_norm(s.x[i]);
  return 0.5 * units * units * sum;
}

}  // namespace

void Cycle::erode() {
  // Activity of every element by kind and model index.
  std::array<std::vector<std::uint8_t>, 5> alive;
  alive[1].assign(model_.shells.id.size(), 1);
  alive[2].assign(model_.sh3ns.id.size(), 1);
  alive[3].assign(model_.bricks.id.size(), 1);
  alive[4].assign(model_.tetras.id.size(), 1);
  for (const std::unique_ptr<elements::Group>& g : groups_) {
    for (Index e = 0; e < g->size(); ++e) {
      alive[static_cast<std::size_t>(g->kind())][static_cast<std::size_t>(g->elements()[static_cast<std::size_t>(e)])] =
          g->active(e) ? 1 : 0;
    }
  }
  const auto is_alive = [&alive](const model::ElementRef& e) {
    return alive[static_cast<std::size_t>(e.kind)][static_cast<std::size_t>(e.index)] != 0;
  };
  init::update_erosion(model_, interfaces_, is_alive);
  if (!model_.pressure_loads.empty()) {
    if (!face_owners_) face_owners_.emplace(model_);
    loads_.erode([this](const std::array<Index, 4>& nodes) { return face_owners_->of(nodes); }, is_alive);
  }
  eroded_ = false;
}

void Cycle::release_boundary_conditions() {
  if (!options_.profile.reference_contact) boundary_.restore_all();  // the reference never gives a condition back
  for (const init::RunInterface& i : interfaces_) {
    const auto& ibc = model_.interfaces[static_cast<std::size_t>(i.model_index)].ibc;
    if (!ibc[0] && !ibc[1] && !ibc[2]) continue;
    for (const Index node : i.contact.nodes_in_contact()) {
      for (int k = 0; k < 3; ++k) {
        if (ibc[static_cast<std::size_t>(k)]) boundary_.release(node, k);
      }
    }
  }
}

void Cycle::book_impulses() {
  const state::StepTimes& t = state_.times;
  const bool kick = options_.profile.impulses == Profile::Impulses::kick;
  bodies_.book_impulses(kick ? t.h_bar : t.h_minus);
  sections_.book_impulses(kick ? t.h_bar : t.h_minus);
  // The reference counts those of interfaces with the half-step sum of the cycle before (numerics.md 7.4.2).
  const double h = kick ? t.h_bar : t.h_bar_old;
  for (InterfaceResult& r : interface_results_) {
    r.normal_impulse += h * r.normal_force;
    r.tangential_impulse += h * r.tangential_force;
  }
}

void Cycle::close_balance() {
  state::Balance& b = balance_;
  const bool product_form = options_.profile.kinetic_energy == Profile::KineticEnergy::leapfrog;
  const KineticSums kinetic = ledger_.sum(state_, product_form, pool_);
  const double jumps = boundary_.jump_work() + walls_.jump_work(), switched = bodies_.switch_work(state_);
  const double external = (loaded_ ? loads_.ledger_work(state_) : 0.0) + gravities_.ledger_work(state_) + boundary_.ledger_work(state_) +
                          imposed_.ledger_work(state_) + bodies_.hold_work(state_) + walls_.ledger_work(state_) + edited_work_;
  const bool discrete = options_.profile.external_work == Profile::ExternalWork::discrete;
  if (!discrete) {
    b.extw += booked_work_ + edited_work_;
  } else if (state_.times.cycle == 0) {
    // The kinetic energy of cycle 0 is that of v(0) after jumps, before the kick: the first halves of its works wait for the second ones.
    b.extw += jumps;
    waiting_work_ = external - jumps;
  } else {
    const double caught = caught_ ? caught_->settle(state_) : 0.0;
    b.extw += external + waiting_work_ + switched + (stops_ ? stops_->settle(state_) : walls_.stop_work(state_) + caught);
    waiting_work_ = 0.0;
  }
  const double constraint_work = external + bodies_.ledger_work(state_);
  const double t_star = kinetic.leapfrog + bodies_.ledger_correction(state_);
  const double ledger = ledger_.close(t_star, constraint_work);
  const constraints::EnergyCorrection body = bodies_.energy_correction(state_);
  b.ker = kinetic.rotation + body.rotation;
  // T* of the ledger knows how rigid bodies move between half-steps; in cycle 0 it is one-sided (translation and rotation are not).
  b.ke = product_form && state_.times.cycle > 0 ? t_star - b.ker : kinetic.translation + body.translation;
  b.momentum = kinetic.momentum + body.momentum + walls_.momentum_correction();
  b.mass = kinetic.mass + body.mass;
  b.added_mass = time_step_->added_mass();
  b.ie = b.he = b.ce = b.fw = b.dw = b.cx = 0.0;
  const double started_before = start_work_;
  start_work_ = 0.0;
  for (const InterfaceResult& r : interface_results_) start_work_ += r.sw;
  b.extw += start_work_ - started_before;
  for (const PartResult& p : parts_) {
    b.ie += p.ie;
    b.he += p.he;
  }
  for (const InterfaceResult& r : interface_results_) {
    b.ce += r.ce;
    b.fw += r.fw;
    b.dw += r.dw;
    b.cx += r.cx;
  }
  b.xe = removed_energy_ - scaled_energy_;
  const double sum = b.ie + b.he + b.ke + b.ker + b.ce + b.fw + b.dw + b.xe - b.extw;
  if (state_.times.cycle == 0) {
    b.initial = sum;
    b.largest = rounding_energy(state_);
  }
  // What an imposed jump brings within a step and takes back in the next one shows nowhere but in the rounding of the works.
  constexpr double rounding_of_works = 1024.0 * std::numeric_limits<double>::epsilon();
  b.largest = std::max(b.largest, rounding_of_works * imposed_.half_step_energy(state_));
  for (const double term : {b.ie, b.he, b.ke, b.ker, b.ce, b.fw, b.dw, b.extw, b.initial}) b.largest = std::max(b.largest, std::abs(term));
  b.err = b.largest > 0.0 ? (sum - b.initial) / b.largest : 0.0;
  b.ledger = b.largest > 0.0 ? ledger / b.largest : 0.0;
  worst_error_ = std::max(worst_error_, std::abs(b.err));
  if (b.largest > 0.0) worst_contact_error_ = std::max(worst_contact_error_, std::abs(b.cx) / b.largest);
}

void Cycle::check_finite() {
  const double sum = balance_.ie + balance_.he + balance_.ke + balance_.ker + balance_.extw + balance_.ce;
  const std::string when = fmt::format(" at cycle {}, time {:.6g}", state_.times.cycle, state_.times.t);
  if (!std::isfinite(sum)) {
    for (std::size_t i = 0; i < state_.mass.size(); ++i) {
      const Vec3 v = state_.v[i] + state_.a[i];
      const Vec3 w = state_.w[i] + state_.alpha[i];
      if (std::isfinite(v.x + v.y + v.z + w.x + w.y + w.z)) continue;
      throw RunError(fmt::format("node {} is the first with a motion that is not finite{}", model_.node_id[i], when));
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (std::isfinite(parts_[p].ie + parts_[p].he)) continue;
      throw RunError(fmt::format("the energy of part {} is not finite{}", model_.parts[p].id, when));
    }
    throw RunError(fmt::format("{} is not finite{}",
                               std::isfinite(balance_.ce) ? "the kinetic energy or the external work" : "the contact energy", when));
  }
  const model::Controls& stop = model_.controls;
  if (stop.stop_total_mass > 0.0 && balance_.added_mass > stop.stop_total_mass * (balance_.mass - balance_.added_mass)) {
    throw RunError(fmt::format("mass scaling has added {:.4g}, {:.4g} times the mass of the model: beyond the limit of {:.4g} of /STOP{}",
                               balance_.added_mass, balance_.added_mass / (balance_.mass - balance_.added_mass), stop.stop_total_mass,
                               when));
  }
  if (const Index node = time_step_->first_beyond(stop.stop_nodal_mass, state_); node != no_index) {
    throw RunError(fmt::format("mass scaling has added more to node {} than {:.4g} times its mass, the nodal limit of /STOP{}",
                               model_.node_id[static_cast<std::size_t>(node)], stop.stop_nodal_mass, when));
  }
  const bool asked = stop.stop_energy_error > 0.0;
  const double limit = asked ? stop.stop_energy_error : default_error_limit;
  const double error = asked && stop.stop_positive_only ? balance_.err : std::abs(balance_.err);
  beyond_limit_ = error > limit ? beyond_limit_ + 1 : 0;
  if (beyond_limit_ < (asked ? 1 : patience)) return;
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < state_.mass.size(); ++i) {
    if (squared_norm(state_.v[i]) > squared_norm(state_.v[fastest])) fastest = i;
  }
  throw RunError(
      fmt::format("the energy error of {:.4g} % of the largest term is beyond the limit of {:.4g} %{}{}; the fastest node is {} "
                  "(speed {:.4g})",
                  100.0 * balance_.err, 100.0 * limit, asked ? " of /STOP" : "", when, model_.node_id[fastest], norm(state_.v[fastest])));
}

void Cycle::check_minimum_step(const elements::Group& group, const elements::GroupResult& result) const {
  const model::Controls& c = model_.controls;
  const model::StepControl* control = &c.brick;
  if (group.kind() == model::ElementKind::shell4) control = &c.shell;
  if (group.kind() == model::ElementKind::shell3) control = &c.sh3n;
  if (group.kind() == model::ElementKind::tetra) control = &c.tetra;
  if (control->action != model::StepControl::Action::stop || result.step > control->minimum) return;
  throw RunError(
      fmt::format("the time step of element {} of part {} fell to {:.4g}, below the minimum {:.4g} of /DT, at cycle {}, time {:.6g}",
                  element_id(group, result.step_element), model_.parts[static_cast<std::size_t>(group.part())].id, result.step,
                  control->minimum, state_.times.cycle, state_.times.t));
}

void Cycle::fill_contact_fields() {
  const std::size_t n = state_.mass.size();
  contact_normal_ = state::ZeroArray<Vec3>(n);
  contact_tangential_ = state::ZeroArray<Vec3>(n);
  contact_area_ = state::ZeroArray<double>(n);
  contact_state_.assign(n, {});
  for (const init::RunInterface& i : interfaces_) {
    i.contact.add_nodal_forces(contact_normal_, contact_tangential_);
    i.contact.add_nodal_contact(contact_state_);
  }
  ContactArea(model_, interfaces_).write(state_.x, interfaces_, contact_area_);  // of use in few cycles
}

void Cycle::fill_option_forces() {
  if (model_.rigid_bodies.empty() && model_.rigid_walls.empty() && model_.sections.empty()) return;
  option_force_.assign(state_.mass.size(), {});
  option_moment_.assign(state_.mass.size(), {});
  for (std::size_t i = 0; i < model_.rigid_bodies.size(); ++i) {
    const auto main = static_cast<std::size_t>(model_.rigid_bodies[i].main);
    option_force_[main] += bodies_.results()[i].force;
    option_moment_[main] += bodies_.results()[i].moment;
  }
  walls_.add_forces(option_force_);
  for (std::size_t i = 0; i < model_.sections.size(); ++i) {
    const Index node = model_.sections[i].frame_nodes[0];
    if (node == no_index) continue;
    option_force_[static_cast<std::size_t>(node)] += sections_.results()[i].normal_force + sections_.results()[i].tangential_force;
    option_moment_[static_cast<std::size_t>(node)] += sections_.global_moment(static_cast<Index>(i));
  }
}

Snapshot Cycle::view() {
  fill_contact_fields();
  fill_option_forces();
  return snapshot();
}

Snapshot Cycle::snapshot_of_cycle() {
  if (animation_due_) {
    fill_contact_fields();
    fill_option_forces();
  } else if (!contact_normal_.empty()) {  // as large as half the state, and of use in few cycles
    const auto release = [](auto&... values) { (std::remove_reference_t<decltype(values)>().swap(values), ...); };  // = {} keeps the memory
    release(contact_normal_, contact_tangential_, contact_area_, contact_state_, option_force_, option_moment_);
  }
  Snapshot s = snapshot();
  s.history_due = history_due_;
  s.animation_due = animation_due_;
  s.listing_due = listing_due_;
  s.hash_due = options_.hash_every > 0 && state_.times.cycle % options_.hash_every == 0;
  if (s.hash_due) s.state_hash = hash();
  return s;
}

Snapshot Cycle::snapshot() const {
  Snapshot s;
  s.model = &model_;
  s.state = &state_;
  s.balance = &balance_;
  s.groups = groups_;
  s.parts = parts_;
  s.interfaces = interface_results_;
  s.contact_normal = contact_normal_;
  s.contact_tangential = contact_tangential_;
  s.contact_area = contact_area_;
  s.contact_state = contact_state_;
  s.option_force = option_force_;
  s.option_moment = option_moment_;
  s.added_mass = time_step_->added_masses();
  s.nodal_scale = time_step_->nodal_scale();
  s.walls = walls_.results();
  s.bodies = bodies_.results();
  s.sections = sections_.results();
  s.accelerometers = accelerometers_.results();
  s.controller = controller_;
  return s;
}

std::uint64_t Cycle::hash() {
  Fnv h;
  h.add(state_.times.t);
  h.add(state_.times.h_minus);
  for (std::size_t i = 0; i < state_.mass.size(); ++i) {
    h.add(state_.x[i]);
    h.add(state_.v[i]);
    h.add(state_.w[i]);
    h.add(state_.mass[i]);
  }
  for (const std::unique_ptr<elements::Group>& g : groups_) {
    for (const std::span<double> array : g->history()) {
      for (const double d : array) h.add(d);
    }
  }
  for (const init::RunInterface& i : interfaces_) { h.add(i.contact.history()); }
  return h.value();
}

}  // namespace abut::cycle
