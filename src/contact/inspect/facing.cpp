#include "contact/inspect/facing.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double clear_cosine = 0.5;  // less than this between normal and line of sight decides nothing
constexpr double clear_share = 0.25;  // less than this net share of the votes decides nothing
constexpr double touching = 1e-6;     // of the facets' size: no line of sight

// How far is looked: a hair beyond the reach.
double within(double smallest, double margin) { return (1.0 + 1e-9) * (smallest + margin); }

struct Votes {
  double sum = 0.0, weight = 0.0;
};

double size_of(const Shape& s, Index f) { return std::sqrt(s.area(f)); }

// Nearest points of `b` to the centres of `a`, of all that are not farther than the smallest of these distances, which is looked for on the
// way, by more than `margin`.
std::vector<NearPoint> sights(const Shape& a, const Shape& b, double margin, double& smallest) {
  std::vector<NearPoint> out(at(a.count()));
  Index last = no_index;
  for (Index i = 0; i < a.count(); ++i) {
    const NearPoint p = out[at(i)] = b.nearest(a.centre(i), within(smallest, margin), no_index, last);
    if (!p.found()) continue;
    smallest = std::min(smallest, std::sqrt(p.squared));
    last = p.item;
  }
  return out;
}

class Looker {
 public:
  /// @param out  nearest points of the other side to the own centres; `in` the reverse
  Looker(const Shape& own, const Shape& other, std::span<const NearPoint> out, std::span<const NearPoint> in, double reach)
      : own_(own), other_(other), out_(out), in_(in), reach_(reach), votes_(at(own.count())) {
    views_.overlaps.assign(at(own.count()), 0);
    views_.alike.assign(at(own.count()), 0);
  }

  Views run() {
    for (Index f = 0; f < own_.count(); ++f) from_own(f);
    for (Index g = 0; g < other_.count(); ++g) from_other(g);
    Facing& facing = views_.facing;
    facing.facet.assign(at(own_.count()), 0);
    for (Index f = 0; f < own_.count(); ++f) {
      const Votes& v = votes_[at(f)];
      if (v.weight == 0.0 || std::abs(v.sum) < clear_share * v.weight) continue;
      facing.facet[at(f)] = v.sum > 0.0 ? 1 : -1;
      (v.sum > 0.0 ? facing.area_facing : facing.area_away) += own_.area(f);
    }
    return std::move(views_);
  }

 private:
  const Shape& own_;
  const Shape& other_;
  std::span<const NearPoint> out_, in_;
  double reach_;
  std::vector<Votes> votes_;
  Views views_;

  // The facet looks from its centre at the nearest point of the other side.
  void from_own(Index f) {
    if (squared_norm(own_.normal(f)) == 0.0) return;
    const Vec3 centre = own_.centre(f);
    const NearPoint& p = out_[at(f)];
    if (p.squared > reach_ * reach_ || own_.hides(centre, p.point, f)) return;
    vote(f, p.point - centre, p.item);
  }

  // The centre of a facet of the other side (or a held node) is seen from its nearest point on this one.
  void from_other(Index g) {
    const Vec3 centre = other_.centre(g);
    const NearPoint& p = in_[at(g)];
    if (p.squared > reach_ * reach_ || squared_norm(own_.normal(p.item)) == 0.0 || other_.hides(centre, p.point, g)) return;
    vote(p.item, centre - p.point, g);
  }

  void vote(Index f, const Vec3& sight, Index seen) {
    const Vec3 normal = own_.normal(f);
    const double distance = norm(sight);
    if (distance <= touching * size_of(own_, f)) {
      touch(f, seen);
      return;
    }
    const double cosine = dot(normal, sight) / distance;
    if (std::abs(cosine) < clear_cosine) return;
    if (cosine < 0.0 && own_.outward(f) > 0 && distance < 0.5 * size_of(own_, f) && !(is_shell(f) && along(f, seen) > clear_cosine)) {
      views_.overlaps[at(f)] = 1;  // the surfaces of two bodies have passed each other: their normals are right
      return;
    }
    if (cosine < 0.0) views_.away_distance = std::max(views_.away_distance, distance);
    votes_[at(f)].sum += cosine;
    votes_[at(f)].weight += std::abs(cosine);
  }

