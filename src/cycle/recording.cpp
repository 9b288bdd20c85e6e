// Call logs of interfaces: from when to when.
#include "cycle/cycle.hpp"

namespace abut::cycle {

void Cycle::record_contacts() {
  for (std::size_t k = 0; k < options_.recordings.size(); ++k) {
    const ContactRecording& r = options_.recordings[k];
    const double t = state_.times.t;
    for (init::RunInterface& i : interfaces_) {
      if (model_.interfaces[static_cast<std::size_t>(i.model_index)].id != r.interface_id) continue;
      if (!recording_[k] && t >= r.from && t <= r.to) {
        i.contact.record(*r.log, r.label);
        recording_[k] = true;
      } else if (recording_[k] && t > r.to) {
        i.contact.stop_recording();
      }
    }
  }
}

}  // namespace abut::cycle
