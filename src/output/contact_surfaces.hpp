// The contact surfaces of a model as a VTK file: which segments, on which side of which interface, looking where.
#pragma once

#include "model/model.hpp"
#include "output/vtu.hpp"

namespace abut::output {

/// An unstructured grid (.vtu) whose points are all nodes at their initial positions, in the animation's order, and whose cells
/// are the segments of every interface's surfaces, ordered as the deck has them after reading: the normal of a cell is the side from which
/// the segment is touched. Cell data: interface_id, surface_id, side (1 first, 2 second). Point data: node_id.
/// The model must live until the grid is written.
[[nodiscard]] VtuGrid contact_surfaces(const model::Model& model);

}  // namespace abut::output
