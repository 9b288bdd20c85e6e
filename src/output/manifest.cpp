#include "output/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <utility>

#include "output/element_lookup.hpp"
#include "output/json.hpp"
#include "output/summary.hpp"

namespace abut::output {
namespace {

Json energies_json(const state::Balance& b) {
  return {{"IE", b.ie},   {"HE", b.he},         {"KE", b.ke},           {"KER", b.ker},        {"CE", b.ce},
          {"FW", b.fw},   {"DW", b.dw},         {"CX", b.cx},           {"XE", b.xe},          {"EXTW", b.extw},
          {"ERR", b.err}, {"LEDGER", b.ledger}, {"initial", b.initial}, {"largest", b.largest}};
}

std::string fingerprint_text(std::uint64_t fingerprint) { return fmt::format("{:016x}", fingerprint); }

}  // namespace

std::string manifest_difference(const RunFolder& folder, const RunInfo& info) {
  std::ifstream file(folder.manifest());
  const Json j = Json::parse(file, nullptr, false);
  if (!j.is_object()) return {};
  const auto differs = [&j](const char* place, const Json& value) {
    const Json::json_pointer pointer(place);
    return j.contains(pointer) && j[pointer] != value;
  };
  if (differs("/model/fingerprint", fingerprint_text(info.model_fingerprint))) return "another model";
  if (differs("/settings/profile", info.profile)) return "another rule set";
  return differs("/settings/interfaces", info.interfaces) ? "other settings of interfaces" : "";
}

bool manifest_says_running(const RunFolder& folder) {
  std::ifstream file(folder.manifest());
  const Json j = Json::parse(file, nullptr, false);
  const Json::json_pointer place("/outcome/kind");
  return j.is_object() && j.contains(place) && j[place] == "running";
}

Manifest::Manifest(RunFolder folder, RunInfo info, std::function<std::vector<PhaseTime>()> timings)
    : folder_(std::move(folder)), info_(std::move(info)), timings_(std::move(timings)) {}

void Manifest::begin(const cycle::Snapshot& first) {
  record_.begin(first);
  Json j;
  j["abut"] = {{"version", info_.version}, {"commit", info_.commit}, {"compiler", info_.compiler}};
  const std::string now =
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  if (started_.empty()) started_ = now;
  if (info_.resumed) resumed_.push_back({info_.resumed->cycle, info_.resumed->time, now});
  j["started"] = started_;
  j["resumed"] = Json::array();
  for (const Resumed& r : resumed_) j["resumed"].push_back({{"cycle", r.cycle}, {"time", r.time}, {"at", r.at}});
  j["decks"] = info_.decks;
  j["settings"] = {{"profile", info_.profile},
                   {"interfaces", info_.interfaces},
                   {"threads", info_.threads},
                   {"instruction_set", info_.instruction_set},
                   {"hash_every", info_.hash_every}};
  j["model"] = model_json(*first.model, part_masses(*first.model, first.groups));
  j["model"]["fingerprint"] = fingerprint_text(info_.model_fingerprint);
  j["findings"] = findings_json(info_.findings);
  j["contact"] = nullptr;  // long where findings name many nodes: made again at the end
  j["files"] = {{"listing", folder_.listing().filename().string()},
                {"history", folder_.history().filename().string()},
                {"animation", folder_.animation_index().filename().string()},
                {"contact_surfaces", folder_.contact_surfaces().filename().string()}};
  head_ = json_text(j);
  j["contact"] = contact_json(*info_.contact);
  j["outcome"] = {{"kind", "running"}};
  write_atomically(folder_.manifest(), json_text(j));
}

std::vector<PhaseTime> Manifest::all_timings() const {
  std::vector<PhaseTime> all = timings_ ? timings_() : std::vector<PhaseTime>{};
  for (const PhaseTime& earlier : earlier_) {
    const auto now = std::find_if(all.begin(), all.end(), [&earlier](const PhaseTime& phase) { return phase.name == earlier.name; });
    if (now == all.end()) {
      all.push_back(earlier);
    } else {
      now->seconds += earlier.seconds;
    }
  }
  return all;
}

void Manifest::persist(state::Archive& a) {
  record_.persist(a);
  std::vector<PhaseTime> phases = all_timings();
  a.each_growing(phases, [&a](PhaseTime& phase) {
    a(phase.name);
    a(phase.seconds);
  });
  if (a.loading()) earlier_ = std::move(phases);
  a(started_);
  a.each_growing(resumed_, [&a](Resumed& r) {
    a(r.cycle);
    a(r.time);
    a(r.at);
  });
}

void Manifest::end(const cycle::Outcome& outcome) {
  Json j = head_.empty() ? Json::object() : Json::parse(head_);
  if (!head_.empty()) j["contact"] = contact_json(*info_.contact);
  j["outcome"] = {{"kind", outcome_name(outcome.kind)},
                  {"message", outcome.message},
                  {"cycles", outcome.cycles},
                  {"time", outcome.time},
                  {"wall_seconds", record_.wall_seconds()},
                  {"element_cycles_per_second", record_.rate(outcome.cycles)}};
  j["timings"] = Json::array();
  for (const PhaseTime& phase : all_timings()) j["timings"].push_back({{"name", phase.name}, {"seconds", phase.seconds}});
  if (record_.any()) {
    const state::Balance& b = record_.balance();
    j["energies"] = energies_json(b);
    j["mass"] = {{"total", b.mass}, {"added", b.added_mass}, {"error", mass_error(b)}};
    j["worst"] = {{"ERR", {{"value", record_.worst_error().value}, {"time", record_.worst_error().time}}},
                  {"CX", {{"value", record_.worst_made().value}, {"time", record_.worst_made().time}}}};
  }
  j["run_findings"] = Json::array();
  for (const RunFinding& f : *info_.during) {
    j["run_findings"].push_back({{"severity", "warning"},
                                 {"code", f.diagnostic.code},
                                 {"time", f.time},
                                 {"cycle", f.cycle},
                                 {"measure", f.measure},
                                 {"message", f.diagnostic.message}});
    if (f.interface_id != 0) j["run_findings"].back()["interface"] = f.interface_id;
    if (!f.nodes.empty()) j["run_findings"].back()["nodes"] = f.nodes;
    if (!f.segments.empty()) j["run_findings"].back()["segments"] = f.segments;
  }
  j["hashes"] = Json::array();
  for (const RunRecord::Hash& hash : record_.hashes()) {
    j["hashes"].push_back({{"cycle", hash.cycle}, {"state", fmt::format("{:016x}", hash.value)}});
  }
  write_atomically(folder_.manifest(), json_text(j));
}

}  // namespace abut::output
