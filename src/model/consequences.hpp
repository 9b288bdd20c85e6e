// One fault, one finding: takes out of a deck's findings those that only say what an error before them leads to.
#pragma once

#include "core/diagnostic.hpp"

namespace abut::model {

/// Left out, when there are errors at all:
///  - further findings at a field, or flags of a field, that already has an error; warnings at a line that has one;
///  - "no /X with id N" after the first, and all of them where an id of a block /X could not be read or is there twice;
///  - the same error about the same surface or set from several interfaces;
///  - empty groups and surfaces, conditions without nodes, parts without material, points of a function out of order, where the block or
///    what it is made of has an error, and outputs of what is not there;
///  - warnings that a set is empty, where an error of an interface says so: that error then names the reason.
[[nodiscard]] Diagnostics without_consequences(const Diagnostics& all);

}  // namespace abut::model
