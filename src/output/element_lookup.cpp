#include "output/element_lookup.hpp"

namespace abut::output {
namespace {

/// Position of a kind in the tables; -1 for `none`.
int slot_of(model::ElementKind kind) { return static_cast<int>(kind) - static_cast<int>(model::ElementKind::shell4); }

}  // namespace

ElementLookup::ElementLookup(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups) {
  const std::array<Index, 4> sizes{model.shells.size(), model.sh3ns.size(), model.bricks.size(), model.tetras.size()};
  for (std::size_t k = 0; k < places_.size(); ++k) places_[k].resize(static_cast<std::size_t>(sizes[k]));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const int slot = slot_of(groups[g]->kind());
    if (slot < 0) continue;
    const std::span<const Index> members = groups[g]->elements();
    for (std::size_t e = 0; e < members.size(); ++e) {
      places_[static_cast<std::size_t>(slot)][static_cast<std::size_t>(members[e])] = {static_cast<Index>(g), static_cast<Index>(e)};
    }
  }
}

ElementPlace ElementLookup::find(model::ElementKind kind, Index index) const {
  const int slot = slot_of(kind);
  if (slot < 0 || index < 0) return {};
  const std::vector<ElementPlace>& table = places_[static_cast<std::size_t>(slot)];
  return static_cast<std::size_t>(index) < table.size() ? table[static_cast<std::size_t>(index)] : ElementPlace{};
}

std::vector<double> part_masses(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups) {
  std::vector<double> masses(model.parts.size(), 0.0);
  for (const auto& group : groups) {
    if (group->part() == no_index) continue;
    double& mass = masses[static_cast<std::size_t>(group->part())];
    for (Index e = 0; e < group->size(); ++e) mass += group->element_mass(e);
  }
  return masses;
}

}  // namespace abut::output
