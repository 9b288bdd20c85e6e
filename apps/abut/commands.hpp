// What the command line asks for, and the functions that do it. Exit codes: 0 done, 1 the deck or the run is not well, 2 wrong usage.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "abut/model.hpp"

namespace abut::app {

struct RunArguments {
  std::filesystem::path deck;
  std::filesystem::path output;  ///< empty: ./NAME
  int threads = 0;               ///< 0: all that the machine has
  std::string profile = "standard";
  std::string interface_law;  ///< empty: the profile's
  int hash_every = 0;
  bool timing = false;
  bool quiet = false;
  bool orient = false;               ///< --orient auto
  bool allow_findings = false;       ///< run although the contact inspection found errors
  std::filesystem::path write_deck;  ///< empty: not asked for
};

struct CheckArguments {
  std::filesystem::path deck;
  std::string profile = "standard";
  bool json = false;
  bool orient = false;
  std::filesystem::path write_deck;
};

[[nodiscard]] int run_command(const RunArguments& arguments);
[[nodiscard]] int check_command(const CheckArguments& arguments);

/// @pre profile is "standard" or "reference", law is "", "stiffening" or "constant"
[[nodiscard]] inline Choices choices_of(std::string_view profile, std::string_view law) {
  Choices choices;
  choices.rules = profile == "reference" ? Rules::reference : Rules::standard;
  if (!law.empty()) choices.interface_law = law == "constant" ? contact::Law::constant : contact::Law::stiffening;
  return choices;
}

}  // namespace abut::app
