// An order of elements in which those that lie close together follow each other.
//
// Chunks of consecutive elements then have few nodes, and few of these in common with other chunks. The order depends on the ids and on
// the geometry of the deck only, so that sums that follow it are the same in every run.
#pragma once

#include <functional>
#include <vector>

#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut::init {

/// Halves the list again and again at the median of its longest extent, down to what a block holds.
/// @param list  elements sorted by id; equal coordinates keep the order of ids
/// @param centre  of an element
void order_for_locality(std::vector<Index>& list, const std::function<Vec3(Index)>& centre);

}  // namespace abut::init
