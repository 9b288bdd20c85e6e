#include "output/animation_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "elements/strain_rate.hpp"
#include "model/animation_names.hpp"

namespace abut::output {
namespace {

using cycle::Snapshot;

void put(const Vec3& v, double* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

template <state::ZeroArray<Vec3> state::State::*member>
void write_vector(const Snapshot& s, std::size_t n, double* out) {
  put((s.state->*member)[n], out);
}

/// Force over tributary area. Spans may be empty in a run without interfaces.
void write_over_area(std::span<const Vec3> force, std::span<const double> area, std::size_t n, double* out) {
  const double a = n < area.size() ? area[n] : 0.0;
  put(a > 0.0 && n < force.size() ? force[n] / a : Vec3{}, out);
}

const NodeField displacement{"displacement", 3, write_vector<&state::State::u>};
const NodeField velocity{"velocity", 3, write_vector<&state::State::v>};
const NodeField acceleration{"acceleration", 3, write_vector<&state::State::a>};
const NodeField angular_velocity{"angular_velocity", 3, write_vector<&state::State::w>};
const NodeField internal_force{"internal_force", 3, write_vector<&state::State::f_internal>};
const NodeField external_force{"external_force", 3, write_vector<&state::State::f_external>};
const NodeField mass{"mass", 1, [](const Snapshot& s, std::size_t n, double* out) { *out = s.state->mass[n]; }};
const NodeField contact_force{"contact_force", 3, [](const Snapshot& s, std::size_t n, double* out) {
                                Vec3 f;
                                if (n < s.contact_normal.size()) f += s.contact_normal[n];
                                if (n < s.contact_tangential.size()) f += s.contact_tangential[n];
                                put(f, out);
                              }};
const NodeField pressure_normal{"contact_pressure_normal", 3, [](const Snapshot& s, std::size_t n, double* out) {
                                  write_over_area(s.contact_normal, s.contact_area, n, out);
                                }};
const NodeField pressure_tangential{"contact_pressure_tangential", 3, [](const Snapshot& s, std::size_t n, double* out) {
                                      write_over_area(s.contact_tangential, s.contact_area, n, out);
                                    }};

// VTK and ParaView show NaN as "no value".
const NodeField contact_gap{"contact_gap", 1, [](const Snapshot& s, std::size_t n, double* out) {
                              *out = n < s.contact_state.size() ? s.contact_state[n].opening : std::numeric_limits<double>::quiet_NaN();
                            }};
const NodeField contact_penetration{"contact_penetration", 1, [](const Snapshot& s, std::size_t n, double* out) {
                                      *out = n < s.contact_state.size() ? s.contact_state[n].penetration : 0.0;
                                    }};
const NodeField contact_state{"contact_state", 1, [](const Snapshot& s, std::size_t n, double* out) {
                                *out = n < s.contact_state.size() ? static_cast<double>(s.contact_state[n].state) : 0.0;
                              }};

void write_or_zero(std::span<const Vec3> values, std::size_t n, double* out) { put(n < values.size() ? values[n] : Vec3{}, out); }

const NodeField option_force{"option_force", 3,
                             [](const Snapshot& s, std::size_t n, double* out) { write_or_zero(s.option_force, n, out); }};
const NodeField option_moment{"option_moment", 3,
                              [](const Snapshot& s, std::size_t n, double* out) { write_or_zero(s.option_moment, n, out); }};

/// Square of 2 m / K; infinite where there is no stiffness: sums start from 1e-20 (numerics.md 1.2 step 2).
double square_of_step(double mass, double stiffness) {
  return mass > 0.0 && stiffness > 1e-20 ? 2.0 * mass / stiffness : std::numeric_limits<double>::infinity();
}

const NodeField nodal_step{"nodal_step", 1, [](const Snapshot& s, std::size_t n, double* out) {
                             const state::State& q = *s.state;
                             const double square = std::min(square_of_step(q.mass[n], q.stiffness[n]),
                                                            square_of_step(q.inertia[n], q.rotational_stiffness[n]));
                             *out = std::isfinite(square) ? s.nodal_scale * std::sqrt(square) : std::numeric_limits<double>::quiet_NaN();
                           }};
const NodeField added_mass_ratio{"added_mass_ratio", 1, [](const Snapshot& s, std::size_t n, double* out) {
                                   const double added = n < s.added_mass.size() ? s.added_mass[n] : 0.0;
                                   *out = added > 0.0 ? added / (s.state->mass[n] - added) : 0.0;
                                 }};

const CellField plastic_strain{"plastic_strain", 1, [](const ElementSample& e, double* out) { *out = e.output.plastic_max; }};
const CellField von_mises{"von_mises", 1, [](const ElementSample& e, double* out) { *out = e.output.von_mises; }};
const CellField stress{"stress", 6,
                       [](const ElementSample& e, double* out) { std::copy(e.output.stress.begin(), e.output.stress.end(), out); }};
const CellField energy{"energy_per_mass", 1,
                       [](const ElementSample& e, double* out) { *out = e.mass > 0.0 ? e.output.internal_energy / e.mass : 0.0; }};
const CellField pressure{"pressure", 1, [](const ElementSample& e, double* out) { *out = e.output.pressure; }};
const CellField density{"density", 1, [](const ElementSample& e, double* out) { *out = e.output.density; }};
const CellField thickness{"thickness", 1, [](const ElementSample& e, double* out) { *out = e.output.thickness; }};
const CellField hourglass{"hourglass_energy", 1, [](const ElementSample& e, double* out) { *out = e.output.hourglass_energy; }};
const CellField strain_rate{"strain_rate", 1, [](const ElementSample& e, double* out) {
                              *out = e.group == nullptr || e.state == nullptr
                                         ? 0.0
                                         : elements::equivalent_strain_rate(*e.group, e.element, e.state->x, e.state->v, e.state->w);
                            }};

CellField layer_field(std::string name, elements::ShellLayer layer) {
  return {std::move(name), 6, [layer](const ElementSample& e, double* out) {
            const std::array<double, 6> s = e.group != nullptr ? e.group->layer_stress(e.element, layer) : std::array<double, 6>{};
            std::copy(s.begin(), s.end(), out);
          }};
}

/// Fields of "TENS/STRESS/UPPER" and its like; none for what is not a layer.
std::vector<CellField> layer_fields(std::string_view selection) {
  using Kind = elements::ShellLayer::Kind;
  constexpr std::string_view stresses = "TENS/STRESS/";
  if (!selection.starts_with(stresses)) return {};
  const std::string_view layer = selection.substr(stresses.size());
  if (layer == "UPPER") return {layer_field("stress_upper", {Kind::upper})};
  if (layer == "LOWER") return {layer_field("stress_lower", {Kind::lower})};
  if (layer == "BEND") return {layer_field("stress_bending", {Kind::bending})};
  if (layer == "ALL") return {layer_field("stress_upper", {Kind::upper}), layer_field("stress_lower", {Kind::lower})};
  const int point = model::animation_layer(selection);
  if (point == 0) return {};
  return {layer_field("stress_point_" + std::to_string(point), {Kind::point, point})};
}

const std::vector<std::pair<std::string_view, NodeField>>& selectable_node_fields() {
  static const std::vector<std::pair<std::string_view, NodeField>> table{
      {"VECT/ACC", acceleration},  {"VECT/VROT", angular_velocity}, {"VECT/FINT", internal_force},   {"VECT/FEXT", external_force},
      {"VECT/FOPT", option_force}, {"NODA/DT", nodal_step},         {"NODA/DMAS", added_mass_ratio}, {"MASS", mass}};
  return table;
}

const std::vector<std::pair<std::string_view, CellField>>& selectable_cell_fields() {
  static const std::vector<std::pair<std::string_view, CellField>> table{
      {"ELEM/ENER", energy},    {"ELEM/P", pressure},      {"ELEM/DENS", density},    {"ELEM/HOURG", hourglass},
      {"ELEM/THIC", thickness}, {"ELEM/THICK", thickness}, {"ELEM/EPSD", strain_rate}};
  return table;
}

}  // namespace

AnimationFields select_animation_fields(const std::vector<std::string>& selections) {
  const auto& node_fields = selectable_node_fields();
  const auto& cell_fields = selectable_cell_fields();
  const std::vector<std::string>& every_state = model::animation_names_of_every_state();
  AnimationFields fields{
      {displacement, velocity, contact_force, pressure_normal, pressure_tangential, contact_gap, contact_penetration, contact_state},
      {plastic_strain, von_mises, stress},
      {}};
  const auto add_once = [](auto& list, const auto& field) {
    if (std::none_of(list.begin(), list.end(), [&](const auto& f) { return f.name == field.name; })) list.push_back(field);
  };
  for (const std::string& selection : selections) {
    const std::string s = model::plain_animation_name(selection);
    if (std::find(every_state.begin(), every_state.end(), s) != every_state.end()) continue;
    const auto same = [&s](const auto& entry) { return entry.first == s; };
    if (const auto n = std::find_if(node_fields.begin(), node_fields.end(), same); n != node_fields.end()) {
      add_once(fields.nodes, n->second);
      if (n->second.name == option_force.name) add_once(fields.nodes, option_moment);
    } else if (const auto c = std::find_if(cell_fields.begin(), cell_fields.end(), same); c != cell_fields.end()) {
      add_once(fields.cells, c->second);
    } else if (const std::vector<CellField> layers = layer_fields(s); !layers.empty()) {
      for (const CellField& field : layers) add_once(fields.cells, field);
    } else if (std::find(fields.left_out.begin(), fields.left_out.end(), selection) == fields.left_out.end()) {
      fields.left_out.push_back(selection);
    }
  }
  return fields;
}

AnimationFields every_animation_field() { return select_animation_fields(model::animation_names_on_request()); }

}  // namespace abut::output
