// Faults of TYPE3 in numbers: the same scene with the plain rule (Rules::reference()) and with abut's own (Rules::standard()).
//
//   contact_faults      the rows of the table in docs/theory/contact.md, section 8, in Markdown
//
// tools/fault_table.py writes them into the page, tools/fault_table.py --check compares. The scenes are those of the tests. No time is
// measured: the numbers are the same on every machine but for rounding. About 10 s.
#include <abut/contact/inspect.hpp>
#include <cstdio>
#include <string>

#include "contact/search/incremental.hpp"
#include "unit/contact/energy_scenes.hpp"
#include "unit/contact/search_scenes.hpp"

namespace abut::contact {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

std::string percent(double share) { return number(100.0 * share) + " %"; }

void row(const char* fault, const std::string& plain, const std::string& ours) {
  std::printf("| %s | %s | %s |\n", fault, plain.c_str(), ours.c_str());
}

// Rules that differ from the plain one in the law only.
Rules plain(Law law) {
  Rules rules = Rules::reference();
  rules.law = law;
  return rules;
}
Rules standard(Law law) {
  Rules rules = Rules::standard();
  rules.law = law;
  return rules;
}

struct Misses {
  long looked = 0, plain = 0, ours = 0;
};

// Nodes slide over a surface that tumbles, now and then by some facets in a step. Plain: the nearest surface node among the last one
// and those of the facets around it, once per cycle (numerics.md 7.3.2), then a facet around that node. A miss: the facet found
// is not as near as the nearest one, for a node within a fifth of the surface's half width.
Misses search_misses(const test::Shape& shape, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  test::Host host;
  const auto main = test::grid(host, 16, 16, -1, 1, -1, 1, test::flat);
  for (Vec3& x : host.x) x = shape.at(x.x, x.y, 0.0);
  const std::vector<Vec3> at_rest = host.x;
  const std::size_t first = host.x.size();
  std::vector<Index> nodes;
  std::vector<std::array<double, 3>> place;
  for (int i = 0; i < 60; ++i) {
    place.push_back({2 * u(random) - 1, 2 * u(random) - 1, 0.2 * (u(random) - 0.5)});
    nodes.push_back(host.add(shape.at(place.back()[0], place.back()[1], place.back()[2]), 1.0));
  }
  Side surface(Surface(main), true);
  surface.set({}, false);
  Side held(nodes, std::vector<double>(nodes.size(), 1.0));
  Candidates lists;
  std::vector<Tracked> tracked(nodes.size());
  const Vec3 axis = normalized({0.3, 0.5, 0.8});
  Misses misses;
  for (int step = 0; step < 60; ++step) {
    const double slide = step % 5 == 4 ? 0.4 : 0.02;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      place[i][0] += (step % 10 < 5 ? 1.0 : -1.0) * slide;
      if (std::abs(place[i][0]) > 1.0) place[i][0] = std::copysign(0.9, place[i][0]);
      host.x[first + i] = test::rotate(shape.at(place[i][0], place[i][1], place[i][2]), axis, 0.05 * step);
    }
    for (std::size_t i = 0; i < first; ++i) host.x[i] = test::rotate(at_rest[i], axis, 0.05 * step);
    const std::vector<Vec3> surface_before(surface.x().begin(), surface.x().end()), held_before(held.x().begin(), held.x().end());
    surface.gather(host.x);
    held.gather(host.x);
    const Motion motion = motion_between(held.x(), held_before, surface.x(), surface_before);
    lists.update(
        held, surface, motion, [](Index) { return 0.25; }, 0.08, false);
    for (Index i = 0; i < held.node_count(); ++i) {
      const Vec3 x = held.x()[at(i)];
      Tracked& t = tracked[at(i)];
      const auto away = [&](Index n) { return squared_norm(surface.x()[at(n)] - x); };
      if (t.node == no_index) {
        t.node = 0;
        for (Index n = 1; n < surface.node_count(); ++n) t.node = away(n) < away(t.node) ? n : t.node;
      } else {
        const Index from = t.node;
        for (const Index f : surface.surface().facets_at(from)) {
          for (const Index n : surface.surface().local()[at(f)]) t.node = away(n) < away(t.node) ? n : t.node;
        }
      }
      t.facet = choose_facet(surface, t.node, t.facet, x);
      const Measure truth = test::brute_force(surface, x);
      if (truth.closest.beyond || std::abs(truth.distance) > 0.2) continue;
      ++misses.looked;
      const auto worse = [&](double found) { return found > std::abs(truth.distance) + 1e-9; };
      if (t.facet == no_index || worse(std::sqrt(closest_point(surface.patch(t.facet), x).squared_distance))) ++misses.plain;
      const Measure found = nearest(surface, lists, i, x, {});
      if (!found.found() || worse(std::abs(found.distance))) ++misses.ours;
    }
  }
  return misses;
}

