// What a surface says about itself: topology, orientation, shape of its facets.
#include <algorithm>
#include <cmath>

#include "contact/inspect/findings.hpp"

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double degrees_between(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)) * (180.0 / 3.141592653589793); }

std::string percent(double share) { return short_number(100.0 * share) + " %"; }

void sort_unique(std::vector<Index>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

// Which facets of each mixed piece to reverse: those whose orientation faces away, or the smaller part.
std::vector<Index> facets_to_flip(const Shape& shape, const std::vector<std::array<PieceVote, 2>>& votes) {
  std::vector<std::array<double, 2>> area(votes.size(), {0.0, 0.0});
  for (Index f = 0; f < shape.count(); ++f) area[at(shape.piece(f))][shape.turned(f)] += shape.area(f);
  std::vector<Index> flip;
  for (Index f = 0; f < shape.count(); ++f) {
    const auto p = at(shape.piece(f));
    if (area[p][0] == 0.0 || area[p][1] == 0.0) continue;
    const bool turn_turned = votes[p][0].score != 0.0 ? votes[p][0].score > 0.0 : area[p][1] <= area[p][0];
    if (shape.turned(f) == turn_turned) flip.push_back(f);
  }
  return flip;
}

}  // namespace

void find_topology(const InspectionContext& c) {
  std::vector<Index> shared;
  const auto first = c.shapes[0].nodes(), second = c.shapes[1].nodes();
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
  if (!shared.empty() && !c.input.both_sides) {
    Finding& f = c.add(Severity::error, "contact.shared_nodes", -1);
    f.measure_name = "shared nodes";
    f.measure = static_cast<double>(shared.size());
    f.what = counted(shared.size(), "node lies", "nodes lie") + " on both sides";
    f.advice = "A node may belong to one side only: separate the meshes, or take the shared facets out of one surface.";
    f.nodes = std::move(shared);
  }
  for (int k = 0; k < 2; ++k) {
    const Shape& s = c.shapes[at(k)];
    if (s.is_nodes()) continue;
    c.add_facets(Severity::error, "contact.degenerate_facets", k, s.degenerate(),
                 {"segment has", "segments have", "no area, hence no normal",
                  "Give each segment three or four distinct nodes that are not on one line (a triangle repeats its third node)."});
    c.add_facets(Severity::error, "contact.duplicate_facets", k, s.duplicates(),
                 {"segment is", "segments are", "on the same nodes as an earlier one",
                  "List each segment once: a second one would double the contact stiffness, or cancel the first one's normal."});
    c.add_facets(Severity::warning, "contact.junctions", k, s.at_junctions(),
                 {"segment meets", "segments meet", "others at an edge of more than two",
                  "Take one branch of each junction out of the surface (a wall that stands on a plate), or give it a surface of its own."});
    std::vector<Index> soft;
    for (std::size_t i = 0; i < s.side().stiffness.size(); ++i) {
      if (!(s.side().stiffness[i] > 0.0)) soft.push_back(static_cast<Index>(i));
    }
    const double share = static_cast<double>(soft.size()) / static_cast<double>(s.count());
    const Severity severity = soft.size() == at(s.count()) ? Severity::error : Severity::warning;
    c.add_facets(severity, "contact.no_stiffness", k, std::move(soft),
                 {"segment lies", "segments lie", "on no shell or brick with stiffness",
                  "Nothing pushes back there: use faces of shells or bricks with E > 0, or leave these segments out."},
                 {"share of facets", share});
  }
}

namespace {

// Facets that look out of their solid and see the other side behind them: they cannot be reversed. Where others of their side stand or
// overlap before the other one, a body beside or below the contact is nothing to speak of.
void find_behind_solids(const InspectionContext& c, int k, std::vector<Index> behind) {
  const Views& view = c.views.side[at(k)];
  if (view.facing.area_facing > 0.0 || std::any_of(view.overlaps.begin(), view.overlaps.end(), [](std::uint8_t o) { return o != 0; }))
    return;
  c.add_facets(
      Severity::error, "contact.normals_away", k, std::move(behind),
      {"segment looks", "segments look",
       "out of the solid behind and away from the other side, up to " + short_number(view.away_distance) + " away; none faces it",
       "Contact would not be felt there: take the faces that meet the other side, or separate the bodies if they overlap by that much."},
      {"facing fraction", 0.0});
}

void find_away(const InspectionContext& c, int k, const std::vector<std::array<PieceVote, 2>>& votes) {
  const Shape& s = c.shapes[at(k)];
  const Views& view = c.views.side[at(k)];
  const double fraction = view.facing.fraction();
  std::vector<Index> away, partly, alike, behind;
  for (Index f = 0; f < s.count(); ++f) {
    if (view.alike[at(f)] != 0) alike.push_back(f);
    if (view.facing.facet[at(f)] >= 0) continue;
    const PieceVote& vote = votes[at(s.piece(f))][s.turned(f)];
    if (s.out_of_solid(f) > 0) {
      behind.push_back(f);
      continue;
    }
    (vote.away > vote.facing ? away : partly).push_back(f);
  }
  if (!away.empty()) {
    const bool all = view.facing.area_facing == 0.0;
    Finding& f = c.add(Severity::error, "contact.normals_away", k);
    f.measure_name = "facing fraction";
    f.measure = fraction;
    f.what = all ? "the normals point away from the other side on all of the " + counted(away.size(), "segment", "segments") + " near it"
                 : counted(away.size(), "segment", "segments") + " near the other side have their normals pointing away from it (" +
                       percent(fraction) + " of the surface near it faces)";
    f.what += ", up to " + short_number(view.away_distance) + " away";
    f.advice =
        "Contact would not be felt there: reverse these segments (or run with --orient auto); if instead the surfaces overlap by "
        "that much at the start, separate them.";
    f.facets = std::move(away);
  }
  find_behind_solids(c, k, std::move(behind));
  c.add_facets(Severity::error, "contact.normals_alike", k, std::move(alike),
               {"segment touches", "segments touch", "the other side with a normal that points the same way",
                "One of the two surfaces is the wrong way round: reverse the one whose normals point into its own body."});
  double partly_area = 0.0;
  for (const Index f : partly) partly_area += s.area(f);
  if (partly_area > 0.1 * (view.facing.area_facing + view.facing.area_away)) {
    c.add_facets(
        Severity::warning, "contact.partly_away", k, std::move(partly),
        {"segment", "segments",
         "of a surface that faces the other side on the whole see it behind them, up to " + short_number(view.away_distance) + " deep",
         "Take out segments that cannot touch, or remove the overlap there."},
        {"facing fraction", fraction});
  }
}

}  // namespace

