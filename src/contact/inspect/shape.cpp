#include "contact/inspect/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::array<Index, 4> sorted_nodes(std::array<Index, 4> n) {
  std::sort(n.begin(), n.end());
  return n;
}

bool distinct(const Facet& f) {
  for (int i = 0; i < f.corners(); ++i) {
    for (int j = 0; j < i; ++j) {
      if (f.node[at(i)] == f.node[at(j)]) return false;
    }
  }
  return true;
}

// Moeller and Trumbore's test, on the open segment.
bool crosses(const Vec3& from, const Vec3& along, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 e1 = b - a;
  const Vec3 e2 = c - a;
  const Vec3 p = cross(along, e2);
  const double det = dot(e1, p);
  if (det == 0.0) return false;
  const Vec3 t = from - a;
  const double u = dot(t, p) / det;
  if (u < 0.0 || u > 1.0) return false;
  const Vec3 q = cross(t, e1);
  const double v = dot(along, q) / det;
  if (v < 0.0 || u + v > 1.0) return false;
  const double s = dot(e2, q) / det;
  return s > 1e-9 && s < 1.0 - 1e-9;
}

}  // namespace

Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return a + (d1 / (d1 - d3)) * ab;
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double up = d4 - d3, down = d5 - d6;
  if (va <= 0.0 && up >= 0.0 && down >= 0.0 && up + down > 0.0) return b + (up / (up + down)) * (c - b);
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return a;  // no area
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

/// What the tree asks of facets, and of nodes.
struct Shape::Items {
  const Shape& shape;
  [[nodiscard]] Vec3 normal(Index i) const { return shape.is_nodes() ? Vec3{} : shape.normal(i); }
  template <class Take>
  void corners(Index f, const Take& take) const {
    for (int k = 0; k < shape.facet(f).corners(); ++k) take(shape.corner(f, k));
  }
};

Shape::Shape(const InspectedSide& side, std::span<const Vec3> x) : side_(side), x_(x) {
  if (is_nodes()) {
    nodes_.assign(side.nodes.begin(), side.nodes.end());
  } else {
    for (const Facet& f : side.facets) nodes_.insert(nodes_.end(), f.node.begin(), f.node.end());
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  nodes_.shrink_to_fit();
  measure();
  if (!is_nodes()) connect();
  tree_.build(box_, Items{*this});
}

void Shape::move(const InspectedSide& side, std::span<const Vec3> x) {
  side_ = side;
  x_ = x;
  const std::vector<Index> degenerate = std::exchange(degenerate_, {});
  bounds_ = {};
  mean_size_ = 0.0;
  centre_.clear();
  box_.clear();
  measure();
  if (degenerate != degenerate_) {
    *this = Shape(side, x);
    return;
  }
  if (!is_nodes()) find_outside();
  tree_.refit(box_, Items{*this});
}

void Shape::keep_connections() {
  const auto release = [](auto&... values) { (std::remove_reference_t<decltype(values)>().swap(values), ...); };  // = {} keeps the memory
  release(centre_, normal_, area_, box_, shared_);
  if (!is_nodes()) release(nodes_);
  tree_.forget_bounds();
}

void Shape::forget_shared_edges() { std::vector<Shared>().swap(shared_); }

void Shape::measure() {
  if (is_nodes()) {
    for (const Index n : nodes_) {
      const Vec3 p = x_[at(n)];
      centre_.push_back(p);
      box_.emplace_back(Bounds{p, p});
      bounds_.include(p);
    }
    return;
  }
  const std::size_t n = side_.facets.size();
  centre_.resize(n);
  normal_.resize(n);
  area_.resize(n);
  box_.resize(n);
  for (Index f = 0; f < static_cast<Index>(n); ++f) {
    const int corners = facet(f).corners();
    Vec3 sum;
    Bounds box;
    for (int k = 0; k < corners; ++k) {
      sum += corner(f, k);
      box.include(corner(f, k));
    }
    box_[at(f)] = CoarseBounds(box);
    centre_[at(f)] = sum / static_cast<double>(corners);
    const Vec3 doubled = cross(corner(f, 2) - corner(f, 0), (corners == 3 ? corner(f, 2) : corner(f, 3)) - corner(f, 1));
    const double twice = norm(doubled);
    area_[at(f)] = 0.5 * twice;
    const double extent = squared_norm(box.high - box.low);
    const bool good = distinct(facet(f)) && twice > 1e-10 * extent;  // thinner faces have a normal of rounding errors
    if (good) {
      normal_[at(f)] = doubled / twice;
    } else {
      degenerate_.push_back(f);
    }
    mean_size_ += std::sqrt(area_[at(f)]);
    bounds_.include(box);
  }
  mean_size_ /= static_cast<double>(n);
}

void Shape::connect() {
  const Index n = count();
  std::vector<std::pair<std::array<Index, 4>, Index>> keys;
  keys.reserve(at(n));
  for (Index f = 0; f < n; ++f) keys.push_back({sorted_nodes(facet(f).node), f});
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k].first == keys[k - 1].first) duplicates_.push_back(keys[k].second);
  }
  std::sort(duplicates_.begin(), duplicates_.end());

  struct Edge {
    Index low, high, facet;
    bool upward;
  };
  std::vector<Edge> edges;
  edges.reserve(at(n) * 4);
  for (Index f = 0; f < n; ++f) {
    if (std::binary_search(degenerate_.begin(), degenerate_.end(), f) || std::binary_search(duplicates_.begin(), duplicates_.end(), f))
      continue;
    const int corners = facet(f).corners();
    for (int k = 0; k < corners; ++k) {
      const Index a = facet(f).node[at(k)];
      const Index b = facet(f).node[at((k + 1) % corners)];
      edges.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::array{a.low, a.high, a.facet} < std::array{b.low, b.high, b.facet};
  });
  std::vector<Index> borders;  // facets with a side of their own
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high) ++last;
    if (last - first == 2) {
      const Edge& a = edges[first];
      const Edge& b = edges[first + 1];
      shared_.push_back({{a.facet, b.facet}, {a.low, a.high}, a.upward != b.upward});
    } else {
      for (std::size_t k = first; k < last; ++k) (last - first == 1 ? borders : at_junctions_).push_back(edges[k].facet);
    }
    first = last;
  }
  std::sort(at_junctions_.begin(), at_junctions_.end());
  at_junctions_.erase(std::unique(at_junctions_.begin(), at_junctions_.end()), at_junctions_.end());
  find_pieces(borders);
}

