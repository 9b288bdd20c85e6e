#include "core/diagnostic.hpp"

#include <fmt/format.h>

#include <utility>

namespace abut {

std::string to_string(const Diagnostic& d) {
  std::string s;
  if (!d.place.file.empty()) {
    s += d.place.file;
    if (d.place.line > 0) s += fmt::format(":{}", d.place.line);
    s += ": ";
  }
  if (d.severity == Severity::warning) s += "warning: ";
  if (d.severity == Severity::note) s += "note: ";
  std::string where = d.place.keyword;
  if (!d.place.field.empty()) where += fmt::format("{}field '{}'", where.empty() ? "" : " ", d.place.field);
  if (d.place.first_column > 0) where += fmt::format(" (columns {}-{})", d.place.first_column, d.place.last_column);
  if (!where.empty()) s += where + ": ";
  return s + d.message;
}

void Diagnostics::add(Diagnostic d) {
  if (d.severity == Severity::error) ++error_count_;
  if (d.severity == Severity::warning) ++warning_count_;
  all_.push_back(std::move(d));
}

void Diagnostics::error(std::string code, Place place, std::string message) {
  add({Severity::error, std::move(code), std::move(place), std::move(message)});
}

void Diagnostics::warning(std::string code, Place place, std::string message) {
  add({Severity::warning, std::move(code), std::move(place), std::move(message)});
}

void Diagnostics::note(std::string code, Place place, std::string message) {
  add({Severity::note, std::move(code), std::move(place), std::move(message)});
}

InputError::InputError(Diagnostics d)
    : std::runtime_error([&d] {
        std::string s;
        for (const Diagnostic& item : d.all()) {
          if (item.severity == Severity::error) s += (s.empty() ? "" : "\n") + to_string(item);
        }
        return s.empty() ? std::string("input error") : s;
      }()),
      diagnostics_(std::move(d)) {}

}  // namespace abut
