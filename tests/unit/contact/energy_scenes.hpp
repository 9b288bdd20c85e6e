// Scenes for the energy of contact: bounces, plates that meet, closed paths, a block that rubs. Shared by the tests and by
// bench/contact_faults, which writes the table of faults in docs/theory/contact.md.
#pragma once

#include <cstdio>
#include <random>
#include <string>

#include "unit/contact/bench_host.hpp"

namespace abut::contact::test {

struct Bounce {
  double mean = 0.0, worst = 0.0;
};

// A free node falls on a rigid surface and leaves; |CX| over its kinetic energy for random phases of the step.
inline Bounce bounces(Rules rules, double gap, double hhk, double free_mass = 0.0) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double k = 1.0, mass = 1.0, speed = 0.01;
  const double h = std::sqrt(hhk * mass / k);
  Bounce result;
  const int shots = 300;
  for (int shot = 0; shot < shots; ++shot) {
    Host host;
    auto facets = grid(host, 1, 1, -1, 1, -1, 1, flat, true, false, free_mass);
    const Index n = host.add({0.1, 0.2, gap + speed * h * (2.0 + uniform(random))}, mass, {0, 0, -speed});
    Options o;
    o.rules = rules;
    o.gap = gap;
    o.stiffness_scale = 1.0;
    Interface i = Interface::nodes_to_surface({n}, {2.0}, Surface(facets), o);
    set_stiffness(i, 1, 1, 2.0);
    bool touched = false;
    for (int step = 0; step < 400; ++step) {
      host.step(i, h);
      touched = touched || host.last.in_contact > 0;
      if (touched && host.last.in_contact == 0) break;
    }
    const double error = std::abs(host.last.made) / (0.5 * mass * speed * speed);
    result.mean += error / shots;
    result.worst = std::max(result.worst, error);
  }
  return result;
}

// Two plates of free nodes meet flat: both passes act on every node at once.
inline Bounce plates_meet(Rules rules, double gap, double hhk, double shift) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double k = 1.0, speed = 0.01;
  const double h = std::sqrt(hhk / k);
  Bounce result;
  const int shots = 100;
  for (int shot = 0; shot < shots; ++shot) {
    Host host;
    const auto lower = grid(host, 4, 4, -2, 2, -2, 2, flat, true, false, 1.0);
    const std::size_t first = host.x.size();
    const double start = gap + 2 * speed * h * (2.0 + uniform(random));
    const auto upper = grid(
        host, 4, 4, -2 + shift, 2 + shift, -2, 2, [&](double, double) { return start; }, false, false, 1.0);
    for (std::size_t n = 0; n < host.x.size(); ++n) host.v[n].z = n < first ? speed : -speed;
    Options o;
    o.rules = rules;
    o.gap = gap;
    o.stiffness_scale = 0.5;
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
    set_stiffness(i, 0, lower.size(), k);
    set_stiffness(i, 1, upper.size(), k);
    bool touched = false;
    for (int step = 0; step < 200; ++step) {
      host.step(i, h);
      touched = touched || host.last.in_contact > 0;
      if (touched && host.last.in_contact == 0) break;
    }
    const double error = std::abs(host.last.made) / (0.5 * static_cast<double>(host.x.size()) * speed * speed);
    result.mean += error / shots;
    result.worst = std::max(result.worst, error);
  }
  return result;
}

// A facet of free nodes, or several, falls on one immobile facet: only one of the passes has anything to hold.
inline Bounce on_a_large_facet(double gap, double hhk, int facets) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double speed = 0.01, pair = 0.5 / facets / facets;  // at the corners: two equal springs of 1/4 in series, over facets^2
  const double h = std::sqrt(hhk / pair);
  Bounce result;
  const int shots = 100;
  for (int shot = 0; shot < shots; ++shot) {
    Host host;
    const auto lower = grid(host, 1, 1, -3, 3, -3, 3, flat);
    const std::size_t first = host.x.size();
    const double start = gap + speed * h * (2.0 + uniform(random));
    const auto upper = grid(
        host, facets, facets, -1, 1, -1, 1, [&](double, double) { return start; }, false, false, 1.0);
    for (std::size_t n = first; n < host.x.size(); ++n) host.v[n].z = -speed;
    Options o;
    o.gap = gap;
    o.stiffness_scale = 1.0;
    Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
    set_stiffness(i, 0, lower.size(), pair);
    set_stiffness(i, 1, upper.size(), pair);
    bool touched = false;
    for (int step = 0; step < 200; ++step) {
      host.step(i, h);
      touched = touched || host.last.in_contact > 0;
      if (touched && host.last.in_contact == 0) break;
    }
    const double error = std::abs(host.last.made) / (0.5 * static_cast<double>(host.x.size() - first) * speed * speed);
    result.mean += error / shots;
    result.worst = std::max(result.worst, error);
  }
  return result;
}