  // A closed piece of shells: which of its sides is touched depends on whether the other body is around it or within it.
  [[nodiscard]] bool is_shell(Index f) const { return own_.out_of_solid(f) == 0; }

  // Cosine between a facet's normal and that out of the other side's body there; 0 where this is not known.
  [[nodiscard]] double along(Index f, Index seen) const {
    return other_.is_nodes() ? 0.0 : other_.outward(seen) * dot(own_.normal(f), other_.normal(seen));
  }

  // Without a distance there is no line of sight: bodies tell which side is out, two shells only whether they agree.
  void touch(Index f, Index seen) {
    const int outward = own_.outward(f);
    if (outward != 0) {
      const double cosine = is_shell(f) ? along(f, seen) : 0.0;
      const int side = cosine > clear_cosine ? -1 : (cosine < -clear_cosine ? 1 : outward);
      votes_[at(f)].sum += side;
      votes_[at(f)].weight += 1.0;
    } else if (!other_.is_nodes() && dot(own_.normal(f), other_.normal(seen)) > clear_cosine) {
      views_.alike[at(f)] = 1;
    }
  }
};

}  // namespace

namespace {

BothViews empty_views(const std::array<Shape, 2>& shapes) {
  BothViews out;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto n = at(shapes[k].count());
    if (!shapes[k].is_nodes()) out.side[k].facing.facet.assign(n, 0);
    out.side[k].overlaps.assign(n, 0);
    out.side[k].alike.assign(n, 0);
  }
  return out;
}

// How much farther than the smallest distance facets count as near.
double margin_of(const std::array<Shape, 2>& shapes, double gap) {
  double size = 1e300;
  for (const Shape& s : shapes) {
    if (!s.is_nodes()) size = std::min(size, s.mean_size());
  }
  return std::max(gap, 2.0 * size);
}

}  // namespace

