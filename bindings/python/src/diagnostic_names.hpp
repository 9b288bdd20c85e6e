#pragma once

#include "abut/diagnostic.hpp"
#include "names.hpp"

namespace abut::python {

inline constexpr Names<Severity, 3> severities{{{"note", Severity::note}, {"warning", Severity::warning}, {"error", Severity::error}}};

}  // namespace abut::python
