// Shell kernels: the same bits for every number type, for the production kernels, and for any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "elements/shell_c0/kernel.hpp"
#include "elements/shell_common/setup.hpp"
#include "elements/shell_q4/kernel.hpp"
#include "simd/isa.hpp"
#include "unit/elements/shell_support.hpp"

namespace abut::elements {
// The production kernels (kernel.isa.cpp).
namespace sse2 {
void q4_elastic(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);
void q4_johnson_cook(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);
void c0_johnson_cook(const ShellKernelArgs&, const C0Parameters&, double, std::size_t, std::size_t);
}  // namespace sse2
namespace avx2 {
void q4_elastic(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);
void q4_johnson_cook(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);
void c0_johnson_cook(const ShellKernelArgs&, const C0Parameters&, double, std::size_t, std::size_t);
}  // namespace avx2
}  // namespace abut::elements

namespace abut::elements::test {
namespace {

/// Three blocks of random elements with their own arrays, driven without a group.
struct Arrays {
  ShellSection section;
  Q4Parameters q;
  C0Parameters c;
  std::vector<double> x, v, w, state, constants, slots, steps;
  std::vector<std::int32_t> nodes;
  static constexpr std::size_t blocks = 3;

  Arrays(int form, ShellLaw law, int iplas, bool bound) {
    ShellModel s({210.0, 0.3, 7.8e-6}, 0.1);
    s.property().ishell = std::min(form, 4);
    s.property().iplas = iplas;
    s.property().points = 3;
    s.property().thickness_changes = true;
    s.property().dm = 0.05;
    if (law == ShellLaw::johnson_cook) {
      auto& j = s.johnson_cook();
      j.a = 0.05;
      j.b = 0.5;
      j.n = 0.4;
      j.c = 0.05;
      j.eps_rate_0 = 1e-6;
      j.kinematic = 0.3;
      j.eps_max = 0.02;
    }
    GroupInput in;
    in.model = &s.model;
    in.part = 0;
    section = *make_section(in, form == 3);
    q.ishell = std::min(form, 4);
    q.step_bound = bound;
    q.plain_gamma = form == 2;
    q.at_hourglass = section.variables;
    q.at_hourglass_old = section.variables + 3;
    section.variables += 8;
    c.step_bound = bound;
    const std::size_t per = form <= 4 ? 4 : 3;
    std::mt19937 random(41);
    std::uniform_real_distribution<double> d(-1.0, 1.0);
    for (std::size_t e = 0; e < 8 * blocks; ++e) {
      for (const Vec3& p : random_quad(random, 0.2, 1.0, 0.1)) {
        for (int i = 0; i < 3; ++i) x.push_back(p[i]);
      }
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      v.push_back(0.02 * d(random));
      w.push_back(0.02 * d(random));
    }
    state.assign(blocks * static_cast<std::size_t>(section.variables) * 8, 0.0);
    constants.assign(blocks * shell_constant::triangle_count * 8, 1.0);
    slots.assign(blocks * per * 64, 0.0);
    steps.assign(blocks * 8, 0.0);
    nodes.resize(blocks * per * 8);
    for (std::size_t e = 0; e < 8 * blocks; ++e) {
      for (std::size_t k = 0; k < per; ++k) nodes[(e / 8 * per + k) * 8 + e % 8] = static_cast<std::int32_t>(3 * (4 * e + k));
      const auto put = [&](int which, double value) {
        state[(e / 8 * static_cast<std::size_t>(section.variables) + static_cast<std::size_t>(which)) * 8 + e % 8] = value;
      };
      put(shell_state::thickness, 0.1);
      put(shell_state::off, e % 11 == 5 ? 0.0 : 1.0);
      for (int k = 0; section.at_points >= 0 && k < 3; ++k) put(section.at_points + k * section.point_size + 4, 0.05);
    }
  }
  ShellKernelArgs args() {
    ShellKernelArgs a;
    a.x = x.data();
    a.v = v.data();
    a.w = w.data();
    a.h = 0.01;
    a.section = &section;
    a.state = state.data();
    a.nodes = nodes.data();
    a.constants = constants.data();
    a.slots = slots.data();
    a.slot_stride = slots.size() / blocks;
    a.steps = steps.data();
    a.step_stride = 8;
    return a;
  }
  void move() {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.01 * v[i];
  }
  [[nodiscard]] bool same(const Arrays& b) const {
    const auto equal = [](const std::vector<double>& p, const std::vector<double>& r) {
      return p.size() == r.size() && std::memcmp(p.data(), r.data(), p.size() * sizeof(double)) == 0;
    };
    return equal(state, b.state) && equal(slots, b.slots) && equal(steps, b.steps);
  }
  [[nodiscard]] double largest(int variable) const {
    double m = 0.0;
    for (std::size_t e = 0; e < 8 * blocks; ++e) {
      m = std::max(m, state[(e / 8 * static_cast<std::size_t>(section.variables) + static_cast<std::size_t>(variable)) * 8 + e % 8]);
    }
    return m;
  }
};

template <class T, ShellLaw law>
Arrays run_header(int form, int iplas, bool bound, int steps) {
  Arrays a(form, law, iplas, bound);
  for (int n = 0; n < steps; ++n) {
    const ShellKernelArgs args = a.args();
    if (form <= 4)
      q4_blocks<T, law>(args, a.q, 0.95, 0, Arrays::blocks);
    else
      c0_blocks<T, law>(args, a.c, 0.95, 0, Arrays::blocks);
    a.move();
  }
  return a;
}

TEST(ShellWidths, EveryNumberTypeGivesTheSameBits) {
  constexpr int steps = 60;
  for (int form = 1; form <= 5; ++form) {
    for (const bool bound : {true, false}) {
      const Arrays elastic = run_header<double, ShellLaw::elastic>(form, 2, bound, steps);
      EXPECT_TRUE(elastic.same(run_header<simd::Pack<2>, ShellLaw::elastic>(form, 2, bound, steps))) << form;
      EXPECT_TRUE(elastic.same(run_header<simd::Pack<4>, ShellLaw::elastic>(form, 2, bound, steps))) << form;
      EXPECT_TRUE(elastic.same(run_header<simd::Pack<8>, ShellLaw::elastic>(form, 2, bound, steps))) << form;
      for (const int iplas : {1, 2, 3}) {
        const Arrays plastic = run_header<double, ShellLaw::johnson_cook>(form, iplas, bound, steps);
        // The path holds what it is meant to hold: plastic strain, elements on their way out.
        EXPECT_GT(plastic.largest(plastic.section.at_points + 3), 0.01);
        EXPECT_TRUE(plastic.same(run_header<simd::Pack<2>, ShellLaw::johnson_cook>(form, iplas, bound, steps))) << form << iplas;
        EXPECT_TRUE(plastic.same(run_header<simd::Pack<4>, ShellLaw::johnson_cook>(form, iplas, bound, steps))) << form << iplas;
        EXPECT_TRUE(plastic.same(run_header<simd::Pack<8>, ShellLaw::johnson_cook>(form, iplas, bound, steps))) << form << iplas;
      }
    }
  }
}

TEST(ShellWidths, ProductionKernelsGiveTheBitsOfTheScalar) {
  const auto production = [](auto kernel, int form, const auto& parameters_of, ShellLaw law) {
    Arrays a(form, law, 1, true);
    for (int n = 0; n < 60; ++n) {
      kernel(a.args(), parameters_of(a), 0.95, 0, Arrays::blocks);
      a.move();
    }
    return a;
  };
  const auto q4 = [](Arrays& a) -> const Q4Parameters& { return a.q; };
  const auto c0 = [](Arrays& a) -> const C0Parameters& { return a.c; };
  const Arrays elastic = run_header<double, ShellLaw::elastic>(1, 1, true, 60);
  const Arrays plastic = run_header<double, ShellLaw::johnson_cook>(1, 1, true, 60);
  const Arrays triangle = run_header<double, ShellLaw::johnson_cook>(5, 1, true, 60);
  EXPECT_TRUE(elastic.same(production(sse2::q4_elastic, 1, q4, ShellLaw::elastic)));
  EXPECT_TRUE(plastic.same(production(sse2::q4_johnson_cook, 1, q4, ShellLaw::johnson_cook)));
  EXPECT_TRUE(triangle.same(production(sse2::c0_johnson_cook, 5, c0, ShellLaw::johnson_cook)));
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "no AVX2 here";
  EXPECT_TRUE(elastic.same(production(avx2::q4_elastic, 1, q4, ShellLaw::elastic)));
  EXPECT_TRUE(plastic.same(production(avx2::q4_johnson_cook, 1, q4, ShellLaw::johnson_cook)));
  EXPECT_TRUE(triangle.same(production(avx2::c0_johnson_cook, 5, c0, ShellLaw::johnson_cook)));
}

// Same bits for any number of threads.
TEST(ShellWidths, ThreadsDoNotMatter) {
  ShellModel s({210.0, 0.3, 7.8e-6}, 0.1);
  std::mt19937 random(43);
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  const int n = 40;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) s.node({i + 0.1 * d(random), j + 0.1 * d(random), 0.1 * d(random)});
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      const Index k = j * (n + 1) + i;
      s.quad(k, k + 1, k + n + 2, k + n + 1);
    }
  }
  s.johnson_cook().a = 0.05;
  std::vector<Vec3> v, w;
  for (std::size_t k = 0; k < s.model.node_x.size(); ++k) {
    v.push_back({d(random), d(random), d(random)});
    w.push_back({d(random), d(random), d(random)});
  }
  const auto run = [&](int threads) {
    Runner r(s, true);
    parallel::ThreadPool pool(threads);
    GroupResult g;
    for (int i = 0; i < 3; ++i) g = r.group->step({r.x.data(), v.data(), w.data(), 0.0, 1e-3}, {nullptr, r.slots.data()}, pool);
    const auto h = r.group->history();
    std::vector<double> all(h[0].begin(), h[0].end());
    all.insert(all.end(), r.slots.begin(), r.slots.end());
    all.insert(all.end(), {g.step, g.internal_energy, g.hourglass_energy, static_cast<double>(g.step_element)});
    return all;
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(3));
  EXPECT_EQ(one, run(8));
}

}  // namespace
}  // namespace abut::elements::test
