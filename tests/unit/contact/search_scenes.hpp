// Random pairs of surface and nodes for the search, and shots for the swept test: short in the default tests, at full counts in
// the suites named ...Full.
#pragma once

#include <functional>
#include <random>

#include "contact/search/nearest.hpp"
#include "unit/contact/bench_host.hpp"

namespace abut::contact::test {

/// Truth word for word (docs/theory/contact.md, 1): over all faces, edges and corners the smallest |distance|; for a held node only among
/// facets that push in about the same direction, or that it is in front of while it is in front of its own.
inline Measure brute_force(const Side& surface, const Vec3& x, const HeldBy& held = {}) {
  Measure best;
  double smallest = 1e300;
  bool in_front = false;
  if (held.facet != no_index) {
    best = signed_measure(surface, held.facet, closest_point(extended(surface, held.facet, held.strip), x), x);
    smallest = std::sqrt(best.closest.squared_distance);
    in_front = best.distance >= 0.0;
  }
  for (Index f = 0; f < surface.facet_count(); ++f) {
    const ClosestPoint c = closest_point(extended(surface, f, held.strip), x);
    const double distance = std::sqrt(c.squared_distance);
    if (distance >= smallest) continue;
    const Measure m = signed_measure(surface, f, c, x);
    if (held.facet != no_index && !(dot(m.normal, held.normal) > -0.5 || (in_front && m.distance >= 0.0))) continue;
    smallest = distance;
    best = m;
  }
  return best;
}

inline Vec3 rotate(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (dot(axis, v) * (1 - c)) * axis;
}

/// Maps (u, v) in [-1, 1]^2 and a height above it to space; size of the whole about 2.
struct Shape {
  const char* name;
  std::function<Vec3(double, double, double)> at;
};

inline Vec3 over(double u, double v, double w) { return {u, v, w}; }

inline std::vector<Shape> shapes() {
  const double pi = std::acos(-1.0);
  return {{"flat", over},
          {"cylinder",
           [pi](double u, double v, double w) {
             return Vec3{(0.5 + w) * std::cos(0.9 * pi * u), v, (0.5 + w) * std::sin(0.9 * pi * u)};
           }},
          {"sphere",
           [pi](double u, double v, double w) {
             const double a = 0.9 * pi * u, b = 0.4 * pi * v, r = 0.7 + w;
             return Vec3{r * std::cos(b) * std::cos(a), r * std::cos(b) * std::sin(a), r * std::sin(b)};
           }},
          {"torus",
           [pi](double u, double v, double w) {
             const double a = 0.95 * pi * u, b = 0.95 * pi * v, r = 0.3 + w;
             return Vec3{(0.8 + r * std::cos(b)) * std::cos(a), (0.8 + r * std::cos(b)) * std::sin(a), r * std::sin(b)};
           }},
          {"folded", [](double u, double v, double w) { return over(u, v, w + 0.4 * std::abs(std::sin(4 * u)) + 0.2 * std::abs(v)); }},
          {"saddle", [](double u, double v, double w) { return over(u, v, w + 0.3 * (u * u - v * v)); }},
          {"rough", [](double u, double v, double w) {
             return over(u, v, w + 0.05 * std::sin(31 * u + 17 * v) + 0.04 * std::cos(23 * v - 11 * u));
           }}};
}

struct SearchCase {
  Shape shape;
  int nu = 12, nv = 10;
  bool triangles = false;
  double stretch = 1.0;  ///< neighbouring facets grow by this factor in all over the surface: size ratio within it
  int nodes = 60, steps = 30;
  unsigned seed = 1;
  double strip = border_strip;
};

struct SearchCount {
  long node_steps = 0, compared = 0, wrong = 0;
};

/// Surface and nodes tumble, slide over many facets and shake; every node is looked for as a free one and as one that is held by what it
/// found in the step before.
inline SearchCount search_against_brute_force(const SearchCase& c) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Host host;
  const auto graded = [&c](double p) {  // -1..1 to -1..1, cells grow geometrically
    return c.stretch == 1.0 ? p : 2.0 * (std::pow(c.stretch, 0.5 * (p + 1.0)) - 1.0) / (c.stretch - 1.0) - 1.0;
  };
  const auto main = grid(host, c.nu, c.nv, -1, 1, -1, 1, flat, true, c.triangles);
  for (Vec3& x : host.x) x = c.shape.at(graded(x.x), graded(x.y), 0.0);
  const std::size_t first_held = host.x.size();
  std::vector<Index> nodes;
  std::vector<double> at_u, at_v, above;
  for (int i = 0; i < c.nodes; ++i) {
    at_u.push_back(2.2 * u(random) - 1.1);
    at_v.push_back(2.2 * u(random) - 1.1);
    above.push_back(0.3 * (u(random) - 0.5));
    nodes.push_back(host.add({}, 1.0));
  }
  const std::vector<Vec3> at_rest = host.x;
  Side surface(Surface(main), true);
  surface.set({}, false);
  Side held(nodes, std::vector<double>(nodes.size(), 1.0));
  Candidates lists;
  const Vec3 axis = normalized({0.3, 0.5, 0.8});
  const double reach = 0.3;
  double angle = 0.0;
  Vec3 away{};
  std::vector<HeldBy> by(nodes.size());
  SearchCount count;
  for (int step = 0; step < c.steps; ++step) {
    angle += step % 7 == 0 ? 0.9 : 0.01;
    away += Vec3{0.05, 0.02, -0.01};
    const double slide = step % 5 == 0 ? 0.4 : 0.003;  // in (u, v): many facets, or a part of one
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      at_u[i] += (step % 10 < 5 ? 1.0 : -1.0) * slide + 0.004 * (u(random) - 0.5);
      at_v[i] += 0.002 * (u(random) - 0.5);
      above[i] += 0.004 * (u(random) - 0.5);
      host.x[first_held + i] = c.shape.at(at_u[i], at_v[i], above[i]);
    }
    for (std::size_t i = 0; i < host.x.size(); ++i) { host.x[i] = rotate(i < first_held ? at_rest[i] : host.x[i], axis, angle) + away; }
    const std::vector<Vec3> surface_before(surface.x().begin(), surface.x().end()), held_before(held.x().begin(), held.x().end());
    surface.gather(host.x);
    held.gather(host.x);
    const Motion motion = motion_between(held.x(), held_before, surface.x(), surface_before);
    const double margin = c.strip > border_strip ? 1.5 * (c.strip - border_strip) * surface.mean_size() * std::sqrt(c.stretch) : 0.0;
    lists.update(
        held, surface, motion, [&](Index) { return reach + margin; }, 0.08, false);
    for (Index i = 0; i < held.node_count(); ++i) {
      const Vec3 x = held.x()[at(i)];
      HeldBy& mine = by[at(i)];
      for (const bool is_held : {false, true}) {
        if (is_held && mine.facet == no_index) continue;
        const HeldBy who = is_held ? mine : HeldBy{};
        const Measure truth = brute_force(surface, x, who);
        const Measure found = nearest(surface, lists, i, x, who);
        ++count.node_steps;
        if (std::abs(truth.distance) > reach) continue;
        ++count.compared;
        if (found.found() && found.distance == truth.distance && found.normal == truth.normal) continue;
        // The same distance from another facet (a shared edge, an inward fold) is the same answer to rounding.
        const bool same = found.found() && std::abs(found.distance - truth.distance) < 1e-13;
        if (!same) ++count.wrong;
      }
      const Measure free = nearest(surface, lists, i, x, {});
      mine = free.found() && std::abs(free.distance) <= reach ? HeldBy{free.facet, free.normal, c.strip} : HeldBy{};
    }
  }
  return count;
}

