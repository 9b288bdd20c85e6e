// Times every cycle of a deck, phase by phase, without outputs.
//
//   bench_cycles STARTER_DECK [THREADS [CYCLES]]
//
// Prints, per phase, the least, the lowest decile and the median over all cycles of the wall time per element, in ns. The lowest are what
// the program takes when the machine leaves it alone: on a shared machine they repeat much better than medians.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "cycle/cycle.hpp"
#include "deck/deck.hpp"
#include "model/build.hpp"

namespace {

class Nothing final : public abut::cycle::Sink {
 public:
  void begin(const abut::cycle::Snapshot&) override {}
  void cycle(const abut::cycle::Snapshot&) override {}
  void end(const abut::cycle::Outcome&) override {}
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

}  // namespace

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
  Nothing sink;
  std::vector<std::string> names{"cycle"};
  for (const abut::cycle::PhaseTime& p : cycle.phases()) names.push_back(p.name);
  std::vector<std::vector<double>> times(names.size());
  std::vector<double> before(names.size(), 0.0);
  for (long i = 0; i < most && !cycle.finished(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    cycle.advance(sink);
    times[0].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    const std::vector<abut::cycle::PhaseTime> phases = cycle.phases();
    for (std::size_t p = 0; p < phases.size(); ++p) {
      times[p + 1].push_back(phases[p].seconds - before[p]);
      before[p] = phases[p].seconds;
    }
  }
  const double per_element = 1e9 / cycle.element_count();
  std::printf("%s: %.0f elements, %zu cycles, %d threads\n", std::filesystem::path(argv[1]).stem().c_str(), cycle.element_count(),
              times[0].size(), options.threads);
  for (std::size_t p = 0; p < names.size(); ++p) {
    std::printf("  %-16s least %7.1f   lowest decile %7.1f   median %7.1f   ns per element\n", names[p].c_str(),
                per_element * quantile(times[p], 0.0), per_element * quantile(times[p], 0.1), per_element * quantile(times[p], 0.5));
  }
  return 0;
}
