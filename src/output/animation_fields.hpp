// What an animation state shows: a fixed useful set, and what the Engine deck's /ANIM cards add.
#pragma once

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

/// An element with what its fields need.
struct ElementSample {
  elements::ElementOutput output;
  double mass = 0.0;
};

struct CellField {
  std::string name;
  int components = 1;
  void (*write)(const ElementSample& element, double* out) = nullptr;
};

struct AnimationFields {
  std::vector<NodeField> nodes;
  std::vector<CellField> cells;
  std::vector<std::string> left_out;  ///< selections of the deck that abut does not compute: "SHELL/TENS/STRESS/UPPER"
};

/// Always: displacement, velocity, contact_force, contact_pressure_normal, contact_pressure_tangential (net contact force
/// of the node over its tributary area, so two passes do not count twice; zero where the area is zero); plastic_strain,
/// von_mises, stress (XX YY ZZ XY YZ XZ, mean over the element, global axes).
/// @param selections  model::Controls::animation_fields, upper case
[[nodiscard]] AnimationFields select_animation_fields(const std::vector<std::string>& selections);

/// All that there are.
[[nodiscard]] AnimationFields every_animation_field();

}  // namespace abut::output
