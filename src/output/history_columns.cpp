#include "output/history_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "output/skew_axes.hpp"

namespace abut::output {
namespace {

using cycle::Snapshot;
using Value = std::function<double(const Snapshot&)>;
constexpr std::array<std::string_view, 3> letters{"X", "Y", "Z"};

/// "DX" -> {"D", 0}: a vector's name and its component.
std::optional<std::pair<std::string_view, int>> split_component(std::string_view variable) {
  for (int c = 0; c < 3; ++c) {
    if (variable.ends_with(letters[static_cast<std::size_t>(c)])) return std::pair{variable.substr(0, variable.size() - 1), c};
  }
  return std::nullopt;
}

Value balance_term(double state::Balance::*term) {
  return [term](const Snapshot& s) { return s.balance->*term; };
}

// ---- nodes (8.4) --------------------------------------------------------------------------------------------------

using NodalVectors = state::ZeroArray<Vec3> state::State::*;
constexpr std::array<std::pair<std::string_view, NodalVectors>, 6> nodal_vectors{{{"D", &state::State::u},
                                                                                  {"V", &state::State::v},
                                                                                  {"A", &state::State::a},
                                                                                  {"VR", &state::State::w},
                                                                                  {"AR", &state::State::alpha},
                                                                                  {"", &state::State::x}}};

Value node_value(std::string_view variable, Index node, Index skew) {
  const auto parts = split_component(variable);
  if (!parts) return {};
  const auto [vector, component] = *parts;
  const auto found = std::find_if(nodal_vectors.begin(), nodal_vectors.end(), [v = vector](const auto& p) { return p.first == v; });
  if (found == nodal_vectors.end()) return {};
  const auto n = static_cast<std::size_t>(node);
  if (skew == no_index || vector.empty()) {
    return [member = found->second, n, c = component](const Snapshot& s) { return (s.state->*member)[n][c]; };
  }
  return [member = found->second, n, c = component, skew](const Snapshot& s) {
    const auto axes = skew_axes(s.model->skews[static_cast<std::size_t>(skew)], s.state->x);
    return dot((s.state->*member)[n], axes[static_cast<std::size_t>(c)]);
  };
}

// ---- parts (8.3) --------------------------------------------------------------------------------------------------

Value part_value(std::string_view variable, Index index) {
  using cycle::PartResult;
  static const std::map<std::string_view, double (*)(const PartResult&)> table{
      {"IE", [](const PartResult& p) { return p.ie; }},
      {"HE", [](const PartResult& p) { return p.he; }},
      {"KE", [](const PartResult& p) { return p.sums.kinetic_energy; }},
      {"RKE", [](const PartResult& p) { return p.sums.rotational_energy; }},
      {"MASS", [](const PartResult& p) { return p.sums.mass; }},
      {"XMOM", [](const PartResult& p) { return p.sums.momentum.x; }},
      {"YMOM", [](const PartResult& p) { return p.sums.momentum.y; }},
      {"ZMOM", [](const PartResult& p) { return p.sums.momentum.z; }},
      {"VX", [](const PartResult& p) { return p.sums.mass > 0.0 ? p.sums.momentum.x / p.sums.mass : 0.0; }},
      {"VY", [](const PartResult& p) { return p.sums.mass > 0.0 ? p.sums.momentum.y / p.sums.mass : 0.0; }},
      {"VZ", [](const PartResult& p) { return p.sums.mass > 0.0 ? p.sums.momentum.z / p.sums.mass : 0.0; }},
      {"ERODED", [](const PartResult& p) { return static_cast<double>(p.eroded); }}};
  const auto found = table.find(variable);
  if (found == table.end()) return {};
  return [f = found->second, i = static_cast<std::size_t>(index)](const Snapshot& s) { return f(s.parts[i]); };
}

// ---- elements (8.5, 8.6) ------------------------------------------------------------------------------------------

using ElementValue = double (*)(const elements::ElementOutput&);

const std::map<std::string_view, ElementValue>& shell_table() {
  using Out = elements::ElementOutput;
  static const std::map<std::string_view, ElementValue> table{{"F1", [](const Out& o) { return o.resultants[0]; }},
                                                              {"F2", [](const Out& o) { return o.resultants[1]; }},
                                                              {"F12", [](const Out& o) { return o.resultants[2]; }},
                                                              {"Q1", [](const Out& o) { return o.resultants[3]; }},
                                                              {"Q2", [](const Out& o) { return o.resultants[4]; }},
                                                              {"M1", [](const Out& o) { return o.resultants[5]; }},
                                                              {"M2", [](const Out& o) { return o.resultants[6]; }},
                                                              {"M12", [](const Out& o) { return o.resultants[7]; }},
                                                              {"IEM", [](const Out& o) { return o.membrane_energy; }},
                                                              {"IEB", [](const Out& o) { return o.bending_energy; }},
                                                              {"OFF", [](const Out& o) { return o.off; }},
                                                              {"EMIN", [](const Out& o) { return o.plastic_min; }},
                                                              {"EMAX", [](const Out& o) { return o.plastic_max; }},
                                                              {"THIC", [](const Out& o) { return o.thickness; }}};
  return table;
}

const std::map<std::string_view, ElementValue>& brick_table() {
  using Out = elements::ElementOutput;
  static const std::map<std::string_view, ElementValue> table{{"OFF", [](const Out& o) { return o.off; }},
                                                              {"SX", [](const Out& o) { return o.stress[0]; }},
                                                              {"SY", [](const Out& o) { return o.stress[1]; }},
                                                              {"SZ", [](const Out& o) { return o.stress[2]; }},
                                                              {"SXY", [](const Out& o) { return o.stress[3]; }},
                                                              {"SYZ", [](const Out& o) { return o.stress[4]; }},
                                                              {"SXZ", [](const Out& o) { return o.stress[5]; }},
                                                              {"DENS", [](const Out& o) { return o.density; }},
                                                              {"VOL", [](const Out& o) { return o.volume; }},
                                                              {"PLAS", [](const Out& o) { return o.plastic_max; }},
                                                              {"BULK", [](const Out& o) { return o.bulk_viscosity; }}};
  return table;
}

/// Value of an element; an element of a part without stiffness (void) has no group and shows zeros.
Value element_value(const std::map<std::string_view, ElementValue>& table, std::string_view variable, ElementPlace place) {
  const auto found = table.find(variable);
  if (found == table.end()) return {};
  if (!place.exists()) return [](const Snapshot&) { return 0.0; };
  return
      [f = found->second, place](const Snapshot& s) { return f(s.groups[static_cast<std::size_t>(place.group)]->output(place.element)); };
}

/// IE of a brick is an energy per initial volume (8.6): energy times initial density over mass.
Value brick_value(const model::Model& model, std::string_view variable, ElementPlace place) {
  if (variable != "IE" || !place.exists()) {
    if (variable == "IE") return [](const Snapshot&) { return 0.0; };
    return element_value(brick_table(), variable, place);
  }
  return [place, &materials = model.materials, &parts = model.parts](const Snapshot& s) {
    const elements::Group& group = *s.groups[static_cast<std::size_t>(place.group)];
    const Index material = parts[static_cast<std::size_t>(group.part())].material;
    const double mass = group.element_mass(place.element);
    return mass > 0.0 ? group.output(place.element).internal_energy * materials[static_cast<std::size_t>(material)].density / mass : 0.0;
  };
}

// ---- interfaces, walls, sections, bodies (8.2, 8.7) ---------------------------------------------------------------

/// Named vectors of a result, e.g. "FN" -> normal_force; the same name with a leading I is the impulse.
template <typename Result>
using VectorTable = std::vector<std::pair<std::string_view, Vec3 Result::*>>;

const VectorTable<cycle::InterfaceResult>& vectors(const cycle::InterfaceResult*) {
  using R = cycle::InterfaceResult;
  static const VectorTable<R> table{
      {"FN", &R::normal_force}, {"FT", &R::tangential_force}, {"IFN", &R::normal_impulse}, {"IFT", &R::tangential_impulse}};
  return table;
}
const VectorTable<cycle::WallResult>& vectors(const cycle::WallResult*) {
  using R = cycle::WallResult;
  static const VectorTable<R> table{
      {"FN", &R::normal_force}, {"FT", &R::tangential_force}, {"IFN", &R::normal_impulse}, {"IFT", &R::tangential_impulse}};
  return table;
}
const VectorTable<cycle::SectionResult>& vectors(const cycle::SectionResult*) {
  using R = cycle::SectionResult;
  static const VectorTable<R> table{
      {"FN", &R::normal_force}, {"FT", &R::tangential_force}, {"IFN", &R::normal_impulse}, {"IFT", &R::tangential_impulse}};
  return table;
}
const VectorTable<cycle::AccelerometerResult>& vectors(const cycle::AccelerometerResult*) {
  using R = cycle::AccelerometerResult;
  static const VectorTable<R> table{{"A", &R::filtered}, {"W", &R::integral}};
  return table;
}
const VectorTable<cycle::BodyResult>& vectors(const cycle::BodyResult*) {
  using R = cycle::BodyResult;
  static const VectorTable<R> table{
      {"F", &R::force}, {"M", &R::moment}, {"IF", &R::force_impulse}, {"IM", &R::moment_impulse}, {"R", &R::rotation}};
  return table;
}

template <typename Result>
Value vector_value(std::string_view variable, std::span<const Result> Snapshot::*results, Index index) {
  const auto parts = split_component(variable);
  if (!parts) return {};
  for (const auto& [name, member] : vectors(static_cast<const Result*>(nullptr))) {
    if (name == parts->first) {
      return [results, m = member, i = static_cast<std::size_t>(index), c = parts->second](const Snapshot& s) {
        return ((s.*results)[i].*m)[c];
      };
    }
  }
  return {};
}

Value interface_value(const model::Model& model, std::string_view variable, Index index) {
  using R = cycle::InterfaceResult;
  static const std::map<std::string_view, double R::*> scalars{{"CE", &R::ce},      {"FW", &R::fw},     {"DW", &R::dw},
                                                               {"CX", &R::cx},      {"SW", &R::sw},     {"CE_ELAST", &R::ce},
                                                               {"CE_FRIC", &R::fw}, {"CE_DAMP", &R::dw}};
  const auto i = static_cast<std::size_t>(index);
  const model::Interface& card = model.interfaces[i];
  const bool type3 = std::holds_alternative<model::InterfaceType3>(card.type);
  if (type3 || std::holds_alternative<model::InterfaceType5>(card.type)) {
    if (variable == "APPR") return [i](const Snapshot& s) { return s.interfaces[i].peak_approach; };
    if (variable == "FACE1" && type3) return [i](const Snapshot& s) { return s.interfaces[i].facing[0]; };
    if (variable == "FACE2") return [i](const Snapshot& s) { return s.interfaces[i].facing[1]; };
  }
  if (variable == "NC") return [i](const Snapshot& s) { return static_cast<double>(s.interfaces[i].in_contact); };
  if (const auto found = scalars.find(variable); found != scalars.end()) {
    return [i, m = found->second](const Snapshot& s) { return s.interfaces[i].*m; };
  }
  return vector_value(variable, &Snapshot::interfaces, index);
}

Value section_value(std::string_view variable, Index index) {
  static const std::map<std::string_view, std::pair<Vec3 cycle::SectionResult::*, int>> moments{
      {"M1", {&cycle::SectionResult::moment, 0}},          {"M2", {&cycle::SectionResult::moment, 1}},
      {"M3", {&cycle::SectionResult::moment, 2}},          {"IM1", {&cycle::SectionResult::moment_impulse, 0}},
      {"IM2", {&cycle::SectionResult::moment_impulse, 1}}, {"IM3", {&cycle::SectionResult::moment_impulse, 2}}};
  if (const auto found = moments.find(variable); found != moments.end()) {
    const auto [member, c] = found->second;
    return [m = member, k = c, i = static_cast<std::size_t>(index)](const Snapshot& s) { return (s.sections[i].*m)[k]; };
  }
  return vector_value(variable, &Snapshot::sections, index);
}

Value body_value(const model::Model& model, std::string_view variable, Index index) {
  Value value = vector_value(variable, &Snapshot::bodies, index);
  if (!value) value = node_value(variable, model.rigid_bodies[static_cast<std::size_t>(index)].main, no_index);
  return value;
}

// ---- all of them --------------------------------------------------------------------------------------------------

std::string_view kind_name(model::ThKind kind) {
  switch (kind) {
    case model::ThKind::node:
      return "NODE";
    case model::ThKind::part:
      return "PART";
    case model::ThKind::shell:
      return "SHEL";
    case model::ThKind::sh3n:
      return "SH3N";
    case model::ThKind::brick:
      return "BRIC";
    case model::ThKind::inter:
      return "INTER";
    case model::ThKind::rwall:
      return "RWALL";
    case model::ThKind::rbody:
      return "RBODY";
    case model::ThKind::section:
      return "SECTIO";
    case model::ThKind::accelerometer:
      return "ACCEL";
  }
  return "";
}

const std::vector<std::string>& always_written(model::ThKind kind) {
  static const std::vector<std::string> inter{"IFNX", "IFNY", "IFNZ", "IFTX", "IFTY", "IFTZ", "CE", "FW", "DW", "CX", "NC"};
  static const std::vector<std::string> wall{"IFNX", "IFNY", "IFNZ", "IFTX", "IFTY", "IFTZ"};
  static const std::vector<std::string> section{"IFNX", "IFNY", "IFNZ", "IFTX", "IFTY", "IFTZ", "IM1", "IM2", "IM3"};
  static const std::vector<std::string> body{"IFX", "IFY", "IFZ", "IMX", "IMY", "IMZ"};
  static const std::vector<std::string> none;
  switch (kind) {
    case model::ThKind::inter:
      return inter;
    case model::ThKind::rwall:
      return wall;
    case model::ThKind::section:
      return section;
    case model::ThKind::rbody:
      return body;
    default:
      return none;
  }
}

class Builder {
 public:
  Builder(const model::Model& model, const ElementLookup& lookup) : model_(model), lookup_(lookup) {}

