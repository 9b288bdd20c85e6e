#include "contact/surface/side.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace abut::contact {
namespace {

// Abramowitz and Stegun 4.4.45, |error| <= 7e-5: enough for a weight, and the same bits everywhere (no libm).
double angle_from_cosine(double c) {
  const double a = c < 0.0 ? -c : c;
  const double clipped = a > 1.0 ? 1.0 : a;
  const double angle = std::sqrt(1.0 - clipped) * (1.5707288 + clipped * (-0.2121144 + clipped * (0.0742610 - 0.0187293 * clipped)));
  return c < 0.0 ? 3.141592653589793 - angle : angle;
}

}  // namespace

Side::Side(Surface surface, bool canonical) : surface_(std::move(surface)) {
  listed_.resize(at(surface_.facet_count()));
  std::iota(listed_.begin(), listed_.end(), 0);
  if (canonical) {
    listed_ = surface_.canonical_order();
    surface_ = surface_.reordered(listed_);
  }
  nodes_.assign(surface_.nodes().begin(), surface_.nodes().end());
  x_.resize(nodes_.size());
  active_.assign(listed_.size(), 1);
  borders_.assign(listed_.size(), 0);
  facet_stiffness_.assign(listed_.size(), 0.0);
  node_active_.assign(nodes_.size(), 1);
  node_stiffness_.assign(nodes_.size(), 0.0);
  corner_stiffness_.assign(nodes_.size(), 0.0);
}

Side::Side(std::vector<Index> nodes, std::vector<double> stiffness) : nodes_(std::move(nodes)), node_stiffness_(std::move(stiffness)) {
  x_.resize(nodes_.size());
  node_active_.assign(nodes_.size(), 1);
}

void Side::set(const SurfaceState& state, bool third_node_twice) {
  const bool facets = surface_.facet_count() > 0;
  const std::size_t count = facets ? listed_.size() : nodes_.size();
  const auto check = [count](std::size_t length, const char* what) {
    if (length != 0 && length != count) {
      throw std::invalid_argument("contact: " + std::to_string(length) + " values of " + what + " for " + std::to_string(count));
    }
  };
  check(state.stiffness.size(), "stiffness");
  check(state.thickness.size(), "thickness");
  check(state.active.size(), "activity");
  if (!state.node_active.empty() && state.node_active.size() != nodes_.size()) {
    throw std::invalid_argument("contact: " + std::to_string(state.node_active.size()) + " values of node activity for " +
                                std::to_string(nodes_.size()));
  }
  for (std::size_t i = 0; i < state.stiffness.size(); ++i) {
    if (!(state.stiffness[i] >= 0.0) || !std::isfinite(state.stiffness[i])) {
      throw std::invalid_argument("contact: stiffness " + std::to_string(i) + " is not a finite number >= 0");
    }
  }
  for (std::size_t i = 0; i < state.thickness.size(); ++i) {
    if (!(state.thickness[i] >= 0.0) || !std::isfinite(state.thickness[i])) {
      throw std::invalid_argument("contact: thickness " + std::to_string(i) + " is not a finite number >= 0");
    }
  }
  if (!facets) {
    if (!state.stiffness.empty()) node_stiffness_.assign(state.stiffness.begin(), state.stiffness.end());
    if (!state.thickness.empty()) node_thickness_.assign(state.thickness.begin(), state.thickness.end());
    for (std::size_t i = 0; i < state.active.size(); ++i) node_active_[i] = state.active[i];
    return;
  }

  if (!state.thickness.empty()) thickness_.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t from = at(listed_[f]);
    if (!state.stiffness.empty()) facet_stiffness_[f] = state.stiffness[from];
    if (!state.thickness.empty()) thickness_[f] = state.thickness[from];
    if (!state.active.empty()) active_[f] = state.active[from];
  }
  for (Index f = 0; f < surface_.facet_count(); ++f) {
    unsigned borders = 0;
    for (int e = 0; e < surface_.facets()[at(f)].corners(); ++e) {
      const Index other = surface_.neighbour(f, e);
      if (surface_.free_border(f, e) || (other != no_index && !active(other))) borders |= 1u << e;
    }
    borders_[at(f)] = static_cast<std::uint8_t>(borders);
  }
  largest_corner_stiffness_ = 0.0;
  smallest_corner_stiffness_ = 1e300;
  double thinnest = 1e300, thickest = 0.0;  // of active corners
  if (!thickness_.empty()) node_thickness_.resize(nodes_.size());
  for (Index s = 0; s < node_count(); ++s) {
    double sum = 0.0;
    double mean = 0.0, thick = 0.0;
    int around = 0;
    for (const Index f : surface_.facets_at(s)) {
      if (!active(f) && state.node_active.empty()) continue;
      const Facet& facet = surface_.facets()[at(f)];
      double share = facet.is_triangle() ? 1.0 / 3.0 : 0.25;
      if (facet.is_triangle() && third_node_twice) share = surface_.local()[at(f)][2] == s ? 0.5 : 0.25;
      sum += share * facet_stiffness(f);
      if (!active(f)) continue;
      mean += facet_stiffness(f);
      thick += thickness(f);
      ++around;
    }
    node_active_[at(s)] = state.node_active.empty() ? (around > 0 ? 1 : 0) : state.node_active[at(s)];
    node_stiffness_[at(s)] = sum;
    corner_stiffness_[at(s)] = around > 0 ? mean / around : 0.0;
    largest_corner_stiffness_ = std::max(largest_corner_stiffness_, corner_stiffness_[at(s)]);
    if (around > 0) smallest_corner_stiffness_ = std::min(smallest_corner_stiffness_, corner_stiffness_[at(s)]);
    if (!thickness_.empty()) node_thickness_[at(s)] = around > 0 ? thick / around : 0.0;
    if (around > 0) thinnest = std::min(thinnest, thick / around);
    if (around > 0) thickest = std::max(thickest, thick / around);
  }
  evenly_thick_ = thinnest >= (1.0 - 1e-9) * thickest;
}

