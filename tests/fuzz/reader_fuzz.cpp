// No text may crash the reader: any bytes as a Starter and as an Engine deck, through the whole build of a model (run with
// -max_len=20000).
#include <cstddef>
#include <cstdint>
#include <string>

#include "deck/deck.hpp"
#include "deck/fields.hpp"
#include "model/build.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  (void)abut::deck::parse_real(text);
  (void)abut::deck::parse_integer(text);
  abut::Diagnostics diagnostics;
  abut::deck::DeckPair pair;
  pair.starter = abut::deck::read_starter_text(text, "fuzz_0000.rad", diagnostics);
  pair.engine = abut::deck::read_engine_text(text, "fuzz_0001.rad", diagnostics);
  pair.has_engine = true;
  (void)abut::model::build(pair, diagnostics);
  for (const abut::Diagnostic& d : diagnostics.all()) (void)to_string(d);
  return 0;
}