  HistoryColumns build() {
    add_balance();
    for (const model::ThRequest& request : model_.th_requests) add_request(request);
    for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
      const Id id = model_.interfaces[i].id;
      if (objects_.contains({model::ThKind::inter, id})) continue;
      model::ThRequest request;
      request.kind = model::ThKind::inter;
      request.id = id;
      request.index = static_cast<Index>(i);
      request.variables = {"FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ"};
      add_request(request);
    }
    return std::move(result_);
  }

 private:
  void add_balance() {
    using B = state::Balance;
    static constexpr std::array<std::pair<std::string_view, double B::*>, 12> terms{{{"IE", &B::ie},
                                                                                     {"HE", &B::he},
                                                                                     {"KE", &B::ke},
                                                                                     {"KER", &B::ker},
                                                                                     {"CE", &B::ce},
                                                                                     {"FW", &B::fw},
                                                                                     {"DW", &B::dw},
                                                                                     {"CX", &B::cx},
                                                                                     {"EXTW", &B::extw},
                                                                                     {"XE", &B::xe},
                                                                                     {"ERR", &B::err},
                                                                                     {"LEDGER", &B::ledger}}};
    for (const auto& [name, term] : terms) add(fmt::format("GLOBAL/{}", name), balance_term(term));
    for (int c = 0; c < 3; ++c) {
      add(fmt::format("GLOBAL/{}MOM", letters[static_cast<std::size_t>(c)]), [c](const Snapshot& s) { return s.balance->momentum[c]; });
    }
    add("GLOBAL/DT", [](const Snapshot& s) { return s.state->times.h_plus; });
    add("GLOBAL/DTKIND", [](const Snapshot& s) { return static_cast<double>(s.controller.kind); });
    add("GLOBAL/DTID", [](const Snapshot& s) { return static_cast<double>(s.controller.id); });
  }

