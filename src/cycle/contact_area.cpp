#include "cycle/contact_area.hpp"

#include <algorithm>

namespace abut::cycle {

ContactArea::ContactArea(const model::Model& model, std::span<const init::RunInterface> interfaces) {
  struct Listed {
    std::array<Index, 4> key, nodes;  ///< key: the same for all facets over the same nodes
    Use use;
  };
  std::vector<Listed> listed;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const model::Interface& card = model.interfaces[static_cast<std::size_t>(interfaces[i].model_index)];
    const std::array<Index, 2> surfaces = model::surfaces_of(card);
    for (std::size_t side = 0; side < 2; ++side) {
      if (surfaces[side] == no_index) continue;
      const auto& segments = model.surfaces[static_cast<std::size_t>(surfaces[side])].segments;
      for (std::size_t f = 0; f < segments.size(); ++f) {
        std::array<Index, 4> key = segments[f].nodes;
        std::sort(key.begin(), key.end());
        listed.push_back({key, segments[f].nodes, {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(side), f}});
      }
    }
  }
  std::stable_sort(listed.begin(), listed.end(), [](const Listed& a, const Listed& b) { return a.key < b.key; });
  uses_.reserve(listed.size());
  for (std::size_t k = 0; k < listed.size(); ++k) {
    if (k == 0 || listed[k].key != listed[k - 1].key) facets_.push_back({listed[k].nodes, 0});
    uses_.push_back(listed[k].use);
    facets_.back().uses_end = uses_.size();
  }
  facets_.shrink_to_fit();
}

void ContactArea::write(std::span<const Vec3> x, std::span<const init::RunInterface> interfaces, std::span<double> area) const {
  std::size_t begin = 0;
  for (const Facet& facet : facets_) {
    const std::span<const Use> uses = std::span(uses_).subspan(begin, facet.uses_end - begin);
    begin = facet.uses_end;
    const bool active = std::any_of(uses.begin(), uses.end(), [interfaces](const Use& use) {
      const auto& flags = interfaces[use.interface].sides[use.side].active;
      return use.facet >= flags.size() || flags[use.facet] != 0;
    });
    if (!active) continue;
    const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(facet.nodes[k])]; };
    const bool triangle = facet.nodes[3] == facet.nodes[2];
    const Vec3 doubled = triangle ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
    const std::size_t corners = triangle ? 3 : 4;
    const double share = 0.5 * norm(doubled) / static_cast<double>(corners);
    for (std::size_t k = 0; k < corners; ++k) area[static_cast<std::size_t>(facet.nodes[k])] += share;
  }
}

}  // namespace abut::cycle