struct Path {
  double net = 0.0;      ///< |CX| after the closed path
  double largest = 0.0;  ///< largest CE on it
  double bound =
      0.0;  ///< sum of |df . dx|/2: what trapezoidal work can miss of a force that changes from one value to the next within a step
};

// One node dragged along a closed path without friction: CX over the lap.
/// @param thickness  #F: the gap is half of it where that is more; empty: none
inline Path lap(Rules rules, double gap, const std::vector<Facet>& facets, const std::vector<double>& stiffness, Host host,
                const std::function<Vec3(double)>& where, int steps, const std::vector<double>& thickness = {}) {
  Options o;
  o.rules = rules;
  o.rules.switch_correction = false;  // a path walked at no speed
  o.gap = gap;
  o.automatic_gap = !thickness.empty();
  o.stiffness_scale = 1.0;
  const Index n = host.add(where(0.0), 1.0);
  Interface i = Interface::nodes_to_surface({n}, {1.0}, Surface(facets), o);
  i.set_surface(1, {stiffness, thickness, {}});
  std::vector<Vec3> x = host.x;
  host.contact(i);
  Path path;
  for (int s = 1; s <= steps; ++s) {
    Vec3& node = x[static_cast<std::size_t>(n)];
    const Vec3 before = node, force_before = host.f[static_cast<std::size_t>(n)];
    node = where(static_cast<double>(s) / steps);
    host.place(i, x);
    path.largest = std::max(path.largest, host.last.elastic);
    path.bound += 0.5 * std::abs(dot(host.f[static_cast<std::size_t>(n)] - force_before, node - before));
  }
  path.net = std::abs(host.last.made);
  return path;
}

inline double fold_height(double x, double angle_degrees, bool convex) {
  const double slope = std::tan(angle_degrees * std::acos(-1.0) / 360.0);  // each half by half the angle
  return (convex ? -1.0 : 1.0) * slope * std::abs(x);
}

/// A surface over [-2.5, 2.5]^2 of 6 x 6 facets and an ellipse above it.
struct ClosedPathCase {
  std::string name;
  std::function<double(double, double)> height;
  bool jump;  ///< right half four times as stiff
  double centre_x, centre_y, rx, ry;
};

inline std::vector<ClosedPathCase> closed_path_cases() {
  std::vector<ClosedPathCase> cases;
  cases.push_back({"flat, inner edges", flat, false, 0.1, 0.05, 1.2, 0.9});
  cases.push_back({"flat, stiffness 4:1", flat, true, 0.1, 0.05, 1.2, 0.9});
  cases.push_back({"flat, off and over the border", flat, false, 2.2, 0.05, 1.2, 0.9});
  cases.push_back({"flat, over the corner", flat, false, 1.9, 1.8, 1.1, 1.2});
  for (const double angle : {10.0, 45.0, 90.0}) {
    for (const bool convex : {true, false}) {
      const std::string name = "fold " + std::to_string(static_cast<int>(angle)) + (convex ? " convex" : " concave");
      cases.push_back({name, [angle, convex](double x, double) { return fold_height(x, angle, convex); }, false, 0.1, 0.05, 1.2, 0.9});
    }
  }
  cases.push_back(
      {"fold 45 convex, over the border", [](double x, double) { return fold_height(x, 45.0, true); }, false, 0.1, 1.8, 1.2, 0.9});
  cases.push_back({"saddle", [](double x, double y) { return 0.1 * x * x - 0.1 * y * y; }, false, 0.1, 0.05, 1.2, 0.9});
  cases.push_back({"saddle and stiffness 4:1", [](double x, double y) { return 0.1 * x * x - 0.1 * y * y; }, true, 0.1, 0.05, 1.2, 0.9});
  return cases;
}

