// The whole truth about who touches (docs/theory/contact.md, 1 and 4a), word for word and by brute force, against an Interface: distance
// and sign, gap and offset, depth limit, nodes that come from behind, the swept test, held nodes and their wider strips.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "contact/search/swept.hpp"
#include "unit/contact/search_scenes.hpp"

namespace abut::contact::test {

/// What is said of one node, and what it remembers.
struct Truth {
  bool held = false, from_front = false;  ///< from_front: its strips widen with its depth
  Index facet = no_index;
  Vec3 normal;
  bool ignored = false;
  double offset = 0.0;
  bool touches = false, crossed = false;
  double penetration = 0.0;
};

class Oracle {
 public:
  /// @param length     #F at the start: square root of the facets' areas
  /// @param automatic  the gap is half of the surface's thickness where that is more
  Oracle(double gap, double depth_limit, Initial initial, std::vector<double> length, bool automatic)
      : gap_(gap), depth_limit_(depth_limit), initial_(initial), length_(std::move(length)), automatic_(automatic) {}

  /// @param before  the surface a step ago; x, x_before, v of the node; v_surface velocities of the surface's nodes
  void step(const Side& before, const Side& surface, const Vec3& x_before, const Vec3& x, const Vec3& v, std::span<const Vec3> v_surface,
            double dt, bool first, Truth& t) const {
    const bool was_held = t.held;
    // Held: the nearest among facets that push in about the same direction. Free: the nearest of all.
    const double strip = border_strip + (was_held && t.from_front ? border_widening : 0.0);
    HeldBy by = was_held ? HeldBy{t.facet, t.normal, strip} : HeldBy{};
    Measure m = brute_force(surface, x, by);
    const bool was_ignored = t.ignored;
    const bool here = !m.closest.beyond;  // at the outer end of a strip there is none
    const bool in_front = here && m.distance >= 0.0;
    // Initial penetration, and what is left of its offset.
    const double full = outer_gap(surface, x, m, by, strip, was_held) - m.distance;
    const double limit = depth_limit(surface, m.facet);
    if (first && initial_ == Initial::offset && m.distance >= -limit) t.offset = std::max(full, 0.0);
    if (!first) t.offset = full <= 0.0 ? 0.0 : std::min(t.offset, full);
    // From behind: ignored until it is seen in front; its gap then begins at its distance there.
    if (in_front && t.ignored) {
      t.ignored = false;
      t.offset = std::max(t.offset, std::max(full, 0.0));
    }
    double p = full - t.offset;
    bool meets = here && p > 0.0 && !(t.offset > 0.0 && t.offset >= full);
    bool was_in_front = true;  // a step ago, as seen along the normal of now
    if (p > 0.0 && !was_held) {
      Vec3 relative = v;
      for (std::size_t c = 0; c < 4; ++c) { relative -= m.closest.weight[c] * v_surface[at(surface.surface().local()[at(m.facet)][c])]; }
      const double a_step_ago = m.distance - dt * dot(relative, m.normal);
      was_in_front = a_step_ago >= -1e-10 * length_[at(m.facet)];
      if (meets && m.distance < 0.0 && -m.distance <= limit && dt > 0.0 && -a_step_ago > limit) t.ignored = true;
      if (m.distance < 0.0 && (-m.distance > limit || t.ignored)) meets = false;
    }
    // From in front to deeper than that in one step.
    t.crossed = false;
    bool lost = false;
    if (!meets && !was_held && !was_ignored && t.offset == 0.0 && dt > 0.0) {
      Index hit = no_index;
      double earliest = 2.0;
      for (Index f = 0; f < surface.facet_count(); ++f) {
        const Crossing c = crosses(before.patch(f), x_before, surface.patch(f), x);
        if (c.crossed && c.fraction < earliest) {
          earliest = c.fraction;
          hit = f;
        }
      }
      if (hit != no_index) {
        const Measure on = signed_measure(surface, hit, closest_point(surface.patch(hit), x), x);
        const Measure caught = brute_force(surface, x, {hit, on.normal});
        if (!caught.closest.beyond && caught.distance < 0.0) {
          m = caught;
          by = {hit, on.normal};
          p = outer_gap(surface, x, m, by, strip, was_held) - m.distance;
          meets = true;
          t.crossed = true;
          t.ignored = false;
        } else {
          lost = caught.closest.beyond;  // through the surface and over its border in one step
        }
      }
    }
    if (!was_held) t.from_front = was_in_front || t.crossed || first;
    // Beyond the end of the nearest strip another facet may still hold the node.
    const bool beside = !here && !lost && p > 0.0 && !t.ignored && t.offset == 0.0 && (was_held || -m.distance <= limit);
    const bool by_nearest = meets && gap(surface, m) - t.offset - m.distance > 0.0 && !faded(surface, m, m.distance, t.from_front);
    t.touches = by_nearest || ((meets || beside) && stored_elsewhere(surface, x, m, t.offset, by, strip, was_held, t.from_front));
    t.held = t.touches;
    t.penetration = t.touches ? p : 0.0;
    if (t.touches && beside) {  // as the strips of a held node show it
      const Patch wide = extended(surface, m.facet, border_strip + (t.from_front ? border_widening : 0.0));
      t.penetration = std::max(0.0, p + m.distance - signed_measure(surface, m.facet, closest_point(wide, x), x).distance);
    }
    if (!t.held) return;
    t.facet = m.facet;
    t.normal = m.normal;
  }

