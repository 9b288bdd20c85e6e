#include "output/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <vector>

#include "init/contact_options.hpp"

namespace abut::output {
namespace {

template <typename... Args>
void print(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

std::string quoted(const std::string& title) { return title.empty() ? "" : fmt::format(" \"{}\"", title); }

std::string_view law_name(const model::Law& law) {
  struct Name {
    std::string_view operator()(const model::LawVoid&) const { return "LAW0 void"; }
    std::string_view operator()(const model::LawElastic&) const { return "LAW1 elastic"; }
    std::string_view operator()(const model::LawJohnsonCook&) const { return "LAW2 Johnson-Cook"; }
  };
  return std::visit(Name{}, law);
}

std::string property_text(const model::Property& property) {
  struct Text {
    std::string operator()(const model::ShellProperty& p) const {
      return fmt::format("shell Ishell {} N {} t {:.5g}", p.ishell, p.points, p.thickness);
    }
    std::string operator()(const model::SolidProperty& p) const { return fmt::format("solid Isolid {} Iframe {}", p.isolid, p.iframe); }
    std::string operator()(const model::VoidProperty&) const { return "void"; }
  };
  return std::visit(Text{}, property.data);
}

std::vector<Index> elements_of_parts(const model::Model& model) {
  std::vector<Index> out(model.parts.size(), 0);
  const auto count = [&out](const auto& table) {
    for (const Index part : table.part) {
      if (part != no_index) ++out[static_cast<std::size_t>(part)];
    }
  };
  count(model.shells);
  count(model.sh3ns);
  count(model.bricks);
  count(model.tetras);
  return out;
}

void print_parts(std::string& out, const model::Model& model, std::span<const double> part_mass) {
  print(out, "Parts\n");
  double total = 0.0;
  const std::vector<Index> elements = elements_of_parts(model);
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const model::Part& part = model.parts[p];
    print(out, "  {:>8}  {:>8} elements", part.id, elements[p]);
    if (p < part_mass.size()) {
      print(out, "  mass {:<12.6g}", part_mass[p]);
      total += part_mass[p];
    }
    if (part.property != no_index) print(out, "  {}", property_text(model.properties[static_cast<std::size_t>(part.property)]));
    if (part.material != no_index) print(out, ", {}", law_name(model.materials[static_cast<std::size_t>(part.material)].law));
    print(out, "{}\n", quoted(part.title));
  }
  if (!part_mass.empty()) print(out, "  mass of all elements {:.8g}\n", total);
}

std::string surface_text(const model::Model& model, Index index) {
  if (index == no_index) return "nothing";
  const model::Surface& s = model.surfaces[static_cast<std::size_t>(index)];
  return fmt::format("surface {}{} ({} segments)", s.id, quoted(s.title), s.segments.size());
}

std::string joins_text(const model::Model& model, const model::Interface& interface) {
  struct Text {
    const model::Model& model;
    std::string operator()(const model::InterfaceType3& t) const {
      return fmt::format("{} and {}", surface_text(model, t.surface_1), surface_text(model, t.surface_2));
    }
    std::string operator()(const model::InterfaceType5& t) const {
      return fmt::format("{} nodes against {}", t.nodes.size(), surface_text(model, t.surface));
    }
    std::string operator()(const model::InterfaceType7& t) const {
      return fmt::format("{} nodes against {}, both sides", t.nodes.size(), surface_text(model, t.surface));
    }
  };
  return std::visit(Text{model}, interface.type);
}

void print_interfaces(std::string& out, const model::Model& model) {
  if (model.interfaces.empty()) return;
  print(out, "Interfaces\n");
  for (const model::Interface& i : model.interfaces) {
    print(out, "  {:>8}  {}{}: {}\n", i.id, interface_type(i), quoted(i.title), joins_text(model, i));
    print(out, "            stiffness scale {:.5g}, friction {:.5g}, gap {:.5g}{}", i.stfac, i.friction, effective_gap(model, i),
          has_automatic_gap(i) ? " (automatic)" : "");
    if (i.t_start > 0.0) print(out, ", from {:.5g}", i.t_start);
    if (i.t_stop < model::infinity) print(out, ", until {:.5g}", i.t_stop);
    print(out, "\n");
  }
}

void print_conditions(std::string& out, const model::Model& model) {
  std::string line;
  const auto add = [&line](std::size_t count, std::string_view what) {
    if (count > 0) print(line, "{}{} {}", line.empty() ? "" : ", ", count, what);
  };
  add(model.boundary_conditions.size(), "boundary conditions");
  add(model.initial_velocities.size(), "initial velocities");
  add(model.imposed_motions.size(), "imposed motions");
  add(model.concentrated_loads.size(), "concentrated loads");
  add(model.pressure_loads.size(), "pressure loads");
  add(model.gravities.size(), "gravity loads");
  std::set<Index> heavier;
  for (const model::AddedMass& a : model.added_masses) heavier.insert(a.node);
  add(heavier.size(), "nodes with added mass");
  add(model.rigid_bodies.size(), "rigid bodies");
  add(model.rigid_walls.size(), "rigid walls");
  add(model.sections.size(), "sections");
  if (!line.empty()) print(out, "Conditions  {}\n", line);
}

}  // namespace

std::string run_summary(const model::Controls& c) {
  std::string out = fmt::format("{:<12}until {:.6g}", c.run_number > 1 ? fmt::format("Run {}", c.run_number) : "Run", c.t_end);
  if (c.history_interval < model::infinity) print(out, ", history every {:.6g}", c.history_interval);
  if (c.animation_interval < model::infinity) print(out, ", animation every {:.6g}", c.animation_interval);
  print(out, ", listing every {} cycles\n", c.print_every);
  return out;
}

bool has_automatic_gap(const model::Interface& interface) {
  const auto* t7 = std::get_if<model::InterfaceType7>(&interface.type);
  return t7 != nullptr && !t7->gap_given;
}

double effective_gap(const model::Model& model, const model::Interface& interface) {
  if (!has_automatic_gap(interface)) return interface.gap;
  return init::both_sides_options(model, interface, Profile::standard(), model.node_x).gap;
}

std::string_view interface_type(const model::Interface& interface) {
  constexpr std::string_view names[] = {"TYPE3", "TYPE5", "TYPE7"};
  return names[interface.type.index()];
}

std::string_view controller_name(cycle::StepController::Kind kind) {
  using Kind = cycle::StepController::Kind;
  switch (kind) {
    case Kind::none:
      return "-";
    case Kind::shell:
      return "SHELL";
    case Kind::sh3n:
      return "SH3N";
    case Kind::brick:
      return "BRICK";
    case Kind::tetra:
      return "TETRA";
    case Kind::node:
      return "NODE";
    case Kind::interface:
      return "INTER";
    case Kind::fixed:
      return "FIXED";
    case Kind::contact_node:
      return "CONTACT AT NODE";
  }
  return "-";
}

std::string first_step_text(const Inspection& inspection) {
  constexpr std::string_view names[] = {
      "nothing", "shell", "triangle", "brick", "tetrahedron", "node", "interface", "the deck's step limit", "contact at node"};
  const StepController& who = inspection.controller;
  return fmt::format("first time step {:.6g}, controlled by {}{}", inspection.first_step, names[static_cast<std::size_t>(who.kind)],
                     who.id != 0 ? fmt::format(" {}", who.id) : "");
}

std::string_view outcome_name(cycle::Outcome::Kind kind) {
  using Kind = cycle::Outcome::Kind;
  switch (kind) {
    case Kind::finished:
      return "finished";
    case Kind::stopped:
      return "stopped";
    case Kind::interrupted:
      return "interrupted";
    case Kind::failed:
      return "failed";
  }
  return "failed";
}

std::string outcome_text(const cycle::Outcome& outcome) {
  using Kind = cycle::Outcome::Kind;
  const bool passive = outcome.kind == Kind::stopped || outcome.kind == Kind::interrupted;
  return fmt::format("{}{} at time {:.8g} after {} cycles{}{}", passive ? "was " : "", outcome_name(outcome.kind), outcome.time,
                     outcome.cycles, outcome.message.empty() ? "" : ": ", outcome.message);
}

Index element_count(const model::Model& model) {
  return model.shells.size() + model.sh3ns.size() + model.bricks.size() + model.tetras.size();
}

std::string model_summary(const model::Model& model, std::span<const double> part_mass) {
  std::string out;
  print(out, "Model       {}{}\n", model.name, quoted(model.title));
  print(out, "Units       {} {} {}\n", model.units.mass_name, model.units.length_name, model.units.time_name);
  print(out, "Counts      {} nodes, {} shells, {} 3-node shells, {} bricks, {} tetrahedra\n", model.node_count(), model.shells.size(),
        model.sh3ns.size(), model.bricks.size(), model.tetras.size());
  print_parts(out, model, part_mass);
  print_interfaces(out, model);
  print_conditions(out, model);
  out += run_summary(model.controls);
  if (!model.skipped.empty()) {
    print(out, "Skipped     keywords that do not change the physics:");
    for (const model::SkippedKeyword& s : model.skipped) print(out, " {} ({})", s.keyword, s.count);
    print(out, "\n");
  }
  return out;
}

}  // namespace abut::output
