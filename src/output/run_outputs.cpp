#include "output/run_outputs.hpp"

#include <utility>

#include "output/animation.hpp"
#include "output/contact_watch.hpp"
#include "output/listing.hpp"
#include "output/manifest.hpp"
#include "output/time_history.hpp"

namespace abut::output {

void add_contact_watch(SinkSet& sinks, const RunInfo& info) { sinks.add(std::make_unique<ContactWatch>(info.during)); }

void add_run_outputs(SinkSet& sinks, const RunFolder& folder, const RunInfo& info, std::function<std::vector<PhaseTime>()> timings) {
  create_folder(folder.directory);
  add_contact_watch(sinks, info);  // first: the others write what it says
  sinks.add(std::make_unique<Listing>(folder, info));
  sinks.add(std::make_unique<TimeHistory>(folder));
  sinks.add(std::make_unique<Animation>(folder));
  sinks.add(std::make_unique<Manifest>(folder, info, std::move(timings)));
}

}  // namespace abut::output
