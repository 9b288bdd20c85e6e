// Several sinks as one.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cycle/sink.hpp"

namespace abut::output {

/// Hands every call to its sinks in the order in which they were added. end() reaches all of them, whatever fails: each
/// closes its file, and the first new failure is thrown when all are done.
class SinkSet final : public cycle::Sink {
 public:
  cycle::Sink* add(std::unique_ptr<cycle::Sink> sink) {
    entries_.push_back({std::move(sink), false});
    return entries_.back().sink.get();
  }

  void begin(const cycle::Snapshot& first) override;
  void cycle(const cycle::Snapshot& now) override;
  void end(const cycle::Outcome& outcome) override;

 private:
  struct Entry {
    std::unique_ptr<cycle::Sink> sink;
    bool failed = false;  ///< it has already said why: what it says in end() adds nothing
  };
  template <typename Call>
  void for_each(const Call& call);

  std::vector<Entry> entries_;
};

}  // namespace abut::output
