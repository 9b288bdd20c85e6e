#include "constraints/sections.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace abut::constraints {

namespace {

std::span<const Index> listed(const model::Section& section, model::ElementKind kind) {
  switch (kind) {
    case model::ElementKind::shell4:
      return section.shells;
    case model::ElementKind::shell3:
      return section.sh3ns;
    case model::ElementKind::brick:
      return section.bricks;
    default:
      return {};
  }
}

}  // namespace

Sections::Sections(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups)
    : model_(&model), sections_(model.sections.size()), sums_(model.sections.size()) {
  using Key = std::tuple<model::ElementKind, Index, int>;  // order of the sum: kind, element, node of the element
  std::vector<std::uint8_t> in_section(static_cast<std::size_t>(model.node_count()));
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const model::Section& card = model.sections[i];
    std::fill(in_section.begin(), in_section.end(), std::uint8_t{0});
    for (const Index node : card.nodes) in_section[static_cast<std::size_t>(node)] = 1;
    std::vector<std::pair<Key, Entry>> found;
    for (const auto& group : groups) {
      std::vector<Index> wanted(listed(card, group->kind()).begin(), listed(card, group->kind()).end());
      std::sort(wanted.begin(), wanted.end());
      for (Index e = 0; e < group->size(); ++e) {
        const Index element = group->elements()[static_cast<std::size_t>(e)];
        if (!std::binary_search(wanted.begin(), wanted.end(), element)) continue;
        const elements::ElementNodes nodes = group->nodes(e);
        for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
          const Index node = nodes[static_cast<std::size_t>(k)];
          if (in_section[static_cast<std::size_t>(node)] == 0) continue;
          found.push_back({{group->kind(), element, k}, {node, group->layout().at(e, k, 0), group->layout().components >= 8}});
        }
      }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [key, entry] : found) sections_[i].entries.push_back(entry);
    sections_[i].frame = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  }
}

void Sections::gather(const state::State& state, std::span<const double> slots) {
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const model::Section& card = model_->sections[i];
    Section& section = sections_[i];
    const auto x = [&](Index node) { return state.x[static_cast<std::size_t>(node)]; };
    const bool has_nodes = card.frame_nodes[0] != no_index && card.frame_nodes[1] != no_index && card.frame_nodes[2] != no_index;
    if (has_nodes) frame_of_points(x(card.frame_nodes[0]), x(card.frame_nodes[1]), x(card.frame_nodes[2]), 0, section.frame);

    Vec3 centre{};
    const int about = card.iframe % 10;
    if (about == 0 && card.frame_nodes[0] != no_index) centre = x(card.frame_nodes[0]);
    if (about == 1 || about == 2) {
      double weights = 0.0;
      for (const Index node : card.nodes) {
        const double weight = about == 1 ? 1.0 : state.mass[static_cast<std::size_t>(node)];
        centre += weight * x(node);
        weights += weight;
      }
      if (weights > 0.0) centre = centre / weights;
    }

    Vec3 force{}, moment{};
    for (const Entry& entry : section.entries) {
      const auto value = [&](std::size_t component) { return -slots[entry.slot + component * elements::lanes]; };
      const Vec3 f{value(0), value(1), value(2)};
      force += f;
      moment += cross(x(entry.node) - centre, f);
      if (entry.moment) moment += Vec3{value(4), value(5), value(6)};
    }

    SectionSums& sums = sums_[i];
    sums.normal_force = dot(force, section.frame[2]) * section.frame[2];
    sums.tangential_force = force - sums.normal_force;
    sums.moment =
        card.iframe >= 10 ? moment : Vec3{dot(moment, section.frame[0]), dot(moment, section.frame[1]), dot(moment, section.frame[2])};
  }
}

void Sections::book_impulses(double h) {
  for (SectionSums& sums : sums_) {
    sums.normal_impulse += h * sums.normal_force;
    sums.tangential_impulse += h * sums.tangential_force;
    sums.moment_impulse += h * sums.moment;
  }
}

Vec3 Sections::global_moment(Index section) const {
  const auto i = static_cast<std::size_t>(section);
  const Vec3& m = sums_[i].moment;
  if (model_->sections[i].iframe >= 10) return m;
  const Frame& e = sections_[i].frame;
  return m.x * e[0] + m.y * e[1] + m.z * e[2];
}

void Sections::persist(state::Archive& a) {
  a.each(sections_, [&a](Section& section) { a(section.frame); });
  a.each(sums_, [&a](SectionSums& s) {
    for (Vec3* v : {&s.normal_force, &s.tangential_force, &s.moment, &s.normal_impulse, &s.tangential_impulse, &s.moment_impulse}) a(*v);
  });
}

}  // namespace abut::constraints
