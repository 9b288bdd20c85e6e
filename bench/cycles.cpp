// Times every cycle of a deck, phase by phase, without outputs.
//
//   bench_cycles STARTER_DECK [THREADS [CYCLES]]
//
// Prints, per phase, the least, the lowest decile and the median over all cycles of the wall time per element, in ns. The lowest are what
// the program takes when the machine leaves it alone: on a shared machine they repeat much better than medians.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "core/diagnostic.hpp"
#include "cycle_times.hpp"
#include "deck/deck.hpp"
#include "model/build.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_cycles STARTER_DECK [THREADS [CYCLES]]\n");
    return 2;
  }
  abut::Diagnostics findings;
  const abut::deck::DeckPair pair = abut::deck::read(argv[1], findings);
  const abut::model::Model model = abut::model::build(pair, findings);
  if (findings.has_errors()) {
    std::fprintf(stderr, "the deck has errors: see abut check\n");
    return 1;
  }
  abut::cycle::RunOptions options;
  options.threads = argc > 2 ? std::atoi(argv[2]) : 1;
  const long most = argc > 3 ? std::atol(argv[3]) : 1000000;
  abut::cycle::Cycle cycle(model, options);
  const abut::bench::CycleTimes times(cycle, most);
  const double per_element = 1e9 / cycle.element_count();
  std::printf("%s: %.0f elements, %zu cycles, %d threads\n", std::filesystem::path(argv[1]).stem().c_str(), cycle.element_count(),
              times.cycles(), options.threads);
  for (std::size_t p = 0; p < times.names.size(); ++p) {
    std::printf("  %-16s least %7.1f   lowest decile %7.1f   median %7.1f   ns per element\n", times.names[p].c_str(),
                per_element * times.quantile(p, 0.0), per_element * times.quantile(p, 0.1), per_element * times.quantile(p, 0.5));
  }
  return 0;
}
