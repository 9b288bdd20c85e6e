// What the command line asks for, and the functions that do it. Exit codes: 0 done, 1 the deck or the run is not well, 2 wrong usage.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "abut/contact/options.hpp"
#include "core/profile.hpp"

namespace abut::app {

struct RunArguments {
  std::filesystem::path deck;
  std::filesystem::path output;  ///< empty: ./NAME
  int threads = 0;               ///< 0: all that the machine has
  std::string profile = "standard";
  std::string interface_law;                 ///< empty: the profile's
  std::vector<std::string> contact_ramps;    ///< ID:TIME
  std::vector<std::string> contact_records;  ///< ID, ID:FROM or ID:FROM:TO
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

struct ReplayArguments {
  std::filesystem::path log;
  bool steps = false;  ///< a line per step
};

/// "abut 0.1.0 (commit), compiler, instruction set".
[[nodiscard]] std::string version_text();

[[nodiscard]] int run_command(const RunArguments& arguments);
[[nodiscard]] int check_command(const CheckArguments& arguments);
[[nodiscard]] int replay_command(const ReplayArguments& arguments);

/// @pre name is "standard" or "reference"
[[nodiscard]] inline Profile profile_of(std::string_view name) { return name == "reference" ? Profile::reference() : Profile::standard(); }
/// @pre name is "", "stiffening" or "constant"
[[nodiscard]] inline std::optional<contact::Law> law_of(std::string_view name) {
  if (name.empty()) return std::nullopt;
  return name == "constant" ? contact::Law::constant : contact::Law::stiffening;
}

}  // namespace abut::app