/// T29: nodes that would jump through in one step are caught, pushed back, end in front, and keep their energy.
struct Shots {
  int count = 0, caught = 0, behind = 0, beyond = 0;  ///< beyond: more than 1 % off in energy
  double worst = 0.0;                                 ///< change of a node's kinetic energy over what it came with
};

/// Half of the shots on a surface without gap, up to two facets per step, half with one, up to 1000 gaps per step. Shots of about the same
/// speed share an interface: the surface does not move, so that they know nothing of each other, and slow ones keep their lists.
/// @param height  of the surface, facets of size 1
/// @param slack   the facets lie above it by up to this
/// @param count   shots per half
/// @param hhk     h^2 K/m of the stiffest part of the law; shots at softer springs are slower, so that they go as deep
inline Shots shoot(const std::function<double(double, double)>& height, double slack, int count, unsigned seed,
                   const Rules& rules = Rules::standard(), double hhk = 0.2) {
  constexpr int together = 250;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Shots result;
  Host plate;
  const auto main = grid(plate, 24, 24, -12, 12, -12, 12, height);
  const std::size_t first = plate.x.size();
  for (const double gap : {0.0, 2e-3}) {
    for (int done = 0; done < count; done += together) {
      Host host = plate;
      const int shots = std::min(together, count - done);
      std::vector<Index> nodes;
      for (int shot = 0; shot < shots; ++shot) {
        const double speed = (done + shots * u(random)) / count;  // 0 slowest, 1 fastest of all
        const double fastest = gap > 0.0 ? gap * std::pow(10.0, 3.0 * speed) : std::pow(10.0, -3.0 + 3.3 * speed);
        const double per_step = std::sqrt(5.0 * hhk) * fastest;
        const Vec3 aim{2 * u(random) - 1, 2 * u(random) - 1, 0};
        const Vec3 direction = normalized({u(random) - 0.5, u(random) - 0.5, -1.0});
        const Vec3 start = aim - (1.0 + u(random)) * per_step * direction;
        nodes.push_back(host.add({start.x, start.y, start.z + height(start.x, start.y) + gap + 0.05 + slack}, 1.0, per_step * direction));
      }
      Options o;
      o.gap = gap;
      o.rules = rules;
      o.stiffness_scale = 1.0;
      const double k = gap > 0.0 ? 0.01 * hhk : hhk;
      Interface i = Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 2.0 * k), Surface(main), o);
      set_stiffness(i, 1, main.size(), 2.0 * k);
      const std::vector<Vec3> came(host.v.begin() + static_cast<std::ptrdiff_t>(first), host.v.end());
      enum State : char { coming, touching, left, left_behind };
      std::vector<char> state(nodes.size(), coming);
      int flying = shots;
      for (int step = 0; step < 4000 && flying > 0; ++step) {
        host.step(i, 1.0);
        result.caught += host.last.crossed;
        std::vector<char> touches(host.x.size(), 0);
        for (const Index n : i.nodes_in_contact()) touches[static_cast<std::size_t>(n)] = 1;
        for (std::size_t s = 0; s < state.size(); ++s) {
          if (touches[first + s] != 0) {
            if (state[s] >= left) ++flying;  // it has come back
            state[s] = touching;
          } else if (state[s] == touching) {
            const Vec3 end = host.x[first + s];
            const Vec3 v = host.v[first + s];
            constexpr double d = 1e-6;
            const double slope_x = (height(end.x + d, end.y) - height(end.x - d, end.y)) / (2 * d);
            const double slope_y = (height(end.x, end.y + d) - height(end.x, end.y - d)) / (2 * d);
            const double normal_speed = v.z - slope_x * v.x - slope_y * v.y;
            const bool over = std::max(std::abs(end.x), std::abs(end.y)) < 12.0;  // else it slid off the border
            const bool behind = over && end.z < height(end.x, end.y) - slack;
            if (over && normal_speed <= 0.0) continue;  // on its way to the other side of a fold, or through: the next step tells
            --flying;
            state[s] = behind ? left_behind : left;
          }
        }
      }
      result.count += shots;
      for (std::size_t s = 0; s < state.size(); ++s) {
        if (state[s] != left) ++result.behind;  // behind, never touched, or never left
        if (state[s] != left) continue;
        const double change = std::abs(squared_norm(host.v[first + s]) / squared_norm(came[s]) - 1.0);
        result.worst = std::max(result.worst, change);
        if (change > 0.01) ++result.beyond;
      }
    }
  }
  return result;
}

