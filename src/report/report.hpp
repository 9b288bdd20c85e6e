// `abut report`: a run folder in one HTML file that opens anywhere, without a network.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abut::report {

/// What went into the file.
struct Written {
  std::size_t states = 0, nodes = 0, faces = 0, elements = 0, bytes = 0;
  std::vector<std::string> left_out;  ///< states that cannot be read, with the reason
};

/// Which fields go in: `automatic` leaves the components of tensors and of some vectors out of large runs.
enum class Fields { automatic, all };

/// Reads `run` (run.json and the files that it names) and writes the page with its data to `target`, atomically.
/// A run without animation or without time history gives a report without the view or without plots.
/// @param page  the viewer's page (viewer/dist/page.html), which has the two places `<!--abut:first-->` and `<!--abut:rest-->`
/// A state that cannot be read is left out.
/// @throws RunError when there is no run.json, or no state or another file that it names can be read
Written write_report(const std::filesystem::path& run, const std::filesystem::path& target, std::string_view page, Fields fields);

}  // namespace abut::report
