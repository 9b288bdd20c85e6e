#include "cycle/contact_thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "init/contact_options.hpp"
#include "init/contact_stiffness.hpp"

namespace abut::cycle {

namespace {

struct Place {
  std::size_t group = 0;
  Index element = no_index;
};

bool changes(const model::Model& model, const model::ElementRef& e) {
  const Index part = init::part_of(model, e);
  if (part == no_index) return false;
  const Index property = model.parts[static_cast<std::size_t>(part)].property;
  if (property == no_index) return false;
  const auto* shell = std::get_if<model::ShellProperty>(&model.properties[static_cast<std::size_t>(property)].data);
  return shell != nullptr && shell->thickness_changes;
}

/// Group and place in it of every shell, by kind and index in the model.
std::array<std::vector<Place>, 2> places_of(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups) {
  std::array<std::vector<Place>, 2> places;
  places[0].resize(model.shells.id.size());
  places[1].resize(model.sh3ns.id.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const model::ElementKind kind = groups[g]->kind();
    if (kind != model::ElementKind::shell4 && kind != model::ElementKind::shell3) continue;
    for (Index e = 0; e < groups[g]->size(); ++e) {
      const auto at = static_cast<std::size_t>(groups[g]->elements()[static_cast<std::size_t>(e)]);
      places[kind == model::ElementKind::shell4 ? 0 : 1][at] = {g, e};
    }
  }
  return places;
}

}  // namespace

ContactThickness::ContactThickness(const model::Model& model, std::span<const std::unique_ptr<elements::Group>> groups,
                                   std::span<const init::RunInterface> interfaces) {
  const auto places = places_of(model, groups);
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const model::Interface& card = model.interfaces[static_cast<std::size_t>(interfaces[i].model_index)];
    const auto* t7 = std::get_if<model::InterfaceType7>(&card.type);
    if (t7 != nullptr && t7->istf == 1) continue;  // the card gives the stiffness
    for (std::size_t k = 0; k < interfaces[i].sides.size(); ++k) {
      const init::RunInterface::Side& side = interfaces[i].sides[k];
      Followed f{i, k, {}, side.stiffness};
      const auto follow = [&](std::size_t target, const model::ElementRef& e, double stiffness) {
        if ((e.kind != model::ElementKind::shell4 && e.kind != model::ElementKind::shell3) || !changes(model, e)) return;
        const Place place = places[e.kind == model::ElementKind::shell4 ? 0 : 1][static_cast<std::size_t>(e.index)];
        if (place.element == no_index) return;
        const double initial = groups[place.group]->thickness(place.element);
        if (initial <= 0.0) return;
        const double gap = side.thickness.empty() ? 0.0 : init::gap_thickness(model, e);
        f.parts.push_back({target, place.group, place.element, initial, stiffness, gap, 1.0});
      };
      for (std::size_t s = 0; s < side.shell.size(); ++s) follow(s, side.shell[s], side.stiffness[s]);
      if (!side.shares.empty()) {
        f.stiffness.assign(side.nodes.size(), 0.0);
        for (const init::NodeShare& s : side.shares) {
          const std::size_t before = f.parts.size();
          follow(s.node, s.element, s.stiffness);
          if (f.parts.size() == before) f.stiffness[s.node] += s.stiffness;
        }
      } else {
        for (const Part& p : f.parts) f.stiffness[p.target] = 0.0;
      }
      if (!f.parts.empty()) followed_.push_back(std::move(f));
    }
  }
}

void ContactThickness::apply(const Followed& f, init::RunInterface& interface) const {
  init::RunInterface::Side& side = interface.sides[f.side];
  side.stiffness = f.stiffness;
  if (!side.thickness.empty()) {
    for (const Part& p : f.parts) side.thickness[p.target] = 0.0;
  }
  for (const Part& p : f.parts) {
    side.stiffness[p.target] += p.stiffness * p.ratio;
    if (!side.thickness.empty()) side.thickness[p.target] = std::max(side.thickness[p.target], p.thickness * p.ratio);
  }
  init::set_surface(interface, f.side);
}

void ContactThickness::update(std::int64_t cycle, std::span<const std::unique_ptr<elements::Group>> groups,
                              std::span<init::RunInterface> interfaces) {
  if (followed_.empty() || cycle % cycles_between != 0) return;
  for (Followed& f : followed_) {
    const auto now = [&groups](const Part& p) { return groups[p.group]->thickness(p.element) / p.initial; };
    const bool due =
        std::any_of(f.parts.begin(), f.parts.end(), [&](const Part& p) { return std::abs(now(p) - p.ratio) > noticed * p.ratio; });
    if (!due) continue;
    for (Part& p : f.parts) p.ratio = std::max(0.0, now(p));
    apply(f, interfaces[f.interface]);
  }
}

void ContactThickness::persist(state::Archive& a, std::span<init::RunInterface> interfaces) {
  a.each(followed_, [&](Followed& f) {
    bool taken = false;
    a.each(f.parts, [&](Part& p) {
      a(p.ratio);
      taken = taken || p.ratio != 1.0;
    });
    if (a.loading() && taken) apply(f, interfaces[f.interface]);
  });
}

}  // namespace abut::cycle
