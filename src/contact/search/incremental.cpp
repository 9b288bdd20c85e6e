#include "contact/search/incremental.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

// Smallest barycentric coordinate of x in the corner triangle of facet f at surface node n.
double corner_measure(const Side& surface, Index f, Index n, const Vec3& x) {
  const std::array<Index, 4>& node = surface.surface().local()[at(f)];
  std::size_t j = 0;
  while (j < 3 && node[j] != n) ++j;
  std::size_t next = (j + 1) % 4;
  const std::size_t previous = (j + 3) % 4;
  if (j == 2 && node[2] == node[3]) next = 0;
  const Vec3 origin = surface.x()[at(node[j])];
  const Vec3 u = surface.x()[at(node[next])] - origin;
  const Vec3 w = surface.x()[at(node[previous])] - origin;
  const Vec3 normal = cross(u, w);
  const Vec3 d = x - origin;
  const double scale = squared_norm(normal);
  if (scale <= 0.0) return -1e300;
  const double to_next = dot(cross(d, w), normal) / scale;
  const double to_previous = dot(cross(u, d), normal) / scale;
  return std::min({1.0 - to_next - to_previous, to_next, to_previous});
}

}  // namespace

Index choose_facet(const Side& surface, Index n, Index previous, const Vec3& x) {
  Index best = no_index;
  double best_measure = -1e301;
  if (previous != no_index) {
    best = previous;
    best_measure = corner_measure(surface, previous, n, x);
    if (best_measure >= 0.0) return previous;
  }
  for (const Index f : surface.surface().facets_at(n)) {
    if (f == previous) continue;
    const double measure = corner_measure(surface, f, n, x);
    if (measure >= 0.0) return f;
    if (measure > best_measure) {
      best_measure = measure;
      best = f;
    }
  }
  return best;
}

void IncrementalSearch::start(const Side& held, const Side& surface, std::vector<Tracked>& tracked) {
  then_.clear();
  const double first_radius = refresh(surface, 0.0);
  tracked.assign(at(held.node_count()), {});
  if (surface.node_count() == 0) return;
  for (Index i = 0; i < held.node_count(); ++i) {
    Tracked& t = tracked[at(i)];
    const Vec3 x = held.x()[at(i)];
    double best = 1e300;
    bool everything = false;
    for (double radius = first_radius; !everything && best > radius * radius; radius *= 2.0) {
      Bounds box{x, x};
      box.inflate(radius);
      Index seen = 0;
      tree_.query(box, [&](Index s) {
        ++seen;
        if (surface.nodes()[at(s)] == held.nodes()[at(i)]) return;
        const double away = squared_norm(x - surface.x()[at(s)]);
        if (away < best || (away == best && s > t.node)) {
          best = away;
          t.node = s;
        }
      });
      everything = seen == surface.node_count();
    }
    if (t.node != no_index) t.facet = choose_facet(surface, t.node, no_index, x);
  }
}

double IncrementalSearch::refresh(const Side& surface, double gap) {
  double diagonal = 0.0;
  const std::span<const Vec3> x = surface.x();
  for (const auto& node : surface.surface().local()) {
    diagonal = std::max({diagonal, squared_norm(x[at(node[2])] - x[at(node[0])]), squared_norm(x[at(node[3])] - x[at(node[1])])});
  }
  // Whoever can touch a facet has one of its nodes within a diagonal.
  constexpr double to_spare = 1.75;
  const double reach = std::max(to_spare * (std::sqrt(diagonal) + std::abs(gap)), 1e-300);
  moved_ = 0.0;
  for (std::size_t s = 0; s < then_.size(); ++s) moved_ = std::max(moved_, squared_norm(x[s] - then_[s]));
  moved_ = std::sqrt(moved_);
  if (!then_.empty() && moved_ <= 0.25 * reach) return reach;
  then_.assign(x.begin(), x.end());
  tree_.resize(then_.size());
  for (std::size_t s = 0; s < then_.size(); ++s) tree_.set(static_cast<Index>(s), {then_[s], then_[s]});
  tree_.update();
  moved_ = 0.0;
  return reach;
}

void IncrementalSearch::update(const Side& held, const Side& surface, std::vector<Tracked>& tracked, double gap) {
  const double reach = refresh(surface, gap);
  for (Index i = 0; i < held.node_count(); ++i) {
    Tracked& t = tracked[at(i)];
    if (t.node == no_index) continue;
    const Vec3 x = held.x()[at(i)];
    const Index own = held.nodes()[at(i)];
    double best = 1e300;
    Index nearest = t.node;
    for (const Index f : surface.surface().facets_at(t.node)) {
      for (const Index s : surface.surface().local()[at(f)]) {
        const double away = squared_norm(x - surface.x()[at(s)]);
        if (away < best && surface.nodes()[at(s)] != own) {
          best = away;
          nearest = s;
        }
      }
    }
    const double radius = std::min(std::sqrt(best), reach);
    Bounds box{x, x};
    box.inflate(radius + moved_);
    Index nearer = no_index;
    tree_.query(box, [&](Index s) {
      const double away = squared_norm(x - surface.x()[at(s)]);
      if (away > reach * reach) return;  // of those out there the box has some or others, as old as the tree is
      if ((away < best || (away == best && nearer != no_index && s < nearer)) && surface.nodes()[at(s)] != own) {
        best = away;
        nearer = s;
      }
    });
    t.node = nearer == no_index ? nearest : nearer;
    t.facet = choose_facet(surface, t.node, t.facet, x);
  }
}

}  // namespace abut::contact
