// Main nodes of rigid bodies that are nodes of the mesh.
#pragma once

#include <vector>

#include "model/reader.hpp"

namespace abut::model {

/// Reports main nodes that belong to an element or a contact segment and that the start moves to the centre of gravity.
/// @param masses by node
void check_main_nodes(const Context& c, const std::vector<double>& masses);

}  // namespace abut::model
