#include "findings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

namespace abut::app {

void print_findings(std::span<const Diagnostic> findings, Severity from) {
  for (const Diagnostic& finding : findings) {
    if (finding.severity >= from) fmt::print(stderr, "{}\n", to_string(finding));
  }
  const auto count = [findings](Severity s) {
    return std::count_if(findings.begin(), findings.end(), [s](const Diagnostic& d) { return d.severity == s; });
  };
  if (count(Severity::error) > 0) fmt::print(stderr, "{} error(s), {} warning(s)\n", count(Severity::error), count(Severity::warning));
}

}  // namespace abut::app