struct Target {
  const char* name;
  std::function<double(double, double)> height;
  double slack;
};

inline std::vector<Target> folds() {
  const auto fold = [](double degrees, double sign) {
    const double slope = std::tan(degrees * std::acos(-1.0) / 360.0);
    return [slope, sign](double x, double) { return sign * slope * std::abs(x); };
  };
  const auto rough = [](double x, double y) { return 0.05 * std::sin(3 * x + 1.7 * y) + 0.04 * std::cos(2.3 * y - 1.1 * x); };
  const auto pit = [](double x, double y) { return 0.4 * std::max(std::abs(x), std::abs(y)); };
  return {{"fold 10 convex", fold(10, -1), 1e-9},
          {"fold 10 concave", fold(10, 1), 1e-9},
          {"fold 45 convex", fold(45, -1), 1e-9},
          {"fold 45 concave", fold(45, 1), 1e-9},
          {"fold 90 convex", fold(90, -1), 1e-9},
          {"fold 90 concave", fold(90, 1), 1e-9},
          {"pit", pit, 0.3},
          {"rough", rough, 0.1}};
}

/// z = curvature (x^2 + y^2): in front of its facets, which lie above it by up to a quarter of the curvature, is well in front of this.
inline Shots shoot(double curvature, int count, unsigned seed, const Rules& rules = Rules::standard()) {
  return shoot([curvature](double x, double y) { return curvature * (x * x + y * y); }, 0.6 * std::abs(curvature), count, seed, rules);
}

}  // namespace abut::contact::test
