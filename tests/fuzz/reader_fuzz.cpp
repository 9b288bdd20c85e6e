// No text may crash the reader: any bytes as a Starter and as an Engine deck, through every reader of mesh and sets (run with
// -max_len=20000).
#include <cstddef>
#include <cstdint>
#include <string>

#include "deck/deck.hpp"
#include "deck/fields.hpp"
#include "model/reader.hpp"

namespace {

void read_model(const std::string& text) {
  abut::Diagnostics diagnostics;
  const abut::deck::Deck deck = abut::deck::read_starter_text(text, "fuzz_0000.rad", diagnostics);
  if (deck.blocks.empty()) return;
  abut::model::Model model;
  abut::model::Context context;
  context.deck = &deck;
  context.model = &model;
  context.diagnostics = &diagnostics;
  abut::model::read_control(context);
  abut::model::check_keywords(context);
  abut::model::read_mesh(context);
  abut::model::read_sets(context);
  for (const abut::Diagnostic& d : diagnostics.all()) (void)to_string(d);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  (void)abut::deck::parse_real(text);
  (void)abut::deck::parse_integer(text);
  abut::Diagnostics diagnostics;
  (void)abut::deck::read_engine_text(text, "fuzz_0001.rad", diagnostics);
  read_model(text);
  return 0;
}
