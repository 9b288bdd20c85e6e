// What the command line asks for, and the functions that do it. Exit codes: 0 done, 1 the deck or the run is not well, 2 wrong usage.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "abut/model.hpp"

namespace abut::app {

struct RunArguments {
  std::filesystem::path deck;
  std::filesystem::path output;  ///< empty: ./NAME
  int threads = 0;               ///< 0: all that the machine has
  std::string profile = "standard";
  std::vector<std::string> interfaces;       ///< ID:KEY=VALUE,...
  std::vector<std::string> contact_records;  ///< ID, ID:FROM or ID:FROM:TO
  int checkpoint_every = 0;                  ///< 0: as /RFILE says
  int hash_every = 0;
  bool timing = false;
  bool quiet = false;
  bool orient = false;               ///< --orient auto
  bool allow_findings = false;       ///< run although the contact inspection found errors
  std::filesystem::path write_deck;  ///< empty: not asked for
};

struct ResumeArguments {
  std::filesystem::path folder;
  std::filesystem::path deck;  ///< empty: where it was
  int threads = 0;
  int checkpoint_every = -1;  ///< -1: as before
  bool timing = false;
  bool quiet = false;
};

struct CheckArguments {
  std::filesystem::path deck;
  std::string profile = "standard";
  std::vector<std::string> interfaces;  ///< as of run
  bool json = false;
  bool orient = false;
  std::filesystem::path write_deck;
};

struct ReportArguments {
  std::filesystem::path run;     ///< run folder
  std::filesystem::path output;  ///< empty: RUN/report.html
  bool all_fields = false;
  bool quiet = false;
};

struct ReplayArguments {
  std::filesystem::path log;
  bool steps = false;  ///< a line per step
};

struct KeywordsArguments {
  std::string word;  ///< empty: all
};

[[nodiscard]] int keywords_command(const KeywordsArguments& arguments);
[[nodiscard]] int run_command(const RunArguments& arguments);
[[nodiscard]] int resume_command(const ResumeArguments& arguments);
[[nodiscard]] int check_command(const CheckArguments& arguments);
[[nodiscard]] int report_command(const ReportArguments& arguments);
[[nodiscard]] int replay_command(const ReplayArguments& arguments);

/// @pre profile is "standard" or "reference"
[[nodiscard]] inline Choices choices_of(std::string_view profile, const std::vector<std::string>& interfaces) {
  Choices choices;
  choices.rules = profile == "reference" ? Rules::reference : Rules::standard;
  for (const std::string& text : interfaces) choices.interfaces.push_back(interface_choice(text));
  return choices;
}

}  // namespace abut::app