double Side::thickness_at(Index f, const std::array<double, 4>& weight) const {
  if (node_thickness_.empty()) return 0.0;
  const std::array<Index, 4>& local = surface_.local()[at(f)];
  double sum = 0.0, smallest = 1e300, largest = 0.0;
  for (std::size_t k = 0; k < (local[2] == local[3] ? 3U : 4U); ++k) {
    const double t = node_thickness_[at(local[k])];
    sum += weight[k] * t;
    smallest = std::min(smallest, t);
    largest = std::max(largest, t);
  }
  return std::clamp(sum, smallest, largest);
}

double Side::largest_thickness() const {
  double largest = 0.0;
  for (const double t : node_thickness_) largest = std::max(largest, t);
  return largest;
}

void Side::gather(std::span<const Vec3> x, std::size_t begin, std::size_t end) {
  for (std::size_t s = begin; s < end; ++s) x_[s] = x[at(nodes_[s])];
}

Vec3 Side::pseudonormal(Index f, const ClosestPoint& point) const {
  const Patch own = patch(f);
  const Vec3 normal = normal_at(own, point.s, point.t);
  if (point.feature == Feature::face) return normal;
  const std::array<Index, 4>& local = surface_.local()[at(f)];
  if (point.feature == Feature::edge) {
    const Index other = surface_.neighbour(f, point.number);
    if (other == no_index || !active(other)) return normal;
    // The facet across: its normal at the same point of the shared edge.
    const int corners = surface_.facets()[at(f)].corners();
    const Index end = local[static_cast<std::size_t>((point.number + 1) % corners)];
    const Patch across = patch(other);
    const double along = point.weight[static_cast<std::size_t>((point.number + 1) % corners)];
    const std::array<Index, 4>& theirs = surface_.local()[at(other)];
    const Index begin = local[point.number];
    double s = 0.0;
    double t = 0.0;
    constexpr std::array<std::array<double, 2>, 4> quad{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    constexpr std::array<std::array<double, 2>, 3> triangle{{{0, 0}, {1, 0}, {0, 1}}};
    for (std::size_t i = 0; i < (across.triangle ? 3u : 4u); ++i) {
      const std::array<double, 2>& c = across.triangle ? triangle[i] : quad[i];
      const double share = theirs[i] == end ? along : theirs[i] == begin ? 1.0 - along : 0.0;
      s += share * c[0];
      t += share * c[1];
    }
    return normalized(normal + normal_at(across, s, t));
  }
  const Index node = local[point.number];
  Vec3 sum{};
  for (const Index g : surface_.facets_at(node)) {
    if (!active(g)) continue;
    const std::array<Index, 4>& theirs = surface_.local()[at(g)];
    const std::size_t corners = static_cast<std::size_t>(surface_.facets()[at(g)].corners());
    std::size_t here = 0;
    while (here < corners && theirs[here] != node) ++here;
    const Vec3 next = normalized(x_[at(theirs[(here + 1) % corners])] - x_[at(node)]);
    const Vec3 previous = normalized(x_[at(theirs[(here + corners - 1) % corners])] - x_[at(node)]);
    sum += angle_from_cosine(dot(next, previous)) * normalized(cross(next, previous));
  }
  return normalized(sum);
}

double Side::facet_area(Index f) const {
  const std::array<Index, 4>& local = surface_.local()[at(f)];
  const Vec3 doubled =
      cross(x_[at(local[2])] - x_[at(local[0])],
            surface_.facets()[at(f)].is_triangle() ? x_[at(local[1])] - x_[at(local[0])] : x_[at(local[3])] - x_[at(local[1])]);
  return 0.5 * norm(doubled);
}

double Side::tributary_area(Index s) const {
  double sum = 0.0;
  for (const Index f : surface_.facets_at(s)) {
    if (active(f)) sum += facet_area(f) / surface_.facets()[at(f)].corners();
  }
  return sum;
}

double Side::mean_size() const {
  double sum = 0.0;
  for (Index f = 0; f < facet_count(); ++f) sum += std::sqrt(facet_area(f));
  return facet_count() > 0 ? sum / facet_count() : 0.0;
}

}  // namespace abut::contact
