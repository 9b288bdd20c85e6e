#include "init/contact_options.hpp"

#include <algorithm>

#include "init/contact_stiffness.hpp"

namespace abut::init {

namespace {

using model::ElementKind;
using model::ElementRef;

/// A sensor on the card takes the place of Tstart and Tstop (deck-format.md E.2).
struct Window {
  double birth = 0.0, death = 1e30;
};
Window window_of(const model::Model& model, const model::Interface& card) {
  if (card.sensor == no_index) return {card.t_start, card.t_stop};
  const model::Sensor& s = model.sensors[static_cast<std::size_t>(card.sensor)];
  return {s.t_on, s.t_off};
}

contact::FrictionLaw friction_law_of(const model::Interface& card) {
  using Model = contact::FrictionLaw::Model;
  static constexpr Model models[] = {Model::coulomb, Model::polynomial, Model::darmstadt, Model::renard, Model::exponential};
  return {models[card.ifric], card.c};
}

/// The reference program takes the larger of 2 pi f h and 1 for Ifiltr 3, which is no filter (numerics.md 7.4.5, 7.7.5).
contact::FrictionFilter filter_of(const model::Interface& card, const Profile& profile) {
  constexpr double two_pi = 6.283185307179586476925;
  if (card.ifiltr == 1) return {card.xfreq, 0.0};
  if (card.ifiltr == 2) return {two_pi / card.xfreq, 0.0};
  if (card.ifiltr == 3 && !profile.reference_contact) return {1.0, card.xfreq};
  return {};
}

}  // namespace

double gap_thickness(const model::Model& model, const ElementRef& e) {
  if (e.kind != ElementKind::shell4 && e.kind != ElementKind::shell3) return 0.0;
  const model::Part& part = model.parts[static_cast<std::size_t>(part_of(model, e))];
  if (part.contact_thickness > 0.0) return part.contact_thickness;
  const auto& own = e.kind == ElementKind::shell4 ? model.shells.thickness : model.sh3ns.thickness;
  const auto i = static_cast<std::size_t>(e.index);
  if (i < own.size() && own[i] > 0.0) return own[i];
  return property_thickness(model.properties[static_cast<std::size_t>(part.property)]);
}

namespace {

struct ShortestSides {
  std::vector<double> of;  ///< per segment
  double least = 1e30;
};
ShortestSides shortest_sides(const model::Surface& surface, std::span<const Vec3> x) {
  ShortestSides s;
  for (const model::Segment& segment : surface.segments) {
    double side = 1e30;
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = norm(x[static_cast<std::size_t>(segment.nodes[(k + 1) % 4])] - x[static_cast<std::size_t>(segment.nodes[k])]);
      if (length > 0.0) side = std::min(side, length);
    }
    s.of.push_back(side);
    s.least = std::min(s.least, side);
  }
  return s;
}

/// Default Gapmin of TYPE7 (numerics.md 7.7.1): the smaller of a shell thickness and half of the shortest side, a tenth of the
/// shortest side on solids. The thickness: Igap 0 the mean of the main shells, else the smallest, with the scale for 2 and 3.
double default_gap(const model::Model& model, const model::InterfaceType7& t7, const model::Surface& surface, double side) {
  double sum = 0.0;
  double least = 1e30;
  int shells = 0;
  for (const model::Segment& s : surface.segments) {
    const double t = gap_thickness(model, s.element);
    if (t <= 0.0) continue;
    sum += t;
    least = std::min(least, t);
    ++shells;
  }
  if (shells == 0) return 0.1 * side;
  const double thickness = t7.igap == 0 ? sum / shells : least * (t7.igap >= 2 ? t7.gap_scale : 1.0);
  return std::min(thickness, 0.5 * side);
}

}  // namespace

std::vector<double> nodal_thickness(const model::Model& model) {
  std::vector<double> t(static_cast<std::size_t>(model.node_count()), 0.0);
  const auto add = [&](const auto& elements, ElementKind kind) {
    for (Index e = 0; e < elements.size(); ++e) {
      const double own = gap_thickness(model, {kind, e});
      for (const Index n : elements.nodes[static_cast<std::size_t>(e)]) {
        double& largest = t[static_cast<std::size_t>(n)];
        largest = std::max(largest, own);
      }
    }
  };
  add(model.shells, ElementKind::shell4);
  add(model.sh3ns, ElementKind::shell3);
  return t;
}

namespace {
double thickness_scale(const model::InterfaceType7& t7) { return t7.igap >= 2 ? t7.gap_scale : 1.0; }
}  // namespace

std::vector<double> gap_thickness_of_nodes(const model::Model& model, const model::InterfaceType7& t7) {
  const std::vector<double> thickness = nodal_thickness(model);
  std::vector<double> out;
  for (const Index n : t7.nodes) out.push_back(thickness_scale(t7) * thickness[static_cast<std::size_t>(n)]);
  return out;
}

std::vector<double> gap_thickness_of_facets(const model::Model& model, const model::InterfaceType7& t7) {
  std::vector<double> out;
  for (const model::Segment& s : model.surfaces[static_cast<std::size_t>(t7.surface)].segments) {
    out.push_back(thickness_scale(t7) * gap_thickness(model, s.element));
  }
  return out;
}

