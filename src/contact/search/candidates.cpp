#include "contact/search/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

// Largest |x - last - shift|; x becomes last.
double largest_motion(std::span<const Vec3> x, std::vector<Vec3>& last, const Vec3& shift) {
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, squared_norm(x[i] - last[i] - shift));
    last[i] = x[i];
  }
  return std::sqrt(largest);
}

}  // namespace

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

void Candidates::advance(const Side& held, const Side& surface) {
  Vec3 sum{};
  for (std::size_t i = 0; i < surface.x().size(); ++i) sum += surface.x()[i] - surface_last_[i];
  const Vec3 mean = surface.x().empty() ? Vec3{} : sum / static_cast<double>(surface.x().size());
  // Strips extrapolate their corners' motion: weights up to 1.2 x 1.2 in sum of magnitudes, 1.5 with room.
  const double change = largest_motion(held.x(), held_last_, mean) + 1.5 * largest_motion(surface.x(), surface_last_, mean);
  shift_ += mean;
  slack_ += change;
  clock_ += change;
}

void Candidates::update(const Side& held, const Side& surface, const std::function<double(Index)>& reach, double skin, bool force) {
  if (!force && !first_.empty()) {
    advance(held, surface);
    if (slack_ <= skin) return;
  }
  shift_ = {};
  slack_ = 0.0;
  clock_ = 0.0;
  held_last_.assign(held.x().begin(), held.x().end());
  surface_last_.assign(surface.x().begin(), surface.x().end());
  boxes_.resize(at(surface.facet_count()));
  for (Index f = 0; f < surface.facet_count(); ++f) boxes_[at(f)] = facet_bounds(surface.patch(f));
  tree_.build(boxes_);
  first_.assign(at(held.node_count()) + 1, 0);
  entries_.clear();
  nearest_.assign(at(held.node_count()), 1e300);
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
        entries_.push_back({f, away});  // the clock shows 0
        nearest_[at(i)] = std::min(nearest_[at(i)], away);
      });
      std::sort(entries_.begin() + begin, entries_.end(), [](const Entry& a, const Entry& b) { return a.facet < b.facet; });
    }
    first_[at(i) + 1] = static_cast<Index>(entries_.size());
  }
}

}  // namespace abut::contact
