// The files of a run, opened together.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/sink_set.hpp"

namespace abut::output {

/// Creates the folder and the sinks that fill it: listing, time history, animation, manifest (last, so that it names what
/// the others have closed). @throws RunError naming the path and the reason
[[nodiscard]] std::unique_ptr<SinkSet> open_run_outputs(const RunFolder& folder, const RunInfo& info,
                                                        std::function<std::vector<PhaseTime>()> timings);

}  // namespace abut::output
