// Cost of the quadrilateral shell kernel alone, chunk sums included: ns per element and step of the instruction set that ABUT_ISA names.
//
//   kernel_shell [elements per edge] [repetitions]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "elements/group.hpp"
#include "model/model.hpp"
#include "parallel/thread_pool.hpp"
#include "simd/isa.hpp"

namespace {

using namespace abut;

model::Model plate(int n, bool plastic) {
  model::Model m;
  const auto node = [n](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      m.node_x.push_back({static_cast<double>(i), static_cast<double>(j), 0.1 * (i % 3) * (j % 2)});
      m.node_id.push_back(static_cast<Id>(m.node_id.size()) + 1);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      m.shells.id.push_back(static_cast<Id>(m.shells.id.size()) + 1);
      m.shells.part.push_back(0);
      m.shells.nodes.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  model::LawJohnsonCook jc;
  jc.young = 210.0;
  jc.poisson = 0.3;
  jc.a = 0.3;
  jc.b = 0.5;
  jc.n = 0.4;
  model::Law law = model::LawElastic{210.0, 0.3};
  if (plastic) law = jc;
  m.materials.push_back({1, "", 7.8e-6, 7.8e-6, law});
  model::ShellProperty shell;
  shell.thickness = 0.2;
  shell.points = 3;
  m.properties.push_back({1, "", shell});
  m.parts.push_back({1, "", 0, 0, 0.0});
  return m;
}

double measure(const model::Model& m, int repetitions) {
  elements::GroupInput in;
  in.model = &m;
  in.part = 0;
  in.step_wanted = false;  // as in a run with the step of the assembled system
  for (Index e = 0; e < m.shells.size(); ++e) in.elements.push_back(e);
  const auto group = elements::make_shell_q4(in);
  parallel::ThreadPool pool(1);
  std::vector<double> sums(group->chunks().sum_count());
  std::vector<Vec3> v(m.node_x.size()), w(m.node_x.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = {1e-5 * m.node_x[i].y, -2e-5 * m.node_x[i].x, 1e-5 * m.node_x[i].z};
    w[i] = {1e-5 * m.node_x[i].x, 0.0, 1e-5};
  }
  double best = 1e30;
  for (int r = 0; r < repetitions; ++r) {
    const elements::StepInput step{m.node_x.data(), v.data(), w.data(), 0.0, r == 0 ? 0.0 : 1e-6};
    const auto begin = std::chrono::steady_clock::now();
    (void)group->step(step, {sums.data(), nullptr}, pool);
    const std::chrono::duration<double, std::nano> t = std::chrono::steady_clock::now() - begin;
    best = std::min(best, t.count() / group->size());
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 16, repetitions = argc > 2 ? std::atoi(argv[2]) : 2000;
  std::printf("law,isa,elements,ns_per_element\n");
  for (const bool plastic : {false, true}) {
    const model::Model m = plate(n, plastic);
    std::printf("%d,%s,%d,%.1f\n", plastic ? 2 : 1, std::string(simd::name(simd::active_isa())).c_str(), n * n, measure(m, repetitions));
  }
  return 0;
}
