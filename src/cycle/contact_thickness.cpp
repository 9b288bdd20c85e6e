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
    const bool given = t7 != nullptr && t7->istf == 1;  // the card gives the stiffness
    const double scale = t7 != nullptr && t7->igap >= 2 ? t7->gap_scale : 1.0;
    for (std::size_t k = 0; k < interfaces[i].sides.size(); ++k) {
      const init::RunInterface::Side& side = interfaces[i].sides[k];
      if (given && side.thickness.empty()) continue;
      Followed f{i, k, {}, side.stiffness, {}};
      f.thickness.assign(side.thickness.size(), 0.0);
      const auto follow = [&](std::size_t target, const model::ElementRef& e, double stiffness) {
        if (e.kind != model::ElementKind::shell4 && e.kind != model::ElementKind::shell3) return false;
        const double gap = side.thickness.empty() ? 0.0 : scale * init::gap_thickness(model, e);
        const Place place = places[e.kind == model::ElementKind::shell4 ? 0 : 1][static_cast<std::size_t>(e.index)];
        const double initial = place.element != no_index && changes(model, e) ? groups[place.group]->thickness(place.element) : 0.0;
        if (initial > 0.0) {
          f.parts.push_back({target, place.group, place.element, initial, stiffness, gap, 1.0});
        } else if (!f.thickness.empty()) {
          f.thickness[target] = std::max(f.thickness[target], gap);
        }
        return initial > 0.0;
      };
      for (std::size_t s = 0; s < side.shell.size(); ++s) {
        if (follow(s, side.shell[s], given ? 0.0 : side.stiffness[s]) && !given) f.stiffness[s] = 0.0;
      }
      if (!side.shares.empty()) {
        f.stiffness.assign(side.nodes.size(), 0.0);
        for (const init::NodeShare& s : side.shares) {
          if (!follow(s.node, s.element, s.stiffness)) f.stiffness[s.node] += s.stiffness;
        }
      }
      if (!f.parts.empty()) followed_.push_back(std::move(f));
    }
  }
}

void ContactThickness::apply(const Followed& f, init::RunInterface& interface) const {
  init::RunInterface::Side& side = interface.sides[f.side];
  side.stiffness = f.stiffness;
  side.thickness = f.thickness;
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
