#include "abut/contact/surface.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace abut::contact {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Edge of a facet with its end nodes in ascending order: equal for the two facets that share it.
struct Edge {
  Index low, high, facet;
  int number;
  [[nodiscard]] bool same_place(const Edge& b) const { return low == b.low && high == b.high; }
};

std::array<Index, 4> sorted_nodes(const std::array<Index, 4>& node) {
  std::array<Index, 4> sorted = node;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
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
  if (!node_key.empty()) {
    if (!nodes_.empty() && at(nodes_.back()) >= node_key.size()) {
      throw std::invalid_argument("contact surface: node " + std::to_string(nodes_.back()) + " has no key");
    }
    std::sort(nodes_.begin(), nodes_.end(),
              [node_key](Index a, Index b) { return std::pair(node_key[at(a)], a) < std::pair(node_key[at(b)], b); });
  }
  connect();
}

void Surface::connect() {
  by_host_.resize(nodes_.size());
  for (std::size_t s = 0; s < nodes_.size(); ++s) by_host_[s] = {nodes_[s], static_cast<Index>(s)};
  std::sort(by_host_.begin(), by_host_.end());

  local_.resize(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    for (std::size_t i = 0; i < 4; ++i) local_[f][i] = find(facets_[f].node[i]);
  }

  std::vector<Index> order = canonical_order();
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (sorted_nodes(local_[at(order[k])]) == sorted_nodes(local_[at(order[k - 1])])) {
      throw std::invalid_argument("contact surface: facet " + std::to_string(std::max(order[k - 1], order[k])) + " is facet " +
                                  std::to_string(std::min(order[k - 1], order[k])) + " again");
    }
  }

  at_first_.assign(nodes_.size() + 1, 0);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    for (int i = 0; i < facets_[f].corners(); ++i) ++at_first_[at(local_[f][static_cast<std::size_t>(i)]) + 1];
  }
  std::partial_sum(at_first_.begin(), at_first_.end(), at_first_.begin());
  at_facet_.resize(at(at_first_.back()));
  std::vector<Index> next(at_first_.begin(), at_first_.end() - 1);
  std::vector<Edge> edges;
  edges.reserve(facets_.size() * 4);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const int corners = facets_[f].corners();
    for (int i = 0; i < corners; ++i) {
      const Index a = local_[f][static_cast<std::size_t>(i)];
      const Index b = local_[f][static_cast<std::size_t>((i + 1) % corners)];
      at_facet_[at(next[at(a)]++)] = static_cast<Index>(f);
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(f), i});
    }
  }

  neighbours_.assign(facets_.size(), {no_index, no_index, no_index, no_index});
  borders_.assign(facets_.size(), 0);
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::array{a.low, a.high, a.facet} < std::array{b.low, b.high, b.facet};
  });
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].same_place(edges[first])) ++last;
    const Edge& a = edges[first];
    if (last - first == 1) {
      borders_[at(a.facet)] = static_cast<std::uint8_t>(borders_[at(a.facet)] | (1u << a.number));
    } else if (last - first == 2) {
      const Edge& b = edges[first + 1];
      neighbours_[at(a.facet)][static_cast<std::size_t>(a.number)] = b.facet;
      neighbours_[at(b.facet)][static_cast<std::size_t>(b.number)] = a.facet;
    }
    first = last;
  }
}

std::span<const Index> Surface::facets_at(Index s) const {
  const auto first = at(at_first_[at(s)]);
  return std::span(at_facet_).subspan(first, at(at_first_[at(s) + 1]) - first);
}

Index Surface::find(Index host_node) const {
  const auto found = std::lower_bound(by_host_.begin(), by_host_.end(), std::array{host_node, Index{-1}});
  return found != by_host_.end() && (*found)[0] == host_node ? (*found)[1] : no_index;
}

std::vector<Index> Surface::canonical_order() const {
  std::vector<std::pair<std::array<Index, 4>, Index>> keys(facets_.size());
  for (std::size_t f = 0; f < keys.size(); ++f) keys[f] = {sorted_nodes(local_[f]), static_cast<Index>(f)};
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

Surface Surface::reordered(std::span<const Index> order) const {
  Surface result;
  result.nodes_ = nodes_;
  result.facets_.reserve(order.size());
  for (const Index f : order) result.facets_.push_back(facets_[at(f)]);
  result.connect();
  return result;
}

}  // namespace abut::contact
