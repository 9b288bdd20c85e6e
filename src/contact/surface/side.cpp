#include "contact/surface/side.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

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

Side::Side(Surface surface, bool canonical) {
  if (canonical) {
    std::vector<Index> order = surface.canonical_order();
    if (!std::is_sorted(order.begin(), order.end())) {
      surface = surface.reordered(order);
      listed_ = std::move(order);
    }
  }
  surface_ = std::move(static_cast<SurfaceTopology&>(surface));  // facets by host nodes follow from it
  x_.resize(surface_.nodes().size());
  const std::size_t facets = at(surface_.facet_count());
  active_.assign(facets, 1);
  borders_.assign(facets, 0);
  facet_stiffness_ = Values(std::vector<double>(facets, 0.0));
  node_active_.assign(x_.size(), 1);
  node_stiffness_ = Values(std::vector<double>(x_.size(), 0.0));
  corner_stiffness_ = node_stiffness_;
}

void check_finite(std::span<const double> values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0.0 && std::isfinite(values[i])) continue;
    throw std::invalid_argument("contact: " + std::string(what) + " " + std::to_string(i) + " is not a finite number >= 0");
  }
}

Side::Side(std::vector<Index> nodes, std::vector<double> stiffness)
    : nodes_(std::move(nodes)), node_stiffness_(Values(std::move(stiffness))) {
  x_.resize(nodes_.size());
  node_active_.assign(nodes_.size(), 1);
}

void Side::set(const SurfaceState& state, bool third_node_twice) {
  const bool facets = surface_.facet_count() > 0;
  const std::size_t count = facets ? at(surface_.facet_count()) : x_.size();
  const auto check = [count](std::size_t length, const char* what) {
    if (length != 0 && length != count) {
      throw std::invalid_argument("contact: " + std::to_string(length) + " values of " + what + " for " + std::to_string(count));
    }
  };
  check(state.stiffness.size(), "stiffness");
  check(state.thickness.size(), "thickness");
  check(state.active.size(), "activity");
  if (!state.node_active.empty() && state.node_active.size() != x_.size()) {
    throw std::invalid_argument("contact: " + std::to_string(state.node_active.size()) + " values of node activity for " +
                                std::to_string(x_.size()));
  }
  check_finite(state.stiffness, "stiffness");
  check_finite(state.thickness, "thickness");
  if (!facets) {
    if (!state.stiffness.empty()) node_stiffness_ = Values({state.stiffness.begin(), state.stiffness.end()});
    if (!state.thickness.empty()) node_thickness_ = Values({state.thickness.begin(), state.thickness.end()});
    for (std::size_t i = 0; i < state.active.size(); ++i) node_active_[i] = state.active[i];
    return;
  }

  const auto take = [this](std::span<const double> given, Values& values) {
    if (given.empty()) return;
    std::vector<double> mine;
    mine.reserve(given.size());
    for (Index f = 0; f < surface_.facet_count(); ++f) mine.push_back(given[at(listed(f))]);
    values = Values(std::move(mine));
  };
  take(state.stiffness, facet_stiffness_);
  take(state.thickness, thickness_);
  for (std::size_t f = 0; f < state.active.size(); ++f) active_[f] = state.active[at(listed(static_cast<Index>(f)))];
  find_borders();
  if (!state.node_active.empty()) nodes_said_.assign(state.node_active.begin(), state.node_active.end());
  largest_corner_stiffness_ = 0.0;
  smallest_corner_stiffness_ = 1e300;
  double thinnest = 1e300, thickest = 0.0;  // of active corners
  std::vector<double> of_node(x_.size()), of_corner(x_.size()), thick_at(thickness_.empty() ? 0 : x_.size());
  for (Index s = 0; s < node_count(); ++s) {
    double sum = 0.0;
    double mean = 0.0, thick = 0.0;
    int around = 0;
    for (const Index f : surface_.facets_at(s)) {
      if (!active(f) && nodes_said_.empty()) continue;
      const bool triangle = surface_.is_triangle(f);
      double share = triangle ? 1.0 / 3.0 : 0.25;
      if (triangle && third_node_twice) share = surface_.local()[at(f)][2] == s ? 0.5 : 0.25;
      sum += share * facet_stiffness(f);
      if (!active(f)) continue;
      mean += facet_stiffness(f);
      thick += thickness(f);
      ++around;
    }
    node_active_[at(s)] = nodes_said_.empty() ? (around > 0 ? 1 : 0) : nodes_said_[at(s)];
    of_node[at(s)] = sum;
    of_corner[at(s)] = around > 0 ? mean / around : 0.0;
    largest_corner_stiffness_ = std::max(largest_corner_stiffness_, of_corner[at(s)]);
    if (around > 0) smallest_corner_stiffness_ = std::min(smallest_corner_stiffness_, of_corner[at(s)]);
    if (!thickness_.empty()) thick_at[at(s)] = around > 0 ? thick / around : 0.0;
    if (around > 0) thinnest = std::min(thinnest, thick / around);
    if (around > 0) thickest = std::max(thickest, thick / around);
  }
  node_stiffness_ = Values(std::move(of_node));
  corner_stiffness_ = Values(std::move(of_corner));
  node_thickness_ = Values(std::move(thick_at));
  evenly_thick_ = thinnest >= (1.0 - 1e-9) * thickest;
}

