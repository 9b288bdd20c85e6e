// Words of the run API's choices.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

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

/// Interface id or "all" to its settings "KEY=VALUE,..." (interface_choice()).
using InterfaceSettings = std::map<std::variant<Id, std::string>, std::string>;

inline Choices choices_of(const std::string& rules, const InterfaceSettings& interfaces) {
  Choices c;
  c.rules = named(rules, "rules", rule_sets);
  for (const auto& [key, settings] : interfaces) {
    const Id* id = std::get_if<Id>(&key);
    c.interfaces.push_back(interface_choice((id != nullptr ? std::to_string(*id) : std::get<std::string>(key)) + ":" + settings));
  }
  return c;
}

}  // namespace abut::python
