#include "elements/solid/solid_group.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "core/diagnostic.hpp"
#include "simd/math.hpp"

namespace abut::elements {

namespace {

[[noreturn]] void refuse(const std::string& code, const std::string& keyword, const std::string& field, const std::string& message) {
  Diagnostics d;
  Place place;
  place.keyword = keyword;
  place.field = field;
  d.error(code, place, message);
  throw InputError(d);
}

/// Constants of the material; sound speed as the profile says (numerics.md 0.4).
void set_material(SolidConfig& c, const model::Material& material, const model::Units& units, const Profile& profile) {
  double young = 0.0, poisson = 0.0;
  const std::string keyword = "/MAT/" + std::to_string(material.id);
  if (const auto* elastic = std::get_if<model::LawElastic>(&material.law)) {
    young = elastic->young;
    poisson = elastic->poisson;
    c.law = 1;
  } else if (const auto* jc = std::get_if<model::LawJohnsonCook>(&material.law)) {
    young = jc->young;
    poisson = jc->poisson;
    c.law = 2;
    c.p_min = jc->p_min;
    if (jc->kinematic != 0.0) {
      refuse("elements.solid_kinematic_hardening", keyword, "C_hard",
             "kinematic hardening is available for shells only; set C_hard to 0 for solids");
    }
    materials::JohnsonCook& p = c.plastic;
    p.a = jc->a;
    p.b = jc->b;
    p.n = jc->n;
    p.eps_max = jc->eps_max;
    p.sigma_max = jc->sigma_max;
    p.c = jc->c;
    p.eps_rate_0 = jc->eps_rate_0;
    p.cap_scaled = jc->icc == 2 ? 0 : 1;
    p.rate_measure = jc->vp;
    // The plastic rate is always filtered with 10 kHz (5.2.3); work time units are units.time seconds.
    p.filter = 2.0 * std::numbers::pi * (jc->vp == 1 ? 1e4 * units.time : jc->cutoff);
    p.m = jc->m;
    p.t_melt = jc->t_melt;
    p.rho_cp = jc->rho_cp;
    p.t_max = jc->t_max;
    p.t_ref = std::min(jc->t_ref, jc->t_max);
  } else {
    refuse("elements.solid_law", keyword, "", "this law has no solid stress update; LAW0 parts form inert groups");
  }
  c.rho_0 = material.reference_density > 0.0 ? material.reference_density : material.density;
  c.shear = 0.5 * young / (1.0 + poisson);
  c.bulk = young / (3.0 * (1.0 - 2.0 * poisson));
  const double third = profile.solid_sound_speed == Profile::SolidSoundSpeed::literal ? 1.333 : 4.0 / 3.0;
  c.sound = std::sqrt((c.bulk + third * c.shear) / c.rho_0);
}

}  // namespace

SolidGroup::SolidGroup(const GroupInput& in, int nodes_per_element, SolidKernel kernel)
    : nodes_per_element_(nodes_per_element), kernel_(kernel) {
  part_ = in.part;
  elements_ = in.elements;
  const model::Model& m = *in.model;
  const model::Part& part = m.parts[static_cast<std::size_t>(in.part)];
  const model::Material& material = m.materials[static_cast<std::size_t>(part.material)];
  const model::Property& property = m.properties[static_cast<std::size_t>(part.property)];
  const std::string keyword = "/PROP/" + std::to_string(property.id);
  const auto* solid = std::get_if<model::SolidProperty>(&property.data);
  if (solid == nullptr) refuse("elements.solid_property", keyword, "", "solid elements need a /PROP/SOLID");
  if (solid->ismstr != 1 && solid->ismstr != 2 && solid->ismstr != 4) {
    refuse("elements.solid_ismstr", keyword, "Ismstr", "use 1 (small strain), 2 or 4 (full geometric nonlinearity)");
  }
  set_material(config_, material, m.units, in.profile);
  density_ = material.density;
  config_.qa_squared = solid->qa * solid->qa;
  config_.qb = solid->qb;
  config_.hourglass = solid->h;
  config_.small_strain = solid->ismstr == 1;
  config_.reference_step = in.profile.element_step == Profile::ElementStep::reference;
  config_.small_strain_work = in.profile.small_strain_energy == Profile::SmallStrainEnergy::work;
  config_.objective_hourglass = in.profile.hourglass_viscosity == Profile::HourglassViscosity::objective;
  config_.orthogonal_fourth = in.profile.hourglass_modes == Profile::HourglassModes::orthogonal;
  config_.trapezoidal_hourglass = in.profile.hourglass_energy == Profile::HourglassEnergy::trapezoidal;
  config_.midpoint_strain = !config_.small_strain && in.profile.strain_increment == Profile::StrainIncrement::midpoint;
  config_.finite_rotation = in.profile.stress_rotation == Profile::StressRotation::finite;
  config_.literal_spin = in.profile.tetra_spin == Profile::TetraSpin::reference;
  reference_part_mass_ = config_.small_strain && config_.reference_step;
  nodal_part_sums_ = in.profile.part_sums == Profile::PartSums::nodal;
  config_.step_scale = in.step_scale;
  config_.viscous_rate = viscous_rate(in.system_scale);
  config_.step_wanted = in.step_wanted;
  config_.step_minimum = in.step_minimum;
  config_.remove_small_step = in.step_action == model::StepControl::Action::remove;
}

double& SolidGroup::at(Index element, int field) {
  const auto e = static_cast<std::size_t>(element);
  return state_[((e / lanes) * static_cast<std::size_t>(config_.fields) + static_cast<std::size_t>(field)) * lanes + e % lanes];
}

double SolidGroup::at(Index element, int field) const {
  const auto e = static_cast<std::size_t>(element);
  return state_[((e / lanes) * static_cast<std::size_t>(config_.fields) + static_cast<std::size_t>(field)) * lanes + e % lanes];
}

void SolidGroup::set_up(const std::vector<Vec3>& x, std::span<const Index> element_nodes, int frozen_fields, int share_fields) {
  SolidConfig& c = config_;
  c.fields = common_fields;
  const auto reserve_fields = [&c](bool wanted, int count, int& first) {
    first = c.fields;
    if (wanted) c.fields += count;
  };
  reserve_fields(c.law == 2, materials::johnson_cook_fields, c.law_field);
  reserve_fields(c.trapezoidal_hourglass && share_fields == 0, hourglass_force_fields, c.force_field);
  reserve_fields(c.corotational, frame_fields, c.frame_field);
  reserve_fields(c.small_strain, frozen_fields, c.frozen_field);
  reserve_fields(share_fields > 0, share_fields, c.share_field);

  const Index count = size();
  layout_.nodes_per_element = nodes_per_element_;
  layout_.components = 4;
  layout_.blocks = (count + lanes - 1) / lanes;
  const auto padded = static_cast<std::size_t>(layout_.blocks) * lanes;
  const auto n = static_cast<std::size_t>(nodes_per_element_);
  block_offsets_.assign(padded * n, 0);
  state_.assign(padded * static_cast<std::size_t>(c.fields), 0.0);
  chunks_ = ChunkTable(element_nodes, nodes_per_element_, layout_.components);
  results_.resize(static_cast<std::size_t>(chunks_.size()));

  std::vector<Vec3> corners(n);
  const auto point = materials::initial_state(c.plastic);
  for (std::size_t slot = 0; slot < padded; ++slot) {
    // Padding repeats the last element, switched off, so that its arithmetic stays harmless.
    const std::size_t e = std::min(slot, static_cast<std::size_t>(count) - 1);
    for (std::size_t k = 0; k < n; ++k) {
      const Index node = element_nodes[e * n + k];
      corners[k] = x[static_cast<std::size_t>(node)];
      block_offsets_[((slot / lanes) * n + k) * lanes + slot % lanes] = 3 * node;
    }
    const SolidGeometry g = geometry(corners);
    const auto id = static_cast<Index>(slot);
    const double volume = g.volume > 0.0 ? g.volume : 1e-30;
    const double mass = density_ * volume;
    at(id, f_volume) = volume;
    at(id, f_inverse_length) = simd::inverse_cube_root(volume);
    at(id, f_density) = density_;
    at(id, f_pressure) = std::max(c.p_min, c.bulk * (density_ / c.rho_0 - 1.0));
    at(id, f_mass) = mass;
    at(id, f_inverse_mass) = 1.0 / mass;
    const double on = slot < static_cast<std::size_t>(count) ? 1.0 : 0.0;
    at(id, f_off) = on;
    at(id, f_live) = on;
    if (c.law == 2) {
      const double values[] = {point.strain, point.yield, point.slope, point.rate, point.temperature};
      for (int i = 0; i < materials::johnson_cook_fields; ++i) at(id, c.law_field + i) = values[i];
    }
    if (c.small_strain) {
      for (int i = 0; i < frozen_fields; ++i) at(id, c.frozen_field + i) = g.frozen[static_cast<std::size_t>(i)];
    }
    if (share_fields > 0) {
      for (int i = 0; i < nodes_per_element_; ++i) {
        const double share = g.mass_share[static_cast<std::size_t>(i)];
        at(id, c.share_field + i) = share;
        at(id, c.share_field + nodes_per_element_ + i) = 1.0 / share;
      }
    }
  }
}

ElementNodes SolidGroup::nodes(Index element) const {
  const auto e = static_cast<std::size_t>(element), n = static_cast<std::size_t>(nodes_per_element_);
  ElementNodes nodes;
  for (std::size_t k = 0; k < n; ++k) nodes.push_back(block_offsets_[((e / lanes) * n + k) * lanes + e % lanes] / 3);
  return nodes;
}

double SolidGroup::mass_share(Index element, int corner) const {
  return nodes_per_element_ == 4 ? at(element, config_.share_field + corner) : 0.125;
}

void SolidGroup::add_masses(std::span<double> mass, std::span<double> /*inertia*/) const {
  for (Index e = 0; e < size(); ++e) {
    const ElementNodes mine = nodes(e);
    for (int k = 0; k < nodes_per_element_; ++k) {
      mass[static_cast<std::size_t>(mine[static_cast<std::size_t>(k)])] += mass_share(e, k) * at(e, f_mass);
    }
  }
}

GroupResult SolidGroup::step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) {
  SolidTask base;
  base.config = &config_;
  base.x = &in.x->x;
  base.v = &in.v->x;
  base.offsets = block_offsets_.data();
  base.state = state_.data();
  base.dt = in.dt;
  base.positions = chunks_.positions();
  const bool sums_now = in.part_sums && !reference_part_mass_;  // else with the densities that the step leaves
  if (sums_now) share_masses();
  pool.for_ranges(results_.size(), 1, [&](std::size_t begin, std::size_t end) {
    alignas(64) double scratch[8 * 4 * lanes];  // slots of one block, when nobody asks for them all
    SolidTask task = base;
    task.slots = out.slots != nullptr ? out.slots + layout_.offset : scratch;
    task.slot_stride = out.slots != nullptr ? nodes_per_element_ * 4 * lanes : 0;
    for (std::size_t i = begin; i < end; ++i) {
      task.first = static_cast<std::int32_t>(chunks_.first_block(i));
      task.last = static_cast<std::int32_t>(chunks_.end_block(i));
      task.chunk = &results_[i];
      task.ahead = chunks_.ahead_of(i);
      if (out.sums != nullptr) {
        task.sums = out.sums + chunks_.sum_offset(i);
        std::fill_n(task.sums, chunks_.nodes(i).size() * 4, 0.0);
      }
      kernel_(task);
      if (sums_now) shares_.sum(chunks_, i, in.v, nullptr);  // while its nodes are in the caches
    }
  });

  GroupResult result;
  double inverse_step = 0.0;
  for (const SolidChunk& chunk : results_) {
    result.internal_energy += chunk.energy;
    result.hourglass_energy += chunk.hourglass;
    result.removed_energy += chunk.removed_energy;
    result.removed += chunk.removed;
    if (chunk.removed > 0) shares_.valid = false;
    if (chunk.inverse_step > inverse_step) {
      inverse_step = chunk.inverse_step;
      result.step_element = chunk.step_element;
    }
    if (result.bad_element == no_index) result.bad_element = chunk.bad_element;
  }
  if (inverse_step > 0.0) result.step = config_.step_scale / inverse_step;
  if (in.part_sums) result.part_sums = sums_now && shares_.valid ? shares_.total() : part_sums(in.v, nullptr, &pool);
  return result;
}

