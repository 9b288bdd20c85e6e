// Findings on the console.
#pragma once

#include <span>

#include "abut/diagnostic.hpp"

namespace abut::app {

/// Findings of this severity and worse on standard error, one per line; with errors also how many.
void print_findings(std::span<const Diagnostic> findings, Severity from = Severity::note);

}  // namespace abut::app
