#include "../operations.hpp"

#include <string>

#include "tally.hpp"

namespace {

std::string text(const std::string& name, const abut::simd::Operations& found, double count) {
  const auto entry = [&](const std::string& kind, double value) {
    return ", \"" + kind + "_" + name + "\": " + std::to_string(value / count);
  };
  return entry("simple", found.simple) + entry("divisions", found.divisions) + entry("roots", found.roots);
}

}  // namespace

std::string abut::bench::operations_text(double element_cycles) {
  return text("elements", of_elements, element_cycles) + text("contact", of_contact, element_cycles);
}
