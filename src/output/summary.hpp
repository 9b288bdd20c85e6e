// A page of text about a model: what `abut check` prints and what opens the listing.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "abut/model.hpp"
#include "cycle/sink.hpp"
#include "model/model.hpp"

namespace abut::output {

/// Units, counts, parts (with their masses when given), interfaces and what they join, conditions, run controls and
/// skipped keywords.
/// @param part_mass  #parts initial masses; empty: not shown
[[nodiscard]] std::string model_summary(const model::Model& model, std::span<const double> part_mass);

/// The line of an Engine deck in it: final time and intervals.
[[nodiscard]] std::string run_summary(const model::Controls& controls);

/// "TYPE3", "TYPE5", "TYPE7".
[[nodiscard]] std::string_view interface_type(const model::Interface& interface);

/// Who gives the step, in words: "SHELL", "NODE", "INTER", ...; "-" for none.
/// True where the gap of a TYPE7 comes from thicknesses and segments.
[[nodiscard]] bool has_automatic_gap(const model::Interface& interface);

/// Gap that the contact works with; the smallest one where it varies from facet to facet.
[[nodiscard]] double effective_gap(const model::Model& model, const model::Interface& interface);

[[nodiscard]] std::string_view controller_name(cycle::StepController::Kind kind);
/// "finished", "stopped", "interrupted", "failed".
[[nodiscard]] std::string_view outcome_name(cycle::Outcome::Kind kind);
/// "finished at time 0.2 after 77 cycles" with the outcome's message behind a colon.
[[nodiscard]] std::string outcome_text(const cycle::Outcome& outcome);

/// "first time step 1e-06, controlled by shell 12".
[[nodiscard]] std::string first_step_text(const Inspection& inspection);

/// Elements of all kinds.
[[nodiscard]] Index element_count(const model::Model& model);

}  // namespace abut::output
