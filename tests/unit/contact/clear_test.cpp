// Interface::clear(): a host that keeps contact apart need not clear its arrays.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bench_host.hpp"

namespace abut::contact {
namespace {

using test::flat;
using test::grid;
using test::Host;

constexpr double gap = 0.1, upper_z = gap + 0.01;

/// A patch over a larger plane, the plane's facets last.
struct Scene {
  Host host;
  std::vector<Facet> lower, upper;
  std::size_t first_of_upper;

  Scene() : lower(grid(host, 6, 6, 0.0, 6.0, 0.0, 6.0, flat, true, false, 1.0)), first_of_upper(host.x.size()) {
    upper = grid(
        host, 3, 3, 1.3, 4.4, 1.4, 4.5, [](double, double) { return upper_z; }, false, false, 1.0);
  }
  [[nodiscard]] std::vector<Index> upper_nodes() const {
    std::vector<Index> nodes;
    for (std::size_t n = first_of_upper; n < host.x.size(); ++n) nodes.push_back(static_cast<Index>(n));
    return nodes;
  }
};

Interface two_surfaces(const Scene& s) {
  Options options;
  options.gap = gap;
  options.friction = 0.2;
  Interface i = Interface::two_surfaces(Surface(s.lower), Surface(s.upper), options);
  test::set_stiffness(i, 0, s.lower.size(), 100.0);
  test::set_stiffness(i, 1, s.upper.size(), 100.0);
  return i;
}
Interface nodes_to_surface(const Scene& s) {
  Options options;
  options.gap = gap;
  const auto nodes = s.upper_nodes();
  Interface i = Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 100.0), Surface(s.lower), options);
  test::set_stiffness(i, 1, s.lower.size(), 100.0);
  return i;
}
Interface both_sides(const Scene& s) {
  BothSidesOptions options;
  options.gap = gap;
  Interface i = Interface::both_sides(s.upper_nodes(), Surface(s.lower), options);
  test::set_stiffness(i, 1, s.lower.size(), 100.0);
  return i;
}

/// The patch hops on the plane, each of its nodes in its own way: contacts open and close, and in some steps there is none.
class Clear : public testing::TestWithParam<Interface (*)(const Scene&)> {};

TEST_P(Clear, TakesAwayWhatWasAddedAndNothingElse) {
  Scene s;
  Interface with = GetParam()(s), without = GetParam()(s);
  const std::size_t nodes = s.host.x.size();
  std::vector<Vec3> f(nodes + 1);  // the last node is none of the interface's
  std::vector<double> k(nodes + 1, 0.0);
  f[nodes] = {1.0, 2.0, 3.0};
  k[nodes] = 4.0;
  const std::vector<Vec3> start = s.host.x;
  int touching = 0, apart = 0;
  for (int step = 0; step < 120; ++step) {
    std::vector<Vec3> x = start;
    for (std::size_t n = s.first_of_upper; n < x.size(); ++n) {
      const double phase = 0.1 * step + (step / 40) * 0.3 * static_cast<double>(n);
      x[n] += Vec3{0.002 * step, 0.0, 0.03 * std::cos(phase) - 0.005};
    }
    with.clear(f, k);
    ASSERT_EQ(f[nodes], (Vec3{1.0, 2.0, 3.0}));
    ASSERT_EQ(k[nodes], 4.0);
    for (std::size_t n = 0; n < nodes; ++n) {
      ASSERT_EQ(f[n], Vec3{}) << "step " << step << ", node " << n;
      ASSERT_EQ(k[n], 0.0) << "step " << step << ", node " << n;
    }
    s.host.place(without, x, 0.01);  // clears all in every step
    with.search(s.host.state());
    if (step % 7 == 0 && GetParam() != both_sides) {  // a step that is tried twice
      with.evaluate(s.host.state(), f, k);
      with.clear(f, k);
      with.search(s.host.state());
    }
    const StepResult result = with.evaluate(s.host.state(), f, k);
    with.commit(s.host.dt);
    (result.in_contact > 0 ? touching : apart) += 1;
    for (std::size_t n = 0; n < nodes; ++n) {
      ASSERT_EQ(f[n], s.host.f[n]);
      ASSERT_EQ(k[n], s.host.k[n]);
    }
  }
  EXPECT_GT(touching, 10);
  EXPECT_GT(apart, 10);
}

TEST_P(Clear, RefusesArraysThatAreTooShort) {
  Scene s;
  Interface interface = GetParam()(s);
  std::vector<Vec3> f(s.host.x.size());
  std::vector<double> k(s.host.x.size() - 1);
  EXPECT_THROW(interface.clear(f, k), std::invalid_argument);
  k.resize(f.size());
  f.pop_back();
  EXPECT_THROW(interface.clear(f, k), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Clear, testing::Values(two_surfaces, nodes_to_surface, both_sides), [](const auto& p) {
  return p.param == two_surfaces ? "two_surfaces" : p.param == nodes_to_surface ? "nodes_to_surface" : "both_sides";
});

}  // namespace
}  // namespace abut::contact