inline std::vector<ClosedPathCase> curved_border_cases() {
  return {{"saddle, y border", [](double x, double y) { return 0.1 * x * x - 0.1 * y * y; }, false, 0.1, 1.9, 1.2, 1.2},
          {"dome, x border", [](double x, double y) { return std::sqrt(25.0 - x * x - y * y) - 5.0; }, false, 1.7, 0.05, 1.2, 1.2},
          {"bowl, x border", [](double x, double y) { return 8.0 - std::sqrt(64.0 - x * x - y * y); }, false, 1.7, 0.05, 1.2, 1.2}};
}

/// Where the node is at 0 <= u <= 1: down on one spot, along three eighths of an ellipse at a changing depth, up on another, and back
/// through the air.
inline Vec3 on_closed_path(const ClosedPathCase& c, double gap, double p, double u) {
  const double lift = gap + 0.8;
  const double a = 0.4 + 0.75 * std::acos(-1.0) * std::clamp((u - 0.15) / 0.7, 0.0, 1.0);
  const double depth = u < 0.15 ? 1.0 - u / 0.15 : u > 0.85 ? (u - 0.85) / 0.15 : 0.0;
  const double x = c.centre_x + c.rx * std::cos(a);
  const double y = c.centre_y + c.ry * std::sin(a);
  return {x, y, c.height(x, y) + gap - p * (0.8 + 0.2 * std::sin(5.0 * u)) + depth * lift};
}

/// One node along that path over a surface of 6 x 6 facets.
inline Path walk(const ClosedPathCase& c, Rules rules, double gap, double p, int steps) {
  Host host;
  const auto facets = grid(host, 6, 6, -2.5, 2.5, -2.5, 2.5, c.height);  // the crease x = 0 is a line of nodes
  std::vector<double> stiffness(facets.size(), 1.0);
  if (c.jump) {
    for (std::size_t f = 0; f < facets.size(); ++f) stiffness[f] = f % 6 < 3 ? 1.0 : 4.0;
  }
  return lap(
      rules, gap, facets, stiffness, host, [&](double u) { return on_closed_path(c, gap, p, u); }, steps);
}

/// Net work over the largest stored energy of a lap.
inline double net_of_lap(const ClosedPathCase& c, Rules rules, double gap, double p, int steps) {
  const Path path = walk(c, rules, gap, p, steps);
  return path.largest > 0.0 ? path.net / path.largest : 0.0;
}

/// A lap over a random surface, at a random place and depth, half of them over a change of stiffness.
struct RandomLap {
  ClosedPathCase path;
  Rules rules = Rules::standard();
  double gap = 0.0, p = 0.0;
};
inline std::vector<RandomLap> random_laps(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::vector<RandomLap> laps;
  for (int lap = 0; lap < count; ++lap) {
    const double bend = 0.03 + 0.12 * u(random), angle = 10.0 + 80.0 * u(random);
    const std::vector<std::function<double(double, double)>> heights{
        [bend](double x, double y) { return bend * (x * x - y * y); },
        [bend](double x, double y) { return -bend * (x * x + y * y); },
        [bend](double x, double y) { return bend * (x * x + y * y); },
        [angle](double x, double) { return fold_height(x, angle, true); },
        [angle](double x, double) { return fold_height(x, angle, false); },
        [bend](double x, double y) { return bend * (std::sin(2 * x + 1.7 * y) + std::cos(2.3 * y - 1.1 * x)); }};
    RandomLap one;
    const bool jump = u(random) < 0.5;
    one.gap = u(random) < 0.35 ? 0.0 : 0.2;
    one.p = one.gap > 0.0 ? one.gap * (0.1 + 0.8 * u(random)) : 0.02 + 0.13 * u(random);
    one.rules.law = one.gap > 0.0 && u(random) < 0.5 ? Law::stiffening : Law::constant;
    one.path = {"",
                heights[static_cast<std::size_t>(lap) % heights.size()],
                jump,
                4 * u(random) - 2,
                4 * u(random) - 2,
                0.6 + 0.8 * u(random),
                0.6 + 0.8 * u(random)};
    laps.push_back(std::move(one));
  }
  return laps;
}

