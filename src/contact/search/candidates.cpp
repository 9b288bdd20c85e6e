#include "contact/search/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {

Bounds facet_bounds(const Patch& patch) {
  Bounds box;
  for (const Vec3& corner : patch.x) box.include(corner);
  if (patch.borders != 0) {
    // A strip leaves the corners' box by at most half of its share of the facet's extent per side and direction.
    const Vec3 width = box.high - box.low;
    box.low -= 2.5 * patch.strip * width;
    box.high += 2.5 * patch.strip * width;
  }
  return box;
}

namespace {

constexpr double worth_keeping = 0.75;  // of the skin: lists that would have to be looked at again at once are made anew

/// Lists count strips as wide as a held node's can be: they hold for held and free nodes.
Bounds widest_bounds(const Side& surface, Index f) {
  if (surface.borders(f) != 0) {
    Patch patch = surface.patch(f);
    patch.strip = border_strip + border_widening;
    return facet_bounds(patch);
  }
  return facet_bounds(surface.bare_patch(f));
}

}  // namespace

void Positions::keep(std::span<const Vec3> x) {
  x_.resize(x.size());
  Bounds all;
  for (const Vec3& p : x) all.include(p);
  low_ = x.empty() ? Vec3{} : all.low;
  unit_ = x.empty() ? Vec3{} : (all.high - all.low) / static_cast<double>(largest);
  constexpr double tiny = 1e-290;  // below it there is no extent
  const auto parts_of = [](double unit) { return unit > tiny ? 1.0 / unit : 0.0; };
  const Vec3 parts{parts_of(unit_.x), parts_of(unit_.y), parts_of(unit_.z)};
  const auto kept_part = [](double part) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min(part + 0.5, static_cast<double>(largest))));
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 d = x[i] - low_;
    x_[i] = kept_part(d.x * parts.x) | kept_part(d.y * parts.y) << bits | kept_part(d.z * parts.z) << 2 * bits;
  }
  // Half of a unit along each axis, and rounding.
  constexpr double rounding = 1e-15;
  error_ =
      0.5001 * norm(unit_) + rounding * (norm(low_) + static_cast<double>(largest) * norm(unit_)) + static_cast<double>(largest) * tiny;
}

double Positions::largest_motion(std::span<const Vec3> x, const Vec3& common) const {
  double squared = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) { squared = std::max(squared, squared_norm(x[i] - kept(i) - common)); }
  return std::sqrt(squared) + error_;
}

bool Candidates::update(const Side& held, const Side& surface, const Motion& motion, const std::function<double(Index)>& reach, double skin,
                        bool force, const Executor& executor) {
  if (!force && !first_.empty()) {
    const double change = motion.change();
    shift_ += motion.mean;
    slack_ += change;
    clock_ += change;
    if (slack_ <= skin) return false;
    // Nodes that go to and fro are not far from where the lists were made.
    slack_ = Motion{shift_, held_then_.largest_motion(held.x(), shift_), surface_then_.largest_motion(surface.x(), shift_)}.change();
    if (slack_ <= worth_keeping * skin) return false;
  }
  held_then_.keep(held.x());
  surface_then_.keep(surface.x());
  shift_ = {};
  slack_ = 0.0;
  clock_ = 0.0;
  tree_.resize(at(surface.facet_count()));
  for (Index f = 0; f < surface.facet_count(); ++f) tree_.set(f, widest_bounds(surface, f));
  tree_.update();
  make(held, surface, reach, skin, executor);
  tree_.forget_boxes();  // near() is asked by few, who measure what they meet
  return true;
}