void search() {
  Misses flat, curved;
  unsigned seed = 1;
  for (const test::Shape& shape : test::shapes()) {
    const Misses m = search_misses(shape, seed++);
    Misses& all = std::string(shape.name) == "flat" ? flat : curved;
    all.looked += m.looked;
    all.plain += m.plain;
    all.ours += m.ours;
  }
  const auto share = [](long of, long all) { return percent(static_cast<double>(of) / static_cast<double>(all)); };
  row("the search follows the surface's topology: node-steps in which it does not have the nearest facet, flat surface",
      share(flat.plain, flat.looked), std::to_string(flat.ours) + " of " + std::to_string(flat.looked));
  row("the same on cylinder, sphere, torus, folds, saddle, rough surface", share(curved.plain, curved.looked),
      std::to_string(curved.ours) + " of " + std::to_string(curved.looked));
}

void jumps() {
  for (const double curvature : {0.0, 0.01, -0.01}) {
    const test::Shots theirs = test::shoot(curvature, 1000, 5, plain(Law::constant));
    const test::Shots ours = test::shoot(curvature, 1000, 5);
    const std::string what = std::string("nodes cross a small gap in one step: shots at up to 1000 gaps per step on a ") +
                             (curvature == 0.0 ? "flat surface"
                              : curvature > 0  ? "bowl (facets turn by 0.02)"
                                               : "dome") +
                             " that do not come back, worst change of kinetic energy of the others";
    const auto said = [](const test::Shots& s) {
      return std::to_string(s.behind) + " of " + std::to_string(s.count) + ", " + percent(s.worst);
    };
    row(what.c_str(), said(theirs), said(ours));
  }
  test::Shots theirs, ours;
  for (const test::Target& t : test::folds()) {
    const auto add = [&](test::Shots& sum, const Rules& rules) {
      const test::Shots s = test::shoot(t.height, t.slack, 500, 6, rules);
      sum.count += s.count;
      sum.behind += s.behind;
      sum.beyond += s.beyond;
      sum.worst = std::max(sum.worst, s.worst);
    };
    add(theirs, plain(Law::constant));
    add(ours, Rules::standard());
  }
  const auto said = [](const test::Shots& s) {
    return std::to_string(s.behind) + " of " + std::to_string(s.count) + ", " + std::to_string(s.beyond) + ", " + percent(s.worst);
  };
  row("the same at folds of 10, 45, 90 degrees both ways, a pit and a rough surface: shots that do not come back, others whose kinetic "
      "energy changes by more than 1 %, worst",
      said(theirs), said(ours));
}

