// Cost of the brick kernel alone: ns per element and step for each instruction set of this CPU, chunk sums included.
//
//   kernel_brick [cells per edge] [repetitions]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "elements/solid/solid_group.hpp"
#include "model/model.hpp"
#include "parallel/thread_pool.hpp"

namespace {

using namespace abut;

struct Scene {
  model::Model model;
  std::vector<Vec3> x, v;
};

Scene cube(int n, int law, int iframe) {
  Scene s;
  const auto node = [n](int i, int j, int k) { return static_cast<Index>((k * (n + 1) + j) * (n + 1) + i); };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        s.model.node_x.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        s.model.node_id.push_back(static_cast<Id>(s.model.node_id.size()) + 1);
      }
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        s.model.bricks.id.push_back(static_cast<Id>(s.model.bricks.id.size()) + 1);
        s.model.bricks.part.push_back(0);
        s.model.bricks.nodes.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
                                        node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
      }
  model::LawJohnsonCook jc;
  jc.young = 210.0;
  jc.poisson = 0.3;
  jc.a = 0.3;
  jc.b = 0.5;
  jc.n = 0.4;
  model::Law material = model::LawElastic{210.0, 0.3};
  if (law == 2) material = jc;
  s.model.materials.push_back({1, "", 7.8, 7.8, material});
  model::SolidProperty p;
  p.iframe = iframe;
  s.model.properties.push_back({1, "", p});
  s.model.parts.push_back({1, "", 0, 0, 0.0});
  s.x = s.model.node_x;
  s.v.assign(s.x.size(), Vec3{});
  for (std::size_t i = 0; i < s.v.size(); ++i) s.v[i] = {1e-3 * s.x[i].y, -2e-3 * s.x[i].x, 1e-3 * s.x[i].z};
  return s;
}

double measure(Scene& s, const Profile& profile, simd::Isa isa, int repetitions) {
  elements::GroupInput in;
  in.model = &s.model;
  in.part = 0;
  in.profile = profile;
  in.step_wanted = false;  // as in a run with the step of the assembled system; the reference profile has it anyway
  for (Index e = 0; e < s.model.bricks.size(); ++e) in.elements.push_back(e);
  const auto group = elements::make_brick8(in);
  dynamic_cast<elements::SolidGroup&>(*group).use_kernel(elements::brick8_kernel(isa));
  parallel::ThreadPool pool(1);
  std::vector<double> sums(group->chunks().sum_count());
  elements::StepInput step;
  step.x = s.x.data();
  step.v = s.v.data();
  double best = 1e30;
  for (int r = 0; r < repetitions; ++r) {
    step.dt = r == 0 ? 0.0 : 1e-3;
    const auto begin = std::chrono::steady_clock::now();
    group->step(step, {sums.data(), nullptr}, pool);
    const std::chrono::duration<double, std::nano> t = std::chrono::steady_clock::now() - begin;
    best = std::min(best, t.count() / group->size());
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 30, repetitions = argc > 2 ? std::atoi(argv[2]) : 40;
  std::vector<simd::Isa> isas{simd::Isa::sse2};
  if (__builtin_cpu_supports("avx2")) isas.push_back(simd::Isa::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    isas.push_back(simd::Isa::avx512);
  std::printf("law,iframe,profile,isa,ns_per_element\n");
  for (const int law : {1, 2}) {
    for (const int iframe : {1, 2}) {
      Scene s = cube(n, law, iframe);
      for (const bool reference : {false, true}) {
        const Profile profile = reference ? Profile::reference() : Profile::standard();
        for (const simd::Isa isa : isas) {
          std::printf("%d,%d,%s,%s,%.1f\n", law, iframe, reference ? "reference" : "standard", std::string(name(isa)).c_str(),
                      measure(s, profile, isa, repetitions));
        }
      }
    }
  }
  return 0;
}