/// The same for a rigid patch of 3 x 3 nodes, 0.5 wide, that faces the surface: two surfaces, two passes. Its lowest node follows the path.
inline double net_of_patch(const ClosedPathCase& c, Rules rules, double gap, double p, int steps) {
  constexpr double half = 0.25;
  Host host;
  const auto facets = grid(host, 6, 6, -2.5, 2.5, -2.5, 2.5, c.height);
  std::vector<double> stiffness(facets.size(), 1.0);
  if (c.jump) {
    for (std::size_t f = 0; f < facets.size(); ++f) stiffness[f] = f % 6 < 3 ? 1.0 : 4.0;
  }
  const std::size_t first = host.x.size();
  const auto patch = grid(host, 2, 2, -half, half, -half, half, flat, false, false, 1.0);
  const std::vector<Vec3> at_rest = host.x;
  const auto place = [&](double u) {
    Vec3 to = on_closed_path(c, gap, p, u);
    double rise = -1e300;
    for (std::size_t n = first; n < at_rest.size(); ++n) rise = std::max(rise, c.height(to.x + at_rest[n].x, to.y + at_rest[n].y));
    to.z += rise - c.height(to.x, to.y);
    std::vector<Vec3> x = at_rest;
    for (std::size_t n = first; n < x.size(); ++n) x[n] += to;
    return x;
  };
  Options o;
  o.rules = rules;
  o.rules.switch_correction = false;  // a path walked at no speed
  o.gap = gap;
  o.stiffness_scale = 1.0;
  Interface i = Interface::two_surfaces(Surface(facets), Surface(patch), o);
  i.set_surface(0, {stiffness, {}, {}});
  set_stiffness(i, 1, patch.size(), 1.0);
  host.x = place(0.0);
  host.contact(i);
  double largest = 0.0;
  for (int s = 1; s <= steps; ++s) {
    host.place(i, place(static_cast<double>(s) / steps));
    largest = std::max(largest, host.last.elastic);
  }
  return largest > 0.0 ? std::abs(host.last.made) / largest : 0.0;
}

/// A block of free nodes thrown on a rubbing surface, under a weight of 1 per node.
struct SlideToRest {
  double kinetic = 0.0, left = 0.0;  ///< of motion along the surface, before and after
  StepResult last;
};

inline SlideToRest slide_to_rest(Rules rules) {
  Host host;
  const auto main = grid(host, 40, 4, -1, 9, -1, 1, flat);
  const std::size_t first = host.x.size();
  const auto block = grid(
      host, 3, 3, 0.0, 0.6, -0.3, 0.3, [](double, double) { return -1e-3; }, false, false, 1.0);
  Options o;
  o.rules = rules;
  o.friction = 0.3;
  o.stiffness_scale = 1.0;
  const double k = 2000.0;
  Interface i = Interface::two_surfaces(Surface(main), Surface(block), o);
  set_stiffness(i, 0, main.size(), k);
  set_stiffness(i, 1, block.size(), k);
  SlideToRest result;
  for (std::size_t n = first; n < host.x.size(); ++n) {
    host.v[n] = {2.0, 0.08, 0.0};
    result.kinetic += 0.5 * squared_norm(host.v[n]);
  }
  for (int s = 0; s < 8000; ++s) {
    host.step(i, 1e-3, [first](Host& h) {
      for (std::size_t n = first; n < h.x.size(); ++n) h.f[n].z -= 1.0;
    });
  }
  for (std::size_t n = first; n < host.x.size(); ++n) result.left += 0.5 * (host.v[n].x * host.v[n].x + host.v[n].y * host.v[n].y);
  result.last = host.last;
  return result;
}

}  // namespace abut::contact::test