void paths() {
  double theirs[4] = {}, ours[4] = {};
  const char* names[4] = {"flat, over inner edges", "over folds of 10, 45, 90 degrees, and a saddle", "over a free border or a corner",
                          "over a change of stiffness 4:1"};
  double both[2] = {}, patch[2] = {};
  for (const test::ClosedPathCase& c : test::closed_path_cases()) {
    const bool border = c.name.find("border") != std::string::npos || c.name.find("corner") != std::string::npos;
    const bool bent = c.name.find("fold") == 0 || c.name.find("saddle") == 0;
    const std::size_t k = border ? 2 : c.jump ? 3 : bent ? 1 : 0;
    if (!(c.jump && bent)) {
      patch[0] = std::max(patch[0], test::net_of_patch(c, plain(Law::constant), 0.2, 0.06, 1000));
      patch[1] = std::max(patch[1], test::net_of_patch(c, standard(Law::stiffening), 0.2, 0.06, 8000));
    }
    for (const double part : {0.1, 0.5, 0.9}) {
      for (const Law law : {Law::stiffening, Law::constant}) {
        const double a = test::net_of_lap(c, plain(law), 0.2, 0.2 * part, 5000);
        const double b = test::net_of_lap(c, standard(law), 0.2, 0.2 * part, 40000);
        if (c.jump && bent) {
          both[0] = std::max(both[0], a);
          both[1] = std::max(both[1], b);
          continue;
        }
        theirs[k] = std::max(theirs[k], a);
        ours[k] = std::max(ours[k], b);
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string what =
        std::string("energy jumps at the edge of a gap: net work of a closed path over the largest stored energy, ") + names[k];
    row(what.c_str(), number(theirs[k]), number(ours[k]));
  }
  row("the same for a patch of 9 nodes with 4 facets of its own, two passes, all these paths", number(patch[0]), number(patch[1]));
  row("the same over inward folds of a saddle and a change of stiffness 4:1 at once", number(both[0]), number(both[1]));
  double curved[2] = {};
  for (const test::ClosedPathCase& c : test::curved_border_cases()) {
    for (const double part : {0.1, 0.5}) {
      curved[0] = std::max(curved[0], test::net_of_lap(c, plain(Law::stiffening), 0.2, 0.2 * part, 5000));
      curved[1] = std::max(curved[1], test::net_of_lap(c, standard(Law::stiffening), 0.2, 0.2 * part, 40000));
    }
  }
  row("the same over the borders of a saddle, a dome and a bowl", number(curved[0]), number(curved[1]));
}

void switching() {
  double theirs[2] = {}, ours[2] = {};
  for (const double h2k : {0.5, 0.2, 0.05}) {
    for (const double gap : {0.0, 0.1}) {
      theirs[0] = std::max(theirs[0], test::bounces(plain(Law::constant), gap, h2k).worst);
      ours[0] = std::max(ours[0], test::bounces(standard(gap > 0.0 ? Law::stiffening : Law::constant), gap, h2k).worst);
      if (h2k > 0.2) continue;
      theirs[1] = std::max(theirs[1], test::plates_meet(plain(Law::constant), gap, h2k, 0.37).worst);
      ours[1] = std::max(ours[1], test::plates_meet(standard(gap > 0.0 ? Law::stiffening : Law::constant), gap, h2k, 0.37).worst);
    }
  }
  row("contact that starts and ends inside a step makes energy: bounce of a node, h^2 K/m 0.05 to 0.5, over its kinetic energy, worst",
      percent(theirs[0]), percent(ours[0]));
  row("the same for two plates that meet with shifted meshes, h^2 K/m 0.05 and 0.2, worst", percent(theirs[1]), percent(ours[1]));
}

// Two plates fly at each other; the normals of the upper one, or of both, are the wrong way round.
struct Wrong {
  double kept = 0.0;  ///< kinetic energy after over before
  std::string codes;  ///< errors that the inspection finds
};
Wrong reversed_normals(const Rules& rules, bool both, bool turn) {
  test::Host host;
  auto lower = test::grid(host, 4, 4, -2, 2, -2, 2, test::flat, !both, false, 1.0);
  const std::size_t first = host.x.size();
  auto upper = test::grid(
      host, 4, 4, -1.7, 1.6, -1.6, 1.7, [](double, double) { return 0.8; }, true, false, 1.0);
  const double speed = 0.02;
  for (std::size_t n = 0; n < host.x.size(); ++n) host.v[n].z = n < first ? speed : -speed;
  const double before = 0.5 * static_cast<double>(host.x.size()) * speed * speed;
  InspectionInput input;
  input.side[0].facets = lower;
  input.side[1].facets = upper;
  input.gap = 0.1;
  input.x = host.x;
  input.v = host.v;
  Wrong result;
  for (const Finding& f : inspect(input)) {
    const std::string code = "`" + f.code + "`";
    if (f.severity == Severity::error && result.codes.find(code) == std::string::npos) {
      result.codes += (result.codes.empty() ? "" : ", ") + code;
    }
  }
  if (turn) {
    const Orientation o = orient(input);
    for (const Index f : o.flip[0]) lower[at(f)] = reversed(lower[at(f)]);
    for (const Index f : o.flip[1]) upper[at(f)] = reversed(upper[at(f)]);
  }
  Options o;
  o.rules = rules;
  o.gap = 0.1;
  o.stiffness_scale = 1.0;
  Interface i = Interface::two_surfaces(Surface(lower), Surface(upper), o);
  test::set_stiffness(i, 0, lower.size(), 1.0);
  test::set_stiffness(i, 1, upper.size(), 1.0);
  for (int step = 0; step < 400; ++step) host.step(i, 0.2);
  double after = 0.0;
  for (const Vec3& v : host.v) after += 0.5 * squared_norm(v);
  result.kept = after / before;
  return result;
}

void normals() {
  for (const bool both : {false, true}) {
    const Wrong theirs = reversed_normals(plain(Law::constant), both, false);
    const Wrong ours = reversed_normals(Rules::standard(), both, false);
    const Wrong turned = reversed_normals(Rules::standard(), both, true);
    const std::string what = std::string("silence with reversed normals, ") + (both ? "both surfaces" : "one surface") +
                             ": what is said before the first step; kinetic energy of two plates after they met over that before";
    row(what.c_str(), "nothing; " + number(theirs.kept),
        "error " + ours.codes + "; as they are " + number(ours.kept) + ", turned by `orient` " + number(turned.kept));
  }
}

void friction() {
  const test::SlideToRest theirs = test::slide_to_rest(plain(Law::constant));
  const test::SlideToRest ours = test::slide_to_rest(Rules::standard());
  // Without a contact term the balance is short of all that was dissipated and stored.
  row("no contact energy in the balance: a block slides to rest by friction, error of the balance over its kinetic energy",
      percent((theirs.last.friction_work + theirs.last.elastic) / theirs.kinetic), percent(std::abs(ours.last.made) / ours.kinetic));
}

}  // namespace
}  // namespace abut::contact

int main() {
  abut::contact::search();
  abut::contact::jumps();
  abut::contact::paths();
  abut::contact::switching();
  abut::contact::normals();
  abut::contact::friction();
}
