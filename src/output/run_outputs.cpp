#include "output/run_outputs.hpp"

#include <utility>

#include "output/animation.hpp"
#include "output/contact_watch.hpp"
#include "output/erosion_watch.hpp"
#include "output/listing.hpp"
#include "output/manifest.hpp"
#include "output/time_history.hpp"

namespace abut::output {

std::vector<cycle::Sink*> add_watches(SinkSet& sinks, const RunInfo& info) {
  return {sinks.add(std::make_unique<ContactWatch>(info.during)), sinks.add(std::make_unique<ErosionWatch>(info.during))};
}

std::vector<cycle::Sink*> add_run_outputs(SinkSet& sinks, const RunFolder& folder, const RunInfo& info,
                                          std::function<std::vector<PhaseTime>()> timings) {
  create_folder(folder.directory);
  if (info.opening() == Opening::fresh) remove_earlier_run(folder);
  return {sinks.add(std::make_unique<Listing>(folder, info)), sinks.add(std::make_unique<TimeHistory>(folder, info.opening())),
          sinks.add(std::make_unique<Animation>(folder, info.opening())),
          sinks.add(std::make_unique<Manifest>(folder, info, std::move(timings)))};
}

}  // namespace abut::output
