// The command line of abut; no physics.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "abut/run.hpp"
#include "commands.hpp"
#include "findings.hpp"
#include "parallel/thread_pool.hpp"

namespace {

constexpr int wrong_usage = 2;
constexpr const char* no_standard_output = "standard output cannot be written (is it closed, or its disk full?)";

constexpr const char* examples = R"(Examples:
  abut run INT357_0000.rad                      run the deck into ./INT357
  abut run deck_0000.rad -o out --threads 4     choose the folder and the threads
  abut run deck_0000.rad --profile reference    with the reference program's rules, to compare results
  abut run deck_0000.rad --checkpoint-every 5000
                                                can be resumed after Ctrl-C, a crash or a full disk
  abut resume deck                              go on in the run folder ./deck from its newest checkpoint
  abut check deck_0000.rad                      read, validate, inspect the contacts, summarise; nothing is written
  abut check deck_0000.rad --orient auto --write-deck fixed_0000.rad
                                                turn contact surfaces to face each other and keep the result
  abut keywords INTER                           which contact keywords are read, and which of their fields
  abut report INT357                            put the run folder into one page: INT357/report.html
  abut run deck_0000.rad --record-contact 3     keep all inputs of interface 3 ...
  abut replay deck/deck_contact_3.calls         ... and compute its forces again from them alone

DECK is a Starter deck NAME_0000.rad; the Engine deck NAME_0001.rad is read from beside it, and runs that go on from it
(NAME_0002.rad, ...) follow. A run writes NAME.out (listing), NAME_th.csv (time history), NAME.pvd (animation, open it with
ParaView), run.json and, for resume, NAME.rst.
Ctrl-C ends a run after its cycle with complete files and a checkpoint.
Exit status: 0 done, 1 the deck has errors or the run did not reach its end, 2 wrong usage.)";

}  // namespace

