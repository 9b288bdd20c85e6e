#include "output/json.hpp"

#include <string_view>

#include "output/summary.hpp"

namespace abut::output {
namespace {

static_assert(static_cast<int>(Severity::error) == static_cast<int>(contact::Severity::error) && static_cast<int>(Severity::note) == 0 &&
              static_cast<int>(contact::Severity::note) == 0);

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "error";
}

Json finding_json(const Diagnostic& d) {
  Json j{{"severity", severity_name(d.severity)}, {"code", d.code}, {"message", d.message}};
  if (!d.place.file.empty()) j["file"] = d.place.file;
  if (d.place.line > 0) j["line"] = d.place.line;
  if (!d.place.keyword.empty()) j["keyword"] = d.place.keyword;
  if (!d.place.field.empty()) j["field"] = d.place.field;
  if (d.place.first_column > 0) j["columns"] = {d.place.first_column, d.place.last_column};
  return j;
}

}  // namespace

Json findings_json(const std::vector<Diagnostic>& findings) {
  Json j = Json::array();
  for (const Diagnostic& d : findings) j.push_back(finding_json(d));
  return j;
}

Json model_json(const model::Model& m, std::span<const double> part_mass) {
  Json j{{"name", m.name},
         {"title", m.title},
         {"units", {{"mass", m.units.mass_name}, {"length", m.units.length_name}, {"time", m.units.time_name}}},
         {"nodes", m.node_count()},
         {"shells", m.shells.size()},
         {"sh3ns", m.sh3ns.size()},
         {"bricks", m.bricks.size()},
         {"tetras", m.tetras.size()}};
  j["parts"] = Json::array();
  for (std::size_t p = 0; p < m.parts.size(); ++p) {
    Json part{{"id", m.parts[p].id}, {"title", m.parts[p].title}};
    if (p < part_mass.size()) part["mass"] = part_mass[p];
    j["parts"].push_back(part);
  }
  j["interfaces"] = Json::array();
  for (const model::Interface& i : m.interfaces) {
    j["interfaces"].push_back({{"id", i.id},
                               {"title", i.title},
                               {"type", interface_type(i)},
                               {"stiffness_scale", i.stfac},
                               {"friction", i.friction},
                               {"gap", effective_gap(m, i)},
                               {"gap_is_automatic", has_automatic_gap(i)}});
  }
  j["t_end"] = m.controls.t_end;
  return j;
}

Json contact_json(const std::vector<init::ContactFinding>& findings) {
  Json all = Json::array();
  for (const init::ContactFinding& c : findings) {
    const contact::Finding& f = c.finding;
    Json j{{"interface", c.interface_id}};
    if (c.surface_id != 0) j["surface"] = c.surface_id;
    j["severity"] = severity_name(static_cast<Severity>(f.severity));
    j["code"] = f.code;
    j["what"] = f.what;
    j["advice"] = f.advice;
    j["measure"] = {{"name", f.measure_name}, {"value", f.measure}};
    if (!c.nodes.empty()) j["nodes"] = c.nodes;
    if (!c.segments.empty()) j["segments"] = c.segments;
    for (const contact::Bar& bar : f.histogram) j["histogram"].push_back({{"low", bar.low}, {"high", bar.high}, {"count", bar.count}});
    all.push_back(std::move(j));
  }
  return all;
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace abut::output