BothViews look(const std::array<Shape, 2>& shapes, double gap) {
  BothViews out = empty_views(shapes);
  if (shapes[0].count() == 0 || shapes[1].count() == 0) return out;
  const double margin = margin_of(shapes, gap);
  out.smallest = 1e150;
  std::array<std::vector<NearPoint>, 2> seen;
  for (std::size_t k = 0; k < 2; ++k) seen[k] = sights(shapes[k], shapes[1 - k], margin, out.smallest);
  out.reach = out.smallest + margin;
  const double radius = within(out.smallest, margin);
  for (std::vector<NearPoint>& points : seen) {
    for (NearPoint& p : points) {
      if (p.squared > radius * radius) p = {};
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (!shapes[k].is_nodes()) out.side[k] = Looker(shapes[k], shapes[1 - k], seen[k], seen[1 - k], out.reach).run();
  }
  return out;
}

std::array<Facing, 2> BothViews::take_facing() {
  for (Views& v : side) v.facing.distance = smallest;
  return {std::move(side[0].facing), std::move(side[1].facing)};
}

BothViews look_unsigned(const std::array<Shape, 2>& shapes, std::span<const Vec3> x, double gap) {
  BothViews out = empty_views(shapes);
  if (shapes[0].count() == 0 || shapes[1].count() == 0) return out;
  double squared = 1e300;
  for (const Index n : shapes[0].nodes()) {
    // Never farther than what is known already: the search stays short.
    const NearPoint p = shapes[1].nearest(x[at(n)], squared < 1e300 ? std::sqrt(squared) : 1e150, n);
    if (p.found()) squared = std::min(squared, p.squared);
  }
  if (squared == 1e300) return out;
  out.smallest = std::sqrt(squared);
  out.reach = out.smallest + margin_of(shapes, gap);
  return out;
}

std::vector<std::array<PieceVote, 2>> piece_votes(const Shape& shape, const Facing& facing) {
  std::vector<std::array<PieceVote, 2>> votes(at(shape.piece_count()));
  for (Index f = 0; f < shape.count(); ++f) {
    const int answer = facing.facet[at(f)];
    if (answer == 0 || (answer < 0 && shape.out_of_solid(f) > 0)) continue;  // what looks out of its solid is not the wrong way round
    auto& piece = votes[at(shape.piece(f))];
    const bool turned = shape.turned(f);
    (answer > 0 ? piece[turned].facing : piece[turned].away) += shape.area(f);
    piece[0].score += (turned ? -answer : answer) * shape.area(f);
    piece[0].weight += shape.area(f);
  }
  return votes;
}

void check(const InspectionInput& input) {
  const auto finite = [](double value, const char* name) {
    if (value >= 0.0 && std::isfinite(value)) return;
    throw std::invalid_argument("contact: " + std::string(name) + " must be a finite number >= 0, not " + std::to_string(value));
  };
  finite(input.gap, "gap");
  finite(input.stiffness_scale, "stiffness_scale");
  finite(input.element_step, "element_step");
}

struct FacingWatch::Known {
  std::array<Shape, 2> shapes;
};

FacingWatch::FacingWatch() = default;
FacingWatch::~FacingWatch() = default;
FacingWatch::FacingWatch(FacingWatch&&) noexcept = default;
FacingWatch& FacingWatch::operator=(FacingWatch&&) noexcept = default;

std::array<Facing, 2> FacingWatch::look(const InspectionInput& input) {
  check(input);
  if (known_ == nullptr) {
    const auto shape = [&input](std::size_t k) {
      Shape made(input.side[k], input.x);
      made.forget_shared_edges();
      return made;
    };
    known_ = std::make_unique<Known>(Known{{shape(0), shape(1)}});
  } else {
    for (std::size_t k = 0; k < 2; ++k) known_->shapes[k].move(input.side[k], input.x);
  }
  BothViews views = contact::look(known_->shapes, input.gap);
  for (Shape& shape : known_->shapes) shape.keep_connections();
  return views.take_facing();
}

std::array<Facing, 2> facing(const InspectionInput& input) { return FacingWatch().look(input); }

Orientation orient(const InspectionInput& input) {
  check(input);
  const std::array<Shape, 2> shapes{Shape(input.side[0], input.x), Shape(input.side[1], input.x)};
  const BothViews views = look(shapes, input.gap);
  Orientation out;
  if (input.both_sides) return out;
  for (std::size_t k = 0; k < 2; ++k) {
    const Shape& shape = shapes[k];
    if (shape.is_nodes()) continue;
    const auto votes = piece_votes(shape, views.side[k].facing);
    std::vector<std::array<double, 2>> area(votes.size(), {0.0, 0.0});
    for (Index f = 0; f < shape.count(); ++f) area[at(shape.piece(f))][shape.turned(f)] += shape.area(f);
    for (Index f = 0; f < shape.count(); ++f) {
      const Index piece = shape.piece(f);
      const PieceVote& vote = votes[at(piece)][0];
      const auto& areas = area[at(piece)];
      if (squared_norm(shape.normal(f)) == 0.0) continue;
      bool turn_turned = true;  // the piece takes the orientation of its first facet
      if (shape.one_sided(piece) || (vote.weight > 0.0 && std::abs(vote.score) < 0.5 * vote.weight)) {
        out.ambiguous[k] = true;
        continue;
      }
      if (vote.weight > 0.0) {
        turn_turned = vote.score > 0.0;
      } else if (areas[1] > areas[0]) {  // nothing near: the larger part keeps its orientation
        turn_turned = false;
      }
      if (shape.turned(f) == turn_turned) out.flip[k].push_back(f);
    }
    for (const std::uint8_t alike : views.side[k].alike) out.ambiguous[k] = out.ambiguous[k] || alike != 0;
  }
  return out;
}

}  // namespace abut::contact
