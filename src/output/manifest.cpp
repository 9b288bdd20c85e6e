#include "output/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/element_lookup.hpp"
#include "output/summary.hpp"

namespace abut::output {
namespace {

using Json = nlohmann::ordered_json;

/// Text of a JSON document; a deck may hold bytes that are not UTF-8 (titles of old decks), they become U+FFFD.
std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
  }
  return "error";
}

Json to_json(const Diagnostic& d) {
  Json j{{"severity", severity_name(d.severity)}, {"code", d.code}, {"message", d.message}};
  if (!d.place.file.empty()) j["file"] = d.place.file;
  if (d.place.line > 0) j["line"] = d.place.line;
  if (!d.place.keyword.empty()) j["keyword"] = d.place.keyword;
  if (!d.place.field.empty()) j["field"] = d.place.field;
  if (d.place.first_column > 0) j["columns"] = {d.place.first_column, d.place.last_column};
  return j;
}

Json model_json(const cycle::Snapshot& first) {
  const model::Model& m = *first.model;
  Json j{{"name", m.name},
         {"title", m.title},
         {"units", {{"mass", m.units.mass_name}, {"length", m.units.length_name}, {"time", m.units.time_name}}},
         {"nodes", m.node_count()},
         {"shells", m.shells.size()},
         {"sh3ns", m.sh3ns.size()},
         {"bricks", m.bricks.size()},
         {"tetras", m.tetras.size()}};
  const std::vector<double> masses = part_masses(m, first.groups);
  j["parts"] = Json::array();
  for (std::size_t p = 0; p < m.parts.size(); ++p) {
    j["parts"].push_back({{"id", m.parts[p].id}, {"title", m.parts[p].title}, {"mass", masses[p]}});
  }
  j["interfaces"] = Json::array();
  for (const model::Interface& i : m.interfaces) {
    j["interfaces"].push_back({{"id", i.id},
                               {"title", i.title},
                               {"type", interface_type(i)},
                               {"stiffness_scale", i.stfac},
                               {"friction", i.friction},
                               {"gap", i.gap}});
  }
  j["t_end"] = m.controls.t_end;
  return j;
}

Json energies_json(const state::Balance& b) {
  return {{"IE", b.ie}, {"HE", b.he}, {"KE", b.ke},     {"KER", b.ker}, {"CE", b.ce},           {"FW", b.fw},          {"DW", b.dw},
          {"CX", b.cx}, {"XE", b.xe}, {"EXTW", b.extw}, {"ERR", b.err}, {"LEDGER", b.ledger}, {"initial", b.initial}, {"largest", b.largest}};
}

}  // namespace

Manifest::Manifest(RunFolder folder, RunInfo info, std::function<std::vector<PhaseTime>()> timings)
    : folder_(std::move(folder)), info_(std::move(info)), timings_(std::move(timings)) {}

void Manifest::begin(const cycle::Snapshot& first) {
  record_.begin(first);
  Json j;
  j["abut"] = {{"version", info_.version}, {"commit", info_.commit}, {"compiler", info_.compiler}};
  j["started"] = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  j["decks"] = info_.decks;
  j["settings"] = {{"profile", info_.profile},
                   {"interface_law", info_.interface_law.empty() ? Json(nullptr) : Json(info_.interface_law)},
                   {"threads", info_.threads},
                   {"instruction_set", info_.instruction_set},
                   {"hash_every", info_.hash_every}};
  j["model"] = model_json(first);
  j["findings"] = Json::array();
  for (const Diagnostic& d : info_.findings) j["findings"].push_back(to_json(d));
  j["files"] = {{"listing", folder_.listing().filename().string()},
                {"history", folder_.history().filename().string()},
                {"animation", folder_.animation_index().filename().string()}};
  head_ = text_of(j);
  j["outcome"] = {{"kind", "running"}};
  write_atomically(folder_.manifest(), text_of(j));
}

void Manifest::end(const cycle::Outcome& outcome) {
  Json j = head_.empty() ? Json::object() : Json::parse(head_);
  j["outcome"] = {{"kind", outcome_name(outcome.kind)},
                  {"message", outcome.message},
                  {"cycles", outcome.cycles},
                  {"time", outcome.time},
                  {"wall_seconds", record_.wall_seconds()},
                  {"element_cycles_per_second", record_.rate(outcome.cycles)}};
  j["timings"] = Json::array();
  if (timings_) {
    for (const PhaseTime& phase : timings_()) j["timings"].push_back({{"name", phase.name}, {"seconds", phase.seconds}});
  }
  const state::Balance& b = record_.balance();
  j["energies"] = energies_json(b);
  j["mass"] = {{"total", b.mass}, {"added", b.added_mass}, {"error", mass_error(b)}};
  j["worst"] = {{"ERR", {{"value", record_.worst_error().value}, {"time", record_.worst_error().time}}},
                {"CX", {{"value", record_.worst_made().value}, {"time", record_.worst_made().time}}}};
  j["hashes"] = Json::array();
  for (const RunRecord::Hash& hash : record_.hashes()) {
    j["hashes"].push_back({{"cycle", hash.cycle}, {"state", fmt::format("{:016x}", hash.value)}});
  }
  write_atomically(folder_.manifest(), text_of(j));
}

}  // namespace abut::output