void Side::find_borders() {
  const auto add = [this](Index f, int e) { borders_[at(f)] = static_cast<std::uint8_t>(borders_[at(f)] | (1u << e)); };
  std::fill(borders_.begin(), borders_.end(), std::uint8_t{0});
  for (Index f = 0; f < surface_.facet_count(); ++f) {
    for (int e = 0; e < surface_.corners(f); ++e) {
      if (surface_.free_border(f, e)) add(f, e);
      const Index beside = active(f) ? no_index : surface_.neighbour(f, e);
      for (int k = 0; beside != no_index && k < surface_.corners(beside); ++k) {
        if (surface_.neighbour(beside, k) == f) add(beside, k);
      }
    }
  }
}

std::vector<double> Side::as_listed(const Values& values) const {
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[at(listed(static_cast<Index>(i)))] = values[i];
  return out;
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
  for (std::size_t s = 0; s < node_thickness_.size(); ++s) largest = std::max(largest, node_thickness_[s]);
  return largest;
}

void Side::gather(std::span<const Vec3> x, std::size_t begin, std::size_t end) {
  const std::span<const Index> nodes = Side::nodes();
  for (std::size_t s = begin; s < end; ++s) x_[s] = x[at(nodes[s])];
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
    const int corners = surface_.corners(f);
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
    const std::size_t corners = static_cast<std::size_t>(surface_.corners(g));
    std::size_t here = 0;
    while (here < corners && theirs[here] != node) ++here;
    const Vec3 next = normalized(x_[at(theirs[(here + 1) % corners])] - x_[at(node)]);
    const Vec3 previous = normalized(x_[at(theirs[(here + corners - 1) % corners])] - x_[at(node)]);
    sum += angle_from_cosine(dot(next, previous)) * normalized(cross(next, previous));
  }
  return normalized(sum);
}

void check_held_nodes(std::span<const Index> nodes) {
  std::vector<Index> sorted(nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end());
  if (!sorted.empty() && sorted.front() < 0)
    throw std::invalid_argument("contact: held node " + std::to_string(sorted.front()) + " is negative");
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw std::invalid_argument("contact: node " + std::to_string(*twice) + " is held twice");
}

double Side::pressure(Index f, double force) const {
  const double area = facet_area(f);
  return area > 0.0 ? force / area : 0.0;
}

double Side::facet_area(Index f) const {
  const std::array<Index, 4>& local = surface_.local()[at(f)];
  const Vec3 doubled = cross(x_[at(local[2])] - x_[at(local[0])],
                             surface_.is_triangle(f) ? x_[at(local[1])] - x_[at(local[0])] : x_[at(local[3])] - x_[at(local[1])]);
  return 0.5 * norm(doubled);
}

double Side::tributary_area(Index s) const {
  double sum = 0.0;
  for (const Index f : surface_.facets_at(s)) {
    if (active(f)) sum += facet_area(f) / surface_.corners(f);
  }
  return sum;
}

double Side::mean_size() const {
  double sum = 0.0;
  for (Index f = 0; f < facet_count(); ++f) sum += std::sqrt(facet_area(f));
  return facet_count() > 0 ? sum / facet_count() : 0.0;
}

}  // namespace abut::contact
