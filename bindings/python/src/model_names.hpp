// Words of the run API's choices.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "abut/model.hpp"
#include "abut/results.hpp"
#include "contact_names.hpp"
#include "names.hpp"

namespace abut::python {

inline constexpr Names<Rules, 2> rule_sets{{{"standard", Rules::standard}, {"reference", Rules::reference}}};
inline constexpr Names<ElementKind, 4> element_kinds{
    {{"shell4", ElementKind::shell4}, {"shell3", ElementKind::shell3}, {"brick", ElementKind::brick}, {"tetra", ElementKind::tetra}}};
inline constexpr Names<Outcome::Kind, 4> outcome_kinds{{{"finished", Outcome::Kind::finished},
                                                        {"stopped", Outcome::Kind::stopped},
                                                        {"interrupted", Outcome::Kind::interrupted},
                                                        {"failed", Outcome::Kind::failed}}};
inline constexpr Names<StepController::Kind, 9> controller_kinds{{{"none", StepController::Kind::none},
                                                                  {"shell4", StepController::Kind::shell},
                                                                  {"shell3", StepController::Kind::sh3n},
                                                                  {"brick", StepController::Kind::brick},
                                                                  {"tetra", StepController::Kind::tetra},
                                                                  {"node", StepController::Kind::node},
                                                                  {"interface", StepController::Kind::interface},
                                                                  {"fixed", StepController::Kind::fixed},
                                                                  {"contact_node", StepController::Kind::contact_node}}};

/// Interface id to the time over which its initial penetrations are pushed out.
using Durations = std::map<Id, double>;

inline Choices choices_of(const std::string& rules, const std::optional<std::string>& interface_law, const Durations& gradual_starts) {
  Choices c;
  c.rules = named(rules, "rules", rule_sets);
  if (interface_law) c.interface_law = named(*interface_law, "interface_law", laws);
  for (const auto& [id, duration] : gradual_starts) c.gradual_starts.push_back({id, duration});
  return c;
}

}  // namespace abut::python