 private:
  double gap_, depth_limit_;
  Initial initial_;
  std::vector<double> length_;
  bool automatic_;

  [[nodiscard]] double gap(const Side& surface, const Measure& m) const {
    return automatic_ ? std::max(gap_, 0.5 * surface.thickness_at(m.facet, m.closest.weight)) : gap_;
  }
  [[nodiscard]] double depth_limit(const Side& surface, Index f) const {
    if (depth_limit_ > 0.0) return depth_limit_;
    const double half = 0.5 * length_[at(f)];
    return automatic_ ? std::min(half, std::max(surface.thickness(f), gap_)) : half;
  }

  /// Section 3: the gap by the facet whose outer face the node is deepest in, one further by D counting for g - D delta/(delta - D).
  [[nodiscard]] double outer_gap(const Side& surface, const Vec3& x, const Measure& nearest, const HeldBy& by, double strip,
                                 bool was_held) const {
    double most = gap(surface, nearest);
    if (!automatic_) return most;
    each_beside(surface, x, nearest, by, strip, was_held, [&](const Measure& m, double further) {
      const double delta = 0.25 * length_[at(m.facet)];
      if (further < delta) most = std::max(most, gap(surface, m) - further * delta / (delta - further));
      return false;
    });
    return most;
  }

  /// Section 3: a facet that is further by D on the same side stores kappa phi(P - D (1 + P/delta)), P by its own gap, delta a quarter of
  /// its length; strips widen with the depth behind the nearest. Of a held node only those count that its nearest was chosen from.
  [[nodiscard]] bool stored_elsewhere(const Side& surface, const Vec3& x, const Measure& nearest, double offset, const HeldBy& by,
                                      double strip, bool was_held, bool from_front) const {
    return each_beside(surface, x, nearest, by, strip, was_held, [&](const Measure& m, double further) {
      const double p = gap(surface, m) - offset - nearest.distance;
      return p > 0.0 && p - further * (1.0 + p / (0.25 * length_[at(m.facet)])) > 0.0 && !faded(surface, m, nearest.distance, from_front);
    });
  }

  /// Until `use(facet, how much further)` says true of one.
  template <class Use>
  bool each_beside(const Side& surface, const Vec3& x, const Measure& nearest, const HeldBy& by, double strip, bool was_held,
                   const Use& use) const {
    const bool in_front =
        by.facet != no_index && signed_measure(surface, by.facet, closest_point(extended(surface, by.facet, strip), x), x).distance >= 0.0;
    double reach = was_held ? 1e300 : std::max(gap_, automatic_ ? 0.5 * surface.largest_thickness() : 0.0);
    for (Index f = 0; f < surface.facet_count(); ++f) reach = std::max(reach, depth_limit(surface, f));
    for (Index f = 0; f < surface.facet_count(); ++f) {
      if (f == nearest.facet) continue;
      const ClosestPoint c = closest_point(extended(surface, f, strip), x);
      if (c.beyond || std::sqrt(c.squared_distance) > reach) continue;
      const Measure m = signed_measure(surface, f, c, x);
      if (m.distance * nearest.distance < 0.0 || dot(m.normal, nearest.normal) < -0.5) continue;
      if (by.facet != no_index && !(dot(m.normal, by.normal) > -0.5 || (in_front && m.distance >= 0.0))) continue;
      if (use(m, std::max(0.0, std::abs(m.distance) - std::abs(nearest.distance)))) return true;
    }
    return false;
  }

