// `abut report`: hands the run folder and the embedded page to the report stage.
#include "report/report.hpp"

#include <fmt/core.h>

#include "commands.hpp"
#include "viewer_page.hpp"

#ifndef ABUT_VIEWER_ABSENT
#define ABUT_VIEWER_ABSENT "the page is empty"
#endif

namespace abut::app {

int report_command(const ReportArguments& arguments) {
  const std::string_view page = viewer_page();
  if (page.empty()) {
    fmt::print(stderr, "abut: this abut was built without the report: " ABUT_VIEWER_ABSENT "; docs/guide/report.md says how to build it\n");
    return 1;
  }
  std::filesystem::path target = arguments.output;
  if (target.empty()) target = arguments.run / "report.html";
  const report::Written w =
      report::write_report(arguments.run, target, page, arguments.all_fields ? report::Fields::all : report::Fields::automatic);
  for (const std::string& state : w.left_out) fmt::print(stderr, "abut: warning: {}; it is left out\n", state);
  if (w.states == 0) {
    fmt::print(stderr, "abut: warning: there is no animation state in {} (/ANIM/DT of the Engine deck): the page has no picture\n",
               arguments.run.string());
  }
  if (!arguments.quiet) {
    fmt::print("{}: {} states, {} elements, {} faces shown, {:.1f} MB; open it in a browser\n", target.string(), w.states, w.elements,
               w.faces, static_cast<double>(w.bytes) / 1e6);
  }
  return 0;
}

}  // namespace abut::app