void SolidGroup::set_rigid(std::span<const std::uint8_t> rigid) {
  shares_.valid = false;
  for (Index e = 0; e < size(); ++e) at(e, f_live) = rigid[static_cast<std::size_t>(e)] != 0 ? 0.0 : at(e, f_off);
}

ElementOutput SolidGroup::output(Index element) const {
  ElementOutput out;
  out.off = at(element, f_off);
  out.internal_energy = at(element, f_energy);
  out.hourglass_energy = at(element, f_hourglass);
  out.density = config_.small_strain ? at(element, f_density) : at(element, f_mass) / at(element, f_volume);
  out.volume = config_.small_strain ? at(element, f_mass) / out.density : at(element, f_volume);
  out.pressure = at(element, f_pressure);
  out.bulk_viscosity = at(element, f_viscosity);
  if (config_.law == 2) out.plastic_min = out.plastic_max = at(element, config_.law_field);
  const double s[6] = {at(element, f_sxx), at(element, f_syy), at(element, f_szz),
                       at(element, f_sxy), at(element, f_syz), at(element, f_szx)};
  out.von_mises = std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  double t[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  if (config_.corotational && at(element, config_.frame_field) * at(element, config_.frame_field) +
                                      at(element, config_.frame_field + 1) * at(element, config_.frame_field + 1) +
                                      at(element, config_.frame_field + 2) * at(element, config_.frame_field + 2) >
                                  0.0) {
    double global[3][3] = {};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int a = 0; a < 3; ++a) {
          for (int b = 0; b < 3; ++b) {
            global[i][j] += at(element, config_.frame_field + 3 * a + i) * t[a][b] * at(element, config_.frame_field + 3 * b + j);
          }
        }
      }
    }
    std::copy(&global[0][0], &global[0][0] + 9, &t[0][0]);
  }
  out.stress = {t[0][0] - out.pressure, t[1][1] - out.pressure, t[2][2] - out.pressure, t[0][1], t[1][2], t[2][0]};
  return out;
}

