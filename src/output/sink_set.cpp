#include "output/sink_set.hpp"

#include <exception>

namespace abut::output {

template <typename Call>
void SinkSet::for_each(const Call& call) {
  for (Entry& entry : entries_) {
    try {
      call(*entry.sink);
    } catch (...) {
      entry.failed = true;
      throw;
    }
  }
}

void SinkSet::begin(const cycle::Snapshot& first) {
  for_each([&first](cycle::Sink& sink) { sink.begin(first); });
}

void SinkSet::cycle(const cycle::Snapshot& now) {
  for_each([&now](cycle::Sink& sink) { sink.cycle(now); });
}

void SinkSet::end(const cycle::Outcome& outcome) {
  std::exception_ptr first_failure;
  for (Entry& entry : entries_) {
    try {
      entry.sink->end(outcome);
    } catch (...) {
      if (!entry.failed && !first_failure) first_failure = std::current_exception();
      entry.failed = true;
    }
  }
  if (first_failure) std::rethrow_exception(first_failure);
}

}  // namespace abut::output
