// The factor s by which the run's step stays below the limit of the assembled system.
#pragma once

#include "model/model.hpp"

namespace abut::model {

/// Of /DT/NODA where that is given, else the smallest of the element families that the model has and of /DT/INTER (deck-format.md G).
[[nodiscard]] double system_step_scale(const Model& model);

}  // namespace abut::model