void Candidates::make(const Side& held, const Side& surface, const std::function<double(Index)>& reach, double skin,
                      const Executor& executor) {
  const std::size_t nodes = at(held.node_count());
  constexpr std::size_t piece = 256;  // nodes; every piece lists its own
  const std::size_t pieces = (nodes + piece - 1) / piece;
  first_.assign(nodes + 1, 0);
  nearest_.assign(nodes, 1e300);
  border_.assign(nodes, 1e300);
  strips_.assign(nodes, 1e300);
  others_.assign(nodes, {});
  std::vector<std::vector<Entry>> lists(pieces);
  const auto make_lists = [&](std::size_t begin, std::size_t end) {
    constexpr std::size_t together = 16;  // nodes
    static_assert(piece % together == 0);
    std::array<double, together> within;
    std::vector<Near> near;
    for (std::size_t p = begin; p < end; ++p) {
      for (std::size_t first = p * piece; first < std::min(nodes, (p + 1) * piece); first += together) {
        const std::size_t count = std::min(together, nodes - first);
        for (std::size_t k = 0; k < count; ++k) {
          const double far = reach(static_cast<Index>(first + k));
          within[k] = far >= 0.0 ? far + skin : -1.0;
        }
        list(held, surface, static_cast<Index>(first), std::span(within).first(count), near, lists[p]);
      }
    }
  };
  if (executor) {
    executor(pieces, std::cref(make_lists));
  } else {
    make_lists(0, pieces);
  }
  std::size_t all = 0;
  for (const std::vector<Entry>& l : lists) all += l.size();
  entries_.clear();
  entries_.reserve(all);
  for (const std::vector<Entry>& l : lists) entries_.insert(entries_.end(), l.begin(), l.end());
  for (std::size_t i = 0; i < nodes; ++i) first_[i + 1] += first_[i];
}

void Candidates::list(const Side& held, const Side& surface, Index first, std::span<const double> within, std::vector<Near>& near,
                      std::vector<Entry>& entries) {
  const auto box_of = [&](std::size_t k) {
    const Vec3& x = held.x()[at(first) + k];
    Bounds box{x, x};
    box.inflate(within[k]);
    return box;
  };
  Bounds all;
  double furthest = -1.0;
  for (std::size_t k = 0; k < within.size(); ++k) {
    if (within[k] < 0.0) continue;
    all.include(box_of(k));
    furthest = std::max(furthest, within[k]);
  }
  if (furthest < 0.0) return;
  // Nodes that do not lie together share few facets: in halves.
  constexpr double apart = 12.0;
  const Vec3 side = all.high - all.low;
  if (within.size() > 1 && std::max({side.x, side.y, side.z}) > apart * furthest) {
    const std::size_t half = within.size() / 2;
    list(held, surface, first, within.first(half), near, entries);
    list(held, surface, first + static_cast<Index>(half), within.subspan(half), near, entries);
    return;
  }
  near.clear();
  tree_.query(all, [&](Index f) {
    if (surface.active(f)) near.push_back({f, surface.borders(f) != 0, surface.surface().facet(f).node, mean_plane(surface.bare_patch(f))});
  });
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.facet < b.facet; });
  for (std::size_t k = 0; k < within.size(); ++k) {
    if (within[k] < 0.0) continue;
    const std::size_t node = at(first) + k, before = entries.size();
    const Vec3& x = held.x()[node];
    const Index host = held.nodes()[node];
    const CoarseBounds box(box_of(k));
    double nearest = 1e300, border = 1e300;
    for (const Near& f : near) {
      if (!tree_.meets(f.facet, box)) continue;
      if (std::find(f.node.begin(), f.node.end(), host) != f.node.end()) continue;  // nobody touches a facet of its own
      // Lower bounds: who needs the distance measures it.
      const double over = f.plane.height(x);
      double away = std::sqrt(squared_distance(tree_.box(f.facet), x));
      if (!f.border) away = std::max(away, over);
      if (away > within[k]) continue;
      entries.emplace_back(f.facet, true, f.border, away);  // the clock shows 0
      nearest = std::min(nearest, away);
      if (f.border) border = std::min(border, over);
    }
    nearest_[node] = std::min(nearest, border);
    border_[node] = border;
    strips_[node] = border < 1e300 ? -1e300 : 1e300;  // not looked at yet
    first_[node + 1] = static_cast<Index>(entries.size() - before);
  }
}

}  // namespace abut::contact
