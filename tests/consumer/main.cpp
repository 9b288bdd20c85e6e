// A host of another author: two facing unit squares of its own, 0.1 of overlap, one TYPE3 interface.
//
// With gap 0.2 and one facet of stiffness 10 on each side, every node is held by a spring of
// K = s K1 K2 / (K1 + K2), K1 = 10/4 (a corner node has a quarter of its facet), K2 = 10, in both passes (T10, T13).
#include <abut/contact/interface.hpp>
#include <abut/contact/options.hpp>
#include <abut/contact/surface.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

using abut::Vec3;
namespace contact = abut::contact;

/// Two unit squares that face each other at distance `clearance`; the nodes of the upper one come last.
std::vector<Vec3> squares(double clearance) {
  std::vector<Vec3> x;
  for (const double z : {0.0, clearance}) { x.insert(x.end(), {{0.0, 0.0, z}, {1.0, 0.0, z}, {1.0, 1.0, z}, {0.0, 1.0, z}}); }
  return x;
}

int fail(const char* what, double got, double expected) {
  std::printf("consumer: %s is %.17g, expected %.17g\n", what, got, expected);
  return 1;
}

bool close(double a, double b) { return std::abs(a - b) <= 1e-12 * (1.0 + std::abs(b)); }

}  // namespace

int main() {
  const double gap = 0.2, clearance = 0.1, facet_stiffness = 10.0;
  contact::Options options;
  options.gap = gap;
  options.rules.law = contact::Law::constant;
  // The force is asked for in the first cycle, where the corrected one differs by design.
  options.rules.switch_correction = false;

  contact::Surface lower({contact::Facet{{0, 1, 2, 3}}});  // normal +z
  contact::Surface upper({contact::Facet{{4, 7, 6, 5}}});  // normal -z
  auto interface = contact::Interface::two_surfaces(lower, upper, options);
  const std::vector<double> stiffness{facet_stiffness};
  interface.set_surface(0, {.stiffness = stiffness, .thickness = {}, .active = {}});
  interface.set_surface(1, {.stiffness = stiffness, .thickness = {}, .active = {}});

  const std::vector<Vec3> x = squares(clearance), v(x.size());
  const std::vector<double> mass(x.size(), 1.0);
  std::vector<Vec3> force(x.size());
  std::vector<double> node_stiffness(x.size(), 0.0);
  const contact::HostState host{.x = x, .v = v, .mass = mass};
  interface.search(host);
  const contact::StepResult result = interface.evaluate(host, force, node_stiffness);
  interface.commit(1e-3);

  // Each of the 8 nodes is held once and, as a corner of the facet below it, takes the whole reaction of the node above.
  const double k = options.stiffness_scale * (facet_stiffness / 4) * facet_stiffness / (facet_stiffness / 4 + facet_stiffness);
  const double total = 2 * 4 * k * (gap - clearance);
  Vec3 sum, on_upper;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force[i];
    if (i >= 4) on_upper += force[i];
    if (!(node_stiffness[i] > 0.0)) return fail("a node's contact stiffness", node_stiffness[i], k);
  }
  if (!close(norm(sum), 0.0)) return fail("the sum of all forces", norm(sum), 0.0);
  if (!close(on_upper.z, total)) return fail("the force on the second surface", on_upper.z, total);
  if (!close(result.normal_force.z, total)) return fail("the reported force", result.normal_force.z, total);
  if (result.in_contact != 8) return fail("the number of nodes in contact", result.in_contact, 8);
  std::printf("consumer: 8 nodes in contact, force %.6g on the second surface\n", on_upper.z);
  return 0;
}
