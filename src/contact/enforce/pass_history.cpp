// What a pass remembers, written and read back.
#include "contact/enforce/pass.hpp"

namespace abut::contact {

std::size_t Pass::saved_bytes() const {
  const auto nodes = static_cast<Index>(states_.size());
  std::size_t full = 0;
  for (Index i = 0; i < nodes; ++i) full += remembered(states_.before(i)) == Remembered::all ? 1 : 0;
  return states_.size() * (1 + sizeof(Tracked)) + full * sizeof(NodeState) + 2 * depth_.size() * sizeof(double) + 64;
}

void Pass::save(HistoryWriter& out) const {
  const auto nodes = static_cast<Index>(states_.size());
  out.put(static_cast<std::uint64_t>(states_.size()));
  for (Index i = 0; i < nodes; ++i) {
    const NodeState& state = states_.before(i);
    const Remembered r = remembered(state);
    out.put(r);
    if (r == Remembered::all) out.put(state);
  }
  out.put(static_cast<std::uint64_t>(started_ ? depth_.size() : 0));
  for (const Values* values : {&depth_, &widening_}) {
    for (std::size_t f = 0; f < values->size(); ++f) out.put((*values)[f]);
  }
  out.put(size_);
  out.put(settled_);
  // Only the incremental search tracks nodes.
  for (std::size_t i = 0; i < (started_ ? states_.size() : 0); ++i) out.put(tracked_.empty() ? Tracked{} : tracked_[i]);
}

void Pass::load(HistoryReader& in) {
  const auto nodes = static_cast<Index>(states_.size());
  if (in.next<std::uint64_t>() != states_.size()) in.refuse("was made for another interface");
  for (Index i = 0; i < nodes; ++i) {
    const auto r = in.next<Remembered>();
    if (r > Remembered::all) in.refuse("is damaged: it has a node that remembers what does not exist");
    NodeState state = plain_state(r);
    if (r == Remembered::all) in.get(state);
    states_.set(i, state);
  }
  std::uint64_t facets = 0;
  in.get(facets);
  started_ = facets > 0;
  for (Values* values : {&depth_, &widening_}) {
    std::vector<double> read(facets);
    for (double& value : read) in.get(value);
    *values = Values(std::move(read));
  }
  limit_depths();
  in.get(size_);
  in.get(settled_);
  tracked_.resize(started_ && !closest() ? states_.size() : 0);
  for (std::size_t i = 0; i < (started_ ? states_.size() : 0); ++i) {
    Tracked t;
    in.get(t);
    if (!tracked_.empty()) tracked_[i] = t;
  }
  stale_ = true;
}

}  // namespace abut::contact
