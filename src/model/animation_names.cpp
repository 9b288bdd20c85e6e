#include "model/animation_names.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include "deck/text.hpp"

namespace abut::model {

std::string animation_selection(const deck::Block& block) {
  static const std::map<std::string, std::string> synonyms{{"HOUR", "HOURG"}, {"PRES", "P"},       {"DMASS", "DMAS"},   {"ACCEL", "ACC"},
                                                           {"BRIC", "BRICK"}, {"EPSDO", "EPSDOT"}, {"STRES", "STRESS"}, {"STRAI", "STRAIN"},
                                                           {"VELO", "VEL"},   {"SHEL", "SHELL"}};
  std::string field;
  for (std::size_t i = 1; i < block.words.size(); ++i) {
    std::string word = deck::to_upper(block.words[i]);
    const auto found = synonyms.find(word);
    if (found != synonyms.end()) word = found->second;
    if (i == 1 && word == "TENS") field = "SHELL";
    if (!word.empty()) field += (field.empty() ? "" : "/") + word;
  }
  return field;
}

std::string plain_animation_name(std::string_view selection) {
  for (const std::string_view type : {"SHELL/", "BRICK/", "SH3N/", "SOLID/", "ELEM/"}) {
    if (!selection.starts_with(type)) continue;
    const std::string rest(selection.substr(type.size()));
    return rest.starts_with("TENS/") ? rest : "ELEM/" + rest;
  }
  return std::string(selection);
}

// ELEM/OFF: only active elements are in a state.
const std::vector<std::string>& animation_names_of_every_state() {
  static const std::vector<std::string> names{"VECT/DISP",  "VECT/VEL",    "VECT/CONT",        "VECT/PCONT",     "ELEM/EPSP",  "ELEM/VONM",
                                              "ELEM/OFF",   "ELEM/SIGX",   "ELEM/SIGY",        "ELEM/SIGZ",      "ELEM/SIGXY", "ELEM/SIGYZ",
                                              "ELEM/SIGZX", "TENS/STRESS", "TENS/STRESS/MEMB", "TENS/STRESS/000"};
  return names;
}

const std::vector<std::string>& animation_names_on_request() {
  static const std::vector<std::string> names{
      "TENS/STRESS/UPPER", "TENS/STRESS/LOWER", "TENS/STRESS/BEND", "TENS/STRESS/ALL", "VECT/ACC", "VECT/VROT", "VECT/FINT",
      "VECT/FEXT",         "VECT/FOPT",         "NODA/DT",          "NODA/DMAS",       "MASS",     "ELEM/ENER", "ELEM/P",
      "ELEM/DENS",         "ELEM/HOURG",        "ELEM/THIC",        "ELEM/THICK",      "ELEM/EPSD"};
  return names;
}

std::vector<std::string> animation_names() {
  std::vector<std::string> all = animation_names_of_every_state();
  all.insert(all.end(), animation_names_on_request().begin(), animation_names_on_request().end());
  return all;
}

int animation_layer(std::string_view plain_name) {
  constexpr std::string_view stresses = "TENS/STRESS/";
  if (!plain_name.starts_with(stresses)) return 0;
  const std::string_view layer = plain_name.substr(stresses.size());
  int point = 0;
  const auto [end, fault] = std::from_chars(layer.data(), layer.data() + layer.size(), point);
  return fault == std::errc{} && end == layer.data() + layer.size() ? std::max(point, 0) : 0;
}

bool has_animation_field(std::string_view selection) {
  const std::string name = plain_animation_name(selection);
  const std::vector<std::string> all = animation_names();
  return animation_layer(name) > 0 || std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace abut::model
