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
    box.low -= 2.5 * border_strip * width;
    box.high += 2.5 * border_strip * width;
  }
  return box;
}

bool Candidates::update(const Side& held, const Side& surface, const Motion& motion, const std::function<double(Index)>& reach, double skin,
                        bool force) {
  if (!force && !first_.empty()) {
    const double change = motion.change();
    shift_ += motion.mean;
    slack_ += change;
    clock_ += change;
    if (slack_ <= skin) return false;
  }
  shift_ = {};
  slack_ = 0.0;
  clock_ = 0.0;
  boxes_.resize(at(surface.facet_count()));
  for (Index f = 0; f < surface.facet_count(); ++f) boxes_[at(f)] = facet_bounds(surface.patch(f));
  tree_.build(boxes_);
  first_.assign(at(held.node_count()) + 1, 0);
  entries_.clear();
  nearest_.assign(at(held.node_count()), 1e300);
  others_.assign(at(held.node_count()), {});
  for (Index i = 0; i < held.node_count(); ++i) {
    const double distance = reach(i);
    const auto begin = static_cast<std::ptrdiff_t>(entries_.size());
    if (distance >= 0.0) {
      const Vec3 x = held.x()[at(i)];
      Bounds box{x, x};
      box.inflate(distance + skin);
      const double limit = distance + skin;
      tree_.query(box, [&](Index f) {
        if (!surface.active(f)) return;
        for (const Index n : surface.surface().facets()[at(f)].node) {
          if (n == held.nodes()[at(i)]) return;  // nobody touches a facet of its own
        }
        const double away = std::sqrt(closest_point(surface.patch(f), x).squared_distance);
        if (away > limit) return;
        entries_.push_back({f, false, away});  // the clock shows 0
        nearest_[at(i)] = std::min(nearest_[at(i)], away);
      });
      std::sort(entries_.begin() + begin, entries_.end(), [](const Entry& a, const Entry& b) { return a.facet < b.facet; });
    }
    first_[at(i) + 1] = static_cast<Index>(entries_.size());
  }
  return true;
}

}  // namespace abut::contact
