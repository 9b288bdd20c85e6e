// The scenes of bench/run: built in code like those of the verification tests, run without outputs.
//
//   bench_scenes NAME THREADS      one JSON object: sizes, ns per element and cycle of every phase, peak memory
//
// shells_N: a clamped plate of N x N shells (LAW2, 3 points) on which a smaller elastic one falls obliquely. bricks_N: four brick
// plates on each other, hit by the top one; three interfaces.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "cycle/run.hpp"
#include "support/scene.hpp"

namespace {

using abut::Index;
using abut::Vec3;
using abut::scenes::Block;
using abut::scenes::Scene;

Scene shells(int n, double end) {
  Scene s("shells");
  const double size = 0.2, gap = 0.002, half = 0.3 * size;
  const Index steel = s.johnson_cook(7800.0, 210e9, 0.3, 300e6, 400e6, 0.5), alu = s.elastic(2700.0, 70e9, 0.33);
  const Index lower = s.part(s.shell_property(0.002), steel), upper = s.part(s.shell_property(0.004), alu);
  const int m = static_cast<int>(0.62 * n);
  const std::vector<Index> base = s.shells(lower, n, n, [&](double u, double v) { return Vec3{size * u, size * v, 0.0}; });
  const std::vector<Index> plate = s.shells(
      upper, m, m,
      [&](double u, double v) {
        return Vec3{0.5 * size - half + 2 * half * u, 0.5 * size - half + 2 * half * v, 1.05 * gap};
      },
      true);
  std::vector<Index> edge;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      if (i == 0 || i == n || j == 0 || j == n) edge.push_back(base[static_cast<std::size_t>(i + (n + 1) * j)]);
    }
  }
  s.fix(edge, {true, true, true}, {true, true, true});
  s.velocity(plate, {1.0, 0.0, -5.0});
  s.contact(s.shell_surface(lower), s.shell_surface(upper), 0.2, 0.1, gap);
  s.end(end, end / 200);
  return s;
}

Scene bricks(int n, int thick, double end) {
  Scene s("bricks");
  const double size = 0.2, height = 0.02, gap = 5e-4;
  std::vector<Block> blocks;
  const std::vector<Index> material{s.elastic(7800.0, 210e9, 0.3), s.elastic(2700.0, 70e9, 0.33)};
  for (int k = 0; k < 4; ++k) {
    const int cells = k % 2 == 0 ? n : static_cast<int>(0.9 * n);
    const Index part = s.part(s.solid_property(), material[static_cast<std::size_t>(k % 2)]);
    blocks.push_back(s.block(part, {0.0, 0.0, k * (height + 1.01 * gap)}, {size, size, height}, {cells, cells, thick}));
  }
  s.fix(blocks[0].plane(2, false), {true, true, true});
  s.velocity(blocks[3].nodes, {0.0, 0.0, -10.0});
  for (std::size_t k = 0; k < 3; ++k) s.contact(s.surface(blocks[k], 2, true), s.surface(blocks[k + 1], 2, false), 0.2, 0.1, gap);
  s.end(end, end / 100);
  return s;
}

class Nothing final : public abut::cycle::Sink {
 public:
  void begin(const abut::cycle::Snapshot&) override {}
  void cycle(const abut::cycle::Snapshot&) override {}
  void end(const abut::cycle::Outcome&) override {}
};

double memory(const std::string& key) {  // bytes
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return 1024.0 * std::atof(line.c_str() + key.size() + 1);
  }
  return 0.0;
}

double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  const bool known = name == "shells_100" || name == "shells_300" || name == "bricks_40" || name == "bricks_100";
  if (argc < 3 || !known) {
    std::fprintf(stderr, "usage: bench_scenes shells_100|shells_300|bricks_40|bricks_100 THREADS\n");
    return 2;
  }
  const Scene scene = name == "shells_100"   ? shells(100, 2e-4)
                      : name == "shells_300" ? shells(300, 2e-5)
                      : name == "bricks_40"  ? bricks(40, 5, 1e-4)
                                             : bricks(100, 8, 2e-5);
  abut::cycle::RunOptions options;
  options.threads = std::atoi(argv[2]);
  std::vector<abut::cycle::PhaseTime> phases;
  options.phases = &phases;
  Nothing sink;
  const double before = memory("VmHWM"), cpu_before = cpu();
  const auto start = std::chrono::steady_clock::now();
  const abut::cycle::RunReport report = abut::cycle::run(scene.model, options, sink);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double used = cpu() - cpu_before;
  const double elements = report.element_cycles / static_cast<double>(report.outcome.cycles);
  double in_phases = 0.0;
  for (const abut::cycle::PhaseTime& p : phases) in_phases += p.seconds;
  const double init = phases.front().seconds;
  // Wall times of phases stretch on a busy machine; the CPU time of the cycles does not.
  std::printf("{\"elements\": %.0f, \"cycles\": %.0f, \"init_s\": %.4f, \"wall_s\": %.4f, \"cpu_s\": %.4f", elements,
              static_cast<double>(report.outcome.cycles), init, wall, used);
  std::printf(", \"bytes_per_element\": %.0f", (memory("VmHWM") - before) / elements);
  const double per_element = 1e9 / report.element_cycles;
  std::printf(", \"ns_cycle_cpu\": %.3f, \"ns_cycle_wall\": %.3f", per_element * (used - init * used / wall), per_element * (wall - init));
  for (std::size_t i = 1; i < phases.size(); ++i) {
    std::string key = phases[i].name;
    for (char& c : key) c = c == ' ' ? '_' : c;
    std::printf(", \"share_%s\": %.3f", key.c_str(), phases[i].seconds / (in_phases - init));
  }
  std::printf(", \"hash\": \"%016llx\"}\n", static_cast<unsigned long long>(report.final_hash));
  return report.outcome.kind == abut::cycle::Outcome::Kind::finished ? 0 : 1;
}
