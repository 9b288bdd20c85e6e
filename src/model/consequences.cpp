#include "model/consequences.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace abut::model {

namespace {

/// "/GRNOD/PART/4" -> "GRNOD".
std::string_view family(std::string_view keyword) {
  if (keyword.empty() || keyword.front() != '/') return {};
  keyword.remove_prefix(1);
  return keyword.substr(0, keyword.find('/'));
}

/// "no /NODE with id 7: left out" -> "NODE" and "no /NODE with id 7"; empty for other messages.
std::pair<std::string_view, std::string_view> missing_id(std::string_view message) {
  if (!message.starts_with("no /")) return {};
  const std::size_t with = message.find(" with id ");
  if (with == std::string_view::npos) return {};
  std::size_t end = with + 9;
  while (end < message.size() && (message[end] == '-' || (message[end] >= '0' && message[end] <= '9'))) ++end;
  return {family(message.substr(3, with - 3)), message.substr(0, end)};
}

template <std::size_t N>
bool among(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// "surface 12 has ..." -> "surface 12"; the whole message where it names no surface.
std::string_view up_to_surface(std::string_view message) {
  const std::size_t word = message.find("surface ");
  if (word == std::string_view::npos) return message;
  const std::size_t end = message.find_first_not_of("0123456789", word + 8);
  return message.substr(0, end);
}

/// What sets are made of, and sets.
constexpr std::array<std::string_view, 18> upstream{"NODE",   "SHELL", "SH3N",   "BRICK",  "TETRA4", "PENTA6", "PART", "MAT", "PROP",
                                                    "SUBSET", "GRNOD", "GRSHEL", "GRSH3N", "GRBRIC", "GRPART", "SURF", "SET", "BOX"};
/// Codes of findings that are the consequence of an error upstream or in their own block.
constexpr std::array<std::string_view, 8> derived{"model.empty_group", "model.empty_surface",    "model.empty_set",      "model.no_effect",
                                                  "model.empty_part",  "model.missing_material", "model.function_order", "model.no_mass"};
/// Errors about a surface or group, whichever interface found them.
constexpr std::array<std::string_view, 3> of_a_set{"model.zero_area", "model.no_stiffness", "model.empty_set"};
constexpr std::array<std::string_view, 4> unreadable_id{"deck.bad_id", "deck.bad_integer", "model.duplicate_id", "model.missing_value"};

class Filter {
 public:
  explicit Filter(const Diagnostics& all) : all_(all.all()) {
    for (const Diagnostic& d : all_) {
      if (d.severity != Severity::error) continue;
      lines_.insert({d.place.file, d.place.line});
      if (d.code == "deck.indented_keyword") indented_.emplace(std::pair{d.place.file, d.place.keyword}, d.place.line);
      incomplete_ = incomplete_ || d.code == "deck.include" || d.code == "deck.indented_keyword";
      const std::string_view word = family(d.place.keyword);
      const bool set_is_empty = d.code == "model.empty_set";
      empty_set_ = empty_set_ || set_is_empty;
      if (!among(d.code, derived)) {
        upstream_ = upstream_ || among(word, upstream);
        misplaced_ = misplaced_ || word == "NODE";
        blocks_.insert(d.place.keyword);
      }
      if (among(d.code, unreadable_id)) unreadable_.insert(word);
      if (const std::string_view what = missing_id(d.message).second; !what.empty()) errors_.insert(what);
    }
  }

  [[nodiscard]] bool keeps(const Diagnostic& d) {
    const bool kept = decide(d);
    if (!kept) blocks_.insert(d.place.keyword);  // what follows from it in its block is a consequence too
    return kept;
  }

  /// For an error that a set is empty: the first warning about a member of such a set that is not there, which is then taken out.
  [[nodiscard]] const Diagnostic* reason(const Diagnostic& d) const {
    if (d.code != "model.empty_set") return nullptr;
    const std::string_view surface = up_to_surface(d.message);
    const bool of_surface = surface.size() < d.message.size();
    const std::string id = of_surface ? "/" + std::string(surface.substr(surface.find_last_of(' ') + 1)) : std::string();
    for (const Diagnostic& w : all_) {
      if (w.code != "model.unknown_member" || w.severity == Severity::error) continue;
      const bool its = of_surface ? family(w.place.keyword) == "SURF" && w.place.keyword.ends_with(id) : family(w.place.keyword) == "GRNOD";
      if (its) return &w;
    }
    return nullptr;
  }

 private:
  [[nodiscard]] bool decide(const Diagnostic& d) {
    const bool error = d.severity == Severity::error;
    const Place& p = d.place;
    if (const auto lost = indented_.find({p.file, p.keyword}); lost != indented_.end() && d.code != "deck.indented_keyword") {
      if (p.line >= lost->second) return false;  // data of the keyword that was not seen
    }
    if (p.line > 0 && p.first_column > 0 && error && !fields_.insert({p.file, p.line, (p.last_column - 1) / 10}).second) return false;
    if (!error && p.line > 0 && p.first_column > 0 && lines_.contains({p.file, p.line})) return false;
    if (const auto [word, what] = missing_id(d.message); !word.empty()) {
      if (incomplete_ || unreadable_.contains(word)) return false;
      if (error ? !missing_.insert(what).second : errors_.contains(what)) return false;
    }
    if (among(d.code, derived) && (upstream_ || blocks_.contains(p.keyword))) return false;
    if (!error && empty_set_ && among(d.code, derived)) return false;
    if (!error && upstream_ && d.code == "model.missing_output") return false;
    if (misplaced_ && d.code == "model.inverted_brick") return false;
    if (error && among(d.code, of_a_set) && !messages_.insert(d.code + std::string(up_to_surface(d.message))).second) return false;
    if (d.code == "model.unknown_member" && empty_set_) {
      return std::none_of(all_.begin(), all_.end(), [&](const Diagnostic& e) { return reason(e) == &d; });
    }
    return true;
  }

  const std::vector<Diagnostic>& all_;
  bool upstream_ = false, empty_set_ = false;
  bool misplaced_ = false;                                       ///< a node may not be where the deck means it
  bool incomplete_ = false;                                      ///< text is missing: what was not found may stand there
  std::map<std::pair<std::string, std::string>, int> indented_;  ///< file and block of an indented keyword, and its line
  std::set<std::pair<std::string, int>> lines_;
  std::set<std::tuple<std::string, int, int>> fields_;  ///< with an error so far
  std::set<std::string> blocks_;
  std::set<std::string_view> unreadable_, errors_, missing_;  ///< of errors all, and so far
  std::set<std::string> messages_;
};

}  // namespace

Diagnostics without_consequences(const Diagnostics& all) {
  if (!all.has_errors()) return all;
  Filter filter(all);
  Diagnostics kept;
  for (const Diagnostic& d : all.all()) {
    if (!filter.keeps(d)) continue;
    const Diagnostic* reason = filter.reason(d);
    if (reason == nullptr) {
      kept.add(d);
      continue;
    }
    Diagnostic both = d;
    std::string_view missing = missing_id(reason->message).second;
    if (missing.empty()) missing = reason->message;
    both.message += " (" + reason->place.keyword + ": " + std::string(missing) + ")";
    kept.add(std::move(both));
  }
  return kept;
}

}  // namespace abut::model
