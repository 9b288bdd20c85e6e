// Pieces of read_mesh, in the order in which they are called.
#pragma once

#include <string>
#include <vector>

#include "model/reader.hpp"

namespace abut::model {

void read_nodes(Context& c);
void read_functions(Context& c);  ///< /FUNCT, /MOVE_FUNCT
void read_skews(Context& c);      ///< /SKEW/FIX, MOV, MOV2; needs nodes
void read_materials(Context& c);

/// A formulation that abut does not have: a fault only where elements of that kind use the property.
struct RefusedFormulation {
  Id property = 0;
  ElementKind kind = ElementKind::none;
  Diagnostic diagnostic;
};
[[nodiscard]] std::vector<RefusedFormulation> read_properties(Context& c);

void read_parts(Context& c);
void read_elements(Context& c);
/// Reports the refusals that meet an element, once per property and kind.
void refuse_formulations(Context& c, const std::vector<RefusedFormulation>& refused);

}  // namespace abut::model
