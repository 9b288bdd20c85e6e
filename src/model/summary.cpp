#include "model/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "model/measure.hpp"
#include "model/th_variables.hpp"

namespace abut::model {

namespace {

using Out = std::back_insert_iterator<std::string>;

std::string titled(std::string_view kind, Id id, const std::string& title) {
  return title.empty() ? fmt::format("{} {}", kind, id) : fmt::format("{} {} \"{}\"", kind, id, title);
}

std::string law_of(const Model& m, Index material) {
  if (material == no_index) return "no material";
  const Material& mat = m.materials[static_cast<std::size_t>(material)];
  const std::string_view law = std::holds_alternative<LawElastic>(mat.law)       ? "LAW1 elastic"
                               : std::holds_alternative<LawJohnsonCook>(mat.law) ? "LAW2 Johnson-Cook"
                                                                                 : "LAW0 void";
  return fmt::format("material {} ({})", mat.id, law);
}

std::string property_of(const Model& m, Index property) {
  if (property == no_index) return "no property";
  const Property& p = m.properties[static_cast<std::size_t>(property)];
  if (const auto* s = std::get_if<ShellProperty>(&p.data)) {
    return fmt::format("property {} (shell, Ishell {}, N {}, t {:.6g})", p.id, s->ishell, s->points, s->thickness);
  }
  if (const auto* s = std::get_if<SolidProperty>(&p.data)) return fmt::format("property {} (solid, Isolid {})", p.id, s->isolid);
  return fmt::format("property {} (void)", p.id);
}

void write_parts(Out out, const Model& m) {
  std::vector<std::array<Index, 4>> counts(m.parts.size(), {0, 0, 0, 0});
  const auto count = [&](const std::vector<Index>& parts, std::size_t family) {
    for (const Index p : parts) {
      if (p != no_index) ++counts[static_cast<std::size_t>(p)][family];
    }
  };
  count(m.shells.part, 0);
  count(m.sh3ns.part, 1);
  count(m.bricks.part, 2);
  count(m.tetras.part, 3);
  const std::vector<double> masses = part_masses(m);
  double total = 0.0, added = 0.0;
  for (const double mass : masses) total += mass;
  for (const AddedMass& a : m.added_masses) added += a.mass;
  fmt::format_to(out, "\nParts ({}), mass {:.6g} {}{}\n", m.parts.size(), total, m.units.mass_name,
                 added > 0.0 ? fmt::format(" and {:.6g} added to nodes", added) : std::string{});
  constexpr std::array<std::string_view, 4> names{"SHELL", "SH3N", "BRICK", "TETRA4"};
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    const Part& p = m.parts[i];
    std::string elements;
    for (std::size_t f = 0; f < names.size(); ++f) {
      if (counts[i][f] > 0) elements += fmt::format("{}{} {}", elements.empty() ? "" : ", ", counts[i][f], names[f]);
    }
    fmt::format_to(out, "  {}: {}, mass {:.6g}, {}, {}\n", titled("part", p.id, p.title), elements.empty() ? "no element" : elements,
                   masses[i], property_of(m, p.property), law_of(m, p.material));
  }
}

std::size_t node_count(const Surface& s) {
  std::set<Index> nodes;
  for (const Segment& segment : s.segments) nodes.insert(segment.nodes.begin(), segment.nodes.end());
  return nodes.size();
}

std::string side(const Model& m, Index surface) {
  if (surface == no_index) return "no surface";
  const Surface& s = m.surfaces[static_cast<std::size_t>(surface)];
  std::array<int, 3> behind{0, 0, 0};
  for (const Segment& segment : s.segments) {
    const ElementKind kind = segment.element.kind;
    ++behind[kind == ElementKind::shell4 || kind == ElementKind::shell3 ? 0 : kind == ElementKind::none ? 2 : 1];
  }
  constexpr std::array<std::string_view, 3> names{"on shells", "on solids", "on nothing"};
  std::string where;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (behind[i] > 0) where += fmt::format("{}{} {}", where.empty() ? "" : ", ", behind[i], names[i]);
  }
  return fmt::format("{}: {} nodes, {} segments ({})", titled("surface", s.id, s.title), node_count(s), s.segments.size(), where);
}

