// What an animation state shows: a fixed useful set, and what the Engine deck's /ANIM cards add.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cycle/sink.hpp"

namespace abut::output {

/// A value per node; `write` fills `components` doubles per node.
struct NodeField {
  std::string name;
  int components = 1;
  void (*write)(const cycle::Snapshot& now, std::size_t node, double* out) = nullptr;
};

/// An element with what its fields need. `group` is null for an element that no group computes.
struct ElementSample {
  elements::ElementOutput output;
  double mass = 0.0;
  const elements::Group* group = nullptr;
  Index element = no_index;  ///< in the group
  const state::State* state = nullptr;
};

struct CellField {
  std::string name;
  int components = 1;
  std::function<void(const ElementSample& element, double* out)> write;
};

struct AnimationFields {
  std::vector<NodeField> nodes;
  std::vector<CellField> cells;
  std::vector<std::string> left_out;  ///< selections of the deck that abut does not compute: "SHELL/TENS/STRAIN/UPPER"
};

/// Always: displacement, velocity, contact_force, contact_pressure_normal, contact_pressure_tangential (net contact force
/// of the node over its tributary area, so two passes do not count twice; zero where the area is zero), contact_gap (distance to the
/// other surface less the interface's gap, NaN where nothing is near), contact_penetration, contact_state (0 apart, 1 sticks, 2 slips);
/// plastic_strain, von_mises, stress (XX YY ZZ XY YZ XZ, mean over the element, global axes). TENS/STRESS/UPPER, LOWER, BEND and n (an
/// integration point from 1 at the bottom) add stress_upper, stress_lower, stress_bending and stress_point_n
/// (elements::Group::layer_stress); ALL adds upper and lower.
/// VECT/FOPT adds option_force and option_moment (cycle::Snapshot), NODA/DT nodal_step (of elements and contact at the node, with the
/// run's factor; NaN for nodes that limit nothing), NODA/DMAS added_mass_ratio (mass added by scaling over the node's mass without it),
/// ELEM/EPSD strain_rate (elements/strain_rate.hpp).
/// @param selections  model::Controls::animation_fields, upper case
[[nodiscard]] AnimationFields select_animation_fields(const std::vector<std::string>& selections);

/// All that there are, without those of single integration points.
[[nodiscard]] AnimationFields every_animation_field();

}  // namespace abut::output
