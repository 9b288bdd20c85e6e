// The files of a run, opened together.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "output/files.hpp"
#include "output/run_info.hpp"
#include "output/sink_set.hpp"

namespace abut::output {

/// Creates the folder, removes what an earlier run has left there unless that goes on, and adds the sinks that fill it: listing, time
/// history, animation, manifest (last, so that it names what the others have closed). @throws RunError naming the path and the reason
/// @return the sinks that have files; their persist() says where a resumed run goes on
std::vector<cycle::Sink*> add_run_outputs(SinkSet& sinks, const RunFolder& folder, const RunInfo& info,
                                          std::function<std::vector<PhaseTime>()> timings);

/// The watches over contacts and deleted elements. They come before the files, which write what they say.
std::vector<cycle::Sink*> add_watches(SinkSet& sinks, const RunInfo& info);

}  // namespace abut::output
