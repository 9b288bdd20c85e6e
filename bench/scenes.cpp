// The scenes of bench/run: built in code like those of the verification tests, run without outputs.
//
//   bench_scenes NAME THREADS [CYCLES]      one JSON object: sizes, ns per element and cycle of every phase, memory
//
// shells_N: a clamped plate of N x N shells (LAW2, 3 points) on which a smaller elastic one falls obliquely. bricks_N: four brick
// plates of N x N columns on each other, hit by the top one; three interfaces.
// Of every phase the least over the cycles is what the program takes when the machine leaves it alone; medians are printed too.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "cycle_times.hpp"
#include "init/start.hpp"
#include "operations.hpp"
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

double memory(const std::string& key) {  // bytes
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return 1024.0 * std::atof(line.c_str() + key.size() + 1);
  }
  return 0.0;
}

double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Bytes that one cycle has to move if nothing but the state of elements and nodes leaves the caches and nothing is moved twice in a
/// pass: elements read and write their history and read their constants and node numbers; nodes are read once by the elements and by each
/// pass over them (assembly, step, balance, integration). Contact is not counted.
double counted_bytes(const abut::model::Model& model) {
  double bytes = 0.0;
  bool shells = false;
  for (const auto& group : abut::init::make_groups(model, {})) {
    for (const auto& history : group->history()) bytes += 2.0 * static_cast<double>(history.size_bytes());
    const bool shell = group->layout().components == 8;
    shells = shells || shell;
    bytes += static_cast<double>(group->size()) * (shell ? 4 * 6 + 4 * 8 : 8 * 6);
    bytes += 2.0 * 8.0 * static_cast<double>(group->chunks().sum_count());
  }
  const double vector = 24.0, scalar = 8.0;
  double per_node = 2 * vector;                                               // elements: x, v
  per_node += scalar + 2 * vector + scalar;                                   // assembly: mass; internal force, acceleration, stiffness
  per_node += 2 * scalar;                                                     // step: mass, stiffness
  per_node += 3 * vector + scalar;                                            // balance: v, a, internal force; mass
  per_node += 7 * vector;                                                     // integration: a; v, x, u read and written
  if (shells) per_node += 7 * vector + 3 * scalar + 3 * vector + 4 * scalar;  // the same for rotations, which have no position
  return bytes + per_node * static_cast<double>(model.node_count());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  const bool is_shells = name.starts_with("shells_"), is_bricks = name.starts_with("bricks_");
  const int n = is_shells || is_bricks ? std::atoi(name.c_str() + 7) : 0;
  if (argc < 3 || n < 4) {
    std::fprintf(stderr, "usage: bench_scenes shells_N|bricks_N THREADS [CYCLES]\n");
    return 2;
  }
  const long most = argc > 3 ? std::atol(argv[3]) : 1000000;
  // Some 700 and 250 cycles at N = 100 and N = 40; the step falls with the size of the elements.
  const Scene scene = is_shells ? shells(n, 2e-4 * 100 / n) : bricks(n, std::max(2, n / 8), 1e-4 * 40 / n);
  abut::cycle::RunOptions options;
  options.threads = std::atoi(argv[2]);
  const double before = memory("VmHWM"), cpu_before = cpu();
  const auto start = std::chrono::steady_clock::now();
  abut::cycle::Cycle cycle(scene.model, options);
  const double init = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double after_init = memory("VmHWM"), cpu_init = cpu();
  const abut::bench::CycleTimes times(cycle, most);
  const double elements = cycle.element_count(), cycles = static_cast<double>(times.cycles());
  const double per_element = 1e9 / elements;
  std::printf("{\"elements\": %.0f, \"cycles\": %.0f, \"init_s\": %.4f, \"init_cpu_s\": %.4f", elements, cycles, init,
              cpu_init - cpu_before);
  std::printf(", \"bytes_per_element\": %.0f, \"peak_bytes_per_element\": %.0f", (memory("VmRSS") - before) / elements,
              (std::max(after_init, memory("VmHWM")) - before) / elements);
  std::printf(", \"counted_bytes\": %.1f", counted_bytes(scene.model) / elements);
  std::printf(", \"ns_cpu\": %.3f, \"ns_least_cpu\": %.3f", per_element * (cpu() - cpu_init) / cycles, per_element * times.least_cpu);
  for (std::size_t p = 0; p < times.names.size(); ++p) {
    std::string key = times.names[p];
    std::replace(key.begin(), key.end(), ' ', '_');
    std::printf(", \"ns_%s\": %.3f, \"ns_median_%s\": %.3f", key.c_str(), per_element * times.quantile(p, 0.0), key.c_str(),
                per_element * times.quantile(p, 0.5));
  }
  std::printf("%s", abut::bench::operations_text(elements * cycles).c_str());
  std::printf(", \"hash\": \"%016llx\"}\n", static_cast<unsigned long long>(cycle.hash()));
  return 0;
}