namespace {

void variable_gap(const model::Model& model, const model::InterfaceType7& t7, const model::Surface& surface, const ShortestSides& sides,
                  contact::BothSidesOptions& o) {
  constexpr double unlimited = 1e30;
  for (const double t : gap_thickness_of_nodes(model, t7)) o.node_gap.push_back(0.5 * t);
  for (const double t : gap_thickness_of_facets(model, t7)) o.facet_gap.push_back(0.5 * t);
  if (t7.igap >= 2) o.gap_max = t7.gap_max;
  if (t7.igap < 3) return;
  std::vector<double> around(static_cast<std::size_t>(model.node_count()), unlimited);
  for (std::size_t f = 0; f < surface.segments.size(); ++f) {
    o.facet_size.push_back(t7.mesh_size * sides.of[f]);
    for (const Index n : surface.segments[f].nodes) {
      double& least = around[static_cast<std::size_t>(n)];
      least = std::min(least, t7.mesh_size * sides.of[f]);
    }
  }
  for (const Index n : t7.nodes) o.node_size.push_back(around[static_cast<std::size_t>(n)]);
}

}  // namespace

InterfaceChoice choice_of(const InterfaceChoices& choices, Id interface_id) {
  InterfaceChoice all;
  all.interface_id = interface_id;
  const auto take = [](auto& into, const auto& from) {
    if (from) into = from;
  };
  for (const Id id : {Id{0}, interface_id}) {
    for (const InterfaceChoice& c : choices) {
      if (c.interface_id != id) continue;
      take(all.law, c.law);
      take(all.automatic_gap, c.automatic_gap);
      take(all.initial, c.initial);
      take(all.damping, c.damping);
      take(all.depth_limit, c.depth_limit);
      take(all.start_duration, c.start_duration);
    }
  }
  return all;
}

double largest_automatic_gap(const model::Model& model, const model::Interface& card) {
  const auto of_surface = [&model](Index surface) {
    double largest = 0.0;
    for (const model::Segment& s : model.surfaces[static_cast<std::size_t>(surface)].segments) {
      largest = std::max(largest, gap_thickness(model, s.element));
    }
    return largest;
  };
  if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) {
    return 0.5 * (of_surface(t3->surface_1) + of_surface(t3->surface_2));
  }
  const auto* t5 = std::get_if<model::InterfaceType5>(&card.type);
  if (t5 == nullptr) return 0.0;
  const std::vector<double> thickness = nodal_thickness(model);
  double largest = 0.0;
  for (const Index n : t5->nodes) largest = std::max(largest, thickness[static_cast<std::size_t>(n)]);
  return 0.5 * (largest + of_surface(t5->surface));
}

contact::Options one_sided_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                   const InterfaceChoices& choices) {
  contact::Options o;
  o.stiffness_scale = card.stfac;
  o.friction = card.friction;
  o.gap = card.gap;
  o.friction_law = friction_law_of(card);
  o.filter = filter_of(card, profile);
  o.birth = window_of(model, card).birth;
  o.death = window_of(model, card).death;
  o.rules = profile.reference_contact ? contact::Rules::reference() : contact::Rules::standard();
  o.shear_limit = profile.reference_contact ? model::infinity : card.ptlim;
  const InterfaceChoice choice = choice_of(choices, card.id);
  o.rules.law = choice.law.value_or(o.rules.law);
  o.automatic_gap = choice.automatic_gap.value_or(false);
  o.initial = choice.initial.value_or(contact::Initial::keep);
  o.damping = choice.damping.value_or(0.0);
  o.depth_limit = choice.depth_limit.value_or(0.0);
  o.start_duration = choice.start_duration.value_or(0.0);
  return o;
}

contact::BothSidesOptions both_sides_options(const model::Model& model, const model::Interface& card, const Profile& profile,
                                             std::span<const Vec3> x) {
  using Options = contact::BothSidesOptions;
  using Initial = Options::Initial;
  using Stiffness = Options::Stiffness;
  const auto& t7 = std::get<model::InterfaceType7>(card.type);
  const model::Surface& surface = model.surfaces[static_cast<std::size_t>(t7.surface)];
  Options o;
  const ShortestSides sides = shortest_sides(surface, x);
  o.gap = t7.gap_given ? card.gap : default_gap(model, t7, surface, sides.least);
  if (t7.igap > 0) variable_gap(model, t7, surface, sides, o);
  static constexpr Stiffness rules[] = {Stiffness::facet,  Stiffness::facet,   Stiffness::mean,
                                        Stiffness::larger, Stiffness::smaller, Stiffness::series};
  o.stiffness = rules[t7.istf];
  o.stiffness_min = t7.st_min;
  o.stiffness_max = t7.st_max;
  o.friction = card.friction;
  o.friction_law = friction_law_of(card);
  o.filter = filter_of(card, profile);
  o.friction_form = t7.iform == 2 ? Options::Friction::incremental : Options::Friction::viscous;
  o.damping = t7.vis_s;
  o.friction_viscosity = t7.vis_f;
  static constexpr Initial treatments[] = {Initial::keep, Initial::drop_nodes, Initial::drop_facets,       Initial::keep,
                                           Initial::keep, Initial::offset,     Initial::offset_with_margin};
  o.initial = treatments[t7.inacti];
  o.largest_penetration = t7.pen_max;
  o.birth = window_of(model, card).birth;
  o.death = window_of(model, card).death;
  o.reference_step = profile.reference_contact;
  o.switch_correction = !profile.reference_contact;
  o.all_pieces = profile.reference_contact;
  const model::Controls& control = model.controls;
  o.step_minimum = t7.dt_min;
  if (o.step_minimum == 0.0 && control.contact_action == model::StepControl::Action::remove) o.step_minimum = control.contact_minimum;
  o.step_scale = control.contact_scale;
  return o;
}

}  // namespace abut::init