  void add_request(const model::ThRequest& request) {
    const auto [object, is_new] = objects_.try_emplace({request.kind, request.id}, request.skew);
    std::string id = std::to_string(request.id);
    if (!is_new && object->second != request.skew) {
      id += fmt::format(":{}", request.skew == no_index ? 0 : model_.skews[static_cast<std::size_t>(request.skew)].id);
    }
    const std::string prefix = fmt::format("{}/{}/", kind_name(request.kind), id);
    for (const std::string& variable : request.variables) add_variable(prefix, request, variable);
    for (const std::string& variable : always_written(request.kind)) add_variable(prefix, request, variable);
    if (request.kind != model::ThKind::inter || request.index == no_index) return;
    for (const char* variable : {"APPR", "FACE1", "FACE2"}) {  // as far as the type has them
      if (value_of(request, variable)) add_variable(prefix, request, variable);
    }
  }

  void add_variable(const std::string& prefix, const model::ThRequest& request, const std::string& variable) {
    if (names_.contains(prefix + variable)) return;
    Value value = value_of(request, variable);
    if (value) {
      add(prefix + variable, std::move(value));
      return;
    }
    std::string name = fmt::format("{} {}", kind_name(request.kind), variable);
    if (std::find(result_.left_out.begin(), result_.left_out.end(), name) == result_.left_out.end()) {
      result_.left_out.push_back(std::move(name));
    }
  }

