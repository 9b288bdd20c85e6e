#include "driver.hpp"

#include "core/diagnostic.hpp"

namespace abut::app {

cycle::Outcome run_model(const model::Model&, const RunSettings&, cycle::Sink&, std::vector<output::PhaseTime>&) {
  throw RunError("this build reads and checks decks but does not run them");
}

Description describe_model(const model::Model&, const RunSettings&) { return {}; }

}  // namespace abut::app