void Shape::find_pieces(std::span<const Index> borders) {
  const Index n = count();
  std::vector<Index> first(at(n) + 1, 0);
  for (const Shared& s : shared_) {
    for (const Index f : s.facet) ++first[at(f) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  struct Link {
    Index facet;
    bool alike;
  };
  std::vector<Link> links(at(first.back()));
  std::vector<Index> next(first.begin(), first.end() - 1);
  for (const Shared& s : shared_) {
    links[at(next[at(s.facet[0])]++)] = {s.facet[1], s.alike};
    links[at(next[at(s.facet[1])]++)] = {s.facet[0], s.alike};
  }
  piece_.assign(at(n), no_index);
  turned_.assign(at(n), 0);
  std::vector<Index> open;
  for (Index start = 0; start < n; ++start) {
    if (piece_[at(start)] != no_index) continue;
    const auto piece = static_cast<Index>(one_sided_.size());
    one_sided_.push_back(0);
    piece_[at(start)] = piece;
    open.push_back(start);
    while (!open.empty()) {
      const Index f = open.back();
      open.pop_back();
      for (Index k = first[at(f)]; k < first[at(f) + 1]; ++k) {
        const Link& link = links[at(k)];
        const auto turned = static_cast<std::uint8_t>(link.alike ? turned_[at(f)] : 1 - turned_[at(f)]);
        if (piece_[at(link.facet)] == no_index) {
          piece_[at(link.facet)] = piece;
          turned_[at(link.facet)] = turned;
          open.push_back(link.facet);
        } else if (turned_[at(link.facet)] != turned) {
          one_sided_[at(piece)] = 1;
        }
      }
    }
  }
  closable_.assign(one_sided_.size(), 1);
  for (Index f = 0; f < n; ++f) {
    if (turned_[at(f)] != 0) closable_[at(piece_[at(f)])] = 0;
  }
  for (const auto& left_out : {std::span<const Index>(borders), std::span<const Index>(at_junctions_), std::span<const Index>(degenerate_),
                               std::span<const Index>(duplicates_)}) {
    for (const Index f : left_out) closable_[at(piece_[at(f)])] = 0;
  }
  if (one_sided_.size() == 1) std::vector<Index>().swap(piece_);
  find_outside();
}

// A closed piece whose facets agree: the sign of its volume tells outside from inside.
void Shape::find_outside() {
  std::vector<double> volume(one_sided_.size(), 0.0);
  const Vec3 origin = 0.5 * (bounds_.low + bounds_.high);
  for (Index f = 0; f < count(); ++f) volume[at(piece(f))] += dot(centre_[at(f)] - origin, area_[at(f)] * normal_[at(f)]);
  closed_.resize(one_sided_.size());
  for (std::size_t p = 0; p < closed_.size(); ++p)
    closed_[p] = closable_[p] == 0 || one_sided_[p] != 0 || volume[p] == 0.0 ? 0 : (volume[p] > 0.0 ? 1 : -1);
}

NearPoint Shape::nearest(const Vec3& from, double radius, Index except, Index guess) const {
  NearPoint best;
  double within = radius * radius;
  const auto visit = [&](Index i, double& limit) {
    if (squared_distance(box_[at(i)].bounds(), from) > limit) return;
    const auto take = [&](const Vec3& point) {
      const double squared = squared_norm(point - from);
      if (squared > limit || (squared == best.squared && i >= best.item)) return;
      best = {i, squared, point};
      limit = squared;
    };
    if (is_nodes()) {
      take(centre_[at(i)]);
      return;
    }
    if (except != no_index && std::find(facet(i).node.begin(), facet(i).node.end(), except) != facet(i).node.end()) return;
    take(closest_on_triangle(from, corner(i, 0), corner(i, 1), corner(i, 2)));
    if (!facet(i).is_triangle()) take(closest_on_triangle(from, corner(i, 0), corner(i, 2), corner(i, 3)));
  };
  if (guess != no_index) visit(guess, within);
  tree_.search(from, within, visit);
  return best;
}

bool Shape::hides(const Vec3& a, const Vec3& b, Index except) const {
  if (is_nodes()) return false;
  Bounds query;
  query.include(a);
  query.include(b);
  const CoarseBounds around(query);
  return tree_.any(a, b, [&](Index f) {
    if (f == except || !box_[at(f)].meets(around)) return false;
    return crosses(a, b - a, corner(f, 0), corner(f, 1), corner(f, 2)) ||
           (!facet(f).is_triangle() && crosses(a, b - a, corner(f, 0), corner(f, 2), corner(f, 3)));
  });
}

}  // namespace abut::contact
