// Readers of single condition keywords; read_conditions() walks the deck and hands every block to one of them.
#pragma once

#include "model/reader.hpp"

namespace abut::model {

void read_added_mass(Context& c, const deck::Block& block);  ///< /ADMAS/type (D.7)
void read_rigid_body(Context& c, const deck::Block& block);  ///< /RBODY (D.8)
void read_rigid_wall(Context& c, const deck::Block& block);  ///< /RWALL/PLANE (D.9)

}  // namespace abut::model