void write_interface(Out out, const Model& m, const Interface& i) {
  const int type = std::holds_alternative<InterfaceType3>(i.type) ? 3 : std::holds_alternative<InterfaceType5>(i.type) ? 5 : 7;
  fmt::format_to(out, "  {}, TYPE{}\n", titled("interface", i.id, i.title), type);
  if (const auto* t3 = std::get_if<InterfaceType3>(&i.type)) {
    fmt::format_to(out, "    {}\n    {}\n", side(m, t3->surface_1), side(m, t3->surface_2));
  } else if (const auto* t5 = std::get_if<InterfaceType5>(&i.type)) {
    fmt::format_to(out, "    {} secondary nodes\n    {}\n", t5->nodes.size(), side(m, t5->surface));
  } else if (const auto* t7 = std::get_if<InterfaceType7>(&i.type)) {
    fmt::format_to(out, "    {} secondary nodes\n    {}\n", t7->nodes.size(), side(m, t7->surface));
  }
  const auto* t7 = std::get_if<InterfaceType7>(&i.type);
  const std::string gap = t7 != nullptr && !t7->gap_given ? "automatic" : fmt::format("{:.6g}", i.gap);
  fmt::format_to(out, "    {} {:.6g}, gap {}, friction {:.6g}", t7 != nullptr && t7->istf == 1 ? "stiffness" : "Stfac", i.stfac, gap,
                 i.friction);
  if (i.t_start > 0.0 || i.t_stop < infinity) {
    fmt::format_to(out, ", from {:.6g} to {}", i.t_start, i.t_stop < infinity ? fmt::format("{:.6g}", i.t_stop) : "the end");
  }
  if (i.idel != 0) fmt::format_to(out, ", Idel {}", i.idel);
  if (i.ptlim < infinity) fmt::format_to(out, ", Ptlim {:.6g}", i.ptlim);
  if (i.ibc[0] || i.ibc[1] || i.ibc[2]) fmt::format_to(out, ", IBC {:d}{:d}{:d}", i.ibc[0], i.ibc[1], i.ibc[2]);
  fmt::format_to(out, "\n");
}

template <class T>
void count_line(Out out, std::string_view name, const std::vector<T>& items) {
  if (items.empty()) return;
  std::set<Index> nodes;
  for (const T& item : items) nodes.insert(item.nodes.begin(), item.nodes.end());
  fmt::format_to(out, "  {} {}, on {} {}\n", items.size(), name, nodes.size(), nodes.size() == 1 ? "node" : "nodes");
}

void write_conditions(Out out, const Model& m) {
  std::string text;
  Out lines(text);
  count_line(lines, "boundary conditions", m.boundary_conditions);
  count_line(lines, "initial velocities", m.initial_velocities);
  count_line(lines, "initial rotations", m.initial_rotations);
  count_line(lines, "imposed motions", m.imposed_motions);
  count_line(lines, "concentrated loads", m.concentrated_loads);
  for (const PressureLoad& p : m.pressure_loads) fmt::format_to(lines, "  pressure {} on {} segments\n", p.id, p.segments.size());
  count_line(lines, "gravities", m.gravities);
  for (const RigidBody& b : m.rigid_bodies) {
    fmt::format_to(lines, "  rigid body {}: {} secondary nodes{}\n", b.id, b.nodes.size(), b.active ? "" : ", switched off");
  }
  for (const RigidWall& w : m.rigid_walls) {
    constexpr std::array<std::string_view, 3> slide{"frictionless", "tied", "with friction"};
    fmt::format_to(lines, "  {}: {} plane{}, {} nodes, normal ({:.4g}, {:.4g}, {:.4g})\n", titled("rigid wall", w.id, w.title),
                   slide[static_cast<std::size_t>(w.slide)], w.node == no_index ? "" : " that moves", w.nodes.size(), w.normal.x,
                   w.normal.y, w.normal.z);
  }
  fmt::format_to(out, "\nConditions\n{}", text.empty() ? "  none\n" : text);
}

void write_outputs(Out out, const Model& m) {
  const Controls& k = m.controls;
  fmt::format_to(out, "\nRun\n  until {:.6g} {}", k.t_end, m.units.time_name);
  if (k.history_interval < infinity) fmt::format_to(out, ", history every {:.6g}", k.history_interval);
  if (k.animation_interval < infinity) fmt::format_to(out, ", animation every {:.6g} from {:.6g}", k.animation_interval, k.animation_start);
  fmt::format_to(out, "\n");
  std::map<ThKind, int> requests;
  for (const ThRequest& r : m.th_requests) ++requests[r.kind];
  if (!requests.empty()) {
    std::string list;
    for (const auto& [kind, count] : requests) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, th_word(kind));
    fmt::format_to(out, "  time history of {}\n", list);
  }
  if (!k.animation_fields.empty()) fmt::format_to(out, "  animation of {}\n", fmt::join(k.animation_fields, ", "));
  if (!m.sections.empty()) fmt::format_to(out, "  {} sections\n", m.sections.size());
}

}  // namespace

std::string summary(const Model& m) {
  std::string text;
  Out out(text);
  fmt::format_to(out, "{}{}{}\n", m.name, m.title.empty() ? "" : ": ", m.title);
  fmt::format_to(out, "  format {}, units {} {} {}\n", m.version, m.units.mass_name, m.units.length_name, m.units.time_name);
  fmt::format_to(out, "  {} nodes, {} SHELL, {} SH3N, {} BRICK, {} TETRA4\n", m.node_count(), m.shells.size(), m.sh3ns.size(),
                 m.bricks.size(), m.tetras.size());
  write_parts(out, m);
  fmt::format_to(out, "\nInterfaces{}\n", m.interfaces.empty() ? ": none" : "");
  for (const Interface& i : m.interfaces) write_interface(out, m, i);
  write_conditions(out, m);
  write_outputs(out, m);
  if (!m.skipped.empty()) {
    fmt::format_to(out, "\nRead past, as they cannot change the mechanics\n");
    for (const SkippedKeyword& s : m.skipped) fmt::format_to(out, "  {} ({})\n", s.keyword, s.count);
  }
  return text;
}

}  // namespace abut::model
