// The page that `abut check` prints about a model.
#pragma once

#include <string>

#include "model/model.hpp"

namespace abut::model {

/// Name, units, counts, parts with their masses, interfaces and what they join, conditions, outputs, what is left out.
/// Values are in work units. Lines end with a newline.
[[nodiscard]] std::string summary(const Model& model);

}  // namespace abut::model
