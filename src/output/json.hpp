// JSON forms shared by run.json and `abut check --json`.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "init/contact_inspection.hpp"
#include "model/model.hpp"

namespace abut::output {

using Json = nlohmann::ordered_json;

/// Name, units, counts, parts, interfaces.
/// @param part_mass  #parts initial masses; empty: not known, no "mass" keys
[[nodiscard]] Json model_json(const model::Model& model, std::span<const double> part_mass);

/// Array of {severity, code, message, file, line, keyword, field, columns}; keys without a value are absent.
[[nodiscard]] Json findings_json(const std::vector<Diagnostic>& findings);

/// Array of {interface, surface, severity, code, what, advice, measure: {name, value}, nodes, segments (node ids), histogram
/// [{low, high, count}]}: findings of the contact inspection with all ids; keys without a value are absent.
[[nodiscard]] Json contact_json(const std::vector<init::ContactFinding>& findings);

/// Text of a document. A deck may hold bytes that are not UTF-8 (titles of old decks): they become U+FFFD. Numbers that
/// are not finite become null.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace abut::output
