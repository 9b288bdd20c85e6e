#include "abut/contact/surface.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Two node numbers as one: orders as the pair does, in one comparison.
std::uint64_t pair_key(Index a, Index b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b); }

// Nodes of a facet in ascending order, and the facet.
struct FacetKey {
  std::array<std::uint64_t, 2> nodes;
  Index facet;
};

std::vector<FacetKey> sorted_keys(std::span<const std::array<Index, 4>> facets) {
  std::vector<FacetKey> keys;
  keys.reserve(facets.size());
  for (std::array<Index, 4> n : facets) {
    std::sort(n.begin(), n.end());
    keys.push_back({{pair_key(n[0], n[1]), pair_key(n[2], n[3])}, static_cast<Index>(keys.size())});
  }
  std::sort(keys.begin(), keys.end(), [](const FacetKey& a, const FacetKey& b) {
    if (a.nodes[0] != b.nodes[0]) return a.nodes[0] < b.nodes[0];
    if (a.nodes[1] != b.nodes[1]) return a.nodes[1] < b.nodes[1];
    return a.facet < b.facet;
  });
  return keys;
}

void check_facet(const Facet& facet, std::size_t number) {
  const auto refuse = [number](const char* why) {
    throw std::invalid_argument("contact surface: facet " + std::to_string(number) + " " + why);
  };
  for (const Index n : facet.node) {
    if (n < 0) refuse("has a negative node");
  }
  for (int i = 0; i < facet.corners(); ++i) {
    for (int j = 0; j < i; ++j) {
      if (facet.node[static_cast<std::size_t>(i)] == facet.node[static_cast<std::size_t>(j)]) {
        refuse("has a node twice (a triangle repeats its third node at the end, nothing else)");
      }
    }
  }
}

}  // namespace

Surface::Surface(std::vector<Facet> facets, std::span<const Id> node_key) : facets_(std::move(facets)) {
  for (std::size_t f = 0; f < facets_.size(); ++f) check_facet(facets_[f], f);
  for (const Facet& facet : facets_) nodes_.insert(nodes_.end(), facet.node.begin(), facet.node.end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  nodes_.shrink_to_fit();
  if (!node_key.empty()) {
    if (!nodes_.empty() && at(nodes_.back()) >= node_key.size()) {
      throw std::invalid_argument("contact surface: node " + std::to_string(nodes_.back()) + " has no key");
    }
    std::sort(nodes_.begin(), nodes_.end(),
              [node_key](Index a, Index b) { return std::pair(node_key[at(a)], a) < std::pair(node_key[at(b)], b); });
  }
  connect(facets_);
}

void SurfaceTopology::connect(std::span<const Facet> facets) {
  if (!std::is_sorted(nodes_.begin(), nodes_.end())) {
    by_host_.resize(nodes_.size());
    std::iota(by_host_.begin(), by_host_.end(), Index{0});
    std::sort(by_host_.begin(), by_host_.end(), [this](Index a, Index b) { return nodes_[at(a)] < nodes_[at(b)]; });
  }

  local_.resize(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t i = 0; i < 4; ++i) local_[f][i] = find(facets[f].node[i]);
  }

  const std::vector<FacetKey> keys = sorted_keys(local_);
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k].nodes == keys[k - 1].nodes) {
      throw std::invalid_argument("contact surface: facet " + std::to_string(keys[k].facet) + " is facet " +
                                  std::to_string(keys[k - 1].facet) + " again");
    }
  }

  at_first_.assign(nodes_.size() + 1, 0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int i = 0; i < facets[f].corners(); ++i) ++at_first_[at(local_[f][static_cast<std::size_t>(i)]) + 1];
  }
  std::partial_sum(at_first_.begin(), at_first_.end(), at_first_.begin());
  at_facet_.resize(at(at_first_.back()));
  std::vector<Index> next(at_first_.begin(), at_first_.end() - 1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int i = 0; i < facets[f].corners(); ++i) {
      at_facet_[at(next[at(local_[f][static_cast<std::size_t>(i)])]++)] = static_cast<Index>(f);
    }
  }

  borders_.assign(facets.size(), 0);
  for (Index f = 0; f < facet_count(); ++f) {
    for (int e = 0; e < corners(f); ++e) {
      if (across(f, e).count == 0) borders_[at(f)] = static_cast<std::uint8_t>(borders_[at(f)] | (1u << e));
    }
  }
}

SurfaceTopology::Across SurfaceTopology::across(Index f, int e) const {
  const auto edge = [this](Index facet, int number) -> std::pair<Index, Index> {
    const std::array<Index, 4>& n = local_[at(facet)];
    return std::minmax(n[static_cast<std::size_t>(number)], n[static_cast<std::size_t>((number + 1) % corners(facet))]);
  };
  const std::pair<Index, Index> own = edge(f, e);
  const std::span<const Index> first = facets_at(own.first), second = facets_at(own.second);
  Across found;
  for (const Index g : first.size() <= second.size() ? first : second) {
    for (int i = 0; g != f && i < corners(g); ++i) {
      if (edge(g, i) == own) found = {g, found.count + 1};
    }
  }
  return found;
}

Index SurfaceTopology::neighbour(Index f, int e) const {
  const Across other = across(f, e);
  return other.count == 1 ? other.facet : no_index;
}

std::span<const Index> SurfaceTopology::facets_at(Index s) const {
  const auto first = at(at_first_[at(s)]);
  return std::span(at_facet_).subspan(first, at(at_first_[at(s) + 1]) - first);
}

Index SurfaceTopology::find(Index host_node) const {
  if (by_host_.empty()) {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), host_node);
    return found != nodes_.end() && *found == host_node ? static_cast<Index>(found - nodes_.begin()) : no_index;
  }
  const auto found =
      std::lower_bound(by_host_.begin(), by_host_.end(), host_node, [this](Index s, Index node) { return nodes_[at(s)] < node; });
  return found != by_host_.end() && nodes_[at(*found)] == host_node ? *found : no_index;
}

std::vector<Index> Surface::canonical_order() const {
  std::vector<Index> order;
  order.reserve(local_.size());
  for (const FacetKey& key : sorted_keys(local_)) order.push_back(key.facet);
  return order;
}

Surface Surface::reordered(std::span<const Index> order) const {
  Surface result;
  result.nodes_ = nodes_;
  result.facets_.reserve(order.size());
  for (const Index f : order) result.facets_.push_back(facets_[at(f)]);
  result.connect(result.facets_);
  return result;
}

}  // namespace abut::contact