bool SolidGroup::active(Index element) const { return at(element, f_off) > 0.0; }

void SolidGroup::share_masses() const {
  // rho^n V_0 of the reference's small strain changes from cycle to cycle.
  if (shares_.valid && !reference_part_mass_) return;
  std::vector<double> masses(chunks_.nodes().size(), 0.0);
  const double equal = 1.0 / nodes_per_element_;
  for (Index e = 0; e < size(); ++e) {
    if (!(at(e, nodal_part_sums_ ? f_off : f_live) > 0.0)) continue;
    const double mass = reference_part_mass_ ? at(e, f_density) * at(e, f_volume) : at(e, f_mass);
    for (int k = 0; k < nodes_per_element_; ++k) masses[chunks_.place(e, k)] += (nodal_part_sums_ ? mass_share(e, k) : equal) * mass;
  }
  shares_.mass = NodalShares::Values(std::move(masses));
  shares_.leaves.resize(static_cast<std::size_t>(chunks_.size()));
  shares_.valid = true;
}

PartSums SolidGroup::part_sums(const Vec3* v, const Vec3* w, parallel::ThreadPool* pool) const {
  share_masses();
  return shares_.sums(chunks_, v, w, pool);
}

double SolidGroup::element_mass(Index element) const { return at(element, f_mass); }

double SolidGroup::element_energy(Index element) const { return at(element, f_energy) + at(element, f_hourglass); }

std::vector<std::span<double>> SolidGroup::history() {
  shares_.valid = false;  // whoever restores a history may change which elements live
  return {std::span<double>(state_)};
}

}  // namespace abut::elements
