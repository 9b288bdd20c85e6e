#include "elements/shell_common/setup.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>

namespace abut::elements {

namespace {

/// A plastic strain rate is always filtered at 10 kHz, whatever the card says (numerics.md 5.2.3).
constexpr double plastic_rate_cutoff_hz = 1e4;

void set_johnson_cook(ShellSection& s, const model::LawJohnsonCook& law, const model::Units& units, int iplas) {
  materials::ShellJohnsonCook& p = s.plastic;
  p.young = law.young;
  p.poisson = law.poisson;
  p.shear = s.elastic.shear;
  p.a = law.a;
  p.b = law.b;
  p.n = law.n;
  p.mapping = iplas == 1 || iplas == 3 ? iplas : 2;
  p.chi = p.mapping == 3 ? 0.0 : law.kinematic;
  p.b_isotropic = (1.0 - p.chi) * law.b;
  p.eps_max = law.eps_max;
  p.sigma_max = law.sigma_max;
  p.icc = law.icc;
  if (law.c > 0.0 && law.eps_rate_0 > 0.0) {
    p.c = law.c;
    p.rate_0 = law.eps_rate_0;
    p.inverse_rate_0 = 1.0 / law.eps_rate_0;
    s.rate = law.vp == 1 ? ShellSection::Rate::plastic : law.vp == 3 ? ShellSection::Rate::deviatoric : ShellSection::Rate::total;
    const double cutoff = law.vp == 1 ? plastic_rate_cutoff_hz * units.time : law.cutoff;
    s.filter = 2.0 * std::numbers::pi * cutoff;
  }
  if (law.rho_cp > 0.0) {
    s.temperature = true;
    p.m = law.m;
    p.t_ref = law.t_ref;
    p.t_max = law.t_max;
    p.inverse_t_range = 1.0 / (law.t_melt - law.t_ref);
    p.inverse_rho_cp = 1.0 / law.rho_cp;
  }
}

void lay_out_state(ShellSection& s, ShellLaw law) {
  s.variables = shell_state::common;
  const auto add = [](int& at, int& total, int count) {
    at = total;
    total += count;
  };
  if (s.mean_volume && s.thickness_changes) add(s.at_volume, s.variables, 2);
  if (law == ShellLaw::elastic) {
    if (s.membrane_damping > 0.0) add(s.at_elastic, s.variables, 3);
    return;
  }
  add(s.at_elastic, s.variables, 2);
  if (s.rate == ShellSection::Rate::total) {
    if (s.filter > 0.0) add(s.at_rate, s.variables, 1);
    if (!s.thickness_changes) add(s.at_rate_thickness, s.variables, 1);
  }
  s.point_size = 5;
  if (s.plastic.chi > 0.0) add(s.point_back, s.point_size, 3);
  if (s.rate == ShellSection::Rate::plastic || (s.rate == ShellSection::Rate::deviatoric && s.filter > 0.0)) {
    add(s.point_rate, s.point_size, 1);
  }
  if (s.temperature) add(s.point_temperature, s.point_size, 1);
  add(s.at_points, s.variables, s.points * s.point_size);
}

}  // namespace

const model::Property& property_of(const GroupInput& in) {
  const model::Part& part = in.model->parts[static_cast<std::size_t>(in.part)];
  return in.model->properties[static_cast<std::size_t>(part.property)];
}

const model::Material& material_of(const GroupInput& in) {
  const model::Part& part = in.model->parts[static_cast<std::size_t>(in.part)];
  return in.model->materials[static_cast<std::size_t>(part.material)];
}

void set_thickness_points(ShellSection& s, int points) {
  if (points < 1 || points > max_thickness_points) {
    throw std::invalid_argument("a shell has 1 to 10 thickness points, not " + std::to_string(points));
  }
  s.points = points;
  if (points == 1) {
    s.zeta[0] = 0.0;
    s.weight[0] = 1.0;
    s.moment_weight[0] = 0.0;
    return;
  }
  const double gap = 1.0 / (points - 1);
  for (int k = 0; k < points; ++k) {
    const bool end = k == 0 || k == points - 1;
    // Antisymmetric to the last bit: pure stretch must leave no moment.
    const double zeta = 0.5 * (2 * k - (points - 1)) * gap;
    s.zeta[k] = zeta;
    s.weight[k] = end ? 0.5 * gap : gap;
    s.moment_weight[k] = end ? std::copysign(0.5 * gap * (0.5 - gap / 3.0), zeta) : zeta * gap;
  }
}

std::optional<ShellSection> make_section(const GroupInput& in, bool mean_yield) {
  const model::Property& property = property_of(in);
  const model::Material& material = material_of(in);
  if (std::holds_alternative<model::VoidProperty>(property.data) || std::holds_alternative<model::LawVoid>(material.law)) {
    return std::nullopt;
  }
  const auto* shell = std::get_if<model::ShellProperty>(&property.data);
  if (shell == nullptr) { throw std::invalid_argument("property " + std::to_string(property.id) + " is not a shell property"); }
  ShellSection s;
  s.step_wanted = in.step_wanted;
  s.viscous_rate = viscous_rate(in.system_scale);
  s.mean_volume = in.profile.strain_increment == Profile::StrainIncrement::midpoint;
  const auto* johnson_cook = std::get_if<model::LawJohnsonCook>(&material.law);
  const auto* elastic = std::get_if<model::LawElastic>(&material.law);
  s.elastic = johnson_cook != nullptr ? materials::ShellElastic::of(johnson_cook->young, johnson_cook->poisson)
                                      : materials::ShellElastic::of(elastic->young, elastic->poisson);
  s.density = material.reference_density > 0.0 ? material.reference_density : material.density;
  s.sound = std::sqrt(s.elastic.young / s.density);
  s.bending = shell->points != 1;
  s.shear_factor = s.bending ? shell->shear_factor : 0.0;
  s.thickness_changes = shell->thickness_changes;
  // 1.414, not sqrt(2): numerics.md 3.6.
  s.membrane_damping = 1.414 * shell->dm * s.density * s.sound;
  s.mean_yield = mean_yield;
  if (johnson_cook != nullptr) {
    // Global integration does not exist for plasticity: three points (numerics.md 5.2.6).
    set_thickness_points(s, shell->points == 0 ? 3 : shell->points);
    set_johnson_cook(s, *johnson_cook, in.model->units, shell->iplas);
  }
  lay_out_state(s, johnson_cook != nullptr ? ShellLaw::johnson_cook : ShellLaw::elastic);
  return s;
}

}  // namespace abut::elements
