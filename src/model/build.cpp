#include "model/build.hpp"

#include <utility>

#include "model/consequences.hpp"
#include "model/reader.hpp"

namespace abut::model {

Model build(const deck::DeckPair& deck, Diagnostics& diagnostics, int run) {
  Model model;
  if (deck.starter.blocks.empty()) return model;  // reported by the deck stage
  Context c;
  c.deck = &deck.starter;
  c.model = &model;
  c.diagnostics = &diagnostics;
  read_control(c);
  check_keywords(c);
  read_entities(c);
  if (deck.has_engine) {
    read_engine(c, deck.engine, 1);
    for (int n = 2; n <= run; ++n) read_engine(c, deck.restarts[static_cast<std::size_t>(n) - 2], n);
  } else {
    Place place;
    place.file = deck.starter.files.front();
    diagnostics.warning("model.no_engine", std::move(place),
                        "no Engine deck NAME_0001.rad beside it: the model can be checked but not run");
  }
  validate(c);
  if (c.diagnostics->error_count() == 0) check_plausibility(c);
  diagnostics = without_consequences(diagnostics);
  return model;
}

}  // namespace abut::model
