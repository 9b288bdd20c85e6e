#include "elements/assembly.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace abut::elements {

namespace {

struct Entry {
  Index node;
  int kind;
  Id element;
  int corner;
  std::uint32_t slot;
};

Id element_id(const model::Model& model, model::ElementKind kind, Index i) {
  const auto k = static_cast<std::size_t>(i);
  switch (kind) {
    case model::ElementKind::shell4:
      return model.shells.id[k];
    case model::ElementKind::shell3:
      return model.sh3ns.id[k];
    case model::ElementKind::brick:
      return model.bricks.id[k];
    case model::ElementKind::tetra:
      return model.tetras.id[k];
    case model::ElementKind::none:
      break;
  }
  return 0;
}

}  // namespace

Assembly::Assembly(Index node_count, const model::Model& model, std::span<const std::unique_ptr<Group>> groups) {
  std::vector<Entry> shells;
  std::vector<Entry> solids;
  for (const std::unique_ptr<Group>& g : groups) {
    g->set_slot_offset(slot_count_);
    slot_count_ += g->layout().size();
    if (slot_count_ > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("too many elements for the slot index");
    if (g->layout().components == 0) continue;
    std::vector<Entry>& list = g->layout().components == 8 ? shells : solids;
    for (Index e = 0; e < g->size(); ++e) {
      const std::span<const Index> nodes = g->nodes(e);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto corner = static_cast<int>(k);
        list.push_back({nodes[k], static_cast<int>(g->kind()), element_id(model, g->kind(), g->elements()[static_cast<std::size_t>(e)]),
                        corner, static_cast<std::uint32_t>(g->layout().at(e, corner, 0))});
      }
    }
  }
  const auto pack = [node_count](std::vector<Entry>& list) {
    std::sort(list.begin(), list.end(), [](const Entry& a, const Entry& b) {
      if (a.node != b.node) return a.node < b.node;
      if (a.kind != b.kind) return a.kind < b.kind;
      if (a.element != b.element) return a.element < b.element;
      return a.corner < b.corner;
    });
    Entries entries;
    entries.first.assign(static_cast<std::size_t>(node_count) + 1, 0);
    entries.slot.reserve(list.size());
    for (const Entry& e : list) {
      ++entries.first[static_cast<std::size_t>(e.node) + 1];
      entries.slot.push_back(e.slot);
    }
    for (std::size_t i = 1; i < entries.first.size(); ++i) entries.first[i] += entries.first[i - 1];
    return entries;
  };
  shells_ = pack(shells);
  solids_ = pack(solids);
}

void Assembly::sum_masses(std::span<const double> slots, std::span<double> mass, std::span<double> inertia) const {
  for (std::size_t i = 0; i < mass.size(); ++i) {
    double m = 0.0;
    double j = 0.0;
    for (std::uint32_t e = shells_.first[i]; e < shells_.first[i + 1]; ++e) {
      m += slots[shells_.slot[e]];
      j += slots[shells_.slot[e] + lanes];
    }
    for (std::uint32_t e = solids_.first[i]; e < solids_.first[i + 1]; ++e) m += slots[solids_.slot[e]];
    mass[i] = m;
    inertia[i] = j;
  }
}

}  // namespace abut::elements