  /// T = 0: further beyond a free border than a fifth of a side and w(depth).
  [[nodiscard]] bool faded(const Side& surface, const Measure& m, double distance, bool from_front) const {
    const Patch patch = surface.patch(m.facet);
    const double x = from_front ? std::max(0.0, -distance) / length_[at(m.facet)] : 0.0;
    const double w = x < 0.1 ? 5 * x * x : x < 0.65 ? x - 0.05 : x < 1.05 ? 0.8 - 1.25 * (1.05 - x) * (1.05 - x) : 0.8;
    const double s = m.closest.s, t = m.closest.t;
    std::array<double, 4> over{-0.5 * (t + 1), 0.5 * (s - 1), 0.5 * (t - 1), -0.5 * (s + 1)};  // of sides 0 to 3, in lengths of the side
    const double ends = patch.narrow < 0.25 ? 0.0 : 0.2 * patch.narrow + w * patch.widens;
    if (patch.triangle) over = {-t, s + t - 1, -s, 0};
    for (int e = 0; e < (patch.triangle ? 3 : 4); ++e) {
      if ((patch.borders >> e & 1) != 0 && over[static_cast<std::size_t>(e)] >= ends) return true;
    }
    return false;
  }
};

struct TruthCase {
  Shape shape;
  int nu = 9, nv = 8;
  bool triangles = false;
  double gap = 0.05, depth_limit = 0.0;
  Initial initial = Initial::keep;
  int nodes = 60, steps = 60;
  unsigned seed = 1;
  bool automatic = false;  ///< facets have thicknesses of 0.5 to 2.5 times the gap, or 0.02 to 0.1 without
};
struct TruthCount {
  long node_steps = 0, touching = 0, behind = 0, crossed = 0, wrong = 0;
};

/// Nodes wander through a tumbling surface, in small steps and in leaps over its gap and depth limit, and slide over its borders.
inline TruthCount interface_against_truth(const TruthCase& c) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Host host;
  const auto main = grid(host, c.nu, c.nv, -1, 1, -1, 1, flat, true, c.triangles);
  for (Vec3& x : host.x) x = c.shape.at(x.x, x.y, 0.0);
  const std::size_t first_held = host.x.size();
  std::vector<Index> nodes;
  std::vector<Vec3> place;  // u, v, height
  for (int i = 0; i < c.nodes; ++i) {
    place.push_back({2.3 * u(random) - 1.15, 2.3 * u(random) - 1.15, 0.4 * (u(random) - 0.4)});
    nodes.push_back(host.add(c.shape.at(place.back().x, place.back().y, place.back().z)));
  }
  const std::vector<Vec3> at_rest = host.x;
  Side surface(Surface(main), true);
  std::vector<double> thickness;
  for (std::size_t f = 0; f < (c.automatic ? main.size() : 0); ++f) {
    thickness.push_back((c.gap > 0.0 ? c.gap : 0.04) * (0.5 + static_cast<double>(f * 7919 % 9) / 4.0));
  }
  surface.set({{}, thickness, {}}, false);
  surface.gather(host.x);
  std::vector<double> length;
  for (Index f = 0; f < surface.facet_count(); ++f) length.push_back(std::sqrt(surface.facet_area(f)));
  const Oracle oracle(c.gap, c.depth_limit, c.initial, length, c.automatic);
  Options options;
  options.gap = c.gap;
  options.depth_limit = c.depth_limit;
  options.initial = c.initial;
  options.automatic_gap = c.automatic;
  Interface made = Interface::nodes_to_surface(nodes, std::vector<double>(nodes.size(), 1.0), Surface(main), options);
  made.set_surface(1, {std::vector<double>(main.size(), 1.0), thickness, {}});
  std::vector<Truth> truth(nodes.size());
  const Vec3 axis = normalized({0.3, 0.5, 0.8});
  double angle = 0.0;
  Vec3 away{};
  TruthCount count;
  for (int step = 0; step < c.steps; ++step) {
    const std::vector<Vec3> old = host.x;
    std::vector<Vec3> x = at_rest;
    if (step > 0) {
      angle += step % 9 == 0 ? 0.4 : 0.01;
      away += Vec3{0.05, 0.02, -0.01};
      for (Vec3& p : place) {
        const double leap = u(random);
        const double by = leap < 0.7 ? 0.01 : leap < 0.9 ? 0.1 : 0.5;
        p += Vec3{2 * by * (u(random) - 0.5), 2 * by * (u(random) - 0.5), by * (u(random) - 0.5) - 0.15 * by * (p.z > 0 ? 1 : -1)};
        p.x = std::clamp(p.x, -1.2, 1.2);
        p.y = std::clamp(p.y, -1.2, 1.2);
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) x[first_held + i] = c.shape.at(place[i].x, place[i].y, place[i].z);
    for (Vec3& p : x) p = rotate(p, axis, angle) + away;
    const Side before = surface;
    if (step == 0) host.x = x;
    const double h = step == 0 ? 0.0 : 1.0;
    if (step == 0) {
      host.v.assign(x.size(), {});
      host.contact(made);
    } else {
      host.place(made, x, h);
    }
    surface.gather(host.x);
    std::vector<Vec3> v_surface;
    for (const Index n : surface.nodes()) v_surface.push_back(host.v[at(n)]);
    std::vector<NodalContact> said(host.x.size());
    made.add_nodal_contact(said);
    std::vector<char> touches(host.x.size(), 0), crossed(host.x.size(), 0);
    for (const Index n : made.nodes_in_contact()) touches[at(n)] = 1;
    for (const Index n : made.nodes_crossed()) crossed[at(n)] = 1;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t n = first_held + i;
      Truth& t = truth[i];
      oracle.step(before, surface, old[n], host.x[n], host.v[n], v_surface, h, step == 0, t);
      ++count.node_steps;
      count.touching += t.touches ? 1 : 0;
      count.behind += t.ignored ? 1 : 0;
      count.crossed += t.crossed ? 1 : 0;
      const bool same = t.touches == (touches[n] != 0) && t.crossed == (crossed[n] != 0) &&
                        (!t.touches || std::abs(t.penetration - said[n].penetration) < 1e-12);
      if (!same && count.wrong < 3) {
        std::printf("    step %d node %zu: truth %d (crossed %d, ignored %d) P %.17g, interface %d (crossed %d) P %.17g\n", step, i,
                    t.touches, t.crossed, t.ignored, t.penetration, touches[n], crossed[n], said[n].penetration);
      }
      count.wrong += same ? 0 : 1;
    }
  }
  return count;
}

/// All shapes, quadrilaterals and triangles, with and without gap, the default depth limit and a shallow one, both treatments at the start.
inline TruthCount all_truths(int nodes, int steps, bool automatic, const std::function<void(const TruthCase&, const TruthCount&)>& each) {
  TruthCount all;
  unsigned seed = 500;
  for (const Shape& shape : shapes()) {
    for (const bool triangles : {false, true}) {
      for (const double gap : {0.0, 0.05}) {
        for (const double depth : {0.0, 0.03}) {
          for (const Initial initial : {Initial::keep, Initial::offset}) {
            const TruthCase c{shape, 9, 8, triangles, gap, depth, initial, nodes, steps, ++seed, automatic};
            const TruthCount one = interface_against_truth(c);
            each(c, one);
            all.node_steps += one.node_steps;
            all.touching += one.touching;
            all.behind += one.behind;
            all.crossed += one.crossed;
            all.wrong += one.wrong;
          }
        }
      }
    }
  }
  return all;
}

}  // namespace abut::contact::test
