// Cost of the contact library's search and force per held node and step, without a solver around it.
//
//   contact_cost [NODES_MOST [STEPS [ONLY]]]   CSV rows: scene, motion, nodes, facets, in_contact, ns_search, ns_force, ns_step
//   ONLY, e.g. flat,resting: that surface and motion alone, in the largest size (for profilers)
//
// Two sheets of the same number of nodes face each other in one gap (one TYPE3 interface, two passes, friction 0.1), half of the gap apart,
// flat or as nested parts of cylinders. resting: nothing moves. sliding: the upper sheet moves by half a facet in every step, so the search
// has to follow. CPU time of one thread, the median over the steps after the first five. The positions are imposed: no step can run away.
#include <abut/contact/interface.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using abut::Index;
using abut::Vec3;
namespace contact = abut::contact;

double seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// n by n nodes, facets of size 1; the flat coordinates (u along the motion, w) are bent onto a cylinder of radius r + height.
class Sheet {
 public:
  Sheet(int n, double height, bool up, std::vector<Vec3>& x) : n_(n), height_(height), first_(static_cast<Index>(x.size())) {
    x.resize(x.size() + static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        const Index a = first_ + j * n + i, b = a + 1, c = b + n, d = a + n;
        facets.push_back(up ? contact::Facet{{a, b, c, d}} : contact::Facet{{a, d, c, b}});
      }
    }
  }
  /// @param radius  0: flat
  void place(double shift, double radius, std::vector<Vec3>& x) const {
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) {
        Vec3& p = x[static_cast<std::size_t>(first_ + j * n_ + i)];
        const double u = i + shift, w = j + 0.37 * (height_ > 0.0);
        if (radius > 0.0) {
          p = {(radius + height_) * std::sin(u / radius), w, (radius + height_) * std::cos(u / radius)};
        } else {
          p = {u, w, height_};
        }
      }
    }
  }
  std::vector<contact::Facet> facets;

 private:
  int n_;
  double height_;
  Index first_;
};

void measure(bool curved, bool sliding, int nodes, int steps) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(nodes / 2.0))));
  const double gap = 0.1, radius = curved ? 2.0 * n / 3.0 : 0.0;
  std::vector<Vec3> x;
  const Sheet lower(n, 0.0, true, x), upper(n, 0.5 * gap, false, x);
  lower.place(0.0, radius, x);
  upper.place(0.31, radius, x);
  std::vector<Vec3> v(x.size()), before, force(x.size());
  std::vector<double> stiffness(x.size()), mass(x.size(), 1.0), k(lower.facets.size(), 1.0);
  contact::Options options;
  options.gap = gap;
  options.friction = 0.1;
  auto interface = contact::Interface::two_surfaces(contact::Surface(lower.facets), contact::Surface(upper.facets), options);
  for (const int side : {0, 1}) interface.set_surface(side, {.stiffness = k});
  const double dt = 1.0;
  std::vector<double> search, evaluate;
  Index touching = 0;
  for (int step = 0; step < steps; ++step) {
    before = x;
    if (sliding) upper.place(0.31 + 0.5 * step, radius, x);
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = (x[i] - before[i]) / dt;
    std::fill(force.begin(), force.end(), Vec3{});
    std::fill(stiffness.begin(), stiffness.end(), 0.0);
    const contact::HostState host{x, v, mass, step * dt, step > 0 ? dt : 0.0, dt};
    const double start = seconds();
    interface.search(host);
    const double searched = seconds();
    touching = interface.evaluate(host, force, stiffness).in_contact;
    interface.commit(dt);
    const double end = seconds();
    if (step < 5) continue;
    search.push_back(searched - start);
    evaluate.push_back(end - searched);
  }
  const double per = 1e9 / static_cast<double>(x.size());
  const double s = per * median(search), e = per * median(evaluate);
  std::printf("%s,%s,%zu,%zu,%d,%.1f,%.1f,%.1f\n", curved ? "curved" : "flat", sliding ? "sliding" : "resting", x.size(),
              2 * lower.facets.size(), touching, s, e, s + e);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 1000000, steps = argc > 2 ? std::atoi(argv[2]) : 25;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf("surface,motion,nodes,facets,in_contact,ns_search,ns_force,ns_step\n");
  for (const bool curved : {false, true}) {
    for (const bool sliding : {false, true}) {
      if (!only.empty() && only != std::string(curved ? "curved," : "flat,") + (sliding ? "sliding" : "resting")) continue;
      for (int nodes = only.empty() ? 1000 : most; nodes <= most; nodes *= 10) measure(curved, sliding, nodes, steps);
    }
  }
  return 0;
}
