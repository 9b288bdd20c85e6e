// Determinism: the same bits from the scalar build of the kernel, from every instruction set of this CPU and from any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "elements/brick8/brick_kernel.hpp"
#include "elements/solid/solid_group.hpp"
#include "elements/tetra4/tetra_kernel.hpp"
#include "solid_fixture.hpp"

namespace abut::elements::test {
namespace {

void scalar_brick(const SolidTask& task) { brick_step<double>(task); }
void scalar_tetra(const SolidTask& task) { tetra_step<double>(task); }

struct Case {
  int isolid = 1, iframe = 1, ismstr = 4, law = 1, vp = 2;
  bool reference = false, tetra = false;
};

/// Everything that a run leaves behind, after a few steps of a violent motion.
std::vector<double> run(const Case& c, SolidKernel kernel, int threads) {
  SolidSetup s;
  s.threads = threads;
  s.property.isolid = c.isolid;
  s.property.iframe = c.iframe;
  s.property.ismstr = c.ismstr;
  if (c.reference) s.profile = Profile::reference();
  if (c.law == 2) {
    model::LawJohnsonCook law;
    law.young = 210.0;
    law.poisson = 0.3;
    law.a = 0.3;
    law.b = 0.5;
    law.n = 0.37;
    law.c = 0.02;
    law.eps_rate_0 = 1e-4;
    law.vp = c.vp;
    law.cutoff = 10.0;
    law.rho_cp = 1e-3;
    law.t_melt = 1500.0;
    law.m = 0.9;
    law.eps_max = 0.3;
    s.law = law;
  }
  Random random(21);
  Box box(9, 7, 6, {1, 1.1, 0.9});
  for (Vec3& p : box.nodes) p += 0.15 * random.vec();
  std::vector<std::vector<Index>> elements;
  for (const auto& b : box.bricks) {
    if (c.tetra) {
      elements.push_back({b[0], b[1], b[3], b[4]});
      elements.push_back({b[6], b[5], b[2], b[7]});
    } else {
      elements.push_back(b);
    }
  }
  SolidBody body(box.nodes, elements, s);
  dynamic_cast<SolidGroup&>(*body.group).use_kernel(kernel);
  for (Vec3& v : body.v) v = 0.5 * random.vec();
  std::vector<double> all;
  for (int i = 0; i < 12; ++i) {
    const GroupResult r = i == 0 ? body.step(0.0) : body.advance(0.02);
    all.insert(all.end(), {r.step, r.internal_energy, r.hourglass_energy, static_cast<double>(r.step_element)});
    EXPECT_EQ(r.bad_element, no_index);
  }
  for (const auto& h : body.group->history()) all.insert(all.end(), h.begin(), h.end());
  all.insert(all.end(), body.slots.begin(), body.slots.end());
  return all;
}

std::size_t differing(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += std::memcmp(&a[i], &b[i], sizeof(double)) != 0 ? 1U : 0U;
  return n;
}

std::vector<simd::Isa> available() {
  std::vector<simd::Isa> all{simd::Isa::sse2};
  if (__builtin_cpu_supports("avx2")) all.push_back(simd::Isa::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    all.push_back(simd::Isa::avx512);
  return all;
}

TEST(SolidBits, EveryInstructionSetAndThreadCount) {
  const Case cases[] = {{},
                        {2, 1, 4, 2, 2},
                        {1, 2, 4, 2, 1},
                        {1, 2, 1, 1, 2, true},
                        {1, 1, 4, 2, 3, true},
                        {1, 1, 1, 1, 2},
                        {1, 1, 4, 1, 2, false, true},
                        {1, 1, 4, 2, 2, true, true}};
  for (const Case& c : cases) {
    const auto scalar = run(c, c.tetra ? scalar_tetra : scalar_brick, 1);
    for (const simd::Isa isa : available()) {
      const SolidKernel kernel = c.tetra ? tetra4_kernel(isa) : brick8_kernel(isa);
      EXPECT_EQ(differing(scalar, run(c, kernel, 1)), 0U) << name(isa);
    }
    for (const int threads : {2, 3, 8}) EXPECT_EQ(differing(scalar, run(c, c.tetra ? scalar_tetra : scalar_brick, threads)), 0U);
  }
}

}  // namespace
}  // namespace abut::elements::test