  [[nodiscard]] Value value_of(const model::ThRequest& request, std::string_view variable) const {
    if (request.index == no_index) return {};
    switch (request.kind) {
      case model::ThKind::node:
        return node_value(variable, request.index, request.skew);
      case model::ThKind::part:
        return part_value(variable, request.index);
      case model::ThKind::shell:
        return element_value(shell_table(), variable, lookup_.find(model::ElementKind::shell4, request.index));
      case model::ThKind::sh3n:
        return element_value(shell_table(), variable, lookup_.find(model::ElementKind::shell3, request.index));
      case model::ThKind::brick:
        return brick_value(model_, variable, lookup_.find(model::ElementKind::brick, request.index));
      case model::ThKind::inter:
        return interface_value(model_, variable, request.index);
      case model::ThKind::rwall:
        return vector_value(variable, &Snapshot::walls, request.index);
      case model::ThKind::rbody:
        return body_value(model_, variable, request.index);
      case model::ThKind::section:
        return section_value(variable, request.index);
      case model::ThKind::accelerometer:
        return vector_value(variable, &Snapshot::accelerometers, request.index);
    }
    return {};
  }

  void add(std::string name, Value value) {
    names_.insert(name);
    result_.columns.push_back({std::move(name), std::move(value)});
  }

  const model::Model& model_;
  const ElementLookup& lookup_;
  HistoryColumns result_;
  std::set<std::string> names_;
  std::map<std::pair<model::ThKind, Id>, Index> objects_;  ///< first skew in which each object was asked for
};

}  // namespace

HistoryColumns make_history_columns(const model::Model& model, const ElementLookup& lookup) { return Builder(model, lookup).build(); }

}  // namespace abut::output
