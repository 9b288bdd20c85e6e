// The files of a run, opened together.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/sink_set.hpp"

namespace abut::output {

/// Creates the folder and adds the sinks that fill it: contact watch, listing, time history, animation, manifest (last, so that it
/// names what the others have closed). @throws RunError naming the path and the reason
void add_run_outputs(SinkSet& sinks, const RunFolder& folder, const RunInfo& info, std::function<std::vector<PhaseTime>()> timings);

/// A run without files: only the watch over the contacts.
void add_contact_watch(SinkSet& sinks, const RunInfo& info);

}  // namespace abut::output