void find_orientation(const InspectionContext& c) {
  for (int k = 0; k < 2; ++k) {
    const Shape& s = c.shapes[at(k)];
    if (s.is_nodes()) continue;
    const auto votes = piece_votes(s, c.views.side[at(k)].facing);
    find_away(c, k, votes);
    std::vector<Index> one_sided;
    for (Index f = 0; f < s.count(); ++f) {
      if (s.one_sided(s.piece(f))) one_sided.push_back(f);
    }
    const bool cut_first = !one_sided.empty();
    c.add_facets(Severity::warning, "contact.one_sided", k, std::move(one_sided),
                 {"segment belongs", "segments belong", "to a surface that has only one side (as a Moebius band)",
                  "No choice of normals makes it face alike everywhere: cut it, and use the part that is touched."});
    if (cut_first) continue;
    const auto unlike = std::count_if(s.shared_edges().begin(), s.shared_edges().end(), [](const Shape::Shared& e) { return !e.alike; });
    std::vector<Index> flip = facets_to_flip(s, votes);
    if (flip.empty()) continue;
    Finding& f = c.add(Severity::warning, "contact.mixed_orientation", k);
    f.measure_name = "edges between unlike normals";
    f.measure = static_cast<double>(unlike);
    f.what = "the normals are mixed: " + counted(flip.size(), "segment is", "segments are") + " the other way round than those beside";
    f.advice = "Reverse these segments, or run with --orient auto.";
    f.facets = std::move(flip);
  }
}

void find_shape(const InspectionContext& c) {
  for (int k = 0; k < 2; ++k) {
    const Shape& s = c.shapes[at(k)];
    if (s.is_nodes()) continue;
    std::vector<Index> thin, warped, folded;
    double worst_aspect = 0.0, worst_warp = 0.0, worst_fold = 0.0;
    for (Index f = 0; f < s.count(); ++f) {
      if (squared_norm(s.normal(f)) == 0.0) continue;
      const int corners = s.facet(f).corners();
      double shortest = 1e300, longest = 0.0;
      for (int e = 0; e < corners; ++e) {
        const double length = norm(s.corner(f, (e + 1) % corners) - s.corner(f, e));
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
      }
      const double aspect = longest / shortest;
      worst_aspect = std::max(worst_aspect, aspect);
      if (aspect > c.limits.aspect_ratio) thin.push_back(f);
      if (corners < 4) continue;
      const Vec3 n1 = cross(s.corner(f, 1) - s.corner(f, 0), s.corner(f, 2) - s.corner(f, 0));
      const Vec3 n2 = cross(s.corner(f, 2) - s.corner(f, 0), s.corner(f, 3) - s.corner(f, 0));
      const double warp = degrees_between(n1, n2);
      worst_warp = std::max(worst_warp, warp);
      if (warp > c.limits.warp_degrees) warped.push_back(f);
    }
    for (const Shape::Shared& e : s.shared_edges()) {
      if (!e.alike || c.input.both_sides) continue;
      const Vec3 n0 = s.normal(e.facet[0]), n1 = s.normal(e.facet[1]);
      const double angle = degrees_between(n0, n1);
      const Vec3 across = s.centre(e.facet[1]) - s.centre(e.facet[0]);
      if (angle <= c.limits.concave_degrees || dot(n0, across) - dot(n1, across) <= 0.0) continue;
      worst_fold = std::max(worst_fold, angle);
      folded.insert(folded.end(), e.facet.begin(), e.facet.end());
    }
    sort_unique(folded);
    c.add_facets(Severity::warning, "contact.aspect_ratio", k, std::move(thin),
                 {"segment is", "segments are",
                  "more than " + short_number(c.limits.aspect_ratio) + " times as long as wide, at worst " + short_number(worst_aspect),
                  "Regular meshes of good aspect ratio are asked for: refine the long direction or coarsen the short one."},
                 {"largest aspect ratio", worst_aspect});
    c.add_facets(Severity::warning, "contact.warp", k, std::move(warped),
                 {"segment is", "segments are",
                  "warped by more than " + short_number(c.limits.warp_degrees) + " degrees, at worst " + short_number(worst_warp),
                  "Split them into triangles or refine the mesh there: a warped segment has no single normal."},
                 {"largest warp in degrees", worst_warp});
    c.add_facets(Severity::note, "contact.concave", k, std::move(folded),
                 {"segment lies", "segments lie",
                  "at an inward fold of up to " + short_number(worst_fold) + " degrees: the surface is not simply convex",
                  "abut's standard profile searches concave surfaces exactly; in the reference profile, split the surface at the fold."},
                 {"largest inward fold in degrees", worst_fold});
  }
}

}  // namespace abut::contact
