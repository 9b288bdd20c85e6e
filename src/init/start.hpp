// Model -> what the first cycle needs: element groups, assembly, nodal state, interfaces.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/profile.hpp"
#include "elements/group.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace abut::init {

/// One group per part and element kind, in the order of parts, then shells, triangles, bricks, tetrahedra; elements as
/// init/locality.hpp orders them.
[[nodiscard]] std::vector<std::unique_ptr<elements::Group>> make_groups(const model::Model& model, const Profile& profile);

/// Positions, lumped masses (elements, then /ADMAS) and initial velocities of the model.
[[nodiscard]] state::State make_state(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups);

}  // namespace abut::init