int main(int argc, char** argv) {
  using namespace abut::app;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of the write, like a full disk
  CLI::App app{"explicit dynamics with two-surface contact, from Radioss decks", "abut"};
  app.footer(examples);
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return abut::version_text(); });
  const CLI::IsMember profiles({"standard", "reference"});

  RunArguments run;
  CLI::App* run_app = app.add_subcommand("run", "run a deck");
  run_app->add_option("DECK", run.deck, "Starter deck NAME_0000.rad")->required();
  run_app->add_option("-o,--output", run.output, "run folder (default: ./NAME)");
  run_app->add_option("--threads", run.threads, "number of threads (default: all); results do not depend on it")
      ->check(CLI::Range(1, abut::parallel::most_threads));
  run_app->add_option("--profile", run.profile, "rule set: standard or reference")->check(profiles)->capture_default_str();
  const char* interface_help =
      "ID:KEY=VALUE..., settings between commas of an interface of TYPE3 or TYPE5, or of all: law=stiffening or constant, gap=auto or card "
      "(half of the "
      "thickness of both sides), initial=keep, offset, project or ignore (initial penetrations), damping=X (of critical), depth=X (how far "
      "behind a segment a node is met), start=X (time over which initial penetrations are pushed out)";
  run_app->add_option("--interface", run.interfaces, interface_help)->allow_extra_args(false);
  run_app
      ->add_option("--checkpoint-every", run.checkpoint_every,
                   "write a checkpoint every N cycles (default: as /RFILE of the deck says); there is one at the end in any case")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  run_app
      ->add_option("--record-contact", run.contact_records,
                   "ID[:FROM[:TO]], write all inputs of an interface to NAME_contact_ID.calls in the run folder, for abut replay")
      ->allow_extra_args(false);
  run_app->add_option("--hash-every", run.hash_every, "hash the state every N cycles into run.json")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  run_app->add_flag("--timing", run.timing, "print the time spent in each phase");
  run_app->add_flag("--quiet", run.quiet, "print nothing but warnings and errors");

  const CLI::IsMember orientations({"none", "auto"});
  std::string run_orient = "none", check_orient = "none";
  const char* orient_help = "auto: turn the segments of contact surfaces to face each other where that is unambiguous";
  const char* write_help = "write the Starter deck with the turned surfaces to this file";
  run_app->add_option("--orient", run_orient, orient_help)->check(orientations)->capture_default_str();
  run_app->add_option("--write-deck", run.write_deck, write_help)->needs("--orient");
  run_app->add_flag("--allow-findings", run.allow_findings, "run although the contact inspection found errors");

  ResumeArguments resume;
  CLI::App* resume_app = app.add_subcommand("resume", "go on with a run from the newest checkpoint in its folder");
  resume_app->add_option("FOLDER", resume.folder, "run folder")->required();
  resume_app->add_option("--deck", resume.deck, "Starter deck, when it is not where it was");
  resume_app->add_option("--threads", resume.threads, "number of threads (default: all); results do not depend on it")
      ->check(CLI::Range(1, abut::parallel::most_threads));
  resume_app->add_option("--checkpoint-every", resume.checkpoint_every, "write a checkpoint every N cycles (default: as before)")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  resume_app->add_flag("--timing", resume.timing, "print the time spent in each phase");
  resume_app->add_flag("--quiet", resume.quiet, "print nothing but warnings and errors");

  CheckArguments check;
  CLI::App* check_app = app.add_subcommand("check", "read and validate a deck, print a summary");
  check_app->add_option("DECK", check.deck, "Starter deck NAME_0000.rad")->required();
  check_app->add_option("--profile", check.profile, "rule set: standard or reference")->check(profiles)->capture_default_str();
  check_app->add_option("--interface", check.interfaces, interface_help)->allow_extra_args(false);
  check_app->add_flag("--json", check.json, "print JSON");
  check_app->add_option("--orient", check_orient, orient_help)->check(orientations)->capture_default_str();
  check_app->add_option("--write-deck", check.write_deck, write_help)->needs("--orient");

  ReportArguments report;
  CLI::App* report_app = app.add_subcommand("report", "put a run folder into one HTML file that opens in any browser");
  report_app->add_option("RUN", report.run, "folder that `abut run` filled")->required();
  report_app->add_option("-o,--output", report.output, "file to write (default: RUN/report.html)");
  report_app->add_flag("--all-fields", report.all_fields, "also what is left out of large runs: components of stress and velocity");
  report_app->add_flag("--quiet", report.quiet, "print nothing but errors");

  ReplayArguments again;
  CLI::App* replay_app = app.add_subcommand("replay", "make the recorded calls of an interface again and compare every bit");
  replay_app->add_option("FILE", again.log, "NAME_contact_ID.calls, from abut run --record-contact or from another host")->required();
  replay_app->add_flag("--steps", again.steps, "print a line per step");

  KeywordsArguments keywords;
  CLI::App* keywords_app = app.add_subcommand("keywords", "print what abut does with each keyword of a deck, as Markdown");
  keywords_app->add_option("WORD", keywords.word, "only keywords that contain this word, e.g. INTER; or a keyword line, e.g. /SURF/SEG/1");

  if (argc > 1 && argv[1][0] != '-') {
    const std::string_view word = argv[1];
    const std::vector<CLI::App*> commands = app.get_subcommands({});
    if (std::ranges::none_of(commands, [&](const CLI::App* command) { return command->get_name() == word; })) {
      fmt::print(stderr, "abut: there is no command '{}'{}\nCommands:", word,
                 word.ends_with(".rad") ? fmt::format("; to run a deck: abut run {}", word) : "");
      for (const CLI::App* command : commands) fmt::print(stderr, " {}", command->get_name());
      fmt::print(stderr, " (abut --help)\n");
      return wrong_usage;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) != 0) return wrong_usage;
    if (std::cout.flush() && std::fflush(stdout) == 0) return 0;
    fmt::print(stderr, "abut: {}\n", no_standard_output);
    return 1;
  } catch (const std::exception& e) {  // --version under an impossible ABUT_ISA
    fmt::print(stderr, "abut: {}\n", e.what());
    return 1;
  }

#ifdef __GLIBC__
  // Large arrays go back to the system when they are freed: what inspection, reading and first outputs have used is not kept.
  constexpr int large = 1 << 18;
  mallopt(M_MMAP_THRESHOLD, large);
#endif
  run.orient = run_orient == "auto";
  check.orient = check_orient == "auto";
  const auto carry_out = [&] {
    if (keywords_app->parsed()) return keywords_command(keywords);
    if (report_app->parsed()) return report_command(report);
    if (replay_app->parsed()) return replay_command(again);
    if (run_app->parsed()) return run_command(run);
    return resume_app->parsed() ? resume_command(resume) : check_command(check);
  };
  try {
    const int status = carry_out();
    if (std::fflush(stdout) != 0) throw std::runtime_error(no_standard_output);
    return status;
  } catch (const abut::InputError& e) {
    print_findings(e.diagnostics().all());
    return 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "abut: {}\n", e.what());
    return 1;
  }
}
