#include "report/report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string>

#include "core/diagnostic.hpp"
#include "output/files.hpp"
#include "output/json.hpp"
#include "report/history.hpp"
#include "report/states.hpp"

namespace abut::report {
namespace {

constexpr std::string_view first_place = "<!--abut:first-->";
constexpr std::string_view rest_place = "<!--abut:rest-->";

std::string slurp(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw RunError("cannot read " + file.string());
  return text.str();
}

Json read_manifest(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "run.json";
  if (!std::filesystem::exists(file)) throw RunError(run.string() + ": no run.json: this is not a folder that `abut run` filled");
  Json manifest = Json::parse(slurp(file), nullptr, false);
  const auto is_object = [&](const char* key) { return manifest.contains(key) && manifest[key].is_object(); };
  const auto names = [](const Json& files) { return std::all_of(files.begin(), files.end(), [](const Json& f) { return f.is_string(); }); };
  if (manifest.is_discarded() || !is_object("model") || !is_object("files") || !names(manifest["files"])) {
    throw RunError(file.string() + ": not a manifest of abut");
  }
  return manifest;
}

/// JSON inside an HTML script element: nothing in it may end the element.
std::string in_script(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

/// Single precision holds what a plot shows; numbers beyond its range become NaN, which is a gap in the line. Ids stay as they are.
Chunk history_chunk(const std::string& name, const std::vector<double>& column) {
  if (name == "GLOBAL/DTID") {
    constexpr double exact = 9007199254740992.0;  // 2^53
    std::vector<std::int64_t> ids;
    for (const double v : column) ids.push_back(std::fabs(v) <= exact ? static_cast<std::int64_t>(v) : 0);
    return identifiers(ids);
  }
  std::vector<float> values;
  for (const double v : column) {
    const bool fits = std::fabs(v) <= static_cast<double>(std::numeric_limits<float>::max());
    values.push_back(fits ? static_cast<float>(v) : std::numeric_limits<float>::quiet_NaN());
  }
  return singles(values, 1);
}

Json history_json(const History& history, ChunkStore& store) {
  Json j{{"names", history.names}, {"rows", history.rows()}, {"columns", Json::array()}};
  for (std::size_t k = 0; k < history.names.size(); ++k) {
    j["columns"].push_back(store.add(history_chunk(history.names[k], history.columns[k])));
  }
  return j;
}

/// Chunks that the first picture needs: the mesh, and the first frame shown.
std::set<std::size_t> needed_first(const Json& document) {
  std::set<std::size_t> out;
  const auto take = [&out](const Json& chunk) {
    if (const int id = chunk.value("id", -1); id >= 0) out.insert(static_cast<std::size_t>(id));
  };
  if (!document.contains("mesh")) return out;
  for (const auto& [name, value] : document["mesh"].items()) {
    if (value.is_object()) take(value);
  }
  const Json& frame = document["frames"][document["first"].get<std::size_t>()];
  for (const Json& value : frame["values"]) take(value);
  if (frame.contains("hidden")) take(frame["hidden"]);
  return out;
}

}  // namespace

Written write_report(const std::filesystem::path& run, const std::filesystem::path& target, std::string_view page, Fields fields) {
  const std::size_t first_at = page.find(first_place), rest_at = page.find(rest_place);
  if (first_at == std::string_view::npos || rest_at == std::string_view::npos || rest_at < first_at) {
    throw RunError("the viewer's page has no place for data");
  }
  ChunkStore store;
  Json document;
  document["run"] = read_manifest(run);
  const Json files = document["run"]["files"];
  const auto named = [&](const char* what) { return run / files.value(what, std::string("-")); };
  document["history"] = history_json(read_history(named("history")), store);
  Written written = add_states(read_index(named("animation")), named("contact_surfaces"), fields, store, document);

  const std::set<std::size_t> early = needed_first(document);
  std::string html(page.substr(0, first_at));
  html += "<script type=\"application/json\" id=\"abut-document\">" + in_script(document) + "</script>\n";
  const auto put = [&](std::size_t id) {
    html += "<script type=\"text/plain\" id=\"c" + std::to_string(id) + "\">";
    html += store.texts()[id];
    html += "</script>\n";
  };
  for (const std::size_t id : early) put(id);
  html += page.substr(first_at + first_place.size(), rest_at - first_at - first_place.size());
  for (std::size_t id = 0; id < store.texts().size(); ++id) {
    if (!early.contains(id)) put(id);
  }
  html += page.substr(rest_at + rest_place.size());
  written.bytes = html.size();
  output::write_atomically(target, html);
  return written;
}

}  // namespace abut::report
